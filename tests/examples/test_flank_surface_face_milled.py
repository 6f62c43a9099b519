"""The face-milled gear file that ships as an example: it meshes, and it is face-milled."""

import math
from pathlib import Path

import numpy as np
import pytest

from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.refusal import check_pair, pair_warnings
from gearlube_core.hypoid_contact.unloaded_error import contact_ratio, unloaded_error
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

FILE = HypoidGearFile.from_toml(
    Path(__file__).parents[2] / "examples" / "gears" / "face_milled.toml"
)
HOBBED = HypoidGearFile.named("mohammadpour_2015")


def test_its_settings_meet():
    check_pair(FILE)
    assert pair_warnings(FILE) == []


def test_gear_tooth_traces_are_circles_of_the_cutter():
    flank = Flank.from_file(FILE, "gear", "drive")
    angles = np.linspace(-0.3, 0.3, 7) + flank.start[1]
    path = np.stack([np.zeros(7), angles, np.zeros(7)], axis=1)
    r = flank.sample_parameters(path).r
    distance = np.linalg.norm(r - np.array(flank.motion.cutter_centre), axis=1)
    np.testing.assert_allclose(distance, 64.185e-3, rtol=1e-12)


def test_gear_tooth_has_the_direction_of_the_hobbed_one_at_the_mean_point():
    def direction(file):
        flank = Flank.from_file(file, "gear", "drive")
        step = np.array([0.0, 1e-4, 0.0])
        ends = flank.sample_parameters(np.stack([flank.start - step, flank.start + step])).r
        chord = ends[1] - ends[0]
        at = flank.sample_parameters(flank.start).r
        around = np.array([-at[1], at[0], 0.0]) / math.hypot(at[0], at[1])
        return math.asin(float(chord @ around) / float(np.linalg.norm(chord)))

    # settings are rounded to 1 um
    assert direction(FILE) == pytest.approx(direction(HOBBED), abs=2e-5)


@pytest.mark.parametrize("side", ["drive", "coast"])
def test_both_flanks_mesh_smoothly(side):
    """Unloaded: pairs hand over on the teeth, with a few micrometres of transmission error."""
    pair = FlankPair.from_file(FILE, side)
    error = unloaded_error(pair)
    # parabola as of the hobbed pair, whose TE spans 1.8 to 3 um
    assert 0.5e-6 < np.ptp(error.linear) < 5e-6
    assert contact_ratio(pair) > 1.2
    for places in (error.path.gear_s, error.path.gear_t, error.path.pinion_s, error.path.pinion_t):
        assert places.min() > 0.0
        assert places.max() < 1.0


def test_gear_is_sound_and_the_pinion_undercut_at_the_toe_only():
    assert tooth_form(FILE, "gear").report() == []
    form = tooth_form(FILE, "pinion")
    for limit in (form.drive, form.coast):
        assert form.t[limit.undercut].max() < 0.25
