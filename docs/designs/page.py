"""Write docs/designs.md from what the survey found: python -m docs.designs.page."""

from __future__ import annotations

from collections import Counter

from docs.designs.survey import Row, known
from docs.page import Page


def main() -> None:
    """Put the designs into the page, and how many are as asked."""
    page, rows = Page("designs"), known()
    count = Counter(one["verdict"] for one in rows)
    unsound = sum(one["teeth_as_cut"] not in ("sound", "") for one in rows)
    seconds = sorted(int(one["seconds"]) for one in rows)
    page.fill(
        "**{} designs: {} as asked, {} in part, {} refused.** {} have pointed teeth or undercut "
        "above the reach of the mate's tip. Half of them took {} s or less, the longest {} s, "
        "beside other work on the machine. The loaded contact of {} was computed.",
        len(rows),
        *(count[verdict] for verdict in ("as asked", "in part", "refused")),
        unsound,
        seconds[len(seconds) // 2],
        seconds[-1],
        sum(one["loaded"] == "done" for one in rows),
    )
    page.rows("Teeth | Offset", (_cells(one) for one in rows if one["verdict"] != "as asked"))
    page.write()


def _cells(one: Row) -> list[str]:
    groups = one["blade_groups"]
    process = f"hobbed, {groups} groups" if groups != "0" else "milled"
    process += ", generated gear" if one["gear"] == "generated" else ""
    names = ("error_percent", "path_deg", "centre_mm", "contact_ratio")
    pairs = [_pair(one, name) for name in names]
    forces = [_pair(one, name) for name in ("stiffness_n_um", "pressure_gpa")]
    verdict = one["verdict"]
    if one["freedoms"].startswith("and"):
        verdict += ", with modified roll and helical motion"
    return [
        one["teeth"], one["offset_mm"], process, *pairs, one["teeth_as_cut"], verdict, *forces,
    ]  # fmt: skip


def _pair(one: Row, name: str) -> str:
    texts = [one[f"{side}_{name}"] or "-" for side in ("drive", "coast")]
    return "-" if texts == ["-", "-"] else " / ".join(texts)


if __name__ == "__main__":
    main()
