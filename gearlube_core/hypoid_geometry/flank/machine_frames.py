"""Machine settings of a gear file as cutting motions in the fixed frame of the pair."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal, NamedTuple

import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.cutting_motion import (
    CuttingMotion,
    blade_offset_angle,
    cut_state,
)
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.gear_file_sections import Cutter, Gear, Pinion
from gearlube_core.kernels.jit import kernel
from gearlube_core.units import DEGREE, MILLIMETRE

Curve = Literal["convex", "concave"]

_X, _Y, _Z = np.eye(3)
_TURN = np.linspace(-math.pi, math.pi, 361)  # tried for a root: a degree of rotation each
_WIDER = 1e-9  # rad
# machine root angle beyond which a cradle stands in for a crown gear, not for the mate
CROWN_ROOT_ANGLE = 10.0 * DEGREE


class ReferenceCut(NamedTuple):
    """A cutting motion and the angles [rad] at which it cuts the mean reference point."""

    motion: CuttingMotion
    cutter_angle: float
    cradle_angle: float


def reference_point(blank: HypoidBlank) -> Array:
    """Return the mean point moved to the reference plane (mid working depth) [m], (3,)."""
    depth = 0.5 * blank.working_depth - blank.gear.addendum
    return blank.mean_point() - depth * blank.pitch_normal()


def gear_cut(file: HypoidGearFile, curve: Curve) -> ReferenceCut:
    """Return the motion that cuts the gear's `curve` flank, form-cut or generated.

    The cutter axis is normal to the root cone's generator in the plane of the gear axis; its
    reference plane has its apex `machine_center_to_back` before the crossing point. With a ratio
    of roll the cradle turns about the line through this apex along the cutter axis.
    """
    gear = file.gear
    machine = gear.machine
    root = machine.machine_root_angle_deg * DEGREE
    along = np.array([math.sin(root), 0.0, math.cos(root)])
    inward = np.array([-math.cos(root), 0.0, math.sin(root)])
    centre = (
        -machine.machine_center_to_back_mm * _Z
        + machine.horizontal_setting_mm * along
        + machine.vertical_setting_mm * _Y
        - machine.sliding_base_mm * inward
    ) * MILLIMETRE
    rolls = machine.ratio_of_roll is not None
    apex = -machine.machine_center_to_back_mm * MILLIMETRE * _Z
    motion = CuttingMotion(
        **_blade(gear, curve),
        cutter_centre=_vector(centre),
        cutter_axis=_vector(inward),
        cutter_zero=_vector(along),
        cradle_point=_vector(apex if rolls else np.zeros(3)),
        cradle_axis=_vector(-inward if rolls else _Z),
        work_point=_vector(np.zeros(3)),
        work_axis=_vector(_Z),
        index_ratio=gear.cutter.blade_groups / gear.teeth,
        roll_ratio=machine.ratio_of_roll or 0.0,
        generated=1.0 if rolls else 0.0,
    )
    angle = _gear_cutter_angle(motion, file.blank())
    return ReferenceCut(_with_offset(motion, gear.cutter, angle, 0.0), angle, 0.0)


def pinion_cut(file: HypoidGearFile, curve: Curve) -> ReferenceCut:
    """Return the motion that cuts the pinion's `curve` flank, generated with cutter tilt.

    The cradle axis is the gear axis of the pair, moved and turned as the settings say: the tilted
    cutter axis stands at the azimuth q - j - 90 deg about it (q basic cradle, j basic swivel
    angle); machine root angle and machine centre to back count as the pinion's own motion.
    """
    pinion = file.pinion
    machine = pinion.machine
    cradle = machine.basic_cradle_angle_deg * DEGREE
    tilt = machine.tilt_angle_deg * DEGREE
    azimuth = cradle - machine.basic_swivel_angle_deg * DEGREE - 0.5 * math.pi
    centre = (
        machine.radial_setting_mm * MILLIMETRE * np.array([math.cos(cradle), math.sin(cradle), 0.0])
    )
    axis = np.array(
        [math.sin(tilt) * math.cos(azimuth), math.sin(tilt) * math.sin(azimuth), -math.cos(tilt)]
    )
    zero = centre - (centre @ axis) * axis
    turn = Rotation.from_rotvec(machine.machine_root_angle_deg * DEGREE * _Y)
    crossing = (
        np.array([0.0, machine.blank_offset_mm, -machine.sliding_base_mm])
        + machine.machine_center_to_back_mm * turn.apply(_X)
    ) * MILLIMETRE
    back = turn.inv()
    pinion_point = file.pair.offset_mm * MILLIMETRE * _Y
    motion = CuttingMotion(
        **_blade(pinion, curve),
        cutter_centre=_vector(back.apply(centre - crossing) + pinion_point),
        cutter_axis=_vector(back.apply(axis)),
        cutter_zero=_vector(-back.apply(zero) / np.linalg.norm(zero)),
        cradle_point=_vector(back.apply(-crossing) + pinion_point),
        cradle_axis=_vector(back.apply(_Z)),
        work_point=_vector(pinion_point),
        work_axis=_vector(_X),
        index_ratio=pinion.cutter.blade_groups / pinion.teeth,
        roll_ratio=machine.ratio_of_roll,
        generated=1.0,
        roll_second=machine.modified_roll_2c,
        roll_third=machine.modified_roll_6d,
        lead=machine.helical_motion_mm_per_rad * MILLIMETRE,
    )
    point = _cut_point(motion, file.blank())
    cradle_angle = _pinion_cradle_angle(motion, point)
    _, radial = _from_cutter(motion, point, cradle_angle)
    side = np.cross(motion.cutter_axis, motion.cutter_zero)
    angle = math.atan2(radial @ side, radial @ np.array(motion.cutter_zero))
    return ReferenceCut(
        _with_offset(motion, pinion.cutter, angle, cradle_angle), angle, cradle_angle
    )


def _cut_point(motion: CuttingMotion, blank: HypoidBlank) -> Array:
    """Return where the mean reference point is cut [m], (3,): the pinion turned to the cutter.

    A cradle that stands in for the gear cuts it where the gear will touch it. A cradle that stands
    in for a crown gear, its axis across the pitch plane, cuts it where the pinion's cone touches
    that plane: on the side that the cradle axis points to.
    """
    point = reference_point(blank)
    axis, cradle = np.array(motion.work_axis), np.array(motion.cradle_axis)
    along = float(cradle @ axis)
    if abs(along) < math.sin(CROWN_ROOT_ANGLE):
        return point
    own = point - np.array(motion.work_point)
    axial = float(own @ axis)
    up = (cradle - along * axis) / math.sqrt(1.0 - along**2)
    return np.asarray(motion.work_point + axial * axis + np.linalg.norm(own - axial * axis) * up)


def other_flank(cut: ReferenceCut, member: Gear | Pinion, curve: Curve) -> ReferenceCut:
    """Return the motion that cuts the `curve` flank, from that of the member's other flank.

    The blades of both flanks pass the mean reference point at the same angles.
    """
    motion = cut.motion._replace(**_blade(member, curve))  # type: ignore[arg-type]
    motion = _with_offset(motion, member.cutter, cut.cutter_angle, cut.cradle_angle)
    return cut._replace(motion=motion)


def reference_plane_distance(cut: ReferenceCut, blank: HypoidBlank) -> float:
    """Return the height [m] of the mean reference point over the cutter's reference plane."""
    return float(_from_cutter(cut.motion, _cut_point(cut.motion, blank), cut.cradle_angle)[0])


