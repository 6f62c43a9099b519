"""Drag of rib, steel and oil on the rollers of two opposed bearings of a shaft."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.losses.liebrecht_drag import liebrecht_drag
from gearlube_core.bearings.losses.rib import (
    RIB_END_RADIUS,
    RIB_SHARE_B,
    RIB_SHARE_C,
    RibParameters,
    rib_friction,
)
from gearlube_core.bearings.losses.rolling import hysteresis_power
from gearlube_core.bearings.palmgren_1959 import SMOOTHING_SPEED
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.raceway_drag import line_radii, steady_load, steady_rollers
from gearlube_core.film.chittenden_1985 import film_geometry
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

_NEWTON_STEPS = 4  # to 1e-15 of the half cone for rollers that fit


class RibDrag(NamedTuple):
    """Torques of both bearings, not negative [N m]."""

    rib: float
    hysteresis: float
    oil: float


@kernel
def roller_half_cone(k: float, sin_outer: float, cos_outer: float) -> float:
    """Return the tangent of half the cone angle of the rollers.

    tan b = k sin(a_o - b), so that rollers and races share one apex

    Parameters
    ----------
    k
        Roller diameter over pitch diameter [-].
    sin_outer, cos_outer
        Of the angle of the outer race a_o.
    """
    t = k * sin_outer / (1.0 + k * cos_outer)
    for _ in range(_NEWTON_STEPS):
        root = math.sqrt(1.0 + t * t)
        excess = t * root - k * (sin_outer - cos_outer * t)
        t -= excess / ((1.0 + 2.0 * t * t) / root + k * cos_outer)
    return t


@kernel
def rib_contact(p: BearingParameters) -> tuple[RibParameters, float]:
    """Return the contact of a roller end with the rib, and its load over that of the outer race.

    The contact angle is that of the outer race; the inner one has the angle that closes the apex.
    Without a contact angle there is no rib: all zeros.
    """
    if p.sin_contact <= 0.0:
        return RibParameters(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 0.0
    t = roller_half_cone(
        2.0 * p.roller_radius / (p.inner_radius + p.outer_radius), p.sin_contact, p.cos_contact
    )
    cos_b = 1.0 / math.sqrt(1.0 + t * t)
    sin_b = t * cos_b
    sin_mean = p.sin_contact * cos_b - p.cos_contact * sin_b
    cos_mean = p.cos_contact * cos_b + p.sin_contact * sin_b
    sin_inner = sin_mean * cos_b - cos_mean * sin_b
    cos_inner = cos_mean * cos_b + sin_mean * sin_b
    relative = 1.0 - p.cage_ratio
    # a turn about the line of contact with the inner race; the rib slides with its height times it
    sliding = p.rib_height * relative * sin_mean / sin_b
    radius = p.inner_radius + 0.5 * p.roller_length * sin_inner + p.rib_height * cos_inner
    # a rib square to the race is a hollow cone whose normals meet in the apex
    distance = radius / sin_inner
    sphere = RIB_END_RADIUS * distance
    along = 1.0 / (1.0 / sphere - 1.0 / distance)
    R_e, side_flow = film_geometry(sphere, along, 0.5 * math.pi)
    rib = RibParameters(
        sliding,
        relative * radius - 0.5 * sliding,
        sphere,
        along,
        R_e,
        side_flow,
        p.rib_roughness,
        RIB_SHARE_B,
        RIB_SHARE_C,
        p.rib_friction,
        p.reduced_modulus,
    )
    return rib, 2.0 * sin_b * cos_b


@kernel
def rib_drag(motion: ShaftMotion, oil: LubricantState, p: BearingParameters) -> RibDrag:
    """Return the torques of the ribs, of the steel's hysteresis and of the oil on the rollers.

    Parameters
    ----------
    motion
        Of the shaft; its velocities play no part.
    oil
        At the inlet.
    p
        Either bearing; with a rib height or a contact angle of 0 there is no rib.

    Returns
    -------
    RibDrag
        Zero at rest.

    Notes
    -----
    Each roller end slides under its own load. The coefficient of friction is that of the mean load
    of the rollers in contact: it depends little on it, and is dear. The rib's torque carries the
    factor |w|/sqrt(w^2 + w0^2) with w0 = 1 rad/s, so that it passes through zero with the speed.
    Source: `rib_friction`, `hysteresis_power`, `liebrecht_drag`.
    """
    speed = abs(motion.speed)
    if speed == 0.0:
        return RibDrag(0.0, 0.0, 0.0)
    rollers = steady_rollers(motion, oil, p)
    R_inner, R_outer = line_radii(p)
    E = p.reduced_modulus
    ribbed = p.rib_height > 0.0 and p.sin_contact > 0.0  # else the contact is not read
    rib, share = rib_contact(p)
    on_rib = hysteresis = 0.0
    for bearing in range(2):
        total = 0.0
        loaded = 0
        for i in range(int(p.n_rollers)):
            load = steady_load(rollers, 1.0 - 2.0 * bearing, i, p)
            if load <= 0.0:
                continue
            total += load
            loaded += 1
            q = load / p.roller_length
            hysteresis += hysteresis_power(load, q, R_inner, E, p.film_speed_radius)
            hysteresis += hysteresis_power(load, q, R_outer, E, p.film_speed_radius)
        if ribbed and loaded > 0:
            end = rib_friction(rib, share * total / loaded, speed, oil)
            on_rib += end.coefficient * share * total * rib.sliding_ratio
    on_rib *= speed / math.sqrt(speed * speed + SMOOTHING_SPEED * SMOOTHING_SPEED)
    in_oil = 2.0 * liebrecht_drag(
        oil.eta0 / oil.nu,
        oil.nu,
        p.roller_length,
        2.0 * p.roller_radius,
        p.inner_radius + p.outer_radius,
        p.cage_ratio * speed / (2.0 * math.pi),
    )
    return RibDrag(on_rib, hysteresis, in_oil)
