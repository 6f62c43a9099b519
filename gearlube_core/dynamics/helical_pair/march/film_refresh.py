"""Friction of the film at the points of the contact lines: kernels."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.constants import MarchConstants, MotionConstants
from gearlube_core.dynamics.helical_pair.march.flank_views import (
    FlankView,
    coast_near,
    coast_view,
    drive_view,
    touches,
)
from gearlube_core.dynamics.helical_pair.march.line_points import line_point
from gearlube_core.dynamics.helical_pair.march.line_sums import pair_slot
from gearlube_core.dynamics.helical_pair.march.mesh_data import LEAST_OFFSET
from gearlube_core.dynamics.helical_pair.march.state import (
    FLANK_POINTS,
    MU,
    POINTS_PER_LINE,
    REFRESHED,
    W_P,
)
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

# place of MarchConstants.refreshes in the pair data
REFRESHES_AT = count_floats(MotionConstants) + MarchConstants._fields.index("refreshes") - 1


@kernel
def refresh_flank(
    view: FlankView,
    at: int,
    s: Array,
    data: Array,
    lubricant: LubricantState,
    p: MarchConstants,
) -> None:
    """Compute the friction coefficients of one flank anew; they start at `s[at]`."""
    lines = int(p.motion.flanks.lines)
    for line in range(lines):
        slot = at + POINTS_PER_LINE * pair_slot(view.phase, line, lines)
        for place in range(POINTS_PER_LINE):
            _, _, _, film = line_point(view, at != MU, line, place, abs(s[W_P]), data, lubricant, p)
            s[slot + place] = film.state.friction_coefficient


@kernel
def refresh_friction(s: Array, data: Array, lubricant: LubricantState) -> bool:
    """Compute the friction coefficients in the state anew if they are due; return whether.

    They are due so many times in a mesh period, and when a flank comes into contact or leaves it.
    `data` are the pair data, see `mesh_data`.
    """
    motion: MotionConstants = tuple_from_array(data, MotionConstants)
    flanks = motion.flanks
    drive = drive_view(s, flanks)
    mark = 4.0 * np.floor(drive.phase * data[REFRESHES_AT])
    if touches(drive, data[LEAST_OFFSET], flanks):
        mark += 1.0
    if coast_near(s, data[LEAST_OFFSET], flanks):
        mark += 2.0
    if mark == s[REFRESHED]:
        return False
    s[REFRESHED] = mark
    p: MarchConstants = tuple_from_array(data, MarchConstants)
    if touches(drive, data[LEAST_OFFSET], flanks):
        refresh_flank(drive, MU, s, data, lubricant, p)
    if coast_near(s, data[LEAST_OFFSET], flanks):
        refresh_flank(coast_view(s, flanks), MU + FLANK_POINTS, s, data, lubricant, p)
    return True
