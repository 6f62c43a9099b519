"""Put numbers into docs/measured.md: python -m docs.measured.make [DIR] [--present].

A quarter of an hour of one processor the first time. Films are kept in the folder given as
argument, by default build/measured: delete it after a change of films or oils. With --present
nothing is solved, and page and figure follow from points.csv and others.json.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Sequence
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from docs.measured.points import (
    Point,
    bearings,
    exponents,
    fva_3,
    mourier,
)
from docs.page import IMAGES, ROOT, Page, begin
from gearlube.plotting.style import GREY, MARKERS, SERIES, house_style, new_figure
from gearlube_core.storage.atomic_file import write_text

KEPT, OTHERS = (Path(__file__).with_name(name) for name in ("points.csv", "others.json"))
FIGURE = IMAGES / "measured.png"


def others(work: Path) -> dict[str, Any]:
    """Return the commit that predicts, and exponents between discs."""
    git = ["git", "merge-base", "HEAD", "main"]
    done = subprocess.run(git, cwd=ROOT, capture_output=True, text=True, check=True)
    found: dict[str, Any] = {"commit": done.stdout[:8]}
    return found | {f"discs_{name}": [*map(float, one)] for name, one in exponents(work).items()}


def stored() -> tuple[list[Point], dict[str, Any]]:
    """Return the points and the other numbers."""
    points = [Point(*row) for row in pd.read_csv(KEPT).itertuples(index=False)]
    return points, json.loads(OTHERS.read_text(encoding="utf-8"))


def sets(points: Sequence[Point]) -> dict[str, list[Point]]:
    """Return the points by their measurement, in their order."""
    found: dict[str, list[Point]] = {}
    for one in points:
        found.setdefault(one.data, []).append(one)
    return found


def summary(name: str, points: Sequence[Point]) -> list[str]:
    """Return the row of one measurement, or of all."""
    logs = np.array([one.log_ratio for one in points])
    misfit = f"{math.exp(logs.mean()):.2f}", f"{100.0 * math.sqrt(np.mean(logs**2)):.0f} %"
    inside = sum(one.inside for one in points)
    return [name, str(len(points)), *misfit, f"{inside} of {len(points)}"]


def put(page: Page, points: Sequence[Point], more: dict[str, Any]) -> None:
    """Put in tables and sentences."""
    by = sets(points)
    page.fill("the code of commit {} has predicted", more["commit"])
    page.rows(
        "measurement | points", [*(summary(*one) for one in by.items()), summary("all", points)]
    )
    films = [one for one in points if one.unit == "nm"]
    torques = [one for one in points if one.unit != "nm"]
    worst = max(math.exp(abs(one.log_ratio)) for one in films)
    page.fill("films are at most {} times off", f"{worst:.2f}")
    page.fill(
        "**Verdict: {} of {} measured films and {} of {} measured torques of bearings lie within "
        "the bars of 95 %",
        *(str(n) for part in (films, torques) for n in (sum(x.inside for x in part), len(part))),
    )
    powers = []
    for own in list(by.values())[:2]:
        u = np.log([float(one.where.removesuffix(" m/s")) for one in own])
        h = np.log([(one.measured, one.predicted) for one in own])
        powers += [f"{one:.2f}" for one in np.polyfit(u, h, 1)[0]]
    page.fill(
        "at 25 °C to the power {}, the solved ones {}; at 34 °C to the power {}, the solved ones "
        "{}. An inlet",
        *powers,
    )
    for name, head in (("FVA 3", "oil film of"), ("Mourier", "film of the ball")):
        page.rows(head, [_row(one) for one in films if one.data.startswith(name)])
    page.rows(
        "exponent of |",
        [
            [words, measured, *(f"{x:.3f}" for x in more[f"discs_{name}"])]
            for name, words, measured in (
                ("speed", "speed times viscosity", "0.65"),
                ("alpha", "pressure-viscosity coefficient", "0.58"),
                ("load", "load", "-0.147 ± 0.013"),
            )
        ],
    )
    page.rows("torque of the bearing", [_row(one) for one in torques])


def _row(one: Point) -> list[str]:
    digits = 0 if one.unit == "nm" else 2
    low, high = one.predicted / one.factor, one.predicted * one.factor
    return [
        f"{one.data}, {one.where}", f"{one.measured:.{digits}f}",
        f"{100.0 * (one.uncertainty - 1.0):.0f} %",
        f"**{one.predicted:.{digits}f}**", f"{low:.{digits}f} to {high:.{digits}f}",
        "yes" if one.inside else "**no**",
    ]  # fmt: skip


def draw(points: Sequence[Point]) -> Any:
    """Return films over speed, and predicted over measured values of all points."""
    first, middles = 0, []
    with house_style():
        figure = new_figure(11.0, 4.6)
        left, right = figure.subplots(1, 2)
        for (name, own), colour, marker in zip(sets(points).items(), SERIES, MARKERS, strict=False):
            measured, known, predicted, factor = np.array(
                [(one.measured, one.uncertainty, one.predicted, one.factor) for one in own]
            ).T
            if name.startswith("FVA 3"):
                u = [float(one.where.removesuffix(" m/s")) for one in own]
                left.errorbar(
                    u, measured, measured * (known - 1.0), fmt=marker, color=colour, label=name
                )
                left.plot(u, predicted, color=colour)
                ends = predicted / factor, predicted * factor
                left.fill_between(u, *ends, color=colour, alpha=0.2)
            ratio, both = predicted / measured, np.exp(np.hypot(np.log(factor), np.log(known)))
            bars = ratio * (1.0 - 1.0 / both), ratio * (both - 1.0)
            at = first + np.arange(len(own))
            right.errorbar(at, ratio, bars, fmt=marker, color=colour, elinewidth=0.7)
            middles.append(float(at.mean()))
            first += len(own) + 1
        left.set(
            xscale="log", yscale="log", xlabel="mean speed of the surfaces [m/s]",
            ylabel="central film [nm]", title="points measured, lines and bands predicted",
        )  # fmt: skip
        left.legend()
        right.axhline(1.0, color=GREY, lw=1.0)
        right.set(
            yscale="log", ylabel="predicted over measured",
            title="all points; bars of prediction and measurement together, 95 %",
        )  # fmt: skip
        right.set_yticks([0.3, 0.5, 1.0, 2.0, 5.0], labels=["0.3", "0.5", "1", "2", "5"])
        right.set_yticks([], minor=True)
        names = [name.replace(", ", "\n").replace("ing ", "ing\n") for name in sets(points)]
        right.set_xticks(middles, labels=names)
    return figure


def main() -> None:
    """Predict all points, or take those that are stored; write numbers, page and figure."""
    work = begin("measured")
    if "--present" not in sys.argv:
        table = pd.DataFrame(chain(fva_3(work), mourier(work), bearings()))
        table.to_csv(KEPT, index=False, float_format="%.5g", lineterminator="\n")
        write_text(json.dumps(others(work), indent=1) + "\n", OTHERS)
    points, more = stored()
    page = Page("measured")
    put(page, points, more)
    page.write()
    draw(points).savefig(FIGURE, dpi=110)


if __name__ == "__main__":
    main()
