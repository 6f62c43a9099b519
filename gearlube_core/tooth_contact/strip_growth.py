"""Loaded contact on strips that are enlarged until the whole contact lies inside."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from gearlube_core.errors import ConvergenceError
from gearlube_core.tooth_contact.coupled_strips import CoupledSolution

Strips = TypeVar("Strips")


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
