"""Write docs/designs.md from what the survey found: python -m docs.designs.page."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from docs.designs.survey import TORQUE, Row, known

PAGE = Path(__file__).parents[1] / "designs.md"
HEAD = """# Designs of many ratios and offsets

Written by `python -m docs.designs.page` from `docs/designs/designs.csv`, which
`python -m docs.designs.survey` computes; not edited by hand.

Blanks by method 3 of ISO 23509: gear of 190 mm, face width 30 mm, spiral angle of the gear 32 deg,
cutter radius 76 mm, pressure angles 20 deg. Each is designed face-milled and face-hobbed with a
form-cut gear, low ratios also with a generated gear. Asked: a transmission error of 50 urad on the
drive and 80 urad on the coast flanks, an ellipse of 10 mm, the middle of the flank; the path is
chosen. Judged by the unloaded contact analysis of the flanks as cut.

As asked: transmission error within 10 % on drive and 15 % on coast flanks, path within 2 deg, mean
contact within 0.5 mm, ellipse within 25 %. Blades are curved; where that does not suffice, modified
roll and helical motion are tried too.
"""
TABLE = """
Each pair of numbers: drive / coast. Error: found over asked. Path: direction found less asked.
Centre: distance of the mean contact from the place asked for. Loaded: secant stiffness and highest
pressure at {torque:g} N.m of the pinion as `gearlube contact` finds them, with the relief of tips and
ends that the design chose for its own torque, 1.4 kN.m at the gear.

| Teeth | Offset [mm] | Process | Error [%] | Path [deg] | Centre [mm] | Contact ratio | Teeth as cut | Verdict | N/um | GPa |
|---|---|---|---|---|---|---|---|---|---|---|
"""  # noqa: E501
TAIL = """
- **Offsets of 10 mm** give pinions that are undercut above the reach of the gear's tip, and one
  that is pointed: few teeth and little offset want a larger pinion addendum or pressure angle.
  The report of a design says so; the survey takes the blanks as they are.
- **Offsets of 45 mm**, nearly half the gear's radius, are where designs fail. A blank that
  cannot be is refused at once.
- **Generated gears** with offsets from 35 mm on are not found: the pinion then starts from a
  crown gear that is a tenth of a millimetre and more from conjugate.
- A loaded contact that is not there was not computed, or its tooth cannot be meshed with
  elements (pointed, or with a slot that closes).
"""


def page(rows: list[Row]) -> str:
    """Return docs/designs.md."""
    count = Counter(one["verdict"] for one in rows)
    unsound = sum(one["teeth_as_cut"] not in ("sound", "") for one in rows)
    loaded = sum(one["loaded"] == "done" for one in rows)
    seconds = sorted(int(one["seconds"]) for one in rows)
    summary = (
        f"\n**{len(rows)} designs: {count['as asked']} as asked, {count['in part']} in part, "
        f"{count['refused']} refused.** {unsound} have pointed teeth or undercut above the reach "
        f"of the mate's tip. Half of them took {seconds[len(seconds) // 2]} s or less, the longest "
        f"{seconds[-1]} s, beside other work on the machine. The loaded contact of {loaded} was "
        "computed.\n"
    )
    lines = "".join(f"{_line(one)}\n" for one in rows)
    return HEAD + summary + TABLE.format(torque=TORQUE) + lines + TAIL


def _line(one: Row) -> str:
    groups = one["blade_groups"]
    process = f"hobbed, {groups} groups" if groups != "0" else "milled"
    process += ", generated gear" if one["gear"] == "generated" else ""
    names = ("error_percent", "path_deg", "centre_mm", "contact_ratio")
    pairs = [_pair(one, name) for name in names]
    forces = [_pair(one, name) for name in ("stiffness_n_um", "pressure_gpa")]
    verdict = one["verdict"]
    if one["freedoms"].startswith("and"):
        verdict += ", with modified roll and helical motion"
    cells = (one["teeth"], one["offset_mm"], process, *pairs, one["teeth_as_cut"], verdict, *forces)
    return f"| {' | '.join(cells)} |"


def _pair(one: Row, name: str) -> str:
    texts = [one[f"{side}_{name}"] or "-" for side in ("drive", "coast")]
    return "-" if texts == ["-", "-"] else " / ".join(texts)


if __name__ == "__main__":
    PAGE.write_text(page(known()), encoding="utf-8")
