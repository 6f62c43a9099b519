"""A car and its axle as one SSP archive, in Ecos, libcosim and FMPy: python -m examples.ssp.run.

The driveline (casadi's C code) and the hypoid axle (numba's object code) are two native FMUs that
exchange torques, angles and speeds every 50 us. Needs the test packages: ecospy, tbb, libcosimpy.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssv

from docs.fmu_hosts.hosts import Job, run_ecos, run_libcosim
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.road_load import mohammadpour_2015_road_load
from examples.ssp.system import CONNECTIONS, REQUEST, ParameterSet, write_ssp, write_ssv
from fmu_src.build import cached_hypoid_axle
from fmu_src.hypoid_axle import DEFINITION
from fmu_src.native.build import NativeOptions, build_native
from fmu_src.native.driveline import driveline_model
from fmu_src.native.platforms import platform_of_this_machine

SPEED = 20.0  # m/s at the start
REQUESTED = 20.5  # m/s
STEP, STEPS = 5e-5, 10_000  # s; a whole number of nanoseconds
OILS = {"mohammadpour": 1, "karagiannis": 2}  # oil.name.number
NAMES = ("car::vehicle.speed", "car::engine.speed", "car::pinion.torque", "axle::mesh.force",
         "axle::friction.power_loss")  # fmt: skip
_PARAMETERS = [v for v in DEFINITION.variables if v.is_model_parameter]
(_OIL,) = (v for v in _PARAMETERS if v.name == "oil.name")


def driveline() -> Driveline:
    """Return the car in its steady state at SPEED."""
    return Driveline(DrivelineParameters(road_load=mohammadpour_2015_road_load()), SPEED)


def build_driveline(folder: Path) -> Path:
    """Write Driveline.fmu for this machine, as `gearlube build-fmu --model driveline` does."""
    options = NativeOptions(platforms=[platform_of_this_machine()], fmi=["2"])
    return build_native(driveline_model(), folder, options)[0]


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


def in_python(oil: str, steps: int = STEPS) -> list[float]:
    """Return the last values of NAMES of the models in Python, coupled as the hosts do it.

    Both advance from the other's outputs at the start of the step.
    """
    car = driveline()
    values = parameter_sets(car, oil)[1].values
    inputs = [float(values[name]) for name in ("pinion.torque", "wheel.torque", "oil.temperature")]
    parameters = {v.name: v.decoded(v.start or 0.0) for v in _PARAMETERS}
    parameters |= {name: values[name] for name in parameters.keys() & values.keys()}
    axle = DEFINITION.start_model(parameters | {"oil.name": _OIL.decoded(OILS[oil])}, inputs)
    motion = [DEFINITION.output_names.index(axle_to[1]) for (axle_to, _) in CONNECTIONS[2:]]
    car.request_speed(REQUESTED)
    torques = (inputs[0], inputs[1])
    for _ in range(steps):
        before = axle.outputs[motion].tolist()
        axle.step(STEP, *torques, inputs[2])
        torques = car.step(STEP, *before)
    outputs = dict(zip(DEFINITION.output_names, axle.outputs.tolist(), strict=True))
    return [car.vehicle_speed, car.engine_speed, torques[0], outputs["mesh.force"],
            outputs["friction.power_loss"]]  # fmt: skip


def in_ecos(archive: Path, oil: str, steps: int = STEPS) -> list[float]:
    """Return the last values of NAMES; Ecos takes the parameter set by its name."""
    job = {"ssp": str(archive), "parameter_set": oil, "step_size": STEP, "steps": steps}
    return run_ecos(job | {"names": NAMES})


def in_libcosim(archive: Path, fmus: dict[str, Path], steps: int = STEPS) -> list[float]:
    """Return the last values of NAMES; libcosim takes the first parameter set."""
    references: dict[str, list[int]] = {}
    for name in NAMES:
        element, variable = name.split("::")
        known = Job(fmu=fmus[element], reals={}, integers={}, names=[]).references
        references.setdefault(element, []).append(known[variable])
    job = {"ssp": str(archive), "step_size": STEP, "steps": steps}
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
            archive = write_ssp(folder / f"{oil}.ssp", *fmus.values(), sets)
            found[f"Ecos, {oil}"] = in_ecos(archive, oil, steps)
            found[f"libcosim, {oil}"] = in_libcosim(archive, fmus, steps)
        whole = write_ssp(folder / "whole.ssp", *fmus.values(), [], system_connectors=True)
        first = write_ssv(folder / "start.ssv", parameter_sets(car, next(iter(OILS)))[:2])
        found["FMPy, mohammadpour"] = [in_fmpy(whole, first, steps)]
    print(f"after {steps * STEP:g} s, from {SPEED:g} m/s, requested {REQUESTED:g} m/s")
    units = {v.name: v.unit for v in DEFINITION.variables} | {"vehicle.speed": "m/s"}
    units["engine.speed"] = "rad/s"
    print(", ".join(f"{n} [{units[n.split('::')[1]]}]" for n in NAMES))
    for host, values in found.items():
        print(f"{host:24}", *(f"{value:16.10g}" for value in values))
    return found


if __name__ == "__main__":
    main()
