"""A flank's film and friction with what is known of their error."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.friction.flank_data import FlankState


class FlankEllipse(NamedTuple):
    """What a film model needs of a contact besides `ContactGeometry`; all floats, SI."""

    R_x: float  # relative radius along the minor axis of the contact ellipse [m]
    R_y: float  # along its major axis [m]
    ellipticity: float  # major over minor semi-axis [-]
    psi: float  # entrainment from the minor axis, 0 to pi/2 [rad]
    delta: float  # sliding from entrainment, positive away from the minor axis, modulo pi [rad]


class ModelFilm(NamedTuple):
    """What a film model says of a contact; all floats, fit to be interpolated."""

    log_film: float  # ln of the central film in m
    log_friction: float  # ln of the friction coefficient of the film alone
    outside: float  # 0 within the model's domain, 1 where it says nothing [-]


class BoundedFlank(NamedTuple):
    """State of one flank contact and bounds of it; all floats."""

    state: FlankState
    outside: float  # 0: film and friction are the film model's; 1: the formulas'; between: both [-]
    film_bound: float  # of the film thickness, relative; 0 where no model tells it [-]
    friction_bound: float  # of the friction force, relative, likewise [-]


NO_MODEL_FILM = ModelFilm(0.0, 0.0, 1.0)
