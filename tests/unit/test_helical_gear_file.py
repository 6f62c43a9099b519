"""Numbers that a helical gear file refuses, completes and reports."""

import math
import re

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.modification import PowerTipRelief, TipRelief
from gearlube_core.input_file.field_notes import field_notes
from tests.helpers.each import each
from tests.helpers.named_pairs import PAIRS, named_pair

HE = HelicalGearFile.named("he_2007")
JAMALI = HelicalGearFile.named("jamali_2015_a")
NOTES = field_notes(HelicalGearFile)
NUMBERS = [name for name, note in NOTES.items() if note.kind in ("number", "whole number")]
INCH, POUND_FORCE = 0.0254, 4.4482216152605
SLUG_INCH = POUND_FORCE / INCH  # kg in 1 lbf.s2/in


def file_with(name):
    """A file whose optional sections are there to be varied."""
    return JAMALI if name.startswith(("oil", "meshing_steps")) else HE


def test_values_beyond_their_range_are_named_with_range_and_unit():
    for name in NUMBERS:
        low, high = re.search(r"(-?[\d.e+]+) to (-?[\d.e+]+)", NOTES[name].limits).groups()
        for value in (float(low) - 1.0, 2.0 * float(high) + 1.0):
            wrong = int(value) if NOTES[name].kind == "whole number" else value
            with pytest.raises(ParameterError) as caught:
                file_with(name).varied({name: wrong})
            message = str(caught.value)
            assert f"{name} must be a {NOTES[name].kind}, {NOTES[name].limits}" in message
            assert f"got {wrong!r}" in message
            assert NOTES[name].unit in message


def test_every_number_has_a_unit_or_needs_none_and_a_meaning():
    plain = (
        "teeth", "facets", "tip_relief_parabola", "tip_relief_exponent", "mesh", "translation",
        "tilt", "nodes_across", "nodes_along", "count", "fillet_radius_factor",
        "profile_shift_coefficient",
    )  # fmt: skip
    for name in NUMBERS:
        assert NOTES[name].unit or name.rsplit(".", 1)[1] in plain, name
        assert len(NOTES[name].meaning) > 5, name


@each(
    ("changes", "words"),
    [
        ({"pair.normal_module_mm": 3.0}, "pair: exactly one of normal_module_mm and .* got both"),
        ({"pair.transverse_module_mm": None}, "transverse_module_mm must be given, got neither"),
        (
            {"pair.transverse_pressure_angle_deg": None},
            "exactly one of normal_pressure_angle_deg .* got neither",
        ),
        (
            {"pinion.root_diameter_mm": 85.852},
            r"pinion: root_diameter_mm must be below tip_diameter_mm, 85\.852 mm, got 85\.852 mm",
        ),
        (
            {"gear.flank.tip_relief_um": 5.0},
            "gear.flank: tip_relief_depth_mm is missing; it must be above 0 mm",
        ),
        (
            {"gear.flank.crown_um": 8.0, "gear.flank.crown_start_mm": 15.875},
            r"gear\.flank\.crown_start_mm must be below half of pair\.face_width_mm, 15\.875 mm",
        ),
        ({"gear.bearing_1": None}, "gear needs bearing_1 and bearing_2, or neither"),
        (
            {"gear.bearing_1.coupling_y_kn_per_rad": 9.0},
            r"gear\.bearing_1: coupling_y_kn_per_rad must be within 0 to 0 kN/rad, got 9 kN/rad",
        ),
        (
            {
                "gear.bearing_1.stiffness_x_n_per_um": 100.0,
                "gear.bearing_1.tilt_y_knm_per_rad": 10.0,
                "gear.bearing_1.coupling_x_kn_per_rad": -1001.0,
            },
            "must be within -1000 to 1000 kN/rad, got -1001 kN/rad; or raise tilt_y_knm_per_rad",
        ),
        ({"gear.flank.tip_relief_form": "cubic"}, "text, blended or power, got 'cubic'"),
        ({"pair.helix_angle": 20.0}, r"is it pair\.helix_angle_deg\?"),
        ({"pair.centre_distance_mm": 75.0}, r"pair\.centre_distance_mm .* 1\d\d\S* mm, got 75 mm"),
        (
            {"pinion.tip_diameter_mm": 120.0},
            "Contact must lie between the tangent points.* Reduce the tip radii",
        ),
        ({"completed": {"gear.colour": "as it is"}}, "'gear.colour', which is not a field"),
        ({"inferred": {"gear.body": ""}}, r"inferred\.gear\.body"),
        ({"compared_with": ["he_2008"]}, "compared_with must name shipped .* got 'he_2008'"),
        (
            {
                "meshing_steps.first_position_mm": -18.7,
                "meshing_steps.step_mm": 0.04,
                "meshing_steps.count": 400,
                "meshing_steps.shown": [75, 500],
            },
            r"meshing_steps: shown must hold steps up to count, 400, got \(75, 500\)",
        ),
    ],
)
def test_fields_that_contradict_each_other_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        HE.varied(changes)


