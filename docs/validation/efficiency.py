"""What decides the efficiency of the gear mesh, claims 43 and 44 of Mohammadpour et al. 2015."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from docs.validation.decision import table
from drivetrain.road_load import mohammadpour_2015_road_load
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.packed_mesh import pack_mesh
from gearlube_core.friction.flank_laws import printed_traction
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.units import kmh_to_ms

SPEEDS = (20.0, 60.0, 100.0)  # km/h
OIL_TEMPERATURE = 368.15  # K
PRINTED = (0.9905, 0.9915)  # fig. 12
JUDGED_AT = 60.0  # km/h, where a needed factor is sought
_SETTLED, _RECORDED, _STEP = 0.05, 0.05, 1e-4  # s; ten or more mesh periods
_WIDEST = 32.0  # factor either way within which a needed one is sought
_PRECISION = 5e-3  # of a needed factor


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """An axle without bearing drag, with some of its inputs multiplied.

    `factors` by a name of `INPUTS`.
    """

    friction: Any = "consistent"
    circular: bool = False
    factors: Mapping[str, float] = field(default_factory=dict)

    def times(self, name: str, factor: float) -> Reading:
        """Return the reading with one more input multiplied."""
        return replace(self, factors={**self.factors, name: factor})

    def axle(self) -> HypoidAxle:
        """Return the axle."""
        factor = {**dict.fromkeys(INPUTS, 1.0), **self.factors}
        base = mohammadpour_2015_axle()
        windows = dict(base.mesh.windows)
        windows["entrainment_arm"] = windows["entrainment_arm"] * factor["entrainment"]
        windows["R_x"] = windows["R_x"] * factor["R_x"]
        for arm in ("friction_arm_p", "friction_arm_g"):
            windows[arm] = windows[arm] * factor["sliding"]
        oil = replace(
            base.oil,
            walther_a=_walther_a(base.oil, factor["viscosity"]),
            alpha=base.oil.alpha * factor["alpha"],
            eyring_stress=base.oil.eyring_stress * factor["eyring_stress"],
        )
        parameters = replace(
            base,
            mesh=replace(base.mesh, windows=windows),
            oil=oil,
            roughness_rms=base.roughness_rms * factor["roughness"],
            friction=self.friction,
            bearing_torque_loss="none",
        )
        axle = HypoidAxle(parameters)
        if self.circular:
            modulus = contact_modulus(base.solid, base.solid)
            packed = pack_mesh(parameters.mesh, modulus, "consistent", "tangent", "circular")
            axle.packed.windows[:] = packed.windows
        return axle

    def efficiency(self, speed_kmh: float) -> float:
        """Return the mean efficiency of the mesh at a vehicle speed under the paper's road load."""
        axle = self.axle()
        mesh = axle.parameters.mesh
        road = mohammadpour_2015_road_load()
        wheel_torque = road.ring_gear_torque(kmh_to_ms(speed_kmh))
        speed = road.pinion_speed(kmh_to_ms(speed_kmh))
        pinion_torque = wheel_torque / mesh.ratio / 0.985
        torques = pinion_torque, wheel_torque
        axle.initialise(
            pinion_speed=speed,
            pinion_torque=pinion_torque,
            wheel_torque=wheel_torque,
            oil_temperature=OIL_TEMPERATURE,
        )
        column = OUTPUT_INDEX["friction.power_loss"]
        power = OUTPUT_INDEX["pinion.speed"]
        kept = []
        for step in range(round((_SETTLED + _RECORDED) / _STEP)):
            axle.step(_STEP, *torques, OIL_TEMPERATURE)
            if step * _STEP >= _SETTLED:
                kept.append(axle.outputs[[column, power]])
        loss, turning = np.mean(kept, axis=0)
        return float(1.0 - loss / (pinion_torque * turning))


def _walther_a(oil: Lubricant, factor: float) -> float:
    """Return the constant of Walther's line for `factor` times the viscosity at the axle's oil."""
    nu = 1e6 * oil.dynamic_viscosity(OIL_TEMPERATURE) / oil.density  # mm2/s
    return math.log10(math.log10(factor * nu + 0.7)) + oil.walther_b * math.log10(OIL_TEMPERATURE)


# what is multiplied: words, unit, and the number at factor one
INPUTS: Mapping[str, tuple[str, float, str]] = {
    "alpha": ("pressure-viscosity coefficient", 23.83, "1/GPa"),
    "viscosity": ("viscosity", 17.1, "mPa s"),
    "eyring_stress": ("Eyring stress", 2.0, "MPa"),
    "roughness": ("composite roughness", 0.5, "um"),
    "entrainment": ("entrainment speed over the mean of both surfaces", 1.0, "-"),
    "sliding": ("sliding speed over that of the surfaces", 1.0, "-"),
    "R_x": ("R_x over that of the contact analysis", 1.0, "-"),
}
