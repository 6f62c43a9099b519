"""Settings that may change keep the flanks of the other side together."""

import numpy as np
import pytest

from gearlube_core.flank_optimisation.held_model import OTHER_SLOPE, HeldModel
from gearlube_core.flank_optimisation.hypoid_positions import side_slopes
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from tests.helpers.loaded_cases import stiffness

BLADE = "pinion.cutter.convex_flank_blade_angle_deg"  # cuts the coast flank
TILT = "pinion.machine.tilt_angle_deg"


def test_a_blade_of_the_coast_flank_turns_it_by_its_angle_alone():
    data = {"name": "p", "gear": "mohammadpour_2015", "torques_n_m": [50.0]}
    bounds = {BLADE: {"low": 15.0, "high": 19.0}, TILT: {"low": 31.0, "high": 32.5}}
    given = Problem.of(OptimisationFile.from_data({**data, "parameters": bounds}, "p"))
    model = HeldModel(given, {"drive": stiffness()}, given.start)
    used, rates = model._settings_used(given.start)
    assert np.abs(used).max() < 1.0  # the shipped pair is within the limits
    slopes, rates = OTHER_SLOPE * used[:2], OTHER_SLOPE * rates[:2]
    assert slopes == pytest.approx(side_slopes(given.file, "coast"), rel=1e-9)
    # one degree of the blade is nearly one of the flank over its height; the spiral stays
    assert abs(rates[1, 0]) == pytest.approx(np.radians(1.0), rel=0.1)
    assert abs(rates[0, 0]) < 0.3 * abs(rates[1, 0])
    moved = given.changed(given.start + np.array([0.0, 0.05]))
    expected = (side_slopes(moved, "coast") - slopes) / 0.05
    assert rates[:, 1] == pytest.approx(expected, rel=0.02)
