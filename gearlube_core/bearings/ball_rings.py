"""Deep groove and angular contact ball bearings in five degrees of freedom: each ball's load."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.parameters import COS_TABLE, SIN_TABLE
from gearlube_core.bearings.ring_loads import (
    REFERENCE_PRESSURE,
    RingLoads,
    RingMotion,
    add_stiffness,
)
from gearlube_core.contact.hertz import complete_elliptic_k_d, ellipticity, hertz_coefficients
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel

LARGEST_OVER_MEAN = 1.5  # pressure of an elliptical contact


class BallRings(NamedTuple):
    """A ball bearing for its kernels; all floats, see `ring_loads.Rings`."""

    n_elements: float  # balls, integral, 3 to ROLLERS_MAX
    stiffness: float  # c_p of inner race - ball - outer race [N/m^1.5]
    centres: float  # A, between the centres of the grooves of unloaded contacts [m]
    radial: float  # of that distance in the middle position, clearance taken off [m]
    axial: float  # likewise, with the offset of a preload [m]
    arm: float  # R, from the axis, with which a tilt moves the groove of the inner ring along z [m]
    pressure: float  # largest on the inner race over the cube root of the load [Pa/N^(1/3)]
    cage_ratio: float
    spring: float  # see `Rings.spring` [N/m]

    @kernel
    def ring_loads(self, motion: RingMotion, damping_time: float, gaps: Array) -> RingLoads:
        """Return the loads of the balls.

        Q = c_p d^1.5 + t k d',  d = |a| - A,  a_r = A cos a0 - s/2 + x cos th + y sin th,
        a_z = A sin a0 + z + R (rx sin th - ry cos th),  k = 1.5 c_p d^0.5

        Notes
        -----
        Balls without mass: neither centrifugal forces nor gyroscopic moments.
        Source: [iso_16281]; [de_mul_1989].
        """
        m, count = motion, int(self.n_elements)
        f_x = f_y = f_z = m_x = m_y = lost = energy = largest = loaded = high = 0.0
        low = math.inf
        cos_c, sin_c = math.cos(m.cage_angle), math.sin(m.cage_angle)
        for i in range(count):
            c = COS_TABLE[count, i] * cos_c - SIN_TABLE[count, i] * sin_c
            s = SIN_TABLE[count, i] * cos_c + COS_TABLE[count, i] * sin_c
            a_r, a_z = _centres(self, m, c, s)
            length = math.sqrt(a_r * a_r + a_z * a_z)
            d = length - self.centres
            if not d > 0.0:
                continue
            n_r, n_z = a_r / length, a_z / length
            elastic = self.stiffness * d * math.sqrt(d)
            radial = m.v_x * c + m.v_y * s + m.cage_speed * (m.y * c - m.x * s)
            tilting = m.w_x * s - m.w_y * c + m.cage_speed * (m.rx * c + m.ry * s)
            rate = n_r * radial + n_z * (m.v_z + self.arm * tilting)
            damper = damping_time * 1.5 * elastic / d
            load = elastic + damper * rate
            on_r, on_z = load * n_r, load * n_z
            f_x -= on_r * c
            f_y -= on_r * s
            f_z -= on_z
            m_x -= self.arm * on_z * s
            m_y += self.arm * on_z * c
            lost += damper * rate * rate
            energy += 0.4 * elastic * d
            largest = max(largest, elastic)
            loaded += 1.0
            low = min(low, n_z) if low < math.inf else n_z
            high = max(high, n_z) if loaded > 1.0 else n_z
        low = low if loaded > 0.0 else 0.0
        return RingLoads(f_x, f_y, f_z, m_x, m_y, lost, energy, largest, loaded, low, high)

    @kernel
    def ring_stiffness(self, motion: RingMotion, gaps: Array, out: Array) -> None:
        """Write the stiffness: that of the contacts, and that of loads which turn with them."""
        count = int(self.n_elements)
        for i in range(out.size):
            out[i] = 0.0
        cos_c, sin_c = math.cos(motion.cage_angle), math.sin(motion.cage_angle)
        for i in range(count):
            c = COS_TABLE[count, i] * cos_c - SIN_TABLE[count, i] * sin_c
            s = SIN_TABLE[count, i] * cos_c + COS_TABLE[count, i] * sin_c
            a_r, a_z = _centres(self, motion, c, s)
            length = math.sqrt(a_r * a_r + a_z * a_z)
            d = length - self.centres
            if not d > 0.0:
                continue
            n_r, n_z = a_r / length, a_z / length
            root = self.stiffness * math.sqrt(d)
            along_x, along_y = self.arm * s, -self.arm * c
            normal = n_r * c, n_r * s, n_z, n_z * along_x, n_z * along_y
            across = -n_z * c, -n_z * s, n_r, n_r * along_x, n_r * along_y
            add_stiffness(out, 1.5 * root, normal)
            add_stiffness(out, root * d / length, across)

    @kernel
    def ring_pressure(self, loads: RingLoads) -> float:
        """Return the largest Hertz pressure on the inner ring [Pa]."""
        return self.pressure * math.pow(loads.largest, 1.0 / 3.0)

    @kernel
    def write_of_rings(self, loads: RingLoads, out: Array, first: int) -> None:
        """Write the least and the largest contact angle under load [rad]."""
        out[first] = math.asin(min(1.0, max(-1.0, loads.low)))
        out[first + 1] = math.asin(min(1.0, max(-1.0, loads.high)))


@inside
def _centres(p: BallRings, m: RingMotion, c: float, s: float) -> tuple[float, float]:
    """Return how far the groove centres of both rings are apart at a ball, radially and along z."""
    a_r = p.radial + m.x * c + m.y * s
    return a_r, p.axial + m.z + p.arm * (m.rx * s - m.ry * c)


def ball_rings(
    n_balls: int,
    ball_diameter: float,
    pitch_diameter: float,
    inner_groove: float,
    outer_groove: float,
    contact_modulus: float,
    *,
    contact_angle: float = 0.0,
    clearance: float = 0.0,
    side: int = 1,
    offset: float = 0.0,
    tilt_on_grooves: bool = False,
) -> BallRings:
    """Return the numbers of a ball bearing.

    c_p = (c_i + c_e)^-1.5,  c = 3 K/(2 pi a E*) of either contact under a unit load

    Parameters
    ----------
    n_balls : int
        Number of balls, 3 to 40.
    ball_diameter, pitch_diameter : float
        D_w, D_pw [m].
    inner_groove, outer_groove : float
        Radius of each groove over the ball diameter, above 0.5 [-].
    contact_modulus : float
        E* [Pa].
    contact_angle : float
        a0 of the unloaded contacts without clearance [rad].
    clearance : float
        Internal radial clearance s, of the diameter [m].
    side : int
        +1 where a displacement of the inner ring along +z loads an angular contact, -1 along -z.
    offset : float
        How far the inner ring is mounted to the loaded side [m].
    tilt_on_grooves : bool
        R: to the centres of the inner groove, D_pw/2 + (f_i - 1/2) D_w cos a0, or D_pw/2.

    References
    ----------
    Contacts as in [johnson_1985 sec. 4.2]; curvatures as in [iso_16281], whose factor 1.48 of c_p
    is pi 2^0.5/3 here, 0.06 % more.
    """
    Dw, cos_a = ball_diameter, math.cos(contact_angle)
    ratio = Dw * cos_a / pitch_diameter
    A = (inner_groove + outer_groove - 1.0) * Dw
    compliance = 0.0
    for groove, along in ((outer_groove, 1.0 + ratio), (inner_groove, 1.0 - ratio)):
        R_x, R_y = 0.5 * Dw * along, 0.5 * Dw / (1.0 - 0.5 / groove)
        c_x, c_y, c_p = hertz_coefficients(R_x, R_y, contact_modulus)
        K, _ = complete_elliptic_k_d(1.0 / ellipticity(max(R_x, R_y) / min(R_x, R_y)))
        compliance += 1.5 * K / (math.pi * max(c_x, c_y) * contact_modulus)
    stiffness, pressure = compliance**-1.5, LARGEST_OVER_MEAN * c_p
    radial = A * cos_a - 0.5 * clearance
    axial = side * (A * math.sin(contact_angle) + offset)
    grooves = (inner_groove - 0.5) * Dw * cos_a if tilt_on_grooves else 0.0
    return BallRings(
        n_elements=float(n_balls),
        stiffness=stiffness,
        centres=A,
        radial=radial,
        axial=axial,
        arm=0.5 * pitch_diameter + grooves,
        pressure=pressure,
        cage_ratio=0.5 * (1.0 - ratio),
        spring=0.5 * n_balls * REFERENCE_PRESSURE / pressure * stiffness ** (2.0 / 3.0),
    )
