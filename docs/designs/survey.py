"""Design pairs of many ratios and offsets and load each: python -m docs.designs.survey.

Writes docs/designs/designs.csv, a row as soon as it is known; what is there is not computed again.
A design takes 5 to 40 s, its loaded contact half a minute.
"""

from __future__ import annotations

import csv
import logging
import math
import time
from collections.abc import Iterator
from pathlib import Path

import gearlube as gl
from gearlube.output.toml_text import toml_text
from gearlube.studies.contact.findings import contact_summary
from gearlube.studies.design.findings import unmet_targets
from gearlube_core.errors import GearLubeError
from gearlube_core.hypoid_contact.contact_dataset import analyse_contact
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.design import Design, design_pair, misses
from gearlube_core.hypoid_design.pinion_fit import SIDES
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form

ROWS = Path(__file__).with_name("designs.csv")
FILES = Path("build") / "designs"  # the gear files, for their loaded contact
OFFSETS = {
    (9, 41): (10.0, 25.0, 31.75, 45.0),
    (11, 39): (10.0, 20.0, 30.0, 45.0),
    (13, 36): (10.0, 24.0, 35.0, 45.0),
    (10, 43): (10.0, 20.0, 31.75, 45.0),
    (17, 35): (10.0, 20.0, 30.0, 45.0),
}
GENERATED = ((17, 35), (13, 36))  # low ratios, whose gears are generated in practice
GROUPS = (13, 11, 7)  # blade groups of face hobbing: the first without a common factor
MORE = {"machine.modified_roll": True, "machine.helical_motion": True}
TORQUE = 100.0  # N.m, of the pinion
FIELDS = (
    "design",
    "teeth",
    "offset_mm",
    "blade_groups",
    "gear",
    "freedoms",
    "verdict",
    "seconds",
    *(
        f"{side}_{name}"
        for side in SIDES
        for name in ("error_percent", "path_deg", "centre_mm", "length_percent", "contact_ratio")
    ),
    "teeth_as_cut",
    "loaded",
    *(f"{side}_{name}" for side in SIDES for name in ("stiffness_n_um", "pressure_gpa")),
    "reason",
)
logger = logging.getLogger("docs.designs")
Row = dict[str, str]


def blanks() -> Iterator[BlankFile]:
    """Yield the blanks of the survey."""
    sample = BlankFile.named("hypoid_13_42")
    for (pinion, gear), offsets in OFFSETS.items():
        hobbing = next(n for n in GROUPS if math.gcd(n, pinion) == math.gcd(n, gear) == 1)
        kinds = [(0, "form-cut"), (hobbing, "form-cut")]
        kinds += [(0, "generated")] if (pinion, gear) in GENERATED else []
        for offset in offsets:
            for groups, process in kinds:
                yield sample.varied(
                    {
                        "name": f"{pinion}_{gear}_{offset:g}_{groups}_{process}",
                        "pair.pinion_teeth": pinion,
                        "pair.gear_teeth": gear,
                        "pair.offset_mm": offset,
                        "pair.outer_pitch_diameter_mm": 190.0,
                        "pair.face_width_mm": 30.0,
                        "pair.pinion_spiral_angle_deg": None,
                        "pair.gear_spiral_angle_deg": 32.0,
                        "cutter.radius_mm": 76.0,
                        "cutter.blade_groups": groups,
                        "machine.gear": process,
                    }
                )


def row(blank: BlankFile) -> Row:
    """Return the row of one blank: as asked with curved blades, or else with all freedoms."""
    pair, began = blank.pair, time.monotonic()
    found = dict.fromkeys(FIELDS, "")
    found |= {
        "design": blank.name,
        "teeth": f"{pair.pinion_teeth}:{pair.gear_teeth}",
        "offset_mm": f"{pair.offset_mm:g}",
        "blade_groups": str(blank.cutter.blade_groups),
        "gear": blank.machine.gear,
    }
    best, unmet, reason = None, [""] * 99, ""
    FILES.mkdir(parents=True, exist_ok=True)
    for freedoms, changes in (("curved blades", {}), ("and modified roll, helical motion", MORE)):
        try:
            design = design_pair(blank.varied(changes))
            check_pair(design.file)
        except GearLubeError as refusal:
            reason = reason or str(refusal)
            continue
        said = unmet_targets(design)
        if len(said) < len(unmet):
            best, unmet, found["freedoms"] = design, said, freedoms
        if not unmet:
            break
    found["seconds"] = f"{time.monotonic() - began:.0f}"
    if best is None:
        return found | {"verdict": "refused", "reason": reason}
    found["verdict"] = "in part" if unmet else "as asked"
    found["reason"] = " ".join(unmet)
    text = toml_text(best.file.model_dump(exclude_defaults=True))
    (FILES / f"{blank.name}.toml").write_text(text, encoding="utf-8")
    return found | _numbers(best) | {"teeth_as_cut": _teeth(best)}


def _numbers(design: Design) -> Row:
    row: Row = {}
    for side in SIDES:
        found = design.measured[side]
        if isinstance(found, str):
            continue
        error, turned, centre, length = misses(design.targets[side], found, design.designed)
        row |= {
            f"{side}_error_percent": f"{100.0 * error:.1f}",
            f"{side}_path_deg": f"{math.degrees(turned):.2f}",
            f"{side}_centre_mm": f"{1e3 * centre:.3f}",
            f"{side}_length_percent": f"{100.0 * length:.0f}",
            f"{side}_contact_ratio": f"{found.contact_ratio:.2f}",
        }
    return row


def _teeth(design: Design) -> str:
    found = []
    for role in ("pinion", "gear"):
        form = tooth_form(design.file, role)  # type: ignore[arg-type]
        if form.topland.min() <= 0.0:
            found.append(f"{role} pointed")
        for side, limit in (("drive", form.drive), ("coast", form.coast)):
            used = limit.undercut & (limit.s > form.active)
            if used.any():
                found.append(f"{role} {side} undercut on {100.0 * float(used.mean()):.0f} %")
    return "; ".join(found) or "sound"


def loaded(name: str) -> Row:
    """Return the loaded contact of a written gear file: one torque, four positions."""
    file = gl.HypoidGearFile.from_toml(FILES / f"{name}.toml")
    cycle = CycleSettings(positions=4, torques=(TORQUE,))
    try:
        contact = analyse_contact(file, gl.studies.ContactSettings(cycle=cycle), jobs=1)
    except GearLubeError as refusal:
        return {"loaded": str(refusal)}
    row: Row = {"loaded": "done"}
    for one in contact_summary(contact):
        row[f"{one.side}_stiffness_n_um"] = f"{1e-6 * one.secant_stiffness:.0f}"
        row[f"{one.side}_pressure_gpa"] = f"{1e-9 * one.highest_pressure:.2f}"
    return row


def known() -> list[Row]:
    """Return the rows that are there."""
    if not ROWS.exists():
        return []
    with ROWS.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def keep(rows: list[Row]) -> None:
    """Write the rows."""
    with ROWS.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def survey() -> None:
    """Compute what is missing: first all designs, then their loaded contact."""
    rows = known()
    there = {one["design"] for one in rows}
    for blank in blanks():
        if blank.name not in there:
            rows.append(row(blank))
            logger.info("%s: %s", blank.name, rows[-1]["verdict"])
            keep(rows)
    for one in rows:
        if one["verdict"] != "refused" and not one["loaded"]:
            one |= loaded(one["design"])
            logger.info("%s, loaded: %s", one["design"], one["loaded"])
            keep(rows)


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    logger.setLevel(logging.INFO)
    survey()
