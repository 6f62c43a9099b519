"""Load and speed of a hypoid tooth pair over time: from the axle's motion, or quasi-static."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import (
    OUTPUT_INDEX,
    HypoidAxle,
    HypoidAxleParameters,
)
from gearlube_core.ehl.gears.hypoid_window import pair_contact, phase_of
from gearlube_core.mesh_table.table import PAIRS

LOADS = ("dynamic", "static")
_SETTLE = 0.8  # s until the motion repeats at the speed asked for
_STEPS = 128  # communication steps a mesh period
# N m s/rad at the pinion and 1/s: hold the speed within some 50 ms, far slower than any mode
_HOLD, _RESET = 0.2, 8.0
_PHI, _SPEED, _LOAD, _FILM, _MU = (
    OUTPUT_INDEX[name]
    for name in (
        "pinion.angle",
        "pinion.speed",
        "flank[1].load",
        "flank[1].film_thickness",
        "flank[1].friction_coefficient",
    )
)


class PairDrive(NamedTuple):
    """One tooth pair over its window; arrays (N,)."""

    time: Array  # [s]
    angle: Array  # of the pinion [rad], 0 where the window begins
    speed: Array  # of the pinion [rad/s]
    load: Array  # of the pair [N]
    axle_film: Array  # that the axle model finds [m]; nan without motion
    axle_friction: Array  # its coefficient of friction [-]; nan without motion


def dynamic_drive(
    parameters: HypoidAxleParameters, speed: float, torque: float, oil_temperature: float
) -> PairDrive:
    """Return one pair's load and speed over a window of the running axle.

    Parameters
    ----------
    parameters
        Axle with its mesh table.
    speed, torque
        Of the pinion [rad/s], [N m]; negative torque coasts.
    oil_temperature
        [K].

    Notes
    -----
    The wheel's torque holds the mean speed. Where the motion does not repeat from window to
    window, as on a branch with separation, this is one of many.
    """
    axle = HypoidAxle(parameters)
    ratio, teeth = parameters.mesh.ratio, parameters.mesh.pinion_teeth
    axle.initialise(
        pinion_speed=speed,
        pinion_torque=torque,
        wheel_torque=torque * ratio,
        oil_temperature=oil_temperature,
    )
    h = 2.0 * np.pi / (teeth * speed * _STEPS)
    held = torque

    def step() -> Array:
        nonlocal held
        excess = float(axle.outputs[_SPEED]) - speed
        held += _HOLD * _RESET * excess * h
        axle.step(h, torque, ratio * (held + _HOLD * excess), oil_temperature)
        return axle.outputs

    window = 2.0 * np.pi * PAIRS / teeth
    for _ in range(int(_SETTLE / h)):
        outputs = step()
    first = np.ceil(outputs[_PHI] / window) * window
    rows = []
    while outputs[_PHI] < first + window:
        outputs = step()
        if outputs[_PHI] >= first:
            rows.append(outputs[[_PHI, _SPEED, _LOAD, _FILM, _MU]])
    angle, speeds, load, film, friction = np.array(rows[:-1]).T
    return PairDrive(h * np.arange(angle.size), angle - first, speeds, load, film, friction)


def static_drive(parameters: HypoidAxleParameters, speed: float, torque: float) -> PairDrive:
    """Return one pair's load over a window at constant speed, T/R_p times its share."""
    mesh = parameters.mesh
    count = PAIRS * _STEPS
    angle = 2.0 * np.pi * PAIRS / mesh.pinion_teeth * np.arange(count) / count
    contact = pair_contact(mesh, torque, phase_of(mesh, angle))
    load = abs(torque) / mesh.mean("R_p", torque) * contact.share
    unknown = np.full(count, np.nan)
    return PairDrive(angle / speed, angle, np.full(count, speed), load, unknown, unknown)
