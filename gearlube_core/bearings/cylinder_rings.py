"""Cylindrical roller bearing in five degrees of freedom: the load of each lamina of each roller."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.ninth_root import ROOT_MAX, ROOT_MIN, ninth_root
from gearlube_core.bearings.parameters import COS_TABLE, SIN_TABLE
from gearlube_core.bearings.ring_loads import (
    REFERENCE_PRESSURE,
    RingLoads,
    RingMotion,
    add_stiffness,
)
from gearlube_core.contact.hertz import LARGEST_OVER_MEAN, line_mean_pressure
from gearlube_core.kernels.inlining import inlined, inside, summing
from gearlube_core.kernels.jit import kernel

PROFILE = 0.00035  # of the logarithmic profile, over the roller diameter [iso_16281]
_LAMINA = 35948.0  # N mm^-(10/9) mm^-(8/9), inner race - steel roller - outer race [iso_16281]
_MM = 1e-3  # m
_UNIT = 1e-8  # m, of approaches under the ninth root: good from 1e-12 m to 1.8 mm
_LEAST = 1e-30  # m, of an approach that divides
_STEEPER = 10.0 / 9.0  # tangent over secant of the load of a lamina
_ROOT_OF_UNIT = _UNIT ** (1.0 / 9.0)


class CylinderRings(NamedTuple):
    """A cylindrical roller bearing for its kernels; all floats, see `ring_loads.Rings`."""

    n_elements: float  # rollers, integral, 3 to ROLLERS_MAX
    stiffness: float  # c_s of one lamina [N/m^(10/9)]
    half_clearance: float  # s/2 [m]
    length: float  # of the contact [m]
    flange: float  # stiffness of the ribs along z [N/m]; 0: none
    flange_gap: float  # along z before they touch [m]
    side: float  # +1: they stop the inner ring towards +z, -1: towards -z, 0: both
    pressure: float  # largest on the inner race over the root of the load per length
    cage_ratio: float
    spring: float  # see `Rings.spring` [N/m]

    @kernel
    def ring_loads(self, motion: RingMotion, damping_time: float, gaps: Array) -> RingLoads:
        """Return the loads of the rollers.

        q_k = c_s d_k^(10/9) + t k d_k',  d_k = x cos th + y sin th + t_k (ry cos th - rx sin th)
        - s/2 - 2 P(t_k),  k = (10/9) c_s d_k^(1/9)

        Notes
        -----
        The damper of a lamina is at most its load: below an approach of (10/9) t |d'| it fades in,
        so that races do not pull. Laminae do not feel each other, so that loads at the ends of a
        roller are too low. A roller follows the mean tilt of both rings. Ribs are a spring without
        friction.
        Source: [iso_16281].
        """
        m, count = motion, int(self.n_elements)
        f_x = f_y = m_x = m_y = lost = energy = largest = loaded = deepest = 0.0
        width = self.length / max(1, gaps.size)
        cos_c, sin_c = math.cos(m.cage_angle), math.sin(m.cage_angle)
        for i in range(count):
            c = COS_TABLE[count, i] * cos_c - SIN_TABLE[count, i] * sin_c
            s = SIN_TABLE[count, i] * cos_c + COS_TABLE[count, i] * sin_c
            radial, slope = m.x * c + m.y * s, m.ry * c - m.rx * s
            if not radial + 0.5 * self.length * abs(slope) > self.half_clearance:
                continue
            rate = m.v_x * c + m.v_y * s + m.cage_speed * (m.y * c - m.x * s)
            turning = m.w_y * c - m.w_x * s - m.cage_speed * (m.ry * s + m.rx * c)
            reach = _STEEPER * damping_time * (abs(rate) + 0.5 * self.length * abs(turning))
            one = _sums(radial, slope, width, self.stiffness, gaps, reach)
            resisting = damping_time * (one.k_0 * rate + one.k_1 * turning)
            tilting = one.moment + damping_time * (one.k_1 * rate + one.k_2 * turning)
            f_x -= (one.load + resisting) * c
            f_y -= (one.load + resisting) * s
            m_x += tilting * s
            m_y -= tilting * c
            lost += resisting * rate + (tilting - one.moment) * turning
            energy += one.energy
            largest = max(largest, one.load)
            loaded += 1.0 if one.load > 0.0 else 0.0
            deepest = max(deepest, _deepest(radial, slope, width, gaps))
        over, sense = _against_rib(self, m.z)
        f_z = 0.0
        if over > 0.0:
            f_z = -self.flange * (over * sense + damping_time * m.v_z)
            lost += damping_time * self.flange * m.v_z * m.v_z
            energy += 0.5 * self.flange * over * over
        line = _lamina(self.stiffness, deepest) / width
        return RingLoads(f_x, f_y, f_z, m_x, m_y, lost, energy, largest, loaded, 0.0, line)

    @kernel
    def ring_stiffness(self, motion: RingMotion, gaps: Array, out: Array) -> None:
        """Write the stiffness of all laminae and of the ribs."""
        m, count = motion, int(self.n_elements)
        width = self.length / max(1, gaps.size)
        for i in range(out.size):
            out[i] = 0.0
        cos_c, sin_c = math.cos(m.cage_angle), math.sin(m.cage_angle)
        for i in range(count):
            c = COS_TABLE[count, i] * cos_c - SIN_TABLE[count, i] * sin_c
            s = SIN_TABLE[count, i] * cos_c + COS_TABLE[count, i] * sin_c
            radial, slope = m.x * c + m.y * s, m.ry * c - m.rx * s
            one = _sums(radial, slope, width, self.stiffness, gaps, 0.0)
            middle = one.k_1 / one.k_0 if one.k_0 > 0.0 else 0.0  # of the line of contact
            add_stiffness(out, one.k_0, (c, s, 0.0, -middle * s, middle * c))
            about = one.k_2 - one.k_1 * middle
            add_stiffness(out, about, (0.0, 0.0, 0.0, -s, c))
        over, _ = _against_rib(self, m.z)
        add_stiffness(out, self.flange if over > 0.0 else 0.0, (0.0, 0.0, 1.0, 0.0, 0.0))

    @kernel
    def ring_pressure(self, loads: RingLoads) -> float:
        """Return the largest Hertz pressure on the inner ring [Pa]."""
        return self.pressure * math.sqrt(loads.high)

    @kernel
    def write_of_rings(self, loads: RingLoads, out: Array, first: int) -> None:
        """Write the largest load per length [N/m]."""
        out[first] = loads.high


class _Roller(NamedTuple):
    """Sums over the laminae of a roller, t along it."""

    load: float  # q [N]
    moment: float  # q t [N.m]
    energy: float  # [J]
    k_0: float  # k [N/m]
    k_1: float  # k t [N]
    k_2: float  # k t^2 [N.m]


@inlined
def _lamina(c_s: float, d: float) -> float:
    """Return the load of a lamina, 0 where it is apart."""
    x = d * (1.0 / _UNIT)
    x = ROOT_MIN if x < ROOT_MIN else x
    x = ROOT_MAX if x > ROOT_MAX else x
    root = c_s * _ROOT_OF_UNIT * ninth_root(x)
    return root * d if d > 0.0 else 0.0


@summing
def _sums(
    radial: float, slope: float, width: float, c_s: float, gaps: Array, reach: float
) -> _Roller:
    """Return the sums of a roller whose races approach by `radial` in its middle.

    Stiffness fades in over an approach of `reach` [m].
    """
    load = moment = energy = k_0 = k_1 = k_2 = 0.0
    middle = 0.5 * (gaps.size - 1)
    for k in range(gaps.size):
        t = (k - middle) * width
        d = radial + t * slope - gaps[k]
        q = _lamina(c_s, d)
        stiffness = _STEEPER * q / max(d, max(reach, _LEAST))
        load += q
        moment += q * t
        energy += q * d
        k_0 += stiffness
        k_1 += stiffness * t
        k_2 += stiffness * t * t
    return _Roller(load, moment, 9.0 / 19.0 * energy, k_0, k_1, k_2)


@kernel
def _deepest(radial: float, slope: float, width: float, gaps: Array) -> float:
    """Return the largest approach of a lamina, from the middle on uphill: gaps are convex."""
    middle, sense = 0.5 * (gaps.size - 1), 1 if slope > 0.0 else -1
    k = (gaps.size - (0 if sense > 0 else 1)) // 2  # of two laminae in the middle the uphill one
    found = -math.inf
    while 0 <= k < gaps.size:
        d = radial + (k - middle) * width * slope - gaps[k]
        if not d > found:
            break
        found = d
        k += sense
    return max(found, 0.0)


@inside
def _against_rib(p: CylinderRings, z: float) -> tuple[float, float]:
    """Return how far the inner ring is pressed into the ribs, and to which side."""
    if p.flange <= 0.0:
        return 0.0, 0.0
    sense = p.side if p.side != 0.0 else (1.0 if z > 0.0 else -1.0)
    return sense * z - p.flange_gap, sense


def cylinder_rings(
    n_rollers: int,
    roller_diameter: float,
    pitch_diameter: float,
    length: float,
    contact_modulus: float,
    *,
    laminae: int,
    clearance: float = 0.0,
    profile: float = PROFILE,
    flange: float = 0.0,
    flange_gap: float = 0.0,
    side: int = 0,
) -> tuple[CylinderRings, Array]:
    """Return the numbers of a cylindrical roller bearing, and the gap of each lamina [m].

    c_s = 35948 L^(8/9)/n  [N, mm],  P(t) = c D ln(1/(1 - (2 t/L)^2)),  gap = s/2 + 2 P

    Parameters
    ----------
    n_rollers : int
        Number of rollers, 3 to 40.
    roller_diameter, pitch_diameter, length : float
        D, D_pw, effective length L [m].
    contact_modulus : float
        E* [Pa], for the pressure; the stiffness is that of steel.
    laminae : int
        n of a roller; the standard asks for 30 or more.
    clearance : float
        Internal radial clearance s, of the diameter [m].
    profile : float
        c of the logarithmic profile [-], that of the standard for L up to 2.5 D.
    flange, flange_gap, side
        See `CylinderRings`.

    References
    ----------
    [iso_16281]
    """
    inner = 1.0 / (2.0 / roller_diameter + 2.0 / (pitch_diameter - roller_diameter))
    stiffness = _LAMINA * (length / _MM) ** (8.0 / 9.0) / laminae / _MM ** (10.0 / 9.0)
    pressure = LARGEST_OVER_MEAN * line_mean_pressure(1.0, inner, contact_modulus)
    load = (REFERENCE_PRESSURE / pressure) ** 2 * length / laminae
    rings = CylinderRings(
        n_elements=float(n_rollers),
        stiffness=stiffness,
        half_clearance=0.5 * clearance,
        length=float(length),
        flange=float(flange),
        flange_gap=float(flange_gap),
        side=float(side),
        pressure=pressure,
        cage_ratio=0.5 * (1.0 - roller_diameter / pitch_diameter),
        spring=0.15 * n_rollers * laminae * stiffness**0.9 * load**0.1,
    )
    share = (2.0 * np.arange(laminae) + 1.0) / laminae - 1.0  # 2 t/L
    return rings, 0.5 * clearance - 2.0 * profile * roller_diameter * np.log1p(-share * share)
