"""Profile shifts of helical pairs: thickness, backlash and teeth that cannot be."""

import math

import pytest

from fmu_src.helical_pair import definition_with
from gearlube.output.toml_text import toml_text
from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.problem import read_gear_file
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.each import each

SHIFTED = {
    "name": "shifted", "source": "by hand",
    "pair": {
        "normal_module_mm": 1.0, "normal_pressure_angle_deg": 20.0, "helix_angle_deg": 15.0,
        "centre_distance_mm": 27.5, "face_width_mm": 9.0,
    },
    "pinion": {"teeth": 17, "tip_diameter_mm": 19.999695, "root_diameter_mm": 15.499695,
               "profile_shift_coefficient": 0.2},
    "gear": {"teeth": 35, "tip_diameter_mm": 38.034666, "root_diameter_mm": 33.534666,
             "profile_shift_coefficient": -0.1},
}  # fmt: skip


def shifted(**changes):
    return HelicalGearFile.from_data(SHIFTED, "shifted").varied(changes)


def closed_backlash(file):
    """p_wt - s_w1 - s_w2 at the working circles, along the normal: DIN 3960, by arcs."""
    pair, a_n = file.helical_pair(), math.radians(20.0)
    cos = math.cos(math.radians(15.0))
    alpha = math.atan(math.tan(a_n) / cos)
    involute = lambda angle: math.tan(angle) - angle  # noqa: E731
    working = math.acos(52 / (2 * cos) * math.cos(alpha) / 27.5)
    arcs = 0.0
    for z, s_t in zip((17, 35), pair.tooth_thickness, strict=True):
        r_w = z * 27.5 / 52
        arcs += r_w * (1e3 * s_t / (z / (2 * cos)) + 2 * (involute(alpha) - involute(working)))
    base_helix = math.asin(math.sin(math.radians(15.0)) * math.cos(a_n))
    gap = 2 * math.pi * 27.5 / 52 - arcs
    return gap * math.cos(working) * math.cos(base_helix)


def test_profile_shifts_make_the_teeth_thick_and_leave_backlash():
    file = shifted()
    pair = file.helical_pair()
    # (pi/2 + 2 x tan 20 deg)/cos 15 deg
    assert 1e3 * pair.tooth_thickness[0] == pytest.approx(1.776932, abs=1e-6)
    assert 1e3 * pair.tooth_thickness[1] == pytest.approx(1.550846, abs=1e-6)
    assert 1e3 * pair.backlash == pytest.approx(closed_backlash(file), abs=1e-9)
    assert 1e3 * pair.backlash == pytest.approx(0.359, abs=5e-4)
    assert file.guesses() == []
    # more backlash than the shifts leave comes off both members alike
    thinner = shifted(**{"pair.backlash_mm": 0.459})
    assert closed_backlash(thinner) == pytest.approx(0.459, abs=1e-9)
    less = [
        a - b
        for a, b in zip(pair.tooth_thickness, thinner.helical_pair().tooth_thickness, strict=True)
    ]
    assert less[0] == pytest.approx(less[1], rel=1e-9)


def test_a_shift_left_out_follows_from_the_other_and_both_are_guessed_aloud():
    one = shifted(**{"gear.profile_shift_coefficient": None}).helical_pair()
    assert one.backlash == 0.0
    assert sum(one.profile_shifts) == pytest.approx(one.profile_shift_sum)
    assert one.profile_shifts[0] == 0.2
    # its root is as deep as if it were given: 1.25 modules, not those of a stub tip
    rootless = shifted(**{
        "gear.profile_shift_coefficient": None, "gear.root_diameter_mm": None,
        "gear.tip_diameter_mm": 37.8,
    }).helical_pair()  # fmt: skip
    depth = rootless.gear_reference_radius - rootless.gear_root_radius
    assert 1e3 * depth == pytest.approx(1.25 - rootless.profile_shifts[1], rel=1e-9)
    none = {f"{role}.profile_shift_coefficient": None for role in ("pinion", "gear")}
    both = shifted(**none)
    assert "guessed: x = 0.462 (pinion) and 0.162 (gear)" in both.guesses()[0]
    # standard pair with short gear tips: tips say 0.2 and -0.2, roots of 1.25 modules say 0
    stub = HelicalGearFile.from_data(
        {
            "name": "stub", "source": "by hand",
            "pair": {
                "normal_module_mm": 3.0, "normal_pressure_angle_deg": 20.0, "helix_angle_deg": 0.0,
                "centre_distance_mm": 90.0, "face_width_mm": 20.0,
            },
            "pinion": {"teeth": 20, "tip_diameter_mm": 66.0, "root_diameter_mm": 52.5},
            "gear": {"teeth": 40, "tip_diameter_mm": 123.6, "root_diameter_mm": 112.5},
        },
        "stub",
    )  # fmt: skip
    assert "doubtful: with them addenda are 0.80 and dedenda 1.45" in stub.remarks()[0]
    zero = {f"{role}.profile_shift_coefficient": 0.0 for role in ("pinion", "gear")}
    known = stub.varied(zero)
    assert known.remarks() == []
    assert known.helical_pair().tooth_thickness == pytest.approx((1.5e-3 * math.pi,) * 2)
    # without root diameters: the rack's dedendum under the shift
    bare = known.varied({"pinion.root_diameter_mm": None, "gear.root_diameter_mm": None})
    assert bare.helical_pair().gear_root_radius == pytest.approx(56.25e-3)


