"""Pressure at the edges against the cells, with sharp and with relieved teeth.

Rewrite the picture and the numbers of docs/tooth_contact.md:
python -m docs.tooth_contact.relief. Some minutes.
"""

from __future__ import annotations

import csv
import logging
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from docs.page import IMAGES, Page, begin
from gearlube.output.csv_text import csv_text
from gearlube.plotting.style import MARKERS, SERIES, house_style, new_figure
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings

HERE = Path(__file__).resolve().parent
NUMBERS = HERE / "relief.csv"
PICTURE = IMAGES / "contact_relief.png"
CELLS = (24, 32, 48, 64, 96)  # across; half as many again along
TORQUE, PHASES = 250.0, 8
_NAMES = ("case", "cells_across", "cells_along", "pressure_gpa", "error_urad")
logger = logging.getLogger("docs.tooth_contact.relief")

_TIP = {"tip_relief_um": 20.0, "tip_relief_depth_mm": 1.9}
_MORE = {"tip_relief_um": 30.0, "tip_relief_depth_mm": 2.5}
_ENDS = {
    "toe_relief_um": 30.0,
    "toe_relief_length_mm": 5.0,
    "heel_relief_um": 30.0,
    "heel_relief_length_mm": 5.0,
}
_DISPLACED = Misalignment(pinion_offset=200e-6)


class Case(NamedTuple):
    """A pair under load: the same relief on both members."""

    label: str
    relief: dict[str, float]
    misalignment: Misalignment


CASES = (
    Case("sharp", {}, ALIGNED),
    Case("tip edges rounded, 0.3 mm", {"tip_edge_radius_mm": 0.3}, ALIGNED),
    Case("tip relief 20 um over 1.9 mm", _TIP, ALIGNED),
    Case("tip 20 um, ends 30 um over 5 mm", _TIP | _ENDS, ALIGNED),
    Case("offset +0.2 mm, sharp", {}, _DISPLACED),
    Case("offset +0.2 mm, tip 30 um over 2.5 mm", _MORE, _DISPLACED),
    Case("offset +0.2 mm, tip 30 um, ends 30 um over 5 mm", _MORE | _ENDS, _DISPLACED),
)


def loaded(case: Case, stiffness: Any, across: int) -> list[str]:
    """Return the row of a case with so many cells across the line of contact."""
    file = HypoidGearFile.named("mohammadpour_2015")
    fields = {f"{role}.drive_flank": case.relief for role in ("pinion", "gear")}
    pair = FlankPair.from_file(file.varied(fields), "drive", case.misalignment)
    settings = LoadedSettings(
        strips=StripSettings(cells_across=across, cells_along=3 * across // 2)
    )
    states = [
        MeshPosition.at(pair, k / PHASES).load(TORQUE, stiffness, settings) for k in range(PHASES)
    ]
    pressure = [max(float(one.pressure.max()) for one in state.pairs) for state in states]
    error = np.ptp([state.rotation for state in states])
    numbers = (1e-9 * max(pressure), 1e6 * error)
    return [case.label, str(across), str(3 * across // 2), *(f"{one:.4g}" for one in numbers)]


def rows() -> list[dict[str, str]]:
    """Return the stored numbers."""
    with NUMBERS.open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def put_relief(page: Page) -> None:
    """Put in highest pressures by case and cells."""
    found = {(row["case"], int(row["cells_across"])): row for row in rows()}
    body = []
    for case in CASES:
        pressure = [float(found[case.label, n]["pressure_gpa"]) for n in CELLS]
        apart = 100.0 * abs(pressure[-1] / pressure[-2] - 1.0)
        error = float(found[case.label, CELLS[-1]]["error_urad"])
        body.append([*(f"{p:.2f}" for p in pressure), f"{apart:.1f}", f"{error:.0f}"])
    page.cells("Both members, 250 N.m", body, first=1)


def picture() -> Any:
    """Return the highest pressure over the cells, the pair in place and displaced."""
    found = rows()
    with house_style():
        figure = new_figure(9.2, 4.0)
        axes = figure.subplots(1, 2, sharey=True)
        for ax, cases in zip(axes, (CASES[:4], CASES[4:]), strict=True):
            for i, case in enumerate(cases):
                own = [row for row in found if row["case"] == case.label]
                ax.plot(
                    [int(row["cells_across"]) for row in own],
                    [float(row["pressure_gpa"]) for row in own],
                    marker=MARKERS[i],
                    color=SERIES[i],
                    lw=2.6 - 0.6 * i,  # lines that coincide show
                    label=case.label.removeprefix("offset +0.2 mm, ").replace(" um", " µm"),
                )
            ax.set_xscale("log")
            ax.set_xticks(CELLS, [str(n) for n in CELLS])
            ax.minorticks_off()
            ax.set_xlabel("cells across the line of contact")
            ax.legend()
        axes[0].set_title("pair in place")
        axes[1].set_title("pinion offset 0.2 mm too large")
        axes[0].set_ylabel("highest pressure at 250 N·m [GPa]")
        axes[0].set_ylim(0.0)
        figure.suptitle(
            "Pressure at sharp edges grows with finer cells; with tip and end relief it stays",
            fontsize=10.5,
        )
    return figure


def main() -> None:
    """Compute all cases, write numbers and picture."""
    begin("tooth_contact")
    file = HypoidGearFile.named("mohammadpour_2015")
    stiffness = pair_stiffness(file, ToothBodySettings())["drive"]
    found = []
    for case in CASES:
        for across in CELLS:
            found.append(loaded(case, stiffness, across))
            logger.info(" ".join(found[-1]))
    write_text(csv_text(_NAMES, found), NUMBERS)
    picture().savefig(PICTURE, dpi=110)


if __name__ == "__main__":
    main()
