"""Driveline.fmu: engine, gearbox, shafts, wheels and vehicle, native, from casadi's C code.

The driveline is symbolic, because its steady state, its modes and its stability need derivatives.
casadi writes one communication step of each gear as C; `driveline_entry.c` chooses the gear and the
start. So there is no second copy of the equations.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import KroghInterpolator
from scipy.optimize import brentq

from drivetrain.driveline.equations import (
    INDEX,
    LONGEST_INNER_STEP,
    MEMORY,
    SLOT,
    STATES,
    driveline_equations,
    driveline_stepper,
)
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.driveline.steady_state import periodic_deviation, steady_state
from drivetrain.road_load import mohammadpour_2015_road_load
from fmu_src.definition import Definition, Value
from fmu_src.native.model import NativeModel
from fmu_src.variable import Variable, count, input_, output, parameter
from gearlube_core.arrays import Array
from gearlube_core.dynamics.ranges import Range
from gearlube_core.units import kmh_to_ms, rpm_to_rads

NAME = "Driveline"
START_SPEED = kmh_to_ms(80.0)  # m/s
_ENTRY = Path(__file__).with_name("driveline_entry.c")
_N, _N_INPUTS = len(MEMORY), 5
_STATE_SIZE = _N + _N_INPUTS + 3  # gear, pinion speed at the start, engine torque
_LIMITS_AT, _RANGES_AT = 0, 2 * _N_INPUTS
_SPEEDS = 33  # of each gear, between which starts are interpolated
_ROW = 2 * len(STATES) + 4  # state, what torque orders add, torques, pinion speed
_SLOWEST, _FASTEST = 0.5, 120.0  # m/s
_MOST_TURNED, _FASTEST_SHAFT = 1e9, 5e3  # rad, rad/s
_REFUSALS = {
    2: "the driveline must get finite signals and keep finite states",
    3: "the start speed must keep the engine within its speeds in gearbox.gear. Choose another "
    "gear, or 0 for the one that fits",
}


def default_car() -> DrivelineParameters:
    """Return the car of Mohammadpour et al. 2015 with the assumed driveline."""
    return DrivelineParameters(road_load=mohammadpour_2015_road_load())


def _variables(car: DrivelineParameters, start: Array) -> tuple[Variable, ...]:
    ratio, fastest = car.axle_ratio, _FASTEST
    continued = "; while it stays the same, the speed continues it"
    angle: dict[str, Any] = {"start": 0.0, "minimum": -_MOST_TURNED, "maximum": _MOST_TURNED}
    speed: dict[str, Any] = {
        "minimum": -_FASTEST_SHAFT,
        "maximum": _FASTEST_SHAFT,
        "display_unit": "rpm",
    }
    return (
        input_("pinion.angle", "rad", f"Rotation of the pinion{continued}", **angle),
        input_("pinion.speed", "rad/s", "Speed of the pinion", start=float(start[-1]), **speed),
        input_("wheel.angle", "rad", f"Rotation of the ring gear{continued}", **angle),
        input_("wheel.speed", "rad/s", "Speed of the ring gear", start=float(start[-1]) / ratio,
               **speed),
        input_("vehicle.speed_request", "m/s", "Target of the speed controller",
               start=START_SPEED, minimum=0.0, maximum=fastest, display_unit="km/h"),
        parameter("engine.order_scale", "1", "Scale of the torque orders: 0 for a smooth engine",
                  start=1.0, minimum=0.0, maximum=10.0, argument="order_scale"),
        parameter("vehicle.speed_start", "m/s", "Speed of the vehicle at the start, held before",
                  start=START_SPEED, minimum=_SLOWEST, maximum=fastest, display_unit="km/h",
                  argument="speed_start"),
        count("gearbox.gear", "Gear, from 1 on; 0: the one for the start speed", 0, 0,
              len(car.gearbox.ratios), "gear"),
        output("pinion.torque", "N.m", "Mean torque on the pinion in the last step; drives"),
        output("wheel.torque", "N.m", "Mean torque on the ring gear in the last step; resists"),
        output("vehicle.speed", "m/s", "Speed of the vehicle", 10.0, "km/h"),
        Variable(name="range.exceeded", type="Integer", causality="output",
                 description="1 while the engine is outside its range, else 0"),
        output("engine.speed", "rad/s", "Speed of the crankshaft", 100.0, "rpm"),
        output("start.pinion_speed", "rad/s", "Speed of the pinion at the start: "
               "pinion.speed_start of the axle", 100.0, "rpm"),
        output("start.gear", "1", "Gear that is engaged"),
    )  # fmt: skip


def _start(car: DrivelineParameters, gear: int, speed: float) -> Array:
    """Return a row of the table of starts."""
    steady = steady_state(car, car.gearbox.ratios[gear - 1], speed, 0.0)
    orders = np.zeros(len(STATES))
    if car.engine.orders:
        orders = periodic_deviation(car, steady)
    torques = [steady.engine_torque, steady.pinion_torque, steady.wheel_torque]
    return np.array([*steady.state, *orders, *torques, steady.pinion_speed])


def _speeds(car: DrivelineParameters, gear: int) -> tuple[float, float, float]:
    """Return the vehicle speeds of idling, cruising and the engine's highest speed in a gear."""
    engine, ratio = car.engine, car.gearbox.ratios[gear - 1]
    of_engine = (
        engine.idle_speed_rpm,
        car.gearbox.lowest_cruising_speed_rpm,
        engine.highest_speed_rpm,
    )

    def vehicle_speed(rpm: float) -> float:
        wanted = rpm_to_rads(rpm) / ratio
        if car.road_load.pinion_speed(_FASTEST) <= wanted:
            return _FASTEST
        if car.road_load.pinion_speed(_SLOWEST) >= wanted:
            return _SLOWEST
        return float(brentq(lambda v: car.road_load.pinion_speed(v) - wanted, _SLOWEST, _FASTEST))

    idle, cruising, highest = map(vehicle_speed, of_engine)
    return idle, cruising, highest


