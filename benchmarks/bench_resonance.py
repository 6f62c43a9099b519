"""Cost of resonance curves: `pytest -n 0 benchmarks/bench_resonance.py --benchmark-only`.

`python -m benchmarks.bench_resonance` prints the figures of benchmarks/README.md that are no plain
timings: both curves of 200 frequencies, and the ratio to SciPy's integration in time at the same
accuracy for one frequency.
"""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture
from scipy.integrate import solve_ivp

from benchmarks.timing import median_time
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.parameters import Form, karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM
from gearlube_core.periodic import Branch, follow, solve_periodic

_LOGGER = logging.getLogger("bench_resonance")
FORMS: tuple[Form, Form] = ("two_dof", "one_dof")
FIRST, LAST, FREQUENCIES = 0.2, 1.6, 200  # mesh over natural frequency
STEPS = 256  # the default; 128 keep the error below ACCURACY in contact
RATIOS = (0.65, 1.0)  # in contact, teeth apart
ACCURACY = 1e-4  # of the peak-to-peak motion
SETTLED = 1e-5  # share of a start's distance that is left when a motion counts as periodic
SAMPLES = 128


def problem(form: Form, steps: int = STEPS) -> PeriodProblem:
    return PeriodProblem(replace(karagiannis_2012_pair(), form=form), steps_per_mesh_period=steps)


def speed_at(of: PeriodProblem, relative: float) -> float:
    return float(of.model.pinion_speed(relative * of.model.natural_frequency))


def resonance_curve(of: PeriodProblem) -> Branch:
    """Return 200 frequencies with stability, through the folds."""
    first, last = speed_at(of, FIRST), speed_at(of, LAST)
    return follow(
        of.equations(),
        of.initial_guess(first),
        first,
        limits=(first, last),
        at=np.linspace(first, last, FREQUENCIES),
    )


@pytest.mark.parametrize("form", FORMS)
def test_period_map(benchmark: BenchmarkFixture, form: Form) -> None:
    """One mesh period with its derivatives."""
    of = problem(form)
    speed = speed_at(of, 1.0)
    z = of.initial_guess(speed)
    of.flow(z, speed)
    benchmark(of.flow, z, speed)
    stats: Any = benchmark.stats
    benchmark.extra_info["microseconds a step"] = 1e6 * stats["median"] / STEPS


@pytest.mark.parametrize("form", FORMS)
def test_resonance_curve(benchmark: BenchmarkFixture, form: Form) -> None:
    of = problem(form)
    of.flow(of.initial_guess(speed_at(of, 1.0)), speed_at(of, 1.0))
    branch = benchmark.pedantic(resonance_curve, (of,), rounds=3)
    benchmark.extra_info["points"] = branch.parameter.size
    benchmark.extra_info["period maps"] = branch.evaluations


def time_curves() -> None:
    """Log wall times of both curves, one process, one thread."""
    total = 0.0
    for form in FORMS:
        of = problem(form)
        branch = resonance_curve(of)
        wall = median_time(lambda of=of: resonance_curve(of), 3)
        total += wall
        _LOGGER.info(
            "%s: %d points, %d folds, %s, %d period maps, %.2f s",
            form, branch.parameter.size, len(branch.of_kind("fold")), branch.ending,
            branch.evaluations, wall,
        )  # fmt: skip
    _LOGGER.info("both: %.2f s", total)


def _settled(of: PeriodProblem, z: Array, speed: float, method: str, rtol: float) -> float:
    """Return the peak-to-peak motion [m] by integration from its speeds and static deflection."""
    model, p = of.model, of.model.kernel_parameters
    period = 2.0 * math.pi / (p.z_p * speed)
    decay = p.c / (2.0 * p.m_eq)  # 1/s, of the mesh mode
    end = period * math.ceil(-math.log(SETTLED) / (decay * period))
    times = end + period * (np.arange(SAMPLES) / SAMPLES - 1.0)
    y, load = of.state(z, speed)
    y[0] = model.static_deflection * MICRO

    def pair(_: float, s: Array) -> list[float]:
        r = model.pair_rates(s[0] * UM, s[1], s[2], s[3], load, speed)
        return [r.x * MICRO, r.w_p, r.w_g, s[1]]

    def reduced(t: float, s: Array) -> list[float]:
        r = model.reduced_rates(s[0] * UM, s[1], speed * t, speed)
        return [r.x * MICRO, r.v]

    two = of.size == 4
    rates, start = (pair, y) if two else (reduced, y[:2])
    s = solve_ivp(rates, (0.0, end), start, method, times, rtol=rtol, atol=rtol)
    return float(np.ptp(s.y[0])) * UM


def compare_with_solve_ivp() -> None:
    """Log wall times for one periodic motion, to ACCURACY of its peak-to-peak value.

    Newton's method on the period map from static deflection, with the multipliers, against
    integration in time until SETTLED. That starts at static deflection too, but is given the
    load and the speeds of the motion, without which the slow speed hold would take ten times as
    long to bring the mean speed about. solve_ivp gets the loosest
    rtol = atol (x in micrometres) on a grid of 10^0.5 that meets ACCURACY; both are held to a
    motion of 2048 steps a period.
    """
    for form in FORMS:
        for relative in RATIOS:
            fine = problem(form, 2048)
            speed = speed_at(fine, relative)
            exact = solve_periodic(fine.equations(), fine.initial_guess(speed), speed)
            orbit = fine.orbit(exact.unknowns, speed)
            swing = float(np.ptp(orbit.x[:: 2048 // SAMPLES]))
            for steps in (64, 128, 256, 512):
                of = problem(form, steps)

                def shoot(of: PeriodProblem = of, speed: float = speed) -> float:
                    found = solve_periodic(of.equations(), of.initial_guess(speed), speed)
                    x = of.orbit(found.unknowns, speed).x
                    return float(np.ptp(x[:: max(1, x.size // SAMPLES)]))

                off = abs(shoot() / swing - 1.0)
                if steps >= SAMPLES and off < ACCURACY:
                    break
            ours = median_time(shoot, 9)
            _LOGGER.info(
                "%s at %g: shooting, %d steps, %.2f ms, error %.0e",
                form, relative, steps, 1e3 * ours, off,
            )  # fmt: skip
            for method in ("DOP853", "RK45"):
                for rtol in 10.0 ** -np.arange(3.0, 11.0, 0.5):
                    run = lambda: _settled(fine, exact.unknowns, speed, method, rtol)  # noqa: B023, E731
                    off = abs(run() / swing - 1.0)
                    if off < ACCURACY:
                        break
                theirs = median_time(run, 3)
                _LOGGER.info(
                    "    %s, rtol %.0e: %.0f ms, error %.0e, %.0f times",
                    method, rtol, 1e3 * theirs, off, theirs / ours,
                )  # fmt: skip


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    _LOGGER.setLevel(logging.INFO)
    time_curves()
    compare_with_solve_ivp()
