"""Multigrid cycle for long contacts: line solutions along the motion, coarsening across it.

In a long contact the spacing along the contact is many times that along the motion. A row then
feels its own pressure by far the most, over a good part of its length: rows are solved with the
deflection of a wave across the motion, and coarser grids have fewer of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.contact.half_space import GradedConvolution, HalfSpaceConvolution
from gearlube_core.ehl.point.equations.grid import ClosedDeflection, PointGrid
from gearlube_core.ehl.point.newton.galerkin import SparseOperator, coarse_operator, sparse_operator
from gearlube_core.ehl.point.newton.preconditioner import CoarseSolution
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.newton.wave import wave_deflection
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.kernels.jit import kernel

_Span = tuple[int, int]

_REACH = 2  # nodes that a stencil reaches beyond those with pressure
_SPARE_SHARE = 0.04  # of the nodes along a side, beside the box, before it is cut again
_LOOSE = 1.3  # nodes of the box over those that it needs, before it is cut again
Inverse = Callable[[Array, float], tuple[Array, float]]

_DAMPING = 0.9
# a row, of the wave across the motion whose deflection a row takes: longer ones would be amplified
_WAVE = 0.12 * np.pi
_SPARE = 4  # columns beside the free ones for those that come
_CHANGE = 0.05  # mean relative change of a row from which on it is inverted again
_AT_ONCE = 64  # rows
_DIRECT_NODES = 1700  # of the grid that is solved directly
_FEWEST_ROWS = 7


class WindowedDeflection:
    """Deflection under a change of pressure; for linear solutions and preconditioners.

    A contact line that enters or leaves the mesh takes a part of the grid. The transform's cost
    is that of the box. A grid that is graded along x is transformed whole: its columns without
    pressure cost nothing.

    Parameters
    ----------
    grid
        Grid of this contact level.
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
        """Cut the box again if it misses nodes, shape (ny, nx), or is much too large."""
        if self._whole is not None:
            return
        filled = [np.asarray(free.any(axis=axis)) for axis in (1, 0)]
        needed = [_span(flags, _REACH) for flags in filled]
        wide = [_span(flags, _REACH + 1 + int(_SPARE_SHARE * flags.size)) for flags in filled]
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
        """Cut the box again before it is used again."""
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


