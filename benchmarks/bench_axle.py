"""Cost of the axle model in Python: `pytest -n 0 benchmarks/bench_axle.py --benchmark-only`.

`python -m benchmarks.bench_axle` prints the figures of benchmarks/README.md that are no plain
timings: the ratio to DOP853 at equal accuracy, and compilation and start in a fresh process.
"""

from __future__ import annotations

import logging
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numba import njit
from pytest_benchmark.fixture import BenchmarkFixture
from scipy.integrate import solve_ivp

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.integrate import step_inputs
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, AxleRaceways, axle_rhs
from gearlube_core.dynamics.hypoid_axle.state import LOAD_TORQUE, N_ODE, N_STATE, PHI_P, SIDE, X
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshAtLoad, MeshLevels, blend_mesh
from gearlube_core.oil.lubricant import lubricant_state

_LOGGER = logging.getLogger("bench_axle")
RATIO = 36 / 13
PINION_SPEED = 100.0 / 3.6 / 0.32 * RATIO  # rad/s at 100 km/h
WHEEL_TORQUE = 176.0  # N.m
INPUTS = (WHEEL_TORQUE / RATIO / 0.96, WHEEL_TORQUE, 368.15)  # N.m, N.m, K
CALLS = 1000
DURATION = 0.02  # s, 12 mesh periods
SAMPLE = 1e-4  # s
ACCURACY = 1e-4  # of the peak-to-peak transmission error, the documented one

VARIANTS = {
    "exact": (1.0, 1.0),
    "bearings expanded, friction kept": (0.0, 1.0),
    "friction anew, bearings kept": (1.0, 0.0),
    "all kept": (0.0, 0.0),
}


def running_axle(**options: Any) -> HypoidAxle:
    axle = HypoidAxle(replace(mohammadpour_2015_axle(), **options))
    axle.initialise(
        pinion_speed=PINION_SPEED,
        pinion_torque=INPUTS[0],
        wheel_torque=INPUTS[1],
        oil_temperature=INPUTS[2],
    )
    for _ in range(500):
        axle.step(SAMPLE, *INPUTS)
    return axle


@njit  # type: ignore[untyped-decorator]
def _repeat(
    count: int,
    s: Array,
    inputs: Any,
    mesh: MeshAtLoad,
    oil: Any,
    p: Any,
    both: tuple[float, float],
    scratch: Array,
    ds: Array,
) -> None:
    axle_rhs(s, inputs, mesh, oil, p, 1.0, 1.0, scratch, ds)
    for _ in range(count):
        s[PHI_P] += 1e-4
        axle_rhs(s, inputs, mesh, oil, p, both[0], both[1], scratch, ds)