def _data(car: DrivelineParameters) -> Array:
    """Return engine speeds, then for each gear its speeds and its table of starts."""
    engine = car.engine
    parts = [np.array([rpm_to_rads(engine.idle_speed_rpm), rpm_to_rads(engine.highest_speed_rpm)])]
    for gear in range(1, len(car.gearbox.ratios) + 1):
        idle, cruising, highest = _speeds(car, gear)
        parts.append(np.array([idle, cruising, highest]))
        parts += [_start(car, gear, v) for v in np.linspace(idle, highest, _SPEEDS)]
    return np.concatenate(parts)


class _Running:
    """The car of the FMU in Python, from its table of starts."""

    def __init__(
        self,
        car: DrivelineParameters,
        data: Array,
        parameters: Mapping[str, Value],
        inputs: Sequence[float],
    ) -> None:
        scale, speed, gear = map(float, parameters.values())
        self._car = Driveline(car, speed, gear=int(gear) or None)
        gears = data[2:].reshape(len(car.gearbox.ratios), -1)
        (low, _, high), rows = np.split(gears[self._car.gear - 1], [3])
        place = (speed - low) / (high - low) * (_SPEEDS - 1)
        first = int(np.clip(place - 1.0, 0, _SPEEDS - 4))
        near = rows.reshape(_SPEEDS, _ROW)[first : first + 4]
        row = KroghInterpolator(np.arange(4.0), near)(place - first)
        steady, orders, (engine, *torques, pinion_speed) = np.split(
            row, [len(STATES), 2 * len(STATES)]
        )
        memory = np.zeros(_N)
        memory[: len(STATES)] = steady + scale * orders
        self._car.set_state(np.array([*memory, inputs[-1], engine, scale]))
        self._torques, self._engine, self._pinion_speed = tuple(torques), engine, pinion_speed
        self._turned = np.array([inputs[0], inputs[2]])

    @property
    def outputs(self) -> Array:
        """Present outputs."""
        car, engine = self._car, self._car.parameters.engine
        low, high = rpm_to_rads(engine.idle_speed_rpm), rpm_to_rads(engine.highest_speed_rpm)
        left = not low <= car.engine_speed <= high
        of_start = self._pinion_speed, car.gear
        return np.array([*self._torques, car.vehicle_speed, left, car.engine_speed, *of_start])

    def step(self, h: float, *inputs: float) -> None:
        """Advance by h [s], angles not connected."""
        _, pinion, _, wheel, requested = inputs
        self._car.request(requested, self._engine)
        angles = self._turned.tolist()
        self._torques = self._car.step(h, angles[0], pinion, angles[1], wheel)
        self._turned += h * np.array([pinion, wheel])


