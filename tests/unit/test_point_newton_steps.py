"""Steps of both Newton iterations of a point contact, on a made-up film of four nodes."""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.point.newton import newton as steady
from gearlube_core.ehl.point.terms.solids import NoSolids
from gearlube_core.ehl.transient import march
from gearlube_core.ehl.transient import newton as moving
from gearlube_core.ehl.transient.level import MovingLevel
from gearlube_core.ehl.transient.march import FilmMarch

TARGET = np.array([0.5, 1.0, 2.0, 0.7])
FLOW_RATE = 7.0


class MadeUpLevel(MovingLevel):
    """The residual is what pressure lacks; the film is 1, at one node 1 + approach."""

    flow_rate = FLOW_RATE

    def __init__(self):
        full = SimpleNamespace(conserves_mass=False)
        self.terms = SimpleNamespace(cavitation=full, solids=NoSolids())
        self.grid = SimpleNamespace(integral=lambda field: float(field.sum()))
        self.half_width, self.load = 0.5, 4.0
        self.squeezes, self.tried = [], []

    def state(self, pressure, approach, load_error=0.0):
        self.tried.append(approach)
        return SimpleNamespace(
            pressure=pressure,
            approach=approach,
            film=np.array([1.0 + approach, 1.0, 1.0, 1.0]),
            residual=TARGET - pressure,
            free=np.ones(4, dtype=bool),
            load_error=load_error,
            contact=SimpleNamespace(unbalanced=lambda residual, grid: 0.0),
        )

    def linearise(self, state, squeeze=0.0):
        self.squeezes.append(squeeze / FLOW_RATE)
        return SimpleNamespace(right=state.residual, by_approach=np.ones(4), load_by_approach=0.0)


def solutions(monkeypatch, module, given):
    """Let linear solutions be those of a list: share of the step, approach, remainder."""
    left = list(given)

    def gmres(operator, inverse, right, load, **settings):
        share, approach, remainder = left.pop(0) if len(left) > 1 else left[0]
        return share * right, approach, remainder, 3

    monkeypatch.setattr(module, "flexible_gmres", gmres)


def iterate(level, approach=0.0, most=40):
    return steady.newton(
        SimpleNamespace(levels=[level]),
        level.state(np.zeros(4), approach),
        tolerance=1e-9,
        load_tolerance=1e-9,
        most=most,
        most_krylov=5,
        build=lambda hierarchy, linear: None,
    )


def test_unsolved_linear_systems_are_repeated_with_four_times_the_squeeze(monkeypatch):
    level = MadeUpLevel()
    solutions(monkeypatch, steady, [(1.0, 0.0, 0.9)])
    state, record = iterate(level)
    assert record.converged
    assert record.krylov == 3 * len(level.squeezes)
    assert level.squeezes[0] == 0.0
    assert 0.0 < level.squeezes[1] < 1.0
    ratios = np.array(level.squeezes[2:]) / level.squeezes[1:-1]
    # up to the largest squeeze, a hundred times the flow through a cell: any step is taken then
    assert len(ratios) == 5
    assert ratios == pytest.approx(4.0)
    assert level.squeezes[-2] < 100.0 < level.squeezes[-1]
    np.testing.assert_array_equal(state.pressure, TARGET)
    assert record.residuals == [TARGET.sum(), 0.0]


def test_a_step_that_spends_the_film_is_shortened_then_repeated_with_squeeze(monkeypatch):
    level = MadeUpLevel()
    # all but nothing left after 0.16 of the step; then half a step and the whole of the rest
    solutions(monkeypatch, steady, [(1.0, -6.0, 0.0), (0.5, 0.0, 0.0), (1.0, 0.0, 0.0)])
    state, record = iterate(level)
    assert record.converged
    assert level.tried == [0.0, -6.0, pytest.approx(-2.4), pytest.approx(-0.96), 0.0, 0.0]
    # squeeze fades by a quarter as half of the residual is gone
    assert level.squeezes[0] == 0.0
    assert level.squeezes[2] == pytest.approx(0.25 * level.squeezes[1])
    assert record.residuals == pytest.approx([TARGET.sum(), 0.5 * TARGET.sum(), 0.0])
    assert state.approach == 0.0


def test_a_shortened_step_is_taken_where_a_fifth_of_the_film_is_left(monkeypatch):
    level = MadeUpLevel()
    solutions(monkeypatch, steady, [(1.0, -1.9, 0.0), (1.0, 0.0, 0.0)])
    state, record = iterate(level)
    # 1 - 0.76 is left, above 0.2
    assert level.tried == [0.0, -1.9, pytest.approx(-0.76), pytest.approx(-0.76)]
    assert record.residuals == pytest.approx([TARGET.sum(), 0.6 * TARGET.sum(), 0.0], abs=1e-14)
    assert level.squeezes == [0.0, 0.0]
    assert state.film.min() == pytest.approx(0.24)


