"""Ease-off of the gear flank: its gap to the conjugate flank of the pinion.

It needs no equation of tangency, only the rotation at which the pinion flank passes through each
point of the gear flank. The slopes at the mean point say whether the flanks are parallel there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.hypoid_contact.contact_rotations import contact_rotations
from gearlube_core.hypoid_contact.flank_intersection import HIT, intersect_rotation
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import (
    ALIGNED,
    pinion_placement,
    placed_axis,
    placed_sample,
)
from gearlube_core.hypoid_contact.searched_transmission_error import searched_transmission_error
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.cutting_motion import CutState, cut_state, unit_normal
from gearlube_core.hypoid_geometry.flank.machine_check import turn_to
from gearlube_core.hypoid_geometry.flank.machine_frames import ReferenceCut, reference_point
from gearlube_core.hypoid_geometry.flank.surface_point import CONVERGED, locate
from gearlube_core.hypoid_geometry.flank.vectors import Vector

_ITERATIONS = 12
_STEP = 1e-3  # rad of the gear
_LONGEST = 0.1
_CLOSED = 1e-5  # changes the slopes by less than a hundredth of a milliradian
MARKING_COMPOUND = 6.35e-6  # m, a quarter of a thousandth of an inch: customary in bevel gear tests


def mean_point_slopes(
    gear: ReferenceCut, pinion: ReferenceCut, blank: HypoidBlank
) -> tuple[float, float]:
    """Return the slopes of the gap to the conjugate flank at the mean point, (2,) [rad].

    The gear's mean point turns through the mesh, and the pinion with it so that its flank passes
    through the point. Where the velocities of both members along the pinion's normal are equal,
    the point comes nearest to the conjugate flank; the slopes are the components of the
    difference of both normals there.

    Parameters
    ----------
    gear, pinion : ReferenceCut
        Of mating flanks.
    blank : HypoidBlank

    Returns
    -------
    along, across : float
        Slope along the tooth and over its height [rad]; NaN where there is no such position.

    References
    ----------
    [litvin_fuentes_2004 ch. 6] (equation of meshing).
    """
    axis = blank.gear_axis
    state = _gear_state(gear, blank)
    start = turn_to(axis, np.array(state.r), blank, np.zeros(3))
    own = np.array([state.r, unit_normal(state), state.r_th])
    work, point = np.array(pinion.motion.work_axis), np.array(pinion.motion.work_point)
    base = pinion_placement(pinion.motion, ALIGNED)
    cut = cut_state(pinion.motion, 0.0, pinion.cutter_angle, pinion.cradle_angle)
    turn = turn_to(work, np.array(cut.r) - point, blank, point)
    unknowns = np.array([0.0, pinion.cutter_angle, pinion.cradle_angle, turn])

    def meet(angle: float) -> tuple[float, Array, Array]:
        """Return the difference of the normal velocities, the pinion's normal, the gear's data."""
        placed = Rotation.from_rotvec((start + angle) * axis).apply(own)
        r, n = placed[0], placed[1]
        if intersect_rotation(pinion.motion, base, Vector(*r.tolist()), unknowns) != HIT:
            return math.nan, n, placed
        mate = np.array(unit_normal(cut_state(pinion.motion, *unknowns[:3])))
        facing = Rotation.from_rotvec(unknowns[3] * work).apply(mate)
        facing *= math.copysign(1.0, float(facing @ n))
        velocity = np.cross(axis, r) - np.cross(blank.ratio * blank.pinion_axis, r - point)
        return float(facing @ velocity), facing, placed

    angles = [0.0, _STEP]
    speeds = [meet(angle)[0] for angle in angles]
    for _ in range(_ITERATIONS):
        if not (math.isfinite(speeds[1]) and speeds[1] != speeds[0]):
            return math.nan, math.nan
        step = speeds[1] * (angles[1] - angles[0]) / (speeds[0] - speeds[1])
        angles = [angles[1], angles[1] + max(-_LONGEST, min(_LONGEST, step))]
        speed, facing, (_, n, lengthwise) = meet(angles[1])
        speeds = [speeds[1], speed]
        if abs(step) < _CLOSED:
            lengthwise /= np.linalg.norm(lengthwise)
            across = np.cross(n, lengthwise)
            return float((facing - n) @ lengthwise), float((facing - n) @ across)
    return math.nan, math.nan


def _gear_state(gear: ReferenceCut, blank: HypoidBlank) -> CutState:
    """Return the gear's flank at the mean point's radius and axial position.

    A form-cut flank passes the blades' mean point, a generated one runs a little below it.
    """
    place = np.array([0.0, gear.cutter_angle, gear.cradle_angle])
    if gear.motion.generated:
        mean, axis = reference_point(blank), blank.gear_axis
        axial = float(mean @ axis)
        radius = float(np.linalg.norm(mean - axial * axis))
        if locate(gear.motion, radius, axial, place) != CONVERGED:
            place[:] = math.nan
    return cut_state(gear.motion, *place)


@dataclass(frozen=True, slots=True)
class EaseOff:
    """Rotation of the pinion to contact, over the gear flank and the gear angle.

    Parameters
    ----------
    pair : FlankPair
    s, t : ndarray of shape (m,), (n,)
        Profile (root 0, tip 1) and face (toe 0, heel 1) positions on the gear [-].
    gear_angle : ndarray of shape (K,)
        [rad], evenly spaced.
    error : ndarray of shape (K, m, n)
        Pinion angle at touch less teeth ratio times gear angle [rad]; NaN where the pinion tooth
        has no such point.
    error_rate : ndarray of shape (K, m, n)
        Its derivative by gear angle at fixed gear point [-].
    R_p : ndarray of shape (K, m, n)
        Arm of the pinion flank's normal about the pinion axis [m]: gap per unit rotation.
    """

    pair: FlankPair
    s: Array
    t: Array
    gear_angle: Array
    error: Array
    error_rate: Array
    R_p: Array

    def conjugate_error(self) -> Array:
        """Return the extreme over gear angle of the error at each gear point [rad], (m, n).

        The gear flank that is conjugate to the pinion passes through a gear point where this is
        constant. Cubic between angles; NaN where the extreme lies outside the angles.
        """
        return self._at_extreme()[0]

    def normal_gap(self) -> Array:
        """Return the ease-off: gap to the conjugate gear flank along the normal [m], (m, n).

        Zero where the pair is tightest, positive elsewhere.
        """
        error, R_p = self._at_extreme()
        height = self.pair.touching_sign * error
        return np.asarray((height - np.nanmin(height)) * R_p)

    def _at_extreme(self) -> tuple[Array, Array]:
        """Return error [rad] and R_p [m] where the error is extreme over gear angle."""
        sign = self.pair.touching_sign
        value, slope = sign * self.error, sign * self.error_rate
        with np.errstate(invalid="ignore"):
            turns = (slope[:-1] < 0.0) & (slope[1:] >= 0.0)
        k = np.argmax(turns, axis=0)
        i, j = np.indices(k.shape)
        step = float(self.gear_angle[1] - self.gear_angle[0])
        v0, v1 = value[k, i, j], value[k + 1, i, j]
        d0, d1 = step * slope[k, i, j], step * slope[k + 1, i, j]
        # slope of the cubic through both ends: d0 + b x + c x^2, root nearest the secant's
        b = 6.0 * (v1 - v0) - 4.0 * d0 - 2.0 * d1
        c = 3.0 * (d0 + d1) - 6.0 * (v1 - v0)
        root = np.sqrt(np.maximum(b * b - 4.0 * c * d0, 0.0))
        x = -2.0 * d0 / (b + np.copysign(root, b))
        extreme = v0 + x * (d0 + x * (0.5 * b + x * c / 3.0))
        R_p = (1.0 - x) * self.R_p[k, i, j] + x * self.R_p[k + 1, i, j]
        missing = ~turns.any(axis=0)
        extreme[missing] = np.nan
        R_p[missing] = np.nan
        return sign * extreme, R_p


def ease_off(
    pair: FlankPair, *, s_count: int = 31, t_count: int = 61, gear_angles: Array | None = None
) -> EaseOff:
    """Return the ease-off on an even grid of the gear flank.

    Parameters
    ----------
    pair : FlankPair
    s_count, t_count : int
        Points over the profile and over the face.
    gear_angles : ndarray of shape (K,), optional
        Evenly spaced [rad]; absent, two and a half pitches to each side, twelve a pitch.

    References
    ----------
    [stadtfeld_1993] (ease-off); [litvin_fuentes_2004 ch. 9] (tooth contact analysis).
    """
    check_within("s_count", s_count, 3, 1001, "", "Points over the profile.")
    check_within("t_count", t_count, 3, 1001, "", "Points over the face.")
    if gear_angles is None:
        gear_angles = np.arange(-30, 31) / 12.0 * pair.gear_pitch
    s, t = np.linspace(0.0, 1.0, s_count), np.linspace(0.0, 1.0, t_count)
    gear = pair.gear.parameters(*np.meshgrid(s, t, indexing="ij"))
    found = contact_rotations(pair, gear, gear_angles).on_tooth()
    shape = found.pinion_angle.shape
    surface = placed_sample(
        pair.pinion,
        pair.pinion_base,
        pair.pinion_turn(found.pinion_angle.ravel()),
        found.pinion_parameters.reshape(-1, 3),
    )
    axis_p, point_p = placed_axis(pair.pinion, pair.pinion_base)
    axis_g, point_g = placed_axis(pair.gear, pair.gear_base)
    normal = pair.touching_sign * surface.normal
    R_p = np.einsum("ni,ni->n", np.cross(-axis_p, surface.r - point_p), normal).reshape(shape)
    R_g = np.einsum("ni,ni->n", np.cross(axis_g, surface.r - point_g), normal).reshape(shape)
    error = found.pinion_angle - pair.ratio * gear_angles[:, None, None]
    rate = R_g / R_p - pair.ratio
    if pair.is_corrected:
        turned = np.gradient(found.by_correction, gear_angles, axis=0)
        rate += np.where(np.isfinite(turned), turned, 0.0)
    return EaseOff(pair, s, t, gear_angles, error, rate, R_p)


def closest_approach(ease: EaseOff) -> Array:
    """Return the least normal gap to each point of the gear flank during the mesh [m], (m, n).

    Every pair takes its turn and holds its neighbours apart. NaN where the pinion tooth never
    comes. Where the gap is below the thickness of a marking compound, the compound is wiped off.

    Parameters
    ----------
    ease : EaseOff
        Its gear angles divide the pitch evenly and span the mesh of a pair.

    References
    ----------
    [stadtfeld_1993] (unloaded contact pattern from the ease-off).
    """
    pair = ease.pair
    sign = pair.touching_sign
    leading = sign * searched_transmission_error(pair, ease.gear_angle).error
    leading[np.isnan(leading)] = np.inf
    leading = _envelope(leading, ease.gear_angle, pair.gear_pitch)
    with np.errstate(invalid="ignore"):
        gap = (sign * ease.error - leading[:, None, None]) * ease.R_p
    closest = np.where(np.isnan(gap), np.inf, gap).min(axis=0)
    return np.where(np.isinf(closest), np.nan, closest)


def _envelope(leading: Array, angle: Array, pitch: float) -> Array:
    """Return the minimum over a pair and its neighbours, whole pitches away."""
    shift = round(pitch / float(angle[1] - angle[0]))
    out = leading.copy()
    for k in range(shift, leading.size, shift):
        out[:-k] = np.minimum(out[:-k], leading[k:])
        out[k:] = np.minimum(out[k:], leading[:-k])
    return out
