"""What is found at one set of values: loaded measures at all loads, errors and phases."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.flank_optimisation.held_position import LoadedMeasures
from gearlube_core.storage.result_store import Record

_OF_OTHER_SIDE = ("pressure", "edge_share", "pressure_rate", "edge_share_rate")


@dataclass(frozen=True, slots=True)
class Evaluation:
    """Measures at J torques, S scenarios and N phases, and their rates by P parameters.

    Parameters
    ----------
    rotation, pressure, sliding, edge_share, force : ndarray of shape (J, S, N)
        As in `LoadedMeasures`: [rad], [Pa], [-], [-], [N].
    rotation_rate, pressure_rate, sliding_rate, edge_share_rate, force_rate
        Of shape (J, S, N, P), per unit of each parameter; P is 0 where rates were not asked.
    other_pressure, other_edge_share : ndarray of shape (K, S, N)
        Of the flanks of the other side, at its K torques [Pa], [-].
    other_pressure_rate, other_edge_share_rate : ndarray of shape (K, S, N, P)
    settings_used : ndarray of shape (3,) or (0,)
        Parts of what the check of a gear file leaves machine settings, -1 to 1: slopes between the
        flanks of the other side, depth of the pinion's cut; empty where no setting may change.
    settings_used_rate : ndarray of shape (3, P) or (0, P)
    """

    rotation: Array
    pressure: Array
    sliding: Array
    edge_share: Array
    force: Array
    rotation_rate: Array
    pressure_rate: Array
    sliding_rate: Array
    edge_share_rate: Array
    force_rate: Array
    other_pressure: Array
    other_edge_share: Array
    other_pressure_rate: Array
    other_edge_share_rate: Array
    settings_used: Array
    settings_used_rate: Array

    @classmethod
    def of(
        cls,
        rows: list[tuple[LoadedMeasures, LoadedMeasures]],
        shape: tuple[int, int, int],
        settings_used: tuple[Array, Array] | None = None,
    ) -> Evaluation:
        """Return the evaluation of measures and rates in the order of `shape` (J, S, N).

        Rows beyond those are of the other side. `settings_used`: with its rates.
        """
        count, (own, *each) = len(LoadedMeasures._fields), shape
        values = np.array([one for one, _ in rows]).reshape(-1, *each, count)
        rates = np.array([one for _, one in rows])
        rates = rates.reshape(*values.shape, rates.shape[-1])
        named = dict(zip(LoadedMeasures._fields, np.moveaxis(values, -1, 0), strict=True))
        named |= {
            f"{name}_rate": one
            for name, one in zip(LoadedMeasures._fields, np.moveaxis(rates, -2, 0), strict=True)
        }
        used, used_rate = settings_used or (np.empty(0), np.empty((0, rates.shape[-1])))
        return cls(
            **{name: one[:own] for name, one in named.items()},
            **{f"other_{name}": named[name][own:] for name in _OF_OTHER_SIDE},
            settings_used=used,
            settings_used_rate=used_rate,
        )

    @classmethod
    def from_record(cls, record: Record) -> Evaluation:
        """Return the evaluation that `record` was made of."""
        return cls(**{one.name: record[one.name] for one in fields(cls)})

    def record(self) -> Record:
        """Return the arrays by name."""
        return {one.name: getattr(self, one.name) for one in fields(self)}

    def orders(self, orders: tuple[int, ...]) -> tuple[Array, Array]:
        """Return the mesh orders of the error (J, S, K) [rad] and their rates (J, S, K, P).

        c_k = (2/N) sum_n theta_n exp(-2 pi i k n/N)

        Linear in the error, so their rates are those of the error likewise. Amplitudes: abs.
        """
        return _orders(self.rotation, self.rotation_rate, orders)

    def swing(self, orders: tuple[int, ...]) -> tuple[Array, Array]:
        """Return the mesh orders of the force over its mean (J,) [-], and their rates (J, P).

        Root of the sum of squares of the orders, root mean square over errors. At one torque the
        force swings as its arm about the pinion's axis does: what the bearings feel and the
        transmission error does not show.
        """
        mean, mean_rate = self.force.mean(axis=2), self.force_rate.mean(axis=2)
        part = self.force / mean[..., None]
        rate = self.force_rate - part[..., None] * mean_rate[:, :, None]
        values, rates = _orders(part, rate / mean[..., None, None], orders)
        found = np.sqrt((np.abs(values) ** 2).sum(axis=2).mean(axis=1))
        turned = np.real(np.einsum("jsk,jskp->jp", np.conj(values), rates)) / values.shape[1]
        return found, turned / np.maximum(found, 1e-12)[:, None]

    def whine(self, orders: tuple[int, ...]) -> Array:
        """Return the root of the sum of squares of the mesh orders (J, S) [rad]."""
        return np.asarray(np.linalg.norm(self.orders(orders)[0], axis=-1))

    def spread(self, orders: tuple[int, ...]) -> Array:
        """Return how far errors move the mesh orders, root mean square over them (J,) [rad].

        Zero without errors.
        """
        found = self.orders(orders)[0]
        if found.shape[1] == 1:
            return np.zeros(found.shape[0])
        moved = np.abs(found[:, 1:] - found[:, :1]) ** 2
        return np.asarray(np.sqrt(moved.sum(axis=2).mean(axis=1)))

    @property
    def highest_pressure(self) -> Array:
        """Over errors and phases (J,) [Pa]."""
        return np.asarray(self.pressure.max(axis=(1, 2)))

    @property
    def highest_other_pressure(self) -> Array:
        """Of the other side, over errors and phases (K,) [Pa]."""
        return np.asarray(self.other_pressure.max(axis=(1, 2)))

    @property
    def largest_other_edge_share(self) -> Array:
        """Of the other side, over errors and phases (K,) [-]."""
        return np.asarray(self.other_edge_share.max(axis=(1, 2)))

    @property
    def mean_sliding(self) -> Array:
        """Over errors and phases (J,) [-]."""
        return np.asarray(self.sliding.mean(axis=(1, 2)))

    @property
    def largest_edge_share(self) -> Array:
        """Over errors and phases (J,) [-]."""
        return np.asarray(self.edge_share.max(axis=(1, 2)))


def _orders(values: Array, rates: Array, orders: tuple[int, ...]) -> tuple[Array, Array]:
    """Return the mesh orders (J, S, K) of values (J, S, N), and their rates (J, S, K, P)."""
    count = values.shape[-1]
    angle = np.outer(orders, np.arange(count)) * (2.0 * np.pi / count)
    wave = np.exp(-1j * angle) * (2.0 / count)
    return values @ wave.T, np.einsum("kn,jsnp->jskp", wave, rates)
