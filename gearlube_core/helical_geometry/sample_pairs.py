"""The gear pairs of the two sources."""

from __future__ import annotations

import math

from gearlube_core.checks import check_option
from gearlube_core.helical_geometry.pair import HelicalPair

_INCH = 0.0254  # m
PAIRS = ("he_2007", "jamali_2015_a", "jamali_2015_b")


def named_pair(name: str) -> HelicalPair:
    """Return a gear pair by name: he_2007, jamali_2015_a or jamali_2015_b."""
    check_option("name", name, PAIRS)
    return _he_2007() if name == "he_2007" else _jamali_2015(name)


def _he_2007() -> HelicalPair:
    """He et al. 2007 sec. 3 (NASA-ART pair); pressure angle 25 degrees transverse."""
    helix = math.radians(21.5)
    return HelicalPair(
        name="he_2007",
        pinion_teeth=25,
        gear_teeth=31,
        normal_module=_INCH / 8.0 * math.cos(helix),
        normal_pressure_angle=math.atan(math.tan(math.radians(25.0)) * math.cos(helix)),
        helix_angle=helix,
        centre_distance=3.5 * _INCH,
        pinion_tip_radius=0.5 * 3.38 * _INCH,
        gear_tip_radius=0.5 * 4.13 * _INCH,
        pinion_root_radius=0.5 * 2.811 * _INCH,
        gear_root_radius=0.5 * 3.561 * _INCH,
        face_width=1.25 * _INCH,
        backlash=100e-6,
    )


def _jamali_2015(name: str) -> HelicalPair:
    """Jamali 2015 Table 4.1, normal module and normal pressure angle; roots completed."""
    module, helix = 4.5e-3, math.radians(19.60)
    gear_teeth, gear_tip, centre = {
        "jamali_2015_a": (34, 171.39, 160.00),
        "jamali_2015_b": (99, 481.83, 315.22),
    }[name]
    full_depth = 2.25 * module  # basic rack: addendum 1, dedendum 1.25
    pinion_tip_radius, gear_tip_radius = 0.5 * 166.61e-3, 0.5e-3 * gear_tip
    return HelicalPair(
        name=name,
        pinion_teeth=33,
        gear_teeth=gear_teeth,
        normal_module=module,
        normal_pressure_angle=math.radians(20.0),
        helix_angle=helix,
        centre_distance=1e-3 * centre,
        pinion_tip_radius=pinion_tip_radius,
        gear_tip_radius=gear_tip_radius,
        pinion_root_radius=pinion_tip_radius - full_depth,
        gear_root_radius=gear_tip_radius - full_depth,
        face_width=44e-3,
        backlash=100e-6,
    )
