"""Films of a point contact solved where measured ones were read, with the bar of its oil."""

from __future__ import annotations

import logging
import math
from pathlib import Path

import numpy as np

from gearlube.report.measured_run import FEWEST, Compared
from gearlube_core.dynamics.hypoid_axle.uncertain import UNCERTAIN
from gearlube_core.ehl.case.contact_case import PointCase
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.thermal.solver import solve_thermal_point
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.measurements import Measurements
from gearlube_core.oil.oil_file import read_oil

logger = logging.getLogger("gearlube")
# of films, [hamrock_dowson_1977]: how viscosity and alpha move them
EXPONENTS = {"viscosity": 0.67, "alpha": 0.53}
_NANO = 1e-9  # m


def compared_films(where: Path, measured: Measurements) -> Compared:
    """Return measured films beside those of a case file or a shipped case, solved at each point.

    Speed along x, load and temperature are those of the points, the slide-roll ratio and the oil
    those of the case. The bar holds the viscosity of the oil, its alpha and the error of the grid.

    Raises
    ------
    ParameterError
        The case is wrong, or fewer than three films converge.
    """
    case = PointCase.given(str(where))
    films, errors = [], []
    for k, (speed, load, degc) in enumerate(zip(*measured.conditions.values(), strict=True)):
        logger.info("Film %d of %d", k + 1, measured.value.size)
        point = case.moved(float(speed), None)
        point = point.varied({"load_n": float(load), "oil.temperature_degc": float(degc)})
        problem, settings = point.problem(), point.settings()
        solved = (
            solve_thermal_point(problem, *point.solids, settings, throw=False)
            if point.temperature == "thermal"
            else solve_point_contact(problem, settings, throw=False)
        )
        films.append(solved.numbers.central_film / _NANO if solved.converged else math.nan)
        errors.append(solved.error.central_film)
    factors = {one.name: one.factor for one in UNCERTAIN}
    if case.oil.library is not None:
        factors["alpha"] = read_oil(case.oil.library).lubricant.alpha_factor or factors["alpha"]
    logs = {name: power * math.log(factors[name]) for name, power in EXPONENTS.items()}
    film, bar = np.array(films), np.exp(np.hypot(math.hypot(*logs.values()), errors))
    inside = np.isfinite(film)
    if inside.sum() < FEWEST:
        raise ParameterError(
            f"At least {FEWEST} films of {where} must converge, got {inside.sum()} of "
            f"{inside.size}. Solve one with `gearlube ehl point`, and give its grid more nodes."
        )
    film, bar = film[inside], bar[inside]
    return Compared(
        measured=measured.chosen(inside),
        left_out="" if inside.all() else f"{measured.named(~inside)}, which did not converge.",
        predicted=film,
        low=film / bar,
        high=film * bar,
        swings={name: film * math.expm1(one) for name, one in logs.items()},
    )
