"""Parameters of the axle for its kernels, as nested tuples of floats."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.bearings.bearing_type import ShaftBearings
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.oil.lubricant import LubricantParameters


class AxleParameters(NamedTuple):
    """Constants of one axle; built by `HypoidAxleParameters.kernel_parameters`.

    Bearings and flank law are NamedTuples of floats of any class with their methods.
    """

    I_p: float  # kg m2
    I_g: float  # kg m2
    m_p: float  # kg
    m_g: float  # kg
    z_p: float  # pinion teeth [-]
    backlash: float  # 2b along the line of action [m]
    loss: float  # hysteretic loss coefficient of [mohammadpour_2015 (4)] [-]
    frequency_floor: float  # lower clamp of f_m in [mohammadpour_2015 (4)], (25) [Hz]
    modal_damping: float  # N s/m; zero selects [mohammadpour_2015 (4)]
    lateral_sign: float  # +1 consistent, -1 as printed in [mohammadpour_2015 (1)] c-h
    consistent: float  # 1 with the terms that make the mesh conserve energy, 0 as printed
    friction: float  # 1 with flank friction, 0 without
    drag: float  # 1 with bearing drag torque, 0 without
    preload: float  # axial preload of a bearing, for its drag [N]
    bearing_p: ShaftBearings
    bearing_g: ShaftBearings
    flank_law: FlankLaw
    oil: LubricantParameters
