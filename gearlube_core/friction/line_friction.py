"""Mixed friction at a point of a lubricated contact line, per unit length of the line."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.line_hertz import line_mean_pressure
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film.dowson_toyoda_1979 import line_film_thickness
from gearlube_core.friction.flank_data import CONSISTENT
from gearlube_core.friction.mixed_friction import SPEED_FLOOR, mixed_friction
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

LINE_LOAD_FLOOR = 1.0  # N/m, film and pressure of an unloaded line are those at this floor
# Round source with the mean rise of a resting strip of length 200 half widths b: radius 4.7 b.
# Of a strip the rise grows with the logarithm of its length: 50 b to 1000 b are -22 to +26 %.
STILL_AREA_OVER_WIDTH_SQUARED = math.pi * (0.5 * 4.7) ** 2


class LineState(NamedTuple):
    """Film and friction at one point of a contact line; all floats, SI."""

    film_thickness: float  # central film [m]
    film_ratio: float  # film over composite roughness [-]
    viscous_friction: float  # [N/m], not negative
    boundary_friction: float  # [N/m], not negative
    friction_coefficient: float  # total friction over line load [-], not negative
    signed_coefficient: float  # the same with the sign of the sliding speed [-]
    temperature_rise: float  # mean of the film over the oil [K]
    mean_pressure: float  # [Pa]


@kernel
def line_friction(
    line_load: float,
    R: float,
    entrainment_speed: float,
    sliding_speed: float,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
) -> LineState:
    """Return film, friction and temperature at a point of a contact line.

    f_v = mu (w - w_a),  f_b = tau_l0 A_a + gamma w_a,  0 <= w_a <= w,  per unit length

    Parameters
    ----------
    line_load
        w, normal load per unit length of the line [N/m]; not positive: no friction.
    R
        Relative radius of curvature across the line [m].
    entrainment_speed
        Mean surface speed across the line (u_1 + u_2)/2 [m/s], either sign.
    sliding_speed
        u_1 - u_2 across the line [m/s], either sign.
    lubricant
        Lubricant at oil temperature.
    surface
        Roughness of the pair.
    solid
        Elastic and thermal data of the pair.

    Returns
    -------
    LineState
        `signed_coefficient` times line load is the friction on surface 2 along its motion, and
        minus that on surface 1. Of a helical pair, 1 the pinion: the force on the pinion along
        the y of He et al. 2007, as mu sgn(x - x_p) is there.

    Notes
    -----
    Range: that of `line_film_thickness`, `line_mean_pressure`, `plateau_stress_ratio` and
    `asperity_load`. The signed coefficient passes through zero with the sliding speed: traction
    over micrometres per second, as the isothermal Eyring film does, boundary friction over
    `BOUNDARY_SPEED`. Flanks on parallel axes do not slide along the line. Heat at rest is that of
    a strip of length 200 half widths.
    Source: [dowson_toyoda_1979] for the film; `mixed_friction` for the
    rest, with the notes of `flank_friction`.
    """
    w = max(line_load, 0.0)
    w_film = max(w, LINE_LOAD_FLOOR)
    speed = max(abs(entrainment_speed), SPEED_FLOOR)
    p = line_mean_pressure(w_film, R, solid.contact_modulus)
    h = line_film_thickness(
        R, lubricant.eta0, lubricant.alpha, speed, w_film, 2.0 * solid.contact_modulus
    )
    width = w_film / p
    friction = mixed_friction(
        w,
        w_film,
        p,
        h,
        speed,
        abs(sliding_speed),
        R,
        STILL_AREA_OVER_WIDTH_SQUARED * width * width,
        lubricant,
        surface,
        solid,
        CONSISTENT,
    )
    mu = friction.friction_coefficient
    return LineState(
        h,
        h / surface.sigma,
        friction.viscous_friction,
        friction.boundary_friction,
        mu,
        -mu if sliding_speed < 0.0 else mu,
        friction.temperature_rise,
        p,
    )
