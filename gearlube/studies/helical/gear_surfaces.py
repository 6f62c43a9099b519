"""Flanks of a helical pair as exact surfaces for CAD."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from gearlube_core.helical_contact.tooth_body import half_angle, tooth_form
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.involute import MEMBERS
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.hypoid_geometry.flank.step_file import (
    COLUMNS,
    ROWS,
    SplineSurface,
    surface_through,
    write_step,
)


def write_gears(file: HelicalGearFile, folder: Path) -> list[Path]:
    """Write both flanks of one tooth of each member as FOLDER/MEMBER_flanks.step."""
    folder.mkdir(parents=True, exist_ok=True)
    pair = file.helical_pair()
    return [
        write_step(tooth_surfaces(pair, member), folder / f"{member}_flanks.step")
        for member in MEMBERS
    ]


def tooth_surfaces(pair: HelicalPair, member: str) -> dict[str, SplineSurface]:
    """Return the flanks of one tooth of the "pinion" or the "gear", without modifications.

    From the start of the involute to the tip, about the member's own axis, z, with mid-face at
    z = 0. The pinion's tooth points towards +y, the gear's towards -y.
    """
    form, start = tooth_form(pair, member), pair.involute_starts[MEMBERS.index(member)]
    s, t = np.linspace(0.0, 1.0, ROWS), np.linspace(0.0, 1.0, COLUMNS)
    tip = math.sqrt(form.tip_radius**2 - form.base_radius**2)
    roll = (start.roll + (tip - start.roll) * s)[:, None]
    z = ((t - 0.5) * pair.face_width)[None, :]
    radius = np.hypot(form.base_radius, roll)
    lead = z * math.tan(pair.base_helix_angle) / form.base_radius
    up = 1.0 if member == "pinion" else -1.0
    found = {}
    for name, side in (("drive", up), ("coast", -up)):
        angle = lead + side * half_angle(form, radius)
        points = [radius * np.sin(angle), up * radius * np.cos(angle), z + 0.0 * angle]
        found[f"{member} {name} flank"] = surface_through(np.stack(points, axis=-1), s, t)
    return found
