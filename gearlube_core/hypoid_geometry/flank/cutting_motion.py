"""Motion of a blade edge in the blank: points, derivatives and the equation of meshing.

One description covers every case: a cutter with its blade edge, carried by a cradle, cuts a work
piece that turns with the cutter (continuous indexing) and with the cradle (roll). Everything is
expressed in the fixed frame of the assembled pair, work piece at rotation zero.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.hypoid_geometry.flank.vectors import (
    Vector,
    add,
    combine,
    cross,
    dot,
    norm,
    rotate,
    subtract,
)
from gearlube_core.kernels.jit import kernel


class CuttingMotion(NamedTuple):
    """Blade edge and motions that cut one flank.

    The edge at height u [m] above the reference plane, towards the blade tip, stands at the radius
    r_c + e(u) with e = slope u + bend u^2, along the direction turned by the blade offset angle
    from the cutter radius. At cutter angle th [rad] and cradle angle ph [rad] the work piece has
    turned by psi = -index_ratio th - roll_ratio (ph - c2 ph^2 / 2 - c3 ph^3 / 6) about its axis,
    with the coefficients of modified roll c2, c3, and the cutter has moved by lead ph along the
    cradle axis (helical motion).
    """

    radius: float  # r_c [m], cutter radius at the reference plane
    slope: float  # tan(blade angle), positive where the radius grows towards the tip
    bend: float  # [1/m]
    cos_offset: float  # blade offset angle dl
    sin_offset: float
    cutter_centre: Vector  # in the reference plane [m], at cradle angle zero
    cutter_axis: Vector  # unit, towards the blade tips
    cutter_zero: Vector  # unit, normal to the axis: cutter angle zero
    cradle_point: Vector  # [m]
    cradle_axis: Vector
    work_point: Vector  # [m]
    work_axis: Vector
    index_ratio: float  # blade groups / teeth; 0 for single indexing (face milling)
    roll_ratio: float  # ratio of roll; unused without generation
    generated: float  # 1: the cradle rolls; 0: form cut (Formate), ph = 0
    roll_second: float = 0.0  # c2 [1/rad], modified roll
    roll_third: float = 0.0  # c3 [1/rad^2]
    lead: float = 0.0  # helical motion [m/rad]


class CutState(NamedTuple):
    """Point of the blade edge in the blank, with its derivatives.

    Derivatives with respect to u, th, ph; `meshing` is (r_u x r_th) . r_ph, zero on the envelope
    (for a form-cut flank: ph itself).
    """

    r: Vector
    r_u: Vector
    r_th: Vector
    r_ph: Vector
    normal: Vector  # r_u x r_th, not normalised
    normal_u: Vector
    normal_th: Vector
    normal_ph: Vector
    meshing: float
    meshing_u: float
    meshing_th: float
    meshing_ph: float


@kernel
def work_angle(motion: CuttingMotion, th: float, ph: float) -> float:
    """Return the work's rotation psi [rad] at cutter angle `th`, cradle angle `ph` [rad]."""
    bent = ph * (1.0 - ph * (motion.roll_second / 2.0 + ph * motion.roll_third / 6.0))
    return -motion.index_ratio * th - motion.generated * motion.roll_ratio * bent


@kernel
def _roll_rates(motion: CuttingMotion, ph: float) -> tuple[float, float]:
    """Return the ratio of roll [-] at cradle angle `ph` [rad] and its change [1/rad]."""
    roll = motion.generated * motion.roll_ratio
    rate = 1.0 - ph * (motion.roll_second + 0.5 * ph * motion.roll_third)
    return roll * rate, -roll * (motion.roll_second + ph * motion.roll_third)


