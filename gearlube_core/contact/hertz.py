"""Hertz contact of an ellipse and of a line."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

_CYCLES = 8  # quadratic convergence: enough for axis ratios down to 1e-9
_ITERATIONS = 12
_TOLERANCE = 1.0e-13  # on ln(a/b)
_LARGEST_LOG_RATIO = 18.0  # a/b = 6.6e7, beyond any ellipse that is not a line contact
LARGEST_OVER_MEAN = 4.0 / math.pi  # p_0/p of an elliptical pressure over a strip


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


@kernel
def log_curvature_ratio(log_ellipticity: float) -> float:
    """Return ln(R_y/R_x) of the solids that touch in an ellipse with a/b = exp(argument).

    R_y/R_x = (K - D) / ((b/a)^2 D)

    Parameters
    ----------
    log_ellipticity
        ln(a/b) [-], not negative.

    Returns
    -------
    float
        [-], between 1.5 and 2 times the argument for slender ellipses.

    Notes
    -----
    Same as [(a/b)^2 E - K] / [K - E] of [johnson_1985 (4.28)].
    """
    K, D = complete_elliptic_k_d(math.exp(-log_ellipticity))
    return math.log((K - D) / D) + 2.0 * log_ellipticity


@kernel
def ellipticity(radius_ratio: float) -> float:
    """Return a/b of the contact ellipse of two solids.

    Solves [(a/b)^2 E - K] / [K - E] = R_y/R_x with m = 1 - (b/a)^2 by secants in ln(a/b)

    Parameters
    ----------
    radius_ratio
        R_y/R_x [-], at least 1: larger over smaller relative radius of curvature.

    Returns
    -------
    float
        a/b [-], at least 1.

    Notes
    -----
    Ratios from 1 to 1e12; larger ones return the ellipse of the limit.
    Source: [johnson_1985 (4.28)].
    """
    target = math.log(radius_ratio)
    if target <= 0.0:
        return 1.0
    # the slope of the curve lies between 3/2 (circle) and 2 (slender ellipse)
    low, high = 0.5 * target, min(target / 1.5, _LARGEST_LOG_RATIO)
    x_old, x = low, 0.637 * target  # 2/pi, the Hamrock and Brewe exponent
    f_old = log_curvature_ratio(x_old) - target
    for _ in range(_ITERATIONS):
        x = min(max(x, low), high)
        f = log_curvature_ratio(x) - target
        slope = (f - f_old) / (x - x_old) if x != x_old else 1.75
        slope = min(max(slope, 1.5), 2.5)
        x_old, f_old = x, f
        step = f / slope
        x -= step
        if abs(step) < _TOLERANCE:
            break
    return math.exp(x)


@kernel
def hertz_coefficients(
    R_x: float, R_y: float, contact_modulus: float
) -> tuple[float, float, float]:
    """Return semi-axes along x and y and mean pressure under a unit load.

    a = k b,  b = [3 E R W / (pi k E*)]^(1/3),  p_mean = W/(pi a b),  1/R = 1/R_x + 1/R_y

    Parameters
    ----------
    R_x, R_y
        Relative principal radii of curvature [m], positive, in either order.
    contact_modulus
        E* [Pa].

    Returns
    -------
    tuple of float
        c_x, c_y, c_p with semi-axis along x = c_x W^(1/3) [m], along y = c_y W^(1/3) [m] and
        p_mean = c_p W^(1/3) [Pa]; the area is W/p_mean [m2].

    Notes
    -----
    Smooth elastic half-spaces; contact small against both radii.
    Source: [johnson_1985 sec. 4.2]; [hamrock_brewe_1983] for this arrangement.
    """
    k = ellipticity(max(R_x, R_y) / min(R_x, R_y))
    K, D = complete_elliptic_k_d(1.0 / k)
    m = (1.0 - 1.0 / k) * (1.0 + 1.0 / k)
    E = K - m * D
    R = R_x * R_y / (R_x + R_y)
    c_b = (3.0 * E * R / (math.pi * k * contact_modulus)) ** (1.0 / 3.0)
    c_a = k * c_b
    c_p = 1.0 / (math.pi * c_a * c_b)
    if R_x <= R_y:
        return c_b, c_a, c_p
    return c_a, c_b, c_p


@kernel
def hertz_ellipse(
    R_x: float, R_y: float, contact_modulus: float, load: float
) -> tuple[float, float, float]:
    """Return semi-axes along x and y [m] and mean pressure [Pa] under a load [N].

    Parameters, equations and source as in `hertz_coefficients`.
    """
    c_x, c_y, c_p = hertz_coefficients(R_x, R_y, contact_modulus)
    cube_root = max(load, 0.0) ** (1.0 / 3.0)
    return c_x * cube_root, c_y * cube_root, c_p * cube_root


@kernel
def line_mean_pressure(line_load: float, R: float, contact_modulus: float) -> float:
    """Return the mean pressure of a line contact.

    p = w/(2 b) = [pi E* w/(16 R)]^(1/2),  p = pi/4 p_0

    Parameters
    ----------
    line_load
        w, load per unit length [N/m], not negative.
    R
        Relative radius of curvature across the line [m].
    contact_modulus
        E* [Pa].

    Returns
    -------
    float
        p [Pa]; the half width is b = w/(2 p) [m], the largest pressure p_0 = 4/pi p.

    Notes
    -----
    Half-spaces under plane strain; b small against R and against the length of the line.
    Source: [johnson_1985 (4.43)] [johnson_1985 (4.44)] [johnson_1985 (4.45)];
    b = [4 w R/(pi E*)]^(1/2).
    """
    return math.sqrt(math.pi * contact_modulus * line_load / (16.0 * R))
