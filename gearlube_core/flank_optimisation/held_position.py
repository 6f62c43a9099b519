"""One position of the mesh with its cells held, and its loaded state for changed flanks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.storage.resumable import Record
from gearlube_core.tooth_contact.held_contact import Mask, solve_held

_OF_OTHER_SIDE = ("pressure", "edge_share", "pressure_rate", "edge_share_rate")


@dataclass(frozen=True, slots=True)
class HeldStrip:
    """Cells of one tooth pair, held.

    Parameters
    ----------
    compliance : ndarray of shape (n, n)
        Displacement under unit forces [m/N].
    arm, area : ndarray of shape (n,)
        [m], [m2].
    sliding : ndarray of shape (n,)
        Sliding speed per pinion speed [m].
    at_edge : ndarray of shape (n,)
        1 in the border of either flank, else 0 [-].
    start : ndarray of bool, shape (n,)
        Cells that carry as the flanks stand.
    """

    compliance: Array
    arm: Array
    area: Array
    sliding: Array
    at_edge: Array
    start: Mask


class StripGaps(NamedTuple):
    """Gap of the cells of a strip and its rates by P parameters, per unit of each."""

    gap: Array  # (n,) [m]
    gap_rate: Array  # (P, n) [m/unit]
    arm: Array  # (n,) [m]
    arm_rate: Array | None  # (P, n) [m/unit]; None: arms are held


class LoadedMeasures(NamedTuple):
    """Measures of one position, or their rates (P,) per unit of each parameter."""

    rotation: float | Array  # [rad]
    pressure: float | Array  # in the cell that carries most [Pa]
    sliding: float | Array  # sliding power of the normal forces over the pinion's power [-]
    edge_share: float | Array  # part of the normal forces within the border of the flanks [-]
    force: float | Array  # sum of the normal forces [N]


@dataclass(slots=True)
class HeldPosition:
    """The tooth pairs at one mesh phase and torque; their cells stay while flanks change.

    Parameters
    ----------
    torque : float
        On the pinion [N.m].
    strips : sequence of HeldStrip
    gaps : callable
        Returns `StripGaps` of each strip for what the caller calls flanks.
    """

    torque: float
    strips: Sequence[HeldStrip]
    gaps: Callable[..., list[StripGaps]]
    _active: list[Mask] = field(default_factory=list)

    def measures(self, *flanks: object) -> tuple[LoadedMeasures, LoadedMeasures]:
        """Return the measures for changed flanks, and their rates by P parameters.

        Notes
        -----
        Contact is solved again on the held cells; the rates are those of the carrying cells. The
        mesh's sliding speeds and the teeth's compliance are held.

        Raises
        ------
        ConvergenceError
            As `solve_held`.
        """
        found = self.gaps(*flanks)
        contact = solve_held(
            [strip.compliance for strip in self.strips],
            [one.gap for one in found],
            [one.arm for one in found],
            self.torque,
            self._active or [strip.start for strip in self.strips],
        )
        self._active = list(contact.active)
        carrying = contact.carrying
        arm_rates = [found[k].arm_rate for k in carrying]
        turn, moves = contact.rates(
            [found[k].gap_rate for k in carrying],
            None if any(one is None for one in arm_rates) else arm_rates,  # type: ignore[arg-type]
        )
        forces = np.concatenate(contact.equilibrium.forces)
        rates = np.concatenate(moves, axis=1)

        def cells(name: str) -> Array:
            return np.concatenate(
                [getattr(self.strips[k], name)[contact.active[k]] for k in carrying]
            )

        area, slide, edge = cells("area"), cells("sliding"), cells("at_edge")
        highest = int(np.argmax(forces / area))
        total = float(forces.sum())
        share = float(forces @ edge) / total
        return (
            LoadedMeasures(
                contact.rotation,
                float(forces[highest] / area[highest]),
                float(forces @ slide) / self.torque,
                share,
                total,
            ),
            LoadedMeasures(
                turn,
                rates[:, highest] / area[highest],
                rates @ slide / self.torque,
                (rates @ edge - share * rates.sum(axis=1)) / total,
                rates.sum(axis=1),
            ),
        )


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
