"""The picture of what a ratio mismatch does, for docs/resonance.md."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from docs.resonance.cases import Curve
from docs.resonance.evidence import Evidence
from gearlube.plotting.style import GREY, SERIES, house_style, new_figure

UM = 1e6


def save_mismatch_figure(evidence: Evidence, file: Path) -> None:
    """Draw the response of the reconstructed pair with growing mismatch beside the shipped one."""
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
        figure.savefig(file, dpi=150)


def _draw(ax: Any, curve: Curve, name: str, colour: str) -> None:
    for segment in curve.response.segments:
        relative = curve.response.relative(segment.branch.parameter)
        swing = UM * np.array([np.ptp(segment.orbit(i).x) for i in range(relative.size)])
        for rows, stable in segment.branch.runs():
            style = "-" if stable else ":"
            width = (1.5 if stable else 1.0) * (2.5 if colour == GREY else 1.0)
            ax.plot(relative[rows], swing[rows], style, color=colour, lw=width)
    ax.plot([], [], "-", color=colour, label=name)
