"""Damped Newton iteration as a kernel, made for one function.

It neither allocates nor raises, and the function is compiled into it: no function pointers.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.linear_solve import factorise, solve_factorised

OK = 0
NOT_CONVERGED = 1  # no shorter step helps, or too many steps
NOT_FINITE = 2  # the function, its derivatives or the step

Residual = Callable[[Array, Any, Array], None]  # (u, problem, out)
Jacobian = Callable[[Array, Any, Array], None]  # (u, problem, matrix row by row)

DIFFERENCE = 1e-3  # half width of the central differences, in scales of the unknown
_TOLERANCE = 1e-13  # of the step that ends the search, in scales or of the unknown itself
# where rounding forbids smaller steps: at most this far from the solution
_SETTLED = 1e-8
_REACH = 1e3  # longest step, in scales
_HALVINGS = 32  # of the step, before it is given up
_MAX_STEPS = 200


def newton_work_size(n: int) -> int:
    """Return the length of the work array for `n` unknowns."""
    return n * n + 7 * n


@kernel
def _size(step: Array, u: Array, scale: Array) -> float:
    """Return the largest entry of a step, in scales or of the unknown where that is larger."""
    largest = 0.0
    for j in range(u.size):
        one = abs(step[j]) / max(scale[j], abs(u[j]))
        if not one < math.inf:
            return math.inf
        largest = max(largest, one)
    return largest


@kernel
def _scale_matrix(matrix: Array, scale: Array, rows: Array) -> None:
    """Turn d F_i / d u_j into a matrix without units; write the size of each row into `rows`."""
    n = scale.size
    for i in range(n):
        largest = 0.0
        for j in range(n):
            matrix[i * n + j] *= scale[j]
            largest = max(largest, abs(matrix[i * n + j]))
        rows[i] = largest if largest > 0.0 else 1.0
        for j in range(n):
            matrix[i * n + j] /= rows[i]


@kernel
def _newton_step(
    factors: Array,
    order: Array,
    rows: Array,
    scale: Array,
    force: Array,
    scratch: Array,
    step: Array,
) -> None:
    """Write the step with which the linear function of these factors passes from `force` to 0."""
    n = scale.size
    for i in range(n):
        scratch[i] = -force[i] / rows[i]
    solve_factorised(factors, n, order, scratch, step)
    for j in range(n):
        step[j] *= scale[j]


@kernel
def _largest_share(force: Array, rows: Array) -> float:
    """Return the largest residual in sizes of its row; inf when one is not finite."""
    largest = 0.0
    for i in range(force.size):
        one = abs(force[i]) / rows[i]
        if not one < math.inf:
            return math.inf
        largest = max(largest, one)
    return largest


def _differences(residual: Residual) -> Callable[..., None]:
    """Return the kernel of central differences of `residual`."""

    @kernel
    def differences(
        u: Array, scale: Array, problem: Any, trial: Array, force: Array, matrix: Array
    ) -> None:
        n = u.size
        for j in range(n):
            trial[j] = u[j]
        for j in range(n):
            step = DIFFERENCE * scale[j]
            for i in range(n):
                matrix[i * n + j] = 0.0
            for side in range(2):
                sign = 1.0 - 2.0 * side
                trial[j] = u[j] + sign * step
                residual(trial, problem, force)
                for i in range(n):
                    matrix[i * n + j] += sign * force[i] / (2.0 * step)
            trial[j] = u[j]

    return differences


def _given(jacobian: Jacobian) -> Callable[..., None]:
    """Return `jacobian` with the arguments of `differences`."""

    @kernel
    def given(
        u: Array, scale: Array, problem: Any, trial: Array, force: Array, matrix: Array
    ) -> None:
        jacobian(u, problem, matrix)

    return given


@cache
def damped_newton(
    residual: Residual, jacobian: Jacobian | None = None
) -> Callable[[Array, Array, Any, Array], tuple[int, float]]:
    """Return the kernel that solves `residual(u) = 0`.

    Parameters
    ----------
    residual : kernel
        `residual(u, problem, out)` writes the n residuals; `problem` is any tuple.
    jacobian : kernel, optional
        `jacobian(u, problem, matrix)` writes all n * n derivatives, row by row. By default central
        differences over DIFFERENCE scales.

    Returns
    -------
    kernel
        `solve(u, scale, problem, work) -> (status, step)`. `u` of shape (n,) is the start and the
        result. `scale` of shape (n,), above 0, says what change of each unknown is small but
        matters, in its unit. `work` has shape (newton_work_size(n),). `step` is the size of the
        last step in scales, or of the unknown where that is larger: the error that is left.
        The status is OK, NOT_CONVERGED or NOT_FINITE; `u` is then the best that was reached.

    Notes
    -----
    The damping takes the longest of the steps 1, 1/2, 1/4, ... after which the simplified Newton
    step, or else the largest residual in sizes of its row of derivatives, is smaller than before.
    The first test does not depend on units of the residuals; the second helps across kinks of
    one-sided contact, where derivatives change at once.

    References
    ----------
    The first is the natural monotonicity test, P. Deuflhard, Newton Methods for Nonlinear Problems,
    Springer 2004, section 3.3.
    """
    derive = _differences(residual) if jacobian is None else _given(jacobian)

    @kernel
    def solve(u: Array, scale: Array, problem: Any, work: Array) -> tuple[int, float]:
        n = u.size
        matrix = work[0 : n * n]
        order = work[n * n : n * n + n]
        rows = work[n * n + n : n * n + 2 * n]
        force = work[n * n + 2 * n : n * n + 3 * n]
        step = work[n * n + 3 * n : n * n + 4 * n]
        trial = work[n * n + 4 * n : n * n + 5 * n]
        scratch = work[n * n + 5 * n : n * n + 6 * n]
        following = work[n * n + 6 * n : n * n + 7 * n]
        size = math.inf
        for _ in range(_MAX_STEPS):
            derive(u, scale, problem, trial, force, matrix)
            _scale_matrix(matrix, scale, rows)
            singular = factorise(matrix, n, order) > 0.0
            residual(u, problem, force)
            share = _largest_share(force, rows)
            _newton_step(matrix, order, rows, scale, force, scratch, step)
            size = _size(step, u, scale)
            if not share + size < math.inf:
                return NOT_FINITE, size
            longest = min(1.0, _REACH / size) if size > 0.0 else 1.0
            left = size
            accepted = False
            for k in range(2 * _HALVINGS if singular else _HALVINGS):
                damping = longest * 0.5 ** (k % _HALVINGS)
                sense = 1.0 if k < _HALVINGS else -1.0  # a singular matrix does not know its sense
                for j in range(n):
                    trial[j] = u[j] + sense * damping * step[j]
                residual(trial, problem, force)
                _newton_step(matrix, order, rows, scale, force, scratch, following)
                left = _size(following, u, scale)
                least = 1.0 - 0.25 * damping
                accepted = left <= least * size or _largest_share(force, rows) <= least * share
                if accepted:
                    break
                if size <= _SETTLED:
                    return OK, size  # rounding: no step is better than none
            if not accepted:
                return NOT_CONVERGED, size
            for j in range(n):
                u[j] = trial[j]
            if longest == 1.0 and left <= _TOLERANCE:
                return OK, left
        return NOT_CONVERGED, size

    return solve
