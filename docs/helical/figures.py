"""The picture of branches with tooth separation, for docs/helical.md."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from docs.helical.separation import Curve
from gearlube.plotting.style import SERIES, house_style, new_figure

UM = 1e6


def save_separation_figure(curves: Sequence[tuple[str, Sequence[Curve]]], file: Path) -> None:
    """Draw branches side by side: swing above, shares of time below."""
    with house_style():
        figure = new_figure(5.2 * len(curves), 6.4)
        axes = figure.subplots(
            2, len(curves), sharex=True, squeeze=False, gridspec_kw={"height_ratios": (2.2, 1.0)}
        )
        for (title, group), (top, bottom) in zip(curves, axes.T, strict=True):
            for row, curve in enumerate(group):
                _draw(top, bottom, curve, SERIES[row % len(SERIES)])
            top.set_title(title)
            top.set_yscale("log")
            top.legend(loc="upper left")
            bottom.set_xlabel("mesh frequency over natural frequency of the mesh")
            bottom.set_xlim(group[0].relative.min(), group[0].relative.max())
            bottom.set_ylim(0.0, None)
        axes[0, 0].set_ylabel(r"mesh deflection $\delta_z$, peak to peak [µm]")
        axes[1, 0].set_ylabel("share of time [%]")
        figure.suptitle(
            "Above: motion with tooth separation, dashed where unstable; dotted: springs that also "
            "pull.\nBelow: time without any contact (wide), with part of the lines off (thin)",
            fontsize=10.0,
        )
        figure.savefig(file, dpi=150)


def _draw(top: Any, bottom: Any, curve: Curve, colour: str) -> None:
    top.plot([], [], color=colour, label=curve.label)
    for rows, stable in curve.branch.runs():
        style = "-" if stable else "--"
        top.plot(curve.relative[rows], UM * curve.swing[rows], style, color=colour, lw=1.5)
        for share, width in ((curve.apart, 1.8), (curve.lifted, 0.8)):
            bottom.plot(curve.relative[rows], 100.0 * share[rows], style, color=colour, lw=width)
    top.plot(curve.linear[:, 0], UM * curve.linear[:, 1], ":", color=colour, lw=1.0)
    places = [p.index for p in curve.branch.special]
    top.plot(
        curve.relative[places], UM * curve.swing[np.array(places, dtype=int)], "o", color=colour,
        mfc="white", ms=4.5,
    )  # fmt: skip
