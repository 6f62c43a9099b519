"""Which edges of the teeth a loaded contact reaches."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.loaded_contact import LoadedPair, LoadedState
from gearlube_core.hypoid_contact.pair import FlankPair

Mask = NDArray[np.bool_]
_NEIGHBOURS = [(i, j) for i in range(3) for j in range(3)]


def loaded_edges(pair: FlankPair, state: LoadedState) -> dict[str, float]:
    """Return the highest pressure [Pa] at each edge that the loaded contact reaches.

    An edge is reached where a loaded cell lies beside one that a tooth does not cover. There the
    pressure follows the cells, as that of a sharp edge does.

    Parameters
    ----------
    pair : FlankPair
        Whose contact it is.
    state : LoadedState

    Returns
    -------
    dict of str to float
        Out of "pinion tip", "pinion toe", "pinion heel", and the same of the gear: the edge that
        is nearest to such a cell. Empty where the contact ends before all edges.

    Examples
    --------
    >>> state = MeshPosition.at(pair, 0.5).load(300.0, teeth, LoadedSettings())  # doctest: +SKIP
    >>> loaded_edges(pair, state)  # doctest: +SKIP
    {'gear tip': 2.1e9}
    """
    found: dict[str, float] = {}
    for one in state.pairs:
        reached = (one.forces > 0.0) & beside_edge(one.strip.usable)
        if not reached.any():
            continue
        distances = _distances(pair, one, reached)
        names = list(distances)
        nearest = np.argmin(np.array(list(distances.values())), axis=0)
        for number, pressure in zip(nearest, one.pressure[reached], strict=True):
            name = names[number]
            found[name] = max(found.get(name, 0.0), float(pressure))
    return found


def beside_edge(usable: Mask) -> Mask:
    """Return which cells have a neighbour that is not usable, as booleans of shape (nx, ny).

    The ends of the strip itself are no edges.
    """
    rows, columns = usable.shape
    padded = np.pad(usable, 1, constant_values=True)
    inside = np.all([padded[i : i + rows, j : j + columns] for i, j in _NEIGHBOURS], axis=0)
    return np.asarray(usable & ~inside)


def _distances(pair: FlankPair, one: LoadedPair, cells: Mask) -> dict[str, Array]:
    """Return the distances [m] of cells from the edges of both teeth."""
    found = {}
    for role, flank, parameters in (
        ("pinion", pair.pinion, one.strip.pinion_parameters),
        ("gear", pair.gear, one.strip.gear_parameters),
    ):
        s, t = flank.position(flank.sample_parameters(parameters[cells]).r)
        height, width = flank.region.whole_height, flank.region.face_width
        found[f"{role} tip"] = (1.0 - s) * height
        found[f"{role} toe"] = t * width
        found[f"{role} heel"] = (1.0 - t) * width
    return found
