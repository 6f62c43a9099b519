"""Quadrature points of the contact lines at every stage of a march over one mesh period.

At prescribed mean speed they depend on the mesh phase alone, so that they are set up once for all
motions, speeds and, where the line mesh has one level, loads.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays
from gearlube_core.dynamics.helical_pair.linear.linear_system import event_phases
from gearlube_core.dynamics.helical_pair.mesh import contact_points as at
from gearlube_core.dynamics.helical_pair.mesh.contact_points import contact_points, point_capacity
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import sign
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel

# columns of a table of points
ALONG, STIFFNESS, OFFSET, DRAG, X, Z, STIFFNESS_RATE, OFFSET_RATE = range(8)
N_POINT = 8
STAGES = 3  # start, middle and end of a step
_INSIDE = 1e-9  # share of an interval by which its ends are moved inwards: the mesh may jump there


class SeparationPoints(NamedTuple):
    """Points at all stages; steps are of equal phase between two events of the mesh."""

    phase: Array  # at the start of each step, shape (steps,) [mesh periods]
    width: Array  # of each step [mesh periods]
    used: np.ndarray[Any, np.dtype[np.int64]]  # number of points, shape (steps, STAGES)
    # p [m], k dl [N/m], e [m], -mu sign(v_s) [-], x, z [m], and k dl and e by pinion torque
    points: Array  # shape (steps, STAGES, capacity, N_POINT)
    total: Array  # sum of k dl, and by pinion torque, shape (steps, STAGES, 2)


class StagePoints(NamedTuple):
    """Points at one stage."""

    points: Array  # shape (capacity, N_POINT), as in `SeparationPoints`
    used: int  # number of points
    total: Array  # shape (2,), as in `SeparationPoints`


def step_phases(plane: ContactPlane, mesh: MeshArrays, steps: int) -> tuple[Array, Array, Array]:
    """Return phases at the start of steps, their widths and those of their stages.

    Parameters
    ----------
    steps
        In a mesh period, at least: no step spans a kink or jump of the mesh.

    Returns
    -------
    ndarray of shape (n,), ndarray of shape (n,), ndarray of shape (n, STAGES)
        [mesh periods]
    """
    breaks = np.unique(np.concatenate(([0.0, 1.0], event_phases(plane, mesh))))
    breaks = breaks[np.append(True, np.diff(breaks) > 1e-9)]
    breaks[-1] = 1.0
    starts, widths, stages = [], [], []
    for low, high in pairwise(breaks):
        count = max(1, int(np.ceil((high - low) * steps - 1e-9)))
        inside = (np.arange(count)[:, None] + [0.0, 0.5, 1.0]) / count
        starts.append(low + (high - low) * np.arange(count) / count)
        widths.append(np.full(count, (high - low) / count))
        stages.append(low + (high - low) * np.clip(inside, _INSIDE, 1.0 - _INSIDE))
    return np.concatenate(starts), np.concatenate(widths), np.concatenate(stages)


def separation_points(
    plane: ContactPlane, mesh: MeshArrays, by_torque: MeshArrays, mu: float, steps: int
) -> SeparationPoints:
    """Return the points at all stages.

    Parameters
    ----------
    plane, mesh
        Geometry, and density and offset along the lines at the load.
    by_torque
        Derivatives of density and offset by the pinion torque.
    mu
        Constant coefficient of friction [-].
    steps
        In a mesh period, at least.
    """
    phase, width, stages = step_phases(plane, mesh, steps)
    capacity = point_capacity(mesh)
    points = np.zeros((phase.size, STAGES, capacity, N_POINT))
    total = np.zeros((phase.size, STAGES, 2))
    used = np.zeros((phase.size, STAGES), dtype=np.int64)
    here, rate = (np.empty((capacity, at.N_COLUMNS)) for _ in range(2))
    _fill(stages, plane, mesh, by_torque, mu, here, rate, points, total, used)
    return SeparationPoints(phase, width, used, points, total)


@kernel
def _fill(
    stages: Array,
    plane: ContactPlane,
    mesh: MeshArrays,
    by_torque: MeshArrays,
    mu: float,
    here: Array,
    rate: Array,
    points: Array,
    total: Array,
    used: np.ndarray[Any, np.dtype[np.int64]],
) -> None:
    for step in range(stages.shape[0]):
        for stage in range(stages.shape[1]):
            n = contact_points(stages[step, stage], 1.0, plane, mesh, here)
            contact_points(stages[step, stage], 1.0, plane, by_torque, rate)
            used[step, stage] = n
            row = points[step, stage]
            for i in range(n):
                x, z, length = here[i, at.X], here[i, at.Z], here[i, at.LENGTH]
                row[i, ALONG] = x * plane.sin_b + z * plane.cos_b
                row[i, STIFFNESS] = here[i, at.DENSITY] * length
                row[i, OFFSET] = here[i, at.OFFSET]
                row[i, DRAG] = -mu * sign(here[i, at.SLIDING])
                row[i, X] = x
                row[i, Z] = z
                row[i, STIFFNESS_RATE] = rate[i, at.DENSITY] * length
                row[i, OFFSET_RATE] = rate[i, at.OFFSET]
                total[step, stage, 0] += row[i, STIFFNESS]
                total[step, stage, 1] += row[i, STIFFNESS_RATE]
