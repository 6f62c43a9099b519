"""Mixed friction at a point of a contact line with film and traction from solved films."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film_model.inlet import FilmInlet, model_inlet
from gearlube_core.film_model.line_contact import line_place
from gearlube_core.film_model.solved_film import SolvedFilm, solved_line_at
from gearlube_core.friction.evans_johnson_1986 import solid_resistance
from gearlube_core.friction.flank_data import CONSISTENT
from gearlube_core.friction.line_points import (
    LINE_LOAD_FLOOR,
    STILL_AREA_OVER_WIDTH_SQUARED,
    LineState,
    line_friction,
)
from gearlube_core.friction.mixed_friction import (
    SPEED_FLOOR,
    FormulaBounds,
    asperity_contact,
    boundary_friction,
    formula_error,
    friction_with_asperities,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import has_own_law
from gearlube_core.oil.lubricant_state import LubricantState

# How far off the formulas are where the model does not hold: of 95 % of the contacts solved there
# with at least 0.1 GPa, see docs/film_model/outside_line.py. Of the film, over that of the formula;
# and the most friction of the film, over that of an isothermal Eyring film of the formula's film.
LINE_FORMULA_FILM_BOUND = 0.65
LINE_FORMULA_FRICTION_TOP = 1.7


class BoundedLine(NamedTuple):
    """State of a point of a contact line and bounds of it; all floats."""

    state: LineState
    outside: float  # 0: film and friction are the film model's; 1: the formulas'; between: both [-]
    film_bound: float  # of the film thickness, relative [-]
    coefficient_bound: float  # of the friction coefficient, not relative [-]


@kernel
def line_film(
    film_model: Array,
    line_load: float,
    R: float,
    entrainment_speed: float,
    sliding_speed: float,
    solid: SolidParameters,
    inlet: FilmInlet,
) -> SolvedFilm:
    """Return film and friction at a point; arguments as in `solved_line_friction`."""
    place = line_place(R, solid.conductivity, solid.density * solid.heat_capacity)
    return solved_line_at(
        film_model,
        max(line_load, LINE_LOAD_FLOOR),
        max(abs(entrainment_speed), SPEED_FLOOR),
        abs(sliding_speed),
        place,
        inlet,
    )


@kernel
def line_with_film(
    film: SolvedFilm,
    line_load: float,
    R: float,
    entrainment_speed: float,
    sliding_speed: float,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
) -> BoundedLine:
    """Return friction and temperature at a point of a contact line whose film is known.

    f_v = mu (w - w_a),  f_b = tau_l0 A_a + gamma w_a, with h and mu of the solved film

    Parameters
    ----------
    film
        What a film model gives at this point.
    line_load, R, entrainment_speed, sliding_speed, lubricant, surface, solid
        As in `line_friction`.

    Returns
    -------
    BoundedLine
        Bounds of the film and of the sum of viscous and boundary friction over the load.

    Notes
    -----
    Towards the outside of the model's domain all goes over into `line_friction` with the weight
    `outside`. The bound of friction is that of the film's own friction, plus what asperities
    change where the film is thinner by its bound.
    """
    w = max(line_load, 0.0)
    w_film = max(w, LINE_LOAD_FLOOR)
    speed = max(abs(entrainment_speed), SPEED_FLOOR)
    slip = abs(sliding_speed)
    out, error = 1.0 if has_own_law(lubricant) else film.outside, 0.0
    formula = LineState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if out > 0.0:
        formula = line_friction(
            line_load, R, entrainment_speed, sliding_speed, lubricant, surface, solid
        )
        bounds = FormulaBounds(LINE_FORMULA_FILM_BOUND, LINE_FORMULA_FRICTION_TOP)
        error = out * formula_error(w, slip, formula, lubricant, surface, solid, CONSISTENT, bounds)
        if out >= 1.0:
            return BoundedLine(formula, 1.0, LINE_FORMULA_FILM_BOUND, error / w_film)
    own = 1.0 - out
    p = line_mean_pressure(w_film, R, solid.contact_modulus)
    h = film.central_film
    width = w_film / p
    modulus = 2.0 * solid.contact_modulus
    effusivity_squared = solid.conductivity * solid.density * solid.heat_capacity
    solved = friction_with_asperities(
        film.friction_coefficient,
        w,
        w_film,
        p,
        h,
        h / surface.sigma,
        slip,
        solid_resistance(R, p, speed, modulus, effusivity_squared),
        STILL_AREA_OVER_WIDTH_SQUARED * width * width,
        lubricant,
        surface,
        solid,
        CONSISTENT,
    )
    model_bound = film.film_bound
    thinner = h * (1.0 - model_bound) / surface.sigma
    W_a, A_a = asperity_contact(w, w / p, thinner, surface, solid, CONSISTENT)
    more = boundary_friction(W_a, A_a, slip, lubricant, surface) - solved.boundary_friction
    error += own * (film.friction_bound * solved.viscous_friction + max(more, 0.0))
    f_v = own * solved.viscous_friction + out * formula.viscous_friction
    f_b = own * solved.boundary_friction + out * formula.boundary_friction
    mu = own * solved.friction_coefficient + out * formula.friction_coefficient
    state = LineState(
        own * h + out * formula.film_thickness,
        own * solved.film_ratio + out * formula.film_ratio,
        f_v,
        f_b,
        mu,
        -mu if sliding_speed < 0.0 else mu,
        own * solved.temperature_rise + out * formula.temperature_rise,
        p,
    )
    return BoundedLine(
        state,
        out,
        own * model_bound + out * LINE_FORMULA_FILM_BOUND,
        error / w_film,
    )


@kernel
def solved_line_friction(
    line_load: float,
    R: float,
    entrainment_speed: float,
    sliding_speed: float,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    inlet: FilmInlet,
    film_model: Array,
) -> BoundedLine:
    """Return film, friction and temperature at a point of a contact line by a film model.

    Parameters
    ----------
    line_load, R, entrainment_speed, sliding_speed, lubricant, surface, solid
        As in `line_friction`.
    inlet
        Of `model_inlet` for this oil.
    film_model : ndarray, shape (N_ARRAY,)
        Numbers of a model of lines; their scratch is written into.

    Returns
    -------
    BoundedLine
        As of `line_with_film`.
    """
    film = line_film(film_model, line_load, R, entrainment_speed, sliding_speed, solid, inlet)
    return line_with_film(
        film, line_load, R, entrainment_speed, sliding_speed, lubricant, surface, solid
    )


@kernel
def bounded_line_friction(
    line_load: float,
    R: float,
    entrainment_speed: float,
    sliding_speed: float,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    film_model: Array,
) -> BoundedLine:
    """Return film, friction and temperature by a film model, or by the formulas if it is empty.

    Parameters
    ----------
    line_load, R, entrainment_speed, sliding_speed, lubricant, surface, solid
        As in `line_friction`.
    film_model : ndarray, shape (N_ARRAY,) or (0,)
        As in `solved_line_friction`.

    Returns
    -------
    BoundedLine
        As of `line_with_film`; without bounds where the formulas are asked for.
    """
    if film_model.size > 0:
        inlet = model_inlet(lubricant, solid, 0.0)
        return solved_line_friction(
            line_load,
            R,
            entrainment_speed,
            sliding_speed,
            lubricant,
            surface,
            solid,
            inlet,
            film_model,
        )
    state = line_friction(line_load, R, entrainment_speed, sliding_speed, lubricant, surface, solid)
    return BoundedLine(state, 0.0, 0.0, 0.0)
