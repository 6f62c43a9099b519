"""Cost of the helical pair's periodic response.

`python -m pytest benchmarks/bench_helical.py --benchmark-only` times single responses;
`python -m benchmarks.bench_helical` the grid of friction and speed, on 1 and 2 processes, and logs
the accuracy of the default resolution.
"""

from __future__ import annotations

import logging
import math
import time
from dataclasses import replace

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from gearlube_core.dynamics.helical_pair.film_friction import FilmFriction
from gearlube_core.dynamics.helical_pair.harmonic_grid import harmonic_grid
from gearlube_core.dynamics.helical_pair.he_2007 import PINION_SPEED, he_2007_pair
from gearlube_core.dynamics.helical_pair.instability_map import instability_map
from gearlube_core.dynamics.helical_pair.periodic_response import (
    ResponseSettings,
    harmonics,
    periodic_response,
)
from gearlube_core.materials.lubricant import Lubricant
from gearlube_core.materials.solid import STEEL_MOHAMMADPOUR_2015

_LOGGER = logging.getLogger("bench_helical")
MU = np.linspace(0.0, 0.3, 30)
SPEED = np.linspace(200.0, 6000.0, 60) * math.pi / 30.0


@pytest.mark.parametrize("rpm", [100.0, 1000.0, 6000.0])
def test_periodic_response(benchmark: BenchmarkFixture, rpm: float) -> None:
    """Twelve coordinates at one operating point, with stability and 256 samples."""
    parameters, speed = he_2007_pair(0.1), rpm * math.pi / 30.0
    response = periodic_response(parameters, speed)
    benchmark(periodic_response, parameters, speed)
    benchmark.extra_info["steps"] = response.steps


def test_periodic_response_with_film_friction(benchmark: BenchmarkFixture) -> None:
    film = FilmFriction(
        oil=Lubricant.named("mohammadpour_2015"), oil_temperature=353.15,
        solid=STEEL_MOHAMMADPOUR_2015, roughness_rms=0.5e-6,
    )  # fmt: skip
    parameters = replace(he_2007_pair(0.0), friction="film", film=film)
    periodic_response(parameters, PINION_SPEED)
    benchmark(periodic_response, parameters, PINION_SPEED)


def time_grid() -> None:
    """Log wall times of 30 coefficients of friction by 60 speeds."""
    harmonic_grid(he_2007_pair(0.0), MU[:1], SPEED[:1])
    for workers in (1, 2):
        start = time.perf_counter()
        harmonic_grid(he_2007_pair(0.0), MU, SPEED, workers=workers)
        wall = time.perf_counter() - start
        _LOGGER.info("%d x %d grid, %d workers: %.1f s", MU.size, SPEED.size, workers, wall)


def time_map() -> None:
    """Log the wall time of an instability map of 20 damping ratios by 200 frequencies."""
    start = time.perf_counter()
    instability_map(
        he_2007_pair(0.0), np.linspace(1e3, 2e4, 200), "damping_ratio", np.linspace(0.0, 0.05, 20)
    )
    _LOGGER.info("20 x 200 instability map: %.1f s", time.perf_counter() - start)


def report_accuracy() -> None:
    """Log the largest error of harmonics 1 to 15 over the largest one."""
    fine = periodic_response(he_2007_pair(0.1), PINION_SPEED, ResponseSettings(samples=1024,
                             steps_per_oscillation=160))  # fmt: skip
    for steps in (10, 20, 40):
        settings = ResponseSettings(steps_per_oscillation=steps)
        coarse = periodic_response(he_2007_pair(0.1), PINION_SPEED, settings)
        exact, got = harmonics(fine.displacement), harmonics(coarse.displacement)
        error = np.max(np.abs(got - exact).max(axis=0) / exact.max(axis=0))
        _LOGGER.info("%d steps an oscillation, %d a period: %.0e", steps, coarse.steps, error)


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    _LOGGER.setLevel(logging.INFO)
    report_accuracy()
    time_map()
    time_grid()
