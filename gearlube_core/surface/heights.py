"""Heights at evenly spaced points: a profile along a line, a map over a rectangle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.surface.measured_heights import MeasuredMap, MeasuredProfile
from gearlube_core.units import MILLIMETRE

MICROMETRE = 1e-6  # m
FEWEST_POINTS = 4  # of a cubic spline, which joins the points
NODES_PER_WAVE = 8.0  # fewest that show a wave and not the grid
STEEPEST = 0.2  # [-] rms slope: Reynolds' equation takes slopes as small
_SPACINGS = (1e-9, 1e-3)  # m, of instruments and film grids
_LOWEST_RQ = 1e-9  # m, below polished wafers
_UNEVEN = 1e-3  # of a spacing
_MOST_FILLED = 10.0  # even points for each measured one
_CUT = "out a part whose ends meet (period_um in a case file, periodic_section in Python)"
_CLOSED = 4.0  # times the rms step between neighbours that may lie at a periodic seam


@dataclass(frozen=True, eq=False, kw_only=True)
class Profile:
    """A measured or made surface profile: heights at evenly spaced points, the first at x = 0.

    Parameters
    ----------
    height
        Heights [m], shape (n,), n at least 4.
    spacing
        Distance from point to point [m], 1 nm to 1 mm.
    periodic
        True: after the last point the profile begins again.
    name
        Name in error messages.

    Raises
    ------
    ParameterError
        A height is not finite, there are fewer than four, or the spacing is out of its range.

    Examples
    --------
    >>> import numpy as np
    >>> round(Profile(height=np.zeros(100), spacing=1e-6, periodic=True).length, 9)
    0.0001
    """

    height: Array
    spacing: float
    periodic: bool = False
    name: str = "profile"

    def __post_init__(self) -> None:
        _check_heights(self.name, self.height, 1)
        _check_spacing(self.name, "", self.spacing)

    @property
    def x(self) -> Array:
        """Places (n,) [m]."""
        return self.spacing * np.arange(self.height.size, dtype=np.float64)

    @property
    def length(self) -> float:
        """Period, or distance of the first point from the last [m]."""
        return self.spacing * (self.height.size - (not self.periodic))

    def measured(self) -> MeasuredProfile:
        """Return the profile with a cubic spline between the points."""
        return MeasuredProfile(self.x, self.height, self.name)


@dataclass(frozen=True, eq=False, kw_only=True)
class HeightMap:
    """A measured or made surface map: heights on an even grid, the first at x = y = 0.

    Parameters
    ----------
    height
        Heights [m], shape (nx, ny), both at least 4.
    spacing
        Distances along x and y [m], 1 nm to 1 mm.
    periodic
        Along x and along y. True: after the last point the map begins again.
    name
        Name in error messages.

    Raises
    ------
    ParameterError
        A height is not finite, there are fewer than four along a side, or a spacing is out of
        its range.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(HeightMap(height=np.zeros((5, 9)), spacing=(1e-6, 2e-6)).y[-1]), 9)
    1.6e-05
    """

    height: Array
    spacing: tuple[float, float]
    periodic: tuple[bool, bool] = (False, False)
    name: str = "height map"

    def __post_init__(self) -> None:
        _check_heights(self.name, self.height, 2)
        for axis, one in zip("xy", self.spacing, strict=True):
            _check_spacing(self.name, f" along {axis}", one)

    @property
    def x(self) -> Array:
        """Places (nx,) [m]."""
        return self.spacing[0] * np.arange(self.height.shape[0], dtype=np.float64)

    @property
    def y(self) -> Array:
        """Places (ny,) [m]."""
        return self.spacing[1] * np.arange(self.height.shape[1], dtype=np.float64)

    @property
    def lengths(self) -> tuple[float, float]:
        """Periods, or distances of the first points from the last [m]."""
        sides = zip(self.spacing, self.height.shape, self.periodic, strict=True)
        along_x, along_y = (step * (count - (not closed)) for step, count, closed in sides)
        return along_x, along_y

    def measured(self) -> MeasuredMap:
        """Return the map with a bicubic spline between the points."""
        return MeasuredMap(self.x, self.y, self.height, self.name)


Surface = Profile | HeightMap
S = TypeVar("S", Profile, HeightMap)  # the kind that a function takes and gives back


def evenly_spaced(measured: MeasuredProfile | MeasuredMap) -> Surface:
    """Return measured heights at even points; uneven ones are joined by their cubic spline.

    The spacing is then the smallest of the places.

    Raises
    ------
    ParameterError
        More than ten times as many points would be needed.
    """
    if isinstance(measured, MeasuredProfile):
        x, heights = _even(measured.name, "x", measured.x), measured.height
        if x is not measured.x:
            heights = measured(x)
        return Profile(height=heights, spacing=_step(x), name=measured.name)
    x, y = (_even(measured.name, axis, getattr(measured, axis)) for axis in "xy")
    heights = measured.height
    if x is not measured.x or y is not measured.y:
        heights = measured(x[:, None], y[None, :])
    return HeightMap(height=heights, spacing=(_step(x), _step(y)), name=measured.name)


def check_plausible(surface: Surface) -> None:
    """Refuse heights that no machined flank has, most often those of a wrong unit.

    Raises
    ------
    ParameterError
        The heights' root mean square is below 1 nm, or their slopes' above 0.2.
    """
    spacings = (surface.spacing,) if isinstance(surface, Profile) else surface.spacing
    rq = float(surface.height.std())
    if rq < _LOWEST_RQ:
        raise ParameterError(
            f"{surface.name}: heights must have a root mean square of at least 1 nm, got "
            f"{1e9 * rq:.3g} nm. Give heights in um; if mm are written instead, they are a "
            "thousand times too small."
        )
    for axis, step in enumerate(spacings):
        slope = float(np.sqrt(np.mean((np.diff(surface.height, axis=axis) / step) ** 2)))
        if slope > STEEPEST:
            raise ParameterError(
                f"{surface.name}: the rms slope along {'xy'[axis]} must be at most {STEEPEST:g}, "
                f"got {slope:.3g}. Give heights in um and places in mm, level the surface, or "
                "filter short waves out (cut-off lambda_s)."
            )


def check_closed(surface: Surface) -> None:
    """Refuse a profile or map that is not periodic or whose ends do not meet.

    Raises
    ------
    ParameterError
        A side is not periodic, or the rms step from its last points to its first is more than
        four times the rms of the others.
    """
    if isinstance(surface, Profile):
        _check_seam(surface.name, surface.height, 0, surface.periodic, "")
        return
    for axis, closed in enumerate(surface.periodic):
        _check_seam(surface.name, surface.height, axis, closed, f" along {'xy'[axis]}")


def _check_seam(name: str, height: Array, axis: int, closed: bool, along: str) -> None:
    if not closed:
        cure = f"Cut {_CUT}" if height.ndim == 1 else "Take a map that repeats"
        raise ParameterError(f"{name} must be periodic{along}. {cure}, or generate it.")
    typical = float(np.sqrt(np.mean(np.diff(height, axis=axis) ** 2)))
    step = height.take(0, axis) - height.take(-1, axis)
    jump = float(np.sqrt(np.mean(step**2)))
    if jump > _CLOSED * typical:
        raise ParameterError(
            f"{name}: the heights at both ends{along} must meet within "
            f"{_CLOSED * typical / MICROMETRE:.3g} um, {_CLOSED:g} times the rms step between "
            f"neighbours, got a jump of {jump / MICROMETRE:.3g} um. "
            + (f"Cut {_CUT}." if height.ndim == 1 else "Take another part, or generate the map.")
        )


def _check_heights(name: str, height: Array, dimensions: int) -> None:
    if height.ndim != dimensions or min(height.shape) < FEWEST_POINTS:
        raise ParameterError(
            f"{name}: heights must have {dimensions} dimension{'s' * (dimensions > 1)} and at "
            f"least {FEWEST_POINTS} points along each, got shape {height.shape}."
        )
    wrong = int((~np.isfinite(height)).sum())
    if wrong:
        raise ParameterError(
            f"{name}: heights must be finite, {wrong} of {height.size} are not. Fill the gaps of "
            "the measurement first."
        )


def _check_spacing(name: str, along: str, spacing: float) -> None:
    low, high = _SPACINGS
    check_within(
        f"{name}: spacing{along}", spacing, low, high, "m", "Give it in m: 1 um is 1e-6 m."
    )


def _step(x: Array) -> float:
    return float((x[-1] - x[0]) / (x.size - 1))


def _even(name: str, axis: str, places: Array) -> Array:
    steps = np.diff(places)
    if np.ptp(steps) <= _UNEVEN * steps.mean():
        return places
    count = round((places[-1] - places[0]) / float(steps.min())) + 1
    if count > _MOST_FILLED * places.size:
        raise ParameterError(
            f"{name}: steps along {axis} must not differ so much that even points are more than "
            f"{_MOST_FILLED:g} times as many, got steps from {steps.min() / MILLIMETRE:.3g} to "
            f"{steps.max() / MILLIMETRE:.3g} mm. Leave out points that lie too close."
        )
    return np.linspace(places[0], places[-1], count)
