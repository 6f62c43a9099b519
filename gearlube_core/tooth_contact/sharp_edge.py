"""When a computed pressure is that of a sharp edge, and the words for it."""

from __future__ import annotations

from gearlube_core.arrays import Array

EDGE_PRESSURE = 2.5e9  # Pa; hardened steel flanks are rated to about 1.5e9, films end near 4e9
EDGE_WORDS = (
    "Above 2.5 GPa: the sharp edge of a tip or end presses into the flank. Such a pressure has no "
    "finite value, it rises with finer cells. Read it as a place, not as a load; tip and end "
    "relief remove it."
)


# of the highest pressure; that of a sharp edge rises as the square root of the cells across, so
# three times finer ones would bring it to the highest
EDGE_SHARE = 0.6


def edges_that_carry(pressure_map: Array) -> dict[str, float]:
    """Return the pressure [Pa] at each edge of the teeth that presses into the mate.

    Relieved teeth have their highest pressure in the middle of the flank and little at the edges,
    also with cells too coarse to show how high the pressure of an edge is.

    Parameters
    ----------
    pressure_map : ndarray of shape (m, n)
        Highest pressure over the mesh on the gear flank [Pa]: root to tip, toe to heel; 0 where
        nothing touches.

    Returns
    -------
    dict of str to float
        Out of "gear tip", "pinion tip" (the lowest row that it reaches), "toe", "heel".

    Examples
    --------
    >>> import numpy as np
    >>> edges_that_carry(np.array([[0.0, 0.2, 0.0], [0.2, 1.0, 0.1], [0.0, 1.5, 0.0]]))
    {'gear tip': 1.5}
    """
    lowest = int((pressure_map > 0.0).any(axis=1).argmax())
    edges = {
        "gear tip": pressure_map[-1],
        "pinion tip": pressure_map[lowest],
        "toe": pressure_map[:, 0],
        "heel": pressure_map[:, -1],
    }
    highest = float(pressure_map.max())
    # where the pinion's tip ends on the gear is known to a row only: there it must be the highest
    enough = {"pinion tip": highest}
    return {
        name: float(one.max())
        for name, one in edges.items()
        if one.max() >= enough.get(name, EDGE_SHARE * highest) > 0.0
    }
