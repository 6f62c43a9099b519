"""Pressures of sharp edges in a figure, named in plain words."""

from __future__ import annotations

import textwrap
from typing import Any

import numpy as np

from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE, EDGE_WORDS


def mark_edge_pressure(axes: Any) -> None:
    """Shade what lies above `EDGE_PRESSURE` in axes of GPa, and say what such a pressure is."""
    drawn = [np.ravel(line.get_ydata()).astype(float) for line in axes.lines]
    top = float(np.nanmax(np.concatenate([np.zeros(1), *drawn])))
    limit = 1e-9 * EDGE_PRESSURE
    if top <= limit:
        return
    axes.axhspan(limit, 1.05 * top, color="0.9", zorder=0)
    axes.text(
        0.03,
        0.97,
        textwrap.fill(EDGE_WORDS, 58),
        transform=axes.transAxes,
        va="top",
        fontsize=7.0,
        bbox={"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 1.5},
    )
