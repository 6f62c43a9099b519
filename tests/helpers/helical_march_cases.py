"""The pair of He et al. 2007 marched in time, for the tests."""

from __future__ import annotations

import math
from dataclasses import fields, replace
from typing import Any

import numpy as np

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.outputs import ENERGIES, OUTPUT_INDEX
from gearlube_core.dynamics.helical_pair.march.gear_file_march import (
    ReplacedBearings,
    helical_march_parameters,
)
from gearlube_core.dynamics.helical_pair.march.mesh_data import pack_march_mesh
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.train.elements.helical_mesh_kernels import pair_data_at
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh import LineMesh

SPEED = 1000.0 * math.pi / 30.0  # rad/s
TORQUE = 225.97  # N.m at the pinion
RATIO = 31.0 / 25.0
OIL = 333.15  # K
PERIOD = 2.0 * math.pi / (25.0 * SPEED)  # s, of the mesh


def he_march(**settings: Any) -> HelicalMarchParameters:
    """The pair with Coulomb friction unless set otherwise."""
    return march_of(HelicalGearFile.named("he_2007"), **{"friction": "constant"} | settings)


def march_of(gear: HelicalGearFile, **settings: Any) -> HelicalMarchParameters:
    """The pair with its arguments, bearings and fields replaced, by name."""

    def taken(*names: str) -> dict[str, Any]:
        return {name: settings.pop(name) for name in names if name in settings}

    bearings = ReplacedBearings(**taken(*(f.name for f in fields(ReplacedBearings))))
    own = taken("line_mesh", "stiffness_density", "oil")
    return replace(helical_march_parameters(gear, bearings=bearings, **own), **settings)


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


def pair_data_of(model: HelicalPairModel) -> np.ndarray:
    """Constants, kept films and line mesh in the memory of the model's mesh, as they are."""
    packed = pack_march_mesh(model.parameters.mesh)
    memory = model.assembly.memory
    return memory[pair_data_at(*packed.density.shape) : -1]


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
    return model.outputs[ENERGIES : ENERGIES + 6].copy()


def unaccounted(before: np.ndarray, after: np.ndarray) -> float:
    """Energy that entered and is neither lost nor stored [J]."""
    entered, left, *lost, stored = after - before
    return float(entered - left - sum(lost) - stored)


def wavy_mesh(parameters: HelicalMarchParameters) -> HelicalMarchParameters:
    """The pair with density and offset that vary with phase, line and station."""
    plain = parameters.mesh
    phase = np.arange(32) / 32.0
    station = np.linspace(0.0, 1.0, 5)
    # continuous as line i becomes line i + 1 at the end of the period
    age = np.arange(plain.lines)[:, None] + phase[:, None, None]
    wave = np.sin(2.0 * np.pi * age / plain.lines + station)
    mesh = LineMesh(
        name="wavy",
        source="made up",
        pinion_teeth=plain.pinion_teeth,
        gear_teeth=plain.gear_teeth,
        base_pitch=plain.base_pitch,
        torque=np.array([TORQUE]),
        phase=phase,
        station=station,
        density=(float(plain.density.max()) * (1.0 + 0.2 * wave))[None],
        offset=(2e-6 * (1.0 + wave))[None],
    )
    return replace(parameters, mesh=mesh)
