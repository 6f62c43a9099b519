"""What would make claim G13 of Jamali 2015 hold: 7.08 deg between lay and contact line."""

from __future__ import annotations

import math
from pathlib import Path

from scipy.optimize import brentq

from docs.helical.claims_thesis import PAIRS
from docs.validation.decision import Decision, decision_table
from gearlube_core.helical_geometry.lay_angle import lay_angles

PRINTED = 7.08  # deg
_PAIR = PAIRS["a"]


def lay_angle(base_helix_angle: float, pressure_angle: float) -> float:
    """Return the angle at the pitch line [deg]: arctan(sin b tan(alpha_w)); angles in rad."""
    return math.degrees(math.atan(math.sin(base_helix_angle) * math.tan(pressure_angle)))


def needed_pressure_angle() -> float:
    """Return the working pressure angle that gives the printed number [deg]."""
    tangent = math.tan(math.radians(PRINTED)) / math.sin(_PAIR.base_helix_angle)
    return math.degrees(math.atan(tangent))


def needed_distance() -> float:
    """Return AB over which the pinion's chord at the pitch line has the printed angle [m]."""

    def off(distance: float) -> float:
        return math.degrees(float(lay_angles(0.0, _PAIR, distance).pinion)) - PRINTED

    return float(brentq(off, 1e-4, 2e-2))


def needed_place() -> float:
    """Return s at which the pinion's lay has the printed angle [m]."""
    x = _PAIR.pinion_base_radius * math.tan(math.radians(PRINTED))
    return x / math.sin(_PAIR.base_helix_angle) - _PAIR.pitch_point


def round_helix() -> float:
    """Return the angle for a helix angle of 20 deg and its reference pressure angle [deg]."""
    helix, normal = math.radians(20.0), math.radians(20.0)
    base = math.asin(math.sin(helix) * math.cos(normal))
    return lay_angle(base, math.atan(math.tan(normal) / math.cos(helix)))


def section() -> str:
    """Return the rows of claim G13."""
    pair = _PAIR
    here = lay_angle(pair.base_helix_angle, pair.working_pressure_angle)
    rows = [
        Decision(
            "G13",
            "The working pressure angle",
            f"{math.degrees(pair.working_pressure_angle):.2f} deg: {here:.3f} deg",
            f"{needed_pressure_angle():.2f} deg",
            "No. Numbers of teeth, module, helix angle and centre distance are printed and fix it.",
        ),
        Decision(
            "G13",
            "The helix angle, with the reference pressure angle",
            f"{math.degrees(pair.helix_angle):.1f} deg: "
            f"{lay_angle(pair.base_helix_angle, pair.transverse_pressure_angle):.3f} deg",
            f"20 deg: {round_helix():.3f} deg",
            "Possible. One program may have had a rounded helix angle. Table 4.1 prints 19.60.",
        ),
        Decision(
            "G13",
            "The distance AB of the chord",
            f"1 mm: {math.degrees(float(lay_angles(0.0, pair).pinion)):.3f} deg",
            f"{1e3 * needed_distance():.1f} mm",
            "No. 1 mm is printed, and the wheel's angle would fall as the pinion's rises.",
        ),
        Decision(
            "G13",
            "The place along the path",
            "s = 0",
            f"s = {1e3 * needed_place():.2f} mm for the pinion",
            "No. It is printed as the point where both angles are equal.",
        ),
    ]
    text = (Path(__file__).parent / "text" / "helical.md").read_text(encoding="utf-8")
    return text.format(decisions=decision_table(rows))
