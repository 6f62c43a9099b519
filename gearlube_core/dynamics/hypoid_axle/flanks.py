"""Friction on the flanks of all simultaneous tooth pairs."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.state import PHI_P, V_G, V_P, W_G, W_P
from gearlube_core.dynamics.packed_mesh import (
    ACROSS_FLOW,
    ARM_G,
    ARM_P,
    DELTA,
    ENTRAIN,
    LINE_LENGTH,
    LINE_RADIUS,
    LOG_ELLIPTICITY,
    N_CHANNELS,
    PRESSURE,
    PSI,
    R_E,
    ROLL,
    SHARE,
    SIDE_FLOW,
    XI_X,
    XI_Y,
    XI_Z,
)
from gearlube_core.friction.flank_bound import BoundedFlank, FlankEllipse
from gearlube_core.friction.flank_data import ContactGeometry
from gearlube_core.friction.flank_law import bounded_flank
from gearlube_core.friction.flank_rolling import RollingGeometry, flank_rolling_force
from gearlube_core.friction.kept_corrections import N_KEPT, forget
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import pair_channels
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant_state import LubricantState

_PAIRS = PAIRS
# places of what `flank_sum` keeps
BOUND = 3 * PAIRS  # of the friction coefficient of each pair
BOUND_POWER = 4 * PAIRS  # of the power lost in friction
KEPT = BOUND_POWER + 1  # corrections of the film model, of each pair
N_FRICTION = KEPT + PAIRS * N_KEPT


@kernel
def kept_of(friction: Array, pair: int) -> Array:
    """Return the corrections of the film model of one pair in what `flank_sum` keeps."""
    first = KEPT + pair * N_KEPT
    return friction[first : first + N_KEPT]


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
def sliding_speed(s: Array, channels: Array) -> float:
    """Return the sliding speed of the pinion over the gear flank [m/s].

    dU = w_p r_p - w_g r_g + xi.(v_p - v_g): the rate that the friction force does work on, so that
    its power is -f abs(dU) whatever the motion.
    """
    return (
        channels[ARM_P] * s[W_P]
        - channels[ARM_G] * s[W_G]
        + channels[XI_X] * (s[V_P] - s[V_G])
        + channels[XI_Y] * (s[V_P + 1] - s[V_G + 1])
        + channels[XI_Z] * (s[V_P + 2] - s[V_G + 2])
    )


@kernel
def pair_friction(
    s: Array,
    load: float,
    sliding: float,
    channels: Array,
    oil: LubricantState,
    p: AxleParameters,
    film_model: Array,
    asked: float,
    kept: Array,
) -> BoundedFlank:
    """Return the state of one flank under `load` [N] that slides at `sliding` [m/s].

    The last three are those of `bounded_flank`.
    """
    return bounded_flank(
        p.flank_law,
        load,
        channels[ENTRAIN] * s[W_P],
        sliding,
        ContactGeometry(channels[R_E], channels[SIDE_FLOW], channels[PRESSURE]),
        FlankEllipse(
            channels[LINE_RADIUS],
            channels[ACROSS_FLOW],
            abs(channels[ROLL] / channels[ENTRAIN]),
            channels[PSI],
            channels[DELTA],
            channels[LOG_ELLIPTICITY],
        ),
        oil,
        film_model,
        s[PHI_P],
        asked,
        kept,
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
    s: Array,
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
    s : ndarray of shape (N_STATE,)
    force : float
        Mesh force [N]; pair i carries abs(force) times its share.
    window : ndarray of shape ((n_nodes + 1) * N_CHANNELS,)
        Pair data of the mesh table at the present load.
    n_nodes : int
    oil : LubricantState
    p : AxleParameters
    refresh : float
        0: keep the coefficients in `friction`, with the loads, arms and directions of this state;
        else evaluate film and traction anew, a film model as ALONE, AGAIN or CARRIED says, see
        `flank_bound`.
    friction : ndarray of shape (N_FRICTION,)
        Viscous and boundary friction over load of each pair [-], the rolling forces [N], bounds
        of the friction over load [-], that of the power lost in friction, always anew [W], and
        `kept_of` each pair.
    channels : ndarray of shape (N_CHANNELS,)
        Work space.
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
    doubt = 0.0
    if (p.friction != 0.0 or p.rolling != 0.0) and force != 0.0:
        for pair in range(_PAIRS):
            pair_channels(window, n_nodes, p.mesh.z_p, s[PHI_P], pair, N_CHANNELS, channels)
            load = abs(force) * channels[SHARE]
            if load > 0.0:
                sliding = sliding_speed(s, channels)
                if p.friction != 0.0:
                    if refresh != 0.0:
                        bounded = pair_friction(
                            s,
                            load,
                            sliding,
                            channels,
                            oil,
                            p,
                            film_model,
                            refresh,
                            kept_of(friction, pair),
                        )
                        flank = bounded.state
                        friction[2 * pair] = flank.viscous_friction / load
                        friction[2 * pair + 1] = flank.boundary_friction / load
                        friction[BOUND + pair] = bounded.friction_bound * (
                            friction[2 * pair] + friction[2 * pair + 1]
                        )
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
                    doubt += friction[BOUND + pair] * load * abs(sliding)
                if p.rolling != 0.0:
                    speed = s[W_P] + p.ratio * s[W_G]
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
                forget(kept_of(friction, pair))
    elif refresh != 0.0:
        # teeth may touch before the next refresh: what stands here is then used
        for i in range(BOUND_POWER):
            friction[i] = 0.0
        for pair in range(_PAIRS):
            forget(kept_of(friction, pair))
    friction[BOUND_POWER] = doubt
    return FlankSum(torque_p, torque_g, f_x, f_y, f_z, viscous, boundary, rolled)
