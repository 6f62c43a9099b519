"""Shapes of the gap: ridges, dents, waviness, measured heights."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive
from gearlube_core.errors import ParameterError

Heights = Callable[[Array, Array], Array]

# fewest that show a shape and not the grid
_NODES_PER_WIDTH, _NODES_PER_WAVE = 4.0, 8.0
_HALF = 4.0 * math.log(2.0)  # exp(-_HALF/4) = 1/2


@dataclass(frozen=True, slots=True, kw_only=True)
class Ridge:
    """Straight ridge, or groove where its height is negative.

    z = A exp(-4 ln(2) s^2/w^2), s the distance from its crest

    Parameters
    ----------
    height
        A [m]; below 0 a groove.
    width
        w, at half height [m].
    x, y
        A point of its crest [m].
    direction
        Of the crest, from x towards y [rad]; pi/2 lies across x.
    """

    height: float
    width: float
    x: float = 0.0
    y: float = 0.0
    direction: float = 0.5 * math.pi

    def __post_init__(self) -> None:
        check_finite("height", self.height, "m")
        check_positive("width", self.width, "m")

    def __call__(self, x: Array, y: Array) -> Array:
        """Return the heights [m] at (x, y) [m]."""
        sine, cosine = math.sin(self.direction), math.cos(self.direction)
        distance = (x - self.x) * sine - (y - self.y) * cosine
        return np.asarray(self.height * np.exp(-_HALF * (distance / self.width) ** 2))

    def check_serves(self, x: Array, y: Array) -> None:
        """Refuse a grid x, y [m] that is too coarse for the width."""
        across = (math.sin(self.direction), math.cos(self.direction))
        _check_nodes("ridge.width", self.width, across, _NODES_PER_WIDTH, x, y)


@dataclass(frozen=True, slots=True, kw_only=True)
class Dent:
    """Round dent, or bump where its depth is negative.

    z = -A exp(-4 ln(2) r^2/w^2), r the distance from its middle

    Parameters
    ----------
    depth
        A [m]; below 0 a bump.
    width
        w, diameter at half depth [m].
    x, y
        Its middle [m].
    """

    depth: float
    width: float
    x: float = 0.0
    y: float = 0.0

    def __post_init__(self) -> None:
        check_finite("depth", self.depth, "m")
        check_positive("width", self.width, "m")

    def __call__(self, x: Array, y: Array) -> Array:
        """Return the heights [m] at (x, y) [m]."""
        square = ((x - self.x) ** 2 + (y - self.y) ** 2) / self.width**2
        return np.asarray(-self.depth * np.exp(-_HALF * square))

    def check_serves(self, x: Array, y: Array) -> None:
        """Refuse a grid x, y [m] that is too coarse for the width."""
        _check_nodes("dent.width", self.width, (1.0, 1.0), _NODES_PER_WIDTH, x, y)


@dataclass(frozen=True, slots=True, kw_only=True)
class Waviness:
    """Straight waves: z = A cos(2 pi (x cos(d) + y sin(d))/wavelength + phase).

    Parameters
    ----------
    amplitude
        A, half the height from trough to crest [m].
    wavelength
        [m].
    direction
        d, across the crests, from x towards y [rad]; 0: crests lie across x.
    phase
        [rad].
    """

    amplitude: float
    wavelength: float
    direction: float = 0.0
    phase: float = 0.0

    def __post_init__(self) -> None:
        check_positive("amplitude", self.amplitude, "m")
        check_positive("wavelength", self.wavelength, "m")

    def __call__(self, x: Array, y: Array) -> Array:
        """Return the heights [m] at (x, y) [m]."""
        along = x * math.cos(self.direction) + y * math.sin(self.direction)
        turn = 2.0 * math.pi * along / self.wavelength + self.phase
        return np.asarray(self.amplitude * np.cos(turn))

    def check_serves(self, x: Array, y: Array) -> None:
        """Refuse a grid x, y [m] that is too coarse for the wavelength."""
        across = (math.cos(self.direction), math.sin(self.direction))
        _check_nodes("waviness.wavelength", self.wavelength, across, _NODES_PER_WAVE, x, y)


@dataclass(frozen=True, slots=True)
class RoughGap:
    """Gap h_u(x, y) less heights: material that stands out narrows it.

    Parameters
    ----------
    smooth
        Gap [m] at (x, y) [m].
    heights
        Each [m] at (x, y) [m].
    """

    smooth: Heights
    heights: tuple[Heights, ...]

    def __call__(self, x: Array, y: Array) -> Array:
        """Return the gap [m] at (x, y) [m]."""
        gap = np.asarray(self.smooth(x, y))
        for one in self.heights:
            gap = gap - one(x, y)
        return gap


def _check_nodes(
    name: str, length: float, across: tuple[float, float], fewest: float, x: Array, y: Array
) -> None:
    for axis, share, places in zip("xy", across, (x, y), strict=True):
        limit = fewest * abs(share) * float(np.diff(places).max())
        if length < limit:
            raise ParameterError(
                f"{name} must be at least {fewest:g} nodes along {axis}, {1e3 * limit:.4g} mm on "
                f"this grid, got {1e3 * length:.4g} mm. Take more nodes or a smaller domain."
            )
