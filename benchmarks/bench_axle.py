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
from pytest_benchmark.fixture import BenchmarkFixture
from scipy.integrate import solve_ivp

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.state import N_ODE, U_G, U_P, X

_LOGGER = logging.getLogger("bench_axle")
RATIO = 36 / 13
PINION_SPEED = 100.0 / 3.6 / 0.32 * RATIO  # rad/s at 100 km/h
WHEEL_TORQUE = 176.0  # N.m
INPUTS = (WHEEL_TORQUE / RATIO / 0.96, WHEEL_TORQUE, 368.15)  # N.m, N.m, K
DURATION = 0.02  # s, 12 mesh periods
SAMPLE = 1e-4  # s
ACCURACY = 1e-4  # of the peak-to-peak transmission error, the documented one


# lengths in micrometres: numbers of order 1, as tolerances of a solver expect
SIZES = np.ones(N_ODE)
SIZES[[*range(U_P, U_P + 3), *range(U_G, U_G + 3), X]] = 1e6


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


def _median(benchmark: BenchmarkFixture) -> float:
    stats: Any = benchmark.stats
    return float(stats["median"])


def test_right_hand_side(benchmark: BenchmarkFixture) -> None:
    """Rates for another integrator, all exact."""
    axle = running_axle()
    benchmark(axle.derivative, axle.state_view[:N_ODE])


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
        lambda t, y: SIZES * slope(y / SIZES),
        (0.0, times[-1]),
        SIZES * start[:N_ODE],
        method="DOP853",
        rtol=tolerance,
        atol=tolerance,
        t_eval=times,
    )
    return found.y[X] / SIZES[X], found.nfev


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
    lean = axle.derivative
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
