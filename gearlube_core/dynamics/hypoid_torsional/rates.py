"""Rates of the torsional hypoid pair: two degrees of freedom, and their reduction to one.

Modes of the mesh: ranges of deflection and rate in which the mesh force is smooth.

The mesh force is continuous, its slopes are not: they jump at first contact, where the damping is
built up, and where the damping alone would pull the flanks together. An integrator that keeps one
mode throughout a step, and ends the step where the mode ends, meets no jump.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP, backlash_deflection
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import (
    DE,
    DK,
    PAIRS_AT,
    R_G,
    R_P,
    THERMAL_EYRING,
    K,
    TorsionalParameters,
)
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

# no contact; damping builds up; damping complete; flanks overlap without force. Below 0: coast
GAP, LAYER, FULL, OPEN = 0, 1, 2, 3
_PAIRS = PAIRS
MICRO = 1.0e6  # um per m; states hold x in um beside speeds of like size
UM = 1.0e-6


class MeshForce(NamedTuple):
    """Deflection and force of the mesh."""

    f: float  # m
    force: float  # N


@kernel
def contact_mode(x: float, x_rate: float, k: float, p: TorsionalParameters) -> int:
    """Return the mode at transmission error `x` [m], its rate [m/s] and stiffness `k` [N/m]."""
    f = backlash_deflection(x, p.backlash)
    if f == 0.0:
        return GAP
    side = 1 if f > 0.0 else -1
    if p.gated == 0.0:
        return side * FULL
    depth = abs(f)
    if k * depth + min(1.0, depth / DAMPING_BUILD_UP) * p.c * side * x_rate <= 0.0:
        return side * OPEN
    return side * (LAYER if depth < DAMPING_BUILD_UP else FULL)


@kernel
def force_in_mode(
    mode: int, x: float, x_rate: float, k: float, p: TorsionalParameters
) -> MeshForce:
    """Return deflection and force by the law of one mode, continued smoothly outside it.

    Inside the mode this is `gated_force`, or k f + c x' if damping acts in the backlash too.
    """
    if mode == GAP:
        return MeshForce(0.0, p.c * x_rate if p.gated == 0.0 else 0.0)
    f = x if mode > 0 else x + p.backlash
    kind = abs(mode)
    if kind == OPEN:
        return MeshForce(f, 0.0)
    if kind == LAYER:
        depth = f if mode > 0 else -f
        return MeshForce(f, k * f + depth / DAMPING_BUILD_UP * p.c * x_rate)
    return MeshForce(f, k * f + p.c * x_rate)


@kernel
def mode_margin(mode: int, x: float, x_rate: float, k: float, p: TorsionalParameters) -> float:
    """Return how far a state lies within its mode [m]; below 0 outside."""
    if mode == GAP:
        return min(-x, x + p.backlash)
    depth = x if mode > 0 else -(x + p.backlash)
    if p.gated == 0.0:
        return depth
    rate = x_rate if mode > 0 else -x_rate
    kind = abs(mode)
    if kind == OPEN:
        push = depth + min(1.0, depth / DAMPING_BUILD_UP) * p.c * rate / k
        return min(depth, -push)
    if kind == LAYER:
        return min(min(depth, DAMPING_BUILD_UP - depth), DAMPING_BUILD_UP + p.c * rate / k)
    return min(depth - DAMPING_BUILD_UP, depth + p.c * rate / k)


class FlankTorques(NamedTuple):
    """Friction of all pairs."""

    torque_p: float  # Q_p [N.m]
    torque_g: float  # Q_g [N.m]
    power: float  # lost, >= 0 [W]


@kernel
def thermal_pair(
    rows: Array, i: int, at: int, load: float, w_p: float, w_g: float, p: TorsionalParameters
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


class PairRates(NamedTuple):
    """Rates of the 2-DOF pair and what makes them."""

    x: float  # dx/dt [m/s]
    w_p: float  # rad/s2
    w_g: float  # rad/s2
    force: float  # F [N]
    torque_p: float  # of the mesh on the pinion, without friction [N.m]
    friction_p: float  # Q_p [N.m]
    friction_g: float  # Q_g [N.m]
    pinion_torque: float  # applied, with ripple and speed hold [N.m]
    load_torque: float  # N.m
    damping_power: float  # W
    friction_power: float  # W


@kernel
def pair_approach(w_p: float, w_g: float, rows: Array, i: int) -> float:
    """Return dx/dt [m/s] of the 2-DOF pair at pinion and gear speed [rad/s]."""
    return (rows[i, R_P] - rows[i, DE]) * w_p - rows[i, R_G] * w_g


@kernel
def reduced_approach(v: float, speed: float, rows: Array, i: int) -> float:
    """Return dx/dt [m/s] of the 1-DOF form at v [m/s] and pinion speed [rad/s]."""
    return v - rows[i, DE] * speed


@kernel
def pair_rates(
    x: float,
    w_p: float,
    w_g: float,
    phi: float,
    load_torque: float,
    speed: float,
    rows: Array,
    i: int,
    mode: int,
    p: TorsionalParameters,
) -> PairRates:
    """Return the rates of the 2-DOF pair.

    x' = R_p w_p - R_g w_g - e' w_p
    I_p w_p' = T_p - (R_p - e') F - k' f^2/2 + Q_p,   I_g w_g' = -T_g + R_g F + Q_g
    T_p = T_p0 (1 + ripple cos phi) + gain (speed - w_p)

    with ' of R, e and k meaning d/dphi of the pinion.

    Parameters
    ----------
    x : float
        Dynamic transmission error from first contact of the drive flanks [m].
    w_p, w_g : float
        [rad/s]
    phi : float
        Pinion angle [rad].
    load_torque : float
        T_g, its mean with an instantaneous load [N.m].
    speed : float
        What the speed hold keeps the pinion at [rad/s].
    rows : ndarray of shape (n, N_ROW)
        Mesh data, see `mesh_row`.
    i : int
        The row that holds those at `phi`.
    mode : int
        See `contact_mode`; its law of the mesh force is kept.
    p : TorsionalParameters

    Notes
    -----
    e' and k' on the pinion make the mesh exchange no energy with nothing; the printed form, in
    which the pinion carries -R_p F, has p.consistent = 0. The instantaneous load of
    [karagiannis_2012 (32)] follows R_g/R_p over its mean.

    References
    ----------
    [karagiannis_2012 (1)] [karagiannis_2012 (2)] [karagiannis_2012 (3)] [karagiannis_2012 (5)]
    [karagiannis_2012 (6)] [karagiannis_2012 (31)] [karagiannis_2012 (32)]
    (3) as a rate.
    """
    k = rows[i, K]
    arm_p = rows[i, R_P] - rows[i, DE]
    x_rate = pair_approach(w_p, w_g, rows, i)
    f, force = force_in_mode(mode, x, x_rate, k, p)
    torque_p = -rows[i, R_P] * force
    if p.consistent != 0.0:
        torque_p = -arm_p * force - 0.5 * rows[i, DK] * f * f
    friction = FlankTorques(0.0, 0.0, 0.0)
    if p.friction_form >= 0.0:
        friction = flank_torques(rows, i, w_p, w_g, force, p)
    applied = p.pinion_torque * ripple(phi, p) + p.hold_gain * (speed - w_p)
    load = load_torque
    if p.instantaneous_load != 0.0:
        load *= rows[i, R_G] / (rows[i, R_P] * p.ratio)
    return PairRates(
        x_rate,
        (applied + torque_p + friction.torque_p) / p.I_p,
        (rows[i, R_G] * force + friction.torque_g - load) / p.I_g,
        force,
        torque_p,
        friction.torque_p,
        friction.torque_g,
        applied,
        load,
        (force - k * f) * x_rate,
        friction.power,
    )


@kernel
def ripple(phi: float, p: TorsionalParameters) -> float:
    """Return the pinion torque over its mean, 1 + ripple cos phi; [karagiannis_2012 (31)]."""
    if p.ripple == 0.0:
        return 1.0  # a cosine costs as much as the rest
    return 1.0 + p.ripple * math.cos(phi)


class ReducedRates(NamedTuple):
    """Rates of the 1-DOF reduction."""

    x: float  # dx/dt [m/s]
    v: float  # m/s2
    force: float  # N


@kernel
def reduced_rates(
    x: float,
    v: float,
    phi: float,
    speed: float,
    rows: Array,
    i: int,
    mode: int,
    p: TorsionalParameters,
) -> ReducedRates:
    """Return the rates of the reduction to one degree of freedom at constant speed.

    m_eq x'' + c x' + k f(x) = F_mean - m_eq e'',  as  x' = v - e' Omega,  m_eq v' = F_mean - F

    Parameters
    ----------
    x : float
        Dynamic transmission error from first contact of the drive flanks [m].
    v : float
        x' + e' Omega, the rate at which the mean base circles approach [m/s]; needs no e''.
    phi, speed, rows, i, mode, p
        As in `pair_rates`; `speed` is Omega, constant.

    Notes
    -----
    F_mean = T_p0/R_p0, with the ripple of the pinion torque times m_eq R_p0^2/I_p. Constant
    radii: what R_p and R_g hold besides their means does not count. No friction.

    References
    ----------
    [karagiannis_2012 (30)] and the 1-DOF model compared there.
    """
    x_rate = reduced_approach(v, speed, rows, i)
    force = force_in_mode(mode, x, x_rate, rows[i, K], p).force
    swing = (ripple(phi, p) - 1.0) * p.m_eq * p.R_p0 * p.R_p0 / p.I_p
    drive = p.pinion_torque / p.R_p0 * (1.0 + swing)
    return ReducedRates(x_rate, (drive - force) / p.m_eq, force)
