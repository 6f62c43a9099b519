"""Rates of change of the marching model: kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

from numpy import float64
from numpy.typing import NDArray

from gearlube_core.dynamics.helical_pair.line_sums import LineSums, line_sums
from gearlube_core.dynamics.helical_pair.march_constants import (
    FlankConstants,
    MotionConstants,
    SupportConstants,
)
from gearlube_core.dynamics.helical_pair.state import (
    BEARING_DAMPING,
    FLANK_POINTS,
    FRICTION,
    MESH_DAMPING,
    MU,
    N_LATERAL,
    OM_G,
    OM_P,
    PHI_G,
    PHI_P,
    PINION_WORK,
    PSI,
    TH_G,
    TH_P,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    WHEEL_WORK,
)
from gearlube_core.flat_tuples import tuple_from_array
from gearlube_core.jit import kernel

SPEED_OF_FULL_FRICTION = 0.01  # rad/s; below, friction fades so that it has no jump at rest


class Wrench(NamedTuple):
    """Forces of the mesh on both members in the frame of the pair."""

    F_x: float  # on the pinion; the gear has the opposite [N]
    F_y: float
    F_z: float
    M_px: float  # on the pinion [N.m]
    M_py: float
    M_pz: float
    M_gx: float  # on the gear
    M_gy: float
    M_gz: float


class FlankView(NamedTuple):
    """Motion as one flank sees it."""

    a: float  # compression at x = z = 0 [m]
    tilt: float  # th_yp - th_yg [rad]
    phase: float  # [mesh periods]


@kernel
def drive_view(s: NDArray[float64], p: FlankConstants) -> FlankView:
    """Return compression and phase of the drive flanks.

    Notes
    -----
    He et al. 2007 eq. (4), sign reversed, with -psi of docs/conventions.md as s[PSI].
    """
    plane = p.plane
    c1 = s[U_P] - s[U_G] + s[PSI]
    c3 = s[U_P + 2] - s[U_G + 2] + plane.r_bp * s[TH_P] + plane.r_bg * s[TH_G]
    c3 -= plane.x_g * s[TH_G + 1]
    phase = plane.r_bp * s[PHI_P] / plane.pitch
    return FlankView(plane.cos_b * c1 - plane.sin_b * c3, s[TH_P + 1] - s[TH_G + 1], phase)


@kernel
def turned(x: float, y: float, p: FlankConstants) -> tuple[float, float]:
    """Return x and y of a vector after half a turn about the line of centres; z changes sign."""
    return -p.turn_cos * x + p.turn_sin * y, p.turn_sin * x + p.turn_cos * y


@kernel
def coast_view(s: NDArray[float64], p: FlankConstants) -> FlankView:
    """Return compression and phase of the coast flanks.

    Notes
    -----
    Half a turn about the line of centres carries either gear into itself, its coast flanks into
    drive flanks: the coast flanks are the drive flanks of the turned motion, less the backlash.
    """
    plane = p.plane
    u_px, _ = turned(s[U_P], s[U_P + 1], p)
    u_gx, _ = turned(s[U_G], s[U_G + 1], p)
    th_px, th_py = turned(s[TH_P], s[TH_P + 1], p)
    th_gx, th_gy = turned(s[TH_G], s[TH_G + 1], p)
    c1 = u_px - u_gx - s[PSI]
    c3 = s[U_G + 2] - s[U_P + 2] + plane.r_bp * th_px + plane.r_bg * th_gx - plane.x_g * th_gy
    phase = p.coast_phase - plane.r_bp * s[PHI_P] / plane.pitch
    a = plane.cos_b * c1 - plane.sin_b * c3 - p.backlash
    return FlankView(a, th_py - th_gy, phase)


@kernel
def touches(view: FlankView, offset_low: float, p: FlankConstants) -> bool:
    """Return whether a flank can touch anywhere: a quick bound."""
    plane = p.plane
    reach = abs(view.tilt) * (0.5 * plane.W * plane.cos_b + plane.x_g * plane.sin_b)
    return view.a + reach - offset_low > 0.0


@kernel
def coast_near(s: NDArray[float64], offset_low: float, p: FlankConstants) -> bool:
    """Return whether the coast flanks can touch: a bound that costs less than their view."""
    reach = 0.0
    for i in range(3):
        reach += abs(s[U_P + i]) + abs(s[U_G + i])
    size = p.plane.W + 2.0 * p.plane.x_g + p.plane.r_bp + p.plane.r_bg
    for i in range(2):
        reach += size * (abs(s[TH_P + i]) + abs(s[TH_G + i]))
    return reach - s[PSI] * p.plane.cos_b - p.backlash - offset_low > 0.0


@kernel
def friction_direction(pinion_speed: float) -> float:
    """Return the direction of rotation: +1 forward, -1 backward, linear between near rest."""
    return min(max(pinion_speed / SPEED_OF_FULL_FRICTION, -1.0), 1.0)


@kernel
def flank_wrench(sums: LineSums, direction: float, p: FlankConstants) -> Wrench:
    """Return forces and moments of one flank in its own frame.

    Parameters
    ----------
    direction
        +1 where the pinion turns about -z of this frame, -1 the other way, between at rest.

    Notes
    -----
    He et al. 2007 eq. (7), (16), (21) with x_g for the misprinted x_e.
    """
    plane = p.plane
    N = sums.N
    F = direction * sums.F
    Fx = direction * sums.Fx
    Fz = direction * sums.Fz
    along = plane.sin_b * sums.Nx + plane.cos_b * sums.Nz
    return Wrench(
        -plane.cos_b * N,
        F,
        plane.sin_b * N,
        plane.r_bp * plane.sin_b * N - Fz,
        -along,
        Fx + plane.r_bp * plane.cos_b * N,
        plane.r_bg * plane.sin_b * N + Fz,
        along - plane.x_g * plane.sin_b * N,
        plane.x_g * F - Fx + plane.r_bg * plane.cos_b * N,
    )


@kernel
def turned_wrench(w: Wrench, p: FlankConstants) -> Wrench:
    """Return the wrench of the coast flanks' frame in that of the pair."""
    F_x, F_y = turned(w.F_x, w.F_y, p)
    M_px, M_py = turned(w.M_px, w.M_py, p)
    M_gx, M_gy = turned(w.M_gx, w.M_gy, p)
    return Wrench(F_x, F_y, -w.F_z, M_px, M_py, -w.M_pz, M_gx, M_gy, -w.M_gz)


