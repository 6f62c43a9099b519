"""Numbers of a pair that any kernel of the march may read; as a user gives them, and as floats."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.dynamics.helical_pair.march.flank_views import FlankConstants, FlankScalars
from gearlube_core.dynamics.ranges import RangeLimits
from gearlube_core.number import Number
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


@dataclass(frozen=True, slots=True, kw_only=True)
class MarchScalars(FlankScalars):
    """Numbers of the pair that a user may give, besides those of `FlankScalars`.

    Parameters
    ----------
    friction_updates_per_mesh_period : int
        How often friction "film" is computed anew at each contact point, 4 to 4096; frozen in
        between.
    film_limiting_slope : float
        Limiting shear stress of a solved film over pressure [-], 0 for none: the film model knows
        none, so contacts whose mean stress comes near it count as outside.
    """

    friction_updates_per_mesh_period: Annotated[int, Number("1", 4, 4096)] = 16
    film_limiting_slope: Annotated[float, Number("1", 0.0, 1.0, "0.05 is usual.")] = 0.0


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
    film: float  # place in FILM_MODELS
    limiting_slope: float  # of a solved film's shear stress over pressure [-]; 0: none
    surface: SurfaceParameters
    solid: SolidParameters
    oil: LubricantParameters
    ranges: RangeLimits