def test_slow_steps_grow_squeeze_and_end_with_patience(monkeypatch):
    level = MadeUpLevel()
    solutions(monkeypatch, steady, [(0.02, 0.0, 0.0)])
    _, record = iterate(level)
    assert not record.converged
    # 0.98^8 = 0.85 of the ninth last residual: not 0.6
    assert len(record.residuals) == 10
    assert record.residuals == pytest.approx(TARGET.sum() * 0.98 ** np.arange(10))
    # growing squeeze: twice for each slow step
    assert np.array(level.squeezes[2:]) / level.squeezes[1:-1] == pytest.approx(2.0)


def test_a_balanced_film_below_zero_is_no_solution():
    level = MadeUpLevel()
    balanced = level.state(TARGET, -1.5)
    balanced.film = np.array([1.0, 1.0, 1.0, -0.1])
    for found in (
        steady.newton(
            SimpleNamespace(levels=[level]),
            balanced,
            tolerance=1e-9,
            load_tolerance=1e-9,
            most=4,
            most_krylov=5,
        )[1],
        step(level, balanced)[1],
    ):
        assert not found.converged


class Lagged:
    """A preconditioner that counts what it is told."""

    def __init__(self, level):
        self.hierarchy, self.deflection = SimpleNamespace(levels=[level]), None
        self.patience, self.renewals, self.told = 2, 5, []  # 5 of earlier steps

    def use_for(self, linear):
        self.renewals += 1

    def clear(self):
        self.told.append("cleared")

    def mark_outdated(self):
        self.told.append("outdated")


def step(level, state, most=8):
    lagged = Lagged(level)
    found = moving.step_newton(
        lagged, state, tolerance=1e-9, load_tolerance=1e-9, most=most, most_krylov=5
    )
    return *found, lagged


@pytest.fixture
def still_front(monkeypatch):
    monkeypatch.setattr(moving, "advance_front", lambda level, state, size: (state, size))
    monkeypatch.setattr(moving, "lifted", lambda level, state, least: None)


def test_a_balanced_film_is_a_solution_without_a_step():
    level = MadeUpLevel()
    _, record, _ = step(level, level.state(TARGET, 0.0))
    assert record == moving.StepRecord(True, 0.0, 0, 0, 0)
    # its load counts too
    _, record, _ = step(level, level.state(TARGET, 0.0, load_error=0.01), most=0)
    assert not record.converged


def test_a_time_step_is_shortened_and_taken(monkeypatch, still_front):
    level = MadeUpLevel()
    solutions(monkeypatch, moving, [(1.0, -1.9, 0.0), (1.0, 0.0, 0.0)])
    state, record, lagged = step(level, level.state(np.zeros(4), 0.0))
    assert level.tried == [0.0, -1.9, pytest.approx(-0.76), pytest.approx(-0.76)]
    assert record.converged
    assert (record.newton_steps, record.krylov_steps, record.renewals) == (2, 6, 2)
    assert record.residual < 1e-12
    np.testing.assert_allclose(state.pressure, TARGET, rtol=1e-14)
    # three iterations are more than its patience of two
    assert lagged.told == ["outdated", "outdated"]


def test_a_time_step_that_spends_the_film_is_not_taken(monkeypatch, still_front):
    level = MadeUpLevel()
    solutions(monkeypatch, moving, [(1.0, -100.0, 0.5)])
    state, record, lagged = step(level, level.state(np.zeros(4), 0.0))
    assert not record.converged
    assert level.tried == pytest.approx([0.0, -100.0, -40.0, -16.0, -6.4])
    assert record.newton_steps == 1
    assert state.approach == 0.0
    assert lagged.told == ["cleared"]


@pytest.mark.parametrize(
    ("lowest", "solids", "begins"),
    # a twentieth of the median of the films, 3 and 1, that more than half of the largest pressure
    # presses on
    [(0.02, None, 0.1), (0.3, None, 0.3), (0.001, 0.02, 0.005), (0.001, 2.0, 0.1)],
)
def test_a_predicted_film_is_lifted_to_a_share_of_the_pressed_one(
    monkeypatch, lowest, solids, begins
):
    monkeypatch.setattr(march, "lifted", lambda level, state, least: None)  # not by peaks alone
    run, level = object.__new__(FilmMarch), MadeUpLevel()
    film = np.array([8.0, 7.0, lowest, 3.0, 1.0, 9.0])
    level.state = lambda pressure, approach: SimpleNamespace(
        pressure=pressure, approach=approach, film=film + approach - 0.4
    )
    level.scales = SimpleNamespace(film=2.0)
    run._level, run._lagged, run.settings = level, None, march.MARCH_SETTINGS
    run.film = SimpleNamespace(solids=None)
    if solids is not None:
        run.film.solids = SimpleNamespace(thickness=solids)
    monkeypatch.setattr(march, "step_newton", lambda lagged, begin, **settings: begin)
    monkeypatch.setattr(march, "_PRESSED", 0.5)
    begin = run._attempt(level.state(np.array([0.0, 1.9, 0.7, 2.1, 4.0, 0.6]), 0.4))
    assert begin.film.min() == pytest.approx(begins)
    assert begin.approach == pytest.approx(0.4 + begins - lowest)
