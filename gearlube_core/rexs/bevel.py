"""Bevel and hypoid pairs: a bevel stage of REXS as a blank file."""

from __future__ import annotations

from typing import Any

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.rexs.document import member_attributes
from gearlube_core.rexs.stage import Stage
from gearlube_core.storage.file_names import as_name
from gearlube_core.units import DEGREE

_RIGHT_ANGLE = 1e-3  # deg
_AGREE = {"mm": 0.02, "deg": 0.05}  # printed tables are rounded to this
_SIDES = ("drive", "coast")


def blank_data(stage: Stage, given: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of a blank file by their dotted names.

    Of several methods of ISO 23509 for which the file has the numbers, the one whose cones and
    spiral angles come nearest to those of the file is taken.

    Parameters
    ----------
    stage : Stage
    given : dict
        Dotted fields that the user gives; the file may lack them.

    Raises
    ------
    ParameterError
        A number is missing or wrong, or the pair is of another kind.

    References
    ----------
    [fva_2022]; [iso_23509 6].
    """
    name = "".join(c if c.isalnum() or c in "_+-. " else "_" for c in stage.stage.name)
    data: dict[str, Any] = {"name": as_name(name.lstrip(". ") or stage.model.path.stem)}
    _check_shafts(stage)
    for role, one in stage.members().items():
        place = (one, "number_of_teeth", "none")
        teeth = stage.required(f"pair.{role}_teeth", place, given=given)
        data[f"pair.{role}_teeth"] = None if teeth is None else round(teeth)
    data["pair.offset_mm"] = _offset(stage)
    data["pair.pinion_hand"] = _hand(stage)
    for field, place in (
        ("pair.face_width_mm", (stage.gear, "face_width", "mm")),
        ("cutter.radius_mm", (stage.stage, "cutter_radius", "mm")),
    ):
        data[field] = stage.required(field, place, given=given)
    groups = stage.optional("cutter.blade_groups", (stage.stage, "number_of_blade_groups", "none"))
    data["cutter.blade_groups"] = round(groups or 0)
    if groups is None:
        reason = "number_of_blade_groups is absent: taken as face-milled, 0"
        stage.note("lacking", "cutter.blade_groups", reason)
    sizes = _sizes(stage, data, given)
    stage.check_complete()
    data = {key: value for key, value in data.items() if value is not None}
    blank = _nearest(stage, data, sizes, given)
    data |= _chosen(sizes, blank.file.design_method)
    data |= _pressure_angles(stage, blank)
    data |= _heights(stage, blank)
    _compare(stage, data | given)
    return data


def _check_shafts(stage: Stage) -> None:
    angle = stage.stage.value("shaft_angle", "deg")
    if angle is None:
        stage.note("lacking", "shaft angle", "shaft_angle is absent: taken as 90 deg")
    elif abs(angle - 90.0) > _RIGHT_ANGLE:
        raise ParameterError(
            f"shaft_angle of {stage.stage} must be 90 deg, got {angle:g} deg. Other angles of the "
            "shafts are not modelled"
        )


def _hand(stage: Stage) -> str:
    """Return the hand of the pinion."""
    hands = [one.word("spiral_angle_pitch_direction") for one in (stage.pinion, stage.gear)]
    if hands[0] and hands[0] == hands[1]:
        raise ParameterError(
            "spiral_angle_pitch_direction of pinion and gear must be left and right, got "
            f"{hands[0]} for both. Correct one of them"
        )
    if hands[0] not in ("left", "right"):
        reason = "spiral_angle_pitch_direction of the pinion is absent: taken as right"
        stage.note("lacking", "pair.pinion_hand", reason)
        return "right"
    stage.note("taken", "pair.pinion_hand", f"spiral_angle_pitch_direction of {stage.pinion}")
    return hands[0]


def _offset(stage: Stage) -> float:
    offset = stage.optional("pair.offset_mm", (stage.stage, "hypoid_offset", "mm"))
    if offset is None:
        stage.note("lacking", "pair.offset_mm", "hypoid_offset is absent: taken as 0, bevel gears")
    elif offset < 0.0:
        raise ParameterError(
            f"hypoid_offset of {stage.stage} must be at least 0 mm (the pinion with the larger "
            f"spiral angle), got {offset:g} mm. Correct the sign, if it only names the side"
        )
    return offset or 0.0


def _sizes(stage: Stage, data: dict[str, Any], given: dict[str, Any]) -> dict[str, float]:
    """Return diameters of the gear and spiral angles, as far as they are there."""
    gear, found = stage.gear, {}
    places = {
        "outer_pitch_diameter_mm": (gear, "outer_pitch_diameter", "mm"),
        "mean_pitch_diameter_mm": (gear, "mean_pitch_diameter", "mm"),
        "pinion_spiral_angle_deg": (stage.pinion, "mean_spiral_angle", "deg"),
        "gear_spiral_angle_deg": (gear, "mean_spiral_angle", "deg"),
    }
    for key, (component, attribute, unit) in places.items():
        value = component.value(attribute, unit)
        if value is not None:
            found[key] = abs(value)
    module = stage.stage.value("outer_transverse_module", "mm")
    if "outer_pitch_diameter_mm" not in found and module and data.get("pair.gear_teeth"):
        found["outer_pitch_diameter_mm"] = module * data["pair.gear_teeth"]
        reason = "outer_transverse_module times the teeth"
        stage.note("inferred", "pair.outer_pitch_diameter_mm", reason)
    if not data["pair.offset_mm"] and "pinion_spiral_angle_deg" in found:
        found.setdefault("gear_spiral_angle_deg", found["pinion_spiral_angle_deg"])
    found |= {key: given[f"pair.{key}"] for key in places if f"pair.{key}" in given}
    if not _methods(data["pair.offset_mm"], found):
        stage.absent.append(
            "pair.outer_pitch_diameter_mm (REXS: outer_pitch_diameter of the gear, with "
            "mean_spiral_angle of pinion or gear), or pair.mean_pitch_diameter_mm (REXS: "
            "mean_pitch_diameter, with mean_spiral_angle of the gear)"
        )
    return found


_NEEDS = {
    0: ("outer_pitch_diameter_mm", "gear_spiral_angle_deg"),
    1: ("outer_pitch_diameter_mm", "pinion_spiral_angle_deg"),
    2: ("mean_pitch_diameter_mm", "gear_spiral_angle_deg"),
    3: ("outer_pitch_diameter_mm", "gear_spiral_angle_deg"),
}


def _methods(offset: float | None, sizes: dict[str, float]) -> list[int]:
    numbers = (0,) if not offset else (1, 3, 2)
    return [number for number in numbers if all(key in sizes for key in _NEEDS[number])]


def _chosen(sizes: dict[str, float], method: int) -> dict[str, Any]:
    return {"method": method} | {f"pair.{key}": sizes[key] for key in _NEEDS[method]}


def _nearest(
    stage: Stage, data: dict[str, Any], sizes: dict[str, float], given: dict[str, Any]
) -> DesignedBlank:
    """Return the blank of the method that comes nearest to the cones of the file."""
    blanks, reasons = [], []
    wanted = {
        f"{role} {what}": abs(value)
        for role, one in stage.members().items()
        for what, attribute in (("pitch angle", "pitch_angle"), ("spiral", "mean_spiral_angle"))
        if (value := one.value(attribute, "deg")) is not None
    }
    for method in _methods(data["pair.offset_mm"], sizes):
        whole = data | _chosen(sizes, method) | given
        try:
            blank = DesignedBlank.from_file(BlankFile.from_data(nested(whole), str(stage.stage)))
        except ParameterError as reason:
            reasons.append(str(reason))
            continue
        cones = blank.cones
        own = {
            "pinion pitch angle": cones.pinion_pitch_angle / DEGREE,
            "gear pitch angle": cones.gear_pitch_angle / DEGREE,
            "pinion spiral": cones.pinion_spiral_angle / DEGREE,
            "gear spiral": cones.gear_spiral_angle / DEGREE,
        }
        blanks.append((max([abs(own[k] - v) for k, v in wanted.items()] or [0.0]), blank))
    if not blanks:
        raise ParameterError(reasons[0])
    blank = min(blanks, key=lambda one: one[0])[1]
    method = blank.file.design_method
    for key in _NEEDS[method]:
        stage.note("taken", f"pair.{key}", f"method {method} of ISO 23509 starts from it")
    for key in sizes.keys() - _NEEDS[method]:
        stage.note("inferred", f"pair.{key}", "follows from the cones, so it is not written")
    return blank


def _pressure_angles(stage: Stage, blank: DesignedBlank) -> dict[str, float]:
    """Return effective pressure angles: as given, from the generated or the nominal ones."""
    found, limit = {}, blank.cones.limit_pressure_angle / DEGREE
    for side, sign in zip(_SIDES, (1.0, -1.0), strict=True):
        name = f"cutter.{side}_pressure_angle_deg"
        kinds = ("effective", "generated", "nominal_design")
        values = [stage.stage.value(f"{kind}_pressure_angle_{side}", "deg") for kind in kinds]
        effective, generated, nominal = values
        if effective is not None:
            found[name] = effective
            stage.note("taken", name, f"effective_pressure_angle_{side} of {stage.stage}")
        elif generated is not None:
            found[name] = generated - sign * limit
            reason = f"generated_pressure_angle_{side}, less the limit pressure angle"
            stage.note("inferred", name, reason if sign > 0.0 else reason.replace("less", "plus"))
        elif nominal is not None:
            found[name] = nominal
            reason = f"nominal_design_pressure_angle_{side}, with a limit influence factor of 1"
            stage.note("inferred", name, reason)
        else:
            stage.note("lacking", name, "no pressure angle in the file: the blank file's 20 deg")
    return found


def _heights(stage: Stage, blank: DesignedBlank) -> dict[str, float]:
    """Return factors of depth from the heights at mid-face."""
    pinion, gear = stage.pinion, stage.gear
    tops = [one.value("mean_addendum", "mm") for one in (pinion, gear)]
    depth = gear.value("mean_dedendum", "mm")
    if tops[0] is None or tops[1] is None:
        stage.note("lacking", "depth", "mean_addendum of both gears is absent: the usual factors")
        return {}
    working, module = tops[0] + tops[1], 1e3 * blank.normal_module
    stage.note("inferred", "depth.depth_factor", "both mean_addendum over the mean normal module")
    stage.note("inferred", "depth.gear_addendum_factor", "mean_addendum of the gear over both")
    found = {
        "depth.depth_factor": round(working / module, 9),
        "depth.gear_addendum_factor": round(tops[1] / working, 9),
    }
    if depth is None:
        stage.note("lacking", "depth.clearance_factor", "mean_dedendum of the gear is absent")
    else:
        found["depth.clearance_factor"] = round((depth - tops[0]) / working, 9)
        reason = "mean_dedendum of the gear less mean_addendum of the pinion, over both addenda"
        stage.note("inferred", "depth.clearance_factor", reason)
    return found


def _compare(stage: Stage, data: dict[str, Any]) -> None:
    """Note which numbers of the file the blank has too, and which differ and are left out."""
    blank = DesignedBlank.from_file(BlankFile.from_data(nested(data), str(stage.stage))).blank
    for role, one in stage.members().items():
        alike = []
        for name, (unit, own) in member_attributes(blank, role).items():
            value = one.value(name, unit)
            if value is None:
                continue
            value = abs(value) if name == "mean_spiral_angle" else value
            if abs(value - own) <= _AGREE[unit]:
                alike.append(name)
                continue
            why = f"{value:.6g} {unit} in the file; the blank has {own:.6g} {unit}"
            if name in ("face_angle", "root_angle"):
                why += ": equally deep teeth, with the heights of mid-face"
            stage.note("left out", f"{name} of {one}", why)
        limits = f"within {_AGREE['mm']:g} mm and {_AGREE['deg']:g} deg"
        if alike:
            stage.note("inferred", f"the blank's {role}", f"agrees {limits}: {', '.join(alike)}")


def nested(fields: dict[str, Any]) -> dict[str, Any]:
    """Return dotted fields as tables in tables.

    >>> nested({"name": "a", "pair.offset_mm": 15.0})
    {'name': 'a', 'pair': {'offset_mm': 15.0}}
    """
    data: dict[str, Any] = {}
    for field, value in fields.items():
        *sections, key = field.split(".")
        place = data
        for part in sections:
            place = place.setdefault(part, {})
        place[key] = value
    return data
