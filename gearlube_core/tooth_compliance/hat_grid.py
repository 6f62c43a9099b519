"""Bilinear hat functions on a flank: how loads and displacements are condensed."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array

from gearlube_core.arrays import Array, Indices
from gearlube_core.errors import ParameterError

_TIP_CLUSTER = 0.4  # steps at the tip are 0.6, at the root 1.4 of the mean


def profile_nodes(count: int) -> Array:
    """Return rising s from 0 at the root to 1 at the tip, closer together towards the tip.

    s(u) = u + c u (1 - u): the free edge's effect on the compliance grows steeply towards it.
    """
    u = np.linspace(0.0, 1.0, count)
    return u + _TIP_CLUSTER * u * (1.0 - u)


def lengthwise_nodes(count: int) -> Array:
    """Return evenly spaced t from 0 at the toe to 1 at the heel."""
    return np.linspace(0.0, 1.0, count)


def bracket(x: Array, nodes: Array) -> tuple[Indices, Array]:
    """Return the lower node's index and the upper node's weight of linear interpolation.

    Points outside the nodes are moved to the nearest end.
    """
    lower = np.clip(np.searchsorted(nodes, x, side="right") - 1, 0, len(nodes) - 2)
    weight = (x - nodes[lower]) / (nodes[lower + 1] - nodes[lower])
    return lower, np.clip(weight, 0.0, 1.0)


def hat_values(s: Array, t: Array, s_nodes: Array, t_nodes: Array) -> csr_array:
    """Return the values of all hats at points of the flank, sparse (points, mh nh) [-].

    Parameters
    ----------
    s, t
        Flank parameters of the points [-], any shape; counted in C order.
    s_nodes, t_nodes
        Rising parameters of the hats' centres [-], (mh,) and (nh,). Hat (i, j) is column
        i nh + j.
    """
    s, t = np.broadcast_arrays(np.asarray(s, dtype=float), np.asarray(t, dtype=float))
    if not (np.all(np.isfinite(s)) and np.all(np.isfinite(t))):
        raise ParameterError("s and t must be finite; some are not.")
    i, u = bracket(s.ravel(), s_nodes)
    j, v = bracket(t.ravel(), t_nodes)
    rows = np.tile(np.arange(i.size), 4)
    columns = [(i + a) * len(t_nodes) + (j + b) for a in (0, 1) for b in (0, 1)]
    weights = [(u if a else 1.0 - u) * (v if b else 1.0 - v) for a in (0, 1) for b in (0, 1)]
    shape = (i.size, len(s_nodes) * len(t_nodes))
    return csr_array(
        coo_array((np.concatenate(weights), (rows, np.concatenate(columns))), shape=shape)
    )
