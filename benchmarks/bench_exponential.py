"""Cost and error of RK4 and of exponential steps: `python -m benchmarks.bench_exponential`.

Shipped e-axles with elastic shafts, one of them also with little torque and gear errors, so that
flanks part, and with lubricated meshes: gears of [he_2007] at as many meshes a second. Error of a
mesh load: rms of the difference from RK4 with 16 times more steps, over the
standard deviation of the load. Communication steps of 1 ms, processor time turn by turn.
"""

from __future__ import annotations

import argparse
import logging
import sys
import time
import tomllib
from collections.abc import Mapping
from typing import Any

import numpy as np

import gearlube as gl
from drivetrain.train.train_file import TrainCase, TrainFile
from gearlube_core.arrays import Array

_LOGGER = logging.getLogger("bench_exponential")
_MS = 1e-3
_OF_HIGHEST = (4.5, 6.0, 8.0, 16.0)  # RK4 steps per period of the highest mode
_PER_MS = (12, 16, 20, 25, 32, 40, 50)
_REFERENCE = 128.0
_TURNS = 5
_PARTING = "parting"
_FILMS = ("formula", "solved")
_MESHES = 1700.0  # of the first stage a second [Hz]


def case(name: str, meshes: str, **integration: Any) -> TrainCase:
    """Return a shipped train with its meshes, such that part, or with formula or solved films."""
    data = tomllib.loads(TrainFile.shipped_text(name)) | integration
    if meshes in _FILMS:
        lubricated(data, meshes)
        return TrainFile.from_data(data, name).case()
    if meshes == _PARTING:
        torques = data["start"]["torque_n_m"]
        data["start"]["torque_n_m"] = {port: torque / 30.0 for port, torque in torques.items()}
        for mesh in ("stage_1", "stage_2"):
            gap = 3.0 * np.cos(2.0 * np.pi * np.arange(8) / 8)
            data["elements"][mesh]["gap"] = [(1e-6 * gap).round(12).tolist()]
    for mesh in ("stage_1", "stage_2") if integration else ():  # the steps per ms alone decide
        data["elements"][mesh]["steps_per_mesh_period"] = 4.0
    return TrainFile.from_data(data, name).case()


def lubricated(data: dict[str, Any], film: str) -> None:
    """Replace both meshes; they share the ratio, and the wheels' torque balances the motor's."""
    gears = {"kind": "helical_mesh", "gear_file": "he_2007", "film": film}
    first = {"pinion": "input.gear", "gear": "counter.gear", "drives_forward": True}
    second = {"pinion": "counter.pinion", "gear": "output.gear", "right_hand": True}
    data["elements"]["stage_1"] = gears | first | {"angle_deg": -40.0}
    data["elements"]["stage_2"] = gears | second | {"angle_deg": 20.0}
    pair = gl.gears.helical_march_parameters(gl.HelicalGearFile.named("he_2007")).pair
    data["start"]["speed_rpm"] = {"left_wheel": 60.0 * _MESHES / pair.pinion_teeth / pair.ratio**2}
    motor = data["start"]["torque_n_m"]["motor"]
    for road in ("left_road", "right_road"):
        data["start"]["torque_n_m"][road] = -0.5 * motor * pair.ratio**2


def loads(one: TrainCase, state: Array, steps: int) -> tuple[Array, float]:
    """Return loads and separation of both meshes after each ms, and the processor time [s]."""
    train, spent, found = one.train, 0.0, []
    train.set_state(state)
    for _ in range(steps):
        begun = time.process_time()
        train.step(_MS, one.torques, one.oil_temperature)
        spent += time.process_time() - begun
        outputs = train.outputs()
        found.append(
            [outputs[f"stage_{k}.{what}"] for what in ("load", "separated") for k in (1, 2)]
        )
    return np.array(found), spent


def table(name: str, meshes: str, steps: int) -> None:
    """Print a line for each way to integrate."""
    rk4 = case(name, meshes)
    first = rk4.start().get_state()
    highest = first[-1] / rk4.train.steps_per_highest_period  # Hz
    ways: dict[str, tuple[TrainCase, Array]] = {}
    for count in _OF_HIGHEST:
        state = first.copy()
        state[-1] = count * highest
        ways[f"RK4 {1e6 / state[-1]:5.1f} us"] = rk4, state
    for count in _PER_MS:
        given: Mapping[str, Any] = {"exponential_steps_per_ms": count}
        one = case(name, meshes, integration="exponential", **given)
        ways[f"exponential {1e3 / count:5.1f} us"] = one, first
    state = first.copy()
    state[-1] = _REFERENCE * highest
    reference = loads(rk4, state, steps)[0]
    swing = reference[:, :2].std(axis=0)
    best = dict.fromkeys(ways, np.inf)
    errors = {}
    for _ in range(_TURNS):
        for way, (one, begun) in ways.items():
            found, spent = loads(one, begun, steps)
            best[way] = min(best[way], spent)
            errors[way] = np.sqrt(((found - reference)[:, :2] ** 2).mean(axis=0)) / swing
    apart = reference[:, 2:].mean()
    _LOGGER.info(f"{name}, {meshes} meshes, flanks apart {100.0 * apart:.0f} % of the time")
    for way, spent in best.items():
        _LOGGER.info(
            f"  {way:22s} {steps * _MS / spent:6.2f} x real time, error {errors[way].max():.1e}"
        )


def main() -> int:
    """Print the tables."""
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--steps", type=int, default=50, help="communication steps of 1 ms")
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    steps = asked.parse_args().steps
    for name, meshes in (
        ("e_axle_elastic", "its"),
        ("e_axle_elastic", _PARTING),
        ("e_axle_elastic", "formula"),
        ("e_axle_elastic", "solved"),
        ("e_axle_full", "its"),
    ):
        table(name, meshes, steps)
    return 0


if __name__ == "__main__":
    sys.exit(main())
