"""The two-stage e-axle on elastic shafts as a gearbox in REXS, and a way to change it."""

from __future__ import annotations

import math

from lxml import etree

# shafts: start along u, axis at (v, w), sections and masses as (place, mass, about v, about u)
_CENTRES = (
    17 / 2 * 3.0 * (1 + 31 / 17) / math.cos(math.radians(28.0)),
    0.5 * 3.4 * 91 / math.cos(math.radians(24.0)),
)
_COUNTER = [_CENTRES[0] * one(math.radians(-40.0)) for one in (math.cos, math.sin)]
_OUTPUT = [
    _COUNTER[i] + _CENTRES[1] * one(math.radians(20.0))
    for i, one in enumerate((math.cos, math.sin))
]
SHAFTS = {
    "input": (0.0, (0.0, 0.0), 290.0, 40.0, 10.0, [(100.0, 16.0, 0.055, 0.04)]),
    "counter": (215.0, _COUNTER, 105.0, 45.0, 0.0, []),
    "output": (260.0, _OUTPUT, 80.0, 60.0, 30.0, [(30.0, 4.0, 0.01, 0.012)]),
}
# name, shaft, place along u from its start, teeth, module, helix angle, width
GEARS = (
    ("pinion 1", "input", 240.0, 17, 3.0, -28.0, 30.0),
    ("wheel 1", "counter", 25.0, 31, 3.0, 28.0, 30.0),
    ("pinion 2", "counter", 75.0, 17, 3.4, 24.0, 40.0),
    ("wheel 2", "output", 30.0, 74, 3.4, -24.0, 40.0),
)
# name, shaft, place, radial, axial [N/um], tilt [N.m/rad]
BEARINGS = (
    ("input fixed", "input", 0.0, 200.0, 50.0, 2e4),
    ("input middle", "input", 200.0, 200.0, 0.0, 2e4),
    ("input end", "input", 290.0, 200.0, 0.0, 2e4),
    ("counter fixed", "counter", 0.0, 400.0, 150.0, 5e4),
    ("counter end", "counter", 105.0, 400.0, 150.0, 5e4),
    ("output fixed", "output", 0.0, 500.0, 200.0, 1e5),
    ("output end", "output", 80.0, 500.0, 200.0, 1e5),
)
SPEED, TORQUE = 6000.0, 150.0


class _Model:
    def __init__(self) -> None:
        self.root = etree.Element("model", version="1.4", applicationId="by hand")
        self.relations = etree.SubElement(self.root, "relations")
        self.components = etree.SubElement(self.root, "components")

    def add(self, kind, name, **attributes):
        number = str(len(self.components) + 1)
        one = etree.SubElement(self.components, "component", id=number, type=kind, name=name)
        for key, (unit, value) in attributes.items():
            attribute = etree.SubElement(one, "attribute", id=key, unit=unit)
            if isinstance(value, list):
                array = etree.SubElement(attribute, "array")
                for number in value:
                    etree.SubElement(array, "c").text = repr(number)
            else:
                attribute.text = str(value)
        return one

    def relate(self, kind, **roles):
        number = str(len(self.relations) + 1)
        relation = etree.SubElement(self.relations, "relation", id=number, type=kind)
        for role, one in roles.items():
            etree.SubElement(relation, "ref", id=one.get("id"), role=role)


def e_axle_model() -> etree._Element:
    """Return the REXS model; z of the train is u, x is v, y is w."""
    model = _Model()
    casing = model.add("gear_casing", "casing")
    steel = model.add(
        "material", "steel", elastic_modulus=("N / mm^2", 206e3), density=("kg / dm^3", 7.85),
        poisson_ratio=("none", 206.0 / 2.0 / 79.2 - 1.0),
    )  # fmt: skip
    shafts = {}
    for name, (start, (v, w), length, outer, inner, masses) in SHAFTS.items():
        shaft = shafts[name] = model.add(
            "shaft", name, u_axis_vector=("mm", [1.0, 0.0, 0.0]),
            w_axis_vector=("mm", [0.0, 0.0, 1.0]), support_vector=("mm", [start, v, w]),
        )  # fmt: skip
        model.relate("reference", origin=shaft, referenced=steel)
        section = model.add(
            "shaft_section", "", u_coordinate_on_shaft=("mm", 0.0), length=("mm", length),
            outer_diameter_begin=("mm", outer), outer_diameter_end=("mm", outer),
            inner_diameter_begin=("mm", inner), inner_diameter_end=("mm", inner),
        )  # fmt: skip
        model.relate("assembly", assembly=shaft, part=section)
        for place, mass, about_v, about_u in masses:
            part = model.add(
                "additional_mass", "", u_coordinate_on_shaft=("mm", place),
                mass_of_component=("kg", mass), moment_of_inertia_v_axis=("kg m^2", about_v),
                moment_of_inertia_u_axis=("kg m^2", about_u),
            )  # fmt: skip
            model.relate("assembly", assembly=shaft, part=part)
    gears = []
    for name, on, place, teeth, module, helix, width in GEARS:
        gear = model.add(
            "cylindrical_gear", name, u_coordinate_on_shaft=("mm", place),
            number_of_teeth=("none", teeth), normal_module=("mm", module),
            helix_angle_reference_diameter=("deg", helix), face_width=("mm", width),
            normal_pressure_angle=("deg", 20.0),
        )  # fmt: skip
        model.relate("assembly", assembly=shafts[on], part=gear)
        gears.append(gear)
    for i, centres in enumerate(_CENTRES):
        stage = model.add(
            "cylindrical_stage", f"stage {i + 1}", center_distance=("mm", repr(centres)),
            minimum_normal_backlash=("mm", 0.08 + 0.02 * i),
        )  # fmt: skip
        model.relate("stage", stage=stage, gear_1=gears[2 * i], gear_2=gears[2 * i + 1])
    for name, on, place, radial, axial, tilt in BEARINGS:
        bearing = model.add(
            "concept_bearing", name, u_coordinate_on_shaft_inner_side=("mm", place),
            radial_stiffness=("N / mm", 1e3 * radial), axial_stiffness=("N / m", 1e6 * axial),
            bending_stiffness=("N mm / rad", 1e3 * tilt),
        )  # fmt: skip
        model.relate("side", assembly=bearing, inner_part=shafts[on], outer_part=casing)
    motor = model.add("external_load", "motor", u_coordinate_on_shaft=("mm", 100.0))
    model.relate("assembly", assembly=shafts["input"], part=motor)
    weight = model.add("external_load", "belt", transmits_torque=("", "false"))
    model.relate("assembly", assembly=shafts["input"], part=weight)
    case = etree.SubElement(etree.SubElement(model.root, "load_spectrum", id="1"), "load_case")
    for one, name, unit, value in (
        (shafts["input"], "rotational_speed", "1 / min", SPEED),
        (motor, "torque_around_u_axis", "N m", TORQUE),
        (casing, "temperature_lubricant", "C", 60.0),
    ):
        part = etree.SubElement(case, "component", id=one.get("id"), type=one.get("type"))
        etree.SubElement(part, "attribute", id=name, unit=unit).text = str(value)
    return model.root
