"""Outputs of `HelicalPairModel`: their names, which are the FMU's contract, out of its train's.

Places are those of the list of `helical_pair`: in the state of the train, and in what the kernel of
trains writes for WRITE and EXCHANGE.
"""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_model.pair import BEARING_FIELDS, N_BEARINGS
from gearlube_core.dynamics.helical_pair.march.flanks import N_FRICTION
from gearlube_core.dynamics.helical_pair.march.line_outputs import LINE_BOUNDS, LINE_OUTPUTS
from gearlube_core.dynamics.mean_power import mean_power
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS
from gearlube_core.dynamics.train.element import BODY_STATES, RATE, RZ, W
from gearlube_core.dynamics.train.elements import held_port
from gearlube_core.dynamics.train.elements.held_port import N_KEPT, PINION_HOLD_TORQUE
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.outputs import IDLE_WORK, TURNING
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Output

MEMBERS = ("pinion", "wheel")

# places in the state of the train
PINION, WHEEL = 0, BODY_STATES
PSI = 2 * BODY_STATES  # relative rotation along the line of action [m]
WORKS = PSI + 1  # of pinion and wheel; then losses: friction, dampers of the mesh, of the bearings
N_ENERGIES = 5
N_INTEGRATED = WORKS + N_ENERGIES
TORQUES = N_INTEGRATED  # of the ports on pinion and, behind what the first one keeps, wheel [N.m]
SPEED_REFERENCE = TORQUES + held_port.REFERENCE  # [rad/s]
HOLD_TORQUE = TORQUES + held_port.HOLD_TORQUE  # of the holder of that speed [N.m]
WHEEL_TORQUE = TORQUES + N_KEPT
LOAD_TORQUE = WHEEL_TORQUE + 1  # filtered, selects the level of the line mesh [N.m]
MARKS = LOAD_TORQUE + 1 + N_FRICTION  # energies at the start of the last step [J]
DURATION = MARKS + N_ENERGIES  # of that step [s]
N_STATE = DURATION + 1


def _moves(member: str, *quantities: str) -> tuple[str, ...]:
    return tuple(
        f"{member}.{q}.{c}" for q, axes in zip(quantities, ("xyz", "xy"), strict=True) for c in axes
    )


# continuous states, their places and senses: the pinion turns about -z of the train, and the work
# of the wheel is taken out
_STATES: dict[str, tuple[int, float]] = {
    "mesh.rotation": (PSI, 1.0),
    "pinion.speed": (PINION + W, -1.0),
    "wheel.speed": (WHEEL + W, 1.0),
    "pinion.angle": (PINION + RZ, -1.0),
    "wheel.angle": (WHEEL + RZ, 1.0),
    **{
        name: (body + rate + i, 1.0)
        for rate, quantities in ((0, ("displacement", "tilt")), (RATE, ("velocity", "tilt_speed")))
        for body, member in zip((PINION, WHEEL), MEMBERS, strict=True)
        for i, name in enumerate(_moves(member, *quantities))
    },
    "energy.pinion_work": (WORKS, 1.0),
    "energy.wheel_work": (WORKS + 1, -1.0),
    "energy.friction": (WORKS + 2, 1.0),
    "energy.mesh_damping": (WORKS + 3, 1.0),
    "energy.bearing_damping": (WORKS + 4, 1.0),
    "mesh.load_torque": (LOAD_TORQUE, 1.0),
}
STATE_NAMES = tuple(_STATES)
RATE_NAMES = tuple(f"der({name})" for name in STATE_NAMES)
EVENT_INDICATORS = tuple(one.name for one in HelicalMesh.events)

