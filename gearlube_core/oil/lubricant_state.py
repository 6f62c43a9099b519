"""Lubricant properties at one oil temperature, evaluated once and used by every contact."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import LubricantParameters
from gearlube_core.oil.roelands_1966 import pressure_viscosity_coefficient
from gearlube_core.oil.walther_1931 import walther_viscosity


class LubricantState(NamedTuple):
    """Properties of a lubricant at one temperature and atmospheric pressure."""

    eta0: float  # dynamic viscosity [Pa s]
    alpha: float  # pressure-viscosity coefficient [1/Pa]
    beta: float  # -d ln eta0 / dT [1/K]
    nu: float  # kinematic viscosity [m2/s]
    tau0: float  # Eyring stress [Pa]
    tau_l0: float  # limiting shear stress at zero pressure [Pa]
    gamma: float  # boundary friction [-]
    conductivity: float  # [W/(m K)]
    temperature: float  # of the oil [K]
    volume_heat: float  # heat capacity by volume [J/(m3 K)]


@kernel
def lubricant_state(parameters: LubricantParameters, temperature: float) -> LubricantState:
    """Return the properties of a lubricant at a temperature.

    eta0 = rho nu(T);  alpha = 5.1e-9 Z (ln eta0 + 9.67) at constant Z;
    K = K_ref + dK/dT (T - T_ref)

    Parameters
    ----------
    parameters
        Of one lubricant, from `Lubricant.parameters()`.
    temperature
        Absolute oil temperature [K].

    Returns
    -------
    LubricantState
        SI throughout.

    Notes
    -----
    Range: the temperature range of the lubricant, not checked here. Density is constant.
    """
    nu, beta = walther_viscosity(parameters.walther_a, parameters.walther_b, temperature)
    eta0 = parameters.density * nu
    alpha = pressure_viscosity_coefficient(eta0, parameters.roelands_z)
    offset = temperature - parameters.conductivity_temperature
    conductivity = parameters.conductivity + parameters.conductivity_slope * offset
    return LubricantState(
        eta0,
        alpha,
        beta,
        nu,
        parameters.tau0,
        parameters.tau_l0,
        parameters.gamma,
        conductivity,
        temperature,
        parameters.density * parameters.heat_capacity,
    )
