"""Mixed friction of a flank: Grubin film, thermal Eyring traction, asperities."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import (
    SurfaceParameters,
    asperity_area_factor,
    asperity_integrals,
    asperity_load_factor,
)
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film.grubin_1949 import (
    GrubinConvention,
    grubin_film_thickness,
    inlet_heating_factor,
)
from gearlube_core.friction.evans_johnson_1986 import solid_resistance
from gearlube_core.friction.flank import LOAD_FLOOR
from gearlube_core.friction.flank_data import ContactGeometry
from gearlube_core.friction.johnson_greenwood_1980 import (
    CONVERGED,
    NOT_CONVERGED,
    thermal_eyring_film_near,
    thermal_newtonian_stress,
)
from gearlube_core.friction.mixed_friction import (
    BOUNDARY_SPEED,
    SPEED_FLOOR,
    contact_temperature_rise,
)
from gearlube_core.friction.thermal_eyring_data import (
    EFFECTIVE,
    INLET_SHEAR_HEATING,
    ThermalEyringOil,
    ThermalEyringOptions,
    ThermalFlankState,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.houpert_1985 import (
    HoupertParameters,
    houpert_log_viscosity,
    houpert_temperature_coefficient,
)
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY, ROELANDS_PRESSURE

SEARCH_ITERATIONS = 40
SEARCH_TOLERANCE = 1.0e-3  # K, of the last step; the error after a secant step is far smaller
_LARGEST_OVER_MEAN = 1.5  # Hertz pressure


class FilmTraction(NamedTuple):
    """Stresses and temperatures of a flank at a given film."""

    Y: float  # of the film [-]
    log_viscosity: float  # ln eta at contact pressure and surface temperature
    beta: float  # [1/K]
    stress_ratio: float  # [-]
    viscosity_ratio: float  # [-]
    rise_centre: float  # [K]
    rise_effective: float  # [K]
    flash: float  # [K]
    area_share: float  # A_a/A [-]
    load_share: float  # W_a/A [Pa]
    boundary_stress: float  # F_b/A [Pa]
    status: float


@kernel
def bracketed_secant_step(
    x: float, g: float, x_old: float, g_old: float, low: float, high: float
) -> float:
    """Return the next trial of a secant search kept inside a bracket."""
    trial = x - g * (x - x_old) / (g - g_old) if g != g_old else low - 1.0
    if not low <= trial <= high:
        trial = 0.5 * (low + high)
    return trial


@kernel
def film_traction(
    film_thickness: float,
    pressure: float,
    sliding_speed: float,
    surface_resistance: float,
    flash_start: float,
    Y_start: float,
    oil: ThermalEyringOil,
    surface: SurfaceParameters,
    contact_modulus: float,
) -> FilmTraction:
    """Return stresses and temperatures of a flank at a given film.

    flash = R [tau (1 - A_a/A) + F_b/A] |dU|

    Parameters
    ----------
    film_thickness
        h [m].
    pressure
        Mean contact pressure [Pa].
    sliding_speed
        dU [m/s], either sign.
    surface_resistance
        R, rise of both surfaces over heat flux [m2 K/W]; 0: surfaces at oil temperature.
    flash_start, Y_start
        Where to begin the search: flash [K] and Y [-] of a similar film, or zeros.
    oil
        Oil at the inlet temperature.
    surface
        Roughness of the pair.
    contact_modulus
        E* [Pa].

    Returns
    -------
    FilmTraction

    Notes
    -----
    tau falls with flash, so the solution lies between any trial and the rise that the stress at
    that trial would give. The viscosity falls from that at the heated surfaces.
    Source: [karagiannis_2012 (24)], which has tau0 for tau_l0, the strength of asperity junctions;
    the tanh lets boundary friction fade with the sliding speed.
    """
    law = HoupertParameters(oil.log_viscosity, oil.temperature, oil.S0, oil.Z)
    slip = abs(sliding_speed)
    F_2, F_5_2 = asperity_integrals(film_thickness / surface.sigma)
    area_share = asperity_area_factor(surface) * F_2
    load_share = min(asperity_load_factor(surface) * contact_modulus * F_5_2, pressure)
    boundary = (oil.tau_l0 * area_share + oil.gamma * load_share) * math.tanh(slip / BOUNDARY_SPEED)
    per_stress = surface_resistance * slip
    flash = flash_start if per_stress > 0.0 else 0.0
    Y = Y_start
    flash_old, gap_old, low, high = flash, 0.0, 0.0, math.inf
    status = CONVERGED if per_stress == 0.0 else NOT_CONVERGED
    for iteration in range(SEARCH_ITERATIONS):
        T_s = oil.temperature + flash
        reduced_log = houpert_log_viscosity(law, pressure, T_s)
        beta = houpert_temperature_coefficient(law, reduced_log, T_s)
        log_viscosity = reduced_log - ROELANDS_LOG_VISCOSITY
        film = thermal_eyring_film_near(
            Y, log_viscosity, beta, oil.conductivity, oil.tau0, film_thickness, slip
        )
        Y = film.Y
        if status == CONVERGED:
            break
        stress = film.stress_ratio * oil.tau0 * (1.0 - area_share) + boundary
        gap = flash - per_stress * stress
        if gap > 0.0:
            low, high = max(low, flash - gap), min(high, flash)
        else:
            low, high = max(low, flash), min(high, flash - gap)
        if iteration == 0:
            # Eyring films lose about tau0 for each e-fold of viscosity
            trial = flash - gap / (1.0 + per_stress * oil.tau0 * beta)
        else:
            trial = bracketed_secant_step(flash, gap, flash_old, gap_old, low, high)
        flash_old, gap_old = flash, gap
        flash = trial
        if abs(flash - flash_old) <= SEARCH_TOLERANCE:
            status = CONVERGED
    if film.status != CONVERGED:
        status = NOT_CONVERGED
    return FilmTraction(
        film.Y,
        log_viscosity,
        beta,
        film.stress_ratio,
        film.viscosity_ratio,
        film.rise_centre,
        film.rise_effective,
        flash,
        area_share,
        load_share,
        boundary,
        status,
    )


@kernel
def _film(
    rise: float,
    load: float,
    speed: float,
    geometry: ContactGeometry,
    oil: ThermalEyringOil,
    options: ThermalEyringOptions,
) -> tuple[float, float, float]:
    """Return film thickness [m], viscosity [Pa s] and ln eta + 9.67 of oil warmer by `rise` [K]."""
    law = HoupertParameters(oil.log_viscosity, oil.temperature, oil.S0, oil.Z)
    reduced_log = houpert_log_viscosity(law, 0.0, oil.temperature + rise)
    eta = math.exp(reduced_log - ROELANDS_LOG_VISCOSITY)
    alpha = ROELANDS_PRESSURE * oil.Z * reduced_log
    convention = GrubinConvention(options.coefficient, options.modulus)
    h = grubin_film_thickness(geometry.R_e, geometry.side_flow, eta, alpha, speed, load, convention)
    return h, eta, reduced_log


@kernel
def thermal_eyring_flank(
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    oil: ThermalEyringOil,
    surface: SurfaceParameters,
    solid: SolidParameters,
    options: ThermalEyringOptions,
) -> ThermalFlankState:
    """Return film, friction and temperatures of one flank contact.

    F_v = tau (A - A_a),  F_b = tau_l0 A_a + gamma W_a,  A = W/p_mean

    Parameters
    ----------
    load
        Normal load W [N]; not positive: no friction.
    entrainment_speed
        Mean surface speed [m/s], either sign: the entrainment arm times the pinion speed, or u
        of `flank_speeds` as Karagiannis et al. 2012 print it.
    sliding_speed
        Relative surface speed dU [m/s], either sign.
    geometry
        From `grubin_contact_geometry`.
    oil
        From `thermal_eyring_oil`.
    surface
        Roughness of the pair.
    solid
        Elastic and thermal data of the pair.
    options
        From `thermal_eyring_options`.

    Returns
    -------
    ThermalFlankState
        Friction forces are magnitudes; they oppose sliding. `status` 1: an iteration of flash or
        effective temperature did not settle.

    Notes
    -----
    Ranges: those of `grubin_film_thickness`, `thermal_eyring_film` (uniform mean pressure) and
    `asperity_load`. W_a is at most W, and the boundary term carries tanh(|dU|/1 mm/s), so that
    friction passes through zero with sliding; the paper states neither. The flash temperature
    is `contact_temperature_rise` of a moving source without its film part, with all friction as
    heat. The effective film temperature counts from the heated surfaces.
    Source: [karagiannis_2012 (23)]
    """
    F = max(load, 0.0)
    F_film = max(F, LOAD_FLOOR)
    speed = max(abs(entrainment_speed), SPEED_FLOOR)
    slip = abs(sliding_speed)
    E_star = solid.contact_modulus
    p = geometry.pressure_coefficient * math.exp(math.log(F_film) / 3.0)
    area = F / p

    surface_resistance = 0.0
    if options.flash > 0.0:
        resistance = solid_resistance(
            geometry.R_e,
            p,
            speed,
            2.0 * E_star,
            solid.conductivity * solid.density * solid.heat_capacity,
        )
        surface_resistance = contact_temperature_rise(
            1.0, 0.0, F_film / p, resistance, oil.conductivity, solid.conductivity
        )

    h, eta_in, reduced_log = _film(0.0, F_film, speed, geometry, oil, options)
    if options.film_temperature == INLET_SHEAR_HEATING:
        law = HoupertParameters(oil.log_viscosity, oil.temperature, oil.S0, oil.Z)
        h *= inlet_heating_factor(
            eta_in,
            houpert_temperature_coefficient(law, reduced_log, oil.temperature),
            oil.conductivity,
            speed,
            slip,
            _LARGEST_OVER_MEAN * p,
            2.0 * E_star,
        )
    state = film_traction(h, p, slip, surface_resistance, 0.0, 0.0, oil, surface, E_star)
    status = state.status
    if options.film_temperature == EFFECTIVE:
        status = NOT_CONVERGED
        rise_old, gap_old = 0.0, -(state.flash + state.rise_effective)
        # a thinner film is cooler inside but rubs more, so that the hot film's rise may be the
        # higher one, though by far less than twice
        low, high = 0.0, -2.0 * gap_old
        rise = -0.9 * gap_old
        for _ in range(SEARCH_ITERATIONS):
            h, eta_in, _log = _film(rise, F_film, speed, geometry, oil, options)
            state = film_traction(
                h, p, slip, surface_resistance, state.flash, state.Y, oil, surface, E_star
            )
            if abs(rise - rise_old) <= SEARCH_TOLERANCE:
                status = state.status
                break
            gap = rise - state.flash - state.rise_effective
            if gap > 0.0:
                high = min(high, rise)
            else:
                low = max(low, rise)
                high = max(high, rise - 2.0 * gap)
            trial = bracketed_secant_step(rise, gap, rise_old, gap_old, low, high)
            rise_old, gap_old = rise, gap
            rise = trial

    tau = state.stress_ratio * oil.tau0
    newtonian = thermal_newtonian_stress(state.log_viscosity, state.beta, oil.conductivity, h, slip)
    viscous = tau * (1.0 - state.area_share) * area
    boundary = state.boundary_stress * area
    return ThermalFlankState(
        h,
        h / surface.sigma,
        p,
        eta_in,
        math.exp(state.log_viscosity) * state.viscosity_ratio,
        tau,
        newtonian,
        state.rise_centre,
        state.rise_effective,
        state.flash,
        area,
        state.area_share * area,
        state.load_share * area,
        viscous,
        boundary,
        (viscous + boundary) / F_film,
        sliding_speed,
        entrainment_speed,
        status,
    )
