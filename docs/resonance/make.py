"""Put numbers into docs/resonance.md and draw its pictures: python -m docs.resonance.make [DIR].

Follows the branches of nine pairs, runs flank contacts along their motions, and checks motions by
integration in time: about three minutes on two cores. What is finished is kept in the folder given
as argument, by default build/resonance; run again to go on after a stop.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from docs.page import IMAGES, Page, begin, tally
from docs.resonance.cases import SEPARATED_FROM, Curve
from docs.resonance.claims_dynamics import DYNAMICS
from docs.resonance.claims_tribology import TRIBOLOGY
from docs.resonance.decisions import flank_decisions
from docs.resonance.evidence import Both, Evidence, gather, kept
from docs.resonance.numerics import agreements, linear_limit
from gearlube.plotting.style import GREY, SERIES, house_style, new_figure
from gearlube.studies.resonance.figures.catalogue import save_resonance_figures
from gearlube.studies.resonance.run import run_resonance
from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube_core.periodic.branch import Kind

UM = 1e6


def study() -> tuple[xr.Dataset, xr.Dataset]:
    """Return what `gearlube resonance` writes with its defaults."""
    found = run_resonance(ResonanceSettings())
    return found.response, found.cycle


def put_claims(page: Page, evidence: Evidence) -> None:
    """Put in what was found for all statements, and how many hold."""
    found = {name: claim(evidence) for name, claim in DYNAMICS.items()}
    flanks = {name: claim(evidence) for name, claim in TRIBOLOGY.items()}
    page.claims({name: _both(one) for name, one in found.items()}, "## Validation: the motion")
    page.claims(
        {name: _shipped(one) for name, one in flanks.items()}, "## Validation: film, heat, friction"
    )
    shipped = [one[1] for one in (*found.values(), *flanks.values())]
    other = [one.reconstructed_verdict for one in (*found.values(), *flanks.values())
             if isinstance(one, Both)]  # fmt: skip
    page.fill(
        "Shipped mesh: {}; reconstructed mesh with mismatch: {}.\n\n",
        *(tally(word for word in words if word != "-") for words in (shipped, other)),
    )


def _both(found: Both) -> tuple[str | None, ...]:
    words = (word if word == "-" else f"**{word}**" for word in found[1:4:2])
    return (found.shipped, next(words), found.reconstructed, next(words), found.reason)


def _shipped(found: Any) -> tuple[str | None, ...]:
    if not isinstance(found, Both):
        return (found.value, f"**{found.verdict}**", found.reason)
    value = f"{found.shipped}; with mismatch {found.reconstructed}"
    verdict = f"**{found.shipped_verdict}**; with mismatch **{found.reconstructed_verdict}**"
    return (value, verdict, found.reason)


def branch_rows(evidence: Evidence) -> list[list[str]]:
    """Return folds, bistable range and separation of every response."""
    named = {
        "Shipped, 2-DOF": evidence.two,
        "Shipped, 2-DOF, both radii from the table": evidence.paper,
        "Shipped, 2-DOF, constant radii": evidence.mean,
        "Shipped, 1-DOF": evidence.one,
        "Reconstructed, 1-DOF": evidence.reconstructed_one,
    }
    for d, curve in evidence.mismatched.items():
        named[f"Reconstructed, 2-DOF, {100.0 * d:g} % mismatch"] = curve
    return [
        [
            name,
            f"{curve.response.natural_frequency:.0f}",
            *map(_span, (curve.bistable, curve.separated("up"), curve.separated("down"))),
            _special(curve, "period doubling"),
            *(_sizes(curve, relative) for relative in (0.65, 0.9, 1.0)),
        ]
        for name, curve in named.items()
    ]


def _special(curve: Curve, kind: Kind) -> str:
    places = [
        float(curve.response.relative(point.parameter))
        for segment in curve.response.segments
        for point in segment.branch.of_kind(kind)
    ]
    shown = sorted({f"{place:.3f}" for place in places if place > SEPARATED_FROM})
    return ", ".join(shown) or "none"


def _span(span: tuple[float, float] | None) -> str:
    return "none" if span is None else f"{span[0]:.3f} to {span[1]:.3f}"


def _sizes(curve: Curve, relative: float) -> str:
    points = curve.points.get(relative, [])
    return " / ".join(f"{UM * p.peak_to_peak:.2f}" for p in points) or "none stable"


def put_double_count(page: Page, evidence: Evidence) -> None:
    """Put in what the shipped radii do besides the error."""
    more = [
        100.0 * (evidence.paper.up(r).peak_to_peak / evidence.two.up(r).peak_to_peak - 1.0)
        for r in (0.3, 0.5, 0.65, 0.8, 1.0, 1.2, 1.4)
    ]
    page.fill(
        "With the shipped mesh that adds {} to {} % (0.3 to 1.4 w_n)",
        f"{min(more):.0f}",
        f"{max(more):.0f}",
    )


def mismatch_figure(evidence: Evidence) -> Any:
    """Return the response of the reconstructed pair with growing mismatch beside the shipped."""
    with house_style():
        figure = new_figure(10.0, 4.6)
        left, right = figure.subplots(1, 2, sharey=True)
        for curve, name, colour in (
            (evidence.one, "1-DOF (wide)", GREY),
            (evidence.two, "2-DOF, consistent radii", SERIES[0]),
            (evidence.paper, "2-DOF, both radii from the table", SERIES[1]),
        ):
            _draw(left, curve, name, colour)
        left.set_title("shipped mesh")
        _draw(right, evidence.reconstructed_one, "1-DOF (wide)", GREY)
        for (mismatch, curve), colour in zip(evidence.mismatched.items(), SERIES, strict=False):
            _draw(right, curve, f"2-DOF, mismatch {100.0 * mismatch:g} %", colour)
        right.set_title("reconstructed mesh, with a mismatch of the ratio")
        left.set_ylabel("transmission error, peak to peak [µm]")
        for ax in (left, right):
            ax.set_xlabel("mesh frequency / natural frequency [-]")
            ax.set_yscale("log")
            ax.legend(loc="lower right")
        figure.suptitle(
            "A mismatch of the ratio lets the separated motion go on to high speeds. "
            "Lines: stable; dotted: unstable",
            fontsize=11,
        )
    return figure


def _draw(ax: Any, curve: Curve, name: str, colour: str) -> None:
    for segment in curve.response.segments:
        relative = curve.response.relative(segment.branch.parameter)
        swing = UM * np.array([np.ptp(segment.orbit(i).x) for i in range(relative.size)])
        for rows, stable in segment.branch.runs():
            style = "-" if stable else ":"
            width = (1.5 if stable else 1.0) * (2.5 if colour == GREY else 1.0)
            ax.plot(relative[rows], swing[rows], style, color=colour, lw=width)
    ax.plot([], [], "-", color=colour, label=name)


def main(work: Path) -> None:
    """Run or resume, write the page and the pictures."""
    evidence, page = gather(work), Page("resonance")
    page.rows("Pair | f_n, Hz", branch_rows(evidence))
    put_double_count(page, evidence)
    put_claims(page, evidence)
    flank_decisions(page, work)
    count, worst = kept(work, "agreement", lambda: agreements(evidence))
    page.fill("{} motions, disturbed and integrated in time by DOP853, differ by at most {} % from",
              count, f"{worst:.3f}")  # fmt: skip
    page.fill("closed form within {} (1-DOF) and {} (2-DOF,",
              *kept(work, "linear_limit", linear_limit))  # fmt: skip
    page.write()
    mismatch_figure(evidence).savefig(IMAGES / "resonance_mismatch.png", dpi=150)
    for picture in save_resonance_figures(*kept(work, "study", study), work / "figures"):
        if f"resonance_{picture.name}" in page.text:
            shutil.copyfile(picture, IMAGES / f"resonance_{picture.name}")


if __name__ == "__main__":
    main(begin("resonance"))