BEARING_QUANTITIES = ("force.x", "force.y", "force.z")
_OUTPUTS: tuple[str, ...] = (
    *("pinion.angle", "wheel.angle", "pinion.speed", "wheel.speed"),
    *("pinion.acceleration", "wheel.acceleration"),
    *("mesh.dte", "mesh.load", "mesh.force.x", "mesh.force.y", "mesh.force.z"),
    *("mesh.separated", "mesh.coast_contact", "mesh.stiffness", "mesh.frequency"),
    *("mesh.film_thickness_min", "film.share_outside"),
    *("friction.power_loss_bound", "efficiency_bound"),
    *LINE_BOUNDS,
    *LINE_OUTPUTS,
    *("friction.power_loss", "damping.power_loss", "bearing.power_loss"),
    *("efficiency", "pair.efficiency"),
    *(name for member in MEMBERS for name in _moves(member, "displacement", "tilt")),
    *(f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in BEARING_QUANTITIES),
    *(f"energy.{one}" for one in ("pinion_work", "wheel_work")),
    *(f"energy.{one}" for one in ("friction", "mesh_damping", "bearing_damping", "stored")),
    *RANGE_OUTPUTS,
)
# outputs that the table of the FMU's variables takes from here, with unit and text
OWN_OUTPUTS: tuple[Output, ...] = (PINION_HOLD_TORQUE,)
# for another integrator: the other states, the rates of all, and the event indicators
_OTHER_STATES = tuple(name for name in STATE_NAMES if name not in _OUTPUTS)
OUTPUT_NAMES = (
    *_OUTPUTS,
    *_OTHER_STATES,
    *RATE_NAMES,
    *EVENT_INDICATORS,
    *(one.name for one in OWN_OUTPUTS),
)
OUTPUT_INDEX = {name: index for index, name in enumerate(OUTPUT_NAMES)}
ENERGIES = OUTPUT_INDEX["energy.pinion_work"]  # then wheel, losses, stored
_FRICTION_LOSS = OUTPUT_INDEX["friction.power_loss"]
_EFFICIENCY = OUTPUT_INDEX["efficiency"]
_BEARINGS = OUTPUT_INDEX["bearing[1].force.x"]
RATES, _EVENTS = OUTPUT_INDEX[RATE_NAMES[0]], OUTPUT_INDEX[EVENT_INDICATORS[0]]

# what an input changes at once while no step has been taken
POWERS = frozenset(OUTPUT_NAMES[_FRICTION_LOSS : _FRICTION_LOSS + 5])
# what follows from the state alone
MOTION_OUTPUTS = POWERS.union(
    STATE_NAMES,
    ("mesh.dte", "mesh.frequency"),
    OUTPUT_NAMES[_BEARINGS : _BEARINGS + N_BEARINGS * len(BEARING_QUANTITIES)],
)

# continuous states in the outputs and in the state of the train, and their senses
_TO = np.array([OUTPUT_INDEX[name] for name in STATE_NAMES])
STATE_PLACES = np.array([place for place, _ in _STATES.values()])
SENSES = np.array([sense for _, sense in _STATES.values()])
# of rates in what EXCHANGE writes: that of the load level is behind the integrated states
_RATE_PLACES = np.minimum(STATE_PLACES, N_INTEGRATED)
_N_EVENTS = len(EVENT_INDICATORS)
# in what WRITE writes: outputs of the bodies begin here, behind them those of input and mesh
_WRITTEN = N_INTEGRATED + 1 + _N_EVENTS
_OF_INPUT = len(held_port.HeldPort.outputs)
_OF_MESH = tuple(one.name for one in HelicalMesh.outputs)
_NAMED = tuple(f"mesh.{one}" if f"mesh.{one}" in OUTPUT_NAMES else one for one in _OF_MESH)
_COPIED = np.array([i for i, name in enumerate(_NAMED) if name in OUTPUT_NAMES])
_COPIED_TO = np.array([OUTPUT_INDEX[name] for name in _NAMED if name in OUTPUT_NAMES])
_BOUND = _OF_MESH.index("friction_bound_relative")
# from the mesh: two supports, powers of all energies, efficiency, energies
_STORED = len(_OF_MESH) + 2 * len(SpringSupport.outputs) + 2 * N_ENERGIES + 1

_HOLD_TORQUE = OUTPUT_INDEX[PINION_HOLD_TORQUE.name]
_ACCELERATION = OUTPUT_INDEX["pinion.acceleration"]
_DTE, _FREQUENCY = OUTPUT_INDEX["mesh.dte"], OUTPUT_INDEX["mesh.frequency"]
_LOSS_BOUND = OUTPUT_INDEX["friction.power_loss_bound"]


