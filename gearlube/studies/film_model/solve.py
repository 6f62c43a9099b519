"""The thermal Eyring film of one contact, solved for training and audit."""

from __future__ import annotations

import math
import time
from typing import Any, NamedTuple

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
from gearlube_core.oil.pressure_factor import PressureFactor
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE, ROELANDS_KAPPA
from gearlube_core.oil.shape_law import OilLine, ShapedViscosity
from gearlube_core.oil.walther_1931 import MM2_S, WALTHER_SHIFT, walther_double_log

_SETTINGS = PointSolverSettings(
    wedge="quick", tolerance=1e-4, fall_back=False, estimate_error=False
)
_HEAT = PointThermalSettings(tolerance=3e-4, max_turns=30)
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
    """Return the oil of a contact: its viscosity law, Dowson and Higginson, Eyring.

    With an Eyring slope Lambda the stress is limited to Lambda p, else not at all.
    """
    c = contact
    heat = OilHeat(conductivity=c.conductivity, heat_capacity=c.heat_capacity / _OIL_DENSITY)
    law: Any = "houpert"
    exponent = 0.0
    if c.modulus > 0.0:
        law = contact_modulus_law(c)
    else:
        exponent = c.beta * (c.temperature - GLASS_TEMPERATURE) / math.log(c.eta0 / ROELANDS_KAPPA)
    return film_oil(
        eta0=c.eta0,
        alpha=None if c.modulus > 0.0 else c.alpha,
        law=law,
        rho0=_OIL_DENSITY,
        eyring_stress=None if c.eyring_slope > 0.0 else c.tau0,
        eyring_slope=c.eyring_slope,
        temperature=c.temperature,
        temperature_exponent=exponent,
        heat=heat,
    )


def contact_modulus_law(contact: FilmContact | LineContact) -> ShapedViscosity:
    """Return the pressure factor of a contact with the line of Walther through eta0 and beta."""
    c, nu = contact, contact.eta0 / _OIL_DENSITY
    shifted = nu / MM2_S + WALTHER_SHIFT
    B = c.beta * c.temperature * nu / MM2_S / (shifted * math.log(shifted))
    A = walther_double_log(nu) + B * math.log10(c.temperature)
    factor = PressureFactor(
        c.modulus - c.modulus_turn * c.temperature,
        c.modulus_turn,
        c.modulus_slope - c.slope_turn * c.temperature,
        c.slope_turn,
    )
    line = OilLine(A, B, _OIL_DENSITY, 1.0)
    return ShapedViscosity(factor, 1.0, 1.0, line, c.temperature, 1.0, 1.0)


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
    """Return the thermal film of a contact; `converged` is whether it was found.

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
