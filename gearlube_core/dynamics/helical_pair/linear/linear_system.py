"""The linear time-periodic pair in relative coordinates, as the march over a period reads it.

Friction turns the pair as a whole without limit under constant torques; the flanks feel only
psi = r_bp th_zp + r_bg th_zg. With psi in place of th_zp and th_zg a steady state exists.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.kernel_parameters import COORDINATES, MeshArrays
from gearlube_core.dynamics.helical_pair.mesh.contact_points import N_COLUMNS, point_capacity
from gearlube_core.dynamics.helical_pair.mesh.film_friction import FilmField, film_moments
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import damping_factor
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import (
    N_SUMS,
    phase_moments,
    strain_rows,
    wrench_columns,
)
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel

RELATIVE = (*(name for name in COORDINATES if not name.startswith("th_z")), "psi")
_KEPT = tuple(i for i, name in enumerate(COORDINATES) if not name.startswith("th_z"))
_PHASES = 16  # at which the fastest motion is looked for


class MatrixEntries(NamedTuple):
    """Entries that are not zero, all of shape (entries,)."""

    row: np.ndarray[Any, np.dtype[np.int64]]
    column: np.ndarray[Any, np.dtype[np.int64]]
    value: Array


def matrix_entries(matrix: Array) -> MatrixEntries:
    """Return the entries of a matrix."""
    row, column = np.nonzero(matrix)
    return MatrixEntries(
        row.astype(np.int64), column.astype(np.int64), np.ascontiguousarray(matrix[row, column])
    )


@kernel
def add_product(factor: float, matrix: MatrixEntries, x: Array, out: Array) -> None:
    """Add factor times matrix times x to `out`; x and `out` have any number of columns."""
    columns = x.shape[1]
    for entry in range(matrix.value.size):
        row, column, value = matrix.row[entry], matrix.column[entry], factor * matrix.value[entry]
        for j in range(columns):
            out[row, j] += value * x[column, j]


class LinearSystem(NamedTuple):
    """q'' = f - K q - C q' - c(t) q'_psi/m_e e_psi + W (G(t) E q - g(t)), all over the masses.

    Coordinates are the free ones of `RELATIVE`, psi last; n of them.
    """

    names: tuple[str, ...]
    K: Array  # supports, shape (n, n) [1/s2]
    C: Array  # supports, shape (n,) [1/s]
    E: Array  # strains of the plane of contact, shape (2, n)
    W: Array  # accelerations by sums of the line loads, shape (n, 5)
    f: Array  # mean torques, shape (n,)
    mu: float  # [-]
    damping: float  # of the mesh: `mesh_damping.damping_factor` over m_e [kg^-1/2]
    variation: float  # of the mesh about its mean; 1 as it is, 0 constant
    plane: ContactPlane
    mesh: MeshArrays
    mean: Array  # moments averaged over the mesh period at this mu, shape (5, 3)
    film: FilmField | None  # friction in place of mu


def relative_rows(parameters: HelicalPairParameters) -> Array:
    """Return d(relative)/d(coordinates), shape (11, 12)."""
    rows = np.zeros((len(RELATIVE), len(COORDINATES)))
    for row, column in enumerate(_KEPT):
        rows[row, column] = 1.0
    rows[-1, 5] = parameters.pair.pinion_base_radius
    rows[-1, 11] = parameters.pair.gear_base_radius
    return rows


def linear_system(parameters: HelicalPairParameters, variation: float = 1.0) -> LinearSystem:
    """Return the linear system of a pair with linear contact and constant friction.

    Parameters
    ----------
    parameters
        `contact` is taken as linear: flanks that separate have no linear system. Film friction
        is left out: it needs a motion, see `periodic_response`.
    variation
        Factor on the mesh's deviation from its mean over the period [-]; axis of instability maps.

    Notes
    -----
    Source: [he_2007 (38a)] [he_2007 (38b)] [he_2007 (38c)] [he_2007 (39a)] [he_2007 (39b)]
    [he_2007 (39c)] [he_2007 (40a)] [he_2007 (40b)] [he_2007 (40c)] [he_2007 (41a)] [he_2007 (41b)]
    [he_2007 (41c)]
    Consistent signs: the pinion's torque of (39c) drives along -z; (38a) and (40c) hold misprints.
    """
    c, mesh, supports = (
        parameters.kernel_parameters(), parameters.mesh_arrays(), parameters.support_arrays(),
    )  # fmt: skip
    R = relative_rows(parameters)
    inertia = np.array([c.m_p] * 3 + [c.J_p] * 2 + [c.J_zp] + [c.m_g] * 3 + [c.J_g] * 2 + [c.J_zg])
    E, W = strain_rows(c.plane), wrench_columns(c.plane)
    E_relative = np.column_stack((E[:, _KEPT], E[:, 5] / c.plane.r_bp))
    K = np.zeros((12, 12))
    K[:6, :6], K[6:, 6:] = supports.stiffness
    torque = np.zeros(12)
    torque[5], torque[11] = -c.T_p, -c.T_g
    K_relative = np.zeros((len(RELATIVE), len(RELATIVE)))
    K_relative[:-1, :-1] = (K / inertia[:, None])[np.ix_(_KEPT, _KEPT)]
    damping = np.append((supports.damping.ravel() / inertia)[list(_KEPT)], 0.0)
    free = np.append(supports.free[list(_KEPT)], 1.0) > 0.0
    return LinearSystem(
        names=tuple(name for name, moves in zip(RELATIVE, free, strict=True) if moves),
        K=np.ascontiguousarray(K_relative[np.ix_(free, free)]),
        C=damping[free],
        E=np.ascontiguousarray(c.mesh_sign * E_relative[:, free]),
        W=np.ascontiguousarray((R @ (W / inertia[:, None]))[free]),
        f=(R @ (torque / inertia))[free],
        mu=parameters.mu,
        damping=damping_factor(c.zeta_mesh, c.m_e, c.plane.cos_b) / c.m_e,
        variation=variation,
        plane=c.plane,
        mesh=mesh,
        mean=mean_moments(c.plane, mesh, parameters.mu),
        film=None,
    )


def event_phases(plane: ContactPlane, mesh: MeshArrays) -> Array:
    """Return the phases in [0, 1) where the mesh has kinks or jumps: a line's ends pass A, P or D.

    Phases between which the mesh's data are linear count too.
    """
    places = np.array([plane.A, plane.P, plane.D])
    lag = plane.W * plane.sin_b / plane.cos_b
    events = np.concatenate((places, places + lag)) - plane.A
    phases = np.mod(events / plane.pitch, 1.0)
    nodes = np.arange(mesh.density.shape[0]) / mesh.density.shape[0]
    every = np.sort(np.concatenate((phases, nodes)))
    return np.asarray(every[np.append(True, np.diff(every) > 1e-9)])


def moments_at(plane: ContactPlane, mesh: MeshArrays, mu: float, phase: Array) -> Array:
    """Return G and g of the mesh at many phases, shape (phases, 5, 3)."""
    points = np.empty((point_capacity(mesh), N_COLUMNS))
    moments = np.empty((phase.size, N_SUMS, 3))
    _fill(plane, mesh, mu, phase, points, moments)
    return moments


@kernel
def _fill(
    plane: ContactPlane, mesh: MeshArrays, mu: float, phase: Array, points: Array, moments: Array
) -> None:
    for i in range(phase.size):
        phase_moments(phase[i], 1.0, mu, plane, mesh, points, moments[i])


def mean_moments(plane: ContactPlane, mesh: MeshArrays, mu: float) -> Array:
    """Return the moments averaged over the period, shape (5, 3): Gauss rule between events."""
    breaks = np.append(event_phases(plane, mesh), 1.0 + event_phases(plane, mesh)[0])
    nodes, weights = np.polynomial.legendre.leggauss(3)
    half, middle = 0.5 * np.diff(breaks), 0.5 * (breaks[1:] + breaks[:-1])
    phase = (middle[:, None] + half[:, None] * nodes).ravel()
    weight = (half[:, None] * weights).ravel()
    return np.asarray(np.einsum("i,ijk->jk", weight, moments_at(plane, mesh, mu, phase)))


def mean_mesh_stiffness(parameters: HelicalPairParameters) -> float:
    """Return the stiffness of all lines along the line of action, mean of a mesh period [N/m]."""
    plane = parameters.kernel_parameters().plane
    moments = mean_moments(plane, parameters.mesh_arrays(), 0.0)
    return float(plane.cos_b**2 * moments[0, 0])


def system_moments(system: LinearSystem, phase: Array) -> Array:
    """Return the moments at many phases in [0, 1], shape (phases, 5, 3).

    With the system's `variation`, which film friction has none of.
    """
    if system.film is not None:
        points = np.empty((point_capacity(system.mesh), N_COLUMNS))
        moments = np.empty((phase.size, N_SUMS, 3))
        film_moments(phase, system.film, system.plane, system.mesh, points, moments)
        return moments
    moments = moments_at(system.plane, system.mesh, system.mu, phase)
    return np.asarray(system.mean + system.variation * (moments - system.mean))


def natural_frequencies(system: LinearSystem) -> Array:
    """Return the angular frequencies of the undamped pair with its mean mesh [rad/s], rising.

    Friction is left out of them.
    """
    G = system.mean[:, :2].copy()
    G[2:] = 0.0
    squares = np.linalg.eigvals(system.K - system.W @ G @ system.E).real
    return np.sqrt(np.abs(np.sort(squares)))


def fastest_frequency(system: LinearSystem) -> float:
    """Return a bound on the modulus of the frequencies over the mesh period [rad/s]."""
    phase = (np.arange(_PHASES) + 0.5) / _PHASES
    stiffness = system.K - system.W @ system_moments(system, phase)[:, :, :2] @ system.E
    return float(np.sqrt(np.abs(np.linalg.eigvals(stiffness)).max()))
