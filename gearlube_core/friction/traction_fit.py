"""Eyring stress and limiting shear stress of an oil from measured traction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import f as fisher
from scipy.stats import t as student

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, SolidParameters, solid_parameters
from gearlube_core.errors import ParameterError
from gearlube_core.friction.evans_johnson_1986 import MAP_RANGE, traction_map_number
from gearlube_core.friction.traction_measurements import (
    FilmPoint,
    TractionMeasurements,
    film_point,
    traction_coefficient,
)
from gearlube_core.oil.formula_laws import mean_slope
from gearlube_core.oil.lubricant import Lubricant

STRESS_RANGE = (0.1e6, 100e6)  # Pa, of the search
_STARTS = tuple(1e6 * 2.0 ** (0.5 * k) for k in range(11))  # Pa, the best of them
_LIMIT_STARTS = (0.95, 0.8)  # of the greatest measured traction
_FEWEST_LIMITED = 3  # points at the limit, below which it says nothing
_RARE = 0.01  # probability of chance above which a limit is not believed
_CONFIDENCE = 0.95
_STEP = 1e-4  # of the logarithm, for the Jacobian


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionFit:
    """Stresses of an oil and how well they are known.

    Parameters
    ----------
    eyring_stress : float
        [Pa].
    eyring_factor : float
        The true value lies between value/factor and value * factor with 95 % [-].
    limiting_coefficient, limiting_factor : float
        Limiting shear stress over pressure and its factor [-]; nan: no point reaches a limit.
    residual : float
        Standard deviation of measured less fitted traction [-].
    curve_misfit : float
        Greatest mean of measured less fitted traction of one curve [-], by magnitude.
    fitted : ndarray of shape (n,)
        Traction coefficient of the law at the measured points [-].
    films : tuple of float
        Smallest and greatest film [m].
    out_of_range : int
        Points outside the range of the law, see `plateau_stress_ratio`.
    """

    eyring_stress: float
    eyring_factor: float
    limiting_coefficient: float
    limiting_factor: float
    residual: float
    curve_misfit: float
    fitted: Array
    films: tuple[float, float]
    out_of_range: int


def steel_on_steel() -> SolidParameters:
    """Return the data of a pair of steels."""
    return solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)


def film_points(
    measured: TractionMeasurements,
    oil: Lubricant,
    *,
    contact: str,
    radius: float,
    solid: SolidParameters | None = None,
) -> list[FilmPoint]:
    """Return film and heating of every measured point.

    Raises
    ------
    ParameterError
        A temperature is outside the data of the oil, or the radius out of its range.
    """
    for temperature in np.unique(measured.temperature):
        oil.check_temperature(float(temperature), "temperature_degc, in K,")
    pair = solid or steel_on_steel()
    return [
        film_point(
            oil.state(float(temperature)),
            pair,
            contact=contact,
            radius=radius,
            entrainment_speed=float(speed),
            sliding_speed=float(sliding),
            mean_pressure=float(pressure),
        )
        for temperature, speed, sliding, pressure in zip(
            measured.temperature,
            measured.entrainment_speed,
            measured.sliding_speed,
            measured.mean_pressure,
            strict=True,
        )
    ]


def fit_traction(
    measured: TractionMeasurements,
    oil: Lubricant,
    *,
    contact: str,
    radius: float,
    solid: SolidParameters | None = None,
) -> TractionFit:
    """Return the Eyring stress, and the limiting coefficient if the points reach it.

    Least squares of the traction coefficient; factors from the Jacobian and the residual.

    Parameters
    ----------
    measured : TractionMeasurements
    oil : Lubricant
        Viscosity, alpha and conductivity are taken as exact; its stresses are not used.
    contact : {"point", "line"}
    radius : float
        Relative radius of curvature [m].
    solid : SolidParameters, optional
        Default: steel on steel.

    Returns
    -------
    TractionFit

    Raises
    ------
    ParameterError
        The points do not determine the stress.

    Notes
    -----
    The factors count scatter of independent points. They do not count errors of the law, of alpha
    and viscosity, which bend all points alike: `curve_misfit` shows them. A limit is kept where
    three points lie on it and an F test finds it by chance in less than 1 of 100 cases.
    Law as in `traction_coefficient`: smooth surfaces, [evans_johnson_1986].
    """
    points = film_points(measured, oil, contact=contact, radius=radius, solid=solid)
    target = measured.traction
    greatest = float(np.max(target))
    check_positive("The greatest traction_coefficient", greatest, "", "It opposes the sliding.")
    start = min(_STARTS, key=lambda s: float(np.sum((_model(points, [math.log(s)]) - target) ** 2)))
    free = _solved(points, target, (start,))
    best, limited = free, False
    tries = [
        _solved(points, target, (math.exp(free.x[0]), share * greatest)) for share in _LIMIT_STARTS
    ]
    with_limit = min(tries, key=lambda one: float(one.cost))
    if _believed(points, target, free, with_limit):
        best, limited = with_limit, True
    factors, deviation = _factors(points, target, best.x)
    stress = math.exp(best.x[0])
    if not STRESS_RANGE[0] * 1.01 < stress < STRESS_RANGE[1] / 1.01 or not factors[0] < 10.0:
        raise ParameterError(
            f"The points do not determine the Eyring stress: got {1e-6 * stress:.3g} MPa within a "
            f"factor of {factors[0]:.3g}, limits 0.1 to 100 MPa and a factor of 10. Measure where "
            "the film thins with shear: at more pressure and more sliding."
        )
    fitted = _model(points, best.x)
    curve, films = measured.curve, [one.film_thickness for one in points]
    means = [float(np.mean((target - fitted)[curve == k])) for k in np.unique(curve)]
    return TractionFit(
        eyring_stress=stress,
        eyring_factor=factors[0],
        limiting_coefficient=math.exp(best.x[1]) if limited else math.nan,
        limiting_factor=factors[1] if limited else math.nan,
        residual=deviation,
        curve_misfit=max(means, key=abs),
        fitted=fitted,
        films=(min(films), max(films)),
        out_of_range=sum(not _in_range(one, stress) for one in points),
    )


def _model(points: Sequence[FilmPoint], logs: Sequence[float] | Array) -> Array:
    limit = math.exp(logs[1]) if len(logs) > 1 else math.inf
    stress = math.exp(logs[0])
    return np.array([traction_coefficient(one, stress, limit) for one in points])


def _solved(points: Sequence[FilmPoint], target: Array, start: tuple[float, ...]) -> Any:
    lower = [math.log(STRESS_RANGE[0]), math.log(1e-3)][: len(start)]
    upper = [math.log(STRESS_RANGE[1]), math.log(1.0)][: len(start)]
    first = np.clip(np.log(start), np.array(lower) + 1e-6, np.array(upper) - 1e-6)
    return least_squares(
        lambda x: (_model(points, x) - target) / 0.01,
        first,
        bounds=(lower, upper),
        diff_step=_STEP,
        xtol=1e-10,
        ftol=1e-12,
        gtol=1e-12,
    )


def _believed(points: Sequence[FilmPoint], target: Array, free: Any, limited: Any) -> bool:
    """Whether a fit with a limit is one that chance would rarely give."""
    unlimited = _model(points, limited.x[:1])
    on_limit = int(np.sum(unlimited > math.exp(limited.x[1])))
    spare = target.size - 2
    gain = float(free.cost - limited.cost)
    if on_limit < _FEWEST_LIMITED or spare < 1 or gain <= 0.0:
        return False
    if limited.cost <= 0.0:
        return True
    return bool(fisher.sf(gain / (limited.cost / spare), 1, spare) < _RARE)


def _factors(points: Sequence[FilmPoint], target: Array, logs: Array) -> tuple[list[float], float]:
    """Return the factor of each stress, and the standard deviation of the residual."""
    columns = []
    for k in range(len(logs)):
        step = np.zeros(len(logs))
        step[k] = _STEP
        columns.append((_model(points, logs + step) - _model(points, logs - step)) / (2.0 * _STEP))
    spare = target.size - len(logs)
    deviation = float(np.sqrt(np.sum((target - _model(points, logs)) ** 2) / spare))
    normal = np.column_stack(columns).T @ np.column_stack(columns)
    if np.linalg.matrix_rank(normal) < len(logs):
        return [math.inf] * len(logs), deviation
    errors = deviation * np.sqrt(np.diag(np.linalg.inv(normal)))
    wide = float(student.ppf(0.5 + 0.5 * _CONFIDENCE, spare))
    return [float(np.exp(min(wide * one, 50.0))) for one in errors], deviation


def _in_range(point: FilmPoint, stress: float) -> bool:
    state = point.state
    number = traction_map_number(
        point.film_thickness,
        point.mean_pressure,
        state.eta0,
        mean_slope(state.viscosity, state, point.mean_pressure),
        state.beta,
        stress,
        state.conductivity,
    )
    return bool(MAP_RANGE[0] <= number <= MAP_RANGE[1])