def test_unknown_and_unreadable_files_are_refused(tmp_path):
    with pytest.raises(ParameterError, match=r"Shipped: he_2007, jamali_2015_a, jamali_2015_b\."):
        HelicalGearFile.named("he_2008")
    path = tmp_path / "broken.toml"
    path.write_text("name = ", encoding="utf-8")
    with pytest.raises(ParameterError, match="not a readable TOML file"):
        HelicalGearFile.from_toml(path)


def test_a_file_of_one_s_own_needs_only_macro_geometry(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        """
        name = "mine"
        source = "a drawing"
        [pair]
        normal_module_mm = 2.0
        normal_pressure_angle_deg = 20.0
        helix_angle_deg = 0.0
        centre_distance_mm = 60.0
        face_width_mm = 20.0
        [pinion]
        teeth = 20
        tip_diameter_mm = 44.0
        [gear]
        teeth = 40
        tip_diameter_mm = 84.0
        """,
        encoding="utf-8",
    )
    file = HelicalGearFile.from_toml(path)
    pair = file.helical_pair()
    assert pair.pinion_root_radius == pytest.approx(17.5e-3, rel=1e-12)  # 20 - 1.25 m
    assert pair.working_pressure_angle == pytest.approx(math.radians(20.0), rel=1e-9)
    assert file.body("gear").supports == ()
    assert file.oil is None
    assert file.operation is None
    plain = file.modified_pair()
    assert plain.pinion == plain.gear
    assert plain.pinion.tip_relief is None
    assert plain.pinion.crown is None


def test_inches_of_the_paper_arrive_in_si():
    """Sec. 3 of He et al. 2007, converted here again; the file rounds to the seventh digit."""
    pair = HE.helical_pair()
    printed = {
        "centre_distance": 3.5, "pinion_tip_radius": 0.5 * 3.38, "gear_tip_radius": 0.5 * 4.13,
        "pinion_root_radius": 0.5 * 2.811, "gear_root_radius": 0.5 * 3.561, "face_width": 1.25,
        "transverse_module": 1.0 / 8.0,
    }  # fmt: skip
    for name, inches in printed.items():
        assert getattr(pair, name) == pytest.approx(inches * INCH, rel=1e-12), name
    assert math.degrees(pair.transverse_pressure_angle) == pytest.approx(25.0, rel=1e-12)
    assert (pair.pinion_teeth, pair.gear_teeth) == (25, 31)
    for role, mass, inertia in (("pinion", 1.26e-2, 8.33e-3), ("gear", 1.58e-2, 1.64e-2)):
        body = HE.body(role)
        assert body.mass == pytest.approx(mass * SLUG_INCH, rel=1e-6)
        assert body.polar_inertia == pytest.approx(inertia * POUND_FORCE * INCH, rel=1e-6)
        disc = 0.5 * body.polar_inertia + body.mass * pair.face_width**2 / 12.0
        assert body.diametral_inertia == pytest.approx(disc, rel=1e-12)
        total = sum(support.K_xx for support in body.supports)
        assert total == pytest.approx(8e6 * SLUG_INCH, rel=1e-6)  # lbf/in
        assert [support.position for support in body.supports] == pytest.approx([0.0508, -0.0508])
    assert HE.operation.pinion_torque_n_m == pytest.approx(2000 * POUND_FORCE * INCH, rel=1e-5)


def test_pitch_diameters_of_the_paper_are_those_of_its_teeth():
    pair = HE.helical_pair()
    for teeth, inches in ((25, 3.125), (31, 3.875)):
        assert teeth * pair.transverse_module == pytest.approx(inches * INCH, rel=1e-12)


def test_thesis_data_arrive_in_si():
    assert JAMALI.operation.pinion_speed_rpm * math.pi / 30.0 == pytest.approx(235.62, abs=5e-3)
    modified = JAMALI.modified_pair()
    for flank in (modified.pinion, modified.gear):
        assert flank.tip_relief == TipRelief(amount=70e-6, extent=2e-3, k=1.0)
        assert flank.crown.amount == pytest.approx(8e-6, rel=1e-12)
        assert flank.crown.start == 0.0
    assert JAMALI.varied({"gear.flank.facets": 20}).modified_pair().gear.facets == 20
    sloped = {"pinion.flank.lead_slope_um": 5.0, "gear.flank.profile_slope_um": -3.0}
    flanks = JAMALI.varied(sloped).modified_pair()
    assert flanks.pinion.lead_slope == pytest.approx(5e-6, rel=1e-12)
    assert flanks.gear.profile_slope == pytest.approx(-3e-6, rel=1e-12)
    power = JAMALI.varied(
        {"pinion.flank.tip_relief_form": "power", "pinion.flank.tip_relief_exponent": 4.0}
    ).modified_pair()
    assert power.pinion.tip_relief == PowerTipRelief(amount=70e-6, extent=2e-3, beta=4.0)


