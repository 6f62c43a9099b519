"""Friction torques of all simultaneous tooth pairs on pinion and gear."""

from __future__ import annotations

from typing import NamedTuple

from numpy import float64
from numpy.typing import NDArray

from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import TorsionalParameters
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
from gearlube_core.jit import kernel
from gearlube_core.mesh_table.table import PAIRS

_PAIRS = PAIRS


class FlankTorques(NamedTuple):
    """Friction of all pairs."""

    torque_p: float  # Q_p [N.m]
    torque_g: float  # Q_g [N.m]
    power: float  # lost, >= 0 [W]


@kernel
def pair_friction(
    rows: NDArray[float64],
    i: int,
    at: int,
    load: float,
    sliding: float,
    w_p: float,
    p: TorsionalParameters,
) -> float:
    """Return the friction [N] of the pair whose channels begin at rows[i, at], under `load` [N]."""
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
    rows: NDArray[float64], i: int, w_p: float, w_g: float, force: float, p: TorsionalParameters
) -> FlankTorques:
    """Return the friction torques of all pairs that share the mesh force `force` [N].

    Q_p = -sum f r_p sign(dU),  Q_g = +sum f r_g sign(dU),  dU = w_p r_p - w_g r_g

    References
    ----------
    Karagiannis et al. 2012, eq. (5)-(9), (13), (19), with signs for which the power
    Q_p w_p + Q_g w_g = -sum f abs(dU) is a loss.
    """
    torque_p = 0.0
    torque_g = 0.0
    power = 0.0
    if force != 0.0:
        for pair in range(_PAIRS):
            at = PAIRS_AT + pair * N_CHANNELS
            load = abs(force) * rows[i, at + SHARE]
            if load > 0.0:
                sliding = w_p * rows[i, at + ARM_P] - w_g * rows[i, at + ARM_G]
                f = pair_friction(rows, i, at, load, sliding, w_p, p)
                if sliding < 0.0:
                    f = -f
                torque_p -= f * rows[i, at + ARM_P]
                torque_g += f * rows[i, at + ARM_G]
                power += f * sliding
    return FlankTorques(torque_p, torque_g, power)
