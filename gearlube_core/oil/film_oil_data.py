"""Building the oil of a film: from numbers and laws, or from a lubricant at a temperature."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.oil.eyring_1936 import NEWTONIAN, Eyring
from gearlube_core.oil.film_laws import (
    DowsonHigginson,
    RoelandsHoupert,
    density_ratio,
    log_viscosity,
    rate_ratio,
)
from gearlube_core.oil.film_oil import LEAST_PRESSURE, FilmOil, viscosity_cooling
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.named_laws import DensityLaw, EyringShear, Newtonian, ShearLaw, ViscosityLaw
from gearlube_core.oil.oil_heat import HEAT_RISES, OilHeat
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE, ROELANDS_KAPPA, ROELANDS_PRESSURE

_MINERAL = OilHeat()


def film_oil(
    *,
    eta0: float,
    alpha: float | None = None,
    law: Any = "roelands",
    density_law: Any = "dowson_higginson",
    shear_law: Any = None,
    rho0: float = 870.0,
    eyring_stress: float | None = None,
    eyring_slope: float = 0.0,
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
    law : str, ViscosityLaw or viscosity law
        Law of viscosity over pressure: name of one that is registered ("barus", "roelands",
        "houpert"), such a law with its numbers, or a NamedTuple with its kernels. Houpert is
        Roelands with `temperature_exponent` above zero.
    density_law : str, DensityLaw or density law
        Law of density over pressure, likewise ("dowson_higginson", "incompressible").
    shear_law : str, ShearLaw or shear law, optional
        Shear law, likewise ("eyring", "newtonian"); a NamedTuple is used instead of
        `eyring_stress`.
    rho0 : float
        Density [kg/m3].
    eyring_stress : float, optional
        tau0 of Eyring's law [Pa]; without it, `eyring_slope` and `shear_law` the oil is Newtonian.
    eyring_slope : float
        Lambda of a local Eyring stress [-], see `stress_ratio`, 0.03 to 0.09 of most oils; the
        shear stress is then also limited to Lambda p. 0: `eyring_stress` everywhere.
    limiting_shear : tuple of float, optional
        Limiting shear stress at ambient pressure [Pa] and its slope with pressure [-]; without
        it 0 and `eyring_slope`.
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
    check_positive("eta0", eta0, "Pa s", "20 cP is 0.02 Pa s.")
    check_within("rho0", rho0, 100.0, 3000.0, "kg/m3", "0.87 g/cm3 is 870 kg/m3.")
    check_within("temperature", temperature, GLASS_TEMPERATURE + 1.0, 1000.0, "K")
    check_within("temperature_exponent", temperature_exponent, 0.0, 5.0)
    if temperature_exponent > 0.0:
        law = _warming_law(law, temperature_exponent)
    check_within("eyring_slope", eyring_slope, 0.0, 0.5)
    viscosity = _viscosity_law(law, eta0, alpha)
    if eyring_slope > 0.0:
        eyring_stress = _ambient_stress(eyring_slope, eyring_stress, viscosity)
    shear = _shear_law(shear_law, eyring_stress)
    Lambda = float(eyring_slope) if shear.tau0 > 0.0 else 0.0
    limit, slope = (0.0, Lambda) if limiting_shear is None else limiting_shear
    check_within("limiting_shear[0]", limit, 0.0, 1e10, "Pa", "5 MPa is 5e6 Pa.")
    check_within("limiting_shear[1]", slope, 0.0, 1.0)
    return FilmOil(
        eta0=float(eta0),
        rho0=float(rho0),
        viscosity=viscosity,
        density=_density_law(density_law, temperature),
        shear=shear,
        tau_limit=float(limit),
        limit_slope=float(slope),
        temperature=float(temperature),
        expansion=float(heat.expansion),
        conductivity=float(heat.conductivity),
        heat_capacity=float(heat.heat_capacity),
        eyring_slope=Lambda,
        heat_rise=HEAT_RISES[heat.under_pressure],
    )


def _ambient_stress(slope: float, stress: float | None, viscosity: Any) -> float:
    if stress is not None:
        raise ParameterError(
            f"eyring_stress must be left out if eyring_slope is above 0, got {stress:g} Pa and "
            f"{slope:g}. Give the one or the other."
        )
    grown = log_viscosity(viscosity, LEAST_PRESSURE, 1.0)[0]
    check_positive("alpha", grown, "", "A local Eyring stress needs viscosity that grows.")
    return 2.0 * slope * LEAST_PRESSURE / float(grown)


def _warming_law(law: Any, exponent: float) -> ViscosityLaw:
    if isinstance(law, str):
        law = ViscosityLaw.kind.named("law", law, {})
    if not (isinstance(law, ViscosityLaw) and hasattr(law, "temperature_exponent")):
        raise ParameterError(
            "law must be houpert if temperature_exponent is above 0, got "
            f"{law.name if isinstance(law, ViscosityLaw) else law} and {exponent:g}. Take houpert, "
            "or leave the exponent out."
        )
    warming: Any = replace(law, temperature_exponent=exponent)  # type: ignore[call-arg]
    return warming  # type: ignore[no-any-return]


def _viscosity_law(law: Any, eta0: float, alpha: float | None) -> Any:
    if isinstance(law, str):
        law = ViscosityLaw.kind.named("law", law, {})
    if isinstance(law, ViscosityLaw):
        check_within("eta0", eta0, law.least_viscosity, 1e4, "Pa s", "20 cP is 0.02 Pa s.")
        if alpha is None:
            raise ParameterError(
                f"alpha is missing; the law {law.name} needs it. 20 1/GPa is 2e-8 1/Pa."
            )
        check_within("alpha", alpha, 0.0, 1e-6, "1/Pa", "20 1/GPa is 2e-8 1/Pa.")
        law = law(eta0, alpha)
    elif alpha is not None:
        raise ParameterError(
            "alpha must be left out with a viscosity law of your own, which has its own "
            f"coefficient, got {alpha:g} 1/Pa."
        )
    if not isinstance(law, RoelandsHoupert):
        _check_law("law", law, "log_viscosity")
        _check_start("ln(eta/eta0)", log_viscosity(law, 0.0, 1.0)[0], 0.0)
    return law


def _density_law(law: Any, temperature: float) -> Any:
    if isinstance(law, str):
        law = DensityLaw.kind.named("density_law", law, {})
    if isinstance(law, DensityLaw):
        law = law.at(temperature)()
    if not isinstance(law, DowsonHigginson):
        _check_law("density_law", law, "density_ratio")
        _check_start("rho/rho0", density_ratio(law, 0.0)[0], 1.0)
    return law


def _shear_law(law: Any, eyring_stress: float | None) -> Any:
    if law is None:
        law = "newtonian" if eyring_stress is None else "eyring"
    if isinstance(law, str):
        law = ShearLaw.kind.named("shear_law", law, {})
    if isinstance(law, Newtonian):
        return NEWTONIAN
    if isinstance(law, ShearLaw):
        if eyring_stress is None and law.needs_stress:
            raise ParameterError(
                f"eyring_stress is missing; the shear law {law.name} needs it. 5 MPa is 5e6 Pa."
            )
        tau0 = 1e6 if eyring_stress is None else eyring_stress
        law = law(check_within("eyring_stress", tau0, 1e4, 1e12, "Pa", "5 MPa is 5e6 Pa."))
    elif eyring_stress is not None:
        raise ParameterError(
            "eyring_stress and eyring_slope must be left out with a shear law of your own, got an "
            f"Eyring stress of {eyring_stress:g} Pa."
        )
    if not isinstance(law, Eyring):
        _check_law("shear_law", law, "rate_ratio")
        _check_start("G = rate_ratio", rate_ratio(law, 0.0)[0], 1.0)
    check_positive("tau0 of the shear law", law.tau0, "Pa", "5 MPa is 5e6 Pa.")
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
    law: Any = None,
    density_law: Any = None,
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
        As in `film_oil`, but no NamedTuple for `law`; by default those of the lubricant, else
        "roelands" and "dowson_higginson".
    newtonian : bool
        True: leave the Eyring stress out.
    limiting_shear : bool
        True: limit the shear stress to tau_l0 + gamma p, the strength of the oil's boundary layer;
        else an oil with an `eyring_slope` Lambda limits it to Lambda p.

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
    law = law or lubricant.viscosity_law or "roelands"
    if isinstance(law, str):
        law = ViscosityLaw.kind.named("law", law, {})
    law, eta0 = law.at(lubricant, temperature)
    alpha = ROELANDS_PRESSURE * lubricant.roelands_z * math.log(eta0 / ROELANDS_KAPPA)
    offset = temperature - lubricant.conductivity_temperature
    limit = None
    Lambda = 0.0 if newtonian else float(lubricant.eyring_slope)
    if not isinstance(lubricant.shear_law, EyringShear | Newtonian | None):
        limit, Lambda = (0.0, Lambda), 0.0  # its unit of stress is one number
    if limiting_shear:
        limit = float(lubricant.limiting_shear_stress), float(lubricant.boundary_friction)
    return film_oil(
        eta0=eta0,
        alpha=alpha,
        law=law,
        density_law=density_law or lubricant.density_law or "dowson_higginson",
        shear_law=None if newtonian else lubricant.shear_law,
        rho0=lubricant.density,
        eyring_stress=None if newtonian or Lambda else lubricant.eyring_stress,
        eyring_slope=Lambda,
        limiting_shear=limit,
        temperature=temperature,
        heat=OilHeat(
            conductivity=lubricant.conductivity + lubricant.conductivity_slope * offset,
            heat_capacity=lubricant.heat_capacity,
            under_pressure=lubricant.heat_under_pressure,
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
