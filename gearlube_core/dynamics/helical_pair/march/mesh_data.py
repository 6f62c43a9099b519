"""A line mesh as the kernels of a mesh read it, behind the pair's constants in one array.

Kernels take constants and line mesh as one float64 array, the *pair data*: handing over more arrays
and tuples costs a call more than its work. Layout:

    MarchConstants | film model | kept films | least offset [m] | level [N.m] | stations |
    moments | density [N/m2] | offset [m]

density and offset have shape (phases, lines, stations), flattened, at the level, a torque. The kept
films are what `kept_films` remembers, the moments what `line_sums` does.
"""

from __future__ import annotations

import math
from typing import NamedTuple, TypeAlias

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import MarchConstants
from gearlube_core.dynamics.helical_pair.march.kept_films import N_KEPT_FILMS
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.kernels.flat_tuples import count_floats, flatten
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.line_mesh import LineMesh

FILM_AT = count_floats(MarchConstants)  # numbers of a film model of lines; zeros with formulas
KEPT_AT = FILM_AT + N_ARRAY  # `kept_films`; zeros: nothing is kept
LEAST_OFFSET = KEPT_AT + N_KEPT_FILMS
LEVEL = LEAST_OFFSET + 1
STATIONS_AT = LEVEL + 1
N_MOMENTS = 21  # of a part of a line, from its start to a station
LINE_HEAD = 2  # before the moments of a line: the level that they hold for, the greatest offset


class MarchMesh(NamedTuple):
    """Density and offset at all torque levels; stations span each whole line."""

    torque: Array  # shape (levels,) [N.m]
    density: Array  # shape (levels, phases * lines * stations) [N/m2]
    offset: Array  # the same [m]


MeshFields: TypeAlias = tuple[Array, Array, Array]  # the same as a plain tuple


def all_stations(mesh: LineMesh) -> Array:
    """Return the stations of a mesh with both ends of the line."""
    own = mesh.station if mesh.station.size > 1 else np.empty(0)
    return np.unique(np.concatenate(([0.0, 1.0], own)))


def pack_march_mesh(mesh: LineMesh) -> MarchMesh:
    """Return the mesh on `all_stations`; values beyond its own are those of the nearest."""
    station = all_stations(mesh)

    def spread(values: Array) -> Array:
        lines = values.reshape(-1, mesh.station.size)
        rows = [np.interp(station, mesh.station, line) for line in lines]
        return np.ascontiguousarray(np.reshape(rows, (mesh.torque.size, -1)))

    return MarchMesh(mesh.torque.copy(), spread(mesh.density), spread(mesh.offset))


def pair_data(constants: MarchConstants, mesh: LineMesh, film_model: Array) -> Array:
    """Return pair data at the lowest torque level.

    `film_model` has shape (N_ARRAY,), see `HelicalMarchParameters.film_model`.
    """
    packed = pack_march_mesh(mesh)
    station = all_stations(mesh)
    data = np.zeros(data_size(station.size, packed.density.shape[1]))
    data[:FILM_AT] = flatten(constants)
    data[FILM_AT:KEPT_AT] = film_model
    place_mesh(station, (packed.torque, packed.density, packed.offset), data)
    return data


@kernel
def density_at(stations: int, size: int) -> int:
    """Return the place of the density, of `size` numbers, in the pair data."""
    return STATIONS_AT + stations + N_MOMENTS * size + LINE_HEAD * (size // stations)


@kernel
def data_size(stations: int, size: int) -> int:
    """Return the length of pair data; `size` is that of the density at one level."""
    return density_at(stations, size) + 2 * size


@kernel
def mesh_at_torque(torque: float, mesh: MeshFields, data: Array) -> None:
    """Write the mesh at a torque [N.m] into the pair data, linear between levels.

    Outside the levels the nearest one holds. `mesh` has the fields of `MarchMesh`.
    """
    if torque == data[LEVEL]:
        return
    levels, densities, offsets = mesh[0], mesh[1], mesh[2]
    last = levels.size - 1
    low = 0
    while low < last - 1 and torque > levels[low + 1]:
        low += 1
    high = min(low + 1, last)
    part = 0.0
    if high > low:
        part = min(max((torque - levels[low]) / (levels[high] - levels[low]), 0.0), 1.0)
    size = densities.shape[1]
    at_density = data.size - 2 * size
    least = offsets[low, 0] + part * (offsets[high, 0] - offsets[low, 0])
    for j in range(size):
        e = offsets[low, j] + part * (offsets[high, j] - offsets[low, j])
        data[at_density + j] = densities[low, j] + part * (densities[high, j] - densities[low, j])
        data[at_density + size + j] = e
        least = min(least, e)
    data[LEAST_OFFSET] = least
    data[LEVEL] = torque


@kernel
def place_mesh(station: Array, mesh: MeshFields, data: Array) -> None:
    """Write stations and the mesh at its lowest level into the pair data behind its constants."""
    for i in range(LEVEL, data.size):
        data[i] = math.nan  # what was there is of another mesh
    for i in range(station.size):
        data[STATIONS_AT + i] = station[i]
    mesh_at_torque(mesh[0][0], mesh, data)


@kernel
def mean_density(mesh: MeshFields) -> float:
    """Return the mean stiffness density of all levels [N/m2]."""
    densities = mesh[1]
    total = 0.0
    for i in range(densities.shape[0]):
        for j in range(densities.shape[1]):
            total += densities[i, j]
    return total / (densities.shape[0] * densities.shape[1])


@kernel
def largest_offset(mesh: MeshFields) -> float:
    """Return the largest offset of all levels [m]."""
    offsets = mesh[2]
    largest = offsets[0, 0]
    for i in range(offsets.shape[0]):
        for j in range(offsets.shape[1]):
            largest = max(largest, offsets[i, j])
    return largest
