"""What a gear file refuses, and with which words."""

import re

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes

FILE = HypoidGearFile.named("mohammadpour_2015")
NOTES = field_notes(HypoidGearFile)
BOUNDED = [name for name, note in NOTES.items() if note.limits and note.kind != "text"]


def limits_of(name):
    number = r"(-?[\d.]+(?:e[+-]?\d+)?)"
    low, high = re.search(f"{number} to {number}", NOTES[name].limits).groups()
    return float(low), float(high)


def test_values_beyond_their_range_are_named_with_range_and_unit():
    for name in BOUNDED:
        low, high = limits_of(name)
        for value in (low - 1, high + 1):
            wrong = int(value) if NOTES[name].kind == "whole number" else value
            with pytest.raises(ParameterError) as caught:
                FILE.varied({name: wrong})
            message = str(caught.value)
            assert f"{name} must be a {NOTES[name].kind}, {NOTES[name].limits}" in message
            assert f"got {wrong!r}" in message
            assert NOTES[name].unit in message


def test_every_number_has_a_unit_or_needs_none_and_a_meaning():
    plain = ("teeth", "blade_groups", "ratio_of_roll", "modified_roll_2c", "modified_roll_6d")
    for name in BOUNDED:
        note = NOTES[name]
        assert note.unit in ("mm", "um", "deg", "mm/rad") or name.rsplit(".", 1)[1] in plain, name
        assert len(note.meaning) > 10, name


def test_missing_field_is_named_with_its_meaning():
    data = FILE.model_dump(exclude_none=True)
    del data["gear"]["machine"]["vertical_setting_mm"]
    with pytest.raises(ParameterError, match=r"gear\.machine\.vertical_setting_mm is missing: Dis"):
        HypoidGearFile.from_data(data, "mine.toml")


def test_misspelled_field_is_answered_with_the_nearest():
    with pytest.raises(ParameterError, match=r"is it pinion\.machine\.tilt_angle_deg\?"):
        FILE.varied({"pinion.machine.tilt_angle": 30.0})


def test_all_wrong_fields_are_listed_at_once():
    with pytest.raises(ParameterError, match=r"2 wrong field.*pinion\.teeth.*gear\.teeth"):
        FILE.varied({"pinion.teeth": 1, "gear.teeth": 1})


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"gear.face_width_mm": 95.598}, r"gear\.face_width_mm must be below .* 95\.598 mm"),
        ({"gear.face_apex_mm": 1.0}, r"working depth.* must be above 0 mm, got -1\.\d+ mm"),
        ({"gear.cutter.blade_groups": 0}, r"must be both 0 .* got 11 and 0"),
        ({"inferred": ("gear.colour",)}, r"'gear\.colour', which is not a field"),
    ],
)
def test_fields_that_contradict_each_other_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        FILE.varied(changes)


def test_unreadable_and_unknown_files_are_told_apart(tmp_path):
    broken = tmp_path / "broken.toml"
    broken.write_text("teeth = = 3", encoding="utf-8")
    with pytest.raises(ParameterError, match=r"broken\.toml is not a readable TOML file"):
        HypoidGearFile.from_toml(broken)
    with pytest.raises(ParameterError, match="No gear file is called 'none'"):
        HypoidGearFile.named("none")


def test_every_datum_says_where_it_is_from():
    assert FILE.origin("gear.cutter.point_radius_mm") == "table"
    assert FILE.origin("gear.cutter.blade_groups") == "inferred"
    assert FILE.origin("gear.cutter.blade_edge_radius_mm") == "completed"


def test_varied_copy_leaves_the_file_as_it_was():
    varied = FILE.varied({"pinion.teeth": 12, "gear.cutter.blade_edge_radius_mm": None})
    assert (varied.pinion.teeth, FILE.pinion.teeth) == (12, 13)
    assert varied.gear.cutter.blade_edge_radius_mm is None
    assert varied.varied({"pinion.teeth": 13}).pinion == FILE.pinion