@kernel
def cut_state(motion: CuttingMotion, u: float, th: float, ph: float) -> CutState:
    """Return the state of blade height `u` [m], cutter angle `th`, cradle angle `ph` [rad].

    References
    ----------
    [litvin_fuentes_2004 ch. 6] [litvin_fuentes_2004 ch. 8] (envelope,
    equation of meshing); [karagiannis_2012 Table 1] (machine settings).
    """
    cos_th = math.cos(th)
    sin_th = math.sin(th)
    side = cross(motion.cutter_axis, motion.cutter_zero)
    radial = combine(cos_th, motion.cutter_zero, sin_th, side)
    tangential = combine(-sin_th, motion.cutter_zero, cos_th, side)
    e = u * (motion.slope + u * motion.bend)
    e_u = motion.slope + 2.0 * u * motion.bend
    e_uu = 2.0 * motion.bend
    reach = motion.radius + e * motion.cos_offset
    shift = e * motion.sin_offset
    cos_e, sin_e = motion.cos_offset, motion.sin_offset
    q = combine(1.0, combine(reach, radial, shift, tangential), u, motion.cutter_axis)
    q = subtract(add(q, motion.cutter_centre), motion.cradle_point)
    q_u = combine(
        1.0, combine(e_u * cos_e, radial, e_u * sin_e, tangential), 1.0, motion.cutter_axis
    )
    q_uu = combine(e_uu * cos_e, radial, e_uu * sin_e, tangential)
    q_th = combine(reach, tangential, -shift, radial)
    q_thth = combine(-reach, radial, -shift, tangential)
    q_uth = combine(e_u * cos_e, tangential, -e_u * sin_e, radial)

    cradle = motion.cradle_axis
    cos_ph = math.cos(ph)
    sin_ph = math.sin(ph)
    q = rotate(q, cradle, cos_ph, sin_ph)
    q_u = rotate(q_u, cradle, cos_ph, sin_ph)
    q_uu = rotate(q_uu, cradle, cos_ph, sin_ph)
    q_th = rotate(q_th, cradle, cos_ph, sin_ph)
    q_thth = rotate(q_thth, cradle, cos_ph, sin_ph)
    q_uth = rotate(q_uth, cradle, cos_ph, sin_ph)
    # a shift along the cradle axis: the cradle turns the blade alike
    q = combine(1.0, q, motion.generated * motion.lead * ph, cradle)
    w = subtract(add(q, motion.cradle_point), motion.work_point)

    # in axes that turn with the work piece, d/dk = partial d/dk + rate_k axis x
    axis = motion.work_axis
    index = motion.index_ratio
    roll, roll_change = _roll_rates(motion, ph)
    by_cradle = motion.generated
    r_u = q_u
    r_th = combine(1.0, q_th, index, cross(axis, w))
    swing = cross(cradle, q)
    along = motion.generated * motion.lead
    swing = combine(1.0, swing, along, cradle)
    r_ph = combine(by_cradle, swing, roll, cross(axis, w))
    r_uu = q_uu
    r_uth = combine(1.0, q_uth, index, cross(axis, q_u))
    r_uph = combine(by_cradle, cross(cradle, q_u), roll, cross(axis, q_u))
    r_thth = combine(1.0, q_thth, index, cross(axis, add(q_th, r_th)))
    r_thph = combine(
        1.0,
        combine(by_cradle, cross(cradle, q_th), by_cradle * index, cross(axis, swing)),
        roll,
        cross(axis, r_th),
    )
    r_phph = combine(
        1.0,
        combine(by_cradle, cross(cradle, swing), roll, cross(axis, swing)),
        roll,
        cross(axis, r_ph),
    )
    r_phph = combine(1.0, r_phph, roll_change, cross(axis, w))

    normal = cross(r_u, r_th)
    normal_u = add(cross(r_uu, r_th), cross(r_u, r_uth))
    normal_th = add(cross(r_uth, r_th), cross(r_u, r_thth))
    normal_ph = add(cross(r_uph, r_th), cross(r_u, r_thph))
    if motion.generated > 0.5:
        meshing = dot(normal, r_ph)
        meshing_u = dot(normal_u, r_ph) + dot(normal, r_uph)
        meshing_th = dot(normal_th, r_ph) + dot(normal, r_thph)
        meshing_ph = dot(normal_ph, r_ph) + dot(normal, r_phph)
    else:
        meshing, meshing_u, meshing_th, meshing_ph = ph, 0.0, 0.0, 1.0

    psi = work_angle(motion, th, ph)
    c = math.cos(psi)
    s = -math.sin(psi)
    return CutState(
        add(rotate(w, axis, c, s), motion.work_point),
        rotate(r_u, axis, c, s),
        rotate(r_th, axis, c, s),
        rotate(r_ph, axis, c, s),
        rotate(normal, axis, c, s),
        rotate(normal_u, axis, c, s),
        rotate(normal_th, axis, c, s),
        rotate(normal_ph, axis, c, s),
        meshing,
        meshing_u,
        meshing_th,
        meshing_ph,
    )


@kernel
def blade_offset_angle(motion: CuttingMotion, th: float, ph: float) -> float:
    """Return the offset angle [rad] that sets the blade face normal to the cutting velocity.

    Taken at the reference plane (u = 0), cutter angle `th` and cradle angle `ph` [rad]; it depends
    on the slope of nothing: the point at u = 0 is the same for every offset angle.
    """
    state = cut_state(motion, 0.0, th, ph)
    psi = work_angle(motion, th, ph)
    velocity = rotate(state.r_th, motion.work_axis, math.cos(psi), math.sin(psi))
    velocity = rotate(velocity, motion.cradle_axis, math.cos(ph), -math.sin(ph))
    side = cross(motion.cutter_axis, motion.cutter_zero)
    radial = combine(math.cos(th), motion.cutter_zero, math.sin(th), side)
    tangential = combine(-math.sin(th), motion.cutter_zero, math.cos(th), side)
    return math.atan2(-dot(velocity, radial), dot(velocity, tangential))


@kernel
def unit_normal(state: CutState) -> Vector:
    """Return the unit normal of the surface [-], in the direction r_u x r_th."""
    scale = 1.0 / norm(state.normal)
    return Vector(state.normal.x * scale, state.normal.y * scale, state.normal.z * scale)
