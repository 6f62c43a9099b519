"""Start of a film on a grid from that of the next coarser one."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.terms.state import FilmState

COARSE_TOLERANCE = 1e-3  # of the flow residual on all but the finest grid


def zero_border(pressure: Array) -> Array:
    """Return a pressure without its negative part and zero on the border."""
    pressure = np.maximum(pressure, 0.0)
    pressure[[0, -1]] = 0.0
    pressure[:, [0, -1]] = 0.0
    return pressure


def interpolated_state(level: PointLevel, pressure: Array, coarse: FilmState) -> FilmState:
    """Return the state at a pressure from a coarser grid, no thinner than the film there.

    Interpolation leaves ripples of the film.
    """
    state = level.state(pressure, coarse.approach)
    lift = max(0.0, float(coarse.film.min()) - float(state.film.min()))
    return level.state(pressure, coarse.approach + lift)
