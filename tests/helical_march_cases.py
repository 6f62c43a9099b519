"""The pair of He et al. 2007 marched in time, for the tests."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlube_core.dynamics.helical_pair.gear_march import helical_march
from gearlube_core.dynamics.helical_pair.he_2007 import STIFFNESS_DENSITY
from gearlube_core.dynamics.helical_pair.march_parameters import HelicalMarchParameters
from gearlube_core.dynamics.helical_pair.model import HelicalPairModel
from gearlube_core.dynamics.helical_pair.output_names import ENERGIES_AT, OUTPUT_INDEX
from gearlube_core.helical_geometry.gear_file import HelicalGearFile

SPEED = 1000.0 * math.pi / 30.0  # rad/s
TORQUE = 225.97  # N.m at the pinion
RATIO = 31.0 / 25.0
OIL = 333.15  # K
PERIOD = 2.0 * math.pi / (25.0 * SPEED)  # s, of the mesh


def he_march(**settings: Any) -> HelicalMarchParameters:
    """The pair with the closure's stiffness density and Coulomb friction unless set otherwise."""
    chosen = {"stiffness_density": STIFFNESS_DENSITY, "friction": "constant"} | settings
    return helical_march(HelicalGearFile.named("he_2007"), **chosen)


def started(
    parameters: HelicalMarchParameters,
    torque: float = TORQUE,
    speed: float = SPEED,
    wheel_torque: float | None = None,
) -> HelicalPairModel:
    model = HelicalPairModel(parameters)
    model.initialise(
        pinion_speed=speed,
        pinion_torque=torque,
        wheel_torque=torque * RATIO if wheel_torque is None else wheel_torque,
        oil_temperature=OIL,
    )
    return model


def output(model: HelicalPairModel, name: str) -> float:
    return float(model.outputs[OUTPUT_INDEX[name]])


def history(
    model: HelicalPairModel,
    names: list[str],
    steps: int,
    h: float,
    torque: float = TORQUE,
    wheel_torque: float | None = None,
) -> np.ndarray:
    """Named outputs after each of so many steps, shape (steps, names)."""
    places = [OUTPUT_INDEX[name] for name in names]
    load = torque * RATIO if wheel_torque is None else wheel_torque
    rows = np.empty((steps, len(names)))
    for k in range(steps):
        model.step(h, torque, load, OIL)
        rows[k] = model.outputs[places]
    return rows


def energies(model: HelicalPairModel) -> np.ndarray:
    """Pinion work, wheel work, friction, mesh damping, bearing damping, stored [J]."""
    return model.outputs[ENERGIES_AT : ENERGIES_AT + 6].copy()


def unaccounted(before: np.ndarray, after: np.ndarray) -> float:
    """Energy that entered and is neither lost nor stored [J]."""
    entered, left, *lost, stored = after - before
    return float(entered - left - sum(lost) - stored)