def _vector(a: Array) -> Vector:
    return Vector(float(a[0]), float(a[1]), float(a[2]))


def _blade(member: Gear | Pinion, curve: Curve) -> dict[str, float]:
    """Return the edge of the blades: inside blades (convex flank) widen towards the tip."""
    cutter = member.cutter
    if curve == "convex":
        sign = 1.0
        angle = cutter.convex_flank_blade_angle_deg + cutter.convex_flank_angle_correction_deg
    else:
        sign = -1.0
        angle = cutter.concave_flank_blade_angle_deg + cutter.concave_flank_angle_correction_deg
    radius = cutter.edge_radius_mm(curve)
    bend = 0.0 if radius is None else -sign / (2.0 * radius * MILLIMETRE)
    return {
        "radius": cutter.point_radius_mm * MILLIMETRE,
        "slope": sign * math.tan(angle * DEGREE),
        "bend": bend,
        "cos_offset": 1.0,
        "sin_offset": 0.0,
    }


def _with_offset(motion: CuttingMotion, cutter: Cutter, th: float, ph: float) -> CuttingMotion:
    given = cutter.blade_offset_angle_deg
    angle = blade_offset_angle(motion, th, ph) if given is None else given * DEGREE
    return motion._replace(cos_offset=math.cos(angle), sin_offset=math.sin(angle))


