"""The search on made-up pairs whose best values are known: limits that held cells miss, breaches.

A made-up pair stands for its values; cells that are held miss a part of the limit where the values
move away from where the cells were cut.
"""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.flank_optimisation import optimise
from gearlube_core.flank_optimisation.optimise import Better, OptimiseSettings
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.flank_optimisation.search import Found, Goal, search

UNIT = np.zeros(2), np.ones(2)


class Made:
    """A goal of values within 0 to 1, in place of `Goal`: `used` and `aim` give a value, rates."""

    loss = False

    def __init__(self, aim, used, worst=False):
        self._aim, self._used, self.worst = aim, used, worst

    def aim(self, found):
        return self._aim(found.values)

    def squares(self, found):
        return self._aim(found.values)

    def highest(self, found):
        return float(np.max(self._aim(found.values)[0]))

    def used(self, found):
        value, rate = self._used(found.values)
        missed = found.missed @ (found.values - found.cut)
        return np.array([value - missed]), np.array([rate - found.missed])


def model(missed):
    """Return pairs that miss so much of the limit for each value on held cells."""

    def cut(at):
        def evaluate(values):
            return SimpleNamespace(values=values, cut=at, missed=np.array(missed))

        return SimpleNamespace(evaluate=evaluate)

    return cut


def both_to_one(x):
    return float(((1.0 - x) ** 2).sum() / 2.0), x - 1.0


def sum_of_both(x):
    return float(x.sum()), np.ones(2)


def test_what_cutting_anew_adds_to_a_limit_is_learnt():
    goal = Made(both_to_one, sum_of_both)
    found = search(model([0.3, 0.3]), goal, UNIT, np.zeros(2))
    # x + y = 1 with x = y; half a percent beyond the limit is allowed
    assert found.values == pytest.approx([0.5, 0.5], abs=0.01)
    assert found.values.sum() <= 1.005
    # the aim at the limit is 0.25: only what is missed keeps the search from it
    assert goal.highest(found.evaluation) < 0.26


@pytest.mark.parametrize(("steep", "start"), [(1.0, [0.1, 0.9]), (5.0, [0.0, 0.3])])
def test_there_is_a_way_back_from_a_broken_limit_with_a_kink(steep, start):
    # as the highest pressure has one where another cell carries most; a round moves by 0.35
    def used(x):
        off = x[1] - 0.5 - x[0] ** 2
        rate = steep * np.sign(off) * np.array([-2.0 * x[0], 1.0])
        return 1.6 - x[0] + steep * abs(off), rate - np.array([1.0, 0.0])

    goal = Made(lambda x: (float(x @ x), 2.0 * x), used)
    found = search(model([0.0, 0.0]), goal, UNIT, np.array(start))
    # least x that keeps the limit, on the kink: 0.6 and 0.5 + 0.6^2, half a percent is allowed
    assert found.values == pytest.approx([0.6, 0.86], abs=0.01)


@pytest.mark.parametrize(("most", "expected"), [(1.0, 0.55), (0.5, 0.5)])
def test_the_worst_case_is_least_within_its_limit(most, expected):
    def cases(x):  # equal where x^2 = (x - 1)^2 + 0.1, at 0.55
        value = np.array([[x[0] ** 2, (x[0] - 1.0) ** 2 + 0.1]])
        rate = np.array([[[2.0 * x[0], 0.0], [2.0 * (x[0] - 1.0), 0.0]]])
        return value, rate

    goal = Made(cases, lambda x: (x[0] / most, np.array([1.0 / most, 0.0])), worst=True)
    found = search(model([0.0, 0.0]), goal, UNIT, np.array([0.1, 0.3]))
    assert found.values[0] == pytest.approx(expected, abs=0.006)


def test_a_pair_that_keeps_the_limits_is_chosen_before_a_quieter_one_that_does_not(monkeypatch):
    problem = Problem.of(OptimisationFile.named("helical"))
    #            mean square of the mesh orders, most used of a limit
    pairs = iter([(0.7, 1.0), (0.1, 1.1), (0.2, 1.02)])
    evaluations = []

    def checked(*_, **__):
        square, used = next(pairs) if evaluations else (1.0, 0.5)
        evaluations.append(SimpleNamespace(square=square, part=used))
        return evaluations[-1]

    made = Found(problem.start, None, ())
    monkeypatch.setattr(optimise, "_stiffness", lambda *_: {})
    monkeypatch.setattr(optimise, "_search", lambda *_: made)
    monkeypatch.setattr(optimise, "plain_check", checked)
    monkeypatch.setattr(optimise, "_tightened", lambda _, __, ___, limits: limits)
    monkeypatch.setattr(Goal, "used", lambda _, found: (np.array([found.part]), None))
    monkeypatch.setattr(Goal, "highest", lambda _, found: found.square)
    found = optimise.optimise(problem, OptimiseSettings(checks=3))
    assert isinstance(found.better, Better)
    assert found.better.checked.square == 0.7
