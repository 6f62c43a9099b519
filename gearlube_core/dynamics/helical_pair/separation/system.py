"""Constants of the pair with tooth separation in relative coordinates, and its mesh mode.

Quadrature points of the contact lines at every stage of a march over one mesh period.

At prescribed mean speed they depend on the mesh phase alone, so that they are set up once for all
motions, speeds and, where the line mesh has one level, loads.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    LinearSystem,
    MatrixEntries,
    event_phases,
    matrix_entries,
)
from gearlube_core.dynamics.helical_pair.mesh import contact_points as at
from gearlube_core.dynamics.helical_pair.mesh.contact_points import contact_points, point_capacity
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import built_up
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import sign
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel

# columns of a table of points
ALONG, STIFFNESS, OFFSET, DRAG, X, Z, STIFFNESS_RATE, OFFSET_RATE = range(8)
N_POINT = 8
STAGES = 3  # start, middle and end of a step
_INSIDE = 1e-9  # share of an interval by which its ends are moved inwards: the mesh may jump there
# rows 0 to 4 are the sums of `mesh_wrench`; then per flank, drive and back, what damping needs
FLANK_LOAD, FLANK_DAMPING = (5, 6), (7, 8)
N_ROWS = 9
VALUE, BY_Y0, BY_Y1, BY_TORQUE = range(4)
N_BY = 4


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


@kernel
def separating_sums(
    y0: float, y1: float, points: Array, n: int, backlash: float, build_up: float, sums: Array
) -> float:
    """Fill the sums over the contact lines with their derivatives; return k dl in contact [N/m].

    w = k max(0, delta - e) on the drive flank, -k max(0, -delta - backlash - e) on the back flank,
    delta = y0 + p y1

    Parameters
    ----------
    y0, y1
        Strains of the plane of contact [m], [rad].
    points : ndarray of shape (at least n, N_POINT)
    backlash
        Normal [m].
    build_up
        Penetration over which a point's damping builds up [m].
    sums : ndarray of shape (N_ROWS, N_BY)
        Written. Rows: w, w p, r, r x, r z, w of either flank, k min(1, penetration/build_up) of
        either flank, all integrated over dl. Columns: value, derivatives by y0, y1 and the pinion
        torque.

    Notes
    -----
    The derivatives are exact but where a point is about to touch, where the sums have kinks.
    """
    sums[:, :] = 0.0
    touching = 0.0
    for i in range(n):
        p, k, e = points[i, ALONG], points[i, STIFFNESS], points[i, OFFSET]
        delta = y0 + p * y1
        pressed, side, flank = delta - e, 1.0, 0
        if pressed < 0.0:
            pressed, side, flank = delta + backlash + e, -1.0, 1
        if pressed * side <= 0.0:
            continue
        touching += k
        k_rate, e_rate = points[i, STIFFNESS_RATE], points[i, OFFSET_RATE]
        r, x, z = side * points[i, DRAG], points[i, X], points[i, Z]
        share = built_up(side * pressed, build_up)
        slope = side * k / build_up if share < 1.0 else 0.0
        for by in range(N_BY):
            if by == VALUE:
                w, damping = k * pressed, k * share
            elif by == BY_Y0:
                w, damping = k, slope
            elif by == BY_Y1:
                w, damping = k * p, slope * p
            else:
                w = k_rate * pressed - side * k * e_rate
                damping = k_rate * share - side * slope * e_rate
            sums[0, by] += w
            sums[1, by] += w * p
            sums[2, by] += r * w
            sums[3, by] += r * w * x
            sums[4, by] += r * w * z
            sums[FLANK_LOAD[flank], by] += w
            sums[FLANK_DAMPING[flank], by] += damping
    return touching


class SeparationSystem(NamedTuple):
    """q'' = T f - K q - C q' + W S(E q, phase) - d e_psi; n coordinates, psi last."""

    K: MatrixEntries  # supports over the masses [1/s2]
    C: Array  # supports over the masses, shape (n,) [1/s]
    E: MatrixEntries  # strains of the plane of contact, (2, n)
    W: MatrixEntries  # accelerations by sums of the line loads, (n, 5)
    f: Array  # accelerations by the pinion torque, shape (n,)
    per_force: float  # acceleration of psi by the line loads' sum: cos(b)/m_e [1/kg]
    damping: float  # `mesh_damping.damping_factor` over m_e [kg^-1/2]
    backlash: float  # normal [m]
    build_up: float  # penetration over which damping builds up [m]


def separation_system(
    parameters: HelicalPairParameters, linear: LinearSystem, build_up: float
) -> SeparationSystem:
    """Return the arguments of the march; `linear` belongs to the same parameters."""
    cos_b = linear.plane.cos_b
    return SeparationSystem(
        K=matrix_entries(linear.K),
        C=linear.C,
        E=matrix_entries(linear.E),
        W=matrix_entries(linear.W),
        f=linear.f / parameters.pinion_torque,
        per_force=cos_b / parameters.effective_mass,
        damping=linear.damping,
        backlash=parameters.pair.backlash,
        build_up=build_up,
    )


def static_state(linear: LinearSystem, f: Array) -> Array:
    """Return (q, 0) of accelerations `f` on the mean mesh, shape (2n,)."""
    stiffness = linear.K - linear.W @ linear.mean[:, :2] @ linear.E
    q = np.linalg.solve(stiffness, f - linear.W @ linear.mean[:, 2])
    return np.concatenate((q, np.zeros(q.size)))


def relative_masses(parameters: HelicalPairParameters, names: tuple[str, ...]) -> Array:
    """Return masses [kg] and inertias [kg m2] of relative coordinates, m_e of psi, shape (n,)."""
    p = parameters
    mass, inertia = (p.pinion_mass, p.gear_mass), (p.pinion_inertia, p.gear_inertia)
    return np.array(
        [
            p.effective_mass
            if name == "psi"
            else (inertia if name.startswith("th") else mass)[name.endswith("g")]
            for name in names
        ]
    )


def mesh_mode_frequency(parameters: HelicalPairParameters, linear: LinearSystem) -> float:
    """Return the frequency [Hz] of the mode that has most of its energy in the mesh.

    Undamped, on the mean mesh, without friction.
    """
    mesh = linear.mean[:2, :2]
    squares, modes = np.linalg.eig(linear.K - linear.W[:, :2] @ mesh @ linear.E)
    squares, modes = squares.real, modes.real
    in_mesh = np.einsum("in,ij,jn->n", linear.E @ modes, mesh, linear.E @ modes)
    kinetic = squares * (relative_masses(parameters, linear.names) @ modes**2)
    share = np.where(squares > 0.0, in_mesh, 0.0) / np.where(squares > 0.0, kinetic, 1.0)
    return math.sqrt(squares[np.argmax(share)]) / (2.0 * math.pi)
