"""Rough surfaces that move through a contact, each at its own speed [jamali_2015 7.6, 7.7]."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.surface.extrusion import Lay, check_divides
from gearlube_core.surface.heights import (
    MICROMETRE,
    NODES_PER_WAVE,
    HeightMap,
    Profile,
    Surface,
    check_closed,
    check_plausible,
)
from gearlube_core.surface.moving_kernels import (
    Moved,
    add_moved_heights,
    rows_of_map,
    spline_coefficients,
)
from gearlube_core.surface.schedule import RoughSchedule
from gearlube_core.units import MILLIMETRE

_WAVES_SHOWN = 0.99  # of the mean square
_SAME = 1e-6  # of a length
_FEWEST_ROWS = 16


@dataclass(frozen=True, slots=True, kw_only=True)
class FedFromInlet:
    """Roughness that enters a smooth contact with its surface, from the inlet.

    Surfaces are smooth at time 0. Behind the first rough point of a surface its heights grow
    linearly with distance.

    Parameters
    ----------
    inlet
        x of the first rough point at time 0 [m]; usually where the domain begins.
    growth
        Length of the surface over which its heights grow from zero to full [m]; the Hertzian
        half-width in [jamali_2015 7.7].

    Examples
    --------
    >>> FedFromInlet(inlet=-5.9e-4, growth=2.4e-4).growth
    0.00024
    """

    inlet: float
    growth: float

    def __post_init__(self) -> None:
        check_finite("inlet", self.inlet, "m")
        check_positive("growth", self.growth, "m")


@dataclass(frozen=True, slots=True, kw_only=True)
class GrownInPlace:
    """Roughness that grows everywhere in a smooth contact at the same time, linearly.

    This takes less time than roughness that enters from the inlet, but no real surface does it. So
    the first films must be left out, until the slower surface has passed the contact.

    Parameters
    ----------
    duration
        Time from smooth to full heights [s].

    Examples
    --------
    >>> GrownInPlace(duration=1e-4).duration
    0.0001
    """

    duration: float

    def __post_init__(self) -> None:
        check_positive("duration", self.duration, "s")


@dataclass(frozen=True, eq=False, kw_only=True)
class MovingSurface:
    """A rough surface in motion: a periodic profile extended along a lay, or a periodic map.

    z(x, y, t) = p(x - y tan(beta) - u t)  or  p(x - y tan(beta) - u t, y)

    Parameters
    ----------
    heights
        Periodic heights; peaks are positive.
    lay
        Lay with the period of the heights along x and the width of the domain. Without turns the
        crests of a profile are along y, and a map is not changed; with turns a map is sheared.
    speed
        u along x [m/s].

    Raises
    ------
    ParameterError
        Heights are not periodic, do not meet at their ends, are below 1 nm or too steep; the
        periods differ; or the width is no multiple of the map's period along y.

    Examples
    --------
    >>> wave = 1e-7 * np.sin(0.02 * math.pi * np.arange(100))
    >>> profile = Profile(height=wave, spacing=1e-6, periodic=True)
    >>> lay = Lay(period=1e-4, width=1e-3, turns=1)
    >>> surface = MovingSurface(heights=profile, lay=lay, speed=2.0)
    >>> [round(1e6 * wave, 3) for wave in surface.shortest_waves()]
    [100.0, 1000.0]
    """

    heights: Surface
    lay: Lay
    speed: float

    def __post_init__(self) -> None:
        check_finite("speed", self.speed, "m/s")
        heights, name = self.heights, self.heights.name
        check_closed(heights)
        check_plausible(heights)
        length = heights.length if isinstance(heights, Profile) else heights.lengths[0]
        if isinstance(heights, HeightMap):
            check_divides(
                f"the width (length_mm in a case file) with {name}",
                self.lay.width,
                heights.lengths[1],
            )
            if self.lay.measured != "along_x":
                raise ParameterError(
                    f"lay.measured must be along_x for {name}, a map, got {self.lay.measured}."
                )
        if abs(length - self.lay.period) > _SAME * length:
            raise ParameterError(
                f"lay.period must be that of {name}, {length / MICROMETRE:.5g} um, got "
                f"{self.lay.period / MICROMETRE:.5g} um."
            )

    @property
    def period(self) -> float:
        """Period along x [m]."""
        across = self.lay.measured == "across_lay"
        return self.lay.period / math.cos(self.lay.angle) if across else self.lay.period

    def coefficients(self, y: Array) -> Array:
        """Return the spline of the rows y [m]: (1, n), or (ny, n) of a map [m]."""
        if isinstance(self.heights, Profile):
            return spline_coefficients(self.heights.height[None, :])
        return spline_coefficients(rows_of_map(self.heights.height, y / self.heights.lengths[1]))

    def shortest_waves(self) -> tuple[float, float]:
        """Return the waves along x and y above which 99 % of the mean square lie [m]."""
        height = self.heights.height
        height = height[:, None] if height.ndim == 1 else height
        power = np.abs(np.fft.fft2(height - height.mean())) ** 2
        nx, ny = height.shape
        along = np.fft.fftfreq(nx) * nx / self.period
        across = np.zeros(1)
        if isinstance(self.heights, HeightMap):
            across = np.fft.fftfreq(ny) * ny / self.heights.lengths[1]
        lean = self.lay.turns * self.period / self.lay.width
        frequencies = (along[:, None] + 0.0 * across, across - lean * along[:, None])
        x, y = (_wave_holding(np.abs(one), power) for one in frequencies)
        return x, y


@dataclass(frozen=True, eq=False, kw_only=True)
class MovingRoughness:
    """Heights of one or two moving surfaces on the nodes of a film at any time.

    Its values are subtracted from the smooth gap.

    Parameters
    ----------
    surfaces
        One or two surfaces with the same width.
    x
        Nodes [m], shape (nx,), rising.
    y
        Rows [m], shape (ny,): evenly over the width, without the row that repeats the first one.
    schedule
        Times and steps of the march.
    feed
        How the smooth contact becomes rough; None: rough at all times.

    Raises
    ------
    ParameterError
        There are no or more than two surfaces, their widths differ, there are fewer than 16 rows or
        an odd number, fewer than eight nodes per wave, or a surface moves by more than a node in a
        time step or never enters.

    Examples
    --------
    >>> wave = 1e-7 * np.sin(0.02 * math.pi * np.arange(100))
    >>> profile = Profile(height=wave, spacing=1e-6, periodic=True)
    >>> lay = Lay(period=1e-4, width=1e-3, turns=1)
    >>> rough = MovingRoughness(
    ...     surfaces=(MovingSurface(heights=profile, lay=lay, speed=2.0),),
    ...     x=1e-6 * np.arange(200.0),
    ...     y=1e-3 / 128 * np.arange(128.0),
    ...     schedule=RoughSchedule(time_step=5e-7, until_rough=0, rough=100),
    ... )
    >>> moved = rough.height(25.0 / 2.0 * 1e-6)  # by 25 nodes
    >>> round(1e9 * float(moved[50, 0]), 4)
    100.0
    """

    surfaces: tuple[MovingSurface, ...]
    x: Array
    y: Array
    schedule: RoughSchedule
    feed: FedFromInlet | GrownInPlace | None = None
    _grids: dict[tuple[bytes, bytes], Callable[[float, Array], None]] = field(
        init=False, repr=False, default_factory=dict
    )

    def __post_init__(self) -> None:
        if not 1 <= len(self.surfaces) <= 2:
            raise ParameterError(f"surfaces must be one or two, got {len(self.surfaces)}.")
        self._check_rows()
        fed = isinstance(self.feed, FedFromInlet)
        for one in self.surfaces:
            self._check_waves(one)
            self._check_step(one)
            if fed and not one.speed > 0.0:
                raise ParameterError(
                    f"The speed of {one.heights.name} must be above 0 m/s so that its roughness "
                    f"enters from the inlet, got {one.speed:g} m/s. Turn the x axis, or let the "
                    "roughness grow in place."
                )

    @cached_property
    def rough_time(self) -> float:
        """Time from which all nodes have full roughness [s]."""
        if isinstance(self.feed, GrownInPlace):
            return self.feed.duration
        if self.feed is None:
            return 0.0
        way = float(self.x[-1]) - self.feed.inlet + self.feed.growth
        return max(way / one.speed for one in self.surfaces)

    def height(self, time: float, into: Array | None = None) -> Array:
        """Return the heights [m] at a time [s], shape (nx, ny).

        Parameters
        ----------
        time
            [s].
        into
            Where to write them, shape (nx, ny); None: a new array.
        """
        return self(self.x, self.y, time, into)

    def height_at_step(self, step: int, into: Array | None = None) -> Array:
        """Return the heights [m] after a number of time steps, shape (nx, ny)."""
        return self.height(self.schedule.time(step), into)

    def __call__(self, x: Array, y: Array, time: float, into: Array | None = None) -> Array:
        """Return the heights [m] on other nodes x, y [m], as coarser grids have; not checked."""
        key = (x.tobytes(), y.tobytes())
        if key not in self._grids:
            self._grids[key] = self._on(x, y)
        height = np.empty((x.size, y.size)) if into is None else into
        self._grids[key](time, height)
        return height

    def _on(self, x: Array, y: Array) -> Callable[[float, Array], None]:
        parts = [(s, s.coefficients(y), s.lay.turns * y / s.lay.width) for s in self.surfaces]
        nodes, feed = np.array(x, dtype=np.float64), self.feed

        def write(time: float, height: Array) -> None:
            height[:] = 0.0
            for surface, coefficients, turns in parts:
                moved = _moved(surface, feed, time)
                add_moved_heights(coefficients, nodes, turns, moved, height)

        return write

    def _check_rows(self) -> None:
        rows, width = self.y.size, self.surfaces[0].lay.width
        if rows < _FEWEST_ROWS or rows % 2:
            raise ParameterError(
                f"Rows along y must be an even number from {_FEWEST_ROWS} on, got {rows}. Take "
                f"{max(rows + rows % 2, _FEWEST_ROWS)}; 128 resolve a lay of 8.5 deg over 1 mm."
            )
        for one in self.surfaces:
            if abs(one.lay.width - width) > _SAME * width:
                raise ParameterError(
                    f"Both surfaces must repeat over the same width, got "
                    f"{width / MILLIMETRE:.5g} and {one.lay.width / MILLIMETRE:.5g} mm."
                )
        spread = float(np.abs(np.diff(self.y) - width / rows).max())
        if spread > _SAME * width:
            raise ParameterError(
                f"Rows along y must lie {width / rows / MICROMETRE:.5g} um apart, the width of "
                f"{width / MILLIMETRE:.5g} mm over {rows} rows, got steps up to "
                f"{float(np.diff(self.y).max()) / MICROMETRE:.5g} um. Leave out the row that "
                "repeats the first one, or take a width that the period divides."
            )

    def _check_waves(self, one: MovingSurface) -> None:
        waves, length = one.shortest_waves(), float(self.x[-1] - self.x[0])
        if waves[0] > length:
            raise ParameterError(
                f"{one.heights.name} must have waves along x shorter than the computed "
                f"{length / MILLIMETRE:.4g} mm, got {waves[0] / MILLIMETRE:.4g} mm for the "
                "shortest. Give places in mm, not in um, and lengths of waves in um."
            )
        for axis, places, wave in zip("xy", (self.x, self.y), waves, strict=True):
            step, limit = float(np.diff(places).max()), wave / NODES_PER_WAVE
            if step > limit * (1.0 + _SAME):
                steps = math.ceil((step * (places.size - 1)) / limit * (1.0 - _SAME))
                rows = math.ceil(step * places.size / limit * (1.0 - _SAME))
                cure = f"{steps + 1} nodes along x" if axis == "x" else f"{rows + rows % 2} rows"
                raise ParameterError(
                    f"The grid must have {NODES_PER_WAVE:g} nodes a wave along {axis}, a step of "
                    f"at most {limit / MICROMETRE:.4g} um for {one.heights.name}, got "
                    f"{step / MICROMETRE:.4g} um. Take {cure} or more, or filter short waves out "
                    "(cutoff_um in a case file)."
                )

    def _check_step(self, one: MovingSurface) -> None:
        moved = abs(one.speed) * self.schedule.time_step
        node = float(np.diff(self.x).min())
        if moved > node * (1.0 + _SAME):
            raise ParameterError(
                f"time_step must be at most {node / abs(one.speed):.4g} s, so that "
                f"{one.heights.name} moves by no more than a node of {node / MICROMETRE:.4g} um, "
                f"got {self.schedule.time_step:.4g} s. Take shorter steps (a larger "
                "steps_per_half_width in a case file); half a node is usual."
            )


def _moved(one: MovingSurface, feed: FedFromInlet | GrownInPlace | None, time: float) -> Moved:
    travel = one.speed * time
    scale, front, growth = 1.0, math.inf, 1.0
    if isinstance(feed, FedFromInlet):
        front, growth = feed.inlet + travel, feed.growth
    elif feed is not None:
        scale = min(max(time / feed.duration, 0.0), 1.0)
    return Moved(one.period, travel, scale, front, growth)


def _wave_holding(frequency: Array, power: Array) -> float:
    """Return the wave [m] above which 99 % of the mean square lie; inf where nothing changes."""
    order = np.argsort(frequency, axis=None)
    held = np.cumsum(power.ravel()[order])
    last = int(np.searchsorted(held, _WAVES_SHOWN * held[-1] * (1.0 - 1e-12)))
    highest = float(frequency.ravel()[order][min(last, held.size - 1)])
    return math.inf if highest == 0.0 else 1.0 / highest
