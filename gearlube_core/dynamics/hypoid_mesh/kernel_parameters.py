"""Numbers of the axle that any of its kernels may read; as a user gives them, and for kernels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.bearings.bearing_type import ShaftBearings, without_loss
from gearlube_core.drag import ChurningConstants, HubTorque, SealTorque
from gearlube_core.dynamics.flank_force import BACKLASH
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshForceConstants, MeshForceScalars
from gearlube_core.dynamics.ranges import RangeLimits
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.number import Number
from gearlube_core.oil.lubricant_state import LubricantParameters

_INERTIA = Number("kg.m2", 1e-6, 500.0, "1734 kg.mm2 is 1.734e-3 kg m2.")
_MASS = Number("kg", 0.05, 2000.0, "12 000 g is 12 kg.")


@dataclass(frozen=True, slots=True, kw_only=True)
class AxleScalars(MeshForceScalars):
    """Numbers of the axle that a user may give, besides those of `MeshForceScalars`.

    Parameters
    ----------
    pinion_inertia, gear_inertia : float
        About the members' axes [kg m2], 1e-6 to 500.
    pinion_mass, gear_mass : float
        [kg], 0.05 to 2000.
    backlash : float
        Total backlash 2b along the line of action [m], 0 to 2e-3.
    pinion_seal_torque, wheel_seal_torque : float
        Of the seal of the pinion's shaft, and of those of both wheels together [N.m], 0 to 100.
    hub_torque : float
        Of the bearings of both wheel hubs together, likewise; counted among the seals.
    """

    pinion_inertia: Annotated[float, _INERTIA]
    gear_inertia: Annotated[float, _INERTIA]
    pinion_mass: Annotated[float, _MASS]
    gear_mass: Annotated[float, _MASS]
    backlash: Annotated[float, BACKLASH]
    pinion_seal_torque: SealTorque = 0.0
    wheel_seal_torque: SealTorque = 0.0
    hub_torque: HubTorque = 0.0


class AxleParameters(NamedTuple):
    """Constants of one axle; built by `HypoidAxleParameters.kernel_parameters`.

    Bearings and flank law are NamedTuples of floats of any class with their methods.
    """

    I_p: float  # kg m2
    I_g: float  # kg m2
    m_p: float  # kg
    m_g: float  # kg
    ratio: float  # teeth of the gear over those of the pinion [-]
    mesh: MeshForceConstants
    lateral_sign: float  # +1 consistent, -1 as printed in [mohammadpour_2015 (1)] c-h
    friction: float  # 1 with flank friction, 0 without
    rolling: float  # place of the law in FLANK_ROLLING_LAWS; 0 none
    drag: float  # place of the law of bearing drag in TORQUE_LOSSES; 0 none
    reduced_modulus: float  # E' = 2 E* of the flanks [Pa]
    ranges: RangeLimits
    preload_p: float  # axial preload of a bearing of the pinion, for its drag [N]
    preload_g: float  # the same of the gear
    churning: ChurningConstants
    pinion_seal_torque: float  # N.m
    wheel_seal_torque: float  # of both seals [N.m]
    hub_torque: float  # of the bearings of both wheel hubs [N.m]
    bearing_p: ShaftBearings
    bearing_g: ShaftBearings
    flank_law: FlankLaw
    oil: LubricantParameters


def without_losses(p: AxleParameters) -> AxleParameters:
    """Return the axle without flank friction and hysteresis: what is in static equilibrium."""
    return p._replace(
        friction=0.0,
        rolling=0.0,
        mesh=p.mesh._replace(hysteretic_loss=0.0),
        bearing_p=without_loss(p.bearing_p),
        bearing_g=without_loss(p.bearing_g),
    )
