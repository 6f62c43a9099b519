"""Flank contacts over a mesh cycle, and the traction of one film against sliding speed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube.studies.resonance.response import Motion
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import PAIRS_AT
from gearlube_core.dynamics.hypoid_torsional.parameters import HypoidTorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.rates import thermal_pair
from gearlube_core.dynamics.packed_mesh import ARM_G, ARM_P, N_CHANNELS, SHARE
from gearlube_core.friction.friction_torques import flank_speeds, friction_torques
from gearlube_core.friction.johnson_greenwood_1980 import (
    thermal_eyring_film,
    thermal_newtonian_stress,
)
from gearlube_core.friction.traction_regime import flank_regime
from gearlube_core.mesh_table.table import PAIRS, MeshTable
from gearlube_core.oil.houpert_1985 import (
    HoupertParameters,
    houpert_log_viscosity,
    houpert_temperature_coefficient,
)
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY

# of the state of a flank, `ThermalFlankState`
STATE = (
    "film_thickness",
    "film_ratio",
    "mean_pressure",
    "inlet_viscosity",
    "effective_viscosity",
    "shear_stress",
    "newtonian_stress",
    "rise_centre",
    "rise_effective",
    "area",
    "asperity_area",
    "viscous_friction",
    "boundary_friction",
    "friction_coefficient",
    "sliding_speed",
    "entrainment_speed",
)
# of its place on the traction map, `TractionRegime`
PLACE = ("pressure_number", "film_number", "slip_number", "largest_stress_ratio", "state")
SHEAR_RATES = np.geomspace(1e2, 1e8, 121)  # 1/s
CURVES = ("thermal_eyring", "isothermal_eyring", "thermal_newtonian", "isothermal_newtonian")


@dataclass(frozen=True, slots=True, kw_only=True)
class FlankCycle:
    """Flank contacts along one motion.

    Parameters
    ----------
    motion : Motion
        Lubricated, one mesh period long.
    oil_temperature : float
        [K]
    values : dict of str to ndarray of shape (PAIRS, samples)
        NaN where a pair carries no load: "load", "R_sliding", "shear_rate", "torque_pinion",
        "torque_gear", and what `STATE` and `PLACE` name.
    """

    motion: Motion
    oil_temperature: float
    values: dict[str, Array]

    @property
    def hardest(self) -> tuple[int, int]:
        """Pair and sample of the highest load."""
        pair, sample = divmod(int(np.nanargmax(self.values["load"])), self.values["load"].shape[1])
        return pair, sample


def flank_cycle(motion: Motion, parameters: HypoidTorsionalParameters) -> FlankCycle:
    """Return the states of all flank contacts along a motion of the lubricated pair.

    References
    ----------
    [karagiannis_2012 fig. 15] [karagiannis_2012 fig. 18] [karagiannis_2012 fig. 20]
    [karagiannis_2012 fig. 21].
    """
    model = motion.problem.model
    p, orbit = model.kernel_parameters, motion.orbit
    samples = orbit.x.size
    rows = model.rows(samples)[::2]
    names = ("load", "R_sliding", "shear_rate", "torque_pinion", "torque_gear", *STATE, *PLACE)
    values = {name: np.full((PAIRS, samples), np.nan) for name in names}
    sliding_radius = _sliding_radius(parameters.mesh, parameters.pinion_torque, samples)
    for i in range(samples):
        w_p, w_g = float(orbit.pinion_speed[i]), float(orbit.gear_speed[i])
        for pair in range(PAIRS):
            at = PAIRS_AT + pair * N_CHANNELS
            load = float(abs(orbit.force[i]) * rows[i, at + SHARE])
            if load <= 0.0:
                continue
            arm_p, arm_g = rows[i, at + ARM_P], rows[i, at + ARM_G]
            _, sliding = flank_speeds(w_p, w_g, arm_p, arm_g)
            state = thermal_pair(rows, i, at, load, w_p, w_g, p)
            place = flank_regime(state, p.thermal_oil, math.inf, math.inf, 1.0)
            friction = state.viscous_friction + state.boundary_friction
            on_pinion, on_gear, _ = friction_torques(friction, sliding, arm_p, arm_g)
            found = {
                "load": load,
                "R_sliding": sliding_radius[pair, i],
                "shear_rate": abs(sliding) / state.film_thickness,
                "torque_pinion": on_pinion,
                "torque_gear": on_gear,
                **{name: getattr(state, name) for name in STATE},
                **{name: getattr(place, name) for name in PLACE},
            }
            for name, value in found.items():
                values[name][pair, i] = value
    return FlankCycle(motion=motion, oil_temperature=parameters.oil_temperature, values=values)


def _sliding_radius(mesh: MeshTable, torque: float, samples: int) -> Array:
    """Return the relative radius along sliding R_zx [m], shape (PAIRS, samples).

    1/R_zx = cos^2 chi/R_x + sin^2 chi/R_y
    """
    windows = {
        name: np.array([np.interp(torque, mesh.torque, column) for column in mesh.windows[name].T])
        for name in ("R_x", "R_y", "chi")
    }
    curvature = np.cos(windows["chi"]) ** 2 / windows["R_x"]
    curvature += np.sin(windows["chi"]) ** 2 / windows["R_y"]
    position = np.arange(PAIRS * samples) * mesh.nodes / (PAIRS * samples)
    inverse = np.interp(position, np.arange(mesh.nodes), curvature, period=mesh.nodes)
    return np.asarray(1.0 / inverse.reshape(PAIRS, samples))


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
