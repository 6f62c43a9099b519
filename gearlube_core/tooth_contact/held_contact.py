"""Unilateral contact of cells that are held in place, and equilibrium under a torque."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from gearlube_core.arrays import Array, Indices
from gearlube_core.contact.half_space import love_coefficients
from gearlube_core.errors import ConvergenceError

Mask = NDArray[np.bool_]
_PASSES = 80
_TOGETHER = 40  # passes in which all wrong cells change; then the worst of each strip alone
_TOUCHING = 1e-13  # m; a gap that is less negative counts as closed


def frozen_compliance(
    row: Indices,
    column: Indices,
    cell: tuple[float, float],
    weights: Array,
    image: Array,
    contact_modulus: float,
) -> Array:
    """Return the displacements of n cells of a strip under unit forces on each [m/N], (n, n).

    Parameters
    ----------
    row, column : ndarray of int, shape (n,)
        Which cells of the strip.
    cell : tuple of float
        Sides of a cell [m].
    weights : ndarray of shape (n, hats)
        On the hats of both teeth.
    image : ndarray of shape (hats, hats)
        Compliance of both teeth between hats, block by block [m/N].
    contact_modulus : float
        E* [Pa].
    """
    rows, columns = np.abs(row[:, None] - row), np.abs(column[:, None] - column)
    size = int(rows.max()) + 1, int(columns.max()) + 1
    half_space = love_coefficients(*cell, *size, contact_modulus)[rows, columns]
    return np.asarray(half_space + weights @ image @ weights.T)


@dataclass(frozen=True, slots=True)
class FrozenEquilibrium:
    """Forces and rotation with which exactly these cells carry a torque.

    A f + g = theta R,  R.f = T

    Parameters
    ----------
    rotation : float
        theta [rad].
    forces, tangents, arms : tuple of ndarray of shape (n,)
        f [N], y = A^-1 R [N/rad] and R [m] of each strip.
    factors : tuple
        Of A, strip by strip.
    """

    rotation: float
    forces: tuple[Array, ...]
    tangents: tuple[Array, ...]
    arms: tuple[Array, ...]
    factors: tuple[Any, ...]

    @classmethod
    def of(
        cls,
        compliances: Sequence[Array],
        gaps: Sequence[Array],
        arms: Sequence[Array],
        torque: float,
    ) -> FrozenEquilibrium:
        """Return the equilibrium of strips with compliance [m/N], gap and arm [m] of their cells.

        The compliances are overwritten.
        """
        factors, tangents, resisted = [], [], []
        for compliance, gap, arm in zip(compliances, gaps, arms, strict=True):
            factor = cho_factor(compliance, overwrite_a=True)
            solved = cho_solve(factor, np.stack([arm, gap], axis=1))
            factors.append(factor)
            tangents.append(solved[:, 0])
            resisted.append(solved[:, 1])
        stiffness = sum(y @ arm for y, arm in zip(tangents, arms, strict=True))
        missing = torque + sum(r @ arm for r, arm in zip(resisted, arms, strict=True))
        rotation = float(missing / stiffness)
        forces = tuple(rotation * y - r for y, r in zip(tangents, resisted, strict=True))
        return cls(rotation, forces, tuple(tangents), tuple(arms), tuple(factors))

    def rates(
        self, gaps: Sequence[Array], arms: Sequence[Array], bent: Sequence[Array]
    ) -> tuple[float, tuple[Array, ...]]:
        """Return the rates of rotation [rad/unit] and forces [N/unit] by a parameter p.

        With b = theta dR/dp - dg/dp - (dA/dp) f

        dtheta/dp = -(y.b + f.dR/dp) / (y.R),  df/dp = y dtheta/dp + A^-1 b

        Parameters
        ----------
        gaps, arms : sequence of ndarray of shape (n,)
            dg/dp and dR/dp of each strip [m/unit].
        bent : sequence of ndarray of shape (n,)
            (dA/dp) f [m/unit].
        """
        right, work, stiffness = [], 0.0, 0.0
        for k, (gap, arm, bend) in enumerate(zip(gaps, arms, bent, strict=True)):
            b = self.rotation * arm - gap - bend
            right.append(b)
            work += float(self.tangents[k] @ b + self.forces[k] @ arm)
            stiffness += float(self.tangents[k] @ self.arms[k])
        turn = -work / stiffness
        return turn, tuple(
            turn * y + cho_solve(factor, b)
            for y, factor, b in zip(self.tangents, self.factors, right, strict=True)
        )


@dataclass(frozen=True, slots=True)
class HeldContact:
    """Equilibrium of strips of cells under one torque.

    A f + g - theta R = h >= 0,  f >= 0,  f.h = 0,  R.f = T

    Parameters
    ----------
    active : tuple of ndarray of bool, shape (n,)
        Cells of each strip that carry.
    equilibrium : FrozenEquilibrium
        Of the carrying cells, strips without any left out.
    passes : int
    """

    active: tuple[Mask, ...]
    equilibrium: FrozenEquilibrium
    passes: int

    @property
    def rotation(self) -> float:
        """Theta [rad]."""
        return self.equilibrium.rotation

    @property
    def carrying(self) -> tuple[int, ...]:
        """Strips with carrying cells, in the order of the equilibrium's."""
        return tuple(k for k, one in enumerate(self.active) if one.any())

    def rates(
        self, gaps: Sequence[Array], arms: Sequence[Array] | None = None
    ) -> tuple[Array, tuple[Array, ...]]:
        """Return the rates of rotation (P,) [rad/unit] and forces (P, n) [N/unit] by P parameters.

        The compliance is held. With b = theta dR/dp - dg/dp

        dtheta/dp = -(y.b + f.dR/dp) / (y.R),  df/dp = y dtheta/dp + A^-1 b

        Parameters
        ----------
        gaps, arms : sequence of ndarray of shape (P, n)
            dg/dp and dR/dp of all cells of each strip that carries [m/unit]; no arms: they are
            held.
        """
        held = self.equilibrium
        right, stiffness = [], 0.0
        work = np.zeros(gaps[0].shape[0])
        for k, gap in enumerate(gaps):
            there = self.active[self.carrying[k]]
            b = -gap[:, there]
            if arms is not None:
                b = b + held.rotation * arms[k][:, there]
                work = work + arms[k][:, there] @ held.forces[k]
            right.append(b)
            work = work + b @ held.tangents[k]
            stiffness += float(held.tangents[k] @ held.arms[k])
        turn = np.asarray(-work / stiffness)
        return turn, tuple(
            turn[:, None] * y + cho_solve(factor, b.T).T
            for y, factor, b in zip(held.tangents, held.factors, right, strict=True)
        )


