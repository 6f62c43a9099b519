"""Building the oil of a film: from numbers and laws, or from a lubricant at a temperature."""

from __future__ import annotations

import math
from typing import Any

from gearlube_core.checks import check_finite, check_option, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.oil.eyring_1936 import NEWTONIAN, Eyring
from gearlube_core.oil.film_laws import (
    DOWSON_HIGGINSON_1966,
    INCOMPRESSIBLE,
    barus,
    density_ratio,
    log_viscosity,
    rate_ratio,
    roelands,
)
from gearlube_core.oil.film_oil import FilmOil, viscosity_cooling
from gearlube_core.oil.houpert_1985 import houpert_log_viscosity, houpert_parameters
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_heat import OilHeat
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE, ROELANDS_KAPPA, ROELANDS_PRESSURE

_MINERAL = OilHeat()

VISCOSITY_LAWS = ("barus", "roelands", "houpert")
DENSITY_LAWS = {"dowson_higginson": DOWSON_HIGGINSON_1966, "incompressible": INCOMPRESSIBLE}


def film_oil(
    *,
    eta0: float,
    alpha: float | None = None,
    law: Any = "roelands",
    density_law: Any = "dowson_higginson",
    shear_law: Any = None,
    rho0: float = 870.0,
    eyring_stress: float | None = None,
    limiting_shear: tuple[float, float] | None = None,
    temperature: float = 313.15,
    temperature_exponent: float = 0.0,
    heat: OilHeat = _MINERAL,
) -> FilmOil:
    """Return the oil of a film from its numbers and laws; `film_oil_of` takes a library oil.

    Parameters
    ----------
    eta0 : float
        Viscosity at ambient pressure [Pa s]; above 63.15e-6 Pa s for Roelands.
    alpha : float, optional
        Pressure-viscosity coefficient [1/Pa], 0 for constant viscosity. Leave it out with a
        viscosity law of your own, which has its own coefficient.
    law : {"barus", "roelands", "houpert"} or viscosity law
        Law of viscosity over pressure. Houpert is Roelands with `temperature_exponent` above zero.
    density_law : {"dowson_higginson", "incompressible"} or density law
        Law of density over pressure.
    shear_law : shear law, optional
        Shear law used instead of `eyring_stress`.
    rho0 : float
        Density [kg/m3].
    eyring_stress : float, optional
        tau0 of Eyring's law [Pa]; without it and `shear_law` the oil is Newtonian.
    limiting_shear : tuple of float, optional
        Limiting shear stress at ambient pressure [Pa] and its slope with pressure [-].
    temperature : float
        Temperature of the oil at the inlet [K].
    temperature_exponent : float
        S0 of Houpert [-], used by thermal solutions only.
    heat : OilHeat
        Thermal expansion, conductivity and heat capacity, used by thermal solutions only.

    Returns
    -------
    FilmOil

    Raises
    ------
    ParameterError
        A number is out of range, given twice or missing.

    Examples
    --------
    >>> oil = film_oil(eta0=0.00625, alpha=13.3e-9)
    >>> round(oil.viscosity.Z, 4)
    0.5676
    >>> from gearlube_core.oil.oil_heat import OilHeat
    >>> hot = film_oil(eta0=0.04, alpha=2e-8, law="houpert", temperature_exponent=1.1,
    ...                heat=OilHeat(expansion=6.5e-4))
    >>> hot.expansion, hot.conductivity
    (0.00065, 0.14)
    """
    lowest = 1.0001 * ROELANDS_KAPPA if law in ("roelands", "houpert") else 0.0
    check_positive("eta0", eta0, "Pa s", "20 cP is 0.02 Pa s.")
    check_within("eta0", eta0, lowest, 1e4, "Pa s", "20 cP is 0.02 Pa s.")
    check_within("rho0", rho0, 100.0, 3000.0, "kg/m3", "0.87 g/cm3 is 870 kg/m3.")
    check_within("temperature", temperature, GLASS_TEMPERATURE + 1.0, 1000.0, "K")
    check_within("temperature_exponent", temperature_exponent, 0.0, 5.0)
    if law != "houpert" and temperature_exponent > 0.0:
        raise ParameterError(
            f"law must be houpert if temperature_exponent is above 0, got {law} and "
            f"{temperature_exponent:g}. Take houpert, or leave the exponent out."
        )
    limit, slope = (0.0, 0.0) if limiting_shear is None else limiting_shear
    check_within("limiting_shear[0]", limit, 0.0, 1e10, "Pa", "5 MPa is 5e6 Pa.")
    check_within("limiting_shear[1]", slope, 0.0, 1.0)
    return FilmOil(
        eta0=float(eta0),
        rho0=float(rho0),
        viscosity=_viscosity_law(law, eta0, alpha, temperature_exponent),
        density=_density_law(density_law),
        shear=_shear_law(shear_law, eyring_stress),
        tau_limit=float(limit),
        limit_slope=float(slope),
        temperature=float(temperature),
        expansion=float(heat.expansion),
        conductivity=float(heat.conductivity),
        heat_capacity=float(heat.heat_capacity),
    )


