"""Limits of mass-conserving cavitation for point contacts."""

from __future__ import annotations

import math

from gearlube_core.ehl.point.equations.film_shear import ALIGNED
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.errors import ParameterError


def check_cavitation(problem: PointContactProblem, settings: PointSolverSettings) -> None:
    """Refuse a problem that the cavitation of the settings does not go with.

    Raises
    ------
    ParameterError
        A starved inlet without mass conservation; touching solids, or an Eyring oil sheared along
        neither axis, with it.
    """
    if settings.cavitation == "reynolds":
        if problem.inlet_layer is not None:
            raise ParameterError(
                f"inlet_layer is {problem.inlet_layer:g} m: a starved inlet needs cavitation "
                "mass_conserving."
            )
        return
    if problem.sides != "ambient":
        raise ParameterError(
            f"mass-conserving cavitation needs sides ambient, got {problem.sides}. Take cavitation "
            "reynolds."
        )
    if problem.solids is not None:
        raise ParameterError(
            "Mass-conserving cavitation cannot be combined with touching solids. Leave one of "
            "them out."
        )
    if problem.lubricant.shear.tau0 > 0.0 and problem.sliding is not None:
        along, across = problem.sliding
        if abs(along * across) >= ALIGNED * math.hypot(along, across) ** 2 > 0.0:
            raise ParameterError(
                "mass-conserving cavitation of an Eyring oil needs sliding along x or y, got "
                f"{along:g} and {across:g} m/s. Turn the axes along sliding, or take a Newtonian "
                "oil."
            )


def refuse_rupture(settings: PointSolverSettings, film: str) -> None:
    """Refuse mass-conserving cavitation of a film that changes in time or has heat.

    Raises
    ------
    ParameterError
    """
    if settings.cavitation == "mass_conserving":
        raise ParameterError(
            "Mass-conserving cavitation is only for steady isothermal point contacts, got a film "
            f"{film}. Take cavitation reynolds."
        )
