"""Curves of a marched film: rows, kept films, checkpoints, repeats; the march is a stand-in."""

from types import SimpleNamespace
from typing import ClassVar

import numpy as np
import pytest

from gearlube_core.ehl.transient import curves as module
from gearlube_core.ehl.transient.curves import NumberedSteps, march_curves
from gearlube_core.errors import ConvergenceError

COLUMNS = ("step", "time", "minimum_film", "pressure_max", "time_error", "time_error_pressure",
           "converged")  # fmt: skip


class MadeUpMarch:
    """A film of 1 + t dt^2 and a pressure of 2 - t dt at time t."""

    saved: ClassVar[list[tuple[str, int, list[int]]]] = []
    fails_at = np.inf

    def __init__(self, film, time_step, *, start_time, scheme, settings, record, throw):
        self.time_step, self.start_time, self.steps = time_step, start_time, 0
        self.settings = settings
        self.solution = self._solution()

    def _solution(self):
        time, dt = self.start_time + self.steps * self.time_step, self.time_step
        return SimpleNamespace(
            time=time,
            film=1.0 + time * dt**2,
            pressure=2.0 - time * dt,
            converged=self.steps < self.fails_at,
            outcome="made up to fail.",
        )

    def step(self, *, throw):
        assert not throw
        self.steps += 1
        return self._solution()

    def save(self, path, rows, kept):
        self.saved.append((path.name, len(rows), sorted(kept)))


def _row(n, film):
    return [n, film.time, film.film, film.pressure, 9.0, 9.0, float(film.converged)]


@pytest.fixture(autouse=True)
def _stand_in(monkeypatch):
    monkeypatch.setattr(module, "FilmMarch", MadeUpMarch)
    monkeypatch.setattr(MadeUpMarch, "saved", [])


def _march(steps, **given):
    return march_curves(None, COLUMNS, _row, steps, **{"checkpoint_every": 2, **given})


def test_every_step_gives_a_row_and_kept_steps_their_film():
    seen = []
    curves = _march(
        NumberedSteps(10, 14, 3.0, 0.5, substeps=2),
        keep=(10, 13),
        progress=lambda n, last, film: seen.append((n, last, film.time)),
    )
    times = 3.0 + 0.5 * np.arange(5)
    np.testing.assert_array_equal(curves["step"], np.arange(10, 15))
    np.testing.assert_allclose(curves["time"], times)
    np.testing.assert_allclose(curves["minimum_film"], 1.0 + times * 0.25**2)
    assert {n: film.time for n, film in curves.kept.items()} == {10: 3.0, 13: 4.5}
    assert seen == [(n, 14, time) for n, time in zip(range(10, 15), times, strict=True)]
    assert curves.failures == 0
    assert MadeUpMarch.saved == []


@pytest.mark.parametrize("substeps", [1, 2])
def test_a_repeat_with_twice_the_step_tells_the_errors_of_the_steps(substeps):
    curves = _march(NumberedSteps(10, 14, 0.0, 0.2, substeps=substeps), repeat=True)
    t, dt = 0.2 * np.arange(5), 0.2 / substeps
    errors = {
        "time_error": np.abs((1.0 + t * 4.0 * dt**2) / (1.0 + t * dt**2) - 1.0),
        "time_error_pressure": np.abs((2.0 - t * 2.0 * dt) / (2.0 - t * dt) - 1.0),
    }
    for name, error in errors.items():
        if substeps == 1:  # steps between those of the repeat take the larger one beside them
            error[[1, 3]] = error[[2, 4]]
        np.testing.assert_allclose(curves[name], error, rtol=1e-12)
    np.testing.assert_allclose(curves["minimum_film"], 1.0 + t * dt**2)


def test_without_a_repeat_or_a_step_the_errors_are_those_of_the_films():
    for curves in (
        _march(NumberedSteps(10, 14, 0.0, 0.2)),
        _march(NumberedSteps(10, 10, 0.0, 0.2), repeat=True),
    ):
        np.testing.assert_array_equal(curves["time_error"], 9.0)


def test_checkpoints_come_at_even_steps_and_at_the_last(tmp_path):
    steps = NumberedSteps(9, 15, 0.0, 0.2)
    _march(steps, checkpoint=tmp_path / "march.npz", keep=(11,), repeat=True)
    own = [("march.npz", 2, []), ("march.npz", 4, [11]), ("march.npz", 6, [11]),
           ("march.npz", 7, [11])]  # fmt: skip
    # the repeat is numbered 9 to 12 and keeps no film
    longer = [("march_longer.npz", 2, []), ("march_longer.npz", 4, [])]
    assert MadeUpMarch.saved == own + longer


def test_a_step_that_fails_stops_the_march_or_is_told(monkeypatch):
    monkeypatch.setattr(MadeUpMarch, "fails_at", 3)
    with pytest.raises(ConvergenceError, match="Step 13: made up to fail"):
        _march(NumberedSteps(10, 14, 0.0, 0.2))
    curves = _march(NumberedSteps(10, 14, 0.0, 0.2), throw=False)
    np.testing.assert_array_equal(curves["converged"], [1.0, 1.0, 1.0, 0.0, 0.0])
    assert curves.failures == 2