def _viscosity_law(law: Any, eta0: float, alpha: float | None, S0: float) -> Any:
    if not isinstance(law, str):
        if alpha is not None:
            raise ParameterError(
                "alpha must be left out with a viscosity law of your own, which has its own "
                f"coefficient, got {alpha:g} 1/Pa."
            )
        _check_law("law", law, "log_viscosity")
        _check_start("ln(eta/eta0)", log_viscosity(law, 0.0, 1.0)[0], 0.0)
        return law
    check_option("law", law, VISCOSITY_LAWS)
    if alpha is None:
        raise ParameterError(f"alpha is missing; the law {law} needs it. 20 1/GPa is 2e-8 1/Pa.")
    check_within("alpha", alpha, 0.0, 1e-6, "1/Pa", "20 1/GPa is 2e-8 1/Pa.")
    return barus(alpha) if law == "barus" else roelands(eta0, alpha, S0)


def _density_law(law: Any) -> Any:
    if isinstance(law, str):
        check_option("density_law", law, DENSITY_LAWS)
        return DENSITY_LAWS[law]
    _check_law("density_law", law, "density_ratio")
    _check_start("rho/rho0", density_ratio(law, 0.0)[0], 1.0)
    return law


def _shear_law(law: Any, eyring_stress: float | None) -> Any:
    if law is None:
        if eyring_stress is None:
            return NEWTONIAN
        return Eyring(
            float(check_within("eyring_stress", eyring_stress, 1e4, 1e12, "Pa", "5 MPa is 5e6 Pa."))
        )
    if eyring_stress is not None:
        raise ParameterError(
            f"eyring_stress must be left out if shear_law is given, got {eyring_stress:g} Pa."
        )
    _check_law("shear_law", law, "rate_ratio")
    check_positive("tau0 of the shear law", law.tau0, "Pa", "5 MPa is 5e6 Pa.")
    _check_start("G = rate_ratio", rate_ratio(law, 0.0)[0], 1.0)
    return law


def _check_law(name: str, law: Any, kernel_name: str) -> None:
    if not (isinstance(law, tuple) and hasattr(type(law), kernel_name)):
        raise ParameterError(
            f"{name} must be a NamedTuple with the kernel {kernel_name}, got {law!r}."
        )


def _check_start(what: str, value: float, expected: float) -> None:
    if not abs(check_finite(what, value) - expected) < 1e-12:
        raise ParameterError(f"{what} must be {expected:g} at zero, got {value:g}.")


def film_oil_of(
    lubricant: Lubricant,
    temperature: float,
    *,
    law: str = "roelands",
    density_law: Any = "dowson_higginson",
    newtonian: bool = False,
    limiting_shear: bool = False,
) -> FilmOil:
    """Return the oil of a film from a lubricant and its temperature.

    Parameters
    ----------
    lubricant : Lubricant
        Oil of the library or from a data sheet.
    temperature : float
        Temperature at the inlet [K], within the range of the oil.
    law, density_law
        As in `film_oil`; the viscosity law by its name.
    newtonian : bool
        True: leave the Eyring stress out.
    limiting_shear : bool
        True: limit the shear stress to tau_l0 + gamma p, the strength of the oil's boundary layer.

    Returns
    -------
    FilmOil

    Raises
    ------
    ParameterError
        The temperature is outside the oil's range, or a law is not known.

    Notes
    -----
    The pressure coefficient follows from a constant Roelands exponent. With "houpert" the viscosity
    is that of Houpert's law through 40 and 100 degC, within 3 % of Walther's line.

    Examples
    --------
    >>> oil = film_oil_of(Lubricant.named("karagiannis_2012"), 353.15)  # at 80 degC
    >>> round(oil.eta0, 4)  # Pa s
    0.0239
    """
    check_option("law", law, VISCOSITY_LAWS)
    eta0 = lubricant.dynamic_viscosity(temperature)
    S0 = 0.0
    if law == "houpert":
        fit = houpert_parameters(lubricant)
        # the law's own constant 9.67 and kappa agree to 4e-5
        eta0 = ROELANDS_KAPPA * math.exp(houpert_log_viscosity(fit, 0.0, temperature))
        S0 = fit.S0
    alpha = ROELANDS_PRESSURE * lubricant.roelands_z * math.log(eta0 / ROELANDS_KAPPA)
    offset = temperature - lubricant.conductivity_temperature
    return film_oil(
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
        heat=OilHeat(
            conductivity=lubricant.conductivity + lubricant.conductivity_slope * offset,
            heat_capacity=lubricant.heat_capacity,
        ),
    )


def check_warms(oil: FilmOil) -> None:
    """Refuse an oil whose viscosity does not fall with temperature, for a solution with heat."""
    if viscosity_cooling(oil, 0.0, oil.temperature) == 0.0:
        raise ParameterError(
            "The viscosity of the oil must fall with temperature in a thermal film, but its "
            "temperature_exponent is 0. Take law houpert and give temperature_exponent; with an "
            "oil of the library leave both out."
        )


def jamali_2015_oil(*, newtonian: bool = False) -> FilmOil:
    """Return the oil of Jamali 2015: 0.00625 Pa s, 13.3 1/GPa, Eyring stress 10 MPa."""
    return film_oil(eta0=0.00625, alpha=13.3e-9, eyring_stress=None if newtonian else 10.0e6)
