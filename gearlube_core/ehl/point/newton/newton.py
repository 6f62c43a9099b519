"""Semismooth Newton iteration for pressure and approach on one grid."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.linalg.blas import daxpy

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.preconditioner import MultigridCycle
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.ehl.point.terms.state import FilmState

Operator = Callable[[Array, float], tuple[Array, float]]
Inverse = Callable[[Array, float], tuple[Array, float]]
Build = Callable[[Hierarchy, Linearisation], Inverse]

_THINNEST = 0.2  # smallest ratio of new to old film in one step [-]
_GROWTH = 1.05  # of the residual that a step may cost
_RUPTURED_GROWTH = 20.0  # where the edge of the oil moves: a node of it comes and goes
_CUTS = 3
_UNSOLVED = 0.3  # of a linear residual: the state is too rough to step from
_FIRST_SHIFT = 0.3  # of the flow through a cell, as a fictitious squeeze rate
_LARGEST_SHIFT = 100.0
_LOAD_WEIGHT = 0.1
_PATIENCE = 9  # steps within which the residual must halve or so
_RUPTURED_PATIENCE = 14


def flexible_gmres(
    operator: Operator,
    inverse: Operator,
    field: Array,
    number: float,
    *,
    tolerance: float,
    most: int,
    weight: float,
) -> tuple[Array, float, float, int]:
    """Return the solution, its relative residual and the number of iterations.

    Parameters
    ----------
    operator
        Takes and returns a field and a number.
    inverse
        Approximate inverse, applied from the right; may change between calls.
    field, number
        Right-hand side: field and number.
    tolerance
        Relative residual to stop at [-].
    most
        Largest number of iterations.
    weight
        Of the number's residual beside those of the field [-].

    Returns
    -------
    tuple
        Field, number, relative residual [-], iterations.

    Notes
    -----
    [saad_1993], with modified Gram-Schmidt and Givens rotations, without restart.
    """
    size = field.size
    first = np.append(field.ravel(), weight * number)
    norm = float(np.linalg.norm(first))
    if norm == 0.0:
        return np.zeros_like(field), 0.0, 0.0, 0
    basis = [first / norm]
    directions: list[tuple[Array, float]] = []
    H = np.zeros((most + 1, most))
    cosines, sines, right = np.zeros(most), np.zeros(most), np.zeros(most + 1)
    right[0] = norm
    count = 0
    for k in range(most):
        v = basis[k]
        direction = inverse(v[:size].reshape(field.shape), float(v[size]) / weight)
        directions.append(direction)
        image, image_number = operator(*direction)
        w = np.append(image.ravel(), weight * image_number)
        for i in range(k + 1):
            H[i, k] = float(w @ basis[i])
            w = daxpy(basis[i], w, a=-H[i, k])
        H[k + 1, k] = float(np.linalg.norm(w))
        for i in range(k):
            upper, lower = H[i, k], H[i + 1, k]
            H[i, k] = cosines[i] * upper + sines[i] * lower
            H[i + 1, k] = -sines[i] * upper + cosines[i] * lower
        length = math.hypot(H[k, k], H[k + 1, k])
        last = H[k + 1, k]
        count = k + 1
        if length == 0.0 or not math.isfinite(length):
            count = k
            break
        cosines[k], sines[k] = H[k, k] / length, H[k + 1, k] / length
        H[k, k] = length
        right[k + 1] = -sines[k] * right[k]
        right[k] *= cosines[k]
        if abs(right[k + 1]) <= tolerance * norm or last == 0.0:
            break
        basis.append(w / last)
    weights = np.linalg.solve(np.triu(H[:count, :count]), right[:count])
    solution, solution_number = np.zeros_like(field), 0.0
    for share, direction in zip(weights, directions, strict=False):
        solution += share * direction[0]
        solution_number += float(share) * direction[1]
    return solution, solution_number, abs(float(right[count])) / norm, count


@dataclass(slots=True)
class NewtonRecord:
    """Residual and step length of one Newton iteration."""

    converged: bool = False
    residuals: list[float] = field(default_factory=list)
    krylov: int = 0
    first_order: bool = False  # the solution of upwind-1: the chosen stencil found none

    def fallen_back(self, wedge: str) -> str:
        """Return a sentence where upwind-1 stands in for the stencil `wedge`, else nothing."""
        if not self.first_order:
            return ""
        return f" With upwind-1: too few nodes for {wedge} at this film; take more."


def flow_residual(level: PointLevel, state: FilmState) -> float:
    """Return the sum of unbalanced flow over the flow through the dry width [-].

    Nodes without pressure count only where flow gathers that no pressure drives away. What
    touching solids carry beyond the pressure counts as a flow.
    """
    unbalanced = level.grid.integral(np.where(state.free, np.abs(state.residual), 0.0))
    unbalanced += state.contact.unbalanced(state.residual, level.grid)
    middle = float(state.film[state.pressure >= 0.8 * state.pressure.max()].mean())
    if not middle > 0.0:
        return math.inf
    return unbalanced / (2.0 * level.half_width * middle)


def newton(
    hierarchy: Hierarchy,
    state: FilmState,
    *,
    tolerance: float,
    load_tolerance: float,
    most: int,
    most_krylov: int,
    build: Build = MultigridCycle,
) -> tuple[FilmState, NewtonRecord]:
    """Return the state on the finest grid of the hierarchy.

    Parameters
    ----------
    hierarchy
        Grids; the finest one is solved.
    state
        State where the iteration starts.
    tolerance, load_tolerance
        Limits of `flow_residual` and of the relative load error [-].
    most, most_krylov
        Most steps, and most iterations in one of them.
    build
        The preconditioner of hierarchy and linearisation.

    Returns
    -------
    tuple
        Last state and record of the iteration.

    Notes
    -----
    Cavitation p >= 0, R <= 0, p R = 0 as an active set: the equation is solved where there is
    pressure or flow gathers, other nodes keep none, negative pressure is cut. A step that makes
    the film collapse or the residual grow is shortened, then repeated with a fictitious squeeze
    term, which fades as the residual falls.
    """
    level = hierarchy.levels[-1]
    record = NewtonRecord()
    shift = 0.0
    ruptures = level.terms.cavitation.conserves_mass
    growth = _RUPTURED_GROWTH if ruptures else _GROWTH
    patience = _RUPTURED_PATIENCE if ruptures else _PATIENCE
    size = flow_residual(level, state)
    record.residuals.append(size)
    for _ in range(most):
        if size <= tolerance and abs(state.load_error) <= load_tolerance:
            break
        linear = level.linearise(state, squeeze=shift * level.flow_rate)
        cycle = build(hierarchy, linear)
        pressure, approach, remainder, count = flexible_gmres(
            lambda p, h, linear=linear: (  # type: ignore[misc]
                level.apply(linear, p, h).copy(),
                level.grid.integral(p) / level.load + h * linear.load_by_approach,
            ),
            cycle,
            linear.right,
            state.load_error,
            tolerance=min(0.03, max(1e-3, 0.1 * math.sqrt(size))),
            most=most_krylov,
            weight=_LOAD_WEIGHT * float(np.linalg.norm(linear.by_approach)),
        )
        record.krylov += count
        if remainder > _UNSOLVED and shift < _LARGEST_SHIFT:
            shift = max(_FIRST_SHIFT, 4.0 * shift)
            continue
        thinnest = _THINNEST * max(float(state.film.min()), 0.0)
        length, accepted = 1.0, False
        for _ in range(_CUTS):
            trial = level.state(
                np.maximum(state.pressure + length * pressure, 0.0),
                state.approach + length * approach,
            )
            trial_size = flow_residual(level, trial)
            positive = float(trial.film.min()) > thinnest
            if positive and trial_size < growth * size:
                accepted = True
                break
            length *= 0.4
        if accepted:
            if length == 1.0 and trial_size < 0.7 * size:
                shift = 0.25 * shift if shift > 0.02 else 0.0
            elif trial_size > 0.9 * size:
                shift = max(_FIRST_SHIFT, 2.0 * shift)
            state, size = trial, trial_size
            record.residuals.append(size)
        else:
            shift = max(_FIRST_SHIFT, 4.0 * shift)
        past = record.residuals
        if shift > _LARGEST_SHIFT or (len(past) > patience and size > 0.6 * past[-patience]):
            break
    record.converged = (
        size <= tolerance
        and abs(state.load_error) <= load_tolerance
        and float(state.film.min()) > 0.0
    )
    return state, record
