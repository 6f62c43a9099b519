"""Cost of a helical pair: `pytest -n 0 benchmarks/bench_helical.py --benchmark-only`.

`python -m benchmarks.bench_helical` prints what is no plain timing: the sweep of 30 coefficients of
friction by 60 speeds on two processes, a loaded mesh period, and ratios within one process.
"""

from __future__ import annotations

import logging
import os
import time
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from pytest_benchmark.fixture import BenchmarkFixture
from scipy.integrate import solve_ivp

from benchmarks.timing import median_time
from gearlube.studies.helical.settings import RPM, HelicalSettings
from gearlube.studies.helical.stages import analyse_loaded_contact
from gearlube.studies.helical.sweep_grid import sweep_dataset
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    PeriodicResponse,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    N_COLUMNS,
    constant_friction,
    contact_points,
    point_capacity,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import mesh_strain
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_accelerations import pair_accelerations
from tests.helpers.helical_mesh_points import line_loads

_LOGGER = logging.getLogger("bench_helical")
SPEED = 1000.0 * RPM
MU = 0.1
FRICTIONS, SPEEDS = 30, 60
LIMIT_POINT, LIMIT_SWEEP = 0.05, 60.0  # s
TORQUES = (113.0, 226.0)
ACCURACY = 1e-3  # of the peak-to-peak motion
SETTLED = 1e-4  # share of a start's distance that is left when a motion counts as periodic


def settings(**changes: Any) -> HelicalSettings:
    return HelicalSettings(
        file=HelicalGearFile.named("he_2007"),
        pinion_torque=226.0,
        pinion_speed=SPEED,
        torques=TORQUES,
        **changes,
    )


def test_operating_point(benchmark: BenchmarkFixture) -> None:
    """Periodic response with constant friction at 1000 rpm, 12 DOF."""
    pair = he_2007_pair(MU)
    periodic_response(pair, SPEED)
    response: PeriodicResponse = benchmark(periodic_response, pair, SPEED)
    benchmark.extra_info["steps"] = response.steps
    stats: Any = benchmark.stats
    assert stats["median"] < LIMIT_POINT


def test_operating_point_with_film(benchmark: BenchmarkFixture) -> None:
    """The same with the friction of the oil film."""
    pair = replace(settings().parameters(), friction="film")
    periodic_response(pair, SPEED)
    benchmark(periodic_response, pair, SPEED)


def time_sweep() -> None:
    """Log the wall time of the sweep on two processes, their start included."""
    pair = he_2007_pair(0.0)
    mu, speeds = np.linspace(0.0, 0.3, FRICTIONS), settings().swept_speeds(pair)
    start = time.perf_counter()
    found = sweep_dataset(pair, mu, speeds, jobs=2)
    wall = time.perf_counter() - start
    _LOGGER.info(
        "%d x %d points, two processes: %.1f s, limit %.0f s; %.1f ms a point",
        found.sizes["mu"], found.sizes["speed"], wall, LIMIT_SWEEP,
        1e3 * wall * 2 / (mu.size * speeds.size),
    )  # fmt: skip


def time_loaded_contact() -> None:
    """Log the wall time of a loaded mesh period in one process, teeth from the cache."""
    asked = settings(positions=12)
    wall = median_time(partial(analyse_loaded_contact, asked, jobs=1), 1)
    states = asked.positions * len(TORQUES)
    _LOGGER.info(
        "loaded contact: %d states, %.2f s, %.0f ms a state", states, wall, 1e3 * wall / states
    )


def _marched(pair: HelicalPairParameters, start: PeriodicResponse, rtol: float) -> float:
    """Return the peak-to-peak of psi [m] by SciPy, from the mean deflection."""
    c, mesh, supports = pair.kernel_parameters(), pair.mesh_arrays(), pair.support_arrays()
    points, work = np.empty((point_capacity(mesh), N_COLUMNS)), np.empty((3, 12))
    period, r_bp = start.period, pair.pair.pinion_base_radius

    def rates(t: float, state: np.ndarray) -> np.ndarray:
        q, v = state[:12], state[12:]
        n = contact_points(t / period, SPEED, c.plane, mesh, points)
        line_loads(*mesh_strain(q, c.plane), c, points, n)
        constant_friction(pair.mu, points, n)
        pair_accelerations(
            q, v, c.T_p, c.T_g, c, supports, points, n, work[0], work[1][:5], work[2]
        )
        return np.concatenate((v, work[2]))

    static = np.zeros(24)
    mean = start.displacement.mean(axis=0)
    static[:5], static[6:11], static[5] = mean[:5], mean[5:10], mean[10] / r_bp
    decay = pair.support_damping_ratio * 2.0 * np.pi * 3000.0  # 1/s, of the slowest mode, 3 kHz
    end = period * np.ceil(-np.log(SETTLED) / (decay * period))
    times = end + period * (np.arange(256) / 256.0 - 1.0)
    found = solve_ivp(
        rates, (0.0, float(times[-1])), static, "DOP853", times, rtol=rtol, atol=1e-6 * rtol
    )
    return float(np.ptp(r_bp * found.y[5] + pair.pair.gear_base_radius * found.y[11]))


def compare_with_solve_ivp() -> None:
    """Log the ratio of SciPy's integration in time to the monodromy solution, turn by turn."""
    pair = he_2007_pair(MU)
    response = periodic_response(pair, SPEED)
    swing = float(np.ptp(response.signal("psi")))
    ours = median_time(lambda: periodic_response(pair, SPEED), 9)
    for rtol in (1e-4, 1e-5, 1e-6, 1e-7, 1e-8):
        off = abs(_marched(pair, response, rtol) / swing - 1.0)
        if off < ACCURACY:
            break
    theirs = median_time(lambda: _marched(pair, response, rtol), 3)
    _LOGGER.info(
        "%.1f ms a point, limit %.0f ms; DOP853, rtol %.0e: %.0f ms, error %.0e, %.0f times",
        1e3 * ours, 1e3 * LIMIT_POINT, rtol, 1e3 * theirs, off, theirs / ours,
    )  # fmt: skip
    for what, other in (
        ("oil film over constant friction", replace(settings().parameters(), friction="film")),
        ("6 DOF over 12 DOF", replace(pair, form="six_dof")),
    ):
        wall = median_time(partial(periodic_response, other, SPEED), 9)
        _LOGGER.info("%s: %.2f", what, wall / ours)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    _LOGGER.setLevel(logging.INFO)
    compare_with_solve_ivp()
    time_loaded_contact()
    time_sweep()
