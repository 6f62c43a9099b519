"""Derivatives of the film equations on one grid at a state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_matrix

from gearlube_core.arrays import Array, Flags, Offsets
from gearlube_core.ehl.point.equations.reynolds import apply_to_rows
from gearlube_core.ehl.point.equations.stencil import CENTRE
from gearlube_core.ehl.point.settings import AMBIENT, Sides
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.row_workers import ALONE, RowWorkers

# steps to the neighbours, derivatives by their pressure and by their film, (n, ny, nx)
Derivatives = tuple[Offsets, Array, Array]


@kernel
def carry_downstream(
    to_x: np.ndarray, to_y: np.ndarray, ruptured: np.ndarray, change: np.ndarray
) -> None:
    """Carry what gathers in ruptured nodes downstream to the next nodes with pressure.

    Parameters
    ----------
    to_x, to_y : ndarray, shape (ny, nx)
        Share of what gathers in a ruptured node that its neighbour downstream gets, along x and y.
    ruptured : ndarray of bool, shape (ny, nx)
    change : ndarray, shape (ny, nx)
        Rows times a change; ruptured nodes become zero.
    """
    ny, nx = change.shape
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if ruptured[j, i]:
                change[j, i + 1] += to_x[j, i] * change[j, i]
                change[j + 1, i] += to_y[j, i] * change[j, i]
                change[j, i] = 0.0


@kernel
def carried_entries(
    to_x: np.ndarray,
    to_y: np.ndarray,
    ruptured: np.ndarray,
    free: np.ndarray,
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    row: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
) -> int:
    """Write what `carry_downstream` brings to free nodes as entries of a matrix, count them.

    Parameters
    ----------
    to_x, to_y, ruptured : ndarray, shape (ny, nx)
        Of `carry_downstream`.
    free : ndarray of bool, shape (ny, nx)
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x, at least.
    by_pressure, by_film : ndarray, shape (m, ny, nx), m <= n
        Derivatives, those of ruptured nodes included.
    row, column, entry : ndarray
        Result, as far as it fits; entries are those by pressure, and by film as imaginary part.

    Returns
    -------
    int
        Of all of them.

    Notes
    -----
    Oil that pressure drives back or aside into ruptured nodes returns downstream: without it a
    preconditioner would see a given pressure at the edge of the oil where a given flow is. Oil is
    followed over 32 nodes along and 8 across the motion, down to a thousandth.
    """
    ny, nx = ruptured.shape
    count = 0
    share = np.zeros((9, 33))
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if not ruptured[j, i]:
                continue
            some = False
            for k in range(by_pressure.shape[0]):
                jj, ii = max(j + offsets[k, 0], 0), max(i + offsets[k, 1], 0)
                some |= by_pressure[k, j, i] != 0.0 and free[jj, ii]
            if not some:
                continue
            share[:] = 0.0
            share[0, 0] = 1.0
            for b in range(min(8, ny - 1 - j)):
                for a in range(min(32, nx - 1 - i)):
                    part = share[b, a]
                    if part < 1e-3:
                        continue
                    at_j, at_i = j + b, i + a
                    if ruptured[at_j, at_i]:
                        share[b, a + 1] += part * to_x[at_j, at_i]
                        share[b + 1, a] += part * to_y[at_j, at_i]
                        continue
                    if not free[at_j, at_i]:
                        continue
                    for k in range(by_pressure.shape[0]):
                        jj, ii = j + offsets[k, 0], i + offsets[k, 1]
                        p, h = by_pressure[k, j, i], by_film[k, j, i]
                        if jj < 0 or ii < 0 or (p == 0.0 and h == 0.0):
                            continue
                        if not free[jj, ii]:
                            p = 0.0
                        if count < entry.size:
                            row[count] = at_j * nx + at_i
                            column[count] = jj * nx + ii
                            entry[count] = complex(part * p, part * h)
                        count += 1
    return count


class NoTransport:
    """No node is ruptured."""

    def carry(self, change: Array) -> None:
        """Leave rows times a change as they are."""

    def added_to(
        self, matrix: csr_matrix, offsets: Offsets, by_pressure: Array, by_film: Array, free: Flags
    ) -> csr_matrix:
        """Return the matrix as it is."""
        return matrix


@dataclass(frozen=True, slots=True)
class RupturedTransport:
    """How changes of the oil in ruptured nodes reach full nodes; arrays of shape (ny, nx)."""

    to_x: Array  # share of a change that the next node along x gets [-]
    to_y: Array  # share that the next node along y gets [-]
    ruptured: Flags

    def carry(self, change: Array) -> None:
        """Carry rows times a change downstream, in place."""
        carry_downstream(self.to_x, self.to_y, self.ruptured, change)

    def added_to(
        self, matrix: csr_matrix, offsets: Offsets, by_pressure: Array, by_film: Array, free: Flags
    ) -> csr_matrix:
        """Return a matrix with what free nodes get through ruptured ones.

        Parameters
        ----------
        matrix : csr_matrix, shape (ny nx, ny nx)
            Derivatives by pressure (real) and by film (imaginary part).
        offsets : ndarray of int, shape (m, 2)
            Steps to the neighbours along y and x.
        by_pressure, by_film : ndarray, shape (n, ny, nx), n <= m
            Derivatives, those of ruptured nodes included [-].
        free : ndarray of bool, shape (ny, nx)
            Nodes with a pressure.
        """
        size = free.size
        count, room = 0, 40 * sum(free.shape)
        while True:
            row, column = np.empty((2, room), dtype=np.int32)
            entry = np.empty(room, dtype=np.complex128)
            count = carried_entries(
                self.to_x,
                self.to_y,
                self.ruptured,
                free,
                offsets,
                by_pressure,
                by_film,
                row,
                column,
                entry,
            )
            if count <= room:
                break
            room = count
        parts = entry[:count], (row[:count], column[:count])
        matrix = matrix + csr_matrix(parts, shape=(size, size))
        matrix.sort_indices()
        return matrix


Transport = NoTransport | RupturedTransport


@dataclass(slots=True)
class Linearisation:
    """Derivatives of the residual on one grid at a state, in units of `PointScales`."""

    offsets: Offsets  # (m, 2), m >= n, steps to the neighbours along y and x
    by_pressure: Array  # (n, ny, nx), of the neighbours
    by_film: Array  # (n, ny, nx), of the neighbours
    by_approach: Array  # (ny, nx)
    free: Flags  # where pressure is unknown, (ny, nx)
    right: Array  # what the derivatives times the changes have to be, (ny, nx)
    result: Array = field(repr=False)  # of `apply`, (ny, nx)
    load_by_approach: float = 0.0  # change of the load that is carried over the load
    transport: Transport = field(default_factory=NoTransport)  # of oil through ruptured nodes
    centre: int = CENTRE  # number of the node itself among its neighbours
    sides: Sides = AMBIENT  # of the rows
    workers: RowWorkers = ALONE  # who share them
    touching: Flags | None = None  # where solids carry pressure; None: nowhere

    @property
    def neighbours(self) -> Offsets:
        """Return the steps to the neighbours that have derivatives, (n, 2)."""
        return self.offsets[: self.by_film.shape[0]]

    def sum_by_approach(self) -> None:
        """Set the derivatives by the approach: all nodes of a film rise together."""
        np.sum(self.by_film, axis=0, out=self.by_approach)
        self.transport.carry(self.by_approach)

    def apply(
        self, pressure: Array, approach: float, deflection: Callable[[Array], Array]
    ) -> Array:
        """Return the change of the residual under changes of pressure and approach, (ny, nx).

        The result is overwritten by the next call.
        """
        ny, nx = self.free.shape
        given = self.offsets, self.by_pressure, self.by_film, self.sides.reach(ny)
        changes = self.sides.filled(pressure), deflection(pressure)
        self.workers.share(lambda part: apply_to_rows(*given, *changes, part, self.result), ny, nx)
        self.transport.carry(self.result)
        if approach != 0.0:
            self.result += approach * self.by_approach
        return self.result
