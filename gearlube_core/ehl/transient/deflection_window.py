"""Deflection of a grid within the box of nodes that carry pressure, in single precision."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.contact.half_space import GradedConvolution, HalfSpaceConvolution
from gearlube_core.ehl.point.equations.closed_deflection import ClosedDeflection
from gearlube_core.ehl.point.equations.grid import PointGrid

_Span = tuple[int, int]

_REACH = 2  # nodes that a stencil reaches beyond those with pressure
_SPARE = 0.04  # of the nodes along a side, beside the box, before it is cut anew
_LOOSE = 1.3  # nodes of the box over those that it needs, before it is cut anew


class WindowedDeflection:
    """Deflection under a change of pressure; for linear solutions and preconditioners.

    A contact line that enters or leaves the mesh takes a part of the grid. The transform's cost
    is that of the box. A grid that is graded along x is transformed whole: its columns without
    pressure cost nothing.

    Parameters
    ----------
    grid
        Grid.
    """

    def __init__(self, grid: PointGrid) -> None:
        self._coefficients = grid.coefficients
        self._whole: GradedConvolution | None = None
        if grid.graded:
            self._whole = GradedConvolution(grid.coefficients, single=True)
        self._modes, self._sides, self._workers = grid.modes, grid.sides, grid.workers
        self._convolution: HalfSpaceConvolution | ClosedDeflection
        self._spans: tuple[_Span, _Span] | None = None
        self._result: Any = np.zeros(grid.shape, dtype=np.float32)

    def follow(self, free: Flags) -> None:
        """Cut the box anew if it misses nodes, shape (ny, nx), or is much too large."""
        if self._whole is not None:
            return
        filled = [np.asarray(free.any(axis=axis)) for axis in (1, 0)]
        needed = [_span(flags, _REACH) for flags in filled]
        wide = [_span(flags, _REACH + 1 + int(_SPARE * flags.size)) for flags in filled]
        if self._spans is not None:
            inside = all(
                a <= c and d <= b for (a, b), (c, d) in zip(self._spans, needed, strict=True)
            )
            if inside and _area(*self._spans) <= _LOOSE * _area(*wide):
                return
        self._spans = rows, columns = wide[0], wide[1]
        if self._modes is not None:
            # rows repeat: the box has them all
            rows = 0, free.shape[0]
            self._spans = rows, columns
            modes = self._modes[: columns[1] - columns[0]]
            self._convolution = ClosedDeflection(
                modes, self._sides, rows[1] - 2, single=True, workers=self._workers
            )
            self._result[:] = 0.0
            return
        self._convolution = HalfSpaceConvolution(
            self._coefficients[: rows[1] - rows[0], : columns[1] - columns[0]], single=True
        )
        self._result[:] = 0.0

    def clear(self) -> None:
        """Cut the box anew before it is used again."""
        self._spans = None

    def __call__(self, pressure: Array) -> Array:
        """Return the deflection, shape (ny, nx), zero outside the box.

        The result is overwritten by the next call.
        """
        if self._whole is not None:
            return self._whole(pressure)
        assert self._spans is not None
        rows, columns = self._spans
        box = slice(*rows), slice(*columns)
        self._result[box] = self._convolution(pressure[box])
        return np.asarray(self._result)


def _span(wanted: Flags, spare: int) -> _Span:
    """Return the first and one past the last place that is wanted, and some beside them."""
    places = np.flatnonzero(wanted)
    if places.size == 0:
        return 0, min(wanted.size, 1 + spare)
    return max(int(places[0]) - spare, 0), min(int(places[-1]) + 1 + spare, wanted.size)


def _area(rows: _Span, columns: _Span) -> int:
    return (rows[1] - rows[0]) * (columns[1] - columns[0])
