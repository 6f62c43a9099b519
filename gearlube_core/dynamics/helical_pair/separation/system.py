"""Constants of the pair with tooth separation in relative coordinates, and its mesh mode."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.linear_system import LinearSystem
from gearlube_core.dynamics.helical_pair.linear.matrix_entries import MatrixEntries, matrix_entries
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters


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
    """Return what the march takes; `linear` belongs to the same parameters."""
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
