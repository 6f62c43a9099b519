"""Parameters of the torsional pair for its kernels, as nested tuples of floats."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.friction.thermal_eyring_data import ThermalEyringOil, ThermalEyringOptions
from gearlube_core.oil.lubricant_state import LubricantState

FRICTION_OFF, EVANS_JOHNSON, THERMAL_EYRING = -1.0, 0.0, 1.0
ONE_DOF, TWO_DOF = 1.0, 2.0


class TorsionalParameters(NamedTuple):
    """Constants of one gear pair; built by `HypoidTorsionalParameters.kernel_parameters`."""

    form: float  # ONE_DOF or TWO_DOF
    I_p: float  # kg m2
    I_g: float  # kg m2
    z_p: float  # pinion teeth [-]
    ratio: float  # gear teeth / pinion teeth [-]
    R_p0: float  # mean radii [m]
    R_g0: float  # m
    m_eq: float  # kg
    backlash: float  # 2b along the line of action [m]
    c: float  # mesh damping [N s/m]
    gated: float  # 0: damping acts within the backlash too, as printed
    consistent: float  # 1 with the terms that make the mesh conserve energy, 0 as printed
    pinion_torque: float  # mean [N.m]
    ripple: float  # share of the mean that the pinion torque swings by, once a revolution [-]
    instantaneous_load: float  # 1: the load follows R_g/R_p through the mesh, 0: it does not
    hold_gain: float  # speed hold on the pinion [N.m s/rad]
    friction_form: float  # FRICTION_OFF, EVANS_JOHNSON or THERMAL_EYRING
    surface: SurfaceParameters
    solid: SolidParameters
    oil: LubricantState
    along_sliding: float  # 1: entrainment speed as printed, along sliding; 0: vector mean
    thermal_oil: ThermalEyringOil
    thermal: ThermalEyringOptions
