"""Equal-angle sampling of signals that were recorded at equal time steps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive
from gearlube_core.errors import ParameterError

_ROUNDING = 1e-9  # rev, length by which a window may exceed the record through rounding


@dataclass(frozen=True, slots=True, kw_only=True)
class AngleWindow:
    """A whole number of shaft revolutions on an equal-angle grid.

    Parameters
    ----------
    start : float
        Shaft angle of the first sample [rad].
    revolutions : int
        Length of the window [-]; the end point is the first point of the next window.
    samples_per_revolution : int
        Grid density [-].
    mean_speed : float
        Angle swept divided by the time it took [rad/s].
    """

    start: float
    revolutions: int
    samples_per_revolution: int
    mean_speed: float

    def __post_init__(self) -> None:
        check_finite("start", self.start, "rad")
        check_positive("revolutions", self.revolutions)
        check_positive("samples_per_revolution", self.samples_per_revolution)
        check_positive("mean_speed", self.mean_speed, "rad/s")

    @property
    def size(self) -> int:
        """Number of samples in the window [-]."""
        return self.revolutions * self.samples_per_revolution

    @property
    def duration(self) -> float:
        """Time the shaft takes to sweep the window [s]."""
        return 2.0 * math.pi * self.revolutions / self.mean_speed

    @property
    def angle(self) -> Array:
        """Shaft angles of the samples [rad], shape (size,)."""
        step = 2.0 * math.pi / self.samples_per_revolution
        return self.start + step * np.arange(self.size, dtype=np.float64)


def whole_revolutions(orders: Sequence[float], minimum: int, *, search: int = 10) -> int:
    """Return the number of revolutions for which all orders are closest to whole cycles.

    A line of order q falls on a bin of a window of N revolutions when N q is an integer. The
    window is the N in [minimum, minimum + search] with the smallest sum over the orders of the
    distance from N q to the nearest integer; the shortest wins a tie. Distances count in steps of
    0.5 % of a cycle, so that a window is not made longer for a gain that no plot shows.

    Parameters
    ----------
    orders : sequence of float
        Events per shaft revolution [-], for instance a cage at 0.399. Whole orders always fit.
    minimum : int
        Shortest window [rev].
    search : int
        How many longer windows are tried [rev].

    Returns
    -------
    int
        Length of the window [rev].
    """
    check_positive("minimum", minimum)
    best, best_misfit = minimum, math.inf
    for revolutions in range(minimum, minimum + search + 1):
        distances = (abs(revolutions * q - round(revolutions * q)) for q in orders)
        misfit = sum(round(200.0 * distance) for distance in distances)
        if misfit < best_misfit:
            best, best_misfit = revolutions, misfit
    return best


def angle_window(
    time: Array, angle: Array, *, revolutions: int, samples_per_revolution: int
) -> AngleWindow:
    """Place a window of `revolutions` at the end of a record.

    Parameters
    ----------
    time, angle : array
        Sample times [s] and exact shaft angles [rad], both increasing, shape (n,).
    revolutions : int
        Length [-].
    samples_per_revolution : int
        Grid density [-].

    Returns
    -------
    AngleWindow
        The last `revolutions` of the record.
    """
    if not np.all(np.diff(angle) > 0.0):
        raise ParameterError(
            "angle must increase from sample to sample, got a record in which the shaft stops or "
            "turns back. Start the record after the speed has settled."
        )
    recorded = (angle[-1] - angle[0]) / (2.0 * math.pi)
    if revolutions > recorded + _ROUNDING:
        raise ParameterError(
            f"revolutions must be at most {recorded:.3f} rev, the length of the record, "
            f"got {revolutions} rev. Record for longer."
        )
    start = angle[-1] - 2.0 * math.pi * revolutions
    first = float(np.interp(start, angle, time))
    speed = 2.0 * math.pi * revolutions / (time[-1] - first)
    return AngleWindow(
        start=float(start),
        revolutions=revolutions,
        samples_per_revolution=samples_per_revolution,
        mean_speed=float(speed),
    )


def resample(angle: Array, signals: Array, window: AngleWindow) -> Array:
    """Interpolate signals onto the equal-angle grid of `window` with a cubic spline.

    Parameters
    ----------
    angle : array
        Shaft angles of the samples [rad], increasing, shape (n,).
    signals : array
        Samples, shape (n,) or (n, channels).
    window : AngleWindow
        Target grid, inside the record.

    Returns
    -------
    array
        Shape (window.size,) or (window.size, channels).

    Notes
    -----
    A cubic spline keeps a component of s samples per cycle to a relative error of about
    1/(s - 1)^4: 4e-3 at 5 samples, 1.5e-4 at 10, 3e-7 at 44 ([unser_1999],
    spline of degree 3).
    """
    from scipy.interpolate import CubicSpline  # slow to import, also where nothing is resampled

    return np.asarray(CubicSpline(angle, signals, axis=0)(window.angle))
