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
    row: NDArray[float64], at: int, load: float, sliding: float, w_p: float, p: TorsionalParameters
) -> float:
    """Return the friction [N] of the pair whose channels begin at row[at], under `load` [N]."""
    flank = flank_friction(
        load,
        row[at + ENTRAIN] * w_p,
        sliding,
        ContactGeometry(row[at + R_E], row[at + SIDE_FLOW], row[at + PRESSURE]),
        p.oil,
        p.surface,
        p.solid,
        CONSISTENT,
    )
    return flank.viscous_friction + flank.boundary_friction


@kernel
def flank_torques(
    row: NDArray[float64], w_p: float, w_g: float, force: float, p: TorsionalParameters
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
    if p.friction_form >= 0.0 and force != 0.0:
        for pair in range(_PAIRS):
            at = PAIRS_AT + pair * N_CHANNELS
            load = abs(force) * row[at + SHARE]
            if load > 0.0:
                sliding = w_p * row[at + ARM_P] - w_g * row[at + ARM_G]
                f = pair_friction(row, at, load, sliding, w_p, p)
                if sliding < 0.0:
                    f = -f
                torque_p -= f * row[at + ARM_P]
                torque_g += f * row[at + ARM_G]
                power += f * sliding
    return FlankTorques(torque_p, torque_g, power)
