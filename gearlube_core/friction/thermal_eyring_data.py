"""Input and output data of a flank with a thermal Eyring film."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.checks import check_option
from gearlube_core.contact.hertz import hertz_coefficients
from gearlube_core.film.grubin_1949 import grubin_convention, grubin_geometry
from gearlube_core.friction.flank_data import ContactGeometry
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.houpert_1985 import HoupertParameters, houpert_log_viscosity
from gearlube_core.oil.lubricant_state import CONTACT_PRESSURE, LubricantParameters

INLET, EFFECTIVE, INLET_SHEAR_HEATING = 0.0, 1.0, 2.0
FILM_TEMPERATURES = {
    "inlet": INLET,
    "effective": EFFECTIVE,
    "inlet_shear_heating": INLET_SHEAR_HEATING,
}
ELLIPTICAL, CIRCULAR = 0.0, 1.0
PRESSURES = {"elliptical": ELLIPTICAL, "circular": CIRCULAR}


class ThermalEyringOil(NamedTuple):
    """A lubricant with the viscosity law of Houpert at one inlet temperature; all floats, SI."""

    log_viscosity: float  # ln eta + 9.67 at inlet temperature and atmospheric pressure [-]
    temperature: float  # of the oil at the inlet [K]
    S0: float  # temperature exponent [-]
    Z: float  # pressure exponent [-]
    tau0: float  # Eyring stress [Pa]
    tau_l0: float  # shear strength of asperity junctions at zero pressure [Pa]
    gamma: float  # boundary friction m: slope of that strength with pressure [-]
    conductivity: float  # [W/(m K)]


class ThermalEyringOptions(NamedTuple):
    """Choices that Karagiannis et al. 2012 leave open; floats."""

    coefficient: float  # of the film, `grubin_convention` [-]
    modulus: float  # of the load group of the film [Pa]
    film_temperature: float  # INLET, EFFECTIVE or INLET_SHEAR_HEATING
    flash: float  # 0: surfaces at oil temperature; 1: heated by friction


class ThermalFlankState(NamedTuple):
    """Film and friction of one flank; all floats, SI, magnitudes except the two speeds."""

    film_thickness: float  # h [m]
    film_ratio: float  # h over composite roughness [-]
    mean_pressure: float  # [Pa]
    inlet_viscosity: float  # of the film formula, atmospheric pressure [Pa s]
    effective_viscosity: float  # that of a uniform film with the same slip and tau* [Pa s]
    shear_stress: float  # tau [Pa]
    newtonian_stress: float  # of a thermal film without Eyring stress [Pa]
    rise_centre: float  # middle of the film over the surfaces [K]
    rise_effective: float  # over the surfaces [K]
    flash: float  # surfaces over the oil [K]
    area: float  # contact area A [m2]
    asperity_area: float  # A_a [m2]
    asperity_load: float  # W_a [N]
    viscous_friction: float  # F_v [N]
    boundary_friction: float  # F_b [N]
    friction_coefficient: float  # (F_v + F_b)/W [-]
    sliding_speed: float  # dU [m/s]
    entrainment_speed: float  # mean speed of the surfaces [m/s]
    status: float  # 0 converged, 1 not


def thermal_eyring_options(
    contact_modulus: float,
    film: str = "consistent",
    film_temperature: str = "inlet",
    flash: bool = False,
) -> ThermalEyringOptions:
    """Return the options of `thermal_eyring_flank` by name.

    Parameters
    ----------
    contact_modulus : float
        E* [Pa].
    film : {"consistent", "as_printed"}
        See `grubin_convention`.
    film_temperature : {"inlet", "effective", "inlet_shear_heating"}
        "inlet": oil temperature; "effective": effective temperature of the sheared film,
        Karagiannis et al. 2012; "inlet_shear_heating": oil temperature and
        `inlet_heating_factor`.
    flash : bool
        Whether friction heats the surfaces. Without, they stay at oil temperature, as in
        Karagiannis et al. 2012.

    Raises
    ------
    ParameterError
    """
    check_option("film_temperature", film_temperature, FILM_TEMPERATURES)
    convention = grubin_convention(film, contact_modulus)
    return ThermalEyringOptions(
        *convention, FILM_TEMPERATURES[film_temperature], 1.0 if flash else 0.0
    )


@kernel
def thermal_eyring_oil(
    law: HoupertParameters, parameters: LubricantParameters, temperature: float
) -> ThermalEyringOil:
    """Return the oil at an inlet temperature [K].

    Parameters
    ----------
    law
        From `houpert_parameters`.
    parameters
        Of the same oil, from `Lubricant.parameters()`: stresses and conductivity.
    temperature
        [K].

    Returns
    -------
    ThermalEyringOil

    Notes
    -----
    Table 2 of Karagiannis et al. 2012 lacks the Eyring stress; the library completes it. A local
    Eyring stress is that at 1 GPa.
    """
    offset = temperature - parameters.conductivity_temperature
    tau0, log_viscosity = parameters.tau0, houpert_log_viscosity(law, 0.0, temperature)
    if parameters.eyring_slope > 0.0:
        grown = houpert_log_viscosity(law, CONTACT_PRESSURE, temperature) - log_viscosity
        tau0 = 2.0 * parameters.eyring_slope * CONTACT_PRESSURE / grown
    return ThermalEyringOil(
        log_viscosity,
        temperature,
        law.S0,
        law.Z,
        tau0,
        parameters.tau_l0,
        parameters.gamma,
        parameters.conductivity + parameters.conductivity_slope * offset,
    )


@kernel
def circular_pressure_coefficient(R_x: float, R_y: float, contact_modulus: float) -> float:
    """Return mean Hertz pressure over load^(1/3) of a circle of radius sqrt(R_x R_y).

    p_mean = (2/3) [6 W E*^2/(pi^3 R_x R_y)]^(1/3)

    Parameters
    ----------
    R_x, R_y
        Relative principal radii of curvature [m].
    contact_modulus
        E* [Pa].

    Returns
    -------
    float
        [Pa/N^(1/3)].

    Notes
    -----
    [karagiannis_2012 (21)] prints (R_x R_y)^(1/2), which is not a pressure. With
    R_x R_y it is W/A of the area printed with [karagiannis_2012 (23)]. Below `hertz_coefficients`
    by 27 % at R_y/R_x = 50.
    """
    return (
        2.0
        / 3.0
        * (6.0 * contact_modulus * contact_modulus / (math.pi**3 * R_x * R_y)) ** (1.0 / 3.0)
    )


@kernel
def grubin_contact_geometry(
    R_x: float, R_y: float, angle: float, contact_modulus: float, pressure: float
) -> ContactGeometry:
    """Return the geometry numbers of a flank for `thermal_eyring_flank`.

    Parameters
    ----------
    R_x, R_y
        Relative principal radii of curvature along the minor and the major axis, R_x <= R_y [m].
    angle
        Between the speed that carries oil in and the minor axis [rad].
    contact_modulus
        E* [Pa].
    pressure
        ELLIPTICAL = 0: Hertz. CIRCULAR = 1: `circular_pressure_coefficient`.

    Returns
    -------
    ContactGeometry
        With psi^(2/3) of `grubin_geometry` as `side_flow`. Evaluate once per contact position.
    """
    R_e, leakage = grubin_geometry(R_x, R_y, angle)
    if pressure == CIRCULAR:
        coefficient = circular_pressure_coefficient(R_x, R_y, contact_modulus)
    else:
        coefficient = hertz_coefficients(R_x, R_y, contact_modulus)[2]
    return ContactGeometry(R_e, leakage, coefficient)
