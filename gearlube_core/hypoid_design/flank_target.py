"""Targets of a design for one flank, the gap that gives them, and its contact."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.ease_off import MARKING_COMPOUND
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.unloaded_error import coarse_path, contact_ratio, unloaded_error
from gearlube_core.hypoid_design.conjugate_flank import ConjugateFlank, conjugate_flank
from gearlube_core.hypoid_geometry.flank.flank import Flank, Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

_STEP = 2e-3  # of s and t
_ITERATIONS = 8
LEAST_TURN = math.radians(15.0)  # of the path from the lines of contact
_POSITIONS = 33
_PATH_STEP = 0.02  # of a pitch, for the direction of the path


@dataclass(frozen=True, slots=True, kw_only=True)
class FlankTarget:
    """Wanted contact of a pair of flanks without load.

    Parameters
    ----------
    s, t : float
        Profile and face position of the mean contact on the gear [-].
    error : float
        Peak to peak of the transmission error at the pinion [rad].
    length : float
        Length of the contact ellipse at a gap of 6.35 um [m].
    path_angle : float
        Of the path of contact on the gear flank, from the root line towards the heel, to the tip
        positive [rad], 0 to pi.
    """

    s: float
    t: float
    error: float
    length: float
    path_angle: float


@dataclass(frozen=True, slots=True)
class MeanContact:
    """Geometry of the mesh at the design point, on the conjugate pinion flank.

    Parameters
    ----------
    r, e1, e2 : ndarray of shape (3,)
        The point [m]; unit tangents along the growing gear angle and along the line of contact.
    gear_angle : float
        At which the point is in contact [rad].
    slope : float
        |grad phi|, gear angle over the way along e1 [rad/m].
    arm : float
        Closing of the gap per pinion rotation [m].
    to_gear : ndarray of shape (2, 2)
        Steps on the gear flank, towards the heel and the tip, per step along e1 and e2 [-].
    to_places : ndarray of shape (2, 2)
        Steps of s and t per step along e1 and e2 [1/m].
    """

    r: Array
    e1: Array
    e2: Array
    gear_angle: float
    slope: float
    arm: float
    to_gear: Array
    to_places: Array

    @classmethod
    def at(cls, pair: FlankPair, s: float, t: float) -> MeanContact:
        """Return the geometry where the place (s, t) of the gear flank is in contact.

        Raises
        ------
        ParameterError
            When the place has no conjugate point.
        """
        h = _STEP
        around = np.array([[s, t], [s + h, t], [s - h, t], [s, t + h], [s, t - h]])
        flank = conjugate_flank(pair, around[:, 0], around[:, 1])
        if np.isnan(flank.gear_angle).any():
            raise ParameterError(
                f"The wanted contact at profile position {s:.2f}, face position {t:.2f} of the "
                f"gear's {pair.side} flank is never in mesh. Choose a place nearer to mid-flank."
            )
        own = pair.gear.sample(around[:, 0], around[:, 1]).r
        c_s, g_s = ((x[1] - x[2]) / (2.0 * h) for x in (flank.r, own))
        c_t, g_t = ((x[3] - x[4]) / (2.0 * h) for x in (flank.r, own))
        angle = flank.gear_angle
        slopes = np.array([angle[1] - angle[2], angle[3] - angle[4]]) / (2.0 * h)
        steps = np.stack([c_s, c_t], axis=1)  # (3, 2), per unit of s and t
        gradient = steps @ np.linalg.solve(steps.T @ steps, slopes)
        size = float(np.linalg.norm(gradient))
        e1 = gradient / size
        e2 = np.cross(flank.normal[0], e1)
        places = np.linalg.lstsq(steps, np.stack([e1, e2], axis=1), rcond=None)[0]
        ways = np.stack([g_s, g_t], axis=1) @ places  # (3, 2), on the gear
        heel, tip = _directions(g_s, g_t)
        return cls(
            flank.r[0],
            e1,
            e2,
            float(angle[0]),
            size,
            float(flank.arm[0]),
            np.stack([heel, tip]) @ ways,
            places,
        )

    @property
    def line_angle(self) -> float:
        """Direction of the line of contact on the gear flank, as path angles count [rad]."""
        along, up = self.to_gear[:, 1]
        return math.atan2(up, along) % math.pi

    def turn(self, path_angle: float) -> float:
        """Return tan(eta) of a path angle [rad]: its way along the line of contact over e1.

        Raises
        ------
        ParameterError
            When the path would lie along the lines of contact.
        """
        direction = np.array([math.cos(path_angle), math.sin(path_angle)])
        e1, e2 = np.linalg.solve(self.to_gear, direction)
        if abs(e1) < math.tan(LEAST_TURN) * abs(e2):
            low = math.degrees(self.line_angle)
            raise ParameterError(
                f"path_angle_deg must be at least {math.degrees(LEAST_TURN):g} deg away from the "
                f"lines of contact, which lie at {low:.0f} deg on this flank, got "
                f"{math.degrees(path_angle):.0f} deg. Choose a path nearer to "
                f"{(low + 90.0) % 180.0:.0f} deg."
            )
        return float(e2 / e1)

    def path_angle(self, turn: float) -> float:
        """Return the path angle [rad] whose tan(eta) is `turn`."""
        along, up = self.to_gear @ np.array([1.0, turn])
        return math.atan2(up, along) % math.pi


def flank_steps(flank: Flank, s: float, t: float) -> tuple[Array, Array]:
    """Return the unit tangents of a flank at (s, t): to the heel along the root, and to the tip."""
    h = _STEP
    r = flank.sample(np.array([s + h, s - h, s, s]), np.array([t, t, t + h, t - h])).r
    return _directions(r[0] - r[1], r[2] - r[3])


def _directions(by_s: Array, by_t: Array) -> tuple[Array, Array]:
    heel = by_t / np.linalg.norm(by_t)
    tip = by_s - (by_s @ heel) * heel
    return heel, tip / np.linalg.norm(tip)


def target_gap(
    target: FlankTarget, mean: MeanContact, flank: ConjugateFlank, gear_teeth: int
) -> Array:
    """Return the gap [m] to the conjugate flank that gives what is asked, shape of the flank.

    Along each line of contact it rises as a parabola from the path, delta = (x / b)^2 6.35 um at
    the ellipse's half length b, and along the path as a parabolic transmission error rises,
    R_p error (phi / (pi / z_2))^2.

    References
    ----------
    [litvin_fuentes_2004 ch. 9.5] (local synthesis: the same three numbers at the mean point).
    """
    way = (flank.gear_angle - mean.gear_angle) / mean.slope
    across = (flank.r - mean.r) @ mean.e2 - mean.turn(target.path_angle) * way
    bulge = MARKING_COMPOUND * (across / (0.5 * target.length)) ** 2
    handover = math.pi / gear_teeth
    error = target.error * ((flank.gear_angle - mean.gear_angle) / handover) ** 2
    return np.asarray(flank.arm * (bulge / mean.arm + error))


def path_places(
    pair: FlankPair, target: FlankTarget, mean: MeanContact, gear_angles: Array
) -> tuple[Array, Array]:
    """Return s and t [-] on the gear where the wanted path is, at gear angles (n,) [rad].

    The angles count from the mean contact. Newton's method from the tangents at the mean contact.
    """
    turn = mean.turn(target.path_angle)
    way = gear_angles / mean.slope
    direction = mean.to_places @ np.array([1.0, turn])
    places = np.array([target.s, target.t]) + way[:, None] * direction
    inverse = mean.to_places @ np.array([[1.0, 0.0], [turn, 1.0]])
    for _ in range(_ITERATIONS):
        flank = conjugate_flank(pair, places[:, 0], places[:, 1])
        past = (flank.gear_angle - mean.gear_angle) / mean.slope
        off = (flank.r - mean.r) @ mean.e2 - turn * past
        places = places - np.stack([past - way, off], axis=1) @ inverse.T
    return places[:, 0], places[:, 1]


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredContact:
    """Unloaded contact of one side, at the extreme of its transmission error.

    Parameters
    ----------
    s, t : float
        Profile and face position on the gear [-].
    error : float
        Peak to peak of the transmission error at the pinion [rad].
    length : float
        Of the contact ellipse at a gap of 6.35 um [m].
    path_angle : float
        Of the path of contact on the gear flank, as targets count it [rad].
    contact_ratio : float
        Pitches over which the path lies on both teeth [-].
    """

    s: float
    t: float
    error: float
    length: float
    path_angle: float
    contact_ratio: float


def measured_contact(file: HypoidGearFile, side: Side) -> MeasuredContact | str:
    """Return the contact of one side of a gear file, or why it has no parabolic error."""
    try:
        pair = FlankPair.from_file(file, side)
        coarse = coarse_path(pair)
        error = unloaded_error(pair, _POSITIONS, coarse)
        angles = error.extreme_angle + np.array([-_PATH_STEP, 0.0, _PATH_STEP]) * pair.gear_pitch
        path = contact_path(pair, angles)
        ratio = contact_ratio(pair, coarse)
    except ParameterError as reason:
        return str(reason)
    s, t = float(path.gear_s[1]), float(path.gear_t[1])
    middle = int(np.argmin(np.abs(error.gear_angle - error.extreme_angle)))
    radius = float(error.kinematics.R_y[middle])
    heel, tip = flank_steps(pair.gear, s, t)
    own = pair.gear.sample(path.gear_s, path.gear_t).r
    way = own[2] - own[0]
    return MeasuredContact(
        s=s,
        t=t,
        error=float(np.ptp(error.angular)),
        length=2.0 * math.sqrt(2.0 * MARKING_COMPOUND * radius) if radius > 0.0 else math.inf,
        path_angle=math.atan2(float(way @ tip), float(way @ heel)) % math.pi,
        contact_ratio=ratio,
    )
