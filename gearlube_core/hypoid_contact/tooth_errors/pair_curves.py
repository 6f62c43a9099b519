"""Torque of single tooth pairs against rotation, and what shifts them.

Tooth pairs share no compliance, so that an error of one tooth changes the load of the others
through the common rotation alone: each pair has a curve of its own, and errors shift it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.contact.unilateral import solve_rotation
from gearlube_core.contact.unilateral_problem import UnilateralSolution, tangent_forces
from gearlube_core.errors import ConvergenceError
from gearlube_core.hypoid_contact.gap_map import GapMap, closing_arm, gear_arm
from gearlube_core.hypoid_contact.loaded_contact import (
    LoadedSettings,
    MeshPosition,
    coupled_strip,
    pair_angles,
)
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.strips import Strip, cut_strip, strip_frame
from gearlube_core.hypoid_geometry.flank.flank import Role
from gearlube_core.hypoid_geometry.measured.tooth_errors import ToothErrors
from gearlube_core.storage.resumable import Record
from gearlube_core.tooth_contact.coupled_strips import PairStiffness, strips_problem

_HALVINGS = 60  # of the bracket of a rotation
_ROLES: tuple[Role, Role] = ("pinion", "gear")
SAMPLES = 10  # rotations of a curve beyond first touch
WIDE = 2.5  # half-width of a strip over that of Hertz' line contact
_WIDER, _ATTEMPTS = 1.6, 8
_ALONE = 2.2  # closing of a pair that carries all, over that of the mesh, at most
_TANGENT = 1e-3  # tolerance of the weights


class PairCurve:
    """Torque of one tooth pair by rotation, zero before first touch [N.m].

    Parameters
    ----------
    rotation, torque : ndarray of shape (K,)
        [rad], [N.m]; the first point is first touch.
    """

    def __init__(self, rotation: Array, torque: Array) -> None:
        self.first, self.last = float(rotation[0]), float(rotation[-1])
        # nearly straight in these: the torque grows a little faster than in proportion
        self._curve = PchipInterpolator(
            np.sqrt(rotation - self.first), np.sqrt(np.maximum.accumulate(torque))
        )

    def __call__(self, rotation: Array) -> Array:
        """Return the torque [N.m]; held beyond the last point."""
        place = np.clip(rotation - self.first, 0.0, self.last - self.first)
        return np.asarray(self._curve(np.sqrt(place)) ** 2)


@dataclass(frozen=True)
class TurnProblem:
    """One mesh phase and pinion torque with all its teeth.

    Parameters
    ----------
    pair : FlankPair
    phase : float
        [mesh periods]
    torque : float
        [N.m]
    curves : Record
        From `position_curves`.
    """

    pair: FlankPair
    phase: float
    torque: float
    curves: Record

    @property
    def pairs(self) -> NDArray[np.int_]:
        """Places of the pairs that touch."""
        return np.flatnonzero(np.isfinite(self.curves["rotation"][:, 0]))

    def rotation(self, shifts: Array) -> Array:
        """Return the rotation [rad] at which shifted pairs carry the torque, (M,).

        Parameters
        ----------
        shifts : ndarray of shape (M, J)
            By how much later each pair touches [rad].

        Raises
        ------
        ConvergenceError
            The pairs do not carry the torque within their curves.
        """
        pairs = self.pairs
        curves = [PairCurve(self.curves["rotation"][j], self.curves["torque"][j]) for j in pairs]

        def carried(rotation: Array) -> Array:
            return np.asarray(
                sum(c(rotation - shifts[:, j]) for c, j in zip(curves, pairs, strict=True))
            )

        low = np.min([c.first + shifts[:, j] for c, j in zip(curves, pairs, strict=True)], axis=0)
        high = np.min([c.last + shifts[:, j] for c, j in zip(curves, pairs, strict=True)], axis=0)
        if np.any(carried(high) < self.torque):
            raise ConvergenceError(
                f"teeth at mesh phase {self.phase:.3f} must carry {self.torque:g} N.m within the "
                "range of their curves, but they do not: errors of single teeth are too large "
                "compared with the deflection. Check their unit, or leave high torques out."
            )
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            below = carried(middle) < self.torque
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        return np.asarray(0.5 * (low + high))

    def means(self, name: str, rotation: float) -> Array:
        """Return a mean over each pair's contact at a rotation, (J, ...); NaN without contact."""
        found = np.full((self.curves[name].shape[0], *self.curves[name].shape[2:]), np.nan)
        for j in self.pairs:
            place = self.curves["rotation"][j]
            # the last sample before the rotation and the next one
            k = int(np.clip(np.searchsorted(place, rotation) - 1, 0, place.size - 2))
            share = float(np.clip((rotation - place[k]) / (place[k + 1] - place[k]), 0.0, 1.0))
            values = self.curves[name][j]
            found[j] = (1.0 - share) * values[k] + share * values[k + 1]
        return found

    def shifts(self, errors: ToothErrors, meshes: NDArray[np.int_]) -> Array:
        """Return by how much later each pair touches for its own teeth [rad], (M, J).

        Parameters
        ----------
        errors : ToothErrors
        meshes : ndarray of int, shape (M,)
            Mesh periods that have passed.
        """
        pair, side = self.pair, self.pair.side
        sign = pair.touching_sign
        count = self.curves["rotation"].shape[0]
        nominal = float(self.rotation(np.zeros((1, count)))[0])
        ratio = self.means("ratio", nominal)
        direction, moment = (np.nan_to_num(self.means(n, nominal)) for n in ("direction", "moment"))
        tooth = meshes[:, None] - (np.arange(count) - count // 2)
        found = np.zeros((meshes.size, count))
        turns = meshes + self.phase
        for role, teeth, scale in (
            ("pinion", pair.pinion.teeth, np.ones(count)),
            ("gear", pair.gear.teeth, -ratio),
        ):
            member = errors.of(role)  # type: ignore[arg-type]
            angle = 2.0 * math.pi * turns / teeth
            if side in member.pitch:
                found += sign * scale * member.pitch[side][tooth % teeth]
            if member.eccentricity or member.wobble:
                axis, lever = _axis_and_lever(pair, role)
                unit = lever / np.linalg.norm(lever)
                moved = member.eccentricity * _around(
                    role, axis, unit, angle - member.eccentricity_angle
                )
                opens = 1.0 if role == "pinion" else -1.0  # normals point to the pinion
                found += opens * moved @ direction.T
                tilt = member.wobble * np.cross(
                    _around(role, axis, unit, angle - member.wobble_angle), axis
                )
                found += opens * tilt @ (moment + np.cross(lever, direction)).T
            means = self.means(f"{role}_waves", nominal)
            for i, wave in enumerate(member.waves.get(side, ())):
                place = wave.waves * angle + wave.phase
                found -= wave.amplitude * (
                    np.cos(place)[:, None] * means[:, i, 0]
                    - np.sin(place)[:, None] * means[:, i, 1]
                )
        return np.asarray(np.nan_to_num(found))


def _axis_and_lever(pair: FlankPair, role: str) -> tuple[Array, Array]:
    """Return a member's axis, away from the crossing point, and the mean point from it [m]."""
    axis, origin = pair.pinion_axis_placed if role == "pinion" else (pair.gear.axis, np.zeros(3))
    lever = pair.mean_point - origin
    return axis, lever - (lever @ axis) * axis


def _around(role: str, axis: Array, unit: Array, angle: Array) -> Array:
    """Return a direction that turns with a member driven forward, (M, 3); `unit` at angle zero."""
    # drive turns the gear about +z and the pinion about -x
    turn = (-1.0 if role == "pinion" else 1.0) * angle
    return np.asarray(Rotation.from_rotvec(turn[:, None] * axis).apply(unit))


def position_curves(
    pair: FlankPair,
    phase: float,
    torque: float,
    span: float,
    counts: tuple[tuple[int, ...], tuple[int, ...]],
    beside: int,
    stiffness: PairStiffness,
    settings: LoadedSettings,
) -> Record:
    """Return the curves of all tooth pairs near contact at one mesh phase.

    Parameters
    ----------
    pair : FlankPair
    phase : float
        [mesh periods]
    torque : float
        Largest pinion torque of interest [N.m].
    span : float
        Largest difference of the shifts of two pairs [rad].
    counts : tuple of 2 tuples of int
        Waves a turn of pinion and of gear whose averages are wanted.
    beside : int
        Tooth pairs looked at before and after.
    stiffness : PairStiffness
    settings : LoadedSettings

    Returns
    -------
    Record
        J = 2 beside + 1 pairs, K = SAMPLES + 1 rotations, the first of them at first touch:
        rotation [rad], torque [N.m], ratio (R_g over R_p) [-], all (J, K); direction (J, K, 3),
        mean normal over the arm [1/m]; moment (J, K, 3), its moment about the mean point [-];
        pinion_waves, gear_waves (J, K, counts, 2), mean cosine and
        sine of waves over the arm [1/m]. NaN where a pair touches later. Means are weighted with
        the growth of the forces.

    Notes
    -----
    Curves end where a single pair carries about the torque, further on by `span`.
    """
    position = MeshPosition.at(pair, phase, beside)
    nominal = position.load(torque, stiffness, settings)
    top = _ALONE * (nominal.rotation - nominal.unloaded_rotation) + span
    end = nominal.unloaded_rotation + top
    shape = (2 * beside + 1, SAMPLES + 1)
    found = {
        "rotation": np.full(shape, np.nan),
        "torque": np.full(shape, np.nan),
        "ratio": np.full(shape, np.nan),
        "direction": np.full((*shape, 3), np.nan),
        "moment": np.full((*shape, 3), np.nan),
        "pinion_waves": np.full((*shape, len(counts[0]), 2), np.nan),
        "gear_waves": np.full((*shape, len(counts[1]), 2), np.nan),
    }
    for j, (one, gaps) in enumerate(zip(position.phases, position.maps, strict=True)):
        first = float(np.min(gaps.touching_rotation))
        if not first < end:
            continue
        samples = first + (end - first) * (np.arange(1, SAMPLES + 1) / SAMPLES) ** 2
        force = 0.0
        for k, rotation in enumerate(samples, 1):
            strip, solution, growth = _pair_at(
                position, one, gaps, float(rotation), force, stiffness, settings
            )
            if strip is None or solution is None:
                continue
            force = float(solution.forces.sum()) * ((k + 1) / k) ** 2.5  # about that of the next
            weight = growth / float(growth @ _flat(strip.arm, growth))
            turns = contact_turns(pair, strip.point, strip.normal)
            found["rotation"][j, k] = rotation
            found["torque"][j, k] = solution.torque
            found["ratio"][j, k] = weight @ _flat(strip.gear_arm, growth)
            found["direction"][j, k] = weight @ strip.normal.reshape(-1, 3)
            moment = np.cross(strip.point - pair.mean_point, strip.normal)
            found["moment"][j, k] = weight @ moment.reshape(-1, 3)
            for name, numbers, scale in (
                ("pinion_waves", counts[0], pair.ratio),
                ("gear_waves", counts[1], 1.0),
            ):
                for i, count in enumerate(numbers):
                    angle = count * scale * _flat(turns, growth)
                    found[name][j, k, i] = weight @ np.cos(angle), weight @ np.sin(angle)
        _begin(found, j, first)
    return found


def _begin(found: Record, j: int, first: float) -> None:
    """Write the first point of a curve, without load: means as in the next."""
    loaded = np.flatnonzero(found["torque"][j] > 0.0)
    if not loaded.size:
        return
    k = int(loaded[0])
    for values in found.values():
        values[j, :k] = values[j, k]
    found["torque"][j, :k] = 0.0
    found["rotation"][j, :k] = np.linspace(first, found["rotation"][j, k], k + 1)[:k]


def contact_turns(pair: FlankPair, point: Array, normal: Array) -> Array:
    """Return how much further the gear turns until points are in contact, teeth as nominal [rad].

    Waves that a machine's or a tool's turning cuts run along lines of equal value of this. The
    gear's normal arm does not change as the gear turns, the pinion's does: that they have the teeth
    ratio is the condition, here to first order in the turn.

    Parameters
    ----------
    pair : FlankPair
    point, normal : ndarray of shape (..., 3)
        Of the gear flank in the fixed frame [m] [-]; normals towards the pinion.
    """
    arm = closing_arm(pair, point, normal)
    # the change of arm = -n.(a x (r - o)) as r and n turn about the gear's axis
    axis, origin = pair.pinion_axis_placed
    turned_point, turned_normal = np.cross(pair.gear.axis, point), np.cross(pair.gear.axis, normal)
    lever = np.cross(pair.touching_sign * -axis, point - origin)
    rate = -np.einsum("...i,...i->...", turned_normal, lever) - np.einsum(
        "...i,...i->...", normal, np.cross(pair.touching_sign * -axis, turned_point)
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = (gear_arm(pair, point, normal) / pair.ratio - arm) / rate
    return np.where(np.isfinite(turn), turn, 0.0)


def _flat(values: Array, growth: Array) -> Array:
    """Return values of cells in a row, zero where nothing grows."""
    return np.where(growth > 0.0, values.ravel(), 0.0)


def _pair_at(
    position: MeshPosition,
    phase: float,
    gaps: GapMap,
    rotation: float,
    force: float,
    stiffness: PairStiffness,
    settings: LoadedSettings,
) -> tuple[Strip | None, UnilateralSolution | None, Array]:
    """Return strip, contact and its growth by rotation of one tooth pair; None without contact."""
    nothing = None, None, np.zeros(0)
    turned = replace(gaps, gap=gaps.gap - rotation * gaps.arm)
    frame = strip_frame(turned, 0.0)
    if frame is None:
        return nothing
    arm = float(np.nanmedian(np.abs(gaps.arm)))
    least = -float(np.min(turned.gap))
    force = max(force, 1e7 * least)  # N, a tenth of a tooth's stiffness, for the first width
    half = WIDE * position.hertz_half_width(frame, force, stiffness.contact_modulus)
    for _ in range(_ATTEMPTS):
        strip = cut_strip(
            position.pair, *pair_angles(position.pair, phase), frame, half, settings.strips
        )
        usable = strip.usable
        if not usable.any() or not (strip.gap[usable] < rotation * strip.arm[usable]).any():
            return nothing
        problem = strips_problem([coupled_strip(position.pair, strip, stiffness)], stiffness)
        solution = solve_rotation(problem, rotation, tolerance=settings.tolerance)
        forces = solution.forces.reshape(strip.gap.shape)
        if not (forces[[0, -1]] > 0.0).any():
            break
        half *= max(_WIDER, math.sqrt(min(float(forces.sum()) / force, 16.0)))
    if not solution.touching.any() or not arm > 0.0:
        return nothing
    return strip, solution, tangent_forces(problem, solution, tolerance=_TANGENT)
