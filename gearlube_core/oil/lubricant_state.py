"""An oil for kernels: its data as floats, and its properties at one temperature."""

from __future__ import annotations

from typing import Any, NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import FORMULA_LAWS, OilLaws, alpha_at, law_at, mean_slope
from gearlube_core.oil.pressure_factor import (
    PressureFactor,
    film_coefficient,
    modulus_at,
    slope_turn,
)
from gearlube_core.oil.roelands_1966 import pressure_viscosity_coefficient
from gearlube_core.oil.walther_1931 import walther_viscosity

CONTACT_PRESSURE = 1e9  # Pa, where a local Eyring stress is taken as the oil's one number


class LubricantParameters(NamedTuple):
    """Properties of a lubricant for the kernels; all floats, SI."""

    walther_a: float  # [-]
    walther_b: float  # [-]
    density: float  # [kg/m3]
    roelands_z: float  # [-]
    alpha_share: float  # alpha of films over the slope of ln eta by Roelands [-]
    tau0: float  # Eyring stress [Pa]
    eyring_slope: float  # Lambda of a local one [-]; 0: tau0
    tau_l0: float  # limiting shear stress at zero pressure [Pa]
    gamma: float  # boundary friction: slope of limiting shear stress with pressure [-]
    conductivity: float  # at conductivity_temperature [W/(m K)]
    conductivity_temperature: float  # [K]
    conductivity_slope: float  # [W/(m K2)]
    heat_capacity: float  # [J/(kg K)]
    factor: PressureFactor


class LubricantState(NamedTuple):
    """Properties of a lubricant at one temperature and atmospheric pressure."""

    eta0: float  # dynamic viscosity [Pa s]
    alpha: float  # pressure-viscosity coefficient of films [1/Pa]
    beta: float  # -d ln eta0 / dT [1/K]
    nu: float  # kinematic viscosity [m2/s]
    tau0: float  # Eyring stress [Pa]; of a local one that at 1 GPa
    tau_l0: float  # limiting shear stress at zero pressure [Pa]
    gamma: float  # boundary friction [-]
    conductivity: float  # [W/(m K)]
    temperature: float  # of the oil [K]
    volume_heat: float  # heat capacity by volume [J/(m3 K)]
    slope: float  # of ln eta at ambient pressure by Roelands, with the same alpha [1/Pa]
    modulus: float = 0.0  # A of the pressure factor [Pa]; 0: the law of each formula
    modulus_slope: float = 0.0  # B [-]
    eyring_slope: float = 0.0  # Lambda of a local Eyring stress [-]; 0: tau0 at all pressures
    modulus_turn: float = 0.0  # dA/dT [Pa/K]
    slope_turn: float = 0.0  # dB/dT [1/K]
    viscosity: Any = FORMULA_LAWS.viscosity  # law over pressure, see `formula_laws`
    shear: Any = FORMULA_LAWS.shear  # law of shear, likewise


@kernel
def lubricant_state(
    parameters: LubricantParameters, temperature: float, laws: OilLaws = FORMULA_LAWS
) -> LubricantState:
    """Return the properties of a lubricant at a temperature.

    eta0 = rho nu(T);  alpha = 5.1e-9 s Z (ln eta0 + 9.67) at constant Z and share s, or that of
    the pressure factor;
    K = K_ref + dK/dT (T - T_ref)

    Parameters
    ----------
    parameters
        Of one lubricant, from `Lubricant.parameters()`.
    temperature
        Absolute oil temperature [K].
    laws
        Of the same lubricant, from `Lubricant.own_laws`, if it has any.

    Returns
    -------
    LubricantState
        Numbers of the oil, in SI units.

    Notes
    -----
    Range: the temperature range of the lubricant, not checked here. Density is constant.
    """
    nu, beta = walther_viscosity(parameters.walther_a, parameters.walther_b, temperature)
    eta0 = parameters.density * nu
    alpha = parameters.alpha_share * pressure_viscosity_coefficient(eta0, parameters.roelands_z)
    A, B = modulus_at(parameters.factor, temperature)
    if A > 0.0:
        alpha = film_coefficient(A, B)
    law = law_at(laws.viscosity, eta0, alpha)
    alpha = alpha_at(law, alpha)
    tau0, Lambda = parameters.tau0, parameters.eyring_slope
    if Lambda > 0.0:
        tau0 = 2.0 * Lambda * (A + B * CONTACT_PRESSURE if A > 0.0 else 1.0 / alpha)
    offset = temperature - parameters.conductivity_temperature
    conductivity = parameters.conductivity + parameters.conductivity_slope * offset
    return LubricantState(
        eta0,
        alpha,
        beta,
        nu,
        tau0,
        parameters.tau_l0,
        parameters.gamma,
        conductivity,
        temperature,
        parameters.density * parameters.heat_capacity,
        alpha / parameters.alpha_share,
        A,
        B,
        Lambda,
        parameters.factor.a2,
        slope_turn(parameters.factor, temperature, B),
        law,
        laws.shear,
    )


@kernel
def eyring_stress_under(oil: LubricantState, p: float) -> float:
    """Return the Eyring stress at a mean pressure above zero [Pa].

    tau_E = 2 Lambda p/ln(eta/eta0), or the oil's one number

    Notes
    -----
    eta by the law that a formula takes. Source: [bair_winer_1990], as quoted by [arana_2019 (12)].

    Examples
    --------
    >>> from gearlube_core.oil.oil_file import read_oil
    >>> oil = read_oil("iso_vg_220_pao").lubricant.state(353.15)
    >>> round(1e-6 * eyring_stress_under(oil, 1e9), 1)  # MPa at 1 GPa and 80 degC
    8.2
    """
    if oil.eyring_slope == 0.0:
        return oil.tau0
    return 2.0 * oil.eyring_slope / mean_slope(oil.viscosity, oil, p)
