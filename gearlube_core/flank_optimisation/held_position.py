"""One position of the mesh with its cells held, and its loaded state for changed flanks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.tooth_contact.held_contact import Mask, solve_held


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
        Contact is solved anew on the held cells; the rates are those of the carrying cells. The
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
