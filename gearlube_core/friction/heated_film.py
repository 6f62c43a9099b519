"""Traction and temperatures of a flank at a given film: thermal Eyring shear, asperities, flash."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import (
    SurfaceParameters,
    asperity_area_factor,
    asperity_integrals,
    asperity_load_factor,
)
from gearlube_core.friction.johnson_greenwood_1980 import (
    CONVERGED,
    NOT_CONVERGED,
    thermal_eyring_film_near,
)
from gearlube_core.friction.mixed_friction import BOUNDARY_SPEED
from gearlube_core.friction.thermal_eyring_data import ThermalEyringOil
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.houpert_1985 import (
    HoupertParameters,
    houpert_log_viscosity,
    houpert_temperature_coefficient,
)
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY

SEARCH_ITERATIONS = 40
SEARCH_TOLERANCE = 1.0e-3  # K, of the last step; the error after a secant step is far smaller


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
        At inlet temperature.
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
