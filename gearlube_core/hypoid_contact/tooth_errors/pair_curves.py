"""Torque of single tooth pairs against rotation, and what shifts them.

Tooth pairs share no compliance, so that an error of one tooth changes the load of the others
through the common rotation alone: each pair has a curve of its own, and errors shift it.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.unilateral import solve_rotation
from gearlube_core.contact.unilateral_problem import UnilateralSolution
from gearlube_core.contact.unilateral_stiffness import tangent_forces
from gearlube_core.hypoid_contact.gap_map import GapMap, closing_arm, gear_arm
from gearlube_core.hypoid_contact.loaded_contact import (
    LoadedSettings,
    MeshPosition,
    coupled_strip,
    pair_angles,
)
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.strips import Strip, cut_strip, strip_frame
from gearlube_core.storage.result_store import Record
from gearlube_core.tooth_contact.coupled_strips import PairStiffness, strips_problem

SAMPLES = 10  # rotations of a curve beyond first touch
WIDE = 2.5  # half-width of a strip over that of Hertz' line contact
_WIDER, _ATTEMPTS = 1.6, 8
_ALONE = 2.2  # closing of a pair that carries all, over that of the mesh, at most
_TANGENT = 1e-3  # tolerance of the weights


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
