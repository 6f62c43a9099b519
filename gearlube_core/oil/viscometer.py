"""Pressure factor of an oil from viscosities that were measured under pressure."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.oil.base_oils import VISCOMETER_FACTOR
from gearlube_core.oil.named_laws import ViscosityLaw
from gearlube_core.oil.pressure_factor import PressureFactor, film_coefficient, modulus_at
from gearlube_core.oil.walther_1931 import walther_kinematic_viscosity

_LEAST_POINTS = 4
_ALIKE = 0.5  # K, temperatures of one curve


class FittedFactor(NamedTuple):
    """Pressure factor and how well it meets the points."""

    factor: PressureFactor
    rms: float  # of ln eta [-]


def fit_pressure_factor(
    points: Array, ambient_viscosity: Callable[[float], float], like: PressureFactor
) -> FittedFactor:
    """Return the pressure factor that meets measured viscosities best.

    ln(eta/eta0) = p/(A + B p),  A = a1 + a2 T,  B = b1 + b2 T

    Parameters
    ----------
    points : ndarray, shape (n, 3)
        Gauge pressure [Pa], temperature [K] and dynamic viscosity [Pa s]. Points without pressure
        are eta0 of their temperature, where there are some.
    ambient_viscosity
        Returns eta0 [Pa s] at a temperature [K] of which there is no such point.
    like
        Factor whose change with temperature is taken where all points have one temperature.

    Raises
    ------
    ParameterError
        There are fewer than 4 points under pressure, they have one pressure, or viscosity does not
        grow with pressure.

    Notes
    -----
    Least squares of ln eta. Good to the highest measured pressure; beyond it grows less than
    measured oils do, see `PressureFactor`.

    Examples
    --------
    >>> known = PressureFactor(-2.3e7, 2.3e5, -0.07, 2.8e-4)
    >>> T, p = np.repeat([313.15, 353.15], 4), np.tile([1e8, 2e8, 3e8, 4e8], 2)
    >>> grown = p / (known.a1 + known.a2 * T + (known.b1 + known.b2 * T) * p)
    >>> points = np.column_stack([p, T, 0.05 * np.exp(grown)])
    >>> fitted = fit_pressure_factor(points, lambda T: 0.05, known)
    >>> round(fitted.factor.a2), round(fitted.rms, 6)
    (230000, 0.0)
    """
    from scipy.optimize import least_squares  # takes a third of a second

    p, T, grown = _growth(points, ambient_viscosity)
    one_curve = float(np.ptp(T)) < _ALIKE

    def factor_of(x: Array) -> PressureFactor:
        if one_curve:  # A and B there, each with the change of the other oil
            A, B = like.a1 + like.a2 * T[0], like.b1 + like.b2 * T[0]
            return PressureFactor(
                like.a1 * x[0] / A, like.a2 * x[0] / A, like.b1 + x[1] - B, like.b2
            )
        return PressureFactor(*(float(one) for one in x))

    def misses(x: Array) -> Array:
        f = factor_of(x)
        return p / (f.a1 + f.a2 * T + (f.b1 + f.b2 * T) * p) - grown

    # p over the growth is linear in the numbers: a start close to the end
    one = np.ones_like(p)
    columns = np.column_stack([one, p] if one_curve else [one, T, p, p * T])
    size = np.abs(columns).max(axis=0)
    weights = grown**2 / p
    start = (
        np.linalg.lstsq(columns / size * weights[:, None], p / grown * weights, rcond=None)[0]
        / size
    )
    found = least_squares(misses, start, x_scale=np.abs(start) + 1e-12, xtol=1e-12, ftol=1e-12)
    factor = factor_of(found.x)
    for t in (T.min(), T.max()):
        A = factor.a1 + factor.a2 * t
        if not A > 0.0:
            raise ParameterError(
                f"The viscosities under pressure give a slope at ambient pressure of {1e9 / A:.3g} "
                f"1/GPa at {t:.5g} K, which must be above 0. Give points at more pressures."
            )
    rms = math.sqrt(float(np.mean(found.fun**2)))
    return FittedFactor(factor, rms)


def measured_law(
    points: Array, data: Mapping[str, Any], like: ViscosityLaw
) -> tuple[ViscosityLaw, dict[str, Any], str]:
    """Return the law of an oil's measured points, what they say of alpha, how well it meets them.

    Parameters
    ----------
    points : ndarray, shape (n, 3)
        As in `fit_pressure_factor`.
    data
        Fields of `Lubricant` that the viscosity without pressure needs, and `alpha_temperature`.
    like
        Law of the class of base oils.
    """
    line, density = (data["walther_a"], data["walther_b"]), data["density"]
    fitted = fit_pressure_factor(
        points,
        lambda T: density * walther_kinematic_viscosity(*line, T),
        PressureFactor(**like.numbers),
    )
    law = ViscosityLaw.kind.named("viscometer", "modulus", fitted.factor._asdict())
    alpha = film_coefficient(*modulus_at(fitted.factor, data["alpha_temperature"]))
    found = {"alpha_per_gpa": 1e9 * alpha, "alpha_is": "film"}
    found["high_pressure_factor"] = VISCOMETER_FACTOR
    return law, found, f"viscometer, {100.0 * fitted.rms:.2g} % rms"


def _growth(
    points: Array, ambient_viscosity: Callable[[float], float]
) -> tuple[Array, Array, Array]:
    """Return pressure [Pa], temperature [K] and ln(eta/eta0) of the points under pressure."""
    points = points[np.lexsort((points[:, 0], points[:, 1]))]
    pressures, temperatures, grown = [], [], []
    base, last = 0.0, (0.0, -1.0, 0.0)  # eta0; the point before
    for p, T, eta in points:
        if abs(T - last[1]) > _ALIKE:  # another curve
            base = eta if p == 0.0 else ambient_viscosity(T)
            last = (0.0, T, base)
        if p == 0.0:
            continue
        if not eta > last[2]:
            raise ParameterError(
                f"Viscosity must grow with pressure, got {eta:.4g} Pa s at {1e-9 * p:g} GPa and "
                f"{last[2]:.4g} Pa s at {1e-9 * last[0]:g} GPa, both at {T - 273.15:.4g} degC. "
                "Are two rows swapped, or is a viscosity in another unit? 20 mPa s is 0.02 Pa s."
            )
        last = (p, T, eta)
        pressures.append(p)
        temperatures.append(T)
        grown.append(math.log(eta / base))
    if len(pressures) < _LEAST_POINTS or np.ptp(pressures) == 0.0:
        raise ParameterError(
            f"At least {_LEAST_POINTS} viscosities under pressure at two pressures must be given, "
            f"got {len(pressures)} at {len(set(pressures))}. Give more, or alpha instead."
        )
    return np.array(pressures), np.array(temperatures), np.array(grown)
