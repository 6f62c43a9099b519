"""Outputs of the bearings: their names and the kernel that writes them."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    ShaftBearings,
    ShaftMotion,
    bearing_loads,
)
from gearlube_core.dynamics.hypoid_axle.bearing_drag import AxleRaceways
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

BEARING_QUANTITIES = ("force.x", "force.y", "force.z", "roller_load_max", "roller_load_min")
N_BEARINGS = 4  # two of the pinion, then two of the gear
BEARING_OUTPUTS = tuple(
    f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in BEARING_QUANTITIES
)

# places within the outputs of one bearing
FORCE = BEARING_QUANTITIES.index("force.x")
ROLLER_LOAD_MAX = BEARING_QUANTITIES.index("roller_load_max")
ROLLER_LOAD_MIN = BEARING_QUANTITIES.index("roller_load_min")
N_BEARING_QUANTITIES = len(BEARING_QUANTITIES)
# by solved films, in a group of their own
FILM_QUANTITIES = ("film_thickness", "film_bound")
BEARING_FILMS = tuple(
    f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in FILM_QUANTITIES
)


@kernel
def write_raceways(raceways: AxleRaceways, first: int, at_share: int, out: Array) -> None:
    """Write the thinnest film of each bearing with its bound, from `first` on.

    At `at_share` the share of the rollers' load outside the film model's domain. All zeros where
    no model tells them.
    """
    one, two = raceways.pinion, raceways.gear
    out[first] = one.first_film
    out[first + 1] = one.first_bound
    out[first + 2] = one.second_film
    out[first + 3] = one.second_bound
    out[first + 4] = two.first_film
    out[first + 5] = two.first_bound
    out[first + 6] = two.second_film
    out[first + 7] = two.second_bound
    load = one.load + two.load
    out[at_share] = (one.load_outside + two.load_outside) / load if load > 0.0 else 0.0


@kernel
def write_shaft(
    motion: ShaftMotion,
    f_ref: float,
    oil: LubricantState,
    bearings: ShaftBearings,
    first: int,
    axes: tuple[int, int, int],
    rollers: Array,
    out: Array,
) -> float:
    """Write forces and extreme roller loads of two bearings; return roller 1 of the first [N].

    Their outputs begin at `first`. `axes` are the places (0, 1, 2) of r1, r2 and the shaft in
    x, y, z; `rollers` is work space of shape (ROLLERS_MAX,).
    """
    first_roller = 0.0
    for k in range(2):
        side = 1.0 - 2.0 * k
        F_r1, F_r2, F_a, load, largest, smallest = bearing_loads(
            bearings, motion, f_ref, oil, side, rollers
        )
        base = first + k * N_BEARING_QUANTITIES
        out[base + FORCE + axes[0]] = F_r1
        out[base + FORCE + axes[1]] = F_r2
        out[base + FORCE + axes[2]] = F_a
        out[base + ROLLER_LOAD_MAX] = largest
        out[base + ROLLER_LOAD_MIN] = smallest
        if k == 0:
            first_roller = load
    return first_roller
