"""Contact of several strips of cells on elastic teeth: one equilibrium of all tooth pairs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import block_diag, csr_array

from gearlube_core.arrays import Array
from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.strip_compliance import StripCompliance
from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem, UnilateralSolution
from gearlube_core.contact.unilateral_stiffness import tangent_forces
from gearlube_core.tooth_compliance.flank_compliance import FlankCompliance


@dataclass(frozen=True, slots=True, kw_only=True)
class PairStiffness:
    """Elastic data of a flank pair.

    Parameters
    ----------
    pinion, gear : FlankCompliance
        Bending and base of the teeth (image part).
    contact_modulus : float
        E* [Pa], both bodies.
    """

    pinion: FlankCompliance
    gear: FlankCompliance
    contact_modulus: float


@dataclass(frozen=True, slots=True, kw_only=True)
class CoupledStrip:
    """Cells of one tooth pair.

    Parameters
    ----------
    cell : tuple of float
        Sides of a cell across and along the strip [m].
    gap, arm, area : ndarray of shape (nx, ny)
        As in UnilateralProblem; inf gaps mask cells.
    weights : csr_array of shape (nx ny, hats of pinion and gear)
        Weights of the cells on the hats, W of `interpolation_weights` side by side.
    """

    cell: tuple[float, float]
    gap: Array
    arm: Array
    area: Array
    weights: csr_array


@dataclass(frozen=True, slots=True)
class CoupledSolution:
    """Equilibrium of all strips.

    Parameters
    ----------
    solution : UnilateralSolution
        Of all cells, strip by strip.
    first_rotation : float
        Rotation at which the first cell touches [rad].
    tangent : float
        dT/d(rotation) [N.m/rad].
    forces, pressure, tangents : tuple of ndarray of shape (nx, ny)
        f [N], p [Pa] and df/d(rotation) [N/rad] of each strip.
    """

    solution: UnilateralSolution
    first_rotation: float
    tangent: float
    forces: tuple[Array, ...]
    pressure: tuple[Array, ...]
    tangents: tuple[Array, ...]


def solve_coupled(
    strips: Sequence[CoupledStrip], stiffness: PairStiffness, torque: float, tolerance: float
) -> CoupledSolution:
    """Return the equilibrium of strips, each on a pair of teeth of its own, under one torque.

    Parameters
    ----------
    strips
        At least one.
    stiffness
        Of every pair of teeth alike.
    torque
        [N.m], above zero.
    tolerance
        As in `solve_torque`.

    Raises
    ------
    ConvergenceError
        As `tangent_stiffness`. Contact that was not found has the outcome `iteration limit`.
    """
    problem = strips_problem(strips, stiffness)
    solution = solve_torque(problem, torque, tolerance=tolerance, throw=False)
    tangents = tangent_forces(problem, solution)
    ends = np.cumsum([0, *(strip.gap.size for strip in strips)])

    def parted(values: Array) -> tuple[Array, ...]:
        return tuple(
            values[a:b].reshape(strip.gap.shape)
            for a, b, strip in zip(ends[:-1], ends[1:], strips, strict=True)
        )

    return CoupledSolution(
        solution=solution,
        first_rotation=float(np.min(problem.gap / problem.arm)),
        tangent=float(problem.arm @ tangents),
        forces=parted(solution.forces),
        pressure=parted(solution.pressure),
        tangents=parted(tangents),
    )


def strips_problem(strips: Sequence[CoupledStrip], stiffness: PairStiffness) -> UnilateralProblem:
    """Return the contact of strips, each on a pair of teeth of its own."""
    one = block_diag([stiffness.pinion.image, stiffness.gear.image]).toarray()
    compliance = StripCompliance(
        [_half_space(strip, stiffness.contact_modulus) for strip in strips],
        csr_array(block_diag([strip.weights for strip in strips], "csr")),
        block_diag([one] * len(strips)).toarray(),
    )
    return UnilateralProblem(
        compliance=compliance,
        gap=np.concatenate([strip.gap.ravel() for strip in strips]),
        arm=np.concatenate([strip.arm.ravel() for strip in strips]),
        cell_area=np.concatenate([strip.area.ravel() for strip in strips]),
    )


def _half_space(strip: CoupledStrip, contact_modulus: float) -> HalfSpaceConvolution:
    nx, ny = strip.gap.shape
    return HalfSpaceConvolution(love_coefficients(*strip.cell, nx, ny, contact_modulus))