def right_hand_side(axle: HypoidAxle) -> tuple[Any, ...]:
    """Arguments of axle_rhs from the state up to the parameters."""
    mesh, p, s = axle.packed, axle.kernel_parameters, axle.get_state()[:N_STATE]
    oil = lubricant_state(p.oil, INPUTS[2])
    table = MeshLevels(mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
    series, window = np.zeros(mesh.series_size), np.zeros(mesh.window_size)
    at_load = MeshAtLoad(series, mesh.orders, window, mesh.nodes)
    blend_mesh(s[LOAD_TORQUE], s[SIDE], table, at_load)
    inputs = step_inputs(s, INPUTS[0], INPUTS[1], oil, p, AxleRaceways())
    return s, inputs, at_load, oil, p


def _median(benchmark: BenchmarkFixture) -> float:
    stats: Any = benchmark.stats
    return float(stats["median"])


@pytest.mark.parametrize("variant", VARIANTS)
def test_right_hand_side(benchmark: BenchmarkFixture, variant: str) -> None:
    arguments, work = right_hand_side(running_axle()), (np.zeros(SCRATCH), np.zeros(N_ODE))
    fill_work = (1, *arguments, (1.0, 1.0), *work)
    _repeat(*fill_work)
    benchmark(_repeat, CALLS, *arguments, VARIANTS[variant], *work)
    benchmark.extra_info["microseconds a call"] = _median(benchmark) / CALLS * 1e6


@pytest.mark.parametrize("h", [1e-4, 1e-3])
def test_simulation_at_100_km_per_hour(benchmark: BenchmarkFixture, h: float) -> None:
    axle = running_axle()
    steps = round(0.1 / h)

    def simulate() -> None:
        for _ in range(steps):
            axle.step(h, *INPUTS)

    benchmark(simulate)
    benchmark.extra_info["simulated seconds a second"] = 0.1 / _median(benchmark)


def test_one_step_through_python(benchmark: BenchmarkFixture) -> None:
    """Little but the call and the outputs: one integrator step."""
    axle = running_axle()
    benchmark(axle.step, 1e-6, *INPUTS)


def _fixed_steps(axle: HypoidAxle, start: Array, h: float) -> Array:
    axle.set_state(start)
    found = []
    for _ in range(round(DURATION / h)):
        axle.step(h, *INPUTS)
        found.append(axle.outputs[OUTPUT_INDEX["mesh.dte"]])
    return np.array(found)


def _dop853(slope: Callable[[Array], Array], start: Array, tolerance: float) -> tuple[Array, int]:
    times = np.arange(1, round(DURATION / SAMPLE) + 1) * SAMPLE
    found = solve_ivp(
        lambda t, y: slope(y),
        (0.0, times[-1]),
        start[:N_ODE],
        method="DOP853",
        rtol=tolerance,
        atol=tolerance,
        t_eval=times,
    )
    return found.y[X] * 1e-6, found.nfev


def _median_times(*functions: Callable[[], Any]) -> list[float]:
    """Median wall times [s] of functions called in turn, so that all see the same machine."""
    for function in functions:
        function()
    rounds = []
    for _ in range(9):
        row = []
        for function in functions:
            start = time.perf_counter()
            function()
            row.append(time.perf_counter() - start)
        rounds.append(row)
    return [statistics.median(column) for column in zip(*rounds, strict=True)]


def compare_with_dop853() -> None:
    """Log wall times to the documented accuracy on one right-hand side.

    DOP853 gets the loosest rtol = atol (states in their natural units) on a grid of 10^0.25 that
    keeps every sample of the transmission error within ACCURACY of its peak-to-peak.
    """
    axle = running_axle(bearing_torque_loss="none")
    start = axle.get_state()
    ds = np.zeros(N_ODE)
    arguments = (*right_hand_side(axle), 1.0, 1.0, np.zeros(SCRATCH), ds)

    def lean(y: Array) -> Array:
        arguments[0][:N_ODE] = y
        axle_rhs(*arguments)
        return ds.copy()

    reference, _ = _dop853(lean, start, 1e-11)
    span = np.ptp(reference)
    tolerance, error = 1e-2, np.inf
    while error > ACCURACY:
        tolerance *= 10**-0.25
        found, calls = _dop853(lean, start, tolerance)
        error = np.max(np.abs(found - reference)) / span
    ours = [_fixed_steps(axle, start, h) for h in (SAMPLE, 1e-3)]
    errors = [
        np.max(np.abs(dte - reference[every - 1 :: every])) / span
        for dte, every in zip(ours, (1, 10), strict=True)
    ]
    axle.set_state(start)
    names = ("step, h = 1e-4 s", "step, h = 1e-3 s", "DOP853, derivative", "DOP853, lean")
    times = _median_times(
        lambda: _fixed_steps(axle, start, SAMPLE),
        lambda: _fixed_steps(axle, start, 1e-3),
        lambda: _dop853(axle.derivative, start, tolerance),
        lambda: _dop853(lean, start, tolerance),
    )
    _LOGGER.info("DOP853: tolerance %.2g, %d evaluations", tolerance, calls)
    for name, wall, off in zip(names, times, (*errors, error, error), strict=True):
        _LOGGER.info(
            "%-20s %7.2f ms, error %.1e, %6.1f x step at 1e-4 s, %6.1f x step at 1e-3 s",
            name, 1e3 * wall, off, wall / times[0], wall / times[1],
        )  # fmt: skip


_START = """
import time
begin = time.perf_counter()
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
imported = time.perf_counter()
axle = HypoidAxle(mohammadpour_2015_axle())
axle.initialise(pinion_speed=240.0, pinion_torque=66.0, wheel_torque=176.0, oil_temperature=368.15)
axle.step(1e-4, 66.0, 176.0, 368.15)
print(imported - begin, time.perf_counter() - imported)
"""


def time_start() -> None:
    """Log import and first step of a fresh process, without and with compiled code on disk."""
    with tempfile.TemporaryDirectory() as folder:
        for state in ("compiling", "cached", "cached"):
            found = subprocess.run(
                [sys.executable, "-c", _START],
                env=dict(os.environ, NUMBA_CACHE_DIR=folder),
                capture_output=True,
                text=True,
                check=True,
            )
            imported, stepped = (float(text) for text in found.stdout.split())
            _LOGGER.info("%s: import %.2f s, first step %.2f s more", state, imported, stepped)


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    _LOGGER.setLevel(logging.INFO)
    compare_with_dop853()
    time_start()
