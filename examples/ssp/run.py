"""A car and its axle as one SSP archive, in Ecos, libcosim and FMPy: python -m examples.ssp.run.

The driveline (casadi's C code) and the hypoid axle (numba's object code) are two native FMUs that
exchange torques, angles and speeds every 50 us. A second car has a motor and an e-axle of two
stages, which is a train of `e_axle.toml`; both exchange every 20 us. Needs the test packages:
ecospy, tbb, libcosimpy.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssv

from docs.fmu_hosts.hosts import Job, run_ecos, run_libcosim
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.engine import Engine, Gearbox
from drivetrain.road_load import FinalDrive, mohammadpour_2015_road_load
from examples.ssp.system import (
    CAR_AND_AXLE,
    CAR_AND_E_AXLE,
    REQUEST,
    ParameterSet,
    write_ssp,
    write_ssv,
)
from fmu_src.build import build_models, cached_hypoid_axle
from fmu_src.definition import Model
from fmu_src.hypoid_axle import DEFINITION
from fmu_src.native.build import NativeOptions, build_native
from fmu_src.native.driveline import driveline_model
from fmu_src.native.platforms import platform_of_this_machine
from fmu_src.train import definition_with_train

SPEED = 20.0  # m/s at the start
REQUESTED = 20.5  # m/s
STEP, STEPS = 5e-5, 10_000  # s; a whole number of nanoseconds
OILS = {"mohammadpour": 1, "karagiannis": 2}  # oil.name.number
NAMES = ("car::vehicle.speed", "car::engine.speed", "car::pinion.torque", "axle::mesh.force",
         "axle::friction.power_loss")  # fmt: skip
E_AXLE = Path(__file__).with_name("e_axle.toml")
E_STEP, E_STEPS = 2e-5, 5_000
E_NAMES = ("car::vehicle.speed", "car::engine.speed", "car::pinion.torque", "axle::stage_2.load",
           "axle::output.speed")  # fmt: skip
_PARAMETERS = [v for v in DEFINITION.variables if v.is_model_parameter]
(_OIL,) = (v for v in _PARAMETERS if v.name == "oil.name")


def driveline() -> Driveline:
    """Return the car in its steady state at SPEED."""
    return Driveline(DrivelineParameters(road_load=mohammadpour_2015_road_load()), SPEED)


def electric_car() -> Driveline:
    """Return a car with a motor in its steady state at SPEED; stiffness and damping are assumed."""
    road = replace(
        mohammadpour_2015_road_load(), final_drive=FinalDrive(pinion_teeth=15, gear_teeth=124)
    )
    return Driveline(
        DrivelineParameters(
            road_load=road, engine=Engine.electric_motor(), gearbox=Gearbox(ratios=(1.0,)),
            propshaft_inertia=1e-3, propshaft_stiffness=3e3, propshaft_damping=0.1,
        ),
        SPEED,
    )  # fmt: skip


def build_driveline(folder: Path, car: DrivelineParameters | None = None) -> Path:
    """Write Driveline.fmu for this machine, as `gearlube build-fmu --model driveline` does."""
    options = NativeOptions(platforms=[platform_of_this_machine()], fmi=["2"])
    return build_native(driveline_model(car), folder, options)[0]


def build_e_axle(folder: Path) -> Path:
    """Write EAxle.fmu for this machine, as `gearlube build-fmu --train` does."""
    options = NativeOptions(platforms=[platform_of_this_machine()], fmi=["2"])
    return build_models(folder, train=E_AXLE, native=options)[0]


def parameter_sets(car: Driveline, first: str) -> list[ParameterSet]:
    """Return the start values: one set for each oil, the one named `first` in front."""
    steady = car.steady
    start = {
        "pinion.speed_start": steady.pinion_speed,
        "pinion.torque": steady.pinion_torque,
        "wheel.torque": steady.wheel_torque,
        "oil.temperature": 333.15,
        "bearing.preload": 2500.0,
    }
    sets = []
    for oil in sorted(OILS, key=lambda name: name != first):
        sets.append(ParameterSet(oil, "car", {REQUEST: REQUESTED, "vehicle.speed_start": SPEED}))
        sets.append(ParameterSet(oil, "axle", start | {"oil.name.number": OILS[oil]}))
    return sets


def e_parameter_sets(car: Driveline) -> list[ParameterSet]:
    """Return the start values of the electric car."""
    steady = car.steady
    speed = steady.pinion_speed / car.parameters.axle_ratio
    start = {
        "output.speed_start": speed,
        "motor.torque": steady.pinion_torque,
        "road.torque": steady.wheel_torque,
        "oil.temperature": 333.15,
    }
    return [
        ParameterSet("start", "car", {REQUEST: REQUESTED, "vehicle.speed_start": SPEED}),
        ParameterSet("start", "axle", start),
    ]


def in_python(oil: str, steps: int = STEPS) -> list[float]:
    """Return the last values of NAMES of the models in Python, coupled as the hosts do it."""
    car = driveline()
    values = parameter_sets(car, oil)[1].values
    inputs = [float(values[name]) for name in ("pinion.torque", "wheel.torque", "oil.temperature")]
    parameters = {v.name: v.decoded(v.start or 0.0) for v in _PARAMETERS}
    parameters |= {name: values[name] for name in parameters.keys() & values.keys()}
    axle = DEFINITION.start_model(parameters | {"oil.name": _OIL.decoded(OILS[oil])}, inputs)
    motion = [f"{flange}.{one}" for flange in ("pinion", "wheel") for one in ("angle", "speed")]
    torque = _coupled(car, axle, DEFINITION.output_names, motion, inputs, STEP, steps)
    outputs = dict(zip(DEFINITION.output_names, axle.outputs.tolist(), strict=True))
    return [car.vehicle_speed, car.engine_speed, torque, outputs["mesh.force"],
            outputs["friction.power_loss"]]  # fmt: skip


def e_in_python(steps: int = E_STEPS) -> list[float]:
    """Return the last values of E_NAMES, likewise."""
    car = electric_car()
    values = e_parameter_sets(car)[1].values
    inputs = [float(values[name]) for name in ("motor.torque", "road.torque", "oil.temperature")]
    definition, _ = definition_with_train(E_AXLE)
    speed = {"output.speed_start": float(values["output.speed_start"])}
    axle = definition.start_model(speed, inputs)
    motion = [f"{body}.{one}" for body in ("input", "output") for one in ("angle", "speed")]
    torque = _coupled(car, axle, definition.output_names, motion, inputs, E_STEP, steps)
    outputs = dict(zip(definition.output_names, axle.outputs.tolist(), strict=True))
    return [car.vehicle_speed, car.engine_speed, torque, outputs["stage_2.load"],
            outputs["output.speed"]]  # fmt: skip


def _coupled(
    car: Driveline,
    axle: Model,
    names: Sequence[str],
    motion: Sequence[str],
    inputs: Sequence[float],
    step: float,
    steps: int,
) -> float:
    """Advance both, each from the other's outputs at the start of the step; return the torque."""
    places = [names.index(name) for name in motion]
    car.request_speed(REQUESTED)
    torques, oil = (inputs[0], inputs[1]), inputs[2]
    for _ in range(steps):
        before = axle.outputs[places].tolist()
        axle.step(step, *torques, oil)
        torques = car.step(step, *before)
    return torques[0]


