"""Band matrices of all rows of nodes, factored and solved side by side without exchange of rows.

Every instruction takes several rows of nodes. LAPACK goes along one row after the other, and
exchanges equations, which linearised films hardly ever need: their own node weighs most.
"""

from __future__ import annotations

import numpy as np

from gearlube_core.kernels.jit import row_kernel

BELOW = 4  # nodes to each side that a node of a row depends on
LARGEST_SHARE = 10.0  # of an equation that is taken off another; 1 where none had to be exchanged
_TOGETHER = 16  # rows of nodes: a line of the cache


@row_kernel
def fill_side_by_side(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    film_offsets: np.ndarray,
    by_film: np.ndarray,
    free: np.ndarray,
    local: np.ndarray,
    across: np.ndarray,
    rows: tuple[int, int],
    band: np.ndarray,
) -> None:
    """Fill the bands of rows of nodes, uncoupled from each other.

    Parameters
    ----------
    offsets, by_pressure, film_offsets, by_film
        Of a `SingleStencil`.
    free, local, across, rows
        As in `fill_rows`.
    band : ndarray, shape (nx, 9, ny)
        Result: by node, place of the other node from -4 to 4, and row; zero on entry.
    """
    nx, reach = free.shape[1], BELOW - 2
    for begin in range(rows[0], rows[1], _TOGETHER):
        end = min(begin + _TOGETHER, rows[1])
        for i in range(nx):
            for k in range(offsets.shape[0]):
                ii = i + offsets[k, 1]
                if offsets[k, 0] == 0 and 0 <= ii < nx:
                    for j in range(begin, end):
                        if free[j, ii]:
                            band[i, BELOW + ii - i, j] += by_pressure[k, j, i]
            for k in range(film_offsets.shape[0]):
                ii = i + film_offsets[k, 1]
                if not 0 <= ii < nx:
                    continue
                share = across[min(abs(film_offsets[k, 0]), 4)]
                for m in range(max(ii - reach, 0), min(ii + reach + 1, nx)):
                    deflection = share * local[ii, m]
                    for j in range(begin, end):
                        if free[j, m]:
                            band[i, BELOW + m - i, j] += by_film[k, j, i] * deflection
            for j in range(begin, end):
                if not free[j, i]:
                    band[i, :, j] = 0.0
                    band[i, BELOW, j] = 1.0


@row_kernel
def factor_side_by_side(rows: tuple[int, int], band: np.ndarray, largest: np.ndarray) -> None:
    """Factor the bands of rows of nodes in place; the reciprocal of the diagonal stands in it.

    Parameters
    ----------
    rows
        First row of nodes and the one behind the last.
    band : ndarray, shape (nx, 9, ny)
        Of `fill_side_by_side`; L and U on return.
    largest : ndarray, shape (ny,)
        Result: largest share of an equation that was taken off another, for every row of nodes.
    """
    nx = band.shape[0]
    most = largest[rows[0] : rows[1]]
    most[:] = 0.0
    for i in range(nx):
        pivot = band[i, BELOW, rows[0] : rows[1]]
        for j in range(pivot.size):
            pivot[j] = np.float32(1.0) / pivot[j]
        for k in range(1, min(BELOW, nx - 1 - i) + 1):
            low = band[i + k, BELOW - k, rows[0] : rows[1]]
            for j in range(low.size):
                low[j] *= pivot[j]
            for j in range(low.size):
                # written so that what is no number counts as too large
                most[j] = most[j] if abs(low[j]) <= most[j] else abs(low[j])
            for m in range(1, min(BELOW, nx - 1 - i) + 1):
                rest = band[i + k, BELOW - k + m, rows[0] : rows[1]]
                above = band[i, BELOW + m, rows[0] : rows[1]]
                for j in range(rest.size):
                    rest[j] -= low[j] * above[j]


@row_kernel
def solve_side_by_side(rows: tuple[int, int], band: np.ndarray, values: np.ndarray) -> None:
    """Solve with the factors of `factor_side_by_side`, in place; values of shape (nx, ny)."""
    nx = band.shape[0]
    for i in range(nx):
        value = values[i, rows[0] : rows[1]]
        for k in range(1, min(BELOW, i) + 1):
            low, before = band[i, BELOW - k, rows[0] : rows[1]], values[i - k, rows[0] : rows[1]]
            for j in range(value.size):
                value[j] -= low[j] * before[j]
    for i in range(nx - 1, -1, -1):
        value = values[i, rows[0] : rows[1]]
        for k in range(1, min(BELOW, nx - 1 - i) + 1):
            above, behind = band[i, BELOW + k, rows[0] : rows[1]], values[i + k, rows[0] : rows[1]]
            for j in range(value.size):
                value[j] -= above[j] * behind[j]
        pivot = band[i, BELOW, rows[0] : rows[1]]
        for j in range(value.size):
            value[j] *= pivot[j]
