"""Motion of a housing at its nodes by its modes, and the forces that hold these."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import (
    BODY_STATES,
    COORDINATES,
    N_COORDINATES,
    RATE,
    Listed,
)
from gearlube_core.dynamics.train.elements.held_modes import (
    HELD,
    HOLDING,
    energy_of_modes,
    hold_modes,
)
from gearlube_core.dynamics.train.part import AxisPlace, Element
from gearlube_core.housings.housing_modes import HousingMotion
from gearlube_core.kernels.checked_numbers import all_finite
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

_MOST = 1000  # nodes, or bodies of modes
# sizes at the end of `at`, behind the first node, the first body of modes and the loss
_LOST, _NODES, _BODIES = range(2, 5)
_SHAPES = HELD * N_COORDINATES  # of the modes of a body at a node


class _Housing(NamedTuple):
    unused: float  # constants of an element are at least one

    @kernel
    def spread(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        for d in (0, RATE):
            m = 0
            for i in range(at[_NODES]):
                x = y = z = rx = ry = rz = 0.0
                q = at[1] + d
                for _ in range(at[_BODIES]):
                    for k in range(HELD):
                        moved = s[q + k]
                        x += memory[m] * moved
                        y += memory[m + 1] * moved
                        z += memory[m + 2] * moved
                        rx += memory[m + 3] * moved
                        ry += memory[m + 4] * moved
                        rz += memory[m + 5] * moved
                        m += N_COORDINATES
                    q += BODY_STATES
                n = at[0] + BODY_STATES * i + d
                s[n], s[n + 1], s[n + 2] = x, y, z
                s[n + 3], s[n + 4], s[n + 5] = rx, ry, rz

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        ds[at[_LOST]] += hold_modes(memory, _holding(at), at[_BODIES], at[1], s, ds)

    @kernel
    def collect(self, at: Any, memory: Array, s: Array, oil: LubricantState, ds: Array) -> None:
        m = 0
        for i in range(at[_NODES]):
            f = at[0] + BODY_STATES * i + RATE
            f_x, f_y, f_z = ds[f], ds[f + 1], ds[f + 2]
            m_x, m_y, m_z = ds[f + 3], ds[f + 4], ds[f + 5]
            q = at[1] + RATE
            for _ in range(at[_BODIES]):
                for k in range(HELD):
                    force = memory[m] * f_x + memory[m + 1] * f_y + memory[m + 2] * f_z
                    moment = memory[m + 3] * m_x + memory[m + 4] * m_y + memory[m + 5] * m_z
                    ds[q + k] += force + moment
                    m += N_COORDINATES
                q += BODY_STATES

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        return energy_of_modes(memory, _holding(at), at[_BODIES], at[1], s)

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        if not (1 <= at[_NODES] <= _MOST and at[_BODIES] <= _MOST):
            return 0.0
        fits = memory.size == _holding(at) + HOLDING * at[_BODIES] and kept == 0
        return 1.0 if fits and all_finite(memory, 0, memory.size) else 0.0


@inside
def _holding(at: Any) -> int:
    """Return where stiffness and damping of the modes begin."""
    return _SHAPES * at[_NODES] * at[_BODIES]


@dataclass(frozen=True, slots=True, kw_only=True)
class CarriedInterface(Element):
    """Nodes that a housing carries by its modes; see `Housing`, which makes it.

    Parameters
    ----------
    name, nodes, modes : str
        Of itself, of its first node and the first body of modes.
    places : tuple of AxisPlace
        Of its nodes in the housing.
    motion : HousingMotion
    highest_frequency : float
        Of its modes [Hz].

    Examples
    --------
    >>> CarriedInterface.carries, CarriedInterface.losses
    (True, ('housing_damping',))
    """

    name: str
    nodes: str
    modes: str
    places: tuple[AxisPlace, ...]
    motion: HousingMotion
    highest_frequency: float
    kind: ClassVar = "carried_interface"
    carries: ClassVar = True
    interpreted: ClassVar = (Listed(_Housing, (), 5),)
    linear: ClassVar = True
    on: ClassVar = ("nodes", "modes")
    losses: ClassVar = ("housing_damping",)

    def between_axes(self) -> tuple[AxisPlace, ...]:
        """Return where its nodes are."""
        return self.places

    def numbers(self) -> _Housing:
        """Return the constants of the kernels."""
        return _Housing(0.0)

    def sizes(self) -> tuple[int, ...]:
        """Return how many nodes and bodies of modes there are."""
        return self.motion.shapes.shape[1], len(free_modes(self.motion))

    def memory(self) -> Array:
        """Return shapes at the nodes, then stiffness and damping of the modes."""
        modes, nodes, _ = self.motion.shapes.shape
        bodies = len(free_modes(self.motion))
        shapes = np.zeros((nodes, bodies * HELD, N_COORDINATES))
        shapes[:, :modes] = self.motion.shapes.transpose(1, 0, 2)
        holding = np.zeros((bodies * HELD, 2))
        holding[:modes] = np.column_stack([self.motion.stiffness, self.motion.damping])
        return np.concatenate([shapes.ravel(), holding.ravel()])


def free_modes(motion: HousingMotion) -> list[tuple[str, ...]]:
    """Return the coordinates that stand for no mode, of each body that holds modes.

    Examples
    --------
    >>> seven = HousingMotion(1.0, np.zeros((7, 1, 6)), np.zeros(7), np.zeros(7))
    >>> free_modes(seven)
    [('rz',), ('z', 'rx', 'ry', 'rz')]
    """
    modes = motion.stiffness.size
    return [COORDINATES[min(HELD, modes - first) :] for first in range(0, modes, HELD)]
