"""Shear stress of a thermal Eyring film, Johnson and Greenwood 1980.

A film of thickness h between surfaces of equal temperature, under one shear stress tau with
tau* = tau0 sinh(tau/tau0) and eta = eta_s exp(-beta dT), has the temperature
dT = (1/beta) ln[cosh^2 Y/cosh^2(2 Y z/h)]. With X = sinh Y and X* = Y/cosh Y,
[karagiannis_2012 (18)] and [karagiannis_2012 (20)] become

    tau/tau0 = c Y tanh Y,  c = 4 A^2/dU* = 8 K/(beta tau0 h |dU|)
    sinh(tau/tau0) = dU* 2 Y/sinh 2Y,  dU* = eta_s |dU|/(tau0 h)

which leaves one number Y to find; c does not contain the viscosity.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import eyring_stress_ratio

CONVERGED, NOT_CONVERGED = 0.0, 1.0
_ITERATIONS = 60
_TOLERANCE = 1.0e-7  # of Y, relative, of the last step; the next would be its square
_LN2 = math.log(2.0)
_SERIES_BELOW = 0.02  # of Y, where logarithms near zero lose digits
_NO_FILM_HEAT = 1.0e-30  # Y of a film at rest


class ThermalEyringFilm(NamedTuple):
    """State of a sheared film between surfaces of equal temperature; all floats, SI."""

    Y: float  # asinh X, the parameter of the temperature profile [-]
    stress_ratio: float  # tau/tau0 [-]
    viscosity_ratio: float  # effective viscosity over that at the surfaces, X*/X [-]
    rise_centre: float  # temperature in the middle over the surfaces [K]
    rise_effective: float  # rise that lowers the viscosity to the effective one [K]
    status: float  # 0 converged, 1 not


@kernel
def _log_sinh_ratio(Y: float) -> float:
    """Return ln(sinh 2Y/2Y) of Y > 0."""
    if Y < _SERIES_BELOW:
        square = 4.0 * Y * Y
        return square * (1.0 / 6.0 - square * (1.0 / 180.0 - square / 2835.0))
    fall = math.expm1(-2.0 * Y)
    return 2.0 * Y + math.log(-fall * (2.0 + fall) / (4.0 * Y))


@kernel
def _excess(Y: float, c: float, log_slip: float) -> tuple[float, float]:
    """Return ln sinh(c Y tanh Y) + ln(sinh 2Y/2Y) - ln dU* and its slope with ln Y.

    It rises with Y from minus to plus infinity, so it has one root.
    """
    fall = math.expm1(-2.0 * Y)
    tanh = -fall / (2.0 + fall)
    s = c * Y * tanh
    fall_s = math.expm1(-2.0 * s)
    excess = s + 2.0 * Y - _LN2 + math.log(fall_s * fall * (2.0 + fall) / (4.0 * Y)) - log_slip
    s_coth = -s * (2.0 + fall_s) / fall_s
    slope = s_coth * (1.0 + Y * (1.0 / tanh - tanh)) + Y * (tanh + 1.0 / tanh) - 1.0
    return excess, slope


@kernel
def thermal_eyring_film_near(
    start: float,
    log_viscosity: float,
    beta: float,
    conductivity: float,
    tau0: float,
    film_thickness: float,
    sliding_speed: float,
) -> ThermalEyringFilm:
    """Return the same as `thermal_eyring_film`, but search from Y = `start` [-]; 0: no guess."""
    slip = abs(sliding_speed)
    if slip == 0.0:
        return ThermalEyringFilm(0.0, 0.0, 1.0, 0.0, 0.0, CONVERGED)
    stress_length = tau0 * film_thickness
    c = 8.0 * conductivity / (beta * stress_length * slip)
    relative_slip = slip / stress_length
    log_slip = log_viscosity + math.log(relative_slip)
    isothermal = eyring_stress_ratio(relative_slip, log_viscosity)
    q = isothermal / c
    # tanh Y > Y/(1 + Y) turns Y tanh Y <= q into a bound on Y
    high = 0.5 * (q + math.sqrt(q * (q + 4.0))) * (1.0 + 1e-9)
    low = 0.0
    Y = start if 0.0 < start < high else math.sqrt(q)
    if Y > 1.0 and start != Y:
        # both logarithms are nearly straight there
        Y = (log_slip + _LN2 + math.log(1.0 + (isothermal + c) / (c + 2.0))) / (c + 2.0)
        Y = min(max(Y, 0.7), high)
    status = NOT_CONVERGED
    for _ in range(_ITERATIONS):
        excess, slope = _excess(Y, c, log_slip)
        if excess > 0.0:
            high = Y
        else:
            low = Y
        step = -excess / slope
        proposal = Y * (1.0 + step) if Y > 1.0 else Y * math.exp(step)
        if not low <= proposal <= high:
            proposal = 0.5 * (low + high)
        change = abs(proposal - Y)
        Y = proposal
        if change <= _TOLERANCE * Y:
            status = CONVERGED
            break
    if not Y > _NO_FILM_HEAT:
        Y = math.nan
        status = NOT_CONVERGED
    log_ratio = _log_sinh_ratio(Y)
    s = c * Y * math.tanh(Y)
    cosh_rise = 2.0 * Y + 2.0 * math.log1p(math.exp(-2.0 * Y)) - 2.0 * _LN2
    if Y < _SERIES_BELOW:
        square = Y * Y
        cosh_rise = square * (1.0 - square * (1.0 / 6.0 - square * (2.0 / 45.0)))
    return ThermalEyringFilm(Y, s, math.exp(-log_ratio), cosh_rise / beta, log_ratio / beta, status)


@kernel
def thermal_eyring_film(
    log_viscosity: float,
    beta: float,
    conductivity: float,
    tau0: float,
    film_thickness: float,
    sliding_speed: float,
) -> ThermalEyringFilm:
    """Return stress and temperature of a film sheared between surfaces of equal temperature.

    Parameters
    ----------
    log_viscosity
        ln eta_s, natural logarithm of the viscosity [Pa s] at contact pressure and surface
        temperature; the exponential is not formed where it would overflow.
    beta
        -d ln eta/dT at the same state [1/K].
    conductivity
        Of the lubricant, K [W/(m K)].
    tau0
        Eyring stress [Pa].
    film_thickness
        h [m].
    sliding_speed
        dU [m/s], either sign.

    Returns
    -------
    ThermalEyringFilm
        Zero stress without sliding. `status` is 1 and the numbers are NaN for input that is not
        positive and finite.

    Notes
    -----
    Uniform pressure and stress, heat conducted across the film only, exponential fall of
    viscosity with temperature, K and tau0 constant. Newton's method, in Y above 1 and in ln Y
    below, inside a bracket: a cold film gives Y tanh Y <= asinh(dU*)/c.
    Source: [johnson_greenwood_1980]
    [karagiannis_2012 (14)] [karagiannis_2012 (15)] [karagiannis_2012 (18)] [karagiannis_2012 (20)]
    (14) and (15) enter through their solution, the temperature profile of this module's text.
    """
    return thermal_eyring_film_near(
        0.0, log_viscosity, beta, conductivity, tau0, film_thickness, sliding_speed
    )


@kernel
def thermal_newtonian_stress(
    log_viscosity: float,
    beta: float,
    conductivity: float,
    film_thickness: float,
    sliding_speed: float,
) -> float:
    """Return the shear stress of a heated Newtonian film (no Eyring stress).

    tau = 8 K/(beta h |dU|) Y tanh Y,  sinh^2 Y = eta_s beta dU^2/(8 K)

    Parameters
    ----------
    log_viscosity, beta, conductivity, film_thickness, sliding_speed
        As in `thermal_eyring_film`.

    Returns
    -------
    float
        tau [Pa].

    Notes
    -----
    The limit of large tau0. Source: [johnson_greenwood_1980].
    """
    slip = abs(sliding_speed)
    if slip == 0.0:
        return 0.0
    number = 0.5 * (log_viscosity + math.log(beta * slip * slip / (8.0 * conductivity)))
    # asinh(x) = ln 2x to double precision beyond
    Y = number + _LN2 if number > 20.0 else math.asinh(math.exp(number))
    return 8.0 * conductivity / (beta * film_thickness * slip) * Y * math.tanh(Y)
