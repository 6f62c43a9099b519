"""Efficiency of the gear mesh by readings of the formulas, claim 43 of Mohammadpour et al. 2015."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from docs.page import Page
from drivetrain.road_load import mohammadpour_2015_road_load
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters, contact_modulus
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.packed_mesh import N_CHANNELS, PRESSURE, SHARE, PackedMesh, pack_mesh
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import TABLE
from gearlube_core.friction.flank_data import PRINTED_TRACTION
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import kmh_to_ms

SPEEDS = (20.0, 60.0, 100.0)  # km/h
OIL_TEMPERATURE = 368.15  # K
_SETTLED, _RECORDED, _STEP = 0.05, 0.05, 1e-4  # s; ten or more mesh periods


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
            packed = _circular(parameters)
            at = TABLE + packed.levels.size + packed.series.size  # behind levels and series
            axle.assembly.memory[at : at + packed.windows.size] = packed.windows.ravel()
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


def _printed_traction(surface: SurfaceParameters, solid: SolidParameters) -> MixedFlankFriction:
    """Return traction as printed in (13) at the mean pressure of the contact ellipse."""
    return MixedFlankFriction(surface, solid, float(PRINTED_TRACTION))


def _walther_a(oil: Lubricant, factor: float) -> float:
    """Return the constant of Walther's line for `factor` times the viscosity at the axle's oil."""
    nu = 1e6 * oil.dynamic_viscosity(OIL_TEMPERATURE) / oil.density  # mm2/s
    return math.log10(math.log10(factor * nu + 0.7)) + oil.walther_b * math.log10(OIL_TEMPERATURE)


# what is multiplied: the number at factor one, and its unit, in the order of the tables
INPUTS: Mapping[str, tuple[float, str]] = {
    "alpha": (23.83, "1/GPa"),
    "viscosity": (17.1, "mPa s"),
    "eyring_stress": (2.0, "MPa"),
    "roughness": (0.5, "um"),
    "entrainment": (1.0, ""),  # over the mean of both surface speeds
    "sliding": (1.0, ""),  # over that of the surfaces
    "R_x": (1.0, ""),  # over that of the contact analysis
}


CIRCULAR = Reading(friction="printed_traction_circular")
# of the rows of the table
_READINGS = (
    Reading(),
    Reading(circular=True),
    Reading(friction=_printed_traction),
    CIRCULAR,
    Reading(friction="as_printed"),
    Reading(friction="as_printed", circular=True),
    Reading().times("alpha", 14.4 / INPUTS["alpha"][0]),
    Reading().times("alpha", 10.3 / INPUTS["alpha"][0]),
)


def reading_rows() -> list[list[str]]:
    """Return the mesh efficiency by reading."""
    return [[f"{100.0 * reading.efficiency(v):.2f} %" for v in SPEEDS] for reading in _READINGS]


def _circular(axle: HypoidAxleParameters) -> PackedMesh:
    modulus = contact_modulus(axle.solid, axle.solid)
    return pack_mesh(axle.mesh, modulus, "consistent", "tangent", "circular")


def circle_share() -> float:
    """Return the circle's mean pressure over the ellipse's, at 50 N.m, weighted by load share."""
    axle = Reading().axle().parameters
    packed = axle.packed_mesh(), _circular(axle)
    level = int(np.argmin(np.abs(packed[0].levels - 50.0)))
    shape = packed[0].levels.size, packed[0].nodes + 1, N_CHANNELS
    ellipse, circle = (p.windows.reshape(shape)[level] for p in packed)
    ratio = circle[:, PRESSURE] / ellipse[:, PRESSURE]
    return float(np.average(ratio, weights=ellipse[:, SHARE]))


def fill(page: Page) -> None:
    """Put what decides the efficiency into the page."""
    page.cells("Reading or input", reading_rows(), first=1)
    page.fill("at the mean pressure of a circle, which is {} % of", f"{100.0 * circle_share():.0f}")