@kernel
def friction_heat(
    sums: LineSums, direction: float, s: NDArray[float64], p: FlankConstants
) -> float:
    """Return the heat of the drive flanks' friction [W], with the true velocities."""
    rate = sums.F * (s[V_P + 1] - s[V_G + 1] + p.plane.x_g * s[W_G])
    rate -= sums.Fz * (s[OM_P] - s[OM_G]) + sums.Fx * (s[W_P] + s[W_G])
    return -direction * rate


@kernel
def turned_friction_heat(
    sums: LineSums, direction: float, s: NDArray[float64], p: FlankConstants
) -> float:
    """Return the heat of the coast flanks' friction [W]."""
    _, v_p = turned(s[V_P], s[V_P + 1], p)
    _, v_g = turned(s[V_G], s[V_G + 1], p)
    om_p, _ = turned(s[OM_P], s[OM_P + 1], p)
    om_g, _ = turned(s[OM_G], s[OM_G + 1], p)
    rate = sums.F * (v_p - v_g - p.plane.x_g * s[W_G])
    rate -= sums.Fz * (om_p - om_g) - sums.Fx * (s[W_P] + s[W_G])
    return -direction * rate


@kernel
def support_rates(
    s: NDArray[float64],
    u: int,
    v: int,
    F_x: float,
    F_y: float,
    F_z: float,
    M_x: float,
    M_y: float,
    k: SupportConstants,
    ds: NDArray[float64],
) -> float:
    """Write the accelerations of one member under the forces given; return the dampers' heat [W].

    `u` and `v` are the places of its displacements and rates in the state.
    """
    x, y, z, a_x, a_y = s[u], s[u + 1], s[u + 2], s[u + 3], s[u + 4]
    v_x, v_y, v_z, w_x, w_y = s[v], s[v + 1], s[v + 2], s[v + 3], s[v + 4]
    ds[v] = (F_x - k.K_xx * x - k.K_x_ay * a_y - k.c_x * v_x) * k.mobility
    ds[v + 1] = (F_y - k.K_yy * y - k.K_y_ax * a_x - k.c_y * v_y) * k.mobility
    ds[v + 2] = (F_z - k.K_zz * z - k.c_z * v_z) * k.mobility_z
    ds[v + 3] = (M_x - k.K_ax * a_x - k.K_y_ax * y - k.c_ax * w_x) * k.mobility_a
    ds[v + 4] = (M_y - k.K_ay * a_y - k.K_x_ay * x - k.c_ay * w_y) * k.mobility_a
    lost = k.c_x * v_x * v_x + k.c_y * v_y * v_y + k.c_z * v_z * v_z
    return lost + k.c_ax * w_x * w_x + k.c_ay * w_y * w_y


