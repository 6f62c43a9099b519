"""Friction on the flanks of all simultaneous tooth pairs."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshForce, MeshMotion
from gearlube_core.dynamics.hypoid_mesh.node_films import N_FILMS
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import flank_coefficients, sliding_speed
from gearlube_core.dynamics.packed_mesh import (
    ARM_G,
    ARM_P,
    LINE_LENGTH,
    LINE_RADIUS,
    N_CHANNELS,
    ROLL,
    SHARE,
    XI_X,
    XI_Y,
    XI_Z,
)
from gearlube_core.friction.flank_rolling import RollingGeometry, flank_rolling_force
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import pair_channels
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant_state import LubricantState

_PAIRS = PAIRS
# places of what `flank_sum` keeps
BOUND = 3 * PAIRS  # of the friction coefficient of each pair
BOUND_POWER = 4 * PAIRS  # of the power lost in friction
FILMS = BOUND_POWER + 1  # films at the nodes of the mesh table
N_FRICTION = FILMS + N_FILMS


class FlankSum(NamedTuple):
    """Friction and rolling of all pairs: torques, force on the pinion, and power lost."""

    torque_p: float  # N.m
    torque_g: float  # N.m
    f_x: float  # N, on the pinion; the gear carries the opposite
    f_y: float
    f_z: float
    viscous_power: float  # W
    boundary_power: float  # W
    rolling_power: float  # W


@kernel
def force_on_pinion(
    mesh: MeshForce, friction: FlankSum, lateral_sign: float, consistent: float
) -> tuple[float, float, float]:
    """Return the force of the teeth on the pinion along x, y, z [N]; the gear carries the opposite.

    Parameters
    ----------
    mesh : MeshForce
    friction : FlankSum
    lateral_sign : float
        1, or -1 with the sign that the paper prints.
    consistent : float
        1: with the forces of friction; 0: without them, as printed.
    """
    lateral = lateral_sign * mesh.force
    return (
        -mesh.n_x * lateral + consistent * friction.f_x,
        -mesh.n_y * lateral + consistent * friction.f_y,
        -mesh.n_z * lateral + consistent * friction.f_z,
    )


@kernel
def pair_rolling(
    load: float,
    rolling: float,
    sliding: float,
    channels: Array,
    oil: LubricantState,
    p: AxleParameters,
) -> float:
    """Return the rolling force of one pair [N] at its rolling and sliding speed [m/s]."""
    return flank_rolling_force(
        load,
        abs(rolling),
        abs(sliding),
        RollingGeometry(channels[LINE_RADIUS], channels[LINE_LENGTH]),
        oil,
        p.reduced_modulus,
    )


@kernel
def flank_sum(
    motion: MeshMotion,
    force: float,
    window: Array,
    n_nodes: int,
    oil: LubricantState,
    p: AxleParameters,
    refresh: float,
    friction: Array,
    channels: Array,
    film_model: Array,
) -> FlankSum:
    """Return friction and rolling losses of all pairs that share the mesh force `force` [N].

    Parameters
    ----------
    motion : MeshMotion
    force : float
        Mesh force [N]; pair i carries abs(force) times its share.
    window : ndarray of shape ((n_nodes + 1) * N_CHANNELS,)
        Pair data of the mesh table at the present load.
    n_nodes : int
    oil : LubricantState
    p : AxleParameters
    refresh : float
        0: keep the coefficients in `friction`, with the loads, arms and directions of this state;
        else evaluate film and traction again, a film model as EXACT or BETWEEN_NODES says.
    friction : ndarray of shape (N_FRICTION,)
        Viscous and boundary friction over load of each pair [-], the rolling forces [N], bounds
        of the friction over load [-], that of the power lost in friction [W], which
        is always computed, and the films at the nodes, see `keep_flank`.
    channels : ndarray of shape (N_CHANNELS,)
        Scratch memory, its values are lost.
    film_model : ndarray
        Numbers of the film model, or empty.

    References
    ----------
    [mohammadpour_2015 (10)] [mohammadpour_2015 (11)] [mohammadpour_2015 (20)]
    [mohammadpour_2015 (23)]
    Rolling takes the entrainment of (11) across the contact line, half of it from either shaft, so
    that its torques lose 2 F l u_n; its forces on the shafts, of a newton, are left out.
    (10) prints the arm of the normal force; a friction force acts at the arm xi . (j x r) of
    `friction_arm_p`. (20) prints the shafts' motion along the line of action for the sliding.
    """
    torque_p = 0.0
    torque_g = 0.0
    f_x = 0.0
    f_y = 0.0
    f_z = 0.0
    viscous = 0.0
    boundary = 0.0
    rolled = 0.0
    error = 0.0
    if (p.friction != 0.0 or p.rolling != 0.0) and force != 0.0:
        for pair in range(_PAIRS):
            pair_channels(window, n_nodes, p.mesh.z_p, motion.angle, pair, N_CHANNELS, channels)
            load = abs(force) * channels[SHARE]
            if load > 0.0:
                sliding = sliding_speed(motion, channels)
                if p.friction != 0.0:
                    if refresh != 0.0:
                        viscous_over_load, boundary_over_load, bound = flank_coefficients(
                            pair,
                            motion,
                            load,
                            force,
                            sliding,
                            channels,
                            window,
                            n_nodes,
                            oil,
                            p.mesh.z_p,
                            p.flank_law,
                            film_model,
                            refresh,
                            part(friction, FILMS, N_FILMS),
                        )
                        friction[2 * pair] = viscous_over_load
                        friction[2 * pair + 1] = boundary_over_load
                        friction[BOUND + pair] = bound
                    f_v = friction[2 * pair] * load
                    f_b = friction[2 * pair + 1] * load
                    f = f_v + f_b
                    if sliding < 0.0:
                        f = -f
                    torque_p -= f * channels[ARM_P]
                    torque_g += f * channels[ARM_G]
                    f_x -= f * channels[XI_X]
                    f_y -= f * channels[XI_Y]
                    f_z -= f * channels[XI_Z]
                    viscous += f_v * abs(sliding)
                    boundary += f_b * abs(sliding)
                    error += friction[BOUND + pair] * load * abs(sliding)
                if p.rolling != 0.0:
                    speed = motion.w_p + p.ratio * motion.w_g
                    rolling = 0.5 * channels[ROLL] * speed
                    if refresh != 0.0:
                        friction[2 * _PAIRS + pair] = pair_rolling(
                            load, rolling, sliding, channels, oil, p
                        )
                    arm = friction[2 * _PAIRS + pair] * abs(channels[ROLL])
                    if speed < 0.0:
                        arm = -arm
                    torque_p -= arm
                    torque_g -= arm * p.ratio
                    rolled += arm * speed
            elif refresh != 0.0:
                friction[2 * pair] = 0.0
                friction[2 * pair + 1] = 0.0
                friction[2 * _PAIRS + pair] = 0.0
                friction[BOUND + pair] = 0.0
    elif refresh != 0.0:
        # teeth may touch before the next refresh: what stands here is then used
        for i in range(BOUND_POWER):
            friction[i] = 0.0
    friction[BOUND_POWER] = error
    return FlankSum(torque_p, torque_g, f_x, f_y, f_z, viscous, boundary, rolled)
