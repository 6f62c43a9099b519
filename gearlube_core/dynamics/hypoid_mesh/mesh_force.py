"""Force between the flanks: stiffness with backlash, damping, and the motion that drives them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.flank_force import backlash_deflection, gated_force
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import MeshSeries, mesh_series
from gearlube_core.number import Number


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshForceScalars:
    """Numbers of the mesh force that a user may give.

    Parameters
    ----------
    frequency_floor : float
        Lower clamp of the frequency in [mohammadpour_2015 (4)] and [mohammadpour_2015 (25)] [Hz],
        1 to 1e4; (4) diverges at rest, the paper's sweep starts at 100 Hz.
    hysteretic_loss : float
        Coefficient of [mohammadpour_2015 (4)] [-], 0 to 0.5.
    """

    frequency_floor: Annotated[float, Number("Hz", 1.0, 1e4)] = 50.0
    hysteretic_loss: Annotated[float, Number("1", 0.0, 0.5, "Default 0.009.")] = 0.009


class MeshForceConstants(NamedTuple):
    """Constants of the mesh for the kernels."""

    z_p: float  # pinion teeth [-]
    backlash: float  # 2b along the line of action [m]
    frequency_floor: float  # Hz
    hysteretic_loss: float  # [-]
    modal_damping: float  # N s/m; zero selects [mohammadpour_2015 (4)]
    consistent: float  # 1 with the terms that make the mesh conserve energy, 0 as printed


class MeshMotion(NamedTuple):
    """Motion of a pinion and its gear, as their mesh takes it."""

    angle: float  # of the pinion [rad]
    x: float  # dynamic transmission error [m]
    w_p: float  # rad/s
    w_g: float  # rad/s
    d_x: float  # displacement of the pinion less that of the gear [m]
    d_y: float
    d_z: float
    v_x: float  # velocity likewise [m/s]
    v_y: float
    v_z: float


class MeshForce(NamedTuple):
    """Mesh force and what it does."""

    force: float  # along the line of action, > 0 on the drive flank [N]
    x_rate: float  # d(DTE)/dt [m/s]
    torque_p: float  # on the pinion [N.m]
    torque_g: float  # on the gear [N.m]
    damping_power: float  # [W]
    stiffness: float  # k_m [N/m]
    n_x: float
    n_y: float
    n_z: float


@kernel
def reference_frequency(p: MeshForceConstants, pinion_speed: float) -> float:
    """Return the mesh frequency [Hz], clamped from below by p.frequency_floor."""
    return max(p.z_p * abs(pinion_speed) / (2.0 * math.pi), p.frequency_floor)


@kernel
def modal_damping(loss_factor: float, stiffness: float, mass: float) -> float:
    """Return the coefficient of a mode with this loss factor, c = eta sqrt(k m) [N s/m]."""
    return loss_factor * math.sqrt(stiffness * mass)


@kernel
def equivalent_mass(R_p: float, ratio: float, I_p: float, I_g: float) -> float:
    """Return the mass of the torsional mesh mode [kg], [karagiannis_2012 (30)]."""
    R_g = R_p * ratio
    return 1.0 / (R_p * R_p / I_p + R_g * R_g / I_g)


@kernel
def mesh_force(
    motion: MeshMotion, series: Array, n_orders: int, p: MeshForceConstants
) -> MeshForce:
    """Return the mesh force in a motion.

    x' = R_p w_p - R_g w_g + n.(v_p - v_g) + n'.(u_p - u_g) w_p - e' w_p
    F = k_m f(x) + c_m x',  c_m = 0.009 k_m / f_m

    Parameters
    ----------
    motion : MeshMotion
    series : ndarray of shape (N_SERIES * (2 n_orders + 1),)
        Coefficients at the present load.
    n_orders : int
    p : MeshForceConstants

    Notes
    -----
    Consistent form: no force within the backlash, damping that builds up over the first
    DAMPING_BUILD_UP of deflection (so that the force is continuous), no adhesion, and the pinion
    carries the torque -F dx/dphi_p - k_m' f^2/2, so that the mesh exchanges no energy with
    nothing. The printed form lets c_m x' act within the backlash and the pinion carry -R_p F.

    References
    ----------
    [mohammadpour_2015 (2)] as a rate; [mohammadpour_2015 (4)] with f_m in Hz, clamped from below
    because it diverges at rest.
    """
    m: MeshSeries = mesh_series(series, n_orders, p.z_p, motion.angle)
    turning = m.dn_x * motion.d_x + m.dn_y * motion.d_y + m.dn_z * motion.d_z
    arm_p = m.R_p - m.de + turning
    approach = m.n_x * motion.v_x + m.n_y * motion.v_y + m.n_z * motion.v_z
    x_rate = arm_p * motion.w_p - m.R_g * motion.w_g + approach
    f = backlash_deflection(motion.x, p.backlash)
    elastic = m.k_m * f
    c = p.modal_damping
    if c == 0.0:
        c = p.hysteretic_loss * m.k_m / reference_frequency(p, motion.w_p)
    force = elastic + c * x_rate
    torque_p = -m.R_p * force
    if p.consistent != 0.0:
        force = gated_force(elastic, c, x_rate, f)
        torque_p = -arm_p * force - 0.5 * m.dk_m * f * f
    return MeshForce(
        force,
        x_rate,
        torque_p,
        m.R_g * force,
        (force - elastic) * x_rate,
        m.k_m,
        m.n_x,
        m.n_y,
        m.n_z,
    )
