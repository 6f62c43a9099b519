"""A bearing type of another package: linear springs, whose forces and modes are known exactly."""

import json
import sys
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gearlube_core.bearings.bearing_type import NO_RACEWAYS
from gearlube_core.dynamics.hypoid_axle import (
    OUTPUT_INDEX,
    HypoidAxle,
    linearise,
    mohammadpour_2015_axle,
)
from gearlube_core.kernels.jit import kernel

STIFFNESS = 3e8  # N/m, of the two bearings of a shaft together, in every direction
SPEED, TORQUE, OIL = 240.0, 66.0, 368.15  # rad/s, N.m, K
TORQUES = (TORQUE, 176.0)  # N.m


class SpringBearings(NamedTuple):
    """Two equal bearings of one shaft: F = -k u, half on each."""

    stiffness: float
    cage_ratio: float

    @kernel
    def expand_forces(self, motion, f_ref, oil, expansion):
        expansion[0] = 0.0

    @kernel
    def expanded_forces(self, motion, expansion):
        k = self.stiffness
        return -k * motion.r1, -k * motion.r2, -k * motion.axial, 0.0

    @kernel
    def shaft_forces(self, motion, f_ref, oil):
        k = 0.5 * self.stiffness
        F = (-k * motion.r1, -k * motion.r2, -k * motion.axial)
        return F[0], F[1], F[2], F[0], F[1], F[2], 0.0

    @kernel
    def shaft_energy(self, motion, oil):
        square = motion.r1 * motion.r1 + motion.r2 * motion.r2 + motion.axial * motion.axial
        return 0.5 * self.stiffness * square

    @kernel
    def bearing_loads(self, motion, f_ref, oil, side, rollers):
        k = 0.5 * self.stiffness
        return -k * motion.r1, -k * motion.r2, -k * motion.axial, 0.0, 0.0, 0.0

    @kernel
    def shaft_drag(self, speed, axial_load, radial_load, law, oil):
        return 0.0

    @kernel
    def raceway_torque(self, motion, law, oil):
        return 0.0

    @kernel
    def solved_raceways(self, motion, oil, films):
        return NO_RACEWAYS

    @kernel
    def beside_raceways(self, motion, oil):
        return 0.0

    def without_loss(self):
        return self


@dataclass(frozen=True)
class SpringBearing:
    """The same in engineering words."""

    stiffness: float

    def parameters(self):
        return SpringBearings(stiffness=self.stiffness, cage_ratio=0.0)

    def preload_force(self):
        return 0.0


def axle_on_springs():
    parameters = replace(mohammadpour_2015_axle(), bearing=SpringBearing(STIFFNESS))
    axle = HypoidAxle(parameters)
    axle.initialise(
        pinion_speed=SPEED, pinion_torque=TORQUE, wheel_torque=TORQUES[1], oil_temperature=OIL
    )
    return axle


def report():
    """Write what the axle on springs does to stdout, as JSON."""
    axle = axle_on_springs()
    found = {
        "frequencies": linearise(axle, OIL, TORQUE).modes()[0].tolist(),
        "at rest": axle.outputs.tolist(),
    }
    for _ in range(3):
        axle.step(1e-4, *TORQUES, OIL)
    found["moving"] = axle.outputs.tolist()
    sys.stdout.write(json.dumps(found))


def quantity(outputs, name):
    """One output of a list that `report` wrote."""
    return outputs[OUTPUT_INDEX[name]]


def along_axes(outputs, name):
    """A vector of `quantity`."""
    return np.array([quantity(outputs, f"{name}.{axis}") for axis in "xyz"])
