"""Contact of several strips of cells on elastic teeth: one equilibrium of all tooth pairs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np
from scipy.sparse import block_diag, csr_array

from gearlube_core.arrays import Array
from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import (
    UnilateralProblem,
    UnilateralSolution,
    tangent_forces,
)
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.tooth_compliance.flank_compliance import FlankCompliance

_SYMMETRY = 1e-9  # of the largest entry: above the rounding of a solved influence matrix
Strips = TypeVar("Strips")


class StripCompliance:
    """Displacement u = A f + W K W^T f of the cells of all strips under their forces.

    A is block diagonal, one half-space strip a tooth pair; W interpolates from a few smooth
    shape functions to cells, and K is their compliance: bending, base rotation, shafts, and the
    coupling of tooth pairs through the rim.

    Parameters
    ----------
    strips
        One convolution a strip; cells are numbered strip by strip, each with y fastest. Strips
        may share one object.
    shapes : sparse array, shape (n_cells, n_shapes), optional
        W [-]; left out together with `shape_compliance`.
    shape_compliance : ndarray, shape (n_shapes, n_shapes), optional
        K [m/N], symmetric; may be indefinite as long as the sum with A is positive definite.

    Raises
    ------
    ParameterError
        No strip, shapes that do not fit, or K neither finite nor symmetric.

    Notes
    -----
    Calls write into one buffer: an object serves one thread at a time.
    """

    __slots__ = ("_compliance", "_displacement", "_gather", "_rows", "_spread", "n_cells", "strips")

    def __init__(
        self,
        strips: Sequence[HalfSpaceConvolution],
        shapes: Any = None,
        shape_compliance: Array | None = None,
    ) -> None:
        if not strips:
            raise ParameterError("strips must hold at least one strip, got none.")
        self.strips = tuple(strips)
        ends = np.cumsum([0, *(strip.shape[0] * strip.shape[1] for strip in strips)])
        self._rows = tuple(slice(int(a), int(b)) for a, b in pairwise(ends))
        self.n_cells = int(ends[-1])
        self._displacement = np.zeros(self.n_cells)
        self._spread: csr_array | None = None
        if (shapes is None) != (shape_compliance is None):
            raise ParameterError("shapes and shape_compliance belong together, got one of them.")
        if shapes is not None and shape_compliance is not None:
            self._spread = csr_array(shapes, dtype=np.float64)
            self._gather = csr_array(self._spread.T)
            self._compliance = _checked_compliance(shape_compliance)
            expected = (self.n_cells, self._compliance.shape[0])
            if self._spread.shape != expected:
                raise ParameterError(
                    f"shapes must have shape {expected}, got {self._spread.shape}: one row a cell "
                    "of all strips, one column a row of shape_compliance."
                )

    def __call__(self, forces: Array) -> Array:
        """Return the displacement [m], shape (n_cells,), under cell forces [N], same shape.

        The result is a buffer that the next call overwrites.
        """
        for rows, strip in zip(self._rows, self.strips, strict=True):
            self._displacement[rows].reshape(strip.shape)[:] = strip(
                forces[rows].reshape(strip.shape)
            )
        if self._spread is not None:
            self._displacement += self._spread @ (self._compliance @ (self._gather @ forces))
        return self._displacement


def _checked_compliance(shape_compliance: Array) -> Array:
    compliance = np.array(shape_compliance, dtype=np.float64)
    if compliance.ndim != 2 or compliance.shape[0] != compliance.shape[1]:
        raise ParameterError(f"shape_compliance must be square, got shape {compliance.shape}.")
    if not np.isfinite(compliance).all():
        raise ParameterError("shape_compliance must be finite, got NaN or infinity in m/N.")
    asymmetry = np.abs(compliance - compliance.T).max(initial=0.0)
    largest = np.abs(compliance).max(initial=0.0)
    if asymmetry > _SYMMETRY * largest:
        raise ParameterError(
            f"shape_compliance must be symmetric within {_SYMMETRY:g} of its largest entry "
            f"{largest:g} m/N, got a difference of {asymmetry:g} m/N. Average it with "
            "its transpose."
        )
    return np.asarray(0.5 * (compliance + compliance.T))


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
        Contact strips, at least one.
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


@dataclass(frozen=True, slots=True, kw_only=True)
class StripGrowth:
    """Enlargement of strips that are too small for the contact.

    Parameters
    ----------
    factor : float
        On the width of strips whose long sides carry load [-].
    margin : float
        Closing that is taken next, over the closing that was needed [-].
    attempts : int
    """

    factor: float
    margin: float
    attempts: int


def solve_on_growing_strips(
    solve: Callable[[float, float], tuple[Strips, CoupledSolution]],
    needed: Callable[[CoupledSolution], float],
    *,
    closing: float,
    width: float,
    growth: StripGrowth,
    tolerance: float,
    where: str,
    cure: str = "",
) -> tuple[Strips, CoupledSolution]:
    """Return strips that contain the whole contact, and its equilibrium on them.

    Parameters
    ----------
    solve
        Cuts strips for a closing and a width and solves the contact on them.
    needed
        The closing of a solution, in the unit of `closing`.
    closing, width
        First guesses: closing beyond first touch, width across the contact lines. Any unit.
    growth
        How both are enlarged.
    tolerance
        That of `solve`, for the error [-].
    where, cure
        Words for the error.

    Raises
    ------
    ConvergenceError
        When contact keeps running out of the strips, or is not found on them.
    """
    for _ in range(growth.attempts):
        strips, solved = solve(closing, width)
        outcome = solved.solution.outcome
        if not outcome.converged:
            raise ConvergenceError(
                f"Contact at {where} must be in balance within {tolerance:g}, got "
                f"{outcome.residual:.3g} after {outcome.iterations} iterations. Take a slightly "
                "different torque (--torque, --torques), or another number of --positions."
            )
        reached = needed(solved)
        sideways = any(bool((forces[[0, -1]] > 0.0).any()) for forces in solved.forces)
        if reached <= closing and not sideways:
            return strips, solved
        if reached > closing:
            closing = max(growth.margin * reached, growth.factor**0.5 * closing)
        if sideways:
            width *= growth.factor
    raise ConvergenceError(
        f"Contact at {where} still leaves its strips after {growth.attempts} enlargements. "
        f"Reduce the torque{cure}."
    )
