"""Curves of a march, its repetition with longer steps, and pools of workers."""

from __future__ import annotations

import math
import os
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube.studies.helical import stability as map_module
from gearlube_core.ehl.transient import curves as module
from gearlube_core.ehl.transient.curves import NumberedSteps, march_curves
from gearlube_core.errors import ConvergenceError
from gearlube_core.hypoid_contact import unloaded_error
from gearlube_core.storage import process_pool
from gearlube_core.storage.process_pool import ProcessPool

COLUMNS = ("step", "time", "minimum_film", "pressure_max", "time_error", "time_error_pressure")


class March:
    """A film that grows with time and with the square of the time step; counts its marches."""

    made: list[tuple[float, float]]
    fails_at = math.inf

    def __init__(self, film, time_step, *, start_time, scheme, settings, record, throw) -> None:
        assert (film, scheme, settings, record) == ("film", "bdf2", "settings", None)
        self.made.append((time_step, start_time))
        self._time_step, self._start, self.steps = time_step, start_time, 0
        self.solution = self._found()

    def _found(self) -> SimpleNamespace:
        time = self._start + self.steps * self._time_step
        return SimpleNamespace(
            time=time, film=1.0 + time + self._time_step**2,
            converged=self.steps < self.fails_at, outcome="It swings.",
        )  # fmt: skip

    def step(self, throw: bool):
        assert not throw
        self.steps += 1
        return self._found()


@pytest.fixture
def marches(monkeypatch):
    monkeypatch.setattr(March, "made", [], raising=False)
    monkeypatch.setattr(module, "FilmMarch", March)
    return March.made


def row(n: int, solution: SimpleNamespace) -> list[float]:
    return [n, solution.time, solution.film, 4.0 + 2.0 * solution.film, 0.1, 0.2]


def march(steps: NumberedSteps, **more):
    given = {"scheme": "bdf2", "settings": "settings", "checkpoint_every": 9} | more
    return march_curves("film", COLUMNS, row, steps, **given)


def test_curves_hold_every_step_and_the_films_that_are_kept(marches):
    seen = []
    steps = NumberedSteps(first=3, last=6, start_time=2.0, step_time=0.5, substeps=2)
    found = march(steps, keep=(3, 5), progress=lambda n, last, film: seen.append((n, last)))
    assert marches == [(0.25, 2.0)]
    assert found.table[:, 0] == pytest.approx([3, 4, 5, 6])
    assert found.table[:, 1] == pytest.approx([2.0, 2.5, 3.0, 3.5])
    assert found.table[:, 2] == pytest.approx(1.0 + found.table[:, 1] + 0.25**2)
    assert {n: film.time for n, film in found.kept.items()} == {3: 2.0, 5: 3.0}
    assert seen == [(3, 6), (4, 6), (5, 6), (6, 6)]


