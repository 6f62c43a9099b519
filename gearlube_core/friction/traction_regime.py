"""Map of traction regimes after Evans and Johnson 1986: what limits the traction of a film.

The largest traction that a heated film can reach over all sliding speeds depends on one number,

    L = ln(eta/eta0) + ln{2 K eta0/[beta (tau0 h)^2]},

the sum of a pressure and a film coordinate, and on the Eyring stress. Boundaries of the map are
therefore straight lines L = constant. Derived here from the film of [johnson_greenwood_1980]:

- Newtonian film, any sliding: tau <= tau_N = 2 X*_max [2 K eta/(beta h^2)]^(1/2), with
  X*_max = max Y/cosh Y = 0.6627. Where tau_N < tau0 heat limits traction before stress thins the
  film: L < -ln(4 X*_max^2) = -0.564.
- Eyring film: s sinh s = 4 X*_max^2 exp(L) at the largest s = tau/tau0.
- limiting stress: where that s exceeds tau_L/tau0 the film yields first (elastic-plastic).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.friction.thermal_eyring_data import ThermalEyringOil, ThermalFlankState
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import eyring_stress_ratio
from gearlube_core.oil.houpert_1985 import (
    HoupertParameters,
    houpert_log_viscosity,
    houpert_temperature_coefficient,
)
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY

NEWTONIAN, EYRING, PLASTIC = 0.0, 1.0, 2.0
REGIMES = {NEWTONIAN: "newtonian", EYRING: "eyring", PLASTIC: "elastic_plastic"}

# X*_max^2: the root of Y tanh Y = 1 is 1.1996786402577339, and (Y/cosh Y)^2 = Y^2 - 1 there
_Y_LARGEST = 1.1996786402577339
LARGEST_X_STAR_SQUARED = _Y_LARGEST * _Y_LARGEST - 1.0
NEWTONIAN_LIMIT = -math.log(4.0 * LARGEST_X_STAR_SQUARED)
_ITERATIONS = 60
_LN2 = math.log(2.0)
THERMAL_LOSS = 0.1  # above, a film counts as thermal


class TractionRegime(NamedTuple):
    """Place of a film on the traction map; all floats."""

    pressure_number: float  # ln(eta/eta0), alpha p of the map [-]
    film_number: float  # ln{2 K eta0/[beta (tau0 h)^2]} [-]
    slip_number: float  # dU* = eta |dU|/(tau0 h), Newtonian stress over Eyring stress [-]
    largest_stress_ratio: float  # of this film at the best sliding speed, tau/tau0 [-]
    thermal_loss: float  # share of the isothermal Eyring stress that heat takes at this speed [-]
    thermal: float  # 1 where that share exceeds a tenth, else 0
    deborah_number: float  # eta U/(G a) of this film, 0 for a rigid one [-]
    limit: float  # what limits traction at any speed: NEWTONIAN, EYRING or PLASTIC
    state: float  # NEWTONIAN, EYRING or PLASTIC at this sliding speed


@kernel
def largest_stress_ratio(map_number: float) -> float:
    """Return the largest tau/tau0 of a thermal Eyring film over all sliding speeds.

    s sinh s = 4 X*_max^2 exp(L)

    Parameters
    ----------
    map_number
        L, pressure number and film number together [-].

    Returns
    -------
    float
        s [-].

    Notes
    -----
    Exact where `plateau_stress_ratio` of [evans_johnson_1986] is its straight-line fit for
    L = 5 to 12 without surface heating. Newton's method on ln s.
    """
    target = map_number - NEWTONIAN_LIMIT
    s = math.exp(0.5 * target) if target < 0.0 else 1.0 + 0.87 * target
    for _ in range(_ITERATIONS):
        fall = math.expm1(-2.0 * s)
        excess = math.log(s) + s - _LN2 + math.log(-fall) - target
        slope = 1.0 - s * (2.0 + fall) / fall
        step = min(max(-excess / slope, -2.0), 2.0)
        s *= math.exp(step)
        if abs(step) < 1e-8:
            break
    return s


@kernel
def traction_regime(
    log_viscosity: float,
    log_viscosity_inlet: float,
    beta: float,
    conductivity: float,
    tau0: float,
    film_thickness: float,
    sliding_speed: float,
    stress_ratio: float,
    limiting_stress: float,
    shear_modulus: float,
    entrainment_speed: float,
    half_width: float,
) -> TractionRegime:
    """Return the place of a sheared film on the map and its regime.

    Parameters
    ----------
    log_viscosity, log_viscosity_inlet
        ln eta at contact pressure and ln eta0 at atmospheric pressure, surface temperature
        [ln Pa s].
    beta
        -d ln eta/dT at contact pressure [1/K].
    conductivity
        Of the lubricant [W/(m K)].
    tau0
        Eyring stress [Pa].
    film_thickness
        h [m].
    sliding_speed
        dU [m/s], either sign.
    stress_ratio
        tau/tau0 of this film, from `thermal_eyring_film` [-].
    limiting_stress
        tau_L at this pressure [Pa]; infinite if unknown.
    shear_modulus
        G of the film at this pressure [Pa]; infinite if unknown.
    entrainment_speed
        U [m/s].
    half_width
        Half length of the contact along entrainment a [m].

    Returns
    -------
    TractionRegime
        `limit` is the region of the map, whatever the sliding speed; `state` is what holds at
        this one: plastic where tau reaches tau_L, Newtonian where dU* < 1 or where heat keeps the
        film below tau0, else Eyring.

    Notes
    -----
    A Deborah number above about 1 means that the film passes before its viscous strain exceeds
    its elastic one, which bends the curve at small slip and leaves the plateau alone; it is
    reported, not used. [evans_johnson_1986] draw their map from measured tau0, tau_L and G,
    which neither paper on this gear pair gives.
    Source: [johnson_greenwood_1980] for the boundaries, derived above; [evans_johnson_1986]
    for the map; [johnson_tevaarwerk_1977] for the Deborah number.
    """
    slip = abs(sliding_speed)
    stress_length = tau0 * film_thickness
    pressure_number = log_viscosity - log_viscosity_inlet
    film_number = (
        math.log(2.0 * conductivity / (beta * stress_length * stress_length)) + log_viscosity_inlet
    )
    map_number = pressure_number + film_number
    largest = largest_stress_ratio(map_number)
    relative_slip = slip / stress_length
    slip_number = relative_slip * math.exp(log_viscosity)
    isothermal = eyring_stress_ratio(relative_slip, log_viscosity)
    thermal_loss = 1.0 - stress_ratio / isothermal if isothermal > 0.0 else 0.0
    deborah = math.exp(log_viscosity) * abs(entrainment_speed) / (shear_modulus * half_width)
    limit = EYRING
    if map_number < NEWTONIAN_LIMIT:
        limit = NEWTONIAN
    if largest * tau0 > limiting_stress:
        limit = PLASTIC
    state = EYRING
    if slip_number < 1.0 or map_number < NEWTONIAN_LIMIT:
        state = NEWTONIAN
    if stress_ratio * tau0 >= limiting_stress:
        state = PLASTIC
    return TractionRegime(
        pressure_number,
        film_number,
        slip_number,
        largest,
        thermal_loss,
        1.0 if thermal_loss > THERMAL_LOSS else 0.0,
        deborah,
        limit,
        state,
    )


@kernel
def flank_regime(
    state: ThermalFlankState,
    oil: ThermalEyringOil,
    limiting_stress: float,
    shear_modulus: float,
    half_width: float,
) -> TractionRegime:
    """Return the place of a flank on the map.

    Parameters
    ----------
    state
        From `thermal_eyring_flank`.
    oil
        The oil of that state.
    limiting_stress, shear_modulus, half_width
        As in `traction_regime`.

    Returns
    -------
    TractionRegime
    """
    law = HoupertParameters(oil.log_viscosity, oil.temperature, oil.S0, oil.Z)
    T_s = oil.temperature + state.flash
    reduced_log = houpert_log_viscosity(law, state.mean_pressure, T_s)
    return traction_regime(
        reduced_log - ROELANDS_LOG_VISCOSITY,
        houpert_log_viscosity(law, 0.0, T_s) - ROELANDS_LOG_VISCOSITY,
        houpert_temperature_coefficient(law, reduced_log, T_s),
        oil.conductivity,
        oil.tau0,
        state.film_thickness,
        state.sliding_speed,
        state.shear_stress / oil.tau0,
        limiting_stress,
        shear_modulus,
        state.entrainment_speed,
        half_width,
    )
