"""Outputs of the single contact lines, and bounds of their films: names and kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.contact.hertz import LARGEST_OVER_MEAN
from gearlube_core.dynamics.helical_pair.march.flanks import (
    LINES_MAX,
    POINTS_PER_LINE,
    FlankView,
    MarchConstants,
)
from gearlube_core.dynamics.helical_pair.march.line_points import line_point
from gearlube_core.dynamics.helical_pair.march.line_sums import pair_slot
from gearlube_core.dynamics.ranges import LEAST_FILM_RATIO
from gearlube_core.film.groups import line_moes_groups
from gearlube_core.friction.evans_johnson_1986 import traction_map_number
from gearlube_core.friction.flank_laws import SOLVED
from gearlube_core.friction.mixed_friction import SPEED_FLOOR
from gearlube_core.friction.solved_line import BoundedLine
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Output
from gearlube_core.oil.formula_laws import mean_slope
from gearlube_core.oil.lubricant_state import LubricantState, eyring_stress_under

_BOUNDS = (
    Output("film_bound", "1", "bound of the film thickness, relative", 0.05),
    Output("friction_bound", "1", "bound of the friction, relative", 0.05),
)
BOUND_QUANTITIES = tuple(one.name for one in _BOUNDS)
LINE_BOUNDS = tuple(f"line[{i}].{q}" for i in range(1, LINES_MAX + 1) for q in BOUND_QUANTITIES)
N_BOUNDS = len(BOUND_QUANTITIES)
_QUANTITIES = (
    Output("load", "N", "normal load", 1e3, "kN"),
    Output("length", "m", "length", 1e-2, "mm"),
    Output("film_thickness_min", "m", "thinnest central film", 1e-6, "um"),
    Output("film_thickness_mean", "m", "mean central film", 1e-6, "um"),
    Output("film_ratio", "1", "least film over roughness"),
    Output("friction_coefficient", "1", "mean friction coefficient", 0.05),
    Output("sliding_speed", "m/s", "mean sliding speed"),
    Output("temperature", "K", "mean film temperature", 300.0, "degC"),
)
LINE_QUANTITIES = tuple(one.name for one in _QUANTITIES)
LINE_OUTPUTS = tuple(f"line[{i}].{q}" for i in range(1, LINES_MAX + 1) for q in LINE_QUANTITIES)
# both, with units and words
LINE_RECORDS = tuple(
    one._replace(name=f"line[{i}].{one.name}", text=f"{one.text}, contact line {i}")
    for quantities in (_QUANTITIES, _BOUNDS)
    for i in range(1, LINES_MAX + 1)
    for one in quantities
)

# places within the outputs of one contact line
LOAD = LINE_QUANTITIES.index("load")
LENGTH = LINE_QUANTITIES.index("length")
FILM_THICKNESS_MIN = LINE_QUANTITIES.index("film_thickness_min")
FILM_THICKNESS_MEAN = LINE_QUANTITIES.index("film_thickness_mean")
FILM_RATIO = LINE_QUANTITIES.index("film_ratio")
FRICTION_COEFFICIENT = LINE_QUANTITIES.index("friction_coefficient")
SLIDING_SPEED = LINE_QUANTITIES.index("sliding_speed")
TEMPERATURE = LINE_QUANTITIES.index("temperature")
N_LINE_QUANTITIES = len(LINE_QUANTITIES)


class BoundSums(NamedTuple):
    """Sums over points of contact lines; all floats."""

    load: float  # [N]
    outside: float  # load outside the domain of the film model [N]
    film: float  # load times bound of the film [N]
    force: float  # friction [N]
    error: float  # its bound [N]
    power: float  # lost in friction [W]
    power_error: float  # its bound [W]


@kernel
def with_point(sums: BoundSums, load: float, sliding: float, film: BoundedLine) -> BoundSums:
    """Return the sums with one more point.

    Parameters
    ----------
    sums
        Of the points before.
    load, sliding
        Load of the point [N] and sliding speed there [m/s].
    film
        Film and friction there.
    """
    force = film.state.friction_coefficient * load
    error, speed = film.coefficient_bound * load, abs(sliding)
    return BoundSums(
        sums.load + load,
        sums.outside + film.outside * load,
        sums.film + film.film_bound * load,
        sums.force + force,
        sums.error + error,
        sums.power + force * speed,
        sums.power_error + error * speed,
    )


@kernel
def with_line(total: BoundSums, line: BoundSums) -> BoundSums:
    """Return the sums of both."""
    return BoundSums(
        total.load + line.load,
        total.outside + line.outside,
        total.film + line.film,
        total.force + line.force,
        total.error + line.error,
        total.power + line.power,
        total.power_error + line.power_error,
    )


@kernel
def write_bounds(line: BoundSums, first: int, out: Array) -> None:
    """Write the bounds of a line, which begin at `first`.

    That of the film is a mean weighted with the load, that of friction one with the friction
    force. A line without load has none. Errors of all points count as if they had one sign.
    """
    out[first] = line.film / line.load if line.load > 0.0 else 0.0
    out[first + 1] = line.error / line.force if line.force > 0.0 else 0.0


class LinesFound(NamedTuple):
    """Thinnest film, and numbers of the most loaded point, each with a range; zeros without load.

    The most loaded point is that with the largest load per length.
    """

    thinnest_film: float  # [m]
    film_load: float  # M of Moes [-]
    film_material: float  # L of Moes [-]
    traction: float  # number of the traction map [-]
    temperature: float  # of the film [K]
    pressure: float  # largest Hertz pressure [Pa]
    outside: float  # share of the load outside the domain of the film model; 0 with formulas [-]
    loss_bound: float  # bound of the friction power at this instant over it; the same [-]


@kernel
def write_lines(
    view: FlankView,
    coast: bool,
    mu: Array,
    mu_at: int,
    pinion_speed: float,
    oil_temperature: float,
    data: Array,
    lubricant: LubricantState,
    p: MarchConstants,
    first: int,
    bounds: int,
    out: Array,
) -> LinesFound:
    """Write the quantities of every line of the flank in `view`; return what stands out of them.

    Their outputs begin at `first`, those of `LINE_BOUNDS` at `bounds`. Means are
    weighted with the load. A line without load has no film: zeros, and the temperature of the oil.
    From `mu_at` on `mu` has the flank's friction coefficients; `coast` says which flank it is.
    """
    lines = int(p.flanks.lines)
    for i in range(LINES_MAX):
        here = first + i * N_LINE_QUANTITIES
        for j in range(N_LINE_QUANTITIES):
            out[here + j] = 0.0
        out[here + TEMPERATURE] = oil_temperature
        for j in range(N_BOUNDS):
            out[bounds + i * N_BOUNDS + j] = 0.0
    thinnest = math.inf
    found = LinesFound(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    nothing = BoundSums(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    sums = nothing
    most = 0.0
    reduced_modulus = 2.0 * p.solid.contact_modulus
    for line in range(lines):
        slot = pair_slot(view.phase, line, lines)
        here = first + slot * N_LINE_QUANTITIES
        total = film_sum = mu_sum = slide_sum = rise_sum = length_sum = 0.0
        thin = math.inf
        of_line = nothing
        for place in range(POINTS_PER_LINE):
            load, length, motion, film = line_point(
                view, coast, line, place, abs(pinion_speed), data, lubricant, p
            )
            state = film.state
            length_sum += length
            if load > 0.0 and length > 0.0:
                part = load * length
                total += part
                film_sum += part * state.film_thickness
                mu_sum += part * mu[mu_at + POINTS_PER_LINE * slot + place]
                slide_sum += part * abs(motion.sliding)
                if p.friction_form > 0.0:
                    rise_sum += part * state.temperature_rise
                thin = min(thin, state.film_thickness)
                if p.film == SOLVED:
                    of_line = with_point(of_line, part, motion.sliding, film)
                if load > most:
                    most = load
                    M, L = line_moes_groups(
                        motion.R,
                        lubricant.eta0,
                        lubricant.alpha,
                        max(abs(motion.entrainment), SPEED_FLOOR),
                        load,
                        reduced_modulus,
                    )
                    traction = traction_map_number(
                        state.film_thickness,
                        state.mean_pressure,
                        lubricant.eta0,
                        mean_slope(lubricant.viscosity, lubricant, state.mean_pressure),
                        lubricant.beta,
                        eyring_stress_under(lubricant, state.mean_pressure),
                        lubricant.conductivity,
                    )
                    with_film = 1.0 if p.friction_form > 0.0 else 0.0
                    in_use = 1.0 if state.film_ratio > LEAST_FILM_RATIO else 0.0
                    found = LinesFound(
                        0.0,
                        in_use * M,
                        in_use * L,
                        in_use * with_film * traction,
                        oil_temperature + with_film * state.temperature_rise,
                        LARGEST_OVER_MEAN * state.mean_pressure,
                        0.0,
                        0.0,
                    )
        out[here + LENGTH] = length_sum
        if total > 0.0:
            out[here + LOAD] = total
            out[here + FILM_THICKNESS_MIN] = thin
            out[here + FILM_THICKNESS_MEAN] = film_sum / total
            out[here + FILM_RATIO] = thin / p.surface.sigma
            out[here + FRICTION_COEFFICIENT] = mu_sum / total
            out[here + SLIDING_SPEED] = slide_sum / total
            out[here + TEMPERATURE] = oil_temperature + rise_sum / total
            thinnest = min(thinnest, thin)
        if p.film == SOLVED:
            write_bounds(of_line, bounds + slot * N_BOUNDS, out)
            sums = with_line(sums, of_line)
    return LinesFound(
        thinnest if thinnest < math.inf else 0.0,
        found.film_load,
        found.film_material,
        found.traction,
        found.temperature,
        found.pressure,
        sums.outside / sums.load if sums.load > 0.0 else 0.0,
        sums.power_error / sums.power if sums.power > 0.0 else 0.0,
    )
