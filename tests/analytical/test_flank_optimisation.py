"""Optimised flanks of a helical pair: rates, a known optimum, limits."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation import held_model
from gearlube_core.flank_optimisation.held_model import (
    HELICAL_CELLS,
    CheckSettings,
    HeldModel,
    differences,
    plain_check,
)
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import Limits, OptimisationFile
from gearlube_core.flank_optimisation.search import Goal, SearchSettings, search
from tests.helpers.helical_contact_cases import stiff_teeth

TEETH = dict.fromkeys(("drive", "coast"), stiff_teeth(1.1e11))
SLOPE = 12.0  # um


def problem(parameters, **more):
    data = {"name": "p", "gear": "he_2007", "torques_n_m": [200.0], "positions": 6}
    given = OptimisationFile.from_data(
        {**data, "orders": [1, 2], "parameters": parameters, **more}, "p"
    )
    return Problem.of(given)


RELIEFS = problem(
    {
        "pinion.flank.tip_relief_um": {"low": 0.0, "high": 30.0, "start": 9.0},
        "pinion.flank.tip_relief_depth_mm": {"low": 0.5, "high": 3.0, "start": 1.5},
        "gear.flank.crown_um": {"low": 0.0, "high": 20.0, "start": 4.0},
    },
    errors={"lead_slope_um": 6.0},
)


@pytest.fixture(scope="module")
def model():
    return HeldModel(RELIEFS, TEETH, RELIEFS.start)


@pytest.fixture(scope="module")
def here(model):
    return model.evaluate(RELIEFS.start)


@pytest.mark.slow
def test_held_cells_give_what_the_plain_analysis_gives(here):
    settings = CheckSettings(positions=6, helical=HELICAL_CELLS)
    file = RELIEFS.changed(RELIEFS.start)
    plain = plain_check(RELIEFS, file, TEETH, settings, jobs=1)
    # strips are 1.25 times wider and 1.5 times as deep, so their cells are that much coarser
    assert here.rotation == pytest.approx(plain.rotation, rel=3e-3)
    assert here.sliding == pytest.approx(plain.sliding, rel=0.01)
    assert here.whine((1, 2)) == pytest.approx(plain.whine((1, 2)), rel=0.05)
    # harmonics of six points by hand
    first = 2.0 / 6.0 * abs(sum(plain.rotation[0, 0] * np.exp(-1j * np.pi / 3.0 * np.arange(6))))
    assert abs(plain.orders((1,))[0])[0, 0, 0] == pytest.approx(first, rel=1e-9)


def test_a_new_number_of_the_plain_check_finds_no_older_positions(monkeypatch):
    def asked(*given, key, **options):
        raise InterruptedError(key)

    monkeypatch.setattr(held_model, "compute_positions", asked)
    keys = []
    for number in (3, 3, 4):
        monkeypatch.setattr(held_model, "_PLAIN_FORMAT", number)
        with pytest.raises(InterruptedError) as found:
            plain_check(RELIEFS, RELIEFS.changed(RELIEFS.start), TEETH, jobs=1)
        keys.append(str(found.value))
    assert keys[0] == keys[1] != keys[2]


@pytest.mark.slow
@pytest.mark.parametrize("loss", [False, True])
def test_aim_and_limits_have_the_rates_of_differences(model, here, loss):
    limits = Limits(edge_share=0.3)
    goal = Goal(before=here, orders=(1, 2), worst=False, limits=limits, loss=loss)
    goal = replace(goal, most_square=0.5)
    steps = np.array([1e-4, 1e-5, 1e-4])  # cells that open or close meanwhile are few
    ends = differences(model, RELIEFS.start, steps)
    for get in (goal.aim, goal.used):
        _, rate = get(here)
        for k, step in enumerate(steps):
            expected = (np.ravel(get(ends[2 * k])[0]) - np.ravel(get(ends[2 * k + 1])[0])) / (
                2.0 * step
            )
            found = np.ravel(np.atleast_2d(rate)[:, k])
            # one cell of a hundred may change between the ends
            assert np.abs(found - expected).max() < 0.01 * np.abs(expected).max()
    assert goal.used(here)[0].size == 6 * 3 + 1 + 6 * 3 + 1 + 1


@pytest.mark.slow
def test_the_swing_of_the_force_has_the_rates_of_differences(here):
    # a made-up force of eight phases: mean and orders by hand
    phase = 2.0 * np.pi * np.arange(8) / 8.0
    rate = np.stack([np.cos(phase), 20.0 + 3.0 * np.sin(2.0 * phase)], axis=-1)[None, None]

    def at(first, second):
        force = 1000.0 + 30.0 * np.cos(phase) + first * rate[0, 0, :, 0]
        force = force + 40.0 * np.sin(2.0 * phase) + second * rate[0, 0, :, 1]
        return replace(here, force=force[None, None], force_rate=rate)

    swing, rates = at(0.0, 0.0).swing((1, 2))
    assert swing[0] == pytest.approx(50.0 / 1000.0)  # of 30 and 40
    for k, step in enumerate(([1e-3, 0.0], [0.0, 1e-3])):
        high, low = at(*step).swing((1, 2))[0], at(*(-np.array(step))).swing((1, 2))[0]
        assert rates[0, k] == pytest.approx((high - low)[0] / 2e-3, rel=1e-6)


def test_the_swing_of_the_force_is_no_limit_of_a_helical_pair():
    with pytest.raises(ParameterError, match="force_swing"):
        problem({"gear.flank.crown_um": {"low": 0.0, "high": 20.0}}, limits={"force_swing": 1.0})


@pytest.mark.slow
def test_a_slope_of_one_gear_is_met_by_that_of_the_other():
    given = problem({"pinion.flank.lead_slope_um": {"low": -30.0, "high": 30.0}})
    same = {  # equal members: from the other end of the face the mesh runs backwards
        "gear.teeth": 25,
        "pair.centre_distance_mm": 79.375,
        "gear.tip_diameter_mm": given.file.pinion.tip_diameter_mm,
        "gear.root_diameter_mm": given.file.pinion.root_diameter_mm,
    }
    crowned = {f"{role}.flank.crown_um": 3.0 for role in ("pinion", "gear")}
    tilted = given.file.varied({**same, **crowned, "gear.flank.lead_slope_um": SLOPE})
    given = replace(given, file=tilted)
    before = HeldModel(given, TEETH, None).evaluate()
    goal = Goal(before=before, orders=(1, 2), worst=False, limits=Limits(loss=None))
    found = search(
        lambda at: HeldModel(given, TEETH, at), goal, (given.low, given.high), given.start
    )
    # both slopes open the gap towards +z: the orders are even in their sum, least where it is zero.
    # They are flat there: the search's 1e-3 of an aim that falls by 0.2 over 12 um is 0.9 um
    assert found.values[0] == pytest.approx(-SLOPE, abs=1.0)
    assert found.rounds[0].aim == pytest.approx(1.0, rel=0.05)
    assert goal.highest(found.evaluation) < 0.9


@pytest.mark.slow
def test_a_limit_that_binds_is_kept_and_costs():
    given = replace(RELIEFS, scenarios=RELIEFS.scenarios[:1])
    start = HeldModel(given, TEETH, given.start)
    before = start.evaluate(given.start)

    def best(limits):
        goal = Goal(before=before, orders=(1, 2), worst=False, limits=limits)
        found = search(
            lambda at: start if at is given.start else HeldModel(given, TEETH, at),
            goal,
            (given.low, given.high),
            given.start,
            SearchSettings(rounds=1, steps=10),
        )
        return goal.highest(found.evaluation), found.evaluation

    none = Limits(pressure=None, loss=None, sensitivity=None)
    free, unlimited = best(none)
    reached = float(unlimited.mean_sliding[0] / before.mean_sliding[0])
    limit = 0.5 * (1.0 + reached)  # between start and best
    assert reached > 1.0  # the best relief is less than that of the start, which slides less
    least, found = best(none.model_copy(update={"loss": limit}))
    assert found.mean_sliding[0] <= 1.005 * limit * before.mean_sliding[0]
    assert 0.99 * free < least < 1.0
