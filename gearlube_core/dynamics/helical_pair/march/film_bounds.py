"""Outputs on the error of solved films: bounds of each contact line, share outside the domain."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.constants import MarchConstants
from gearlube_core.dynamics.helical_pair.march.film_refresh import bounded_line_point
from gearlube_core.dynamics.helical_pair.march.flank_views import FlankView
from gearlube_core.dynamics.helical_pair.march.line_sums import pair_slot
from gearlube_core.dynamics.helical_pair.march.state import LINES_MAX, POINTS_PER_LINE, W_P
from gearlube_core.friction.flank_laws import SOLVED
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

BOUND_QUANTITIES = ("film_bound", "friction_bound")
LINE_BOUNDS = tuple(f"line[{i}].{q}" for i in range(1, LINES_MAX + 1) for q in BOUND_QUANTITIES)
_WIDTH = len(BOUND_QUANTITIES)


@kernel
def write_film_bounds(
    view: FlankView,
    s: Array,
    data: Array,
    lubricant: LubricantState,
    p: MarchConstants,
    first: int,
    out: Array,
) -> tuple[float, float]:
    """Write the bounds of every line; return share outside and bound of the friction power.

    Parameters
    ----------
    view
        Flank that is in contact.
    first
        Place of the first of `LINE_BOUNDS` in `out`.

    Others as in `write_lines`.

    Returns
    -------
    tuple of float
        Share of the load on the lines outside the domain of the film model; bound of the power
        lost in friction over that power, both at this instant [-]. Zeros with formulas.

    Notes
    -----
    Bounds of a line are means, that of the film weighted with the load, that of friction with the
    friction force. Lines without load have none. Errors of all points count as if they had one
    sign.
    """
    for i in range(_WIDTH * LINES_MAX):
        out[first + i] = 0.0
    if p.film != SOLVED:
        return 0.0, 0.0
    lines = int(p.motion.flanks.lines)
    load_sum = outside_sum = power_sum = doubt_sum = 0.0
    for line in range(lines):
        here = first + _WIDTH * pair_slot(view.phase, line, lines)
        total = film_sum = force_sum = friction_sum = 0.0
        for place in range(POINTS_PER_LINE):
            load, length, motion, bounded = bounded_line_point(
                view, line, place, abs(s[W_P]), data, lubricant, p
            )
            if load > 0.0 and length > 0.0:
                part = load * length
                force = bounded.state.friction_coefficient * part
                total += part
                film_sum += bounded.film_bound * part
                force_sum += force
                friction_sum += bounded.friction_bound * force
                outside_sum += bounded.outside * part
                power_sum += force * abs(motion.sliding)
                doubt_sum += bounded.friction_bound * force * abs(motion.sliding)
        load_sum += total
        if total > 0.0:
            out[here] = film_sum / total
        if force_sum > 0.0:
            out[here + 1] = friction_sum / force_sum
    return (
        outside_sum / load_sum if load_sum > 0.0 else 0.0,
        doubt_sum / power_sum if power_sum > 0.0 else 0.0,
    )
