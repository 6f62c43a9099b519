"""CSV files of pitch and waves: what is read, and what is refused with which words."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.measured_file import (
    PITCH_COLUMNS,
    WAVE_COLUMNS,
    MeasuredFile,
    read_pitch,
    read_waves,
)
from gearlube_core.hypoid_geometry.measured.tooth_errors import Wave

TEETH = {"pinion": 5, "gear": 7}
LINES = [f"pinion,drive,{k},{value}" for k, value in enumerate((3.0, -1.0, 0.0, 2.0, 1.0), 1)]


@pytest.fixture
def csv(tmp_path):
    def write(columns, lines):
        path = tmp_path / "one.csv"
        path.write_text("\n".join([",".join(columns), *lines]) + "\n")
        return path

    return write


def test_cumulative_pitch_is_read_without_its_mean(csv):
    found = read_pitch(csv(PITCH_COLUMNS, LINES[::-1]), TEETH, "cumulative")
    np.testing.assert_allclose(
        found["pinion", "drive"], 1e-6 * np.array([2.0, -2.0, -1.0, 1.0, 0.0]), atol=1e-18
    )


def test_single_pitch_is_the_step_from_the_tooth_before(csv):
    steps = (2.0, -4.0, 1.0, 2.0, -1.0)  # of tooth 1 from tooth 5, and so on
    lines = [f"pinion,convex,{k},{value}" for k, value in enumerate(steps, 1)]
    found = read_pitch(csv(PITCH_COLUMNS, lines), TEETH, "single")
    np.testing.assert_allclose(
        found["pinion", "coast"], 1e-6 * np.array([2.0, -2.0, -1.0, 1.0, 0.0]), atol=1e-18
    )


@pytest.mark.parametrize(
    ("lines", "kind", "parts"),
    [
        (
            LINES[:-2],
            "cumulative",
            ["pinion, drive flank: all 5 teeth", "but these are missing: 4, 5"],
        ),
        ([*LINES, LINES[0]], "cumulative", ["line 7: tooth 1 of the pinion, drive", "twice"]),
        ([*LINES[:-1], "pinion,drive,6,1.0"], "cumulative", ["tooth must be", "from 1 to 5"]),
        (LINES, "single", ["must sum to 0 within 2 um", "got 5 um", 'pitch_kind = "cumulative"']),
        (
            [f"{one.rpartition(',')[0]},{1e-3 * float(one.rpartition(',')[2])}" for one in LINES],
            "cumulative",
            ["must be 0 or at least 0.1 um, got 0.003 um", "0.003 mm is 3 um"],
        ),
        ([*LINES[:-1], "pinion,drive,5,nan"], "cumulative", ["within -500 to 500 um, got 'nan'"]),
    ],
)
def test_wrong_pitch_is_refused_with_line_value_and_cure(csv, lines, kind, parts):
    with pytest.raises(ParameterError) as caught:
        read_pitch(csv(PITCH_COLUMNS, lines), TEETH, kind)
    for part in parts:
        assert part in str(caught.value), str(caught.value)


def test_waves_are_read_in_metres_and_radians(csv):
    found = read_waves(csv(WAVE_COLUMNS, ["gear,drive,83,0.4,45", "gear,drive,12,0.1,-90"]))
    assert found["gear", "drive"] == (
        Wave(83, pytest.approx(0.4e-6), pytest.approx(np.pi / 4)),
        Wave(12, pytest.approx(0.1e-6), pytest.approx(-np.pi / 2)),
    )


@pytest.mark.parametrize(
    ("line", "part"),
    [
        ("gear,drive,83,0.2,0", "83 waves of the gear's drive flank occur twice"),
        ("gear,drive,8.5,0.2,0", "waves must be a whole number"),
        ("gear,drive,84,-0.2,0", "amplitude_um must be a finite number within 0 to 50 um"),
        ("gear,drive,84,0.2,400", "phase_deg must be a finite number within -360 to 360 deg"),
    ],
)
def test_wrong_waves_are_refused(csv, line, part):
    with pytest.raises(ParameterError, match=part):
        read_waves(csv(WAVE_COLUMNS, ["gear,drive,83,0.4,45", line]))


def test_pitch_turns_a_flank_by_its_length_over_the_radius(tmp_path):
    gear = HypoidGearFile.named("mohammadpour_2015")
    values = np.r_[13.0, np.zeros(12)]
    lines = [f"pinion,drive,{k},{value}" for k, value in enumerate(values, 1)]
    (tmp_path / "pitch.csv").write_text("\n".join([",".join(PITCH_COLUMNS), *lines]))
    data = {
        "name": "one",
        "source": "made",
        "gear_file": "mohammadpour_2015",
        "pitch": str(tmp_path / "pitch.csv"),
    }
    file = MeasuredFile.from_data(data, "one")
    found = file.tooth_errors(gear.blank())
    # mid-face pitch radius of the pinion by hand: (outer cone distance - half the width) sin(delta)
    member = gear.pinion
    radius = member.outer_cone_distance_mm - 0.5 * member.face_width_mm
    radius *= np.sin(np.radians(member.pitch_angle_deg))
    turned = found.pinion.pitch["drive"][0]
    assert turned == pytest.approx(12e-3 / radius, rel=1e-9)
    at = MeasuredFile.from_data({**data, "pinion": {"pitch_radius_mm": 20.0}}, "one")
    turned = at.tooth_errors(gear.blank()).pinion.pitch["drive"][0]
    assert turned == pytest.approx(12e-3 / 20.0, rel=1e-9)
    assert found.gear.is_none
    assert not found.is_none
