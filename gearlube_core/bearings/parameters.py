"""Parameters of one bearing for the roller kernels, as plain floats."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

ROLLERS_MAX = 40  # largest number of rollers the trigonometric tables hold

# The load of a film below which its load dependence is held constant, given as an approach [m].
FILM_FLOOR_APPROACH = 0.5e-6
# Above this multiple of FILM_FLOOR_APPROACH it is held constant again [-].
FILM_RANGE = 256.0

_ANGLES = (
    2.0 * np.pi * np.arange(ROLLERS_MAX) / np.maximum(np.arange(ROLLERS_MAX + 1), 1)[:, np.newaxis]
)
COS_TABLE = np.cos(_ANGLES)  # cosine of the angle of roller i among N at [N, i]
SIN_TABLE = np.sin(_ANGLES)  # sine likewise


class BearingParameters(NamedTuple):
    """One roller bearing; the two opposed bearings of a shaft share it.

    The floats of `TaperedRollerParameters`, which `TaperedRollerBearing.parameters` builds.
    """

    kn: float  # inner race - roller - outer race stiffness [N/m^n]
    n: float  # load-approach exponent [-], 10/9 for lines
    n_rollers: float  # number of rollers, integral, 3 to ROLLERS_MAX [-]
    sin_contact: float  # sine of the contact angle [-]
    cos_contact: float  # cosine of the contact angle [-]
    interference: float  # approach at zero displacement and zero film, < 0 clearance [m]
    cage_ratio: float  # cage speed over shaft speed [-]
    loss: float  # hysteresis coefficient of [mohammadpour_2015 (25)], 0.009 [-]
    approach_factor: float  # 1 full approach, 0.5 as printed in [mohammadpour_2015 (26)] [-]
    clip: float  # 1 no tension, 0 as printed [-]
    film_constant: float  # film at the floor load / ((eta0 u)^0.647 alpha^0.46), 0 off
    film_speed_radius: float  # mean entraining speed over shaft speed [m]
    squeeze: float  # 1 with the squeeze factor of [mohammadpour_2015 (27)], 0 without [-]
    mean_diameter: float  # (bore + outside diameter)/2, for the drag [m]
    ring_section: float  # outside diameter less bore [m]
    skf_rolling: float  # R1 of the series in `skf_2013` [-]
    skf_sliding: float  # S1 ditto [-]
    f0: float  # viscous factor of the drag [-], 0 off
    f1: float  # load factor of the drag [-], 0 off
    axial_factor: float  # 2 Y = 0.8 cot(contact angle), load of the drag over axial load [-]
    roller_length: float  # [m]
    roller_radius: float  # at the middle [m]
    inner_radius: float  # of the inner race there, from the shaft's axis [m]
    outer_radius: float  # ditto of the outer race [m]
    reduced_modulus: float  # E' = 2 E* of rollers and races [Pa]
    rib_height: float  # of the contact of roller end and rib above the inner race [m]; 0: no rib
    rib_friction: float  # of the asperities there [-]
    rib_roughness: float  # composite rms there [m]
    conductivity: float  # of rollers and races [W/(m K)]
    density: float  # of theirs [kg/m3]
    heat_capacity: float  # [J/(kg K)]