@each(
    ("changes", "words"),
    [
        ({"pinion.profile_shift_coefficient": 0.9}, r"at least 0 mm .* got -0\.1201 mm: .* jam"),
        ({"pair.backlash_mm": 0.0}, "at least the 0.3587 mm that the profile shifts leave"),
        ({"pair.centre_distance_mm": 26.9}, "at least 0 mm .* jam. x1 . x2 must be at most"),
        (
            {"pinion.root_diameter_mm": 17.3},
            "tips over the pinion's roots must be at least 0 mm, got -0.167 mm.*Increase",
        ),
        (
            {"pinion.tip_diameter_mm": 21.9, "gear.root_diameter_mm": 32.0},
            "pinion's teeth are pointed: they must have a topland above 0 mm, got -0.",
        ),
    ],
)
def test_teeth_that_cannot_be_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        shifted(**changes)


@pytest.mark.parametrize("reader", [HelicalGearFile.given, read_gear_file, definition_with])
def test_every_reader_of_a_gear_file_says_what_its_teeth_are(reader, tmp_path, caplog):
    """A rack of 14.5 deg undercuts below 2 (1.25 - 0.25 (1 - sin a))/sin2 a = 33.9 teeth."""
    path = tmp_path / "pair.toml"
    data = HelicalGearFile.named("he_2007").model_dump(exclude_none=True, exclude_defaults=True)
    data["pair"] = {
        "normal_module_mm": 3.0, "normal_pressure_angle_deg": 14.5, "helix_angle_deg": 0.0,
        "centre_distance_mm": 72.0, "face_width_mm": 20.0,
    }  # fmt: skip
    for role in ("pinion", "gear"):
        data[role] |= {"teeth": 24, "tip_diameter_mm": 78.0, "root_diameter_mm": 64.5}
    path.write_text(toml_text(data))
    reader(str(path))
    for words in ("The pinion is undercut", "The gear is undercut", "Profile shift coefficients"):
        assert caplog.text.count(f"{path}: {words}") == 1


def test_tips_in_the_mates_roots_are_refused_and_near_ones_named():
    """a - d_a1/2 - d_f2/2 of a pair 23/57, 2.5 mm, 25 deg: 110.338 - 35.0645 - 75.7405."""
    data = {
        "name": "deep", "source": "by hand",
        "pair": {
            "normal_module_mm": 2.5, "normal_pressure_angle_deg": 20.0, "helix_angle_deg": 25.0,
            "centre_distance_mm": 110.338, "face_width_mm": 20.0,
        },
        "pinion": {"teeth": 23, "tip_diameter_mm": 70.129, "root_diameter_mm": 58.944},
        "gear": {"teeth": 57, "tip_diameter_mm": 162.666, "root_diameter_mm": 151.481},
    }  # fmt: skip
    with pytest.raises(ParameterError, match=r"must be at least 0 mm, got -0\.467 mm"):
        HelicalGearFile.from_data(data, "deep")
    data["pinion"]["root_diameter_mm"], data["gear"]["root_diameter_mm"] = 57.8, 150.2
    near = HelicalGearFile.from_data(data, "near").remarks()
    assert "tips over the pinion's roots is 0.105 mm, below 0.1 normal modules" in " ".join(near)
