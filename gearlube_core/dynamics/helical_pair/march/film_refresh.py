"""Friction of the film at the points of the contact lines: kernels."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.constants import MarchConstants, MotionConstants
from gearlube_core.dynamics.helical_pair.march.flank_views import (
    FlankConstants,
    FlankView,
    coast_near,
    coast_view,
    drive_view,
    touches,
)
from gearlube_core.dynamics.helical_pair.march.line_sums import GAUSS, pair_slot
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    FILM_AT,
    LEAST_OFFSET,
    STATIONS_AT,
)
from gearlube_core.dynamics.helical_pair.march.state import (
    FLANK_POINTS,
    MU,
    POINTS_PER_LINE,
    REFRESHED,
    W_P,
)
from gearlube_core.friction.flank_laws import SOLVED
from gearlube_core.friction.line_friction import LineState, line_friction
from gearlube_core.friction.solved_line import BoundedLine, line_inlet, solved_line_friction
from gearlube_core.helical_geometry.contact_line import clip_line, pitch_crossing
from gearlube_core.helical_geometry.line_kinematics import LineKinematics, line_kinematics
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

# place of MarchConstants.refreshes in the pair data
REFRESHES_AT = count_floats(MotionConstants) + MarchConstants._fields.index("refreshes") - 1


@kernel
def point_load(
    g: float,
    at_line: float,
    phase: float,
    line: int,
    data: Array,
    p: FlankConstants,
) -> float:
    """Return w [N/m] at a fraction of a line where the compression is `g` [m]."""
    n_s = int(p.stations)
    n_phase = int(p.phases)
    lines = int(p.lines)
    at_density = STATIONS_AT + n_s
    to_offset = n_phase * lines * n_s
    at_phase = (phase - math.floor(phase)) * n_phase
    row = min(int(at_phase), n_phase - 1)
    part = at_phase - row
    here = at_density + (row * lines + line) * n_s
    after = here + lines * n_s
    if row == n_phase - 1:
        after = at_density + (line + 1) * n_s if line + 1 < lines else here
    c = 0
    while c < n_s - 2 and at_line > data[STATIONS_AT + c + 1]:
        c += 1
    t = (at_line - data[STATIONS_AT + c]) / (data[STATIONS_AT + c + 1] - data[STATIONS_AT + c])
    k_here = data[here + c] + t * (data[here + c + 1] - data[here + c])
    k_after = data[after + c] + t * (data[after + c + 1] - data[after + c])
    here += to_offset
    after += to_offset
    e_here = data[here + c] + t * (data[here + c + 1] - data[here + c])
    e_after = data[after + c] + t * (data[after + c + 1] - data[after + c])
    k = k_here + part * (k_after - k_here)
    e = e_here + part * (e_after - e_here)
    return max(k * (g - e), 0.0)


@kernel
def bounded_line_point(
    view: FlankView,
    line: int,
    place: int,
    pinion_speed: float,
    data: Array,
    lubricant: LubricantState,
    p: MarchConstants,
) -> tuple[float, float, LineKinematics, BoundedLine]:
    """Return load [N/m], length [m], speeds and film with bounds at point `place` of a line.

    `place` counts the two Gauss points before the pitch line, then the two after it. The length
    is that of line the point stands for, zero where there is none.
    """
    plane = p.motion.flanks.plane
    X = plane.A + (view.phase - math.floor(view.phase) + line) * plane.pitch
    segment = clip_line(X, plane)
    crossing = pitch_crossing(X, segment, plane)
    z_start = segment.z_low if place < 2 else crossing
    z_end = crossing if place < 2 else segment.z_high
    share = GAUSS if place % 2 == 0 else 1.0 - GAUSS
    z = z_start + share * (z_end - z_start)
    x = X - (0.5 * plane.W - z) * plane.sin_b / plane.cos_b
    length = max(z_end - z_start, 0.0) * 0.5 / plane.cos_b
    if length == 0.0:
        still = LineKinematics(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        none = LineState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        return 0.0, 0.0, still, BoundedLine(none, 0.0, 0.0, 0.0)
    g = view.a + view.tilt * (z * plane.cos_b + x * plane.sin_b)
    at_line = (z - segment.z_low) / (segment.z_high - segment.z_low)
    load = point_load(g, at_line, view.phase, line, data, p.motion.flanks)
    motion = line_kinematics(x, pinion_speed, plane)
    if p.film == SOLVED:
        bounded = solved_line_friction(
            load,
            motion.R,
            motion.entrainment,
            motion.sliding,
            lubricant,
            p.surface,
            p.solid,
            line_inlet(lubricant, p.solid, p.limiting_slope),
            data[FILM_AT:LEAST_OFFSET],
        )
        return load, length, motion, bounded
    state = line_friction(
        load,
        motion.R,
        motion.entrainment,
        motion.sliding,
        lubricant,
        p.surface,
        p.solid,
    )
    return load, length, motion, BoundedLine(state, 0.0, 0.0, 0.0)


@kernel
def line_point(
    view: FlankView,
    line: int,
    place: int,
    pinion_speed: float,
    data: Array,
    lubricant: LubricantState,
    p: MarchConstants,
) -> tuple[float, float, LineKinematics, LineState]:
    """Return load [N/m], length [m], speeds and film, as `bounded_line_point`."""
    load, length, motion, bounded = bounded_line_point(
        view, line, place, pinion_speed, data, lubricant, p
    )
    return load, length, motion, bounded.state


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
            s[slot + place] = line_point(view, line, place, abs(s[W_P]), data, lubricant, p)[
                3
            ].friction_coefficient


@kernel
def refresh_friction(s: Array, data: Array, lubricant: LubricantState) -> bool:
    """Compute the friction coefficients in the state anew if they are due; return whether.

    They are due so many times in a mesh period, and when a flank comes into contact or leaves it.
    `data` are the pair data, see `mesh_data`.
    """
    motion: MotionConstants = tuple_from_array(data, MotionConstants)
    flanks = motion.flanks
    drive = drive_view(s, flanks)
    mark = 4.0 * math.floor(drive.phase * data[REFRESHES_AT])
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
