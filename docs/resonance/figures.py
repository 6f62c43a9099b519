"""The picture of what a ratio mismatch does, for docs/resonance.md."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from docs.resonance.cases import Curve
from docs.resonance.evidence import Evidence

UM = 1e6


def save_mismatch_figure(evidence: Evidence, file: Path) -> None:
    """Draw the response of the reconstructed pair with growing mismatch beside the shipped one."""
    figure, axes = plt.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained")
    for curve, name, colour in (
        (evidence.one, "1-DOF", "0.45"),
        (evidence.two, "2-DOF, consistent radii", "C0"),
        (evidence.paper, "2-DOF, both radii from the table", "C3"),
    ):
        _draw(axes[0], curve, name, colour)
    axes[0].set_title("shipped mesh")
    _draw(axes[1], evidence.reconstructed_one, "1-DOF", "0.45")
    for (mismatch, curve), colour in zip(
        evidence.mismatched.items(), ("C0", "C1", "C2", "C3"), strict=True
    ):
        _draw(axes[1], curve, f"2-DOF, {100.0 * mismatch:g} %", colour)
    axes[1].set_title("reconstructed mesh, ratio mismatch")
    for ax in axes:
        ax.set_xlabel("mesh frequency / natural frequency")
        ax.set_ylabel("transmission error, peak to peak [um]")
        ax.set_yscale("log")
        ax.grid(alpha=0.3)
        ax.legend(fontsize=8, loc="lower right")
    figure.savefig(file, dpi=150)
    plt.close(figure)


def _draw(ax: plt.Axes, curve: Curve, name: str, colour: str) -> None:
    for segment in curve.response.segments:
        relative = curve.response.relative(segment.branch.parameter)
        swing = UM * np.array([np.ptp(segment.orbit(i).x) for i in range(relative.size)])
        for rows, stable in segment.branch.runs():
            style = "-" if stable else ":"
            ax.plot(relative[rows], swing[rows], style, color=colour, lw=1.3 if stable else 0.8)
    ax.plot([], [], "-", color=colour, label=name)
