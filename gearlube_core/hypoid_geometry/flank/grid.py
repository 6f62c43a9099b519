"""Loops over many points of a flank."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion
from gearlube_core.hypoid_geometry.flank.surface_point import CONVERGED, locate, surface_point
from gearlube_core.kernels.jit import kernel


@kernel
def march(motion: CuttingMotion, radius: Array, axial: Array, starts: Array) -> Array:
    """Locate places (N,) [m] from `starts` (N, 3); return u [m], th, ph [rad], (N, 3), or NaN."""
    found = starts.copy()
    for i in range(radius.size):
        if locate(motion, radius[i], axial[i], found[i]) != CONVERGED:
            found[i] = np.nan
    return found


@kernel
def sample_surface(motion: CuttingMotion, outward: float, parameters: Array) -> Array:
    """Return (N, 16): r, normal, tangent_1, tangent_2, k_11, k_12, k_22, regularity."""
    out = np.full((parameters.shape[0], 16), np.nan)
    for i in range(parameters.shape[0]):
        if np.isnan(parameters[i, 0]):
            continue
        p = surface_point(motion, parameters[i, 0], parameters[i, 1], parameters[i, 2], outward)
        row = out[i]
        row[0], row[1], row[2] = p.r
        row[3], row[4], row[5] = p.normal
        row[6], row[7], row[8] = p.tangent_1
        row[9], row[10], row[11] = p.tangent_2
        row[12], row[13], row[14], row[15] = p.k_11, p.k_12, p.k_22, p.regularity
    return out
