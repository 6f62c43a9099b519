"""Driveline.fmu: engine, shafts, wheels and vehicle, native, from casadi's C code."""

from __future__ import annotations

import hashlib
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from uuid import UUID

import casadi as ca
import numpy as np

from drivetrain.driveline.equations import INDEX, STATES
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.stepper import LONGEST_INNER_STEP, MEMORY, SLOT, driveline_stepper
from fmu_src.archive import write_archive
from fmu_src.definition import Definition, Model, Value
from fmu_src.model_description import model_description
from fmu_src.native.model import NativeModel
from fmu_src.native.platforms import (
    PLATFORMS,
    Platform,
    fmi_headers,
    platform_of_this_machine,
    shared_library,
)
from fmu_src.native.sources import c_sources
from fmu_src.variable import Variable
from fmu_src.variable_kinds import input_, output, parameter
from gearlube_core.dynamics.ranges import Range
from gearlube_core.units import rpm_to_rads

NAME = "Driveline"
_ENTRY = Path(__file__).with_name("driveline_entry.c")
_INTERVAL = "driveline_interval"
_N, _N_INPUTS = len(MEMORY), 5
_REFUSALS = {
    1: f"communication steps of the driveline must be at most {1e3 * LONGEST_INNER_STEP:g} ms",
    2: "the driveline must get finite signals and keep finite states",
}


def _variables(driveline: Driveline) -> tuple[Variable, ...]:
    steady, speed = driveline.steady, float(driveline.inputs[0])
    return (
        input_("pinion.angle", "rad", "Rotation of the pinion", start=0.0),
        input_("pinion.speed", "rad/s", "Speed of the pinion", start=steady.pinion_speed),
        input_("wheel.angle", "rad", "Rotation of the ring gear", start=0.0),
        input_("wheel.speed", "rad/s", "Speed of the ring gear", start=steady.wheel_speed),
        input_("vehicle.speed_request", "m/s", "Target of the speed controller", start=speed,
               minimum=0.0, maximum=120.0),
        parameter("engine.order_scale", "1", "Scale of the torque orders: 0 for a smooth engine",
                  start=1.0, minimum=0.0, maximum=10.0, argument="ripple"),
        output("pinion.torque", "N.m", "Mean torque on the pinion in the last step; drives"),
        output("wheel.torque", "N.m", "Mean torque on the ring gear in the last step; resists"),
        output("vehicle.speed", "m/s", "Speed of the vehicle"),
        Variable(name="range.exceeded", type="Integer", causality="output",
                 description="1 while the engine is outside its range, else 0"),
        output("engine.speed", "rad/s", "Speed of the crankshaft"),
    )  # fmt: skip


def _data(driveline: Driveline) -> np.ndarray:
    steady = driveline.steady
    smooth = np.zeros(_N)
    smooth[: len(STATES)] = steady.state
    orders = driveline.get_state()[:_N] - smooth
    torques = [steady.engine_torque, steady.pinion_torque, steady.wheel_torque]
    return np.array([*smooth, *orders, *torques, *_engine_speeds(driveline)])


def _engine_speeds(driveline: Driveline) -> tuple[float, float]:
    engine = driveline.parameters.engine
    return rpm_to_rads(engine.idle_speed_rpm), rpm_to_rads(engine.highest_speed_rpm)


def _no_python_model(parameters: Mapping[str, Value], inputs: Sequence[float]) -> Model:
    raise NotImplementedError("gearlube has this model as drivetrain.driveline.model.Driveline")


def _compiled_from_c(*arguments: object) -> int:
    raise NotImplementedError(f"the entry of this model is {_ENTRY.name}")


