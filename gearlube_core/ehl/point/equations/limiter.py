"""Count of the faces whose wedge is limited to first order, kernel."""

from __future__ import annotations

import numpy as np

from gearlube_core.ehl.point.equations.stencil import StencilParameters, face_weights
from gearlube_core.kernels.jit import kernel


@kernel
def limited_faces(
    parameters: StencilParameters, pressure: np.ndarray, mass: np.ndarray
) -> tuple[int, int]:
    """Return how many faces next to pressure are limited, and how many there are.

    Parameters
    ----------
    parameters
        Of the grid.
    pressure, mass : ndarray, shape (ny, nx)
        p and rho h [-].

    Returns
    -------
    tuple of int
        Faces across the entrainment along x and, where oil is carried along y, those along y.
    """
    ny, nx = pressure.shape
    limited, total = 0, 0
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if pressure[j, i] <= 0.0:
                continue
            for along in (True, False):
                if not along and parameters.wedge_y == 0.0:
                    continue
                jj, ii = (j, i - 1) if along else (j - 1, i)
                far = mass[j, max(i - 2, 0)] if along else mass[max(j - 2, 0), i]
                near, there = mass[jj, ii], mass[j, i]
                plain = parameters.here * near + parameters.upstream * far
                plain += parameters.downstream * there
                index = i - 1 if along else j - 1
                w0, w1, w2 = face_weights(parameters, index, far, near, there)
                total += 1
                value = w0 * near + w1 * far + w2 * there
                limited += index > 0 and value != plain
    return limited, total
