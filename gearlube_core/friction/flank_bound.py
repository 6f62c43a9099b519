"""A flank's film and friction with what is known of their error."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.friction.flank_data import FlankState

# how a film model is asked: for this contact alone; likewise, and for how it changes since the last
# time; not at all, but by carrying its last answers on
ALONE, AGAIN, CARRIED = 1.0, 2.0, 3.0


class FlankEllipse(NamedTuple):
    """What a film model needs of a contact besides `ContactGeometry`; all floats, SI."""

    R_x: float  # relative radius along the minor axis of the contact ellipse [m]
    side_flow: float  # side-flow factor of a film entrained along the minor axis [-]
    cos_psi: float  # cosine of the angle of entrainment from the minor axis, not negative [-]
    psi: float  # that angle, 0 to pi/2 [rad]
    delta: float  # sliding from entrainment, positive away from the minor axis, modulo pi [rad]
    log_ellipticity: float  # ln of major over minor semi-axis [-]


class BoundedFlank(NamedTuple):
    """State of one flank contact and bounds of it; all floats."""

    state: FlankState
    outside: float  # 0: film and friction are the film model's; 1: the formulas'; between: both [-]
    film_bound: float  # of the film thickness, relative; 0 where no model tells it [-]
    friction_bound: float  # of the friction force, relative, likewise [-]
