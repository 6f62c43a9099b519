"""Modal coordinates of a body, five to each body of modes, and the forces that hold them."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import BODY_STATES, RATE
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel

HELD = 5  # coordinates of a body that can be modes; the sixth, rz, turns on
HOLDING = 2 * HELD  # numbers of a body in a memory: stiffness and damping of each, in turn


@inside
def hold_modes(memory: Array, m: int, bodies: int, q: int, s: Array, ds: Array) -> float:
    """Add the forces of springs and dampers to modes; return the power of the dampers [W].

    `m` is the place of the first stiffness in the memory, `q` that of the first body of modes.
    """
    power = 0.0
    for _ in range(bodies):
        for k in range(HELD):
            damping = memory[m + 1] * s[q + RATE + k]
            ds[q + RATE + k] -= memory[m] * s[q + k] + damping
            power += damping * s[q + RATE + k]
            m += 2
        q += BODY_STATES
    return power


@kernel
def energy_of_modes(memory: Array, m: int, bodies: int, q: int, s: Array) -> float:
    """Return the energy of these springs [J]."""
    twice = 0.0
    for _ in range(bodies):
        for k in range(HELD):
            twice += memory[m] * s[q + k] * s[q + k]
            m += 2
        q += BODY_STATES
    return 0.5 * twice
