"""Extreme values of a signal that is sampled only a few times per cycle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive

_END = 6  # intervals after which the end condition of the spline has decayed to (sqrt(3) - 2)^6


@dataclass(frozen=True, slots=True, kw_only=True)
class Extremes:
    """Smallest, largest and mean value of a signal, in the unit of the signal."""

    minimum: float
    maximum: float
    mean: float

    @property
    def peak_to_peak(self) -> float:
        """Difference between the largest and the smallest value."""
        return self.maximum - self.minimum


def extremes(signal: Array, refine: int = 1) -> Extremes:
    """Return the extremes of equally spaced samples, between the samples when `refine` > 1.

    With s samples per cycle the largest sample lies up to 1 - cos(pi/s) below the crest (19 % at
    s = 5); reading a cubic spline at `refine` points per sample divides s accordingly. Use 1 for
    signals with kinks such as contact loads, where a spline overshoots. The first and last few
    intervals, where the spline feels its ends, count with their samples only.

    Parameters
    ----------
    signal : array
        Samples, shape (n,).
    refine : int
        Points read per sample [-].
    """
    check_positive("refine", refine)
    values = np.asarray(signal, dtype=np.float64)
    mean = float(np.mean(values))
    if refine > 1:
        from scipy.interpolate import CubicSpline  # slow to import, also where nothing is refined

        interior = np.arange(_END * refine, (values.size - 1 - _END) * refine + 1) / refine
        between = CubicSpline(np.arange(values.size), values)(interior)
        values = np.concatenate([values, between])
    return Extremes(minimum=float(np.min(values)), maximum=float(np.max(values)), mean=mean)
