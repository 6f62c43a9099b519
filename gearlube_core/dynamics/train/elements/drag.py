"""Drag without load on a body: of seals, and of a gear in its oil."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.drag import (
    CHURNING_LAWS,
    ChurningConstants,
    ChurningLaw,
    Immersion,
    OilVolume,
    RingDiameter,
    RingWidth,
    SealTorque,
    churning_torque,
    seal_drag,
)
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.part import Element
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Output
from gearlube_core.oil.lubricant_state import LubricantState


# kernels of both, whose memory is the torque of the present step
@kernel
def _brake(
    self: Any, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
) -> None:
    body, lost = at
    ds[body + RATE + RZ] -= memory[0]
    ds[lost] += memory[0] * s[body + W]


@kernel
def _write(
    self: Any, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
) -> None:
    out[first] = memory[0]


@kernel
def _check(self: Any, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
    return 1.0 if memory.size == 1 else 0.0


class _Seal(NamedTuple):
    torque: float  # [N.m]
    add_forces, write, check = _brake, _write, _check  # type: ignore[misc]

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        memory[0] = seal_drag(s[at[0] + W], self.torque)
        return 0.0


class _Churning(NamedTuple):
    gear: ChurningConstants
    add_forces, write, check = _brake, _write, _check  # type: ignore[misc]

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        density = oil.eta0 / oil.nu
        memory[0] = churning_torque(s[at[0] + W], oil.nu, density, self.gear)
        return 0.0


class _Brake(Element):
    on: ClassVar = ("body",)
    outputs: ClassVar = (Output("torque", "N.m", "drag"),)

    def memory(self) -> Array:
        """Return room for the torque of the present step."""
        return np.zeros(1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Seal(_Brake):
    """Seal of a shaft, see `seal_torque`.

    Parameters
    ----------
    name, body : str
    torque : float
        [N.m], 0 to 100.

    Examples
    --------
    >>> from gearlube_core.drag import seal_torque
    >>> round(Seal(name="seal", body="input", torque=seal_torque(0.04)).numbers().torque, 3)
    0.149
    """

    name: str
    body: str
    torque: SealTorque
    kind: ClassVar = "seal"
    interpreted: ClassVar = (Listed(_Seal, (), 2),)
    losses: ClassVar = ("seals",)

    def numbers(self) -> _Seal:
        """Return the constants of the kernels."""
        return _Seal(float(self.torque))


@dataclass(frozen=True, slots=True, kw_only=True)
class Churning(_Brake):
    """A gear that turns in the oil.

    Parameters
    ----------
    name, body : str
    law : {"changenet_velex_2007", "boness_1989", "iso_tr_14179_2"}
        See `churning_torque`.
    ring_diameter, ring_width : float
        Outside diameter and width of the teeth [m].
    immersion : float
        Depth of the lowest tooth below the oil at rest [m].
    oil_volume : float
        [m3]

    Examples
    --------
    >>> sump = Churning(name="sump", body="gear", law="boness_1989", ring_diameter=0.2,
    ...                 ring_width=0.03, immersion=0.04, oil_volume=1e-3)
    >>> sump.numbers().gear.immersion
    0.04
    """

    name: str
    body: str
    law: ChurningLaw
    ring_diameter: RingDiameter
    ring_width: RingWidth
    immersion: Immersion
    oil_volume: OilVolume
    kind: ClassVar = "churning"
    interpreted: ClassVar = (Listed(_Churning, (), 2),)
    losses: ClassVar = ("churning",)

    def numbers(self) -> _Churning:
        """Return the constants of the kernels."""
        sizes = self.ring_diameter, self.ring_width, self.immersion, self.oil_volume
        law = float(CHURNING_LAWS.index(self.law))
        return _Churning(ChurningConstants(law, *(float(one) for one in sizes)))
