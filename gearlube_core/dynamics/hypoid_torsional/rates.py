"""Rates of the torsional hypoid pair: two degrees of freedom, and their reduction to one."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.contact_mode import force_in_mode
from gearlube_core.dynamics.hypoid_torsional.flank_torques import FlankTorques, flank_torques
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import TorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.mesh_row import DE, DK, R_G, R_P, K
from gearlube_core.kernels.jit import kernel

MICRO = 1.0e6  # um per m; states hold x in um beside speeds of like size
UM = 1.0e-6


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
