"""Drag torque of a tapered roller bearing of a shaft by the catalogue of SKF."""

from __future__ import annotations

import math

from gearlube_core.bearings.losses.skf_2013 import SkfBearing, skf_torque
from gearlube_core.bearings.palmgren_1959 import SMOOTHING_SPEED
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.kernels.jit import kernel


@kernel
def skf_drag(
    speed: float, axial_load: float, radial_load: float, nu: float, p: BearingParameters
) -> float:
    """Return the drag torque of one tapered roller bearing, with the sign of the speed.

    M = (M_rr + M_sl) w/sqrt(w^2 + w0^2)

    Parameters
    ----------
    speed : float
        Speed w of the shaft [rad/s].
    axial_load, radial_load : float
        Of the bearing, not negative [N].
    nu : float
        Kinematic viscosity of the oil [m2/s].
    p : BearingParameters
        Bearing.

    Returns
    -------
    float
        Torque that opposes the rotation when subtracted from the shaft [N m].

    Notes
    -----
    Rolling of the raceways and sliding of the rib, see `skf_torque`; without its drag term. The
    factor in w, with w0 = 1 rad/s, makes the torque smooth through zero speed.
    """
    bearing = SkfBearing(
        p.mean_diameter - 0.5 * p.ring_section,
        p.mean_diameter + 0.5 * p.ring_section,
        p.skf_rolling,
        p.skf_sliding,
        0.5 * p.axial_factor,
    )
    rolling, sliding = skf_torque(bearing, abs(speed), axial_load, radial_load, nu)
    smooth = speed / math.sqrt(speed * speed + SMOOTHING_SPEED * SMOOTHING_SPEED)
    return (rolling + sliding) * smooth
