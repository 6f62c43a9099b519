"""Derivatives of the loaded contact at one position by settings and misalignments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import block_diag

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.loaded_contact import LoadedState
from gearlube_core.hypoid_contact.sensitivity.frozen_cells import CellGeometry, FrozenCells
from gearlube_core.hypoid_contact.sensitivity.parameter import Variations
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.held_contact import FrozenEquilibrium, frozen_compliance

QUANTITIES = (
    "rotation",
    "touching",
    "gear_torque",
    "force",
    "secant_stiffness",
    "pressure_max",
    "sliding_loss",
    "s",
    "t",
)


@dataclass(frozen=True, slots=True)
class LoadedQuantities:
    """The loaded contact at one position, or its derivatives with a leading dimension (P,).

    Parameters
    ----------
    rotation : float or ndarray
        Pinion rotation under load beyond the teeth ratio, towards the gear [rad].
    touching : float or ndarray
        The same without load, at the first of the loaded cells [rad].
    gear_torque : float or ndarray
        [N.m]
    force : float or ndarray
        Mesh force: of the resultant of the cells' normal forces [N].
    secant_stiffness : float or ndarray
        Force over closing along the line of action, counted from first touch [N/m].
    pressure_max : float or ndarray
        In the cell that carries most [Pa].
    sliding_loss : float or ndarray
        Sliding power of the normal forces over the pinion's power [-]: times a coefficient of
        friction it is the share of power that sliding takes.
    s, t : float or ndarray
        Centre of force on the gear flank [-].
    share : ndarray of shape (J,) or (P, J)
        Of each tooth pair with loaded cells, by rising phase [-].
    """

    rotation: Any
    touching: Any
    gear_torque: Any
    force: Any
    secant_stiffness: Any
    pressure_max: Any
    sliding_loss: Any
    s: Any
    t: Any
    share: Array


@dataclass(frozen=True, slots=True)
class LoadedRates:
    """The loaded contact at one position and its derivatives by P parameters.

    Parameters
    ----------
    phases : tuple of float
        Of the J tooth pairs with loaded cells [mesh periods].
    value, rate : LoadedQuantities
        Rates per unit of each parameter.
    """

    phases: tuple[float, ...]
    value: LoadedQuantities
    rate: LoadedQuantities


def loaded_rates(
    variations: Variations, state: LoadedState, stiffness: PairStiffness
) -> LoadedRates:
    """Return the derivatives of a loaded position by parameters.

    The equilibrium of the loaded cells, A f + g = theta R and R.f = T, is differentiated as it
    stands (`FrozenEquilibrium.rates`).

    Parameters
    ----------
    variations : Variations
        Of the position's pair.
    state : LoadedState
    stiffness : PairStiffness
        The elastic teeth of the state; they are held, a setting moves the flanks alone.

    Notes
    -----
    The strips, their cells and which cells carry are held. Inside the flanks that is exact for
    the rotation up to the cells' size: cells at the border of the contact carry no pressure. At
    the edge of a tooth they do, and that the edge moves over the cells is left out. A new
    analysis cuts other strips, and its differences scatter by what that changes. `value` is the
    equilibrium on the loaded cells without the tolerance of the contact's iteration.

    References
    ----------
    [johnson_1985 ch. 5.9] (numerical methods for elastic contact).
    """
    image = block_diag(stiffness.pinion.image, stiffness.gear.image)
    pair = variations.pair
    carrying = [loaded for loaded in state.pairs if (loaded.forces > 0.0).any()]
    cells = [FrozenCells.of(pair, loaded) for loaded in carrying]
    here = [one.geometry(pair, stiffness) for one in cells]
    held = FrozenEquilibrium.of(
        [
            frozen_compliance(
                *(one.row, one.column, one.cell, there.weights, image, stiffness.contact_modulus)
            )
            for one, there in zip(cells, here, strict=True)
        ],
        [there.gap for there in here],
        [there.arm for there in here],
        state.torque,
    )
    marked = _marked(held.forces, here)
    value = _quantities(held.rotation, held.forces, here, state.torque, marked)
    rates = []
    for k, step in enumerate(variations.steps):
        ends = [
            [one.geometry(end[k], stiffness) for one in cells]
            for end in (variations.lower, variations.upper)
        ]
        rates.append(_rates(value, held, ends, step, image, state.torque, marked))
    return LoadedRates(
        tuple(loaded.phase for loaded in carrying),
        value,
        LoadedQuantities(*(np.array([getattr(one, name) for one in rates]) for name in _NAMES)),
    )


_NAMES = (*QUANTITIES, "share")
_Marked = tuple[int, int]  # cells counted through all strips


def _rates(
    value: LoadedQuantities,
    held: FrozenEquilibrium,
    ends: list[list[CellGeometry]],
    step: float,
    image: Array,
    torque: float,
    marked: _Marked,
) -> LoadedQuantities:
    """Return the derivatives by one parameter, of which both ends are `step` away."""

    def rate(lower: Array, upper: Array) -> Array:
        return np.asarray((upper - lower) / (2.0 * step))

    def bent(geometry: CellGeometry, forces: Array) -> Array:
        return np.asarray(geometry.weights @ (image @ (geometry.weights.T @ forces)))

    pairs = list(zip(*ends, strict=True))
    turn, moves = held.rates(
        [rate(a.gap, b.gap) for a, b in pairs],
        [rate(a.arm, b.arm) for a, b in pairs],
        [rate(bent(a, f), bent(b, f)) for (a, b), f in zip(pairs, held.forces, strict=True)],
    )
    lower_value, upper_value = (
        _quantities(
            held.rotation + sign * step * turn,
            [f + sign * step * move for f, move in zip(held.forces, moves, strict=True)],
            end,
            torque,
            marked,
        )
        for sign, end in zip((-1.0, 1.0), ends, strict=True)
    )
    found = {
        name: (getattr(upper_value, name) - getattr(lower_value, name)) / (2.0 * step)
        for name in _NAMES
    }
    # a quotient of what differs by parts in a thousand over the step: by its rule
    closing = value.rotation - value.touching
    found["secant_stiffness"] = value.secant_stiffness * (
        2.0 * found["force"] / value.force - (found["rotation"] - found["touching"]) / closing
    )
    return LoadedQuantities(**found)


def _marked(forces: Sequence[Array], here: list[CellGeometry]) -> _Marked:
    """Return the cell that touches first and the one with the highest pressure."""
    touching = np.concatenate([one.gap / one.arm for one in here])
    pressure = np.concatenate([f / one.area for f, one in zip(forces, here, strict=True)])
    return int(np.argmin(touching)), int(np.argmax(pressure))


def _quantities(
    rotation: float,
    forces: Sequence[Array],
    here: list[CellGeometry],
    torque: float,
    marked: _Marked,
) -> LoadedQuantities:
    whole = np.concatenate(forces)

    def over_all(name: str) -> Array:
        return np.concatenate([getattr(one, name) for one in here])

    force = float(np.linalg.norm(whole @ over_all("normal")))
    first, highest = marked
    touching = float(over_all("gap")[first] / over_all("arm")[first])
    arm = torque / force
    total = float(whole.sum())
    return LoadedQuantities(
        rotation=rotation,
        touching=touching,
        gear_torque=float(whole @ over_all("gear_arm")),
        force=force,
        secant_stiffness=torque / (rotation - touching) / arm**2,
        pressure_max=float(whole[highest] / over_all("area")[highest]),
        sliding_loss=float(whole @ over_all("sliding")) / torque,
        s=float(whole @ over_all("s")) / total,
        t=float(whole @ over_all("t")) / total,
        share=np.array([f @ one.arm / torque for f, one in zip(forces, here, strict=True)]),
    )
