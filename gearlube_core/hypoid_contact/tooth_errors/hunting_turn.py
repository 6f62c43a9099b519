"""Rotation of a loaded pair, tooth by tooth, over the turn after which the same teeth meet."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.errors import ConvergenceError
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.flank.flank import Role
from gearlube_core.hypoid_geometry.measured.tooth_errors import ToothErrors
from gearlube_core.storage.result_store import Record

_HALVINGS = 60  # of the bracket of a rotation
_ROLES: tuple[Role, Role] = ("pinion", "gear")


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
