"""A rotating mass with drag as a native FMU: small, with an exact solution and every refusal.

In model exchange there is a wall at the angle WALL too: what arrives there turns back.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from fmu_src.definition import Definition
from fmu_src.native.model import Exchange, NativeModel
from fmu_src.object_code import array_at
from fmu_src.variable import (
    Variable,
    count,
    input_,
    local,
    option,
    options_by_number,
    output,
    parameter,
    ranges,
    rates,
)
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS, Range

START, STEP, RESUME, MOTION, DERIVATIVES, EVENT = 0, 1, 3, 4, 5, 6
TURNED, SPEED, TORQUE, LOAD, OIL, LIMIT, N_STATE = range(7)
INERTIA, DRAG, SPEED_START, LAW, SUBSTEPS, BRAKED, N_PARAMETERS = range(7)
N_RANGES = len(RANGE_OUTPUTS) - 1
LIMITS_AT, RANGES_AT, DRAG_AT = 0, 6, 6 + 2 * N_RANGES
N_WORK = DRAG_AT + 1
FASTEST = 1000.0  # rad/s, above it a step is refused
WALL = 20.0  # rad
SINGULAR_OIL, HIDDEN_OIL = 400.0, 401.0  # K, where an output, or the state alone, is infinite

NO_DRAG, TOO_MUCH, TOO_FAST = 1, 2, 3
REFUSALS = {
    NO_DRAG: 'drag.coefficient must be above 0 with the law "squared" \\ got 0??/',
    TOO_MUCH: "the torques have no equilibrium",
    TOO_FAST: "the speed would leave the range of the model",
}

_FREE = (
    input_("pinion.torque", "N.m", "Torque that drives", start=3.0, minimum=-50.0, maximum=50.0),
    input_("wheel.torque", "N.m", "Torque that resists", start=1.0, minimum=-50.0, maximum=50.0),
    input_("oil.temperature", "K", "Temperature of the oil", start=313.15, minimum=273.15,
           maximum=423.15, display_unit="degC"),
    parameter("mass.inertia", "1", "Inertia over 1 kg.m2", start=0.5, minimum=0.01, maximum=100.0,
              argument="inertia"),
    parameter("drag.coefficient", "1", "Drag over 1 N.m.s/rad", start=0.25, minimum=0.0,
              maximum=10.0, argument="drag"),
    parameter("pinion.speed_start", "rad/s", "Speed at the start", start=2.0, minimum=-500.0,
              maximum=500.0, argument="speed"),
    option("drag.law", "Law of the drag", "linear", "squared", start="linear", argument="law"),
    count("solver.substeps", "Substeps of a step", 16, 1, 1000, "substeps"),
    Variable(name="drag.braked", type="Boolean", causality="parameter", start=0.0,
             description="Whether the drag is doubled", argument="braked"),
)  # fmt: skip
_OUTPUTS = (
    output("pinion.angle", "rad", "Rotation of the pinion"),
    output("pinion.speed", "rad/s", "Speed of the pinion"),
    output("wheel.angle", "rad", "Rotation of the wheel"),
    output("wheel.speed", "rad/s", "Speed of the wheel"),
    Variable(name="mass.forward", type="Boolean", causality="output",
             description="True while the speed is above 0"),
    Variable(name="mass.turns", type="Integer", causality="output",
             description="Whole turns since the start"),
    *(output(f"disc[{i}].power", "W", f"Drag power of disc {i}") for i in (1, 2, 3)),
    output("oil.ratio", "1", "Infinite at one temperature"),
    *ranges(),
)  # fmt: skip
_LOCALS = (
    *rates([_OUTPUTS[0], _OUTPUTS[1]]),
    local("event.wall", "1", "Angle beyond the wall over 1 rad"),
)
VARIABLES = (*_FREE, *_OUTPUTS, *options_by_number(_FREE), *_LOCALS)
OUTPUT_NAMES = tuple(variable.name for variable in _OUTPUTS + _LOCALS)
N_OUTPUTS = len(OUTPUT_NAMES)
EXCHANGE = Exchange(
    states=("pinion.angle", "pinion.speed"),
    places=(0, 1),
    units=(1.0, 1.0),
    indicators=("event.wall",),
    inputs_at=TORQUE,
    of_states=frozenset({"wheel.angle", "wheel.speed", "disc[1].power", "disc[2].power",
                         "disc[3].power"}),
)  # fmt: skip
FIRST_RATE = OUTPUT_NAMES.index("der(pinion.angle)")
FIRST_RANGE = OUTPUT_NAMES.index(RANGE_OUTPUTS[0])
RANGES = tuple(
    Range(name, f"the {name.split('.')[1]}", -30.0, 30.0, "N.m", "Use less torque.")
    for name in RANGE_OUTPUTS[1:]
)


def entry(operation, step, data, parameters, inputs, state, work, outputs):  # type: ignore[no-untyped-def]
    """Do one operation of the model, as `NativeModel.entry` says; torque range of 30 N.m."""
    p, u, s = array_at(parameters, N_PARAMETERS), array_at(inputs, 3), array_at(state, N_STATE)
    w, out, constants = array_at(work, N_WORK), array_at(outputs, N_OUTPUTS), array_at(data, 2)
    squared = p[LAW] == 2.0
    if operation in (START, RESUME):
        w[DRAG_AT] = p[DRAG] * (2.0 if p[BRAKED] != 0.0 else 1.0)
        for i in range(2):
            w[LIMITS_AT + 2 * i] = -constants[0]
            w[LIMITS_AT + 2 * i + 1] = constants[0]
        w[LIMITS_AT + 4] = 280.0
        w[LIMITS_AT + 5] = 420.0
        for i in range(N_RANGES):
            w[RANGES_AT + 2 * i] = -constants[1]
            w[RANGES_AT + 2 * i + 1] = constants[1]
        if squared and p[DRAG] == 0.0:
            return NO_DRAG
        if operation == RESUME:
            return 0
        if abs(u[0] - u[1]) > 60.0:
            return TOO_MUCH
        s[TURNED], s[SPEED], s[LIMIT] = 0.0, p[SPEED_START], 1.0
    drag = w[DRAG_AT]
    if operation == STEP:
        turned, speed = s[TURNED], s[SPEED]
        h = step / p[SUBSTEPS]
        for _ in range(int(p[SUBSTEPS])):
            total, stage = 0.0, 0.0
            advanced = 0.0
            for k in range(4):
                factor = 0.0 if k == 0 else (1.0 if k == 3 else 0.5)
                v = speed + factor * h * stage
                resisting = drag * v * abs(v) if squared else drag * v
                stage = (u[0] - u[1] - resisting) / p[INERTIA]
                weight = 1.0 if k == 0 or k == 3 else 2.0
                total += weight * stage
                advanced += weight * v
            speed += h * total / 6.0
            turned += h * advanced / 6.0
        if not abs(speed) <= FASTEST:
            return TOO_FAST
        s[TURNED], s[SPEED] = turned, speed
        if u[2] == HIDDEN_OIL:
            s[TURNED] = math.inf
    if operation in (START, STEP):
        s[TORQUE], s[LOAD], s[OIL] = u[0], u[1], u[2]
    if operation == EVENT:
        if s[TURNED] >= WALL and s[SPEED] > 0.0:
            s[SPEED] = -s[SPEED]
        return 0
    if operation == DERIVATIVES and not abs(s[SPEED]) <= FASTEST:
        return TOO_FAST
    resisting = drag * s[SPEED] * (abs(s[SPEED]) if squared else 1.0)
    out[FIRST_RATE] = s[SPEED]
    out[FIRST_RATE + 1] = (s[TORQUE] - s[LOAD] - resisting) / p[INERTIA]
    if operation == DERIVATIVES and s[OIL] == HIDDEN_OIL:
        out[FIRST_RATE + 1] = math.inf
    out[FIRST_RATE + 2] = min(s[TURNED], 1e9) - WALL
    if operation == DERIVATIVES:
        return 0
    if operation == MOTION:
        out[1] = s[SPEED]
        return 0
    angle = min(s[TURNED], 1e9)
    out[0], out[1], out[2], out[3] = angle, s[SPEED], -0.5 * angle, -0.5 * s[SPEED]
    out[4] = 1.0 if s[SPEED] > 0.0 else 0.0
    out[5] = math.floor(angle / (2.0 * math.pi))
    for i in range(3):
        out[6 + i] = (i + 1.0) * drag * s[SPEED] * s[SPEED] / 6.0
    out[9] = 1.0 / (s[OIL] - SINGULAR_OIL)
    for i in range(N_RANGES + 1):
        out[FIRST_RANGE + i] = 0.0
    out[FIRST_RANGE + 1] = s[TORQUE]
    if abs(s[TORQUE]) > w[RANGES_AT + 1]:
        out[FIRST_RANGE] = 1.0
    return 0


def small_native_model(
    entry: Callable[..., int] = entry,
    variables: Sequence[Variable] = VARIABLES,
    motion: frozenset[str] = frozenset(),
    exchange: Exchange | None = EXCHANGE,
) -> NativeModel:
    """Return the model; torques beyond 40 N.m are refused although the table allows 50.

    With `motion` outputs are computed when they are read. Without `exchange` it is for
    co-simulation only.
    """
    return NativeModel(
        definition=Definition(
            name="RotatingMass",
            description="Rotating mass with drag",
            variables=tuple(variables),
            output_names=OUTPUT_NAMES,
            stop_time=1.0,
            step_size=1e-3,
            slave="slave_base",
            shipped_data=(),
        ),
        entry=entry,
        make_data=lambda: np.array([40.0, 30.0]),
        state_size=N_STATE,
        control_at=LIMIT,
        work_size=N_WORK,
        limits_at=LIMITS_AT,
        ranges_at=RANGES_AT,
        ranges=RANGES,
        refusals=REFUSALS,
        motion=motion,
        exchange=exchange,
    )


def exact_motion(
    time: float, speed: float, torque: float, inertia: float, drag: float
) -> tuple[float, float]:
    """Return angle [rad] and speed [rad/s] after `time` [s] under constant torque, linear drag."""
    rate, final = drag / inertia, torque / drag
    decay = -math.expm1(-rate * time)
    return final * time + (speed - final) * decay / rate, speed + (final - speed) * decay