@pytest.mark.parametrize(("substeps", "longer"), [(2, 0.5), (1, 1.0)])
def test_a_march_is_repeated_with_steps_twice_as_long(marches, substeps: int, longer: float):
    steps = NumberedSteps(first=3, last=7, start_time=2.0, step_time=0.5, substeps=substeps)
    found = march(steps, repeat=True)
    shorter = 0.5 / substeps
    assert marches == [(shorter, 2.0), (longer, 2.0)]
    # the films differ by the squares of their steps, on every step or on every other one
    off = longer**2 - shorter**2
    every = 1 if substeps == 2 else 2
    for k, values in ((4, found["minimum_film"]), (5, 0.5 * found["pressure_max"])):
        error = off / values
        before, after = (np.arange(5) // every * every), -(-np.arange(5) // every) * every
        assert found.table[:, k] == pytest.approx(np.maximum(error[before], error[after]))
    alone = NumberedSteps(first=3, last=3, start_time=2.0, step_time=0.5, substeps=substeps)
    assert march(alone, repeat=True).table.shape == (1, 6)
    assert len(marches) == 3


def test_step_that_is_not_found_is_raised_or_told(marches, monkeypatch):
    monkeypatch.setattr(March, "fails_at", 2)
    steps = NumberedSteps(first=3, last=7, start_time=2.0, step_time=0.5, substeps=1)
    with pytest.raises(ConvergenceError, match="Step 5: It swings"):
        march(steps)
    assert march(steps, throw=False).table.shape == (5, 6)


class Executor:
    def __init__(self, workers, **given) -> None:
        self.workers, self.given, self.ended = workers, given, None

    def shutdown(self, **how) -> None:
        self.ended = how


@pytest.mark.parametrize(
    ("jobs", "tasks", "spawn", "workers"),
    [(4, 9, False, 4), (4, 3, False, 3), (1, 9, True, 1), (4, 0, True, 1), (None, 99, False, 5)],
)
def test_pool_has_a_process_for_each_job_but_not_more_than_tasks(
    monkeypatch, jobs, tasks, spawn, workers
):
    monkeypatch.setattr(process_pool, "ProcessPoolExecutor", Executor)
    monkeypatch.setattr(process_pool, "processors", lambda: 5)
    calls = []
    pool = ProcessPool(
        jobs=jobs, prepare=print, arguments=(1, 2), always_spawn=spawn,
        before=lambda: calls.append("before"),
    )  # fmt: skip
    with pool.open(tasks) as executor:
        assert executor.workers == workers
        assert executor.given["initargs"] == (print, (1, 2))
        assert executor.ended is None
    assert executor.ended == {"wait": True, "cancel_futures": True}
    assert calls == ["before"]


@pytest.mark.parametrize(("jobs", "tasks"), [(1, 9), (4, 1), (4, 0)])
def test_one_job_runs_in_this_process(monkeypatch, jobs: int, tasks: int):
    monkeypatch.setattr(process_pool, "ProcessPoolExecutor", None)
    calls = []
    pool = ProcessPool(jobs=jobs, prepare=lambda *given: calls.append(given), arguments=(1, 2))
    with pool.open(tasks) as executor:
        assert executor is None
    assert calls == [(1, 2)]
    assert 1 <= process_pool.processors() <= (os.cpu_count() or 1)


def testcoarse_path_has_a_scan_s_positions_in_every_pitch(monkeypatch):
    monkeypatch.setattr(unloaded_error, "contact_path", lambda pair, angles: angles)
    pair = SimpleNamespace(gear_pitch=0.17)
    angles = unloaded_error.coarse_path(pair)
    assert np.diff(angles) == pytest.approx(unloaded_error._step(pair), rel=1e-9)
    assert angles[[0, -1]] == pytest.approx([-2.5 * 0.17, 2.5 * 0.17])
    assert unloaded_error._step(pair) == pytest.approx(0.17 / 32)


def test_growth_is_the_logarithm_of_a_multiplier_over_its_period(monkeypatch):
    monkeypatch.setattr(map_module, "linear_system", lambda parameters, variation=1.0: variation)
    monkeypatch.setattr(
        map_module,
        "march_period",
        lambda system, period, samples, steps: SimpleNamespace(transition=[None, (system, period)]),
    )
    # exp(30 v t) or so: a rate of 30 v per second, whatever the period
    monkeypatch.setattr(
        map_module, "floquet_multipliers", lambda last: [-math.exp(30.0 * last[0] * last[1]), 0.1]
    )
    monkeypatch.setattr(
        map_module, "natural_frequencies", lambda system: 2.0 * math.pi * np.array([70.0, 90.0])
    )
    found = map_module.instability_map(
        SimpleNamespace(friction="off"), [200.0, 500.0], "stiffness_variation", [-0.5, 0.2]
    )
    assert found.growth == pytest.approx(np.array([[-15.0, -15.0], [6.0, 6.0]]))
    assert found.multiplier[1] == pytest.approx([-math.exp(6.0 / 200.0), -math.exp(6.0 / 500.0)])
    assert found.natural_frequencies == pytest.approx([70.0, 90.0])
    assert (found.unstable == [[False, False], [True, True]]).all()