def driveline_model(driveline: Driveline) -> NativeModel:
    """Return the model as the FMI functions need it."""
    variables = _variables(driveline)
    slowest, fastest = _engine_speeds(driveline)
    return NativeModel(
        definition=Definition(
            name=NAME,
            description="Engine, gearbox, shafts, wheels and vehicle around a rear axle",
            variables=variables,
            output_names=tuple(v.name for v in variables if v.causality == "output"),
            start=_no_python_model,
            stop_time=1.0,
            step_size=1e-4,
            slave="slave_base",
            shipped_data=(),
        ),
        entry=_compiled_from_c,
        data=_data(driveline),
        state_size=_N + _N_INPUTS + 1,
        control_at=_N + _N_INPUTS,
        work_size=2 * _N_INPUTS + 2,
        limits_at=0,
        ranges_at=2 * _N_INPUTS,
        ranges=(
            Range("engine.speed", "the engine speed", slowest, fastest, "rad/s",
                  "The gear is that of the speed at the start and does not change."),
        ),
        refusals=_REFUSALS,
    )  # fmt: skip


def _interval_code(driveline: Driveline) -> dict[str, str]:
    """Return the C code of one communication step, with the sizes and places that C needs."""
    car = driveline.parameters
    function = driveline_stepper(
        driveline.equations, 1, car.propshaft_stiffness, car.half_shaft_stiffness
    )
    places = {
        "MEMORY": _N,
        "STARTED": SLOT["started"],
        "PINION_TORQUE": SLOT["pinion_torque"],
        "WHEEL_TORQUE": SLOT["wheel_torque"],
        "CRANK_SPEED": INDEX["crank_speed"],
        "VEHICLE_SPEED": INDEX["vehicle_speed"],
        "ENGINE_TORQUE": 2 * _N,
        "STEADY_TORQUES": 2 * _N + 1,
        "ENGINE_SPEEDS": 2 * _N + 3,
        "LONGEST_STEP": repr(LONGEST_INNER_STEP * (1.0 + 1e-9)),
    }
    generator = ca.CodeGenerator(_INTERVAL, {"with_header": True})
    generator.add(function)
    with tempfile.TemporaryDirectory() as folder:
        generator.generate(f"{folder}/")
        files = {path.name: path.read_text("utf-8") for path in sorted(Path(folder).iterdir())}
    lines = [f"#define {name} {value}" for name, value in places.items()]
    entry = {_ENTRY.name: _ENTRY.read_text("utf-8")}
    return {**files, **entry, "driveline_places.h": "\n".join(lines) + "\n"}


def _object_code(platform: Platform, sources: Mapping[str, str]) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        for name, text in sources.items():
            Path(folder, name).write_text(text, "utf-8")
        command = [
            sys.executable, "-m", "ziglang", "cc", "-target", platform.zig, "-std=c99", "-O2", "-w",
            "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-c", _ENTRY.name, "-o", "entry.o",
        ]  # fmt: skip
        subprocess.run(command, cwd=folder, check=True)
        return Path(folder, "entry.o").read_bytes()


def build_driveline(driveline: Driveline, path: Path) -> Path:
    """Write the FMU of a driveline for this machine, FMI 2.0, and return its path.

    The start is that of the driveline, at its requested speed and in its gear.
    """
    model = driveline_model(driveline)
    definition = model.definition
    code = _interval_code(driveline)
    described = [model_description(definition, "", native=True).decode()]
    tables = c_sources(model, "")
    digest = hashlib.sha256("\0".join([*described, *tables.values(), *code.values()]).encode())
    guid = str(UUID(bytes=digest.digest()[:16]))
    (platform,) = (one for one in PLATFORMS if one.name == platform_of_this_machine())
    sources = c_sources(model, guid) | fmi_headers()
    headers = {name: text for name, text in sources.items() if name.endswith(".h")}
    kernels = _object_code(platform, headers | code)
    library = shared_library(platform, sources, kernels, NAME)
    content = {
        "modelDescription.xml": model_description(definition, guid, native=True),
        f"binaries/linux64/{NAME}{platform.suffix}": library,
    }
    write_archive(path, content)
    return path