@kernel
def write_bearings(s: Array, bearings: Array, out: Array) -> None:
    """Write the forces of the four bearings on their shafts, from `bearing_shares`."""
    for j in range(N_BEARINGS):
        u = PINION if j < 2 else WHEEL
        v, b, to = u + RATE, j * BEARING_FIELDS, _BEARINGS + 3 * j
        out[to] = -(bearings[b] * s[u] + bearings[b + 1] * s[u + 4] + bearings[b + 5] * s[v])
        out[to + 1] = -(
            bearings[b + 2] * s[u + 1] + bearings[b + 3] * s[u + 3] + bearings[b + 6] * s[v + 1]
        )
        out[to + 2] = -(bearings[b + 4] * s[u + 2] + bearings[b + 7] * s[v + 2])


@kernel
def write_losses(s: Array, rates: Array, out: Array) -> None:
    """Write powers lost and efficiencies, averaged over the last communication step.

    Before the first step: instantaneous. Efficiency is 1 - loss/input with the work put in at the
    side that drives; 0 where no work is put in.
    """
    duration, lost = s[DURATION], 0.0
    for i in range(2, N_ENERGIES):
        power = mean_power(s, rates, WORKS + i, MARKS + i, duration)
        out[_FRICTION_LOSS + i - 2] = power
        lost += power
    idle_power = IDLE_WORK * (1.0 / duration) if duration > 0.0 else IDLE_WORK
    put_in = mean_power(s, rates, WORKS, MARKS, duration)
    if put_in <= 0.0:
        put_in = mean_power(s, rates, WORKS + 1, MARKS + 1, duration)
    out[_EFFICIENCY] = out[_EFFICIENCY + 1] = 0.0
    if put_in > idle_power:
        out[_EFFICIENCY] = 1.0 - out[_FRICTION_LOSS] / put_in
        out[_EFFICIENCY + 1] = 1.0 - lost / put_in


@kernel
def write_motion(s: Array, rates: Array, teeth: float, bearings: Array, out: Array) -> None:
    """Write `MOTION_OUTPUTS`.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        State of the train.
    rates : ndarray
        Its rates; read before the first step only.
    teeth : float
        Number of pinion teeth [-].
    bearings : ndarray of shape (N_BEARINGS * BEARING_FIELDS,)
        Shares of the bearings, see `write_bearing_shares`.
    out : ndarray of shape (len(OUTPUT_NAMES),)
    """
    for i in range(_TO.size):
        out[_TO[i]] = 0.0 + SENSES[i] * s[STATE_PLACES[i]]  # no negative zeros
    out[_DTE] = s[PSI] + s[PINION] - s[WHEEL]
    out[_FREQUENCY] = -teeth * s[PINION + W] / (2.0 * math.pi)
    write_losses(s, rates, out)
    write_bearings(s, bearings, out)


@kernel
def write_derivatives(work: Array, out: Array) -> None:
    """Write the rates of the continuous states and the event indicators that EXCHANGE has left."""
    for i in range(_RATE_PLACES.size):
        out[RATES + i] = 0.0 + SENSES[i] * work[_RATE_PLACES[i]]
    for i in range(_N_EVENTS):
        out[_EVENTS + i] = work[N_INTEGRATED + 1 + i]


@kernel
def write_pair(s: Array, free: int, teeth: float, bearings: Array, work: Array, out: Array) -> None:
    """Write all outputs, in the order of OUTPUT_NAMES, from what WRITE has left in `work`.

    `free` are the coordinates of a member, besides its rotation, that are not held; other arguments
    as in `write_motion`.
    """
    write_derivatives(work, out)
    write_motion(s, work, teeth, bearings, out)
    mesh = _WRITTEN + 2 * (len(TURNING) + free) + _OF_INPUT
    for i in range(_COPIED.size):
        out[_COPIED_TO[i]] = work[mesh + _COPIED[i]]
    out[_ACCELERATION] = 0.0 - work[PINION + W]
    out[_ACCELERATION + 1] = work[WHEEL + W]
    out[_HOLD_TORQUE] = s[HOLD_TORQUE]
    bound = work[mesh + _BOUND]
    out[_LOSS_BOUND] = bound * abs(out[_FRICTION_LOSS])
    lossy = out[_EFFICIENCY] > 0.0
    out[_LOSS_BOUND + 1] = bound * (1.0 - out[_EFFICIENCY]) if lossy else 0.0
    out[ENERGIES + N_ENERGIES] = work[mesh + _STORED]
