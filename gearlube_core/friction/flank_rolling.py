"""Rolling loss of a flank: pumping of the oil into the contact."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple, get_args

from gearlube_core.contact.hertz import hertz_coefficients
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film.zhu_cheng_1989 import zhu_cheng_heating
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

FlankRolling = Literal["none", "biboulet_houpert_2010"]
FLANK_ROLLING_LAWS: tuple[str, ...] = get_args(FlankRolling)
_LENGTH_OVER_SEMI_AXIS = 3.0 * math.pi * math.pi / 16.0  # line of the mean pressure of an ellipse


class RollingGeometry(NamedTuple):
    """Line contact that stands for the ellipse of a flank at one position; all floats, SI."""

    R: float  # relative radius of curvature across the line [m]
    length_coefficient: float  # length of the line over load^(1/3) [m/N^(1/3)]


@kernel
def rolling_geometry(R_x: float, R_y: float, contact_modulus: float) -> RollingGeometry:
    """Return the line contact that stands for a Hertz ellipse.

    l = (3 pi^2/16) a,  which for slender ellipses is Q^(1/3) pi E'/(32 c^2 R_x)

    Parameters
    ----------
    R_x, R_y
        Relative principal radii of curvature along the minor and major axis, R_x <= R_y [m].
    contact_modulus
        E* [Pa].

    Returns
    -------
    RollingGeometry
        Evaluate once per contact position.

    Notes
    -----
    a is the major semi-axis, c the mean pressure over Q^(1/3), E' = 2 E*. A slender ellipse has
    a = Q^(1/3) E'/(6 pi c^2 R_x) and a line contact p_mean^2 = pi E' Q/(32 R l): at the same load,
    radius and mean pressure, l is 1.85 a. Other ellipses get the same multiple of their a. Strips
    of a slender ellipse that roll each by itself lose up to 1.08 times as much.
    Source: [johnson_1985 sec. 4.2] for the pressures.
    """
    semi_axis = hertz_coefficients(R_x, R_y, contact_modulus)[1]
    return RollingGeometry(R_x, _LENGTH_OVER_SEMI_AXIS * semi_axis)


@kernel
def flank_rolling_force(
    load: float,
    rolling_speed: float,
    sliding_speed: float,
    geometry: RollingGeometry,
    oil: LubricantState,
    reduced_modulus: float,
) -> float:
    """Return the rolling force F l on each of the two flanks of a contact [N].

    Parameters
    ----------
    load
        Q [N], positive.
    rolling_speed
        Mean of the two surface speeds across the contact line, u_n [m/s], not negative.
    sliding_speed
        In any direction [m/s], not negative.
    geometry
        See `rolling_geometry`.
    oil
        Oil at the inlet temperature.
    reduced_modulus
        E' = 2 E* [Pa].

    Returns
    -------
    float
        Both surfaces work against it: the contact loses 2 F l u_n [W].

    Notes
    -----
    Flooded and Newtonian. Inlet heating lowers F once, by the factor that Zhu and Cheng found for
    the film with sliding, at u_n. Roughness, and the hysteresis of the steel, are left out. Range
    as in `biboulet_houpert_force`; beyond it the fit is continued.
    Source: [biboulet_houpert_2010] [zhu_cheng_1989]
    """
    if rolling_speed <= 0.0 or load <= 0.0:
        return 0.0
    length = geometry.length_coefficient * load ** (1.0 / 3.0)
    line_load = load / length
    force, _ = biboulet_houpert_force(
        geometry.R, line_load, reduced_modulus, oil.eta0, oil.alpha, rolling_speed
    )
    pressure = math.sqrt(line_load * reduced_modulus / (2.0 * math.pi * geometry.R))
    heating = zhu_cheng_heating(
        inlet_heating_number(oil.eta0, oil.beta, rolling_speed, oil.conductivity),
        pressure / reduced_modulus,
        sliding_speed / rolling_speed,
    )
    return force * heating * length
