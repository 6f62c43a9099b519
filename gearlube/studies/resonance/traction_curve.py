"""Traction of one film against sliding speed, with its limiting effects switched off in turn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube.studies.resonance.flank_cycle import FlankCycle
from gearlube_core.arrays import Array
from gearlube_core.friction.johnson_greenwood_1980 import (
    thermal_eyring_film,
    thermal_newtonian_stress,
)
from gearlube_core.oil.houpert_1985 import (
    HoupertParameters,
    houpert_log_viscosity,
    houpert_temperature_coefficient,
)
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY

SHEAR_RATES = np.geomspace(1e2, 1e8, 121)  # 1/s
CURVES = (
    "thermal_eyring",
    "isothermal_eyring",
    "thermal_newtonian",
    "isothermal_newtonian",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionCurve:
    """Traction of the most heavily loaded film of a cycle at other sliding speeds.

    Parameters
    ----------
    pressure, film_thickness, viscosity : float
        Mean [Pa], [m], at that pressure and oil temperature [Pa s].
    stress : dict of str to ndarray of shape (SHEAR_RATES.size,)
        tau of each of `CURVES` [Pa].
    effective_viscosity : ndarray of shape (SHEAR_RATES.size,)
        Of the heated film at low stress [Pa s].
    """

    pressure: float
    film_thickness: float
    viscosity: float
    stress: dict[str, Array]
    effective_viscosity: Array


def traction_curve(cycle: FlankCycle) -> TractionCurve:
    """Return the traction curve of the hardest loaded contact of a cycle.

    References
    ----------
    [karagiannis_2012 fig. 19]; [johnson_greenwood_1980].
    """
    oil = cycle.motion.problem.model.kernel_parameters.thermal_oil
    pressure = float(cycle.values["mean_pressure"][cycle.hardest])
    h = float(cycle.values["film_thickness"][cycle.hardest])
    law = HoupertParameters(oil.log_viscosity, oil.temperature, oil.S0, oil.Z)
    reduced_log = houpert_log_viscosity(law, pressure, oil.temperature)
    beta = houpert_temperature_coefficient(law, reduced_log, oil.temperature)
    log_viscosity = reduced_log - ROELANDS_LOG_VISCOSITY
    viscosity = float(np.exp(log_viscosity))
    films = [
        thermal_eyring_film(log_viscosity, beta, oil.conductivity, oil.tau0, h, rate * h)
        for rate in SHEAR_RATES
    ]
    hot = [
        thermal_newtonian_stress(log_viscosity, beta, oil.conductivity, h, rate * h)
        for rate in SHEAR_RATES
    ]
    return TractionCurve(
        pressure=pressure,
        film_thickness=h,
        viscosity=viscosity,
        stress={
            "thermal_eyring": oil.tau0 * np.array([film.stress_ratio for film in films]),
            "isothermal_eyring": oil.tau0 * np.arcsinh(viscosity * SHEAR_RATES / oil.tau0),
            "thermal_newtonian": np.array(hot),
            "isothermal_newtonian": viscosity * SHEAR_RATES,
        },
        effective_viscosity=viscosity * np.array([film.viscosity_ratio for film in films]),
    )
