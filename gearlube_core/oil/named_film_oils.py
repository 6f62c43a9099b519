"""Lubricants of films by name: those of the library, and that of Jamali 2015."""

from __future__ import annotations

import math

from gearlube_core.checks import check_option
from gearlube_core.oil.film_oil import (
    ROELANDS_CHI,
    ROELANDS_KAPPA,
    VISCOSITY_LAWS,
    EhlLubricant,
    ehl_lubricant,
)
from gearlube_core.oil.houpert_1985 import houpert_log_viscosity, houpert_parameters
from gearlube_core.oil.lubricant import Lubricant


def lubricant_from_library(
    lubricant: Lubricant,
    temperature: float,
    *,
    law: str = "roelands",
    density_law: str = "dowson_higginson",
    newtonian: bool = False,
    limiting_shear: bool = False,
) -> EhlLubricant:
    """Return the film's data of an oil of the library at a temperature.

    Parameters
    ----------
    lubricant : Lubricant
        From the library or a data sheet.
    temperature : float
        At the inlet [K], within the range of the oil.
    law, density_law : str
        As in `ehl_lubricant`.
    newtonian : bool
        True: leave the Eyring stress out.
    limiting_shear : bool
        True: limit the shear stress at tau_l0 + gamma p of the oil's junctions.

    Returns
    -------
    EhlLubricant

    Raises
    ------
    ParameterError
        When the temperature is outside the oil's range or a law is not known.

    Notes
    -----
    The pressure coefficient follows from a constant Roelands exponent. With "houpert" the
    viscosity is that of the law through 40 and 100 degC, within 3 % of Walther's line.
    """
    check_option("law", law, VISCOSITY_LAWS)
    eta0 = lubricant.dynamic_viscosity(temperature)
    S0 = 0.0
    if law == "houpert":
        fit = houpert_parameters(lubricant)
        # the law's own constant 9.67 and kappa agree to 4e-5
        eta0 = ROELANDS_KAPPA * math.exp(houpert_log_viscosity(fit, 0.0, temperature))
        S0 = fit.S0
    alpha = ROELANDS_CHI * lubricant.roelands_z * math.log(eta0 / ROELANDS_KAPPA)
    offset = temperature - lubricant.conductivity_temperature
    return ehl_lubricant(
        eta0=eta0,
        alpha=alpha,
        law=law,
        density_law=density_law,
        rho0=lubricant.density,
        eyring_stress=None if newtonian else lubricant.eyring_stress,
        limiting_shear=(
            (lubricant.limiting_shear_stress, lubricant.boundary_friction)
            if limiting_shear
            else None
        ),
        temperature=temperature,
        temperature_exponent=S0,
        conductivity=lubricant.conductivity + lubricant.conductivity_slope * offset,
        heat_capacity=lubricant.heat_capacity,
    )


def jamali_2015_oil(*, newtonian: bool = False) -> EhlLubricant:
    """Return the oil of Jamali 2015: 0.00625 Pa s, 13.3 1/GPa, Eyring stress 10 MPa."""
    return ehl_lubricant(eta0=0.00625, alpha=13.3e-9, eyring_stress=None if newtonian else 10.0e6)