def _from_cutter(motion: CuttingMotion, point: Array, ph: float | Array) -> tuple[Array, Array]:
    """Return height over the reference plane (...) and radius vector (..., 3) of `point` [m].

    The cradle is turned by `ph`, of shape (...).
    """
    origin, axis = np.array(motion.cradle_point), np.array(motion.cutter_axis)
    cradle, arm = np.array(motion.cradle_axis), point - origin
    turned = (
        np.multiply.outer(np.cos(ph), arm - (arm @ cradle) * cradle)
        - np.multiply.outer(np.sin(ph), np.cross(cradle, arm))
        + np.multiply.outer(arm @ cradle - motion.lead * np.asarray(ph), cradle)
    )
    offset = turned + origin - np.array(motion.cutter_centre)
    height = offset @ axis
    return height, offset - np.multiply.outer(height, axis)


def _roots(function: Callable[[float], float], values: Array) -> list[float]:
    """Return the roots of a function of an angle whose `values` are known on the grid `_TURN`."""
    crossed = (values[1:] * values[:-1] < 0.0) | (values[:-1] == 0.0)
    return [
        # a root on a node of the grid lies inside the widened interval
        float(brentq(function, _TURN[i] - _WIDER, _TURN[i + 1] + _WIDER, xtol=1e-14))
        for i in np.flatnonzero(crossed)
    ]


def _pinion_cradle_angle(motion: CuttingMotion, point: Array) -> float:
    def excess(ph: Array) -> Array:
        radial = _from_cutter(motion, point, ph)[1]
        return np.asarray(np.linalg.norm(radial, axis=-1) - motion.radius)

    values = excess(_TURN)
    candidates = _roots(lambda ph: float(excess(np.asarray(ph))), values)
    if not candidates:
        nearest = float(np.min(np.abs(values)))
        raise ParameterError(
            "The pinion's cutter does not reach the mean point at any cradle angle: it passes it "
            f"by {nearest / MILLIMETRE:.3g} mm. Check radial_setting_mm (a change of about "
            "that size would mesh), point_radius_mm, sliding_base_mm and blank_offset_mm."
        )
    return min(candidates, key=abs)


@kernel
def _path_section(motion: CuttingMotion, angles: Array, places: Array) -> None:
    """Write radius and z [m] of the blades' path at cutter angles (n,) [rad] to `places` (n, 2)."""
    for i in range(angles.size):
        r = cut_state(motion, 0.0, angles[i], 0.0).r
        places[i, 0] = math.hypot(r.x, r.y)
        places[i, 1] = r.z


def _gear_cutter_angle(motion: CuttingMotion, blank: HypoidBlank) -> float:
    """Return the cutter angle at the mean cone distance where the spiral angle is the blank's."""
    gear = blank.gear
    apex, sine, cosine = blank.gear_apex, math.sin(gear.pitch_angle), math.cos(gear.pitch_angle)

    def excess(th: float) -> float:
        r = np.array(cut_state(motion, 0.0, th, 0.0).r) - apex
        return math.hypot(r[0], r[1]) * sine + float(r[2]) * cosine - gear.mean_cone_distance

    def spiral_angle(th: float) -> float:
        state = cut_state(motion, 0.0, th, 0.0)
        r, tangent = np.array(state.r), np.array(state.r_th)
        radial = np.array([r[0], r[1], 0.0]) / math.hypot(r[0], r[1])
        along = sine * radial + cosine * _Z
        return math.atan(
            float(tangent @ np.cross(along, radial * cosine - sine * _Z)) / float(tangent @ along)
        )

    places = np.empty((_TURN.size, 2))
    _path_section(motion, _TURN, places)
    distances = places[:, 0] * sine + (places[:, 1] - apex[2]) * cosine
    candidates = _roots(excess, distances - gear.mean_cone_distance)
    if not candidates:
        raise ParameterError(
            "The gear's cutter does not cross the middle of the face, cone distance "
            f"{gear.mean_cone_distance / MILLIMETRE:.4g} mm. Check horizontal_setting_mm, "
            "vertical_setting_mm and point_radius_mm of the gear."
        )
    return min(candidates, key=lambda th: abs(spiral_angle(th) - gear.spiral_angle))
