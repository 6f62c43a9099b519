"""A line mesh with all its torque levels as the marching kernels read it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from gearlube_core.jit import kernel
from gearlube_core.mesh_table.line_mesh import LineMesh

Array = NDArray[np.float64]
LOAD_FILTER_TIME = 0.02  # s, the load level follows the torque below the shafts' own motions


class MarchMesh(NamedTuple):
    """Density and offset at all torque levels; stations span each whole line."""

    torque: Array  # shape (levels,) [N.m]
    density: Array  # shape (levels, phases * lines * stations) [N/m2]
    offset: Array  # ditto [m]
    station: Array  # shape (stations,), from 0 to 1


def pack_march_mesh(mesh: LineMesh) -> MarchMesh:
    """Return the mesh with stations 0 and 1 added; values there are those of the nearest."""
    station = np.unique(np.concatenate(([0.0, 1.0], mesh.station if mesh.station.size > 1 else [])))

    def spread(values: Array) -> Array:
        lines = values.reshape(-1, mesh.station.size)
        rows = [np.interp(station, mesh.station, line) for line in lines]
        return np.ascontiguousarray(np.reshape(rows, (mesh.torque.size, -1)))

    return MarchMesh(mesh.torque.copy(), spread(mesh.density), spread(mesh.offset), station)


@kernel
def mesh_at_torque(
    torque: float,
    levels: NDArray[float64],
    density: NDArray[float64],
    offset: NDArray[float64],
    density_out: NDArray[float64],
    offset_out: NDArray[float64],
) -> float:
    """Blend the mesh to a torque [N.m], linear between levels, and return the least offset [m].

    Outside the levels the nearest one holds.
    """
    last = levels.size - 1
    low = 0
    while low < last - 1 and torque > levels[low + 1]:
        low += 1
    high = min(low + 1, last)
    part = 0.0
    if high > low:
        part = min(max((torque - levels[low]) / (levels[high] - levels[low]), 0.0), 1.0)
    least = offset[low, 0] + part * (offset[high, 0] - offset[low, 0])
    for j in range(density_out.size):
        density_out[j] = density[low, j] + part * (density[high, j] - density[low, j])
        offset_out[j] = offset[low, j] + part * (offset[high, j] - offset[low, j])
        least = min(least, offset_out[j])
    return least
