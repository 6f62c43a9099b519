"""Helical and spur pairs: a cylindrical stage of REXS as a gear file, and back."""

from __future__ import annotations

import math
from typing import Any

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.rexs.document import Document
from gearlube_core.rexs.model import Component
from gearlube_core.rexs.stage import ExchangeNote, Stage
from gearlube_core.storage.file_names import as_name
from gearlube_core.units import DEGREE, MILLIMETRE

_AGREE = 1e-4  # of numbers that both gears must have alike
_SHIFT = "addendum_modification_coefficient"
_ADDENDUM = "addendum_coefficient_basic_profile"
_REFERENCE = ("pair.centre_distance_mm", "pair.normal_module_mm", "pair.helix_angle_deg",
              "pinion.teeth", "gear.teeth")  # fmt: skip


def helical_data(stage: Stage, given: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of a helical gear file by their dotted names.

    Parameters
    ----------
    stage : Stage
    given : dict
        Dotted fields that the user gives; the file may lack them.

    Raises
    ------
    ParameterError
        A number is missing or wrong, or the gears are not such a pair.

    References
    ----------
    [fva_2022]; tip diameter from addendum and profile shift: [iso_21771].
    """
    data: dict[str, Any] = {"name": as_name(stage.stage.name or stage.model.path.stem)}
    data["source"] = stage.model.source
    data |= pair_data(stage, given)
    for role, one in stage.members().items():
        data[f"{role}.profile_shift_coefficient"] = _shift(stage, role, one, data | given)
        data[f"{role}.tip_diameter_mm"] = _tip(stage, role, one, data, given)
        data[f"{role}.root_diameter_mm"] = stage.optional(
            f"{role}.root_diameter_mm", (one, "root_diameter", "mm")
        )
    stage.check_complete()
    return {name: value for name, value in data.items() if value is not None}


def pair_data(stage: Stage, given: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of both gears together, None where absent, which the stage then knows."""
    data: dict[str, Any] = {}
    teeth = {
        role: stage.required(f"{role}.teeth", (one, "number_of_teeth", "none"), given=given)
        for role, one in stage.members().items()
    }
    data |= {f"{role}.teeth": round(z) for role, z in teeth.items() if z is not None}
    data["pair.centre_distance_mm"] = stage.required(
        "pair.centre_distance_mm", (stage.stage, "center_distance", "mm"), given=given
    )
    for name, attribute, unit, other in (
        ("pair.normal_module_mm", "normal_module", "mm", "transverse_module"),
        ("pair.normal_pressure_angle_deg", "normal_pressure_angle", "deg",
         "pressure_angle_in_the_transverse_section"),
    ):  # fmt: skip
        both = name.replace("normal", "transverse")
        if _alike(stage, both, other, unit) is not None and not _has(stage, attribute):
            data[both] = _alike(stage, both, other, unit)
            stage.note("taken", both, f"{other} of both gears")
        elif (value := _alike(stage, name, attribute, unit)) is not None:
            data[name] = value
            stage.note("taken", name, f"{attribute} of both gears")
        elif name not in given and both not in given:
            stage.absent.append(f"{name} (REXS: {attribute} or {other})")
    data["pair.helix_angle_deg"] = _helix(stage, given)
    _check_modules(stage, data)
    data["pair.face_width_mm"] = _face_width(stage, given)
    if (backlash := _backlash(stage)) is not None:
        data["pair.backlash_mm"] = backlash
    return data


def _places(stage: Stage, attribute: str) -> list[Component]:
    """Return the components that may have an attribute: gears, then their flanks."""
    members = stage.members().values()
    own = [one for one in members if attribute in one.attributes]
    return own or [flank for one in members for flank in stage.flanks(one)]


def _has(stage: Stage, attribute: str) -> bool:
    return any(attribute in one.attributes for one in _places(stage, attribute))


def _alike(stage: Stage, name: str, attribute: str, unit: str) -> float | None:
    """Return a number that both gears and all flanks must share."""
    found = [(one, one.value(attribute, unit)) for one in _places(stage, attribute)]
    values = [value for _, value in found if value is not None]
    if values and max(values) - min(values) > _AGREE * abs(values[0]):
        listed = ", ".join(f"{v:g} {unit} of {one}" for one, v in found if v is not None)
        raise ParameterError(
            f"{attribute} must be the same for both gears and all flanks ({name}), got {listed}"
        )
    return values[0] if values else None


def _check_modules(stage: Stage, data: dict[str, Any]) -> None:
    """Raise ParameterError where normal and transverse module contradict the helix angle."""
    normal, helix = data.get("pair.normal_module_mm"), data.get("pair.helix_angle_deg")
    transverse = _alike(stage, "pair.transverse_module_mm", "transverse_module", "mm")
    if normal is None or helix is None or transverse is None:
        return
    wanted = normal / math.cos(helix * DEGREE)
    if abs(transverse - wanted) > _AGREE * wanted:
        raise ParameterError(
            f"transverse_module of {stage.pinion} must be normal_module over the cosine of the "
            f"helix angle, {wanted:.6g} mm, got {transverse:.6g} mm. Correct one of the three"
        )


def _helix(stage: Stage, given: dict[str, Any]) -> float | None:
    angles = [
        one.value("helix_angle_reference_diameter", "deg") for one in stage.members().values()
    ]
    name = "pair.helix_angle_deg"
    if angles[0] is None or angles[1] is None:
        if name not in given:
            stage.absent.append(f"{name} (REXS: helix_angle_reference_diameter of both gears)")
        return None
    if abs(angles[0] + angles[1]) > _AGREE * max(1.0, abs(angles[0])):
        raise ParameterError(
            "helix_angle_reference_diameter of both gears must be equal and opposite (right-hand "
            f"teeth mesh with left-hand teeth on parallel axes), got {angles[0]:g} deg of "
            f"{stage.pinion} and {angles[1]:g} deg of {stage.gear}. Correct the sign of one"
        )
    stage.note("taken", name, "helix_angle_reference_diameter of both gears, without its sign")
    if angles[0] > 0.0:
        stage.note(
            "left out", "hand", "the pinion is right-handed; gear files describe the mirror image, "
            "which is the same but for the signs of axial forces and of lead_slope_um",
        )  # fmt: skip
    return abs(angles[0])


def _face_width(stage: Stage, given: dict[str, Any]) -> float | None:
    name = "pair.face_width_mm"
    common = stage.optional(name, (stage.stage, "common_face_width", "mm"))
    widths = [one.value("face_width", "mm") for one in stage.members().values()]
    known = [width for width in widths if width is not None]
    if common is None and len(known) == 2:
        common = min(known)
        stage.note("inferred", name, f"the narrower face; face_width {known[0]:g}, {known[1]:g} mm")
    elif common is None and name not in given:
        stage.absent.append(f"{name} (REXS: common_face_width, or face_width of both gears)")
    return common


def _backlash(stage: Stage) -> float | None:
    names = ("minimum_normal_backlash", "maximum_normal_backlash")
    found = {name: v for name in names if (v := stage.stage.value(name, "mm")) is not None}
    if not found:
        return None
    least, most = min(found.values()), max(found.values())
    stage.note("inferred", "pair.backlash_mm", f"the middle of {' and '.join(found)}")
    return 0.5 * (least + most)


def _shift(stage: Stage, role: str, gear: Component, data: dict[str, Any]) -> float | None:
    """Return the profile shift coefficient, alike on both flanks.

    0 where neither it nor the tip diameter is there and the axes stand at the reference distance.
    """
    name = f"{role}.profile_shift_coefficient"
    found = [(one, x) for one in stage.flanks(gear) if (x := one.value(_SHIFT)) is not None]
    if found:
        values = [x for _, x in found]
        if max(values) - min(values) > _AGREE:
            listed = ", ".join(f"{x:g} of {one}" for one, x in found)
            raise ParameterError(f"{_SHIFT} must be the same for both flanks, got {listed}")
        stage.note("taken", name, f"{_SHIFT} of {found[0][0]}")
        return values[0]
    numbers = [float(data[one]) for one in _REFERENCE if data.get(one) is not None]
    if "tip_diameter" in gear.attributes or len(numbers) < len(_REFERENCE):
        return None
    centres, module, helix, z1, z2 = numbers
    if abs(0.5 * (z1 + z2) * module / math.cos(helix * DEGREE) - centres) > _AGREE * module:
        return None
    stage.note("lacking", name, f"{_SHIFT} is absent: 0, as the axes are at reference distance")
    return 0.0


def _tip(
    stage: Stage, role: str, gear: Component, data: dict[str, Any], given: dict[str, Any]
) -> float | None:
    """Return the tip diameter [mm]: as given, or d + 2 m_n (x + h_aP); [iso_21771]."""
    name = f"{role}.tip_diameter_mm"
    fields = (f"{role}.teeth", *_REFERENCE[1:3], f"{role}.profile_shift_coefficient")
    known = [value for one in fields if (value := given.get(one, data.get(one))) is not None]
    tip = gear.value("tip_diameter", "mm")
    if len(known) < len(fields):
        other = f"{_SHIFT} of a flank"
        return stage.required(name, (gear, "tip_diameter", "mm"), given=given, other=other)
    teeth, module, helix, shift = (float(value) for value in known)
    reference = teeth * module / math.cos(helix * DEGREE)
    if tip is not None and tip > 0.5 * reference:
        return stage.optional(name, (gear, "tip_diameter", "mm"))
    if tip is not None:
        why = f"{tip:g} mm cannot be with a reference diameter of {reference:.4g} mm"
        stage.note("left out", f"tip_diameter of {gear}", why)
    found = [h for one in (*stage.flanks(gear), gear) if (h := one.value(_ADDENDUM)) is not None]
    if found:
        stage.note("inferred", name, f"from {_SHIFT} and {_ADDENDUM}, {found[0]:g}")
    elif name not in given:
        stage.note("lacking", name, f"{_ADDENDUM} is absent: 1 module above the profile shift")
    return reference + 2.0 * module * (shift + (found[0] if found else 1.0))


def lacking_fields(file: HelicalGearFile) -> list[ExchangeNote]:
    """Return the fields that a gear file may have beside these, with what stands for them."""
    found: dict[str, list[str]] = {}
    for name, note in field_notes(HelicalGearFile).items():
        *sections, key = name.split(".")
        place: Any = file
        for count, part in enumerate(sections, 1):
            place = getattr(place, part)
            if place is None:
                found[".".join(sections[:count])] = ["no such section"]
                break
        else:
            given = key in place.model_fields_set or key in _ALTERNATIVES or not sections
            if note.default and not given:
                found.setdefault(".".join(sections), []).append(f"{key} {note.default}")
    return [ExchangeNote("lacking", name, ", ".join(keys)) for name, keys in found.items()]


_ALTERNATIVES = {
    f"{kind}_{key}"
    for kind in ("normal", "transverse")
    for key in ("module_mm", "pressure_angle_deg")
}


def write_helical(file: HelicalGearFile, document: Document) -> set[str]:
    """Add a pair to a document; return the dotted fields that it took.

    Hand: [iso_21771], right-hand teeth have a positive helix angle. The pinion of
    docs/conventions.md is left-handed.
    """
    pair = file.helical_pair()
    stage = document.component("cylindrical_stage", file.name)
    document.value(stage, "center_distance", "mm", pair.centre_distance / MILLIMETRE)
    document.value(stage, "common_face_width", "mm", pair.face_width / MILLIMETRE)
    for bound in ("minimum", "maximum"):
        if file.pair.backlash_mm is not None:
            document.value(stage, f"{bound}_normal_backlash", "mm", file.pair.backlash_mm)
    gears = []
    for role, sign in (("pinion", -1.0), ("gear", 1.0)):
        member = getattr(file, role)
        gear = document.component("cylindrical_gear", role)
        document.value(gear, "number_of_teeth", "none", member.teeth)
        for name, value in (
            ("normal_module", pair.normal_module),
            ("transverse_module", pair.normal_module / math.cos(pair.helix_angle)),
            ("face_width", pair.face_width),
            ("tip_diameter", 2.0 * getattr(pair, f"{role}_tip_radius")),
            ("root_diameter", 2.0 * getattr(pair, f"{role}_root_radius")),
        ):
            document.value(gear, name, "mm", value / MILLIMETRE)
        helix = sign * pair.helix_angle / DEGREE
        document.value(gear, "helix_angle_reference_diameter", "deg", helix + 0.0)
        flanks = []
        for side in ("left", "right"):
            flank = document.component("cylindrical_gear_flank", f"{role}, {side} flank")
            angle = pair.normal_pressure_angle / DEGREE
            document.value(flank, "normal_pressure_angle", "deg", angle)
            if member.profile_shift_coefficient is not None:
                document.value(flank, _SHIFT, "none", member.profile_shift_coefficient)
            flanks.append(flank)
        document.flanks(gear, *flanks)
        gears.append(gear)
    document.stage(stage, *gears)
    members = {f"{role}.{key}" for role in ("pinion", "gear")
               for key in ("teeth", "tip_diameter_mm", "root_diameter_mm",
                           "profile_shift_coefficient")}  # fmt: skip
    return members | {
        *(f"pair.{key}" for key in _ALTERNATIVES),
        "name", "pair.helix_angle_deg", "pair.centre_distance_mm", "pair.face_width_mm",
        "pair.backlash_mm",
    }  # fmt: skip
