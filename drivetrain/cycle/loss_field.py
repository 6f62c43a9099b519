"""Losses over speed and torque of a shaft, and the torque that it needs with them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

_SLOWEST = 0.01  # of the highest speed, below which the loss torque does not change
_ROUNDS, _SETTLED = 100, 1e-9  # N.m


@dataclass(frozen=True, slots=True, kw_only=True)
class LossField:
    """Losses at the points of a grid; between them the loss torque is linear in speed and torque.

    Below the lowest speed the loss torque is that of the lowest.

    Parameters
    ----------
    speeds : ndarray of shape (n,)
        [rad/s]
    torques : ndarray of shape (m,)
        [N.m]
    power : ndarray of shape (n, m, sources)
        [W]

    Examples
    --------
    >>> grid = np.array([10.0, 20.0])  # rad/s, N.m
    >>> seal = LossField(speeds=grid, torques=grid, power=np.array([[[5.0]] * 2, [[10.0]] * 2]))
    >>> speed = np.array([14.0])  # rad/s
    >>> seal.lost(speed, grid[:1]).round(3), seal.with_losses(speed, grid[:1], "").round(3)
    (array([[7.]]), array([10.5]))
    """

    speeds: Array
    torques: Array
    power: Array

    def lost(self, speed: Array, torque: Array) -> Array:
        """Return the power of each source at speeds [rad/s] and torques [N.m], (k, sources) [W]."""
        return self.between(self._loss_torque, speed, torque) * speed[:, None]

    def between(self, values: Array, speed: Array, torque: Array) -> Array:
        """Return other values of the grid, (n, m, ...), at speeds [rad/s] and torques [N.m]."""
        inside = np.clip(speed, self.speeds[0], self.speeds[-1])
        found = RegularGridInterpolator((self.speeds, self.torques), values)
        return np.asarray(found(np.column_stack([inside, torque])))

    def with_losses(self, speed: Array, asked: Array, cure: str) -> Array:
        """Return the torques that are `asked` plus the loss torque at themselves [N.m].

        Raises
        ------
        ParameterError
            They do not settle, or leave the grid; then `cure` ends the sentence.
        """
        low, high = self.torques[[0, -1]]
        carried = asked
        for _ in range(_ROUNDS):
            found = self.between(self._loss_torque, speed, np.clip(carried, low, high))
            new = asked + found.sum(axis=-1)
            change = float(np.abs(new - carried).max())
            carried = new
            if change < _SETTLED:
                break
        else:
            raise ParameterError(
                "The iteration of the shaft's torque with the losses must settle to within "
                f"{_SETTLED:g} N.m, got a change of {change:.2g} N.m in the last round. The losses "
                "grow faster than the torque. Check the oil and the roughness."
            )
        if carried.max() > high or carried.min() < low:
            raise ParameterError(
                f"The torque of the shaft with losses must be within {low:g} to {high:g} N.m, got "
                f"{carried.min():.4g} to {carried.max():.4g} N.m. {cure}"
            )
        return carried

    @property
    def _loss_torque(self) -> Array:
        return np.asarray(self.power / self.speeds[:, None, None])


def torque_nodes(count: int, low: float, high: float) -> Array:
    """Return `count` torques from `low` < 0 to `high` > 0 [N.m], denser near 0, and 0 itself."""
    roots = np.sqrt(-low), np.sqrt(high)
    below = max(2, round((count - 1) * roots[0] / sum(roots)))
    above = max(2, count - 1 - below)
    return np.concatenate(
        [
            low * np.linspace(1.0, 0.0, below, endpoint=False) ** 2,
            high * np.linspace(0.0, 1.0, above + 1) ** 2,
        ]
    )


def speed_nodes(count: int, highest: float) -> Array:
    """Return `count` speeds up to the highest one [rad/s], in a geometric series."""
    nodes = np.geomspace(_SLOWEST * highest, highest, count)
    nodes[-1] = highest
    return nodes
