"""Friction torques of all simultaneous tooth pairs on pinion and gear."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import (
    THERMAL_EYRING,
    TorsionalParameters,
)
from gearlube_core.dynamics.hypoid_torsional.mesh_row import PAIRS_AT
from gearlube_core.dynamics.packed_mesh import (
    ARM_G,
    ARM_P,
    ENTRAIN,
    N_CHANNELS,
    PRESSURE,
    R_E,
    SHARE,
    SIDE_FLOW,
)
from gearlube_core.friction.flank import flank_friction
from gearlube_core.friction.flank_data import CONSISTENT, ContactGeometry
from gearlube_core.friction.friction_torques import flank_speeds, friction_torques
from gearlube_core.friction.thermal_eyring_data import ThermalFlankState
from gearlube_core.friction.thermal_eyring_flank import thermal_eyring_flank
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.table import PAIRS

_PAIRS = PAIRS


class FlankTorques(NamedTuple):
    """Friction of all pairs."""

    torque_p: float  # Q_p [N.m]
    torque_g: float  # Q_g [N.m]
    power: float  # lost, >= 0 [W]


@kernel
def thermal_pair(
    rows: Array,
    i: int,
    at: int,
    load: float,
    w_p: float,
    w_g: float,
    p: TorsionalParameters,
) -> ThermalFlankState:
    """Return film and friction of the pair whose channels begin at rows[i, at], load in N."""
    speed, sliding = flank_speeds(w_p, w_g, rows[i, at + ARM_P], rows[i, at + ARM_G])
    if p.along_sliding == 0.0:
        speed = rows[i, at + ENTRAIN] * w_p
    return thermal_eyring_flank(
        load,
        speed,
        sliding,
        ContactGeometry(rows[i, at + R_E], rows[i, at + SIDE_FLOW], rows[i, at + PRESSURE]),
        p.thermal_oil,
        p.surface,
        p.solid,
        p.thermal,
    )


@kernel
def pair_friction(
    rows: Array,
    i: int,
    at: int,
    load: float,
    sliding: float,
    w_p: float,
    w_g: float,
    p: TorsionalParameters,
) -> float:
    """Return the friction [N] of the pair whose channels begin at rows[i, at], under `load` [N]."""
    if p.friction_form == THERMAL_EYRING:
        hot = thermal_pair(rows, i, at, load, w_p, w_g, p)
        return hot.viscous_friction + hot.boundary_friction
    flank = flank_friction(
        load,
        rows[i, at + ENTRAIN] * w_p,
        sliding,
        ContactGeometry(rows[i, at + R_E], rows[i, at + SIDE_FLOW], rows[i, at + PRESSURE]),
        p.oil,
        p.surface,
        p.solid,
        CONSISTENT,
    )
    return flank.viscous_friction + flank.boundary_friction


@kernel
def flank_torques(
    rows: Array, i: int, w_p: float, w_g: float, force: float, p: TorsionalParameters
) -> FlankTorques:
    """Return the friction torques of all pairs that share the mesh force `force` [N].

    See `friction_torques`.

    References
    ----------
    [karagiannis_2012 (13)]
    """
    torque_p = 0.0
    torque_g = 0.0
    power = 0.0
    if force != 0.0:
        for pair in range(_PAIRS):
            at = PAIRS_AT + pair * N_CHANNELS
            load = abs(force) * rows[i, at + SHARE]
            if load > 0.0:
                arm_p, arm_g = rows[i, at + ARM_P], rows[i, at + ARM_G]
                sliding = flank_speeds(w_p, w_g, arm_p, arm_g)[1]
                f = pair_friction(rows, i, at, load, sliding, w_p, w_g, p)
                on_pinion, on_gear, lost = friction_torques(f, sliding, arm_p, arm_g)
                torque_p += on_pinion
                torque_g += on_gear
                power += lost
    return FlankTorques(torque_p, torque_g, power)
