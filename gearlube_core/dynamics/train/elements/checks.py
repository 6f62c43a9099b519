"""Checks by several elements of constants that come from a file, see `Kernels.check`."""

from __future__ import annotations

from typing import Any

from gearlube_core.arrays import Array
from gearlube_core.bearings.followed_shaft import SOLVED_FILMS, TORQUE_LOSSES
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.film_model.net import N_ARRAY, UNITS, WIDTH
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.checked_numbers import all_finite, is_whole
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import N_SERIES, SHAFT_HEAD

MOST = 1e6  # of anything in a mesh table
_LAST_LAW = float(len(TORQUE_LOSSES) - 1)


@kernel
def fits_model(model: Array) -> bool:
    """Whether the numbers of a film model, empty without one, can be computed with."""
    if model.size == 0:
        return True
    return (
        model.size >= N_ARRAY
        and is_whole(model[UNITS], 1.0, float(WIDTH))
        and all_finite(model, 0, N_ARRAY)
    )


@kernel
def fits_rollers(bearings: Any, law: float, film: int) -> bool:
    """Whether bearings have rollers that can be counted, and a film model if their law needs it."""
    fits = is_whole(bearings.n_rollers, 3.0, float(ROLLERS_MAX)) and is_whole(law, 0.0, _LAST_LAW)
    return fits and (film == N_ARRAY if law == SOLVED_FILMS else film == 0)


@kernel
def fits_sizes(sizes: tuple[int, int, int, int]) -> bool:
    """Whether there is a mesh table with these levels, orders, nodes and numbers at one level."""
    levels, orders, nodes, series = sizes
    most = int(MOST)
    behind = series - N_SERIES * (2 * orders + 1)
    fits = 1 <= levels <= most and orders <= most and 1 <= nodes <= most
    return fits and 0 <= behind <= most and (behind == 0 or behind >= SHAFT_HEAD)


@kernel
def fits_table(
    memory: Array, table: int, end: int, at_film: int, sizes: tuple[int, int, int, int]
) -> bool:
    """Whether a mesh table of these sizes can be computed with, and the film model in the memory.

    The levels stand at `table`, the series behind them, of which each has a tail with as many
    numbers as it counts, see `shaft_error`. The film model stands at the end, from `at_film` on.
    """
    levels, orders, _, series = sizes
    least = N_SERIES * (2 * orders + 1)
    room = float(series - least - SHAFT_HEAD)
    fits = all_finite(memory, table, end)
    fits = fits and fits_model(part(memory, at_film, memory.size - at_film))
    for k in range(levels if series > least else 0):
        tail = table + levels + k * series + least
        p, q = memory[tail], memory[tail + 1]
        fits = fits and is_whole(p, 0.0, MOST) and is_whole(q, 0.0, MOST)
        fits = fits and 2.0 * (p + q) <= room
    return fits
