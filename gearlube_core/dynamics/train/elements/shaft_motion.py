"""Motion of a shaft at its nodes, rigid and by modes, and the forces that hold its modes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import (
    BODY_STATES,
    COORDINATES,
    RATE,
    Listed,
    W,
    add_wrench,
)
from gearlube_core.dynamics.train.elements.held_modes import (
    HELD,
    HOLDING,
    energy_of_modes,
    hold_modes,
)
from gearlube_core.dynamics.train.part import AxisPlace, Element
from gearlube_core.kernels.checked_numbers import all_finite
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.shafts.free_modes import ShaftMotion
from gearlube_core.shafts.section import ShaftSection

_MOST = 1000  # nodes, or bodies of modes
# sizes at the end of `at`, behind the body, its first node, the first body of modes and the loss
_LOST, _NODES, _BODIES, _BENT = range(3, 7)
# the first bodies of modes hold two bending modes, each towards x and then y, and an axial or
# torsional one; those behind them five axial or torsional ones
_PAIRS, _SINGLE = 2, 4
# of both at a node: deflection and slope of bending modes, deflection and twist of single ones
_SHAPES, _STRAIGHT = 2 * _PAIRS + 2, 2 * HELD


class _Shaft(NamedTuple):
    gyroscopic: float  # 1: with gyroscopic moments, 0: without
    bent: float  # as among the sizes: a damaged file has another one

    @kernel
    def spread(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        nodes, row = at[_NODES], _row(at)
        for d in (0, RATE):
            b = at[0] + d
            for i in range(nodes):
                arm, m = memory[i], nodes + row * i
                x, y, z = s[b] + arm * s[b + 4], s[b + 1] - arm * s[b + 3], s[b + 2]
                rx, ry, rz = s[b + 3], s[b + 4], s[b + 5]
                q = at[2] + d
                for _ in range(at[_BENT]):
                    for k in range(_PAIRS):
                        u, slope = memory[m + 2 * k], memory[m + 2 * k + 1]
                        x += u * s[q + 2 * k]
                        ry += slope * s[q + 2 * k]
                        y += u * s[q + 2 * k + 1]
                        rx -= slope * s[q + 2 * k + 1]
                    z += memory[m + 4] * s[q + _SINGLE]
                    rz += memory[m + 5] * s[q + _SINGLE]
                    m += _SHAPES
                    q += BODY_STATES
                for _ in range(at[_BODIES] - at[_BENT]):
                    for k in range(HELD):
                        z += memory[m + 2 * k] * s[q + k]
                        rz += memory[m + 2 * k + 1] * s[q + k]
                    m += _STRAIGHT
                    q += BODY_STATES
                n = at[1] + BODY_STATES * i + d
                s[n], s[n + 1], s[n + 2] = x, y, z
                s[n + 3], s[n + 4], s[n + 5] = rx, ry, rz

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        ds[at[_LOST]] += hold_modes(memory, _holding(at), at[_BODIES], at[2], s, ds)
        if self.gyroscopic == 0.0:
            return
        body, bent, m = at[0], at[_BENT], _holding(at) + HOLDING * at[_BODIES]
        turning = s[body + W]
        from_x, from_y = _tilting(at, memory, s, m)
        ds[body + RATE + 4] -= turning * from_y
        ds[body + RATE + 3] -= turning * from_x
        q = at[2] + RATE
        for _ in range(bent):
            for k in range(_PAIRS):
                m += 1 + _PAIRS * bent
                from_x, from_y = _tilting(at, memory, s, m)
                ds[q + 2 * k] -= turning * from_y
                ds[q + 2 * k + 1] += turning * from_x
            q += BODY_STATES

    @kernel
    def collect(self, at: Any, memory: Array, s: Array, oil: LubricantState, ds: Array) -> None:
        nodes, row = at[_NODES], _row(at)
        for i in range(nodes):
            f, m = at[1] + BODY_STATES * i + RATE, nodes + row * i
            f_x, f_y, f_z = ds[f], ds[f + 1], ds[f + 2]
            m_x, m_y, m_z = ds[f + 3], ds[f + 4], ds[f + 5]
            add_wrench(ds, at[0], memory[i], (f_x, f_y, f_z), (m_x, m_y, m_z))
            q = at[2] + RATE
            for _ in range(at[_BENT]):
                for k in range(_PAIRS):
                    u, slope = memory[m + 2 * k], memory[m + 2 * k + 1]
                    ds[q + 2 * k] += u * f_x + slope * m_y
                    ds[q + 2 * k + 1] += u * f_y - slope * m_x
                ds[q + _SINGLE] += memory[m + 4] * f_z + memory[m + 5] * m_z
                m += _SHAPES
                q += BODY_STATES
            for _ in range(at[_BODIES] - at[_BENT]):
                for k in range(HELD):
                    ds[q + k] += memory[m + 2 * k] * f_z + memory[m + 2 * k + 1] * m_z
                m += _STRAIGHT
                q += BODY_STATES

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        return energy_of_modes(memory, _holding(at), at[_BODIES], at[2], s)

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        if not (1 <= at[_NODES] <= _MOST and at[_BENT] <= at[_BODIES] <= _MOST):
            return 0.0
        end = _holding(at) + HOLDING * at[_BODIES] + (1 + _PAIRS * at[_BENT]) ** 2
        fits = memory.size == end and kept == 0 and self.bent == float(at[_BENT])
        return 1.0 if fits and all_finite(memory, 0, memory.size) else 0.0


@inside
def _row(at: Any) -> int:
    """Return how many numbers the shapes at a node have."""
    return _SHAPES * at[_BENT] + _STRAIGHT * (at[_BODIES] - at[_BENT])


@inside
def _holding(at: Any) -> int:
    """Return where stiffness and damping of the modes begin; behind them couples the rotation."""
    return at[_NODES] + at[_NODES] * _row(at)


@inside
def _tilting(at: Any, memory: Array, s: Array, row: int) -> tuple[float, float]:
    """Return a row of the gyroscopic coupling times the rates of tilts and bending modes."""
    from_x, from_y = memory[row] * s[at[0] + RATE + 4], -memory[row] * s[at[0] + RATE + 3]
    row, q = row + 1, at[2] + RATE
    for _ in range(at[_BENT]):
        for k in range(_PAIRS):
            from_x += memory[row + k] * s[q + 2 * k]
            from_y += memory[row + k] * s[q + 2 * k + 1]
        row += _PAIRS
        q += BODY_STATES
    return from_x, from_y


@dataclass(frozen=True, slots=True, kw_only=True)
class CarriedNodes(Element):
    """Nodes that a shaft carries, and its modes; see `Shaft`, which makes it.

    Parameters
    ----------
    name, body, nodes, modes : str
        Of itself, of the rigid body, its first node and the first body of modes.
    places : tuple of AxisPlace
        Of its nodes on the body.
    motion : ShaftMotion
    highest_frequency : float
        Modes of the train above it are not those of the shaft [Hz]; 0: the shaft is rigid.
    damping_ratio : float
        Of all modes [-].
    gyroscopic : bool
        Whether moments of tilting that turns with the shaft act.
    sections : tuple of ShaftSection
        For pictures.

    Examples
    --------
    >>> CarriedNodes.carries, CarriedNodes.losses
    (True, ('shaft_damping',))
    """

    name: str
    body: str
    nodes: str
    modes: str
    places: tuple[AxisPlace, ...]
    motion: ShaftMotion
    highest_frequency: float
    damping_ratio: float
    gyroscopic: bool
    sections: tuple[ShaftSection, ...] = ()
    kind: ClassVar = "carried_nodes"
    carries: ClassVar = True
    interpreted: ClassVar = (Listed(_Shaft, (), 7),)
    linear: ClassVar = True
    on: ClassVar = ("body", "nodes", "modes")
    losses: ClassVar = ("shaft_damping",)

    def between_axes(self) -> tuple[AxisPlace, ...]:
        """Return where its nodes are."""
        return self.places

    def numbers(self) -> _Shaft:
        """Return the constants of the kernels."""
        return _Shaft(float(self.gyroscopic), float(_bent(self.motion)))

    def sizes(self) -> tuple[int, ...]:
        """Return how many nodes, bodies of modes, and those of bending modes there are."""
        return self.motion.arms.size, len(mode_bodies(self.motion)), _bent(self.motion)

    def memory(self) -> Array:
        """Return arms and shapes at the nodes, then what holds the modes, gyroscopic coupling."""
        own, bent = self.motion, _bent(self.motion)
        straight, pairs = len(mode_bodies(own)) - bent, own.bending.stiffness.size
        nodes, axial = own.arms.size, own.axial.stiffness.size
        shapes = np.zeros((nodes, 2, _PAIRS * bent))
        shapes[:, 0, :pairs] = own.bending.deflection.T
        shapes[:, 1, :pairs] = own.bending.slope.T
        single = np.zeros((nodes, bent + HELD * straight, 2))
        single[:, :axial, 0] = own.axial.deflection.T
        single[:, axial : axial + own.torsion.stiffness.size, 1] = own.torsion.deflection.T
        of_bent = shapes.transpose(0, 2, 1).reshape(nodes, bent, 2 * _PAIRS)
        rows = np.concatenate([of_bent, single[:, :bent]], axis=2).reshape(nodes, -1)
        rows = np.hstack([rows, single[:, bent:].reshape(nodes, -1)])
        held = np.zeros(_PAIRS * bent)
        held[:pairs] = own.bending.stiffness
        alone = np.zeros(bent + HELD * straight)
        both = [*own.axial.stiffness, *own.torsion.stiffness]
        alone[: len(both)] = both
        towards = np.repeat(held.reshape(bent, _PAIRS), 2, axis=1)  # x and y are alike
        stiffness = np.append(np.column_stack([towards, alone[:bent]]), alone[bent:])
        damping = 2.0 * self.damping_ratio * np.sqrt(stiffness * own.mass)
        holding = np.column_stack([stiffness, damping])
        turning = np.zeros((1 + _PAIRS * bent,) * 2)
        turning[: 1 + pairs, : 1 + pairs] = own.gyroscopic
        return np.concatenate([own.arms, rows.ravel(), holding.ravel(), turning.ravel()])


def _bent(motion: ShaftMotion) -> int:
    """Return how many bodies hold bending modes."""
    return -(-motion.bending.stiffness.size // _PAIRS)


def mode_bodies(motion: ShaftMotion) -> list[tuple[str, ...]]:
    """Return the bodies that hold the modes of a shaft: the coordinates that each leaves out.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.shaft import Shaft
    >>> from gearlube_core.shafts.section import ShaftSection
    >>> tube = ShaftSection(start=0.0, end=0.3, outer_diameter=0.04)
    >>> shaft = {"name": "rotor", "sections": [tube], "nodes": {"gear": 0.1}}
    >>> mode_bodies(Shaft(**shaft, highest_frequency=0.0).motion())
    []
    >>> mode_bodies(Shaft(**shaft, highest_frequency=3e3).motion())
    [('rz',), ('z', 'rx', 'rz')]
    """
    pairs, bent = motion.bending.stiffness.size, _bent(motion)
    single = motion.axial.stiffness.size + motion.torsion.stiffness.size
    used = [
        {*range(2 * min(_PAIRS, pairs - _PAIRS * i)), *((_SINGLE,) if i < single else ())}
        for i in range(bent)
    ]
    rest = range(bent, single, HELD)
    used += [set(range(min(HELD, single - first))) for first in rest]
    return [tuple(one for i, one in enumerate(COORDINATES) if i not in own) for own in used]
