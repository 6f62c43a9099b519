"""Line contact of smooth elastic solids after Hertz."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

LARGEST_OVER_MEAN = 4.0 / math.pi  # p_0/p of an elliptical pressure over a strip


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
