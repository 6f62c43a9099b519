"""Path of contact of a pair of flanks without load, from the equations of tangency."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_point import (
    TOUCHING,
    UNKNOWNS,
    find_contact,
    trace_contact,
)
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import placed_sample, tooth_position
from gearlube_core.hypoid_contact.searched_transmission_error import (
    FirstContactPoint,
    first_contact_point,
    searched_transmission_error,
)

_LONGEST_STEP = 0.125  # of a pitch, between solutions that start from one another
_DIFFERENCE = 1e-3  # of a pitch: errors of both difference and rounding below 1e-8 m
_AT_EDGE = 1e-3  # of tooth height or face width: a search ends so far from an edge at most
_TRIED = (0.0, -0.25, 0.25, -0.5, 0.5)  # gear angles [pitches] tried for a first contact


@dataclass(frozen=True, slots=True)
class ContactPath:
    """Points of contact of one tooth pair, one per position; NaN without contact.

    Parameters
    ----------
    pair : FlankPair
    gear_angle, pinion_angle : ndarray of shape (N,)
        [rad], in the drive direction.
    gear_parameters, pinion_parameters : ndarray of shape (N, 3)
        u [m], th, ph [rad] of the touching points.
    r, normal : ndarray of shape (N, 3)
        Point [m] and unit normal out of the pinion tooth [-], in the fixed frame.
    gear_s, gear_t, pinion_s, pinion_t : ndarray of shape (N,)
        Profile (root 0, tip 1) and face (toe 0, heel 1) positions [-]. The surfaces reach beyond
        the teeth; `inside` is true where both teeth are.
    pinion_regularity : ndarray of shape (N,)
        Not positive beyond a fold of the pinion surface (undercut) [-].
    """

    pair: FlankPair
    gear_angle: Array
    pinion_angle: Array
    gear_parameters: Array
    pinion_parameters: Array
    r: Array
    normal: Array
    gear_s: Array
    gear_t: Array
    pinion_s: Array
    pinion_t: Array
    pinion_regularity: Array

    @property
    def transmission_error(self) -> Array:
        """Pinion angle less teeth ratio times gear angle [rad], (N,): the gear lags."""
        return self.pinion_angle - self.pair.ratio * self.gear_angle

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Whether the point lies on both teeth, and not beyond a fold, (N,)."""
        places = np.stack([self.gear_s, self.gear_t, self.pinion_s, self.pinion_t])
        on_teeth = ((places >= 0.0) & (places <= 1.0)).all(axis=0)
        return np.asarray(on_teeth & (self.pinion_regularity > 0.0))


def contact_path(pair: FlankPair, gear_angles: Array) -> ContactPath:
    """Return the points of contact at the gear angles (N,) [rad], in any order.

    Raises
    ------
    ParameterError
        When the flanks touch in no point of both teeth near the middle of the mesh: they meet at
        an edge. The message says where, and what would bring the contact back.

    Notes
    -----
    Of corrected flanks the points are found by `searched_transmission_error`, without equations of
    tangency; where they meet at an edge of a tooth there is no contact in this sense.

    References
    ----------
    [litvin_fuentes_2004 ch. 9.4].
    """
    gear_angles = np.asarray(gear_angles, float)
    if pair.is_corrected:
        return _searched_path(pair, gear_angles)
    start_angle, start = _first_contact(pair)
    found = np.full((gear_angles.size, UNKNOWNS), np.nan)
    order = np.argsort(gear_angles, kind="stable")
    after = order[gear_angles[order] >= start_angle]
    before = order[gear_angles[order] < start_angle][::-1]
    for way in (after, before):
        part = np.full((way.size, UNKNOWNS), np.nan)
        trace_contact(
            pair.gear.motion,
            pair.pinion.motion,
            pair.gear_base,
            pair.pinion_base,
            _facing(pair),
            pair.gear_turn(gear_angles[way]),
            _LONGEST_STEP * pair.gear_pitch,
            pair.gear_turn(start_angle),
            start.copy(),
            part,
            np.empty((UNKNOWNS, UNKNOWNS + 1)),
        )
        found[way] = part
    return path_at(pair, gear_angles, found)


