"""The part of a film that statistics are taken over, and distributions there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.checks import check_positive
from gearlube_core.ehl.point.equations.stencil import cell_faces
from gearlube_core.errors import ParameterError

_FEWEST = 4  # nodes along a side


class Distribution:
    """Areas over bins of a quantity, gathered from any number of films.

    Parameters
    ----------
    edges
        Of the bins, rising, shape (n + 1,). A value at an edge belongs to the bin below it, so that
        the distribution function at an edge is exact: the share of the area at or below it.
    """

    def __init__(self, edges: Array) -> None:
        if edges.ndim != 1 or edges.size < 2 or not (np.diff(edges) > 0.0).all():
            raise ParameterError(f"edges must rise, at least 2, got shape {edges.shape}.")
        self.edges = edges
        self.areas = np.zeros(edges.size + 1)  # below the first edge, bins, beyond the last

    def add(self, values: Array, areas: Array) -> None:
        """Add nodes: values and areas, shapes (n,)."""
        bins = np.searchsorted(self.edges, values, side="left")
        self.areas += np.bincount(bins, areas, self.areas.size)

    @property
    def function(self) -> Array:
        """Share of the area at or below each edge [-], shape (n + 1,); NaN where none was added."""
        total = self.areas.sum()
        if total == 0.0:
            return np.full(self.edges.size, np.nan)
        return np.asarray(np.cumsum(self.areas[:-1]) / total)

    @property
    def shares(self) -> Array:
        """Share of the area in each bin [-], shape (n,); NaN where none was added.

        What is at or below the first edge counts in the first bin.
        """
        function = self.function
        shares = np.diff(function)
        shares[0] += function[0]
        return np.asarray(shares)

    def percentiles(self, percent: Array) -> Array:
        """Return the values at or below which a percentage of the area lies, shape of `percent`.

        Straight inside a bin, so wrong by less than its width. At or below the first edge it is
        that edge; beyond the last NaN.
        """
        function = self.function
        share = percent / 100.0 * (1.0 - 1e-12)
        if np.isnan(function[0]):
            return np.full(percent.shape, np.nan)
        upper = np.searchsorted(function, share)
        beyond = upper == function.size
        upper = np.minimum(upper, function.size - 1)
        lower = np.maximum(upper - 1, 0)
        span = function[upper] - function[lower]
        inside = (share - function[lower]) / np.where(span > 0.0, span, 1.0)
        inside = np.where(upper > 0, inside, 0.0)
        found = self.edges[lower] + inside * (self.edges[upper] - self.edges[lower])
        return np.where(beyond, np.nan, found)


def weighted_percentiles(values: Array, areas: Array, percent: Array) -> Array:
    """Return the smallest values at or below which a percentage of the area lies.

    Parameters
    ----------
    values, areas
        Values and their areas, shape (n,).
    percent
        [%], shape (m,).
    """
    order = np.argsort(values)
    share = np.cumsum(areas[order])
    places = np.searchsorted(share, percent / 100.0 * share[-1] * (1.0 - 1e-12))
    return np.asarray(values[order][np.minimum(places, values.size - 1)])


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class FilmZone:
    """The nodes of a film whose statistics are taken, usually inside the Hertzian contact.

    Parameters
    ----------
    x, y
        Nodes [m], shapes (nx,) and (ny,).
    inside
        Which nodes are counted, shape (nx, ny).
    cells
        Areas of all cells [m2], shape (nx, ny).

    Examples
    --------
    >>> zone = FilmZone.line(np.linspace(-4e-4, 4e-4, 401), np.linspace(0.0, 1e-3, 33), 2.01e-4)
    >>> int(zone.inside.sum())
    6633
    """

    x: Array
    y: Array
    inside: Flags
    cells: Array

    @classmethod
    def line(cls, x: Array, y: Array, half_width: float) -> FilmZone:
        """Return |x| <= a on all rows, a [m] the half-width of a line contact."""
        check_positive("half_width", half_width, "m")
        return cls._of(x, y, np.abs(x)[:, None] <= half_width + 0.0 * y)

    @classmethod
    def ellipse(cls, x: Array, y: Array, a: float, b: float) -> FilmZone:
        """Return (x/a)^2 + (y/b)^2 <= 1, with the half-axes of a point contact [m]."""
        check_positive("a", a, "m")
        check_positive("b", b, "m")
        return cls._of(x, y, (x[:, None] / a) ** 2 + (y / b) ** 2 <= 1.0)

    @classmethod
    def _of(cls, x: Array, y: Array, inside: Flags) -> FilmZone:
        for name, nodes in (("x", x), ("y", y)):
            if nodes.ndim != 1 or nodes.size < _FEWEST or not (np.diff(nodes) > 0.0).all():
                raise ParameterError(
                    f"{name} must be at least {_FEWEST} rising places [m], got shape {nodes.shape}."
                )
        if not inside.any():
            raise ParameterError(
                "The Hertzian contact must hold a node, got none. Give lengths in m and x = 0 in "
                "its middle."
            )
        cells = np.diff(cell_faces(x))[:, None] * np.diff(cell_faces(y))
        return cls(x=x, y=y, inside=inside, cells=cells)
