"""Slips of the pen in the shipped gear file against lists made by hand."""

import pytest

from gearlube_core.hypoid_contact.refusal import Change, setting, slips
from tests.helpers.contact_cases import shipped_file
from tests.helpers.each import each

FILE = shipped_file()
GROUPS = ("pinion.cutter.blade_groups", "gear.cutter.blade_groups")


def listed(file, field):
    """Changes of one field alone as values and slips."""
    changes = [change for change in slips(file, (field,)) if change.slip != "both heads"]
    assert all(change.now == {field: setting(file, field)} for change in changes)
    return [(change.values[field], change.slip) for change in changes]


def same(found, expected):
    assert [slip for _, slip in found] == [slip for _, slip in expected]
    # rounding of one product
    assert [value for value, _ in found] == pytest.approx([v for v, _ in expected], rel=1e-14)


@pytest.mark.parametrize("now", [20.647, -0.288])
def test_lengths_lose_their_sign_point_or_unit(now):
    field = "pinion.machine.sliding_base_mm"
    file = FILE.varied({field: now})
    expected = [
        (-now, "the sign"),
        (10.0 * now, "the decimal point"),
        (0.1 * now, "the decimal point"),
        (25.4 * now, "inches for millimetres"),
        (now / 25.4, "millimetres converted twice"),
    ]
    same(listed(file, field), expected)


@pytest.mark.parametrize(
    ("field", "now", "other"),
    [
        ("pinion.machine.tilt_angle_deg", 31.736, 58.264),
        ("pinion.machine.basic_swivel_angle_deg", -32.865, -57.135),
    ],
)
def test_angles_lose_their_sign_point_unit_or_axis(field, now, other):
    degrees = 57.29577951308232
    expected = [
        (-now, "the sign"),
        (10.0 * now, "the decimal point"),
        (0.1 * now, "the decimal point"),
        (degrees * now, "radians for degrees"),
        (now / degrees, "degrees converted twice"),
        (other, "the angle to the other axis"),
    ]
    same(listed(FILE, field), expected)


def test_ratio_of_roll_may_be_inverted_or_that_of_the_teeth():
    expected = [
        (-2.762, "the sign"),
        (27.62, "the decimal point"),
        (0.2762, "the decimal point"),
        (1.0 / 2.762, "the inverse ratio"),
        (36.0 / 13.0, "the teeth ratio"),
    ]
    same(listed(FILE, "pinion.machine.ratio_of_roll"), expected)


def test_counts_are_miscounted_by_up_to_ten_or_lose_a_digit():
    miscounts = [(n, "a miscount") for k in range(1, 11) for n in (13 + k, 13 - k)]
    digits = [(130, "a digit is missing"), (1, "a digit too many")]
    assert listed(FILE, "pinion.teeth") == miscounts + digits
    assert all(isinstance(value, int) for value, _ in listed(FILE, "pinion.teeth"))


@pytest.mark.parametrize("field", GROUPS)
def test_blade_groups_may_be_those_of_the_mate_and_stay_above_zero(field):
    file = FILE.varied({field: 3})
    expected = [(4, "a miscount"), (2, "a miscount"), (5, "a miscount"), (1, "a miscount")]
    expected += [(n, "a miscount") for n in range(6, 14)]
    assert listed(file, field) == [
        *expected, (30, "a digit is missing"), (11, "the groups of the mate")
    ]  # fmt: skip
    # eleven of both: the mate's are no change
    assert "the groups of the mate" not in [slip for _, slip in listed(FILE, field)]
    ten = FILE.varied({field: 10})
    assert (1, "a digit too many") in listed(ten, field)


def exchanges(file, *fields):
    return [change for change in slips(file, fields) if change.slip == "exchanged"]


@each(
    ("first", "second", "values"),
    [
        ("pinion.teeth", "gear.teeth", (13, 36)),
        ("pinion.spiral_angle_deg", "gear.spiral_angle_deg", (45.989, 27.601)),
        ("pinion.pitch_angle_deg", "gear.pitch_angle_deg", (29.056, 59.653)),
        (
            "pinion.cutter.concave_flank_blade_angle_deg",
            "pinion.cutter.convex_flank_blade_angle_deg",
            (21.529, 16.743),
        ),
        (
            "gear.machine.horizontal_setting_mm",
            "gear.machine.vertical_setting_mm",
            (66.65, 62.642),
        ),
        (
            "pinion.machine.sliding_base_mm",
            "pinion.machine.machine_center_to_back_mm",
            (20.647, -0.288),
        ),
    ],
)
def test_two_settings_may_be_exchanged(first, second, values):
    (change,) = exchanges(FILE, first, second)
    assert change.now == {first: values[0], second: values[1]}
    assert change.values == {first: values[1], second: values[0]}
    assert change.fields == (first, second)
    assert exchanges(FILE, first) == exchanges(FILE, second) == []


def test_equal_settings_are_not_exchanged_and_absent_ones_not_changed():
    assert exchanges(FILE, *GROUPS) == []
    assert setting(FILE, "pair.clearance_mm") is None
    assert list(slips(FILE, ("pair.clearance_mm",))) == []


def test_heads_without_blade_groups_mill_and_are_not_given_any():
    file = FILE.varied(dict.fromkeys(GROUPS, 0))
    assert all(change.slip != "both heads" for change in slips(file, GROUPS))


@pytest.mark.parametrize("fields", [GROUPS[:1], GROUPS[1:], GROUPS])
def test_both_heads_may_have_another_number_of_groups(fields):
    both = [change for change in slips(FILE, fields) if change.slip == "both heads"]
    counts = [count for count in range(30) if count != 11]
    assert [change.values for change in both] == [dict.fromkeys(GROUPS, n) for n in counts]
    assert all(change.now == dict.fromkeys(GROUPS, 11) for change in both)
    unlike = FILE.varied({GROUPS[0]: 7})
    both = [change.values for change in slips(unlike, fields) if change.slip == "both heads"]
    assert both == [dict.fromkeys(GROUPS, n) for n in range(30) if n not in (7, 11)]
    assert all(change.slip != "both heads" for change in slips(FILE, ("pinion.teeth",)))


def test_change_is_told_with_units():
    now = {"pinion.teeth": 13, "gear.machine.tilt_mm": 1.25, "gear.tilt_deg": 30.0}
    values = {"pinion.teeth": 14, "gear.machine.tilt_mm": 0.123456, "gear.tilt_deg": 60.0}
    assert str(Change(values, now, "the sign")) == (
        "pinion.teeth from 13 to 14 and gear.machine.tilt_mm from 1.25 to 0.1235 mm and "
        "gear.tilt_deg from 30 to 60 deg (the sign)"
    )
    assert str(Change({"a": 2.0}, {"a": 1.0})) == "a from 1 to 2"