def test_small_and_given_values_arrive_in_si():
    file = JAMALI.varied(
        {
            "gear.flank.tip_relief_um": 0.5, "pinion.flank.crown_um": 0.5,
            "pinion.flank.crown_start_mm": 3.0, "pair.backlash_mm": 0.12,
            "gear.body.diametral_inertia_kg_mm2": 4321.0, "gear.body.polar_inertia_kg_mm2": 8000.0,
        }
    )  # fmt: skip
    flanks = file.modified_pair()
    assert flanks.gear.tip_relief.amount == pytest.approx(5e-7, rel=1e-12)
    assert flanks.pinion.crown.amount == pytest.approx(5e-7, rel=1e-12)
    assert flanks.pinion.crown.start == pytest.approx(3e-3, rel=1e-12)
    assert file.helical_pair().backlash == pytest.approx(1.2e-4, rel=1e-12)
    assert file.body("gear").diametral_inertia == pytest.approx(4.321e-3, rel=1e-12)
    assert file.body("gear").polar_inertia == pytest.approx(8e-3, rel=1e-12)


def test_depth_without_an_amount_is_no_relief():
    plain = JAMALI.varied({"gear.flank.tip_relief_um": 0.0}).modified_pair()
    assert plain.gear.tip_relief is None
    assert plain.pinion.tip_relief is not None


def test_bodies_the_thesis_lacks_are_steel_discs_of_the_root_diameter():
    pair, body = JAMALI.helical_pair(), JAMALI.body("pinion")
    root = 0.5 * 166.61e-3 - 2.25 * 4.5e-3
    assert pair.pinion_root_radius == pytest.approx(root, rel=1e-12)
    mass = 7850.0 * math.pi * root**2 * 44e-3
    assert body.mass == pytest.approx(mass, rel=1e-12)
    assert body.polar_inertia == pytest.approx(0.5 * mass * root**2, rel=1e-12)
    heavier = JAMALI.varied({"pinion.body.mass_kg": 10.0}).body("pinion")
    assert heavier.polar_inertia == pytest.approx(5.0 * root**2, rel=1e-12)


def test_bearing_terms_keep_their_places():
    terms = {
        "stiffness_x_n_per_um": 100.0, "stiffness_y_n_per_um": 200.0, "stiffness_z_n_per_um": 300.0,
        "tilt_x_knm_per_rad": 4.0, "tilt_y_knm_per_rad": 5.0, "coupling_x_kn_per_rad": 6.0,
        "coupling_y_kn_per_rad": -7.0, "distance_mm": 80.0,
    }  # fmt: skip
    file = HE.varied({f"gear.bearing_2.{name}": value for name, value in terms.items()})
    got = file.body("gear").supports[1]
    assert tuple(got) == pytest.approx((-0.08, 1e8, 2e8, 3e8, 4e3, 5e3, 6e3, -7e3))


@each(
    ("file", "field", "origin", "words"),
    [
        (HE, "pinion.teeth", "table", ""),
        (HE, "pinion.root_diameter_mm", "table", ""),
        (HE, "pair.backlash_mm", "completed", "excludes tooth separation"),
        (HE, "pinion.bearing_1.stiffness_y_n_per_um", "completed", "harmonics 8 to 10"),
        (HE, "gear.body.diametral_inertia_kg_mm2", "completed", "J_z/2"),
        (JAMALI, "gear.root_diameter_mm", "completed", "basic rack"),
        (JAMALI, "gear.body.mass_kg", "completed", "steel disc"),
        (JAMALI, "pair.normal_pressure_angle_deg", "inferred", "normal angle"),
    ],
)
def test_every_number_says_where_it_is_from(file, field, origin, words):
    assert file.origin(field) == origin
    sentence = file.provenance(field)
    assert sentence.startswith(origin)
    assert words in sentence
    assert (sentence == origin) == (words == "")


def test_given_data_are_not_called_completed():
    file = JAMALI.varied({"gear.body.mass_kg": 6.0, "gear.root_diameter_mm": 150.0})
    assert file.origin("gear.body.mass_kg") == "table"
    assert file.origin("gear.root_diameter_mm") == "table"


@pytest.mark.parametrize("name", PAIRS)
def test_shipped_files_are_read_and_survive_being_written(name):
    file = HelicalGearFile.named(name)
    assert HelicalGearFile.shipped() == PAIRS
    assert named_pair(name) == file.helical_pair()
    assert file.name == name
    again = HelicalGearFile.from_data(file.model_dump(exclude_none=True), "again")
    assert again == file


# 17 and 35 teeth, 1 mm, 15 deg, x = 0.2 and -0.1, 27.5 mm apart
