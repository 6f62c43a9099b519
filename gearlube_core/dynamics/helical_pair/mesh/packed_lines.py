"""A line mesh at one torque, as the kernels read it."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays
from gearlube_core.mesh_table.line_mesh import LineMesh


def pack_lines(mesh: LineMesh, torque: float, divisions: int) -> MeshArrays:
    """Return density and offset at a pinion torque [N.m], stations spanning each whole line.

    Linear between torque levels; a mesh with one level serves all. Stations 0, 1 and those that cut
    the line into `divisions` equal parts are added: separation is resolved to a quadrature point.

    Raises
    ------
    ParameterError
        The torque lies outside the mesh's levels.
    """
    if mesh.torque.size > 1:
        low, high = float(mesh.torque[0]), float(mesh.torque[-1])
        check_within("pinion_torque", torque, low, high, "N.m", "The line mesh holds no other.")
    grid = np.linspace(0.0, 1.0, divisions + 1)
    station = np.unique(np.concatenate((grid, mesh.station if mesh.station.size > 1 else [])))

    def at_torque(values: Array) -> Array:
        flat = values.reshape(mesh.torque.size, -1)
        rows = np.array([np.interp(torque, mesh.torque, column) for column in flat.T])
        lines = rows.reshape(-1, mesh.station.size)
        packed = np.array([np.interp(station, mesh.station, line) for line in lines])
        return np.ascontiguousarray(packed.reshape(mesh.phase.size, mesh.lines, station.size))

    return MeshArrays(at_torque(mesh.density), at_torque(mesh.offset), station)
