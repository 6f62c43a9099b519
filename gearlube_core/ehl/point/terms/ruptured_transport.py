"""Oil that a change of pressure moves to ruptured nodes, and the residual that it causes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from gearlube_core.arrays import Array, Flags, Offsets
from gearlube_core.ehl.point.equations.rupture_transport import carried_entries, carry_downstream


class NoTransport:
    """No node is ruptured."""

    def carry(self, change: Array) -> None:
        """Leave rows times a change as they are."""

    def added_to(
        self,
        matrix: csr_matrix,
        offsets: Offsets,
        by_pressure: Array,
        by_film: Array,
        free: Flags,
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
        self,
        matrix: csr_matrix,
        offsets: Offsets,
        by_pressure: Array,
        by_film: Array,
        free: Flags,
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
