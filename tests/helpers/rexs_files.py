"""REXS files written by hand: a cylindrical stage, and bevel stages of ISO 23509."""

import math

# A cylindrical stage with the attribute names of REXS 1.4, in units other than the data base's.
# 20 and 41 teeth, normal module 4 mm, helix angle 15 deg, no profile shift: the centre distance is
# 61 * 4 / (2 cos 15 deg), the tips are one module above the reference circles.
TIPS = [z * 4.0 / math.cos(math.radians(15.0)) + 8.0 for z in (20, 41)]
CENTRES = 61.0 * 2.0 / math.cos(math.radians(15.0))
CYLINDRICAL = f"""<?xml version="1.0" encoding="UTF-8"?>
<model version="1.4" applicationId="by hand" applicationVersion="1" date="2022">
  <relations>
    <relation id="1" type="stage">
      <ref id="2" role="stage" hint="cylindrical_stage"/>
      <ref id="4" role="gear_1" hint="cylindrical_gear"/>
      <ref id="3" role="gear_2" hint="cylindrical_gear"/>
    </relation>
    <relation id="2" type="flank">
      <ref id="3" role="gear"/><ref id="5" role="left"/><ref id="6" role="right"/>
    </relation>
    <relation id="3" type="flank">
      <ref id="4" role="gear"/><ref id="7" role="left"/><ref id="8" role="right"/>
    </relation>
  </relations>
  <components>
    <component id="1" type="gear_unit"/>
    <component id="2" type="cylindrical_stage" name="output stage">
      <attribute id="center_distance" unit="m">{CENTRES / 1e3}</attribute>
    </component>
    <component id="3" type="cylindrical_gear">
      <attribute id="number_of_teeth" unit="none">20</attribute>
      <attribute id="normal_module" unit="mm">4</attribute>
      <attribute id="helix_angle_reference_diameter" unit="rad">{math.radians(15.0)}</attribute>
      <attribute id="face_width" unit="mm">32</attribute>
      <attribute id="tip_diameter" unit="mum">{1e3 * TIPS[0]}</attribute>
      <attribute id="u_coordinate_on_shaft" unit="mm">80</attribute>
    </component>
    <component id="4" type="cylindrical_gear">
      <attribute id="number_of_teeth" unit="none">41</attribute>
      <attribute id="normal_module" unit="mm">4</attribute>
      <attribute id="helix_angle_reference_diameter" unit="&#176;">-15</attribute>
      <attribute id="face_width" unit="mm">30</attribute>
    </component>
    {
    "".join(
        f'<component id="{number}" type="cylindrical_gear_flank">'
        '<attribute id="normal_pressure_angle" unit="deg">20</attribute>'
        '<attribute id="addendum_modification_coefficient" unit="none">0</attribute>'
        '<attribute id="addendum_coefficient_basic_profile" unit="none">1</attribute></component>'
        for number in (5, 6, 7, 8)
    )
}
    <component id="9" type="lubricant"/>
  </components>
  <load_spectrum id="1"/>
</model>
"""

# at another centre distance than the reference one, missing shifts are not taken as 0
TIPLESS, CENTRED = f"{CENTRES / 1e3}", f"{CENTRES / 1e3 + 2e-4}"

# the samples F.3 to F.5 of ISO 23509 as printed: teeth, offset, face width, cutter, diameters and
# angles (the outer diameter of F.4 from its mean one, face width and pitch angle)
SAMPLES = {
    1: (13, 42, 15.0, 30.0, 63.5, 0, 170.0, 141.877, 21.288, 68.323, 49.998, 38.609),
    2: (9, 34, 31.75, 26.0, 76.0, 13, 169.912, 146.7, 24.765, 63.212, 44.990, 21.009),
    3: (12, 49, 40.0, 60.0, 135.0, 5, 400.0, 343.151, 18.200, 71.360, 42.922, 30.0),
}


def bevel(z1, z2, offset, width, radius, groups, outer, mean, delta1, delta2, beta1, beta2):
    """A bevel stage with the attribute names of REXS 1.4."""
    stage = {
        "shaft_angle": ("deg", 90), "hypoid_offset": ("mm", offset),
        "cutter_radius": ("mm", radius), "number_of_blade_groups": ("none", groups),
        "nominal_design_pressure_angle_drive": ("deg", 20),
        "nominal_design_pressure_angle_coast": ("deg", 20),
    }  # fmt: skip
    pinion = {
        "number_of_teeth": ("none", z1), "pitch_angle": ("deg", delta1),
        "mean_spiral_angle": ("deg", beta1),
    }  # fmt: skip
    gear = {
        "number_of_teeth": ("none", z2), "pitch_angle": ("deg", delta2),
        "mean_spiral_angle": ("deg", beta2), "face_width": ("mm", width),
        "outer_pitch_diameter": ("mm", outer), "mean_pitch_diameter": ("mm", mean),
    }  # fmt: skip
    kinds = {2: ("bevel_stage", stage), 3: ("bevel_gear", pinion), 4: ("bevel_gear", gear)}
    components = "".join(
        f'<component id="{number}" type="{kind}">'
        + "".join(
            f'<attribute id="{name}" unit="{unit}">{value}</attribute>'
            for name, (unit, value) in attributes.items()
        )
        + "</component>"
        for number, (kind, attributes) in kinds.items()
    )
    return (
        '<model version="1.4" applicationId="by hand" applicationVersion="1" date="2022">'
        '<relations><relation id="1" type="stage"><ref id="2" role="stage"/>'
        '<ref id="3" role="gear_1"/><ref id="4" role="gear_2"/></relation></relations>'
        f"<components>{components}</components></model>"
    )