def solve_held(
    compliances: Sequence[Array],
    gaps: Sequence[Array],
    arms: Sequence[Array],
    torque: float,
    active: Sequence[Mask],
) -> HeldContact:
    """Return the contact of strips, each on a pair of teeth of its own, under one torque.

    Cells that pull are let go and cells that overlap are taken in until there are none.

    Parameters
    ----------
    compliances : sequence of ndarray of shape (n, n)
        Displacement of cells under unit forces [m/N], symmetric and positive definite.
    gaps, arms : sequence of ndarray of shape (n,)
        [m]; arms above zero.
    torque : float
        [N.m], above zero.
    active : sequence of ndarray of bool, shape (n,)
        Where to start, at least one cell; those of a solution nearby take few passes.

    Raises
    ------
    ConvergenceError
        The cells do not settle.

    Examples
    --------
    >>> import numpy as np
    >>> soft, apart = np.diag([1e-8, 1e-8]), np.array([0.0, 1e-6])
    >>> found = solve_held([soft], [apart], [np.full(2, 0.05)], 1.0, [np.ones(2, bool)])
    >>> found.active[0].tolist()
    [True, False]
    """
    there = [np.array(one, bool) for one in active]
    for count in range(1, _PASSES + 1):
        used = [k for k, one in enumerate(there) if one.any()]
        held = FrozenEquilibrium.of(
            [compliances[k][np.ix_(there[k], there[k])] for k in used],
            [gaps[k][there[k]] for k in used],
            [arms[k][there[k]] for k in used],
            torque,
        )
        changed = False
        for k, one in enumerate(there):
            open_by = gaps[k] - held.rotation * arms[k]
            wrong = np.zeros(one.size)
            if k in used:
                forces = held.forces[used.index(k)]
                open_by = open_by + compliances[k][:, one] @ forces
                wrong[one] = np.maximum(-forces, 0.0) * np.median(np.diag(compliances[k]))
            wrong[~one] = np.maximum(-open_by[~one] - _TOUCHING, 0.0)
            if not wrong.any():
                continue
            changed = True
            flip = wrong > 0.0
            if count > _TOGETHER:
                flip = wrong == wrong.max()
            there[k] = one ^ flip
        if not changed:
            return HeldContact(tuple(there), held, count)
        if not any(one.any() for one in there):  # all let go: the nearest cell takes the load
            first = int(np.argmin([np.min(g / r) for g, r in zip(gaps, arms, strict=True)]))
            there[first][np.argmin(gaps[first] / arms[first])] = True
    raise ConvergenceError(
        f"The contact of held cells must settle within {_PASSES} passes, but some cells still open "
        "and close. Take fewer or larger cells."
    )
