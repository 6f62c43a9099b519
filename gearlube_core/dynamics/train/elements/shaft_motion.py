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
from gearlube_core.dynamics.train.part import Element
from gearlube_core.kernels.checked_numbers import all_finite
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import LubricantState
from gearlube_core.shafts.free_modes import ShaftMotion

_MOST = 1000  # nodes, or bodies of modes
# sizes at the end of `at`, behind the body, its first node, the first body of modes and the loss
_LOST, _NODES, _BODIES = range(3, 6)
# a body of modes holds two bending modes, each towards x and then y, and an axial or torsional one
_PAIRS, _SINGLE = 2, 4
# of it at a node: deflection and slope of both pairs, deflection and twist of the single mode
_SHAPES = 6
# of it: stiffness and damping of both pairs and the single mode
_HOLDING = 6


class _Shaft(NamedTuple):
    gyroscopic: float  # 1: with gyroscopic moments, 0: without

    @kernel
    def spread(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        nodes, bodies = at[_NODES], at[_BODIES]
        for d in (0, RATE):
            b = at[0] + d
            for i in range(nodes):
                arm, m = memory[i], nodes + _SHAPES * bodies * i
                x, y, z = s[b] + arm * s[b + 4], s[b + 1] - arm * s[b + 3], s[b + 2]
                rx, ry, rz = s[b + 3], s[b + 4], s[b + 5]
                q = at[2] + d
                for _ in range(bodies):
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
                n = at[1] + BODY_STATES * i + d
                s[n], s[n + 1], s[n + 2] = x, y, z
                s[n + 3], s[n + 4], s[n + 5] = rx, ry, rz

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        body, bodies, power = at[0], at[_BODIES], 0.0
        m, q = _holding(at), at[2]
        for _ in range(bodies):
            for k in range(_SINGLE + 1):
                damping = memory[m + 3 + k // 2] * s[q + RATE + k]
                ds[q + RATE + k] -= memory[m + k // 2] * s[q + k] + damping
                power += damping * s[q + RATE + k]
            m += _HOLDING
            q += BODY_STATES
        ds[at[_LOST]] += power
        if self.gyroscopic == 0.0:
            return
        turning = s[body + W]
        from_x, from_y = _tilting(at, memory, s, m)
        ds[body + RATE + 4] -= turning * from_y
        ds[body + RATE + 3] -= turning * from_x
        q = at[2] + RATE
        for _ in range(bodies):
            for k in range(_PAIRS):
                m += 1 + _PAIRS * bodies
                from_x, from_y = _tilting(at, memory, s, m)
                ds[q + 2 * k] -= turning * from_y
                ds[q + 2 * k + 1] += turning * from_x
            q += BODY_STATES

    @kernel
    def collect(self, at: Any, memory: Array, s: Array, oil: LubricantState, ds: Array) -> None:
        nodes, bodies = at[_NODES], at[_BODIES]
        for i in range(nodes):
            f, m = at[1] + BODY_STATES * i + RATE, nodes + _SHAPES * bodies * i
            f_x, f_y, f_z = ds[f], ds[f + 1], ds[f + 2]
            m_x, m_y, m_z = ds[f + 3], ds[f + 4], ds[f + 5]
            add_wrench(ds, at[0], memory[i], (f_x, f_y, f_z), (m_x, m_y, m_z))
            q = at[2] + RATE
            for _ in range(bodies):
                for k in range(_PAIRS):
                    u, slope = memory[m + 2 * k], memory[m + 2 * k + 1]
                    ds[q + 2 * k] += u * f_x + slope * m_y
                    ds[q + 2 * k + 1] += u * f_y - slope * m_x
                ds[q + _SINGLE] += memory[m + 4] * f_z + memory[m + 5] * m_z
                m += _SHAPES
                q += BODY_STATES

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        m, q, twice = _holding(at), at[2], 0.0
        for _ in range(at[_BODIES]):
            for k in range(_SINGLE + 1):
                twice += memory[m + k // 2] * s[q + k] * s[q + k]
            m += _HOLDING
            q += BODY_STATES
        return 0.5 * twice

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        if not (1 <= at[_NODES] <= _MOST and at[_BODIES] <= _MOST):
            return 0.0
        end = _holding(at) + _HOLDING * at[_BODIES] + (1 + _PAIRS * at[_BODIES]) ** 2
        fits = memory.size == end and kept == 0
        return 1.0 if fits and all_finite(memory, 0, memory.size) else 0.0


@inside
def _holding(at: Any) -> int:
    """Return where stiffness and damping of the modes begin; behind them couples the rotation."""
    return at[_NODES] + _SHAPES * at[_NODES] * at[_BODIES]


@inside
def _tilting(at: Any, memory: Array, s: Array, row: int) -> tuple[float, float]:
    """Return a row of the gyroscopic coupling times the rates of tilts and bending modes."""
    from_x, from_y = memory[row] * s[at[0] + RATE + 4], -memory[row] * s[at[0] + RATE + 3]
    row, q = row + 1, at[2] + RATE
    for _ in range(at[_BODIES]):
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
    motion : ShaftMotion
    highest_frequency : float
        Modes of the train above it are not those of the shaft [Hz]; 0: the shaft is rigid.
    damping_ratio : float
        Of all modes [-].
    gyroscopic : bool
        Whether moments of tilting that turns with the shaft act.

    Examples
    --------
    >>> CarriedNodes.carries, CarriedNodes.losses
    (True, ('shaft_damping',))
    """

    name: str
    body: str
    nodes: str
    modes: str
    motion: ShaftMotion
    highest_frequency: float
    damping_ratio: float
    gyroscopic: bool
    kind: ClassVar = "carried_nodes"
    carries: ClassVar = True
    interpreted: ClassVar = (Listed(_Shaft, (), 6),)
    on: ClassVar = ("body", "nodes", "modes")
    losses: ClassVar = ("shaft_damping",)

    def numbers(self) -> _Shaft:
        """Return the constants of the kernels."""
        return _Shaft(float(self.gyroscopic))

    def sizes(self) -> tuple[int, ...]:
        """Return how many nodes and bodies of modes there are."""
        return self.motion.arms.size, mode_bodies(self.motion)

    def memory(self) -> Array:
        """Return arms and shapes at the nodes, then what holds the modes, gyroscopic coupling."""
        own = self.motion
        bodies, pairs = mode_bodies(own), own.bending.stiffness.size
        twisting, axial = own.torsion.stiffness.size, own.axial.stiffness.size
        shapes = np.zeros((own.arms.size, bodies, _SHAPES))
        holding = np.zeros((bodies, _HOLDING))
        for k in range(pairs):
            body, place = divmod(k, _PAIRS)
            shapes[:, body, 2 * place] = own.bending.deflection[k]
            shapes[:, body, 2 * place + 1] = own.bending.slope[k]
            holding[body, place] = own.bending.stiffness[k]
        shapes[:, :axial, 4] = own.axial.deflection.T
        shapes[:, axial : axial + twisting, 5] = own.torsion.deflection.T
        holding[: axial + twisting, 2] = [*own.axial.stiffness, *own.torsion.stiffness]
        holding[:, 3:] = 2.0 * self.damping_ratio * np.sqrt(holding[:, :3] * own.mass)
        turning = np.zeros((1 + _PAIRS * bodies,) * 2)
        turning[: 1 + pairs, : 1 + pairs] = own.gyroscopic
        return np.concatenate([own.arms, shapes.ravel(), holding.ravel(), turning.ravel()])


def mode_bodies(motion: ShaftMotion) -> int:
    """Return how many bodies hold the modes of a shaft.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.shaft import Shaft
    >>> from gearlube_core.shafts.section import ShaftSection
    >>> tube = ShaftSection(start=0.0, end=0.3, outer_diameter=0.04)
    >>> rigid = Shaft(name="rotor", sections=[tube], nodes={"gear": 0.1}, highest_frequency=0.0)
    >>> mode_bodies(rigid.motion())
    0
    """
    single = motion.axial.stiffness.size + motion.torsion.stiffness.size
    return max(-(-motion.bending.stiffness.size // _PAIRS), single)


def free_slots(motion: ShaftMotion, body: int) -> tuple[str, ...]:
    """Return the coordinates of a body of modes that stand for no mode of the shaft.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.shaft import Shaft
    >>> from gearlube_core.shafts.section import ShaftSection
    >>> tube = ShaftSection(start=0.0, end=0.3, outer_diameter=0.04)
    >>> rotor = Shaft(name="rotor", sections=[tube], nodes={"gear": 0.1}, highest_frequency=3e3)
    >>> free_slots(rotor.motion(), 0)
    ('rz',)
    """
    pairs = min(_PAIRS, max(0, motion.bending.stiffness.size - _PAIRS * body))
    single = motion.axial.stiffness.size + motion.torsion.stiffness.size
    used = {*range(2 * pairs), *((_SINGLE,) if body < single else ())}
    return tuple(one for i, one in enumerate(COORDINATES) if i not in used)