@kernel
def march_rates(
    s: NDArray[float64],
    pinion_torque: float,
    wheel_torque: float,
    density: NDArray[float64],
    offset: NDArray[float64],
    station: NDArray[float64],
    offset_low: float,
    constants: NDArray[float64],
    ds: NDArray[float64],
) -> None:
    """Write d/dt of the N_ODE integrated states into `ds`.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    pinion_torque, wheel_torque
        [N.m]
    density, offset, station
        Line mesh at the present load, see `line_sums`.
    offset_low
        Smallest offset [m].
    constants : ndarray
        Flattened MarchConstants; as an array, since a call with so many floats costs more than the
        work in it.
    ds : ndarray of shape (N_ODE,)

    Notes
    -----
    He et al. 2007 eq. (38)-(41), consistent signs, about a motion that follows the actual rotation
    of the pinion; flanks press, never pull. Products of rotation and tilt (gyroscopic terms) are
    left out as in the paper. Mesh damping as in `rhs.mesh_damping`, for either flank by itself.
    """
    motion: MotionConstants = tuple_from_array(constants, MotionConstants)
    p = motion.flanks
    plane = p.plane
    w_p = s[W_P]
    w_g = s[W_G]
    direction = friction_direction(w_p)
    psi_rate = plane.r_bp * w_p - plane.r_bg * w_g
    F_x = F_y = F_z = M_px = M_py = M_pz = M_gx = M_gy = M_gz = 0.0
    heat = damping = moving = 0.0
    drive = drive_view(s, p)
    if touches(drive, offset_low, p):
        sums = line_sums(drive.a, drive.tilt, drive.phase, density, offset, station, s, MU, p)
        F_x, F_y, F_z, M_px, M_py, M_pz, M_gx, M_gy, M_gz = flank_wrench(sums, direction, p)
        heat = friction_heat(sums, direction, s, p)
        viscous = p.damping * math.sqrt(sums.stiffness) * psi_rate
        damping = max(viscous, -plane.cos_b * sums.N)
        moving = sums.moving
    if coast_near(s, offset_low, p):
        coast = coast_view(s, p)
        sums = line_sums(
            coast.a, coast.tilt, coast.phase, density, offset, station, s, MU + FLANK_POINTS, p
        )
        w = turned_wrench(flank_wrench(sums, -direction, p), p)
        F_x += w.F_x
        F_y += w.F_y
        F_z += w.F_z
        M_px += w.M_px
        M_py += w.M_py
        M_pz += w.M_pz
        M_gx += w.M_gx
        M_gy += w.M_gy
        M_gz += w.M_gz
        heat += turned_friction_heat(sums, -direction, s, p)
        viscous = p.damping * math.sqrt(sums.stiffness) * psi_rate
        damping += min(viscous, plane.cos_b * sums.N)
        moving -= sums.moving
    lost = support_rates(s, U_P, V_P, F_x, F_y, F_z, M_px, M_py, motion.pinion, ds)
    lost += support_rates(s, U_G, V_G, -F_x, -F_y, -F_z, M_gx, M_gy, motion.gear, ds)
    on_pinion = pinion_torque - M_pz - plane.r_bp * (damping + moving)
    on_gear = -wheel_torque + M_gz + plane.r_bg * damping
    ds[PSI] = psi_rate
    ds[W_P] = on_pinion * motion.pinion.mobility_r
    ds[W_G] = on_gear * motion.gear.mobility_r
    ds[PHI_P] = w_p
    ds[PHI_G] = w_g
    for i in range(N_LATERAL):
        ds[U_P + i] = s[V_P + i]
    ds[PINION_WORK] = pinion_torque * w_p
    ds[WHEEL_WORK] = wheel_torque * w_g
    ds[FRICTION] = heat
    ds[MESH_DAMPING] = damping * psi_rate
    ds[BEARING_DAMPING] = lost
