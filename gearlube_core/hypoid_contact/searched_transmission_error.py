"""Unloaded transmission error by search: the least rotation of the pinion to contact.

A second method beside the path of contact. It compares no normals and includes edge contact.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.contact_rotations import contact_rotations
from gearlube_core.hypoid_contact.pair import FlankPair

_GRID = (9, 13)  # profile and face positions
_STENCIL = np.linspace(-1.0, 1.0, 3)
_FINE = np.linspace(-1.0, 1.0, 41)
_FIRST = np.array(
    [0.1, 0.06]
)  # of tooth height and face width: about the grid of first_contact_point
_SMALLEST = 1e-5
_SHRINK = 0.3
_ROUNDS = 40  # ten shrink to the smallest, the others travel


@dataclass(frozen=True, slots=True)
class FirstContactPoint:
    """The grid point of first contact, with the starting values of an exact search."""

    gear_angle: float  # rad
    gear_s: float
    gear_t: float
    gear_parameters: Array
    pinion_parameters: Array
    pinion_turn: float  # rad, about the work axis


def first_contact_point(pair: FlankPair, gear_angle: float) -> FirstContactPoint | None:
    """Return the first point of contact on a coarse grid of the gear flank, or None."""
    s, t = np.meshgrid(*(np.linspace(0.0, 1.0, k) for k in _GRID), indexing="ij")
    gear = pair.gear.parameters(s, t)
    reach = contact_rotations(pair, gear, np.array([gear_angle])).on_tooth()
    order = pair.touching_sign * reach.pinion_angle[0]
    if np.isnan(order).all():
        return None
    i, j = np.unravel_index(np.nanargmin(order), order.shape)
    return FirstContactPoint(
        gear_angle,
        float(s[i, j]),
        float(t[i, j]),
        gear[i, j],
        reach.pinion_parameters[0, i, j],
        pair.pinion_turn(float(reach.pinion_angle[0, i, j] - reach.by_correction[0, i, j])),
    )


class SearchedTransmissionError(NamedTuple):
    """First contact of one pair: error [rad], profile and face position on the gear [-], (N,).

    `pinion_parameters`, (N, 3), are u [m], th, ph [rad] of the pinion point.
    """

    error: Array
    s: Array
    t: Array
    pinion_parameters: Array


def searched_transmission_error(pair: FlankPair, gear_angles: Array) -> SearchedTransmissionError:
    """Return the first contact of one pair at gear angles (N,) [rad], by search.

    The extreme over the points of both teeth of the pinion angle at touch less teeth ratio times
    gear angle, found with parabolas through stencils of nine points that shrink about it. NaN
    where no flank point of the pinion reaches the gear flank: the pair is out of mesh.
    """
    found = np.array([_touch(pair, float(a)) for a in gear_angles]).reshape(-1, 6)
    return SearchedTransmissionError(found[:, 0], found[:, 1], found[:, 2], found[:, 3:])


def _touch(pair: FlankPair, angle: float) -> tuple[float, ...]:
    touch = first_contact_point(pair, angle)
    if touch is None:
        return (np.nan,) * 6
    x, size = np.array([touch.gear_s, touch.gear_t]), _FIRST
    start = np.array([*touch.pinion_parameters, touch.pinion_turn])
    error = np.nan
    for _ in range(_ROUNDS):
        x = np.clip(x, size, 1.0 - size)
        s, t = np.meshgrid(x[0] + size[0] * _STENCIL, x[1] + size[1] * _STENCIL, indexing="ij")
        found = contact_rotations(pair, pair.gear.parameters(s, t), np.array([angle]), start)
        if np.isnan(found.pinion_angle).any():
            size = _SHRINK * size  # part of the stencil lies where the pinion has no flank
            continue
        errors = found.pinion_angle[0] - pair.ratio * angle
        error = float(errors[1, 1])
        as_cut = found.pinion_angle[0, 1, 1] - found.by_correction[0, 1, 1]
        turn = pair.pinion_turn(float(as_cut))
        start = np.array([*found.pinion_parameters[0, 1, 1], turn])
        lowest = _lowest(pair.touching_sign * errors, found.pinion_s[0], found.pinion_t[0])
        # at the rim of the flank the extreme stays on the rim of the stencil
        x = x + lowest * size
        if not ((np.abs(lowest) > 0.9) & (x > 0.0) & (x < 1.0)).any():
            if size[0] < _SMALLEST:
                break
            size = _SHRINK * size
    return error, float(x[0]), float(x[1]), *map(float, start[:3])


def _lowest(height: Array, pinion_s: Array, pinion_t: Array) -> Array:
    """Return the lowest place of the parabola through 3 x 3 values, in steps of the stencil.

    Held to the stencil and, by parabolas through its positions, to the pinion tooth.
    """
    values = np.stack([height.ravel(), pinion_s.ravel(), pinion_t.ravel()], axis=1)
    c = np.linalg.lstsq(_terms(_STENCIL), values, rcond=None)[0]
    hessian = np.array([[2.0 * c[3, 0], c[4, 0]], [c[4, 0], 2.0 * c[5, 0]]])
    if np.linalg.det(hessian) > 0.0 and c[3, 0] > 0.0:
        vertex = np.linalg.solve(hessian, -c[1:3, 0])
        if (np.abs(vertex) <= 1.0).all() and _beyond_tooth(_row(*vertex) @ c[:, 1:]) <= 0.0:
            return np.asarray(vertex)
    fine = _terms(_FINE)
    model = fine @ c
    beyond = _beyond_tooth(model[:, 1:])
    if (beyond > 0.0).all():
        return np.asarray(fine[int(np.argmin(beyond)), 1:3])
    return np.asarray(fine[int(np.argmin(np.where(beyond > 0.0, np.inf, model[:, 0]))), 1:3])


def _beyond_tooth(places: Array) -> Array:
    """Return how far positions (..., 2) lie beyond the edges 0 and 1 [-]; not above 0 inside."""
    return np.asarray(np.maximum(-places, places - 1.0).max(axis=-1))


def _row(a: Array, b: Array) -> Array:
    return np.stack([np.ones_like(a), a, b, a * a, a * b, b * b], axis=-1)


def _terms(nodes: Array) -> Array:
    """Return the terms of a parabola on the grid of `nodes` (k,) in both directions, (k * k, 6)."""
    a, b = (q.ravel() for q in np.meshgrid(nodes, nodes, indexing="ij"))
    return _row(a, b)
