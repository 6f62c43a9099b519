"""Check whether machine settings can mesh, and suggest single changes that would correct them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.cutting_motion import cut_state, unit_normal
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Role, Side
from gearlube_core.hypoid_geometry.flank.machine_frames import (
    gear_cut,
    pinion_cut,
    reference_plane_distance,
    reference_point,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.units import DEGREE, MILLIMETRE

REFERENCE_LIMIT = 1e-4  # m; a tenth of a millimetre is 60 times the misfit of the shipped pair
MISMATCH_LIMIT = 0.5 * DEGREE  # over the working depth a gap of 60 um

# fields that move a cutter's reference plane, and how far a cure is looked for
_PINION_FIELDS = {
    "pinion.machine.sliding_base_mm": 20.0,
    "pinion.machine.machine_center_to_back_mm": 20.0,
    "pinion.machine.blank_offset_mm": 20.0,
    "pinion.machine.radial_setting_mm": 20.0,
    "pinion.machine.basic_swivel_angle_deg": 20.0,
    "pinion.machine.tilt_angle_deg": 20.0,
    "pinion.machine.machine_root_angle_deg": 20.0,
}
_GEAR_FIELDS = {
    "gear.machine.machine_center_to_back_mm": 20.0,
    "gear.machine.machine_root_angle_deg": 20.0,
}
_TRIALS = 41


@dataclass(frozen=True, slots=True)
class Suggestion:
    """A change of one field that alone would remove a misfit.

    Parameters
    ----------
    field : str
        Dotted name, as `HypoidGearFile.varied` takes it.
    value_now, value_that_meets : float
    unit : str
        Of both values.
    """

    field: str
    value_now: float
    value_that_meets: float
    unit: str

    def __str__(self) -> str:
        now, then = f"{self.value_now:.3f}", f"{self.value_that_meets:.3f}"
        return f"{self.field} from {now} to {then} {self.unit}"


def reference_misfit(file: HypoidGearFile, role: str) -> float:
    """Return the distance of a cutter's reference plane from the middle of the working depth [m].

    For the pinion: height of the mean reference point over the plane, at the cradle angle that
    brings it to the point radius. For the gear: height of the cutter's path over the middle of the
    working depth where it crosses the mean cone distance. Positive towards the blade tips.
    """
    blank = file.blank()
    if role == "pinion":
        return reference_plane_distance(pinion_cut(file, "concave"), blank)
    cut = gear_cut(file, "convex")
    r = np.array(cut_state(cut.motion, 0.0, cut.cutter_angle, 0.0).r) - blank.gear_apex
    delta = blank.gear.pitch_angle
    height = math.hypot(r[0], r[1]) * math.cos(delta) - r[2] * math.sin(delta)
    return height - (blank.gear.addendum - 0.5 * blank.working_depth)


def pressure_angle(file: HypoidGearFile, role: Role, side: Side) -> float:
    """Return the pressure angle [rad] of the surface that a cutter's blades sweep.

    Angle between its normal and the pitch plane, where the blades' path passes the mean reference
    point. For a form-cut gear this surface is the flank; the pinion's is the tooth that generates
    it and stands in for the gear's.
    """
    blank = file.blank()
    cut = (pinion_cut if role == "pinion" else gear_cut)(file, CURVES[role, side])
    axis, point = np.array(cut.motion.work_axis), np.array(cut.motion.work_point)
    state = cut_state(cut.motion, 0.0, cut.cutter_angle, cut.cradle_angle)
    mean, r = reference_point(blank) - point, np.array(state.r) - point
    turn = math.atan2(float(axis @ np.cross(r, mean)), float(r @ mean - (axis @ r) * (axis @ mean)))
    normal = Rotation.from_rotvec(turn * axis).apply(np.array(unit_normal(state)))
    return math.asin(abs(float(normal @ blank.pitch_normal())))


def pressure_angle_mismatch(file: HypoidGearFile, side: Side) -> float:
    """Return by how much the tooth that generates the pinion differs from the gear's [rad].

    Pinion's less gear's pressure angle of `pressure_angle`; positive: the pinion's flank is the
    flatter one, and bears at its root and the gear's tip.
    """
    return pressure_angle(file, "pinion", side) - pressure_angle(file, "gear", side)


def suggest_settings(file: HypoidGearFile, limit: float = REFERENCE_LIMIT) -> list[Suggestion]:
    """Return single changes that would move the reference plane to its place; empty if correct.

    Every setting that moves the plane is searched on its own, 20 mm or 20 deg to both sides; those
    that cannot close the misfit are left out.

    Parameters
    ----------
    file : HypoidGearFile
    limit : float
        Misfit [m] that is still taken as meeting.
    """
    check_positive("limit", limit, "m")
    found = []
    for role, fields in (("pinion", _PINION_FIELDS), ("gear", _GEAR_FIELDS)):
        if abs(_or_nan(lambda: reference_misfit(file, role))) <= limit:  # noqa: B023
            continue
        for field, span in fields.items():
            suggestion = _solve(
                file,
                field,
                span,
                lambda varied: reference_misfit(varied, role),  # noqa: B023
            )
            found += [suggestion] if suggestion else []
    return found


def suggest_corrections(file: HypoidGearFile, limit: float = MISMATCH_LIMIT) -> list[Suggestion]:
    """Return the blade angle corrections of the pinion that make its pressure angles the gear's.

    Only for sides whose mismatch exceeds `limit` [rad].
    """
    check_positive("limit", limit, "rad")
    found = []
    for side, curve in _sides():
        if abs(pressure_angle_mismatch(file, side)) <= limit:
            continue
        field = f"pinion.cutter.{curve}_flank_angle_correction_deg"
        suggestion = _solve(
            file,
            field,
            4.9,
            lambda varied: pressure_angle_mismatch(varied, side),  # noqa: B023
        )
        found += [suggestion] if suggestion else []
    return found


def setting_report(file: HypoidGearFile) -> list[str]:
    """Return the faults of a gear file that prevent good meshing, one sentence each."""
    sentences = []
    suggestions = suggest_settings(file)
    for role in ("pinion", "gear"):
        cures = [str(one) for one in suggestions if one.field.startswith(role)]
        misfit = _or_nan(lambda: reference_misfit(file, role))  # noqa: B023
        if abs(misfit) <= REFERENCE_LIMIT:
            continue
        size = (
            "does not reach the mean point at all"
            if math.isnan(misfit)
            else f"misses the middle of the working depth by {misfit / MILLIMETRE:.3f} mm"
        )
        cure = f" Any one of these would cure it: {'; '.join(cures)}." if cures else ""
        sentences.append(f"{role} cutter's reference plane {size}.{cure}")
    if sentences:
        return sentences
    cures_of = {one.field: one for one in suggest_corrections(file)}
    for side, curve in _sides():
        mismatch = pressure_angle_mismatch(file, side)
        if abs(mismatch) > MISMATCH_LIMIT:
            cure_of = cures_of.get(f"pinion.cutter.{curve}_flank_angle_correction_deg")
            cure = f" To cure it, change {cure_of}." if cure_of else ""
            sentences.append(
                f"{side} flanks differ by {mismatch / DEGREE:+.2f} deg of pressure angle "
                f"(pinion less gear) at the mean point.{cure}"
            )
    return sentences


def _sides() -> Iterator[tuple[Side, str]]:
    for (role, side), curve in CURVES.items():
        if role == "pinion":
            yield side, curve


def _or_nan(function: Callable[[], float]) -> float:
    """Return the value, or NaN where the settings do not even cut the tooth."""
    try:
        return function()
    except ParameterError:
        return math.nan


def _solve(
    file: HypoidGearFile, field: str, span: float, misfit: Callable[[HypoidGearFile], float]
) -> Suggestion | None:
    """Return the value of `field`, nearest to that of the file, at which `misfit` vanishes."""
    role, section, key = field.split(".")
    now = float(getattr(getattr(getattr(file, role), section), key))

    def at(value: float) -> float:
        return _or_nan(lambda: misfit(file.varied({field: float(value)})))

    grid = now + np.linspace(-span, span, _TRIALS)
    values = np.array([at(value) for value in grid])
    with np.errstate(invalid="ignore"):
        crossings = np.flatnonzero(values[1:] * values[:-1] < 0.0)
    roots = [float(brentq(at, grid[i], grid[i + 1], xtol=1e-9)) for i in crossings]
    if not roots:
        return None
    nearest = min(roots, key=lambda value: abs(value - now))
    return Suggestion(field, now, nearest, "mm" if field.endswith("_mm") else "deg")
