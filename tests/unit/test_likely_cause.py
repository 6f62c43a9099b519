"""Which changes of a setting are offered, with made-up misfits of made-up files."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact import refusal as module
from gearlube_core.hypoid_contact.refusal import Change, likely_changes

FIRST, SECOND, TEETH = "pinion.machine.tilt_deg", "gear.machine.offset_mm", "gear.teeth"


@dataclass(frozen=True)
class Fit:
    """What is read of a misfit; sound up to its limit."""

    what: str
    value: float
    limit: float = 1.0
    fields: tuple[str, ...] = ()

    @property
    def share(self) -> float:
        return abs(self.value) / self.limit

    @property
    def is_sound(self) -> bool:
        return self.share <= 1.0


@dataclass(frozen=True)
class File:
    """Settings by name; some values cannot be cut."""

    values: dict[str, float] = field(default_factory=dict)
    cannot: frozenset[float] = frozenset()

    def varied(self, changed: dict[str, float]) -> File:
        if self.cannot & set(changed.values()):
            raise ParameterError("no tooth")
        return File({**self.values, **changed}, self.cannot)


class Checks:
    """Stand-ins for the checks of a pair: groups of misfits, cuts that are known, contact."""

    def __init__(self, monkeypatch, groups, slips=(), touches=lambda file: True) -> None:
        self.known: list[dict] = []
        self.tried: list[File] = []
        self._groups, self._touches = groups, touches
        monkeypatch.setattr(module, "misfits_by_cost", self.misfits)
        monkeypatch.setattr(module, "reference_cuts", lambda file: {"pinion": 1, "gear": 2})
        monkeypatch.setattr(module, "slips", lambda file, tried: list(slips))
        monkeypatch.setattr(module, "setting", lambda file, name: file.values.get(name))
        monkeypatch.setattr(module, "unloaded_refusal", self.refusal)

    def misfits(self, file: File, known: dict):
        self.known.append(known)
        yield from self._groups(file)

    def refusal(self, file: File) -> str | None:
        self.tried.append(file)
        return None if self._touches(file) else "apart"


def change(name: str, value: float) -> Change:
    return Change({name: value}, {name: 0.0}, "a slip")


def test_slips_that_fit_best_come_first_one_for_each_setting(monkeypatch):
    scores = {1.0: (0.9, 0.1), 2.0: (0.2, 0.3), 3.0: (0.5, 0.6), 4.0: (0.1, 1.2), 5.0: (0.0, 0.8)}

    def groups(file):
        a, b = scores[next(iter(file.values.values()))]
        yield [Fit("a", 2.0 * a, 2.0)]
        yield [Fit("b", -b), Fit("c", 0.0)]

    offered = [change("x", 1.0), change("x", 2.0), change("x", 3.0), change("y", 4.0)]
    offered += [change("z", 5.0), change("w", 9.0)]
    checks = Checks(monkeypatch, groups, offered)
    found = likely_changes(File(cannot=frozenset({9.0})), [Fit("a", 3.0, fields=("x",))])
    # squares 0.13 of x = 2 against 0.82 and 0.61; y is not sound; w cannot be cut
    assert found == [offered[1], offered[4]]
    assert all(known == {"pinion": 1, "gear": 2} or known == {} for known in checks.known)


@pytest.mark.parametrize(
    ("better", "worse"),
    [
        ((0.9, 0.1), (0.7, 0.65)),  # squares 0.82 and 0.91; cubes the other way round
        ((0.5, 0.5), (0.9, 0.0)),  # squares 0.5 and 0.81; sums the other way round
    ],
)
def test_the_sum_of_squares_decides(monkeypatch, better, worse):
    scores = {1.0: worse, 2.0: better}

    def groups(file):
        yield [Fit(str(k), share) for k, share in enumerate(scores[file.values["x"]])]

    offered = [change("x", 1.0), change("x", 2.0)]
    Checks(monkeypatch, groups, offered)
    assert likely_changes(File(), [Fit("a", 3.0, fields=("x",))]) == [offered[1]]


@pytest.mark.parametrize("known", [True, False])
def test_the_first_step_brings_the_worst_misfit_to_zero(monkeypatch, known: bool):
    seen = []

    def groups(file):
        x = file.values[FIRST]
        seen.append(x)
        a, b, c = Fit("a", 1.0 * (x - 4.0)), Fit("b", 2.0 * (x - 6.0)), Fit("c", 0.1)
        yield [a, b, c]
        assert a.is_sound  # what comes later is not looked at before
        assert b.is_sound

    Checks(monkeypatch, groups)
    misfits = [Fit("a", 5.0, fields=(FIRST,)), Fit("b", 6.0 if known else math.inf)]
    if not known:
        misfits[0] = Fit("a", math.inf, fields=(FIRST,))
    likely_changes(File({FIRST: 9.0}), misfits)
    # the value, one beside it for the slope, the step; where nothing is known a start before
    assert seen[2 if known else 3] == pytest.approx(6.0, abs=1e-6)


def test_at_most_three_are_offered_of_six_that_are_tried(monkeypatch):
    offered = [change(f"s{k}", float(k)) for k in range(9)]
    scores = {float(k): 0.05 * k for k in range(9)}

    def groups(file):
        yield [Fit("a", scores[next(iter(file.values.values()))])]

    checks = Checks(monkeypatch, groups, offered)
    misfit = [Fit("a", 2.0, fields=("s1",))]
    assert likely_changes(File(), misfit) == offered[:3]
    assert len(checks.tried) == 3
    checks = Checks(monkeypatch, groups, offered, lambda f: next(iter(f.values.values())) > 4.0)
    assert likely_changes(File(), misfit) == [offered[5]]
    assert len(checks.tried) == 6


def test_cuts_that_a_change_leaves_as_they_are_serve_again(monkeypatch):
    def groups(file):
        yield [Fit("a", 0.0)]

    both = Change({FIRST: 1.0, SECOND: 2.0}, {FIRST: 2.0, SECOND: 1.0})
    mixed = Change({FIRST: 1.0, TEETH: 2.0}, {FIRST: 2.0, TEETH: 1.0})
    for one in (both, mixed):
        checks = Checks(monkeypatch, groups, [one])
        likely_changes(File(), [Fit("a", 2.0, fields=one.fields)])
        assert checks.known == [{}]
    for name, known in ((FIRST, {"gear": 2}), (SECOND, {"pinion": 1}), (TEETH, {})):
        checks = Checks(monkeypatch, groups, [change(name, 1.0)])
        likely_changes(File(), [Fit("a", 2.0, fields=(name,))])
        assert checks.known == [known]


def test_settings_are_those_that_decide_the_misfits_unless_given(monkeypatch):
    seen = []
    Checks(monkeypatch, lambda file: iter([[Fit("a", 0.0)]]))
    monkeypatch.setattr(module, "slips", lambda file, tried: seen.append(tried) or [])
    misfits = [Fit("a", 2.0, fields=("x", "y")), Fit("b", 3.0, fields=("y", "z"))]
    likely_changes(File(), misfits)
    likely_changes(File(), misfits, ("u",))
    assert seen == [("x", "y", "z"), ("u",)]


def test_a_value_is_solved_for_where_no_slip_fits(monkeypatch):
    def groups(file):
        x = file.values[FIRST]
        yield [Fit("depth", x**2 - 2.0, 0.01)]

    checks = Checks(monkeypatch, groups)
    (found,) = likely_changes(File({FIRST: 1.0}), [Fit("depth", -1.0, 0.01, (FIRST,))])
    # the misfit is closed to a fiftieth of its limit
    assert found.values[FIRST] == pytest.approx(math.sqrt(2.0), abs=2e-4 / 2.8)
    assert found == Change({FIRST: found.values[FIRST]}, {FIRST: 1.0})
    # secant: start, its slope, and five more values of x^2
    assert len(checks.known) < 12


@pytest.mark.parametrize(
    "name", ["pinion.machine.tilt_deg", "gear.machine.offset_mm", "pinion.machine.ratio_of_roll"]
)
def test_lengths_angles_and_ratios_are_solved_for_and_nothing_else(monkeypatch, name: str):
    def groups(file):
        yield [Fit("a", next(iter(file.values.values())) - 3.0)]

    Checks(monkeypatch, groups)
    (found,) = likely_changes(File({name: 6.0}), [Fit("a", 3.0, fields=(name,))])
    assert found.values[name] == pytest.approx(3.0, abs=0.02)
    for other, value in (("gear.teeth", 6.0), (name, None)):
        assert likely_changes(File({other: value}), [Fit("a", 3.0, fields=(other,))]) == []


def test_steps_are_ten_units_at_most_and_eight_in_all(monkeypatch):
    seen = []

    def groups(file):
        seen.append(file.values[FIRST])
        yield [Fit("a", 1e-3 * (file.values[FIRST] - goal), 1e-3)]

    Checks(monkeypatch, groups)
    misfits = [Fit("a", 3.0, 1e-3, (FIRST,))]
    for goal, found in ((65.0, True), (-65.0, True), (75.0, False)):
        seen.clear()
        offered = likely_changes(File({FIRST: 0.0}), misfits)
        assert bool(offered) == found
        sign = math.copysign(1.0, goal)
        # the derivative is taken a thousandth beside
        assert seen[:4] == pytest.approx([0.0, 1e-3, sign * 10.0, sign * 20.0], abs=1e-9)


def test_what_has_no_slope_is_left(monkeypatch):
    Checks(monkeypatch, lambda file: iter([[Fit("a", 3.0)]]))
    assert likely_changes(File({FIRST: 0.0}), [Fit("a", 3.0, fields=(FIRST,))]) == []


def test_the_worst_misfit_comes_first_and_then_what_is_still_unsound(monkeypatch):
    # of two groups the second is reached where the first is sound
    def groups(file):
        x = file.values[FIRST]
        yield [Fit("a", 0.1 * (x - 4.0)), Fit("b", 2.0 * (x - 4.2))]
        yield [Fit("c", 5.0 * (x - 4.4), 0.5)]

    Checks(monkeypatch, groups)
    misfits = [Fit("a", 1.5, fields=(FIRST,)), Fit("b", 9.0), Fit("d", math.inf)]
    (found,) = likely_changes(File({FIRST: 20.0}), misfits)
    # b is brought to zero, then c, at which a and b are sound
    assert found.values[FIRST] == pytest.approx(4.4, abs=0.02 * 0.5 / 5.0)


class Blank:
    """Misfit a of a setting that a cutter reaches on one side of an edge only."""

    def __init__(self, goal: float, reaches) -> None:
        self._goal, self._reaches = goal, reaches

    def groups(self, file):
        x = file.values[FIRST]
        yield [Fit("a", x - self._goal if self._reaches(x) else math.nan)]


MISSED = [Fit("a", math.inf, fields=(FIRST,))]


@pytest.mark.parametrize(
    ("goal", "reaches"),
    [
        (33.0, lambda x: x >= 25.0),
        (-17.0, lambda x: x <= -15.0),
        (3.0, lambda x: x < 6.0),
        # sixteen values to either side, from that of the file on
        (150.0, lambda x: x >= 149.0),
        (-150.0, lambda x: x <= -149.0),
    ],
)
def test_a_cutter_that_misses_is_moved_in_steps_until_it_cuts_a_tooth(monkeypatch, goal, reaches):
    Checks(monkeypatch, Blank(goal, reaches).groups)
    (found,) = likely_changes(File({FIRST: 0.0}), MISSED)
    assert found.values[FIRST] == pytest.approx(goal, abs=0.02)


def test_a_cutter_that_lies_too_far_away_is_not_found(monkeypatch):
    Checks(monkeypatch, Blank(152.0, lambda x: x >= 151.0).groups)
    assert likely_changes(File({FIRST: 0.0}), MISSED) == []


def test_a_value_that_cannot_be_cut_is_passed_over(monkeypatch):
    Checks(monkeypatch, Blank(23.0, lambda x: x > 5.0).groups)
    (found,) = likely_changes(File({FIRST: 0.0}, frozenset({10.0})), MISSED)
    assert found.values[FIRST] == pytest.approx(23.0, abs=0.02)
