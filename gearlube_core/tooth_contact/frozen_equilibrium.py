"""Equilibrium of a set of loaded cells that is held, and how it moves with gaps and arms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from gearlube_core.arrays import Array, Indices
from gearlube_core.contact.half_space import love_coefficients


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
