"""Running-in as a model: peaks cut off at a height."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Generic

import numpy as np

from gearlube_core.checks import check_finite
from gearlube_core.errors import ParameterError
from gearlube_core.surface.heights import MICROMETRE, S

_MOST = 0.5  # of the points: beyond, no peaks are cut but the surface


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class RunIn(Generic[S]):
    """A surface after its peaks were cut.

    Parameters
    ----------
    surface
        Its mean is zero again.
    height
        At which the peaks were cut, above the mean of before [m].
    share
        Of the points that were above it [-].
    removed
        Mean height of the removed material [m].
    """

    surface: S
    height: float
    share: float
    removed: float


def peaks_cut(surface: S, height: float) -> RunIn[S]:
    """Return a surface whose peaks are cut off flat at a height, as a model of running-in.

    This is no simulation of wear: real running-in rounds the peaks and bends material aside. The
    cuts have edges, which add shorter waves than before. Filter them with lambda_s if the grid is
    too coarse for them.

    Parameters
    ----------
    surface
        Levelled profile or map.
    height
        Height of the cut [m] above the mean; a value below 0 is below the mean.

    Raises
    ------
    ParameterError
        More than half of the points would be cut.

    Examples
    --------
    >>> from gearlube_core.surface.heights import Profile
    >>> profile = Profile(height=1e-7 * np.sin(np.arange(500.0)), spacing=1e-5)
    >>> round(peaks_cut(profile, 0.5e-7).share, 2)  # a third of a sine
    0.33
    """
    check_finite("height", height, "m")
    deviation = surface.height - surface.height.mean()
    share = float(np.mean(deviation > height))
    if share > _MOST:
        raise ParameterError(
            f"height must cut at most {100.0 * _MOST:g} % of the points of {surface.name}, from "
            f"{np.quantile(deviation, 1.0 - _MOST) / MICROMETRE:.3g} um on, got "
            f"{height / MICROMETRE:.3g} um, which cuts {100.0 * share:.3g} %."
        )
    cut = np.minimum(deviation, height)
    removed = -float(cut.mean())
    return RunIn(
        surface=replace(surface, height=cut + removed), height=height, share=share, removed=removed
    )