def in_ecos(
    archive: Path,
    parameter_set: str,
    steps: int = STEPS,
    step: float = STEP,
    names: Sequence[str] = NAMES,
) -> list[float]:
    """Return the last values of `names`; Ecos takes the parameter set by its name."""
    job = {"ssp": str(archive), "parameter_set": parameter_set, "step_size": step, "steps": steps}
    return run_ecos(job | {"names": names})


def in_libcosim(
    archive: Path,
    fmus: dict[str, Path],
    steps: int = STEPS,
    step: float = STEP,
    names: Sequence[str] = NAMES,
) -> list[float]:
    """Return the last values of `names`; libcosim takes the first parameter set."""
    references: dict[str, list[int]] = {}
    for name in names:
        element, variable = name.split("::")
        known = Job(fmu=fmus[element], reals={}, integers={}, names=[]).references
        references.setdefault(element, []).append(known[variable])
    job = {"ssp": str(archive), "step_size": step, "steps": steps}
    return run_libcosim(job | {"references": references})


def in_fmpy(archive: Path, values: Path, steps: int = STEPS) -> float:
    """Return the last speed of the vehicle.

    FMPy sets connected inputs to 0 in the first step: the driveline is jerked, and settles.
    """
    with values.open("rb") as stream:
        parameters = read_ssv(stream)
    rows = simulate_ssp(
        str(archive),
        stop_time=(steps - 0.5) * STEP,
        step_size=STEP,
        parameter_set=parameters,
    )
    return float(rows["vehicle.speed"][-1])


def main(steps: int = STEPS) -> dict[str, Sequence[float]]:
    """Build the archives, run them, print and return the last values by host and oil."""
    found: dict[str, Sequence[float]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder, car = Path(name), driveline()
        fmus = {"car": build_driveline(folder), "axle": cached_hypoid_axle()}
        for oil in OILS:
            found[f"Python, {oil}"] = in_python(oil, steps)
            sets = parameter_sets(car, oil)
            archive = write_ssp(folder / f"{oil}.ssp", CAR_AND_AXLE, fmus, sets)
            found[f"Ecos, {oil}"] = in_ecos(archive, oil, steps)
            found[f"libcosim, {oil}"] = in_libcosim(archive, fmus, steps)
        whole = write_ssp(folder / "whole.ssp", CAR_AND_AXLE, fmus, [], system_connectors=True)
        first = write_ssv(folder / "start.ssv", parameter_sets(car, next(iter(OILS)))[:2])
        found["FMPy, mohammadpour"] = [in_fmpy(whole, first, steps)]
        found |= electric(folder)
    print(f"after {steps * STEP:g} s, from {SPEED:g} m/s, requested {REQUESTED:g} m/s")
    units = {v.name: v.unit for v in DEFINITION.variables} | {"vehicle.speed": "m/s"}
    units["engine.speed"] = "rad/s"
    print(", ".join(f"{n} [{units[n.split('::')[1]]}]" for n in NAMES))
    for host, values in found.items():
        if host == "Python, electric":
            print(f"after {E_STEPS * E_STEP:g} s:", ", ".join(E_NAMES))
        print(f"{host:24}", *(f"{value:16.10g}" for value in values))
    return found


def electric(folder: Path, steps: int = E_STEPS) -> dict[str, list[float]]:
    """Build the electric car as archives of SSP 1.0 and 2.0; return the last values by host."""
    car = electric_car()
    fmus = {"car": build_driveline(folder / "electric", car.parameters),
            "axle": build_e_axle(folder)}  # fmt: skip
    found = {"Python, electric": e_in_python(steps)}
    given = steps, E_STEP, E_NAMES
    for version in ("1.0", "2.0"):
        archive = write_ssp(
            folder / f"electric_{version}.ssp", CAR_AND_E_AXLE, fmus, e_parameter_sets(car),
            version=version,
        )  # fmt: skip
        found[f"libcosim, SSP {version}"] = in_libcosim(archive, fmus, *given)
        if version == "1.0":  # Ecos refuses 2.0
            found[f"Ecos, SSP {version}"] = in_ecos(archive, "start", *given)
    return found


if __name__ == "__main__":
    main()
