"""A law of flank friction of another package: one coefficient, and a film of its own."""

import json
import sys
from dataclasses import replace
from functools import partial
from typing import NamedTuple

from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.film.line_film import LineFilmLaw, power_law_line_film
from gearlube_core.friction.flank_data import FlankState
from gearlube_core.kernels.jit import kernel

SPEED, TORQUE, OIL = 240.0, 66.0, 368.15  # rad/s, N.m, K
# a formula of another package: the film of rigid cylinders, Martin 1916, 4.9 eta u R/w
MARTIN = LineFilmLaw(coefficient=4.9, speed=1.0, material=0.0, load=-1.0)
LINE_LENGTH = 0.02  # m, over which a flank carries its load
COEFFICIENTS = (0.04, 0.08)


class ConstantFriction(NamedTuple):
    """f = mu F, all of it viscous; film of Martin."""

    coefficient: float
    sigma: float
    reduced_modulus: float

    @kernel
    def flank_state(self, load, entrainment_speed, sliding_speed, geometry, oil):
        F = max(load, 1.0)
        film = power_law_line_film(
            MARTIN,
            geometry.R_e,
            oil.eta0,
            oil.alpha,
            abs(entrainment_speed),
            F / LINE_LENGTH,
            self.reduced_modulus,
        )
        friction = self.coefficient * load
        return FlankState(film, film / self.sigma, friction, 0.0, self.coefficient, 0.0, 1e9)


def constant_friction(coefficient, surface, solid):
    return ConstantFriction(coefficient, surface.sigma, 2.0 * solid.contact_modulus)


def report():
    """Write the outputs of the axle at rest and moving, for two coefficients, as JSON."""
    found = []
    for coefficient in COEFFICIENTS:
        law = partial(constant_friction, coefficient)
        axle = HypoidAxle(replace(mohammadpour_2015_axle(), friction=law))
        axle.initialise(
            pinion_speed=SPEED, pinion_torque=TORQUE, wheel_torque=176.0, oil_temperature=OIL
        )
        at_rest = axle.outputs.tolist()
        axle.step(1e-4, TORQUE, 176.0, OIL)
        found.append({"at rest": at_rest, "moving": axle.outputs.tolist()})
    sys.stdout.write(json.dumps(found))
