"""Unloaded transmission error of the meshing gears, with handover between tooth pairs."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import ContactKinematics, path_kinematics
from gearlube_core.hypoid_contact.contact_path import ContactPath, contact_path
from gearlube_core.hypoid_contact.pair import FlankPair

_REACH = 2.5  # pitches to each side in which a pair is followed
_SCAN = 32  # positions a pitch of the coarse path


@dataclass(frozen=True, slots=True)
class UnloadedError:
    """Transmission error over one mesh period, from handover to handover.

    The error is the pinion angle less teeth ratio times gear angle (the gear lags), counted from
    the extreme of a single pair: positive on drive flanks, negative on coast flanks.

    Parameters
    ----------
    path : ContactPath
        The contacts of the touching pair, N even positions of the gear over a period, first and
        last at the handovers.
    kinematics : ContactKinematics
        There.
    extreme_angle : float
        Gear angle [rad] at which a pair's error is extreme.
    extreme_error : float
        Error [rad] there, from which the others count.
    """

    path: ContactPath
    kinematics: ContactKinematics
    extreme_angle: float
    extreme_error: float

    @property
    def gear_angle(self) -> Array:
        """Gear angle [rad], (N,)."""
        return self.path.gear_angle

    @property
    def pinion_angle(self) -> Array:
        """Pinion angle [rad], (N,); spans one pitch of the pinion."""
        return self.path.pinion_angle

    @property
    def angular(self) -> Array:
        """Error as pinion angle [rad], (N,)."""
        return self.path.transmission_error - self.extreme_error

    @property
    def linear(self) -> Array:
        """Error along the line of action [m], (N,): the angular one times the mean R_p.

        One arm for the whole period keeps it continuous: R_p itself jumps where pairs hand over.
        """
        return float(self.kinematics.R_p.mean()) * self.angular

    @property
    def mean(self) -> float:
        """Mean of the linear error over a mesh period [m]."""
        return float(np.trapezoid(self.linear, self.gear_angle) / np.ptp(self.gear_angle))


def unloaded_error(
    pair: FlankPair, count: int = 65, coarse: ContactPath | None = None
) -> UnloadedError:
    """Return the unloaded transmission error over a mesh period, `count` positions.

    The pair that the pinion closes first touches: the smallest error on drive flanks, the largest
    on coast flanks. `coarse` is the `coarse_path` of the pair, where it is known.

    Raises
    ------
    ParameterError
        When a pair leaves its teeth before the next takes over: the teeth then meet at edges and
        the error is a sawtooth; searched_transmission_error gives it. Also of corrected flanks,
        where a path that is searched ends at an edge within a pitch of the extreme.

    References
    ----------
    [litvin_fuentes_2004 ch. 9.2] (transmission errors of parabolic type).
    """
    check_within("count", count, 3, 100_001, "", "Positions over the mesh period.")
    extreme, error = _extreme(coarse_path(pair) if coarse is None else coarse)

    def difference(angle: float) -> float:
        two = contact_path(pair, np.array([angle, angle + pair.gear_pitch])).transmission_error
        return float(two[1] - two[0])

    ends = extreme - pair.gear_pitch, extreme
    handover = _zero(difference, ends, 1e-13)
    if handover is None:
        raise _edge_error(pair, "has no place where two neighbouring pairs hand over")
    path = contact_path(pair, handover + np.linspace(0.0, 1.0, count) * pair.gear_pitch)
    if not path.inside.all():
        raise _edge_error(pair, "leaves the teeth before the next pair takes over")
    return UnloadedError(path, path_kinematics(path), extreme, error)


def _zero(
    function: Callable[[float], float], ends: tuple[float, float], xtol: float
) -> float | None:
    """Return a zero between two places; None without, and where the path is lost on the way."""
    if not function(ends[0]) * function(ends[1]) < 0.0:
        return None
    try:
        return float(brentq(function, *ends, xtol=xtol))
    except ValueError:  # a NaN: no contact there
        return None


def contact_ratio(pair: FlankPair, coarse: ContactPath | None = None) -> float:
    """Return the pitches [-] over which the unloaded path of contact lies on both teeth.

    So many pairs have an open path at a time, on average; without load one of them touches, unless
    two errors happen to be equal. `coarse` is the `coarse_path` of the pair, where it is known.
    """
    entry, leaving = path_ends(pair, coarse)
    return (leaving - entry) / pair.gear_pitch


def path_ends(pair: FlankPair, coarse: ContactPath | None = None) -> tuple[float, float]:
    """Return the gear angles [rad] between which the unloaded path of contact is on both teeth."""
    path = coarse_path(pair) if coarse is None else coarse
    margin = _margin(path)
    inside = margin >= 0.0
    middle = int(np.argmax(np.where(np.isnan(margin), -np.inf, margin)))
    ends = []
    for way in (-1, 1):
        k = middle
        while 0 <= k + way < margin.size and inside[k + way]:
            k += way
        ends.append(_edge_angle(pair, path.gear_angle[k], path.gear_angle[k] + way * _step(pair)))
    return ends[0], ends[1]


def _edge_angle(pair: FlankPair, inner: float, outer: float) -> float:
    """Return the gear angle [rad] at which the path crosses a tooth's edge.

    `inner` where the flank itself ends there, or where a path of its own, without the neighbours
    that the search of a whole path starts from, is not found on the teeth.
    """

    def margin(angle: float) -> float:
        found = float(_margin(contact_path(pair, np.array([angle])))[0])
        return -1.0 if math.isnan(found) else found

    alone = float(_margin(contact_path(pair, np.array([outer])))[0])
    if not alone < 0.0 <= margin(inner):
        return inner
    return float(brentq(margin, inner, outer, xtol=1e-12))


def _margin(path: ContactPath) -> Array:
    """Return the distance from the nearest edge of either tooth in tooth heights or face widths."""
    places = np.stack([path.gear_s, path.gear_t, path.pinion_s, path.pinion_t])
    return np.asarray(np.minimum(places, 1.0 - places).min(axis=0))


def _step(pair: FlankPair) -> float:
    return pair.gear_pitch / _SCAN


def coarse_path(pair: FlankPair) -> ContactPath:
    """Return the unloaded path of contact over all positions in which a pair can be in mesh."""
    count = int(2 * _REACH * _SCAN) + 1
    return contact_path(pair, np.linspace(-_REACH, _REACH, count) * pair.gear_pitch)


def _extreme(path: ContactPath) -> tuple[float, float]:
    """Return gear angle and error [rad] where the ratio of the radii is that of the teeth."""
    pair = path.pair

    def mismatch(angle: float) -> float:
        k = path_kinematics(contact_path(pair, np.array([angle])))
        return float(k.R_g[0] - pair.ratio * k.R_p[0])

    order = np.where(path.inside, pair.touching_sign * path.transmission_error, np.inf)
    lowest = float(path.gear_angle[int(np.argmin(order))])
    ends = lowest - _step(pair), lowest + _step(pair)
    angle = _zero(mismatch, ends, 1e-14)
    if angle is None:
        raise _edge_error(pair, "has no extreme of the transmission error on the teeth")
    return angle, float(contact_path(pair, np.array([angle])).transmission_error[0])


def _edge_error(pair: FlankPair, what: str) -> ParameterError:
    return ParameterError(
        f"The path of contact of the {pair.side} flanks {what}: the teeth meet at edges and the "
        "transmission error is a sawtooth (searched_transmission_error finds it). Check the flank "
        "angle corrections, the blade edge radii and the misalignment."
    )
