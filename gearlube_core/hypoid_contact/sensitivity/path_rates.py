"""Derivatives of the unloaded path of contact by settings and misalignments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.contact_path import ContactPath, path_at
from gearlube_core.hypoid_contact.contact_point import (
    UNKNOWN_STEPS,
    UNKNOWNS,
    linearise_contacts,
)
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.sensitivity.variations import Variations

_ANGLE = 1e-5  # rad of the gear, for derivatives along the path


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
    lower, upper = moved_paths(
        path,
        [(path.pair, angles - _ANGLE)],
        [(path.pair, angles + _ANGLE)],
    )
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
