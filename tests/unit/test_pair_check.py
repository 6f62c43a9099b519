"""Pairs that cannot be: checks, and settings that may be exchanged."""

import math
from pathlib import Path

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.ease_off import ease_off
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.pair_check import misfits_by_cost
from gearlube_core.hypoid_contact.refusal import Change, check_pair, pair_warnings, setting, slips
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.machine_check import edge_misfits, reference_misfit
from gearlube_core.hypoid_geometry.flank.machine_frames import pinion_cut
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes
from tests.helpers.contact_cases import shipped_file
from tests.helpers.each import each
from tests.helpers.pressure_angle import pressure_angle

GEARS = Path(__file__).parents[2] / "examples" / "gears"
SHIPPED = HypoidGearFile.named("mohammadpour_2015")
MILLED = HypoidGearFile.from_toml(GEARS / "face_milled.toml")
ANGLES = np.arange(-12, 13) / 6.0 * 2.0 * math.pi / 36.0
SOUND = [SHIPPED, MILLED]
# other blanks, machine settings far from the image of the gear; coast flanks touch at edges
REFERENCES = Path(__file__).parents[1] / "references" / "gears"
SYNTHESISED = [HypoidGearFile.from_toml(path) for path in sorted(REFERENCES.glob("*.toml"))]

GEAR_CONVEX = "gear.cutter.convex_flank_blade_angle_deg"
GEAR_CONCAVE = "gear.cutter.concave_flank_blade_angle_deg"


def misfit(file, words):
    (found,) = [m for group in misfits_by_cost(file) for m in group if words in m.what]
    return found.value


def refusal(file):
    with pytest.raises(ParameterError) as caught:
        check_pair(file)
    return str(caught.value)


@pytest.mark.parametrize("file", SOUND, ids=lambda file: file.name)
def test_sound_pairs_pass_without_a_warning(file):
    check_pair(file)
    assert pair_warnings(file) == []


@pytest.mark.parametrize("file", SYNTHESISED, ids=lambda file: file.name)
def test_other_blanks_and_cutters_pass_every_check(file):
    check_pair(file)
    assert all(m.is_sound for group in misfits_by_cost(file) for m in group)


def test_teeth_change_the_pitch_by_their_ratio():
    one = misfit(SHIPPED, "tooth pitches")
    wrong = misfit(SHIPPED.varied({"gear.teeth": 41}), "tooth pitches")
    assert (1.0 + wrong) / (1.0 + one) == pytest.approx(41.0 / 36.0, rel=1e-12)
    assert abs(one) < 0.004  # the printed angles and lengths, rounded


def test_gear_cutters_path_lies_in_the_middle_of_the_working_depth():
    # printed apexes and angles: 1 um and 0.001 deg of 80 mm
    assert reference_misfit(SHIPPED, "gear") == pytest.approx(0.0, abs=2e-6)


def test_sliding_base_moves_the_plane_by_its_cosine_of_the_tilt():
    """The cutter axis leans by the tilt from the cradle axis, along which the base slides.

    The plane is met at another cradle angle, so that this holds to first order.
    """
    moved = SHIPPED.varied({"pinion.machine.sliding_base_mm": 20.647 + 0.1})
    change = reference_misfit(moved, "pinion") - reference_misfit(SHIPPED, "pinion")
    assert change == pytest.approx(0.1e-3 * math.cos(math.radians(31.736)), rel=0.05)


def test_gears_centre_to_back_moves_the_plane_by_the_sine_of_its_root_angle():
    moved = SHIPPED.varied({"gear.machine.machine_center_to_back_mm": 6.5})
    expected = -0.526e-3 * math.sin(math.radians(59.653))
    assert reference_misfit(moved, "gear") == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize(
    ("field", "side"),
    [
        ("gear.cutter.convex_flank_angle_correction_deg", "drive"),
        ("pinion.cutter.convex_flank_angle_correction_deg", "coast"),
    ],
)
def test_slope_over_the_height_is_that_of_the_ease_off(field, side):
    """The ease-off comes from a search over the flank, without any equation of tangency."""
    turned = SHIPPED.varied({field: setting(SHIPPED, field) + 1.0})
    words = "flanks at the mean point, over"
    change = misfit(turned, f"{side} {words}") - misfit(SHIPPED, f"{side} {words}")
    before, after = (
        ease_off(FlankPair.from_file(file, side), s_count=6, t_count=3, gear_angles=ANGLES)
        for file in (SHIPPED, turned)
    )
    gap = (after.normal_gap() - before.normal_gap())[:, 1]
    up = 0.4 * SHIPPED.blank().whole_depth / math.cos(pressure_angle(SHIPPED, "gear", side))
    # 5 %: the slope is not the same over the height, from s = 0.4 to 0.8
    assert abs(change) == pytest.approx(abs(gap[4] - gap[2]) / up, rel=0.05)
    other = "coast" if side == "drive" else "drive"
    assert misfit(turned, f"{other} {words}") == misfit(SHIPPED, f"{other} {words}")


def test_teeth_of_the_other_hand_are_said():
    mirrored = SHIPPED.varied({"pinion.machine.basic_cradle_angle_deg": -64.433})
    said = refusal(mirrored)
    assert "the other hand" in said
    assert "basic_cradle_angle_deg from -64.433 to 64.433 deg (the sign)" in said