def driveline_model(car: DrivelineParameters | None = None) -> NativeModel:
    """Return the native model of a car around its axle.

    Parameters
    ----------
    car : DrivelineParameters, optional
        By default that of Mohammadpour et al. 2015.

    Raises
    ------
    ParameterError
        No gear fits 80 km/h, the start speed that the FMU has by default.
    """
    car = default_car() if car is None else car
    gear = car.gearbox.gear_for(car.road_load.pinion_speed(START_SPEED), car.engine)
    variables = _variables(car, _start(car, gear, START_SPEED))
    data = _data(car)
    return NativeModel(
        definition=Definition(
            name=NAME,
            description="Engine, gearbox, shafts, wheels and vehicle around a driven axle",
            variables=variables,
            output_names=tuple(v.name for v in variables if v.causality == "output"),
            stop_time=1.0,
            step_size=1e-4,
            slave="slave_base",
            shipped_data=(),
        ),
        c_code=_c_code(car, [v.range for v in variables if v.causality == "input"]),
        make_data=lambda: data,
        state_size=_STATE_SIZE,
        control_at=_N + _N_INPUTS,
        work_size=_RANGES_AT + 2,
        limits_at=_LIMITS_AT,
        ranges_at=_RANGES_AT,
        ranges=(
            Range("engine.speed", "the engine speed", float(data[0]), float(data[1]), "rad/s",
                  "The gear is that of the start and does not change."),
        ),
        refusals=_REFUSALS,
        in_python=partial(_Running, car, data),
    )  # fmt: skip


def _c_code(car: DrivelineParameters, limits: Sequence[tuple[float, float]]) -> dict[str, str]:
    """Return the C code of the entry and of one communication step in each gear."""
    import casadi as ca

    files = {_ENTRY.name: _ENTRY.read_text("utf-8")}
    gears = range(1, len(car.gearbox.ratios) + 1)
    work = 1
    for gear, ratio in zip(gears, car.gearbox.ratios, strict=True):
        function = driveline_stepper(
            driveline_equations(car, ratio), 1, car.propshaft_stiffness, car.half_shaft_stiffness
        )
        work = max(work, function.sz_w())
        generator = ca.CodeGenerator(f"gear_{gear}", {"with_header": False})
        generator.add(function)
        with tempfile.TemporaryDirectory() as folder:
            generator.generate(f"{folder}/")
            text = Path(folder, f"gear_{gear}.c").read_text("utf-8")
        files[f"gear_{gear}.c"] = text.replace("driveline_interval", f"gear_{gear}")
    places = {
        "MEMORY": _N,
        "INPUTS": _N_INPUTS,
        "STATE_SIZE": _STATE_SIZE,
        "LIMITS_AT": _LIMITS_AT,
        "RANGES_AT": _RANGES_AT,
        "STATES": len(STATES),
        "STARTED": SLOT["started"],
        "PINION_TORQUE": SLOT["pinion_torque"],
        "WHEEL_TORQUE": SLOT["wheel_torque"],
        "PINION_ANGLE": SLOT["pinion_angle"],
        "WHEEL_ANGLE": SLOT["wheel_angle"],
        "CRANK_SPEED": INDEX["crank_speed"],
        "VEHICLE_SPEED": INDEX["vehicle_speed"],
        "GEARS": len(gears),
        "SPEEDS": _SPEEDS,
        "ROW": _ROW,
        "WORK": work,
        "LOWEST_INPUTS": f"{{{', '.join(repr(low) for low, _ in limits)}}}",
        "HIGHEST_INPUTS": f"{{{', '.join(repr(high) for _, high in limits)}}}",
        "LONGEST_PART": repr(LONGEST_INNER_STEP * (1.0 + 1e-9)),
    }
    lines = [f"#define {name} {value}" for name, value in places.items()]
    files["driveline_places.h"] = "\n".join(lines) + "\n"
    includes = [f'#include "gear_{gear}.c"' for gear in gears]
    every = " ".join(f"GEAR({gear})" for gear in gears)
    files["driveline_gears.h"] = "\n".join([*includes, f"#define ALL_GEARS {every}\n"])
    return files