def row_shapes(shape: tuple[int, int]) -> list[tuple[int, int]]:
    """Return shapes (ny, nx) from coarse to fine that differ in the number of rows."""
    shapes = [shape]
    while shapes[0][0] * shapes[0][1] > _DIRECT_NODES and shapes[0][0] > _FEWEST_ROWS:
        shapes.insert(0, ((shapes[0][0] - 1) // 2 + 1, shape[1]))
    return shapes


@kernel
def fill_row_matrices(
    start: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
    free: np.ndarray,
    local: np.ndarray,
    across: np.ndarray,
    first: int,
    which: np.ndarray,
    matrices: np.ndarray,
) -> None:
    """Fill the matrices of rows of nodes, uncoupled from each other.

    Parameters
    ----------
    start, column, entry : ndarray
        Compressed rows of the operator; slopes by pressure (real) and film (imaginary).
    free : ndarray of bool, shape (ny, nx)
        Other nodes get the identity.
    local : ndarray, shape (nx, nx)
        Deflection at the nodes of a row per unit pressure on its cells.
    across : ndarray, shape (5,)
        Share of it that neighbours 0 to 4 rows away see.
    first : int
        Index of the first node of every row that the matrices hold.
    which : ndarray of int, shape (m,)
        Numbers of the rows to fill.
    matrices : ndarray, shape (m, n, n)
        Result, of n nodes from `first` on; zero on entry.
    """
    nx = free.shape[1]
    n = matrices.shape[1]
    for place in range(which.size):
        j = which[place]
        for i in range(first, first + n):
            row = j * nx + i
            if not free[j, i]:
                matrices[place, i - first, i - first] = 1.0
                continue
            for k in range(start[row], start[row + 1]):
                jj = column[k] // nx
                ii = column[k] - jj * nx
                if jj == j and free[jj, ii]:
                    matrices[place, i - first, ii - first] += entry[k].real
                slope = entry[k].imag * across[min(abs(jj - j), 4)]
                if slope != 0.0:
                    for m in range(n):
                        matrices[place, i - first, m] += slope * local[ii, first + m]
            for m in range(n):
                if not free[j, first + m]:
                    matrices[place, i - first, m] = 0.0


@kernel
def subtract_rows(
    start: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
    pressure: np.ndarray,
    film: np.ndarray,
    right: np.ndarray,
    rest: np.ndarray,
) -> None:
    """Write right - Re(entry) pressure - Im(entry) film of all rows.

    All arrays are one-dimensional but film, shape (ny, nx), of any strides.
    """
    nx = film.shape[1]
    for row in range(rest.size):
        total = right[row]
        for k in range(start[row], start[row + 1]):
            node = column[k]
            j = node // nx
            total -= entry[k].real * pressure[node] + entry[k].imag * film[j, node - j * nx]
        rest[row] = total


@kernel
def multiply_matrices(
    transposed: np.ndarray, vectors: np.ndarray, scale: float, products: np.ndarray
) -> None:
    """Write scale times matrix by vector of every row; matrices (ny, nx, nx) are transposed."""
    ny, nx = vectors.shape
    total = np.empty(nx, dtype=np.float32)
    for j in range(ny):
        total[:] = 0.0
        for k in range(nx):
            v = np.float32(vectors[j, k])
            if v != 0.0:
                part = transposed[j, k]
                for i in range(nx):
                    total[i] += v * part[i]
        for i in range(nx):
            products[j, i] = scale * total[i]


class RowInverses:
    """Inverse of every row of one linearisation; float32 is enough for a preconditioner.

    Rows whose derivatives have hardly changed keep their inverse when others are inverted again.
    """

    def __init__(self, grid: PointGrid) -> None:
        self._local = wave_deflection(grid, _WAVE / grid.dy)
        self._held = slice(0, 0)
        self._free = np.zeros(grid.shape, dtype=np.bool_)
        self._centre = np.zeros(grid.shape, dtype=np.complex128)
        self._transposed = np.empty((grid.shape[0], 0, 0), dtype=np.float32)
        self._products = np.empty((grid.shape[0], 0))
        # nodes that came to rows whose inverse serves on are solved on their own
        self._new = np.zeros(grid.shape, dtype=np.bool_)
        self._alone = np.zeros(0)

    def renew(self, operator: SparseOperator) -> int:
        """Invert the rows that have changed; return their number."""
        columns = np.flatnonzero(operator.free.any(axis=0))
        first, last = (int(columns[0]), int(columns[-1]) + 1) if columns.size else (0, 1)
        centre = operator.matrix.diagonal().reshape(operator.free.shape)
        if first < self._held.start or last > self._held.stop or self._held.stop == 0:
            # columns without any free node drop out: much of the inlet and of the outlet
            first, last = max(first - _SPARE, 0), min(last + _SPARE, centre.shape[1])
            self._held = slice(first, last)
            count = last - first
            self._transposed = np.empty((centre.shape[0], count, count), dtype=np.float32)
            self._products = np.empty((centre.shape[0], count))
            rows = np.arange(centre.shape[0])
        else:
            rows = np.flatnonzero(self._changes(centre, operator.free) > _CHANGE)
        for part in np.array_split(rows, max(1, rows.size // _AT_ONCE)):
            matrices = np.zeros((part.size, *self._transposed.shape[1:]), dtype=np.float32)
            fill_row_matrices(
                operator.matrix.indptr,
                operator.matrix.indices,
                operator.matrix.data,
                operator.free,
                self._local.astype(np.float32),
                np.cos(_WAVE * np.arange(5.0)).astype(np.float32),
                self._held.start,
                part,
                matrices,
            )
            self._transposed[part] = np.linalg.inv(matrices).transpose(0, 2, 1)
        self._free[rows] = operator.free[rows]
        self._centre[rows] = centre[rows]
        self._new = operator.free & ~self._free
        slopes = centre.real + self._local.diagonal() * centre.imag
        self._alone = _DAMPING / slopes[self._new]
        return int(rows.size)

    def _changes(self, centre: np.ndarray, free: Flags) -> Array:
        # mean relative change of the derivatives of a row; nodes that come or go count as one
        weight = self._local.diagonal()
        old = self._centre
        change = np.abs(centre.real - old.real) + weight * np.abs(centre.imag - old.imag)
        size = np.abs(centre.real) + np.abs(old.real)
        size += weight * (np.abs(centre.imag) + np.abs(old.imag))
        share = np.divide(2.0 * change, size, out=np.zeros_like(size), where=size > 0.0)
        share[free != self._free] = 1.0
        return np.asarray(share.sum(axis=1) / np.maximum(free.sum(axis=1), 1))

    def __call__(self, residual: Array) -> Array:
        """Return a pressure that removes the short waves of a residual, shape (ny, nx)."""
        right = np.where(self._free, residual, 0.0)[:, self._held]
        multiply_matrices(self._transposed, right, _DAMPING, self._products)
        pressure = np.zeros(residual.shape)
        pressure[:, self._held] = self._products
        pressure[self._new] = residual[self._new] * self._alone
        return pressure


@dataclass(frozen=True, slots=True)
class _Halved:
    """Operator in single precision; memory traffic is what it costs."""

    start: np.ndarray
    column: np.ndarray
    entry: np.ndarray
    free: Flags
    by_approach: Array

    @classmethod
    def of(cls, operator: SparseOperator) -> _Halved:
        matrix = operator.matrix
        entry = matrix.data.astype(np.complex64)
        return cls(matrix.indptr, matrix.indices, entry, operator.free, operator.by_approach)


class RowCycle:
    """From coarse to fine as an approximate inverse; pressure and approach are found together.

    A grid's rows are solved once, after the coarser grids: solving them before as well costs as
    much again and saves no iteration. The deflection under what comes from coarser grids is that
    of the next coarser grid, between its nodes. All but the coarsest grid is in single precision.
    `before` is a cycle of the same grids whose rows serve again where little has changed; it
    cannot be used any more.
    """

    def __init__(
        self, grids: Hierarchy, linear: Linearisation, before: RowCycle | None = None
    ) -> None:
        self._levels, self._transfers = grids.levels, grids.transfers
        if before is None:
            self._rows = [RowInverses(level.grid) for level in self._levels[1:]]
            self._deflections = [WindowedDeflection(level.grid) for level in self._levels[:-1]]
        else:
            self._rows, self._deflections = before._rows, before._deflections
        operator = sparse_operator(linear)
        self._operators = [_Halved.of(operator)]
        for k in range(len(self._levels) - 1, 0, -1):
            self._rows[k - 1].renew(operator)
            operator = coarse_operator(operator, self._transfers[k - 1])
            self._deflections[k - 1].follow(operator.free)
            self._operators.insert(0, _Halved.of(operator))
        self._direct = CoarseSolution(self._levels[0].grid, operator, self._levels[0].load)

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach that cancel most of a residual."""
        return self._cycle(len(self._levels) - 1, residual, load_residual)

    def _rest(
        self, k: int, residual: Array, pressure: Array, film: Array, approach: float
    ) -> Array:
        operator = self._operators[k]
        rest = np.empty(residual.shape)
        subtract_rows(
            operator.start,
            operator.column,
            operator.entry,
            np.ascontiguousarray(pressure).ravel(),
            film,
            np.ascontiguousarray(residual).ravel(),
            rest.ravel(),
        )
        if approach != 0.0:
            rest -= approach * operator.by_approach
        return rest

    def _cycle(self, k: int, residual: Array, load_residual: float) -> tuple[Array, float]:
        if k == 0:
            pressure, approach = self._direct(residual, load_residual)
            return pressure.astype(np.float64), approach
        free, transfer = self._operators[k].free, self._transfers[k - 1]
        coarse, approach = self._cycle(k - 1, transfer.down(residual), load_residual)
        pressure = transfer.up(coarse)
        pressure[~free] = 0.0
        film = transfer.up(self._deflections[k - 1](coarse))
        after = self._rows[k - 1](self._rest(k, residual, pressure, film, approach))
        after[~free] = 0.0
        return pressure + after, approach
