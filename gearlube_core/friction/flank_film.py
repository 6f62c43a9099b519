"""A flank contact in the words of the film model."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film_model import net
from gearlube_core.film_model.groups import FilmInlet, FilmPlace, film_inlet
from gearlube_core.film_model.model import FilmModel
from gearlube_core.friction.flank_bound import FlankEllipse
from gearlube_core.friction.flank_data import ContactGeometry
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array, tuple_to_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.oil.roelands_1966 import ROELANDS_KAPPA

# behind the numbers of the model: the oil that the numbers behind it belong to, and these
_OIL = net.N_ARRAY
_INLET = _OIL + count_floats(LubricantState) + 1
N_FLANK_MODEL = _INLET + count_floats(FilmInlet)


def flank_film_model(model: FilmModel) -> Array:
    """Return the numbers of a film model for one gear pair, shape (N_FLANK_MODEL,).

    Kernels write into them: two gear pairs must not share them.
    """
    return np.concatenate([model.copied_numbers(), np.full(N_FLANK_MODEL - _OIL, np.nan)])


@kernel
def reference_place(geometry: ContactGeometry, ellipse: FlankEllipse) -> FilmPlace:
    """Return of a position of mesh what the references of the film model take of it."""
    return FilmPlace(
        ellipse.R_x,
        ellipse.side_flow,
        geometry.pressure_coefficient,
        0.0,
        ellipse.cos_psi,
        0.0,
        0.0,
        0.0,
        0.0,
    )


@kernel
def flank_film_place(
    geometry: ContactGeometry, ellipse: FlankEllipse, solid: SolidParameters
) -> FilmPlace:
    """Return a position of mesh as the film model takes it, without what `film_place` costs."""
    R_x = ellipse.R_x
    volume_heat = solid.density * solid.heat_capacity
    return FilmPlace(
        R_x,
        ellipse.side_flow,
        geometry.pressure_coefficient,
        ellipse.psi,
        ellipse.cos_psi,
        ellipse.delta - math.pi * math.floor(ellipse.delta / math.pi + 0.5),
        ellipse.log_ellipticity,
        math.log(ROELANDS_KAPPA / (solid.contact_modulus * R_x)),
        math.log(R_x * volume_heat / solid.conductivity),
    )


@kernel
def flank_film_inlet(
    lubricant: LubricantState,
    solid: SolidParameters,
    limiting_slope: float,
    film_model: Array,
) -> FilmInlet:
    """Return oil and solids as the film model takes them.

    Parameters
    ----------
    lubricant, solid
        Of one gear pair.
    limiting_slope
        Limiting stress over pressure [-]; 0: no limit.
    film_model : ndarray, shape (N_FLANK_MODEL,)
        It keeps the result until the oil changes.
    """
    oil = film_model[_OIL:_INLET]
    known = oil[len(lubricant)] == limiting_slope
    for i in range(len(lubricant)):
        known = known and oil[i] == lubricant[i]
    if not known:
        inlet = film_inlet(
            solid.contact_modulus,
            lubricant.eta0,
            lubricant.alpha,
            lubricant.beta,
            lubricant.tau0,
            0.0,
            limiting_slope,
            lubricant.temperature,
            lubricant.conductivity,
            lubricant.volume_heat,
            solid.conductivity,
            solid.density * solid.heat_capacity,
        )
        tuple_to_array(inlet, film_model[_INLET:])
        tuple_to_array(lubricant, oil)
        oil[len(lubricant)] = limiting_slope
    return tuple_from_array(film_model[_INLET:], FilmInlet)
