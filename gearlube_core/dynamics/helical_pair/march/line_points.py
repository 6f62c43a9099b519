"""Load, speeds, film and friction at the points of the contact lines: kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import (
    FLANK_POINTS,
    POINTS_PER_LINE,
    FlankConstants,
    FlankView,
    MarchConstants,
    PairMotion,
    coast_near,
    coast_view,
    drive_view,
    touches,
)
from gearlube_core.dynamics.helical_pair.march.kept_films import (
    LEAST_SPEED,
    N_FILMS,
    NODES_KEPT,
    NUDGES,
    Bin,
    NodeFilm,
    begin_bin,
    bin_of,
    film_in,
    is_kept,
    keep_film,
    middle_of,
    place_of,
)
from gearlube_core.dynamics.helical_pair.march.line_moments import cell_ends
from gearlube_core.dynamics.helical_pair.march.line_sums import GAUSS, pair_slot
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    FILM_AT,
    KEPT_AT,
    LEAST_OFFSET,
    STATIONS_AT,
    density_at,
)
from gearlube_core.film.line_film import line_film_thickness
from gearlube_core.film_model import net
from gearlube_core.film_model.inlet import model_inlet
from gearlube_core.film_model.solved_film import SolvedFilm
from gearlube_core.friction.flank_laws import SOLVED
from gearlube_core.friction.line_points import LINE_LOAD_FLOOR, LineState, line_friction
from gearlube_core.friction.mixed_friction import SPEED_FLOOR
from gearlube_core.friction.solved_line import BoundedLine, line_film, line_with_film
from gearlube_core.helical_geometry.contact_line import (
    ContactPlane,
    LineKinematics,
    clip_line,
    line_kinematics,
    pitch_crossing,
)
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.places import place_below
from gearlube_core.oil.lubricant_state import LubricantState, lubricant_state

# place of MarchConstants.refreshes in the pair data
REFRESHES_AT = count_floats(FlankConstants) + MarchConstants._fields.index("refreshes") - 1
_TINY = 1e-300  # coefficient of friction in pure rolling


class LinePoint(NamedTuple):
    """A point of a contact line; all floats."""

    x: float  # [m]
    z: float  # [m]
    at_line: float  # share of the line before it [-]
    length: float  # of line that it stands for; 0: there is none, and the others mean nothing [m]


@kernel
def line_place(part: float, line: int, place: int, plane: ContactPlane) -> LinePoint:
    """Return point `place` of a line at the part of a mesh period that has passed, 0 to 1.

    `place` counts the two Gauss points before the pitch line, then the two after it.
    """
    X = plane.A + (part + line) * plane.pitch
    segment = clip_line(X, plane)
    crossing = pitch_crossing(X, segment, plane)
    z_start = segment.z_low if place < 2 else crossing
    z_end = crossing if place < 2 else segment.z_high
    length = max(z_end - z_start, 0.0) * 0.5 / plane.cos_b
    if length == 0.0:
        return LinePoint(0.0, 0.0, 0.0, 0.0)
    share = GAUSS if place % 2 == 0 else 1.0 - GAUSS
    z = z_start + share * (z_end - z_start)
    x = X - (0.5 * plane.W - z) * plane.sin_b / plane.cos_b
    at_line = (z - segment.z_low) / (segment.z_high - segment.z_low)
    return LinePoint(x, z, at_line, length)


@kernel
def point_load(
    g: float, at_line: float, phase: float, line: int, data: Array, p: FlankConstants
) -> float:
    """Return w [N/m] at a fraction of a line where the compression is `g` [m]."""
    n_s = int(p.stations)
    n_phase = int(p.phases)
    lines = int(p.lines)
    to_offset = n_phase * lines * n_s
    at_density = density_at(n_s, to_offset)
    at_phase = (phase - np.floor(phase)) * n_phase
    row = place_below(at_phase, n_phase)
    part = at_phase - row
    here = at_density + (row * lines + line) * n_s
    after = here + lines * n_s
    if row == n_phase - 1:
        after = at_density + (line + 1) * n_s if line + 1 < lines else here
    c = 0
    while c < n_s - 2 and at_line > data[STATIONS_AT + c + 1]:
        c += 1
    t = (at_line - data[STATIONS_AT + c]) / (data[STATIONS_AT + c + 1] - data[STATIONS_AT + c])
    cell = cell_ends(here + c, after + c, to_offset, part, data)
    k = cell.k_a + t * (cell.k_b - cell.k_a)
    e = cell.e_a + t * (cell.e_b - cell.e_a)
    return max(k * (g - e), 0.0)


@kernel
def film_node(phase: float, coast: bool, p: MarchConstants) -> tuple[int, float]:
    """Return the node before a flank's phase, -1 for none, and the flank's part of a period there.

    Nodes are the phases of the drive flanks at which friction is computed again.
    """
    refreshes, start = p.refreshes, p.flanks.coast_phase
    if refreshes > NODES_KEPT:
        return -1, 0.0
    number = np.floor((start - phase if coast else phase) * refreshes)
    node = number - refreshes * np.floor(number / refreshes)
    there = number / refreshes
    if np.floor(start - there if coast else there) != np.floor(phase):
        return -1, 0.0  # other lines than now
    part = start - node / refreshes if coast else node / refreshes
    return place_below(node, NODES_KEPT), part - np.floor(part)


@kernel
def bin_film(x: float, box: Bin, n: int, data: Array, p: MarchConstants) -> NodeFilm:
    """Return film `n` of a bin by the film model, at x of the plane of contact; see `keep_film`."""
    load, speed, temperature = middle_of(box)
    slipping = 1.0
    if n == 1:
        load *= math.exp(NUDGES[0])
    elif n == 2:
        speed *= math.exp(NUDGES[1])
    elif n == 3:
        temperature += NUDGES[2]
    elif n == 4:
        slipping = math.exp(NUDGES[3])
    oil = lubricant_state(p.oil, temperature)
    motion = line_kinematics(x, speed, p.flanks.plane)
    inlet = model_inlet(oil, p.solid, p.limiting_slope)
    R, u, slip = motion.R, motion.entrainment, motion.sliding * slipping
    film = line_film(data[FILM_AT:KEPT_AT], load, R, u, slip, p.solid, inlet)
    first = line_film_thickness(R, oil.eta0, oil.alpha, u, load, 2.0 * p.solid.contact_modulus)
    border = film.outside
    if 0.0 < border < 1.0:  # the inverse of `smooth_step`
        border = 0.5 - math.sin((0.5 * math.pi - math.acos(1.0 - 2.0 * border)) / 3.0)
    return NodeFilm(
        math.log(film.central_film / first),
        math.log(max(film.friction_coefficient, _TINY)),
        border,
    )


@kernel
def point_film(
    phase: float,
    coast: bool,
    line: int,
    place: int,
    load: float,
    pinion_speed: float,
    motion: LineKinematics,
    data: Array,
    lubricant: LubricantState,
    p: MarchConstants,
) -> SolvedFilm:
    """Return the solved film at a point of a line: by what is kept of its node, or itself.

    Notes
    -----
    From the node on, up to one refresh before, the film follows the formula of Dowson and Toyoda,
    and friction a power of sliding.
    """
    numbers = data[FILM_AT:KEPT_AT]
    w = max(load, LINE_LOAD_FLOOR)
    node, part = film_node(phase, coast, p)
    R, u = motion.R, max(abs(motion.entrainment), SPEED_FLOOR)
    if node >= 0 and pinion_speed >= LEAST_SPEED:
        kept = data[KEPT_AT:LEAST_OFFSET]
        box = bin_of(w, pinion_speed, lubricant.temperature)
        at = place_of(coast, node, line, place, box)
        there = is_kept(kept, at, box)
        if not there:
            plane = p.flanks.plane
            point = line_place(part, line, place, plane)
            if point.length > 0.0:
                there = True
                begin_bin(kept, at, box, line_kinematics(point.x, 1.0, plane).sliding)
                for n in range(N_FILMS):
                    keep_film(kept, at, n, bin_film(point.x, box, n, data, p))
        if there:
            film = film_in(kept, at, box, motion.sliding / pinion_speed)
            modulus = 2.0 * p.solid.contact_modulus
            first = line_film_thickness(R, lubricant.eta0, lubricant.alpha, u, w, modulus)
            return SolvedFilm(
                first * math.exp(film.log_film),
                math.exp(film.log_friction),
                net.smooth_step(film.border),
                numbers[net.BOUNDS],
                numbers[net.BOUNDS + 1],
            )
    inlet = model_inlet(lubricant, p.solid, p.limiting_slope)
    return line_film(numbers, w, R, u, motion.sliding, p.solid, inlet)


@kernel
def line_point(
    view: FlankView,
    coast: bool,
    line: int,
    place: int,
    pinion_speed: float,
    data: Array,
    lubricant: LubricantState,
    p: MarchConstants,
) -> tuple[float, float, LineKinematics, BoundedLine]:
    """Return load [N/m], length [m], speeds and film with bounds at point `place` of a line.

    The point is that of `line_place`; `coast` says which flanks `view` is of. The length is zero
    where there is no line.
    """
    flanks = p.flanks
    plane = flanks.plane
    point = line_place(view.phase - np.floor(view.phase), line, place, plane)
    if point.length == 0.0:
        still = LineKinematics(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        none = LineState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        return 0.0, 0.0, still, BoundedLine(none, 0.0, 0.0, 0.0)
    g = view.a + view.tilt * (point.z * plane.cos_b + point.x * plane.sin_b)
    load = point_load(g, point.at_line, view.phase, line, data, flanks)
    motion = line_kinematics(point.x, pinion_speed, plane)
    R, u, slip = motion.R, motion.entrainment, motion.sliding
    if p.film == SOLVED:
        film = point_film(
            view.phase, coast, line, place, load, pinion_speed, motion, data, lubricant, p
        )
        bounded = line_with_film(film, load, R, u, slip, lubricant, p.surface, p.solid)
        return load, point.length, motion, bounded
    state = line_friction(load, R, u, slip, lubricant, p.surface, p.solid)
    return load, point.length, motion, BoundedLine(state, 0.0, 0.0, 0.0)


@kernel
def refresh_flank(
    view: FlankView,
    coast: bool,
    pinion_speed: float,
    mu: Array,
    data: Array,
    lubricant: LubricantState,
    p: MarchConstants,
) -> None:
    """Compute the friction coefficients of one flank again, `mu` of shape (FLANK_POINTS,)."""
    lines = int(p.flanks.lines)
    for line in range(lines):
        slot = POINTS_PER_LINE * pair_slot(view.phase, line, lines)
        for place in range(POINTS_PER_LINE):
            _, _, _, film = line_point(view, coast, line, place, pinion_speed, data, lubricant, p)
            mu[slot + place] = film.state.friction_coefficient


@kernel
def refresh_friction(m: PairMotion, kept: Array, data: Array, lubricant: LubricantState) -> bool:
    """Renew the friction coefficients that a state keeps if they are due; return whether.

    They are due so many times in a mesh period, and when a flank comes into contact or leaves it.

    Parameters
    ----------
    m : PairMotion
    kept : ndarray of shape (N_FRICTION,)
        The state from REFRESHED on.
    data : ndarray
        Pair data, see `mesh_data`.
    lubricant : LubricantState
    """
    flanks: FlankConstants = tuple_from_array(data, FlankConstants)
    drive = drive_view(m, flanks)
    on_drive = touches(drive, data[LEAST_OFFSET], flanks)
    on_coast = coast_near(m, data[LEAST_OFFSET], flanks)
    mark = 4.0 * np.floor(drive.phase * data[REFRESHES_AT])
    if on_drive:
        mark += 1.0
    if on_coast:
        mark += 2.0
    if mark == kept[0]:
        return False
    kept[0] = mark
    p: MarchConstants = tuple_from_array(data, MarchConstants)
    speed = abs(m.w_p)
    if on_drive:
        refresh_flank(drive, False, speed, part(kept, 1, FLANK_POINTS), data, lubricant, p)
    if on_coast:
        mu = part(kept, 1 + FLANK_POINTS, FLANK_POINTS)
        refresh_flank(coast_view(m, flanks), True, speed, mu, data, lubricant, p)
    return True
