"""Contact of one tooth pair from a mesh table, with vectors in the axes of its ellipse."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.mesh_table.kernels import LoadBracket, load_bracket
from gearlube_core.mesh_table.sliding_direction import pair_sliding_direction
from gearlube_core.mesh_table.table import PAIRS, MeshTable

_MIDDLE = 0.5 * PAIRS  # of a pair's window [mesh periods]


class PairContact(NamedTuple):
    """Contact of one pair at N phases, per unit pinion speed.

    x is the minor axis of the contact ellipse, y its major one, both turned so that entrainment
    points to larger x and y.
    """

    share: Array  # of the mesh force [-], (N,)
    R_x: Array  # relative radii [m], (N,)
    R_y: Array
    entrainment: Array  # mean surface velocity over pinion speed [m], (N, 2)
    sliding: Array  # of the pinion's surface over the gear's, over pinion speed [m], (N, 2)


def phase_of(table: MeshTable, angle: Array, pair: int = 0) -> Array:
    """Return the phase of a pair at pinion angles [rad]: mesh periods from its window's middle."""
    turned = table.pinion_teeth * np.asarray(angle) / (2.0 * np.pi) + pair
    return np.asarray(turned % PAIRS - _MIDDLE)


def pair_contact(table: MeshTable, torque: float, phase: Array) -> PairContact:
    """Return the contact of a pair, interpolated linearly in load and phase as the axle does.

    Parameters
    ----------
    table
        Of the gear pair.
    torque
        On the pinion, its sign chooses the flank [N m].
    phase : ndarray, shape (N,)
        Mesh periods from the middle of the pair's window.
    """
    bracket = load_bracket(abs(torque), float(np.sign(torque)), table.torque, table.torque.size)
    levels = [_at_level(table, level) for level in (bracket.lower, bracket.upper)]
    position = (np.asarray(phase, dtype=np.float64) + _MIDDLE) % PAIRS / PAIRS * table.nodes
    node = np.minimum(position.astype(int), table.nodes - 1)
    after, weight = (node + 1) % table.nodes, position - node

    def blended(lower: Array, upper: Array) -> Array:
        values = _blend(lower, upper, bracket)
        t = weight if values.ndim == 1 else weight[:, None]
        return np.asarray(values[node] + t * (values[after] - values[node]))

    return PairContact(*(blended(*pair) for pair in zip(*levels, strict=True)))


def _blend(lower: Array, upper: Array, bracket: LoadBracket) -> Array:
    return lower + bracket.weight * (upper - lower)


def _at_level(table: MeshTable, level: int) -> PairContact:
    w = {key: values[level] for key, values in table.windows.items()}
    pinion, gear = w["friction_arm_p"], w["friction_arm_g"] / table.ratio
    direction = pair_sliding_direction(w, table.ratio)
    return PairContact(
        w["share"],
        w["R_x"],
        w["R_y"],
        _vectors(w["entrainment_arm"], w["psi"]),
        _vectors(pinion - gear, direction),
    )


def _vectors(length: Array, angle: Array) -> Array:
    return np.stack([length * np.cos(angle), length * np.sin(angle)], axis=1)
