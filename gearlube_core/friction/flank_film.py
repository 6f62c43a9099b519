"""Film and friction of a flank contact by the film model."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film_model import net
from gearlube_core.film_model.groups import film_place
from gearlube_core.film_model.inlet import FilmInlet, model_inlet
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_film_at
from gearlube_core.friction.flank_data import ContactGeometry, FlankState
from gearlube_core.kernels.apart import apart
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array, tuple_to_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import has_own_law
from gearlube_core.oil.lubricant_state import LubricantState

# behind the numbers of the model: the oil that the numbers behind it belong to, these, and the oil
# that is asked for
_OIL = net.N_ARRAY
_OIL_FLOATS = len(LubricantState._fields) - 2  # without its laws
_INLET = _OIL + _OIL_FLOATS + 1
_GIVEN = _INLET + count_floats(FilmInlet)
N_FLANK_MODEL = _GIVEN + _OIL_FLOATS
_LEAST_FRICTION = 1e-12  # so that there is a logarithm without sliding


class FlankEllipse(NamedTuple):
    """Inputs of a film model besides `ContactGeometry`; all floats, SI."""

    R_x: float  # relative radius along the minor axis of the contact ellipse [m]
    R_y: float  # along its major axis [m]
    ellipticity: float  # major over minor semi-axis [-]
    psi: float  # entrainment from the minor axis, 0 to pi/2 [rad]
    delta: float  # sliding from entrainment, positive away from the minor axis, modulo pi [rad]


class ModelFilm(NamedTuple):
    """Results of a film model for a contact: floats that can be interpolated."""

    log_film: float  # ln of the central film in m
    log_friction: float  # ln of the friction coefficient of the film alone
    outside: float  # 0 within the model's domain, 1 where it says nothing [-]


class BoundedFlank(NamedTuple):
    """State of one flank contact and bounds of it; all floats."""

    state: FlankState
    outside: float  # 0: film and friction are the film model's; 1: the formulas'; between: both [-]
    film_bound: float  # of the film thickness, relative; 0 where no model gives it [-]
    friction_bound: float  # of the friction force, relative, likewise [-]


NO_MODEL_FILM = ModelFilm(0.0, 0.0, 1.0)


def flank_film_model(model: FilmModel) -> Array:
    """Return the numbers of a film model for one gear pair, shape (N_FLANK_MODEL,).

    Kernels write into them: two gear pairs must not share them.
    """
    return np.concatenate([model.copied_numbers(), np.full(N_FLANK_MODEL - _OIL, np.nan)])


@apart
def _keep_inlet(
    lubricant: LubricantState, solid: SolidParameters, limiting_slope: float, film_model: Array
) -> None:
    inlet = model_inlet(lubricant, solid, limiting_slope)
    tuple_to_array(inlet, film_model[_INLET:])
    oil = film_model[_OIL:_INLET]
    tuple_to_array(lubricant[:_OIL_FLOATS], oil)
    oil[_OIL_FLOATS] = limiting_slope


@kernel
def _inlet(
    lubricant: LubricantState, solid: SolidParameters, limiting_slope: float, film_model: Array
) -> FilmInlet:
    """Return oil and solids as the film model takes them; kept until the oil changes."""
    oil = film_model[_OIL:_INLET]
    # an array: an index of a tuple may lie beyond its end, and native code cannot raise
    given = film_model[_GIVEN:]
    tuple_to_array(lubricant[:_OIL_FLOATS], given)
    known = oil[_OIL_FLOATS] == limiting_slope
    for i in range(_OIL_FLOATS):
        known = known and oil[i] == given[i]
    if not known:
        _keep_inlet(lubricant, solid, limiting_slope, film_model)
    return tuple_from_array(film_model[_INLET:], FilmInlet)


@kernel
def flank_model_film(
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    ellipse: FlankEllipse,
    lubricant: LubricantState,
    solid: SolidParameters,
    limiting_slope: float,
    film_model: Array,
) -> ModelFilm:
    """Return film and friction of a flank contact by the film model.

    Parameters
    ----------
    load, entrainment_speed, sliding_speed, geometry, lubricant, solid
        As in `flank.flank_friction`.
    ellipse
        The rest of the contact's geometry.
    limiting_slope
        Limiting shear stress of the film over pressure [-]; 0: none.
    film_model : ndarray, shape (N_FLANK_MODEL,)
        Of `flank_film_model`; written into.
    """
    if has_own_law(lubricant):
        return NO_MODEL_FILM
    place = film_place(
        ellipse.R_x,
        ellipse.R_y,
        ellipse.psi,
        ellipse.delta,
        ellipse.ellipticity,
        geometry.pressure_coefficient,
        solid.conductivity,
        solid.density * solid.heat_capacity,
    )
    inlet = _inlet(lubricant, solid, limiting_slope, film_model)
    found = solved_film_at(
        film_model, load, abs(entrainment_speed), abs(sliding_speed), place, inlet
    )
    return ModelFilm(
        math.log(found.central_film),
        math.log(max(found.friction_coefficient, _LEAST_FRICTION)),
        found.outside,
    )
