"""The thermal Eyring film of one line contact, solved for training."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from gearlube.studies.film_model.solve import Solved, contact_oil, contact_solid
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.thermal import (
    ThermalLineSolution,
    ThermalSettings,
    thermal_line_on_grid,
)
from gearlube_core.film_model.line_contact import LineContact
from gearlube_core.film_model.rolling import RollerContact, rolling_line

_TOLERANCE = 1e-7
_HEAT = ThermalSettings(tolerance=3e-3, max_turns=80)


def line_problem(contact: LineContact) -> LineProblem:
    """Return the problem of a contact."""
    u, slip = contact.entrainment_speed, contact.sliding_speed
    return LineProblem(
        lubricant=contact_oil(contact),
        radius=contact.R,
        line_load=contact.line_load,
        reduced_modulus=2.0 * contact.contact_modulus,
        speed_1=u - 0.5 * slip,
        speed_2=u + 0.5 * slip,
    )


def solve_line_contact(contact: LineContact, nodes: tuple[int, int]) -> Solved:
    """Return the thermal film of a line contact; `converged` tells whether it was found.

    Parameters
    ----------
    contact
        Its limiting stress is left out.
    nodes
        Across the line, and 1.

    Raises
    ------
    ParameterError
        The contact is out of the solver's range.
    """
    return _solved(contact, nodes, _sliding_friction)


def solve_roller_contact(contact: RollerContact, nodes: tuple[int, int]) -> Solved:
    """Return the thermal film of a roller on its race; its friction is that of rolling, 2 F/w.

    F = int h/2 dp/dx dx, the force of the film on either surface per length, from one relative
    radius ahead of the contact on; the rest as in `solve_line_contact`.
    """
    return _solved(rolling_line(contact), nodes, _rolling_friction)


def _sliding_friction(warm: ThermalLineSolution) -> float:
    return warm.film.friction_coefficient


def _rolling_friction(warm: ThermalLineSolution) -> float:
    # rollers and races end about one relative radius from the contact: no oil is rolled beyond it
    film, problem = warm.film, warm.film.problem
    beyond = 12.0 * problem.lubricant.eta0 * problem.entrainment_speed
    return 2.0 * (film.rolling_force - beyond) / problem.line_load


def _solved(
    contact: LineContact,
    nodes: tuple[int, int],
    friction: Callable[[ThermalLineSolution], float],
) -> Solved:
    begin = time.process_time()
    solid = contact_solid(contact)
    settings = LineSettings(nodes=nodes[0], tolerance=_TOLERANCE)
    warm = thermal_line_on_grid(line_problem(contact), (solid, solid), settings, _HEAT)
    film = warm.film
    return Solved(
        film.central_film,
        film.minimum_film,
        friction(warm),
        film.maximum_pressure,
        warm.max_temperature - contact.temperature,
        math.nan,  # not asked for
        float(warm.converged),
        time.process_time() - begin,
    )