def contact_migration(path: ContactPath) -> Array:
    """Return the velocity of the point of contact in the fixed frame, per unit pinion speed [m].

    Shape (N, 3), by central differences of exact contacts. Surface velocities are those of the
    bodies' points; relative to the moving contact they are smaller or larger by this.
    """
    step = _DIFFERENCE * path.pair.gear_pitch
    after = contact_path(path.pair, path.gear_angle + step)
    before = contact_path(path.pair, path.gear_angle - step)
    return np.asarray((after.r - before.r) / (after.pinion_angle - before.pinion_angle)[:, None])


def path_at(pair: FlankPair, gear_angles: Array, found: Array) -> ContactPath:
    """Return the path through known contacts.

    Parameters
    ----------
    pair : FlankPair
    gear_angles : ndarray of shape (N,)
        [rad]
    found : ndarray of shape (N, 7)
        Unknowns of `find_contact` there; NaN without contact.
    """
    gear, pinion = found[:, :3], found[:, 3:6]
    surface = placed_sample(pair.pinion, pair.pinion_base, found[:, 6], pinion)
    return ContactPath(
        pair,
        gear_angles,
        pair.pinion_angle(found[:, 6]),
        gear,
        pinion,
        surface.r,
        surface.normal,
        *tooth_position(pair.gear, pair.gear.sample_parameters(gear).r),
        *tooth_position(pair.pinion, pair.pinion.sample_parameters(pinion).r),
        surface.regularity,
    )


def _searched_path(pair: FlankPair, gear_angles: Array) -> ContactPath:
    """Return the path of corrected flanks: what touches first, away from the edges."""
    found = searched_transmission_error(pair, gear_angles)
    gear = np.full((gear_angles.size, 3), np.nan)
    some = np.isfinite(found.error)
    gear[some] = pair.gear.parameters(found.s[some], found.t[some])
    pinion = found.pinion_parameters
    own = pair.pinion.sample_parameters(pinion).r
    places = np.stack([found.s, found.t, *tooth_position(pair.pinion, own)])
    edge = ~(np.minimum(places, 1.0 - places).min(axis=0) > _AT_EDGE)
    angle = np.where(edge, np.nan, pair.ratio * gear_angles + found.error)
    gear[edge] = np.nan
    unknowns = np.column_stack([gear, pinion, pair.pinion_turn(angle)])
    unknowns[edge] = np.nan
    return path_at(pair, gear_angles, unknowns)


def _facing(pair: FlankPair) -> float:
    return -pair.gear.outward * pair.pinion.outward


def _first_contact(pair: FlankPair) -> tuple[float, Array]:
    """Return a gear angle [rad] and the seven unknowns there, for a contact on both teeth."""
    nearest: FirstContactPoint | None = None
    for pitches in _TRIED:
        angle = pitches * pair.gear_pitch
        touch = first_contact_point(pair, angle)
        if touch is None:
            continue
        nearest = nearest or touch
        x = np.concatenate([touch.gear_parameters, touch.pinion_parameters, [touch.pinion_turn]])
        status = find_contact(
            pair.gear.motion,
            pair.pinion.motion,
            pair.gear_placed(angle),
            pair.pinion_base,
            _facing(pair),
            x,
            np.empty((UNKNOWNS, UNKNOWNS + 1)),
        )
        if status == TOUCHING and path_at(pair, np.array([angle]), x[None]).inside[0]:
            return angle, x
    where = (
        "no point of the gear flank is reached by the pinion flank"
        if nearest is None
        else f"at gear angle {nearest.gear_angle:.3g} rad the teeth meet first at the edge, near "
        f"profile position s = {nearest.gear_s:.2f}, face position t = {nearest.gear_t:.2f} of "
        "the gear (root 0, tip 1; toe 0, heel 1)"
    )
    raise ParameterError(
        f"The {pair.side} flanks must touch in a point of both teeth within half a pitch of the "
        f"mean point; {where}. Check the blade angles and their corrections (flank angle), the "
        "blade edge radii (a straight edge leaves no profile crown) and the misalignment."
    )
