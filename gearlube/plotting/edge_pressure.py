"""Pressures of sharp edges in a figure, named in plain words."""

from __future__ import annotations

import textwrap
from typing import Any

import numpy as np

from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE, EDGE_WORDS

_ROOM = 1.45  # height over the highest value, for the words


def mark_edge_pressure(axes: Any) -> None:
    """Shade what lies above `EDGE_PRESSURE` in axes of GPa, and say what such a pressure is."""
    drawn = [np.ravel(line.get_ydata()).astype(float) for line in axes.lines]
    top = float(np.nanmax(np.concatenate([np.zeros(1), *drawn])))
    limit = 1e-9 * EDGE_PRESSURE
    if top <= limit:
        return
    above = max(axes.get_ylim()[1], _ROOM * top)
    # far beyond the top: axes that share it may be stretched later
    axes.axhspan(limit, 100.0 * above, color="0.92", zorder=0)
    axes.set_ylim(0.0, above)
    axes.text(
        0.5,
        0.97,
        textwrap.fill(EDGE_WORDS, 56),
        transform=axes.transAxes,
        ha="center",
        va="top",
        fontsize=7.0,
    )
