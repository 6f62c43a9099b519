"""Writing REXS files: components, attributes with units, relations."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

from lxml import etree

from gearlube_core import __version__
from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.designed_blank import SHAFT_ANGLE, DesignedBlank
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.rating.gears import StrengthRating
from gearlube_core.rating.pairs import MPA, Pair
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.units import DEGREE, MILLIMETRE, rads_to_rpm

_VERSION, _OF_RESULTS = "1.4", "1.7"  # the first that has safety factors of ISO 6336
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"  # [fva_2022] wants it
_OTHER = {"right": "left", "left": "right"}
_CONE = (
    "teeth", "face_width_mm", "outer_cone_distance_mm", "pitch_angle_deg", "spiral_angle_deg",
    "pitch_apex_mm", "face_apex_mm",
)  # fmt: skip


_STRESS = "N / mm^2"
_FACTORS = {
    "application_factor": "K_A",
    "dynamic_factor": "K_v",
    "face_load_factor_contact_stress": "K_Hb",
    "face_load_factor_root_stress": "K_Fb",
}
_OF_CYLINDERS = {
    "mesh_load_factor": "K_gam",
    "transverse_load_factor_contact_stress": "K_Ha",
    "transverse_load_factor_root_stress": "K_Fa",
}
_OF_BEVELS = {
    "transverse_load_factor_pitting": "K_Ha",
    "transverse_load_factor_tooth_root": "K_Fa",
}


class RatedLoad(NamedTuple):
    """A rating and the load that it is for.

    Parameters
    ----------
    rating : StrengthRating
    pinion_torque, pinion_speed : float
        As they were given to the rating, above 0 [N.m], [rad/s].

    Examples
    --------
    >>> import gearlube as gl
    >>> gear = gl.rating.RatedGear(
    ...     treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8
    ... )
    >>> pair = gl.HelicalGearFile.named("he_2007").helical_pair()
    >>> rating = gl.rating.cylindrical_rating(
    ...     pair, (gear, gear), gl.rating.LoadFactors(face=1.1),
    ...     pinion_torque=300.0, pinion_speed=200.0, cycles=(5e7, 5e7), oil_viscosity=100e-6,
    ... )
    >>> load = RatedLoad(rating, pinion_torque=300.0, pinion_speed=200.0)
    >>> round(load.rating.contact_safety[0], 2)
    1.4
    """

    rating: StrengthRating
    pinion_torque: float
    pinion_speed: float


def _mpa(pair: Pair) -> Pair:
    return pair[0] * MPA, pair[1] * MPA


_OF_GEAR: dict[str, tuple[str, Callable[[StrengthRating], Any]]] = {
    "contact_stress": (_STRESS, lambda one: _mpa(one.contact_stress)),
    "nominal_tooth_root_stress": (_STRESS, lambda one: one.factors["sigma_F0"]),
    "tooth_root_stress": (_STRESS, lambda one: _mpa(one.bending_stress)),
    "life_factor_pitting": ("none", lambda one: one.factors["Z_NT"]),
    "life_factor_tooth_root": ("none", lambda one: one.factors["Y_NT"]),
    "safety_factor_pitting": ("none", lambda one: one.contact_safety),
    "safety_factor_tooth_root": ("none", lambda one: one.bending_safety),
}


class Document:
    """A REXS model that grows: a gear unit, one stage, two gears on shafts.

    References
    ----------
    [fva_2022]: file format, and relations that a stage needs.
    """

    def __init__(self) -> None:
        self.root = etree.Element(
            "model",
            version=_VERSION,
            applicationId="gearlube",
            applicationVersion=__version__,
            date=datetime.now().astimezone().isoformat(timespec="seconds"),
            applicationLanguage="en",
        )
        self.relations = etree.SubElement(self.root, "relations")
        self.components = etree.SubElement(self.root, "components")
        self.unit = self.component("gear_unit", "")
        self.pair: tuple[etree._Element, ...] = ()  # stage, pinion, gear

    def component(self, kind: str, name: str) -> etree._Element:
        """Add a component and return it."""
        number = str(len(self.components) + 1)
        element = etree.SubElement(self.components, "component", id=number, type=kind)
        if name:
            element.set("name", name)
        return element

    def value(self, component: etree._Element, name: str, unit: str, value: float | str) -> None:
        """Add an attribute; numbers keep 12 digits."""
        element = etree.SubElement(component, "attribute", id=name, unit=unit)
        element.text = value if isinstance(value, str) else f"{value:.12g}"

    def relation(self, kind: str, **roles: etree._Element) -> None:
        """Add a relation between components in their roles."""
        number = str(len(self.relations) + 1)
        relation = etree.SubElement(self.relations, "relation", id=number, type=kind)
        for role, one in roles.items():
            etree.SubElement(relation, "ref", id=one.get("id"), role=role, hint=one.get("type"))

    def stage(self, stage: etree._Element, *gears: etree._Element) -> None:
        """Put a stage of two gears into the gear unit, each gear on a shaft without sections."""
        self.relation("assembly", assembly=self.unit, part=stage)
        self.relation("stage", stage=stage, gear_1=gears[0], gear_2=gears[1])
        self.pair = (stage, *gears)
        for gear in gears:
            shaft = self.component("shaft", f"shaft of {gear.get('name')}")
            self.relation("assembly", assembly=self.unit, part=shaft)
            self.relation("assembly", assembly=shaft, part=gear)

    def flanks(self, gear: etree._Element, left: etree._Element, right: etree._Element) -> None:
        """Give a gear its flanks."""
        self.relation("flank", gear=gear, left=left, right=right)

    def results(self, load: RatedLoad) -> None:
        """Add a load case with the rating of the pair: load, stresses, safety factors, K factors.

        References
        ----------
        [fva_2022]: attributes of stages, gears and stage_gear_data, from version 1.7 on.

        Raises
        ------
        ParameterError
            The rating is of gears of another kind.
        """
        check_positive("pinion_torque", load.pinion_torque, "N.m", "Give that of the rating.")
        check_positive("pinion_speed", load.pinion_speed, "rad/s", "Give that of the rating.")
        self.root.set("version", _OF_RESULTS)
        stage, *gears = self.pair
        rating, cylindrical = load.rating, stage.get("type") == "cylindrical_stage"
        if ("ISO 6336" in rating.standard) != cylindrical:
            raise ParameterError(
                f"The rating of a {stage.get('type')} must be by ISO "
                f"{'6336' if cylindrical else '10300'}, got {rating.standard}. Rate this pair."
            )
        standard = re.sub(r"ISO (\d+).*:(\d{4}).*", r"iso_\1_\2", rating.standard)
        spectrum = etree.SubElement(self.root, "load_spectrum", id="1")
        case = etree.SubElement(spectrum, "load_case", id="1")

        def loaded(component: etree._Element) -> etree._Element:
            about = {key: component.get(key) for key in ("id", "type")}
            return etree.SubElement(case, "component", **about)

        here = loaded(stage)
        names = _FACTORS | (_OF_CYLINDERS if cylindrical else _OF_BEVELS)
        for name, symbol in names.items():
            self.value(here, f"{name}_{standard}", "none", rating.number(symbol))
        nominal = rating.number("sigma_H0")
        if cylindrical:
            self.value(here, f"nominal_contact_stress_{standard}", _STRESS, nominal)
        teeth = [int(gear.findtext("attribute[@id='number_of_teeth']")) for gear in gears]
        ratio = teeth[1] / teeth[0]
        for k, gear in enumerate(gears):
            turned = loaded(gear)
            # parallel shafts have u the same way; else each shaft turns about its own u
            sign = -1.0 if cylindrical and k else 1.0
            speed = sign * load.pinion_speed / (ratio if k else 1.0)
            torque = load.pinion_torque * (sign * ratio if k else -1.0)
            self.value(turned, "rotational_speed", "1 / min", rads_to_rpm(speed))
            self.value(turned, "torque_acting_on_shaft_u", "N m", torque)
            data = self.component(f"{stage.get('type')}_gear_data", f"rating of {gear.get('name')}")
            self.relation("stage_gear_data", stage=stage, gear=gear, stage_gear_data=data)
            rated = loaded(data)
            if not cylindrical:
                self.value(rated, f"nominal_contact_stress_{standard}", _STRESS, nominal)
            for name, (unit, pair_of) in _OF_GEAR.items():
                self.value(rated, f"{name}_{standard}", unit, pair_of(rating)[k])

    def write(self, path: Path) -> None:
        """Write the file, in UTF-8."""
        etree.indent(self.root)
        content = etree.tostring(self.root, xml_declaration=True, encoding="UTF-8")
        with atomic_write(path) as partial:
            partial.write_bytes(_BYTE_ORDER_MARK + content + b"\n")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Cutter:
    radius: float  # m
    blade_groups: int
    kind: str  # of the pressure angles
    drive: float  # rad
    coast: float  # rad


def write_blank(file: BlankFile, document: Document) -> set[str]:
    """Add the pair of a blank file to a document; return the dotted fields that it took."""
    cutter = _Cutter(
        radius=file.cutter.radius_mm * MILLIMETRE,
        blade_groups=file.cutter.blade_groups,
        kind="effective",
        drive=file.cutter.drive_pressure_angle_deg * DEGREE,
        coast=file.cutter.coast_pressure_angle_deg * DEGREE,
    )
    _write(DesignedBlank.from_file(file).blank, cutter, file.pair.pinion_hand, document)
    return {"name", "method"} | {
        f"{section}.{key}"
        for section in ("pair", "cutter", "depth")
        for key in type(getattr(file, section)).model_fields
    }


def write_hypoid(file: HypoidGearFile, document: Document) -> set[str]:
    """Add the blank of a gear file to a document; return the dotted fields that it took."""
    blades = file.gear.cutter
    cutter = _Cutter(
        radius=blades.point_radius_mm * MILLIMETRE,
        blade_groups=blades.blade_groups,
        kind="generated",
        drive=(blades.convex_flank_blade_angle_deg + blades.convex_flank_angle_correction_deg)
        * DEGREE,
        coast=(blades.concave_flank_blade_angle_deg + blades.concave_flank_angle_correction_deg)
        * DEGREE,
    )
    _write(file.blank(), cutter, file.pair.pinion_hand, document)
    members = {f"{role}.{key}" for role in ("pinion", "gear") for key in _CONE}
    flanks = ("convex", "concave")
    blade = {
        "gear.cutter.point_radius_mm",
        "gear.cutter.blade_groups",
        *(f"gear.cutter.{curve}_flank_blade_angle_deg" for curve in flanks),
        *(f"gear.cutter.{curve}_flank_angle_correction_deg" for curve in flanks),
    }
    return {"name", "pair.offset_mm", "pair.pinion_hand", "pair.clearance_mm", *members, *blade}


def _write(blank: HypoidBlank, cutter: _Cutter, hand: str, document: Document) -> None:
    stage = document.component("bevel_stage", blank.name)
    document.value(stage, "shaft_angle", "deg", SHAFT_ANGLE / DEGREE)
    document.value(stage, "hypoid_offset", "mm", blank.offset / MILLIMETRE)
    document.value(stage, "cutter_radius", "mm", cutter.radius / MILLIMETRE)
    document.value(stage, "number_of_blade_groups", "none", cutter.blade_groups)
    for side in ("drive", "coast"):
        name = f"{cutter.kind}_pressure_angle_{side}"
        document.value(stage, name, "deg", getattr(cutter, side) / DEGREE)
    gears = []
    for role, own in (("pinion", hand), ("gear", _OTHER[hand])):
        gear = document.component("bevel_gear", role)
        document.value(gear, "number_of_teeth", "none", getattr(blank, role).teeth)
        for name, (unit, value) in member_attributes(blank, role).items():
            document.value(gear, name, unit, value)
        document.value(gear, "spiral_angle_pitch_direction", "none", own)
        gears.append(gear)
    document.stage(stage, *gears)


def member_attributes(blank: HypoidBlank, role: str) -> dict[str, tuple[str, float]]:
    """Return unit and value of each attribute of a bevel_gear that a blank determines.

    Parameters
    ----------
    blank : HypoidBlank
    role : str
        Which member: "pinion" or "gear".
    """
    member = getattr(blank, role)
    dedendum = blank.pinion_dedendum if role == "pinion" else blank.gear_dedendum
    sine, outer = math.sin(member.pitch_angle), member.outer_cone_distance
    lengths = {
        "face_width": member.face_width,
        "outer_pitch_diameter": 2.0 * outer * sine,
        "mean_pitch_diameter": 2.0 * member.mean_pitch_radius,
        "outer_cone_distance": outer,
        "mean_cone_distance": member.mean_cone_distance,
        "inner_cone_distance": outer - member.face_width,
        "pitch_apex_beyond_crossing_point": member.pitch_apex,
        "face_apex_beyond_crossing_point": member.face_apex,
        "root_apex_beyond_crossing_point": member.pitch_apex - dedendum / sine,
        "mean_addendum": member.addendum,
        "mean_dedendum": dedendum,
        "mean_normal_module": blank.mean_normal_module,
    }
    angles = {  # teeth are equally deep
        "pitch_angle": member.pitch_angle,
        "face_angle": member.pitch_angle,
        "root_angle": member.pitch_angle,
        "mean_spiral_angle": member.spiral_angle,
    }
    return {name: ("mm", value / MILLIMETRE) for name, value in lengths.items()} | {
        name: ("deg", value / DEGREE) for name, value in angles.items()
    }
