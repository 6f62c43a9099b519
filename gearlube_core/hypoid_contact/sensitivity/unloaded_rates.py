"""Rates of the ease-off and of the contact path with a setting or a placement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.contact_path import ContactPath, path_at
from gearlube_core.hypoid_contact.contact_point import UNKNOWN_STEPS, UNKNOWNS, linearise_contacts
from gearlube_core.hypoid_contact.contact_rotations import contact_rotations, rotations_to_points
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import placed_axis, placed_sample
from gearlube_core.hypoid_contact.sensitivity.parameter import Variations
from gearlube_core.hypoid_geometry.flank.surface_point import march

_ANGLE = 1e-5  # rad of the gear, for derivatives along the path
_PITCHES = np.arange(-30, 31) / 12.0  # gear angles between which the extreme is bracketed
_STEP = 1e-4  # rad of the gear
_LONGEST = 0.02
_CLOSED = 1e-11
_ITERATIONS = 20


@dataclass(frozen=True, slots=True)
class PathRates:
    """Derivatives of a path of contact at fixed gear angles, per unit of each parameter.

    Parameters
    ----------
    path : ContactPath
        N contacts.
    transmission_error : ndarray of shape (P, N)
        [rad/unit]; with what the zero of both members' angles moves.
    gear_s, gear_t, pinion_s, pinion_t : ndarray of shape (P, N)
        [1/unit]
    r : ndarray of shape (P, N, 3)
        Of the point of contact in the fixed frame [m/unit].
    lower, upper : tuple of ContactPath
        Of each parameter, the path to first order one step below and above its value.
    """

    path: ContactPath
    transmission_error: Array
    gear_s: Array
    gear_t: Array
    pinion_s: Array
    pinion_t: Array
    r: Array
    lower: tuple[ContactPath, ...]
    upper: tuple[ContactPath, ...]


def path_rates(variations: Variations, path: ContactPath) -> PathRates:
    """Return the derivatives of a path of contact by parameters.

    dF/dx dx/dp = -dF/dp

    F are the seven equations of tangency and x their unknowns. dF/dx is analytic and taken once;
    dF/dp comes from differences of the motions alone, nothing is searched again.

    Parameters
    ----------
    variations : Variations
        Of the path's pair.
    path : ContactPath

    Raises
    ------
    ParameterError
        When the flanks are corrected.

    References
    ----------
    [litvin_fuentes_2004 ch. 9.4] (equations of tangency).
    """
    variations.pair.check_uncorrected()
    angles = path.gear_angle
    lower, upper = moved_paths(
        path,
        [(pair, angles) for pair in variations.lower],
        [(pair, angles) for pair in variations.upper],
    )

    def rate(name: str) -> Array:
        return variations.difference(
            np.array([getattr(one, name) for one in lower]),
            np.array([getattr(one, name) for one in upper]),
        )

    return PathRates(
        path,
        rate("transmission_error"),
        rate("gear_s"),
        rate("gear_t"),
        rate("pinion_s"),
        rate("pinion_t"),
        rate("r"),
        tuple(lower),
        tuple(upper),
    )


def angle_rates(path: ContactPath) -> tuple[ContactPath, ContactPath, float]:
    """Return the path to first order at gear angles below and above, and their change [rad]."""
    angles = path.gear_angle
    lower, upper = moved_paths(path, [(path.pair, angles - _ANGLE)], [(path.pair, angles + _ANGLE)])
    return lower[0], upper[0], _ANGLE


def moved_paths(
    path: ContactPath,
    below: Sequence[tuple[FlankPair, Array]],
    above: Sequence[tuple[FlankPair, Array]],
) -> tuple[list[ContactPath], list[ContactPath]]:
    """Return the path to first order with pairs and gear angles moved down and up by a step.

    Parameters
    ----------
    path : ContactPath
        N contacts.
    below, above : sequence of (FlankPair, ndarray of shape (N,))
        P pairs and gear angles [rad].
    """
    x = np.concatenate(
        [
            path.gear_parameters,
            path.pinion_parameters,
            path.pair.pinion_turn(path.pinion_angle)[:, None],
        ],
        axis=1,
    )
    there = np.isfinite(x).all(axis=1)
    known = x[there]
    jacobian = _equations(path.pair, path.gear_angle[there], known)[..., :UNKNOWNS]
    right = np.stack(
        [
            (_equations(b, hi[there], known) - _equations(a, lo[there], known))[..., UNKNOWNS]
            for (a, lo), (b, hi) in zip(below, above, strict=True)
        ],
        axis=-1,
    )
    # half: `right` is the change over two steps
    moves = 0.5 * np.linalg.solve(jacobian, right) * np.array(UNKNOWN_STEPS)[:, None]
    lower, upper = [], []
    for k in range(len(below)):
        step = np.full_like(x, np.nan)
        step[there] = moves[..., k]
        lower.append(path_at(below[k][0], below[k][1], x - step))
        upper.append(path_at(above[k][0], above[k][1], x + step))
    return lower, upper


def _equations(pair: FlankPair, gear_angles: Array, x: Array) -> Array:
    rows = np.empty((x.shape[0], UNKNOWNS, UNKNOWNS + 1))
    linearise_contacts(
        pair.gear.motion,
        pair.pinion.motion,
        pair.gear_base,
        pair.pinion_base,
        pair.gear_turn(gear_angles),
        x,
        rows,
    )
    return rows


@dataclass(frozen=True, slots=True)
class EaseOffRates:
    """The ease-off and its derivatives, per unit of each of P parameters.

    Parameters
    ----------
    s, t : ndarray of shape (m,), (n,)
        Places on the gear flank [-].
    gap : ndarray of shape (m, n)
        As `EaseOff.normal_gap` [m]: zero at the tightest place; NaN where there is none.
    rate : ndarray of shape (P, m, n)
        [m/unit]
    """

    s: Array
    t: Array
    gap: Array
    rate: Array


@dataclass(frozen=True, slots=True)
class _Places:
    """Gear points and what the pinion does when each is on the conjugate flank, N of them."""

    gear: Array  # u, th, ph
    pinion: Array  # u, th, ph, rotation about the work axis
    angle: Array  # rad of the gear
    error: Array  # rad
    arm: Array  # R_p, m


def ease_off_rates(variations: Variations, s: Array, t: Array) -> EaseOffRates:
    """Return the ease-off at places (s, t) of the gear flank and its derivatives.

    With each setting a step lower and a step higher, the extreme of every place is corrected from
    the one known: two or three Newton steps in place of a search over all gear angles.

    Parameters
    ----------
    variations : Variations
    s, t : ndarray of shape (m,), (n,)
        Profile and face positions [-], both within 0 to 1.

    Raises
    ------
    ParameterError
        When the flanks are corrected.

    References
    ----------
    [stadtfeld_1993] (ease-off).
    """
    s, t = np.asarray(s, float), np.asarray(t, float)
    pair = variations.pair
    pair.check_uncorrected()
    places, known = _bracketed(pair, s, t)
    places = _extremes(pair, places)
    sign = pair.touching_sign
    height = sign * places.error
    tightest = int(np.nanargmin(height))

    def gap_of(there: _Places) -> Array:
        full = np.full(known.shape, np.nan)
        high = sign * there.error
        full[known] = (high - high[tightest]) * there.arm
        return full

    at_ends = [
        np.array([gap_of(_extremes(one, _on_gear(one, places, s, t, known))) for one in end])
        for end in (variations.lower, variations.upper)
    ]
    return EaseOffRates(s, t, gap_of(places), variations.difference(*at_ends))


def _bracketed(pair: FlankPair, s: Array, t: Array) -> tuple[_Places, NDArray[np.bool_]]:
    """Return the places near their extremes, and which places of the grid have one, (m, n)."""
    angles = _PITCHES * pair.gear_pitch
    gear = pair.gear.parameters(*np.meshgrid(s, t, indexing="ij"))
    found = contact_rotations(pair, gear, angles).on_tooth()
    error = pair.touching_sign * (found.pinion_angle - pair.ratio * angles[:, None, None])
    inner = error[1:-1]
    with np.errstate(invalid="ignore"):
        least = (inner <= error[:-2]) & (inner < error[2:])
    known = np.asarray(least.any(axis=0))
    k = 1 + np.argmax(least, axis=0)[known]
    i, j = np.nonzero(known)
    turn = pair.pinion_turn(found.pinion_angle[k, i, j])
    pinion = np.concatenate([found.pinion_parameters[k, i, j], turn[:, None]], axis=1)
    empty = np.full(k.size, np.nan)
    return _Places(gear[known], pinion, angles[k], empty, empty), known


def _on_gear(
    pair: FlankPair, places: _Places, s: Array, t: Array, known: NDArray[np.bool_]
) -> _Places:
    """Return the same places on the gear of another pair."""
    grid = np.stack(np.meshgrid(s, t, indexing="ij"), axis=-1)[known]
    gear = pair.gear
    found = march(gear.motion, *gear.region.section(grid[:, 0], grid[:, 1]), places.gear)
    return _Places(found, places.pinion, places.angle, places.error, places.arm)


def _extremes(pair: FlankPair, places: _Places) -> _Places:
    """Return the places at the gear angles at which their error is extreme: R_g = ratio R_p."""
    points = pair.gear.sample_parameters(places.gear).r
    pinion = places.pinion.copy()

    def meet(angles: Array) -> tuple[Array, Array]:
        """Return the mismatch of the arms [-] and R_p [m], (N,); `pinion` follows."""
        rotations_to_points(
            pair.pinion.motion,
            pair.pinion_base,
            pair.gear_base,
            points,
            pair.gear_turn(angles),
            pinion,
        )
        surface = placed_sample(pair.pinion, pair.pinion_base, pinion[:, 3], pinion[:, :3])
        axis_p, point_p = placed_axis(pair.pinion, pair.pinion_base)
        axis_g, point_g = placed_axis(pair.gear, pair.gear_base)
        normal = pair.touching_sign * surface.normal
        arm_p = np.einsum("ni,ni->n", np.cross(-axis_p, surface.r - point_p), normal)
        arm_g = np.einsum("ni,ni->n", np.cross(axis_g, surface.r - point_g), normal)
        return arm_g / arm_p - pair.ratio, arm_p

    before, here = places.angle, places.angle + _STEP
    slope_before, _ = meet(before)
    for _ in range(_ITERATIONS):
        slope, arm = meet(here)
        change = slope - slope_before
        move = np.divide(slope * (here - before), change, out=0.0 * here, where=change != 0.0)
        if np.nanmax(np.abs(move)) < _CLOSED:
            break
        before, here, slope_before = here, here - np.clip(move, -_LONGEST, _LONGEST), slope
    error = pair.pinion_angle(pinion[:, 3]) - pair.ratio * here
    return _Places(places.gear, pinion, here, np.asarray(error), arm)