@pytest.mark.slow
@each(
    ("changes", "check", "cure"),
    [
        ({"gear.teeth": 41}, "tooth pitches", "gear.teeth from 41 to 36 (a miscount)"),
        ({"pair.offset_mm": 0.945}, "offset angle", "pair.offset_mm from 0.945 to 24.003 mm"),
        (
            {"pinion.machine.sliding_base_mm": -20.647},
            "reference plane",
            "pinion.machine.sliding_base_mm from -20.647 to 20.647 mm (the sign)",
        ),
        (
            {GEAR_CONVEX: 22.436, GEAR_CONCAVE: 15.815},
            "slope between the drive flanks",
            f"{GEAR_CONCAVE} from 15.815 to 22.436 deg and {GEAR_CONVEX} from 22.436 to 15.815 "
            "deg (exchanged)",
        ),
        (
            {"pinion.cutter.blade_groups": 5, "gear.cutter.blade_groups": 5},
            "spiral angle that the gear",
            "pinion.cutter.blade_groups from 5 to 11 and gear.cutter.blade_groups from 5 to 11",
        ),
        ({"pinion.machine.ratio_of_roll": 0.362}, "ratio of roll", "ratio_of_roll from 0.362 to 2"),
    ],
)
def test_a_refusal_says_the_check_and_the_setting_that_is_wrong(changes, check, cure):
    said = refusal(SHIPPED.varied(changes))
    assert check in said
    assert f"Most likely wrong: the flanks meet with {cure}" in said or cure in said


def test_a_value_that_is_no_slip_is_found_from_what_it_must_do():
    said = refusal(SHIPPED.varied({"gear.machine.vertical_setting_mm": 58.642}))
    value = said.split("gear.machine.vertical_setting_mm from 58.642 to ")[1].split(" mm")[0]
    # the spiral angle of the blank, which the printed cutter meets to 0.2 deg of 64 mm
    assert float(value) == pytest.approx(62.642, abs=0.25)


def test_two_wrong_settings_are_not_blamed_on_one():
    wrong = {"pinion.machine.sliding_base_mm": -20.647, "gear.teeth": 37}
    assert "two or more are wrong" in refusal(SHIPPED.varied(wrong))


@pytest.mark.slow
def test_a_small_misfit_is_a_warning_with_its_cure():
    off = SHIPPED.varied({"pinion.machine.sliding_base_mm": 21.147})
    check_pair(off)
    said = " ".join(pair_warnings(off))
    assert "reference plane from the middle of the working depth must be within 0.1 mm" in said
    assert "pinion.machine.sliding_base_mm from 21.147 to 20.6" in said


def test_cutter_far_from_the_tooth_is_refused_with_its_distance_and_cure():
    far = SHIPPED.varied({"pinion.machine.radial_setting_mm": 400.0})
    with pytest.raises(ParameterError, match=r"passes it by \d+ mm. Check radial_setting_mm"):
        pinion_cut(far, "concave")
    far = SHIPPED.varied({"gear.machine.horizontal_setting_mm": 400.0})
    with pytest.raises(ParameterError, match="horizontal_setting_mm"):
        Flank.from_file(far, "gear", "drive")


def slipped(file):
    """Every number of a file with one slip of the pen: sign, decimal point, unit, one tooth.

    Without the cradle angle, which is only a phase, blade edges ten times flatter, which are nearly
    straight, and changes that workshops make to shift the contact: below 0.15 mm and 0.2 deg.
    """
    for field, note in field_notes(HypoidGearFile).items():
        now = setting(file, field) if note.limits and note.kind != "text" else None
        if now is None or field == "pinion.machine.basic_cradle_angle_deg":
            continue
        if field.endswith(("teeth", "blade_groups")):
            values = [int(now) + 1, int(now) - 1, -int(now), 10 * int(now)]
            smallest = 1.0
        else:
            values = [-now, now / 10.0]
            values += [] if field.endswith("edge_radius_mm") else [10.0 * now]
            values += [now / 25.4] if field.endswith("_mm") else []
            values += [math.radians(now)] if field.endswith("_deg") else []
            smallest = 0.15 if field.endswith("_mm") else 0.2
        yield from ((field, value) for value in values if abs(value - now) >= smallest)


@pytest.mark.slow
@pytest.mark.parametrize("file", [*SOUND, *SYNTHESISED[::3]], ids=lambda file: file.name)
def test_every_single_slip_is_refused_or_warned_of_and_its_setting_is_named(file):
    """Nine of ten are refused; the rest only shift the contact, and are warned of."""
    missed, refused, count = [], 0, 0
    for field, value in slipped(file):
        count += 1
        try:
            wrong = file.varied({field: value})
            check_pair(wrong)
            said = " ".join(pair_warnings(wrong))
        except ParameterError as reason:
            said = str(reason)
            refused += 1
        if field not in said:
            missed.append((field, value))
    assert count > 125
    assert missed == []
    assert refused > 0.85 * count


def test_each_blade_whose_edge_crowns_too_much_is_named():
    radii = {"pinion.cutter.convex_flank_edge_radius_mm": 70.0,
             "pinion.cutter.concave_flank_edge_radius_mm": 60.0}  # fmt: skip
    file = MILLED.varied({"pinion.cutter.blade_edge_radius_mm": None, **radii})
    told = [m.what for m in edge_misfits(file)]
    assert len(set(told)) == len(told)
    assert all(any(name in one for one in told) for name in radii)


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
        ("gear.machine.horizontal_setting_mm", "gear.machine.vertical_setting_mm", (66.65, 62.642)),
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
