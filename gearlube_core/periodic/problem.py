"""A periodic motion as a system of equations with one parameter."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive
from gearlube_core.errors import ParameterError

Residual = Callable[[Array, float], tuple[Array, Array, Array, Array]]
PeriodMap = Callable[[Array, float], tuple[Array, Array, Array]]


class Evaluation(NamedTuple):
    """Values of the scaled equations at one point.

    `place` is (z / unknown scales, p / parameter scale), shape (m + 1,); `equations` the scaled
    residual, shape (m,); `jacobian` its derivative by place, shape (m, m + 1).
    """

    place: Array
    equations: Array
    jacobian: Array
    monodromy: Array

    @property
    def size(self) -> float:
        """Euclidean norm of the scaled equations [-]; inf where any entry is not finite."""
        size = float(np.sqrt(self.equations @ self.equations))
        return size if math.isfinite(size) and np.isfinite(self.jacobian).all() else math.inf


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PeriodicProblem:
    """r(z, p) = 0: a state that repeats after a period, and other unknown constants if any.

    Parameters
    ----------
    residual
        Maps (z, p) to r, shape (m,); dr/dz, shape (m, m); dr/dp, shape (m,); and the monodromy
        matrix M = d(state after a period)/d(state at its start), shape (k, k), where k = 0 says
        that stability has no meaning. It shows failure by a residual that is not finite, not by
        an exception. Derivatives must be those of the map as computed (variational equations
        integrated with the same steps), or Newton's method converges slowly.
    unknown_scale : ndarray, shape (m,)
        Size of z [units of z] at which the unknowns count alike; above zero.
    parameter_scale
        Size of p [unit of p] that counts like one unknown scale; above zero. It sets how finely
        a branch is resolved along the parameter.
    residual_scale : ndarray, shape (m,), optional
        Size of r [units of r]; the unknown scales if left out, which suits r = P(z) - z.
    trivial_multipliers
        How many multipliers of M are one by construction (motion along the orbit of an autonomous
        system, conserved quantities, states that only count); they say nothing of stability.

    Raises
    ------
    ParameterError
        A scale is not above zero, shapes differ, or the count is negative.
    """

    residual: Residual
    unknown_scale: Array
    parameter_scale: float
    residual_scale: Array | None = None
    trivial_multipliers: int = 0
    _equation_scale: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        unknowns = _scales("unknown_scale", self.unknown_scale)
        rows = self.unknown_scale if self.residual_scale is None else self.residual_scale
        equations = _scales("residual_scale", rows)
        if equations.shape != unknowns.shape:
            raise ParameterError(
                f"residual_scale must have one entry an unknown, {unknowns.size}, got "
                f"{equations.size}. As many equations as unknowns are needed."
            )
        check_positive("parameter_scale", self.parameter_scale)
        if self.trivial_multipliers < 0:
            raise ParameterError(
                f"trivial_multipliers must be 0 or more, got {self.trivial_multipliers}."
            )
        object.__setattr__(self, "unknown_scale", unknowns)
        object.__setattr__(self, "_equation_scale", equations)

    @property
    def count(self) -> int:
        """Number of unknowns m."""
        return int(self.unknown_scale.size)

    def place(self, unknowns: Array, parameter: float) -> Array:
        """Return the scaled place of (z, p), shape (m + 1,); raise ParameterError if malformed."""
        z = np.array(unknowns, dtype=np.float64)
        if z.shape != self.unknown_scale.shape or not np.isfinite(z).all():
            raise ParameterError(
                f"unknowns must be {self.count} finite numbers, got shape {z.shape}: {z}. "
                "Start from a motion near the periodic one."
            )
        p = check_finite("parameter", parameter)
        return np.append(z / self.unknown_scale, p / self.parameter_scale)

    def unscaled(self, place: Array) -> tuple[Array, float]:
        """Return (z, p) of a scaled place."""
        return place[:-1] * self.unknown_scale, float(place[-1]) * self.parameter_scale

    def evaluate(self, place: Array) -> Evaluation:
        """Return the scaled equations at a scaled place, shape (m + 1,)."""
        r, by_unknowns, by_parameter, monodromy = self.residual(*self.unscaled(place))
        jacobian = np.empty((self.count, self.count + 1))
        jacobian[:, :-1] = by_unknowns * self.unknown_scale
        jacobian[:, -1] = by_parameter * self.parameter_scale
        jacobian /= self._equation_scale[:, None]
        return Evaluation(place, r / self._equation_scale, jacobian, np.asarray(monodromy))


def _scales(name: str, values: Array) -> Array:
    scales = np.array(values, dtype=np.float64)
    if scales.ndim != 1 or not ((scales > 0.0) & np.isfinite(scales)).all():
        raise ParameterError(
            f"{name} must be flat, finite and above zero, got {scales}. Give the size of a "
            "typical oscillation, in the unknown's unit."
        )
    return scales


def fixed_point_residual(period_map: PeriodMap, *, periods: int = 1) -> Residual:
    """Return r = P(P(...P(z))) - z for a map over one period of the excitation.

    Parameters
    ----------
    period_map
        P: maps (z, p) to the state after one period, shape (m,); dP/dz, shape (m, m); dP/dp,
        shape (m,).
    periods
        Number of periods after which the motion repeats; 2 for the motion after a period doubling.

    Raises
    ------
    ParameterError
        `periods` is below one.

    Examples
    --------
    Of the map z -> p z + 1 the fixed point is 1/(1 - p):

    >>> def line(z, p):
    ...     return p * z + 1.0, np.array([[p]]), z
    >>> r, by_z, by_p, M = fixed_point_residual(line, periods=2)(np.array([2.0]), 0.5)
    >>> float(r[0]), float(by_z[0, 0]), float(M[0, 0])
    (0.0, -0.75, 0.25)
    """
    if periods < 1:
        raise ParameterError(f"periods must be 1 or more, got {periods}.")

    def residual(z: Array, p: float) -> tuple[Array, Array, Array, Array]:
        end, monodromy, by_parameter = period_map(z, p)
        for _ in range(1, periods):
            end, step, by_parameter_here = period_map(end, p)
            monodromy = step @ monodromy
            by_parameter = step @ by_parameter + by_parameter_here
        return end - z, monodromy - np.eye(z.size), by_parameter, monodromy

    return residual
