"""The thermal Eyring film of one contact, solved for training and audit."""

from __future__ import annotations

import math
import time
from typing import NamedTuple

from gearlube_core.contact.solid import Solid
from gearlube_core.ehl.gears.hypoid_film import FlankInstant, flank_contact
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.thermal.solver import PointThermalSettings, solve_thermal_point
from gearlube_core.film_model.groups import FilmContact
from gearlube_core.film_model.line_contact import LineContact
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.oil.oil_heat import OilHeat
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE, ROELANDS_KAPPA

_SETTINGS = PointSolverSettings(wedge="quick", tolerance=1e-5, estimate_error=False)
_HEAT = PointThermalSettings(tolerance=1e-5, max_turns=40)
_POISSON = 0.3
# only products with heat capacities act
_OIL_DENSITY, _SOLID_DENSITY = 870.0, 7850.0  # kg/m3


class Solved(NamedTuple):
    """Numbers of a solved film; floats, SI."""

    central_film: float  # [m]
    minimum_film: float  # [m]
    friction: float  # coefficient [-]
    pressure_max: float  # [Pa]
    rise: float  # of the film over the inlet, largest [K]
    balance: float  # heat not balanced over that of shear [-]
    converged: float  # 1 or 0
    seconds: float  # of the processor


def contact_oil(contact: FilmContact | LineContact) -> FilmOil:
    """Return the oil of a contact: Houpert, Dowson and Higginson, Eyring; no limiting stress."""
    log_ratio = math.log(contact.eta0 / ROELANDS_KAPPA)
    return film_oil(
        eta0=contact.eta0,
        alpha=contact.alpha,
        law="houpert",
        rho0=_OIL_DENSITY,
        eyring_stress=contact.tau0,
        temperature=contact.temperature,
        temperature_exponent=contact.beta * (contact.temperature - GLASS_TEMPERATURE) / log_ratio,
        heat=OilHeat(
            conductivity=contact.conductivity,
            heat_capacity=contact.heat_capacity / _OIL_DENSITY,
        ),
    )


def contact_solid(contact: FilmContact | LineContact) -> Solid:
    """Return the two alike bodies of a contact."""
    return Solid(
        youngs_modulus=2.0 * (1.0 - _POISSON**2) * contact.contact_modulus,
        poisson_ratio=_POISSON,
        density=_SOLID_DENSITY,
        conductivity=contact.solid_conductivity,
        heat_capacity=contact.solid_heat_capacity / _SOLID_DENSITY,
    )


def contact_problem(contact: FilmContact, nodes: tuple[int, int]) -> PointContactProblem:
    """Return the problem of a contact on a grid, nodes along the minor and the major axis."""
    psi, chi = contact.entrainment_angle, contact.entrainment_angle + contact.sliding_angle
    u, slip = contact.entrainment_speed, contact.sliding_speed
    instant = FlankInstant(
        time=0.0,
        angle=0.0,
        phase=0.0,
        load=contact.load,
        R_x=contact.R_x,
        R_y=contact.R_y,
        entrainment=(u * math.cos(psi), u * math.sin(psi)),
        sliding=(slip * math.cos(chi), slip * math.sin(chi)),
    )
    return flank_contact(instant, contact.contact_modulus, contact_oil(contact), nodes)


def solve_contact(contact: FilmContact, nodes: tuple[int, int]) -> Solved:
    """Return the thermal film of a contact; `converged` tells whether it was found.

    Parameters
    ----------
    contact
        Its limiting stress is left out.
    nodes
        Along the minor and the major axis.

    Raises
    ------
    ParameterError
        The contact is out of the solver's range.
    """
    solid = contact_solid(contact)
    begin = time.process_time()
    problem = contact_problem(contact, nodes)
    warm = solve_thermal_point(problem, solid, solid, _SETTINGS, _HEAT, throw=False)
    loaded = warm.film.pressure > 0.0
    cell = (problem.x[1] - problem.x[0]) * (problem.y[1] - problem.y[0])
    return Solved(
        warm.film.central_film,
        warm.film.minimum_film,
        float(warm.mean_stress[loaded].sum()) * cell / problem.load,
        warm.film.maximum_pressure,
        warm.max_temperature - contact.temperature,
        warm.balances[-1] if warm.balances else math.inf,
        float(warm.converged),
        time.process_time() - begin,
    )
