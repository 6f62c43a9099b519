"""Complete elliptic integrals by the arithmetic-geometric mean."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

_CYCLES = 8  # quadratic convergence: enough for axis ratios down to 1e-9


@kernel
def complete_elliptic_k_d(axis_ratio: float) -> tuple[float, float]:
    """Return K and D = (K - E)/m of an ellipse with axis ratio b/a, m = 1 - (b/a)^2.

    K = pi / (2 agm(1, b/a)),  D = K (1/2 + sum over n >= 1 of 2^(n-1) c_n^2 / m)

    Parameters
    ----------
    axis_ratio
        Minor over major semi-axis b/a [-], above 0 and up to 1.

    Returns
    -------
    tuple of float
        K and D [-]; E = K - m D.

    Notes
    -----
    D is formed without the difference K - E and keeps its digits for a circle, where
    K = pi/2 and D = pi/4. Source: [abramowitz_stegun_1964 sec. 17.6].
    """
    complement = 1.0 - axis_ratio
    a, g = 0.5 * (1.0 + axis_ratio), math.sqrt(axis_ratio)
    c_squared = 0.25 * complement * complement
    c_squared_over_m = 0.25 * complement / (1.0 + axis_ratio)
    weighted_sum, weight = 0.5 + c_squared_over_m, 1.0
    for _ in range(_CYCLES):
        mean = 0.5 * (a + g)
        g = math.sqrt(a * g)
        a = mean
        factor = c_squared / (16.0 * a * a)
        c_squared *= factor
        c_squared_over_m *= factor
        weight *= 2.0
        weighted_sum += weight * c_squared_over_m
    K = 0.5 * math.pi / a
    return K, K * weighted_sum
