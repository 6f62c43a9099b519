"""Constants of a pair for the time integration kernels: floats only."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.oil.lubricant import LubricantParameters


class SupportConstants(NamedTuple):
    """Support of one member: stiffness against (u, theta), dampers on its diagonal."""

    K_xx: float  # [N/m]
    K_yy: float
    K_zz: float
    K_ax: float  # against tilting about x [N.m/rad]
    K_ay: float
    K_x_ay: float  # symmetric coupling [N/rad]
    K_y_ax: float
    c_x: float  # [N s/m]
    c_y: float
    c_z: float
    c_ax: float  # [N.m s/rad]
    c_ay: float
    mobility: float  # 1/m [1/kg]
    mobility_z: float  # ditto along z; 0 when held
    mobility_a: float  # 1/J against tilting [1/(kg m2)]; 0 when held
    mobility_r: float  # 1/J_z of rotation [1/(kg m2)]


class FlankConstants(NamedTuple):
    """Geometry of the flanks, of which the back ones are the drive ones turned about."""

    plane: ContactPlane
    damping: float  # `mesh_damping.damping_factor` [sqrt(kg)]
    backlash: float  # normal [m]
    coast_phase: float  # phase of drive flank plus phase of coast flank [mesh periods]
    turn_cos: float  # cosine and sine of twice the angle of the line of centres against y
    turn_sin: float
    line_work: float  # 1: lines that move under load exchange work with the pinion; 0: none
    lines: float  # contact lines in the line mesh
    phases: float  # mesh phases in it
    stations: float  # places along a line in it


class MotionConstants(NamedTuple):
    """What the rates of change depend on."""

    flanks: FlankConstants
    pinion: SupportConstants
    gear: SupportConstants


class MarchConstants(NamedTuple):
    """Constants of the marching model; `motion` comes first, so that it can be read alone."""

    motion: MotionConstants
    teeth: float  # of the pinion
    friction_form: float  # -1 off, 0 constant, 1 film
    mu: float  # of the constant form [-]
    refreshes: float  # of the film's friction in a mesh period
    surface: SurfaceParameters
    solid: SolidParameters
    oil: LubricantParameters
