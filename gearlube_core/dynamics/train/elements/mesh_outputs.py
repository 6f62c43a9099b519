"""Outputs that all meshes of a train have, beside those of their kind."""

from __future__ import annotations

from typing import Any, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.ranges import FILM_SHARES, RANGE_OUTPUTS, RangeLimits, write_ranges
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Output

_MOST_LOADED = "where the load is largest"
_RANGES = (
    ("1", "sum of 1, 2, 4, ... for each range that is left"),
    ("N.m", "torque of the mesh data or carried by the teeth; below 0 on the coast flanks"),
    ("1", f"load group M of Moes {_MOST_LOADED}"),
    ("1", f"material group L of Moes {_MOST_LOADED}"),
    ("1", f"number of the traction map {_MOST_LOADED}"),
    ("K", f"film temperature {_MOST_LOADED}"),
    ("Pa", f"largest Hertz pressure {_MOST_LOADED}"),
)
FILM_SHARE = FILM_SHARES[0]
MESH_OUTPUTS = (
    Output("dte", "m", "dynamic transmission error", 1e-5, "um"),
    Output("stiffness", "N/m", "mesh stiffness", 1e8),
    Output("separated", "1", "1 while no flanks touch"),
    Output("coast_contact", "1", "1 while coast flanks touch"),
    Output("frequency", "Hz", "mesh frequency", 1e3),
    Output("load_torque", "N.m", "torque that selects the mesh data", 100.0),
    Output("friction", "W", "power lost in friction now", 100.0),
    Output("friction_bound", "W", "bound of that by the film model", 10.0),
    Output("film_thickness_min", "m", "thinnest film of the loaded flanks", 1e-6, "um"),
    Output(FILM_SHARE.output, "1", "share of the load outside the film model"),
    *(Output(name, unit, text) for name, (unit, text) in zip(RANGE_OUTPUTS, _RANGES, strict=True)),
)
OWN = len(MESH_OUTPUTS)  # place of the first output of a kind


class MeshValues(NamedTuple):
    """The first of `MESH_OUTPUTS`; all floats."""

    dte: float
    stiffness: float
    separated: float
    coast_contact: float
    frequency: float
    load_torque: float
    friction: float
    friction_bound: float
    film_thickness_min: float
    share_outside: float


FRICTION = MeshValues._fields.index("friction")


@kernel
def write_mesh(
    values: MeshValues, torque: float, found: Any, limits: RangeLimits, first: int, out: Array
) -> None:
    """Write `MESH_OUTPUTS` from place `first` of `out`.

    Parameters
    ----------
    torque : float
        That has a range [N.m].
    found : NamedTuple
        Numbers of the most loaded contact: a `LinesFound` or a `MostLoaded`.
    """
    n = len(values)
    for i in range(n):
        out[first + i] = values[i]
    write_ranges(
        torque,
        found.film_load,
        found.film_material,
        found.traction,
        found.temperature,
        found.pressure,
        limits,
        first + n,
        out,
    )
