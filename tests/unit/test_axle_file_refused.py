"""Axle files that are refused, and frusta of shafts."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.bearing_section import stacked_frusta
from gearlube.cli.axle_gears import bring_gears_up_to_date
from gearlube_core.errors import ParameterError
from tests.helpers.axle_files import car_axle
from tests.helpers.each import each


def refusal(changes):
    with pytest.raises(ParameterError) as error:
        car_axle(changes)
    return str(error.value)


@each(
    ("changes", "parts"),
    [
        (
            {"pinion.bearing.rollers": 20},
            # 20 rollers have 62.7 mm sin(pi/20) each; 62.7 sin(pi/15) is 13.04, of 16 it is 12.2
            ["pinion.bearing: the rollers overlap: 20", "9.808 mm", "12.7 mm", "at most 15 fit"],
        ),
        ({"pinion.bearing.pitch_diameter_mm": 0.0627}, ["Is it in m? 0.0627 m is 62.7 mm"]),
        ({"pinion.bearing.pitch_diameter_mm": -60.0}, ["5 to 2000 mm, got -60.0"]),
        ({"pinion.bearing.pitch_diameter_mm": 200.0}, ["between bore and outside diameter"]),
        (
            # pitch diameter 71.85 mm, the mean; less 12.7 mm cos 15 deg: inside the bore
            {"pinion.bearing.bore_diameter_mm": 60.0},
            ["the rings must have room: races of 59.58 and 84.12 mm", "got 60 and 83.7 mm"],
        ),
        (
            {
                "gear.bearing.inner_race_diameter_mm": 50.0,
                "gear.bearing.outer_race_diameter_mm": 85.0,
            },
            ["gear.bearing: the rings must have room", "85 mm", "got 40 and 83.7 mm"],
        ),
        (
            {
                "gear.bearing.inner_race_diameter_mm": 75.0,
                "gear.bearing.outer_race_diameter_mm": 50.0,
            },
            ["The roller must fit between the races"],
        ),
        ({"pinion.bearing.contact_angle_deg": -15.0}, ["5 to 45 deg, got -15"]),
        ({"gear_set.backlash_um": -10.0}, ["0 to 2000 um, got -10"]),
        ({"pinion.bearing.preload_n": -5.0}, ["0 to 100000 N, got -5"]),
        ({"gear.bearing.interference_um": -5.0}, ["0 to 100 um, got -5"]),
        (
            {"housing.ring_diameter_mm": 165.0, "housing.immersion_mm": 200.0},
            ["immersion_mm must be at most ring_diameter_mm, 165 mm, got 200 mm"],
        ),
        ({"housing.immersion_mm": -2.0}, ["0 to 3000 mm, got -2"]),
        ({"seals.pinion_torque_n_m": -1.0}, ["0 to 100 N.m, got -1"]),
        ({"oil.density_kg_m3": 0.87}, ["Is it in g/cm3? 0.87 g/cm3 is 870 kg/m3"]),
        ({"oil.density_kg_m3": -870.0}, ["500 to 2000 kg/m3, got -870"]),
        ({"oil.viscosity_40_degc_mm2_s": 100.0}, ["must be given together"]),
        ({"oil.walther_a": 7.4, "oil.walther_b": -2.8}, ["0.3 to 10, got -2.8"]),
        ({"gear.bearing.contact_angle_deg": 0.26}, ["0.26 rad is 14.8969 deg"]),
        ({"gear.bearing.contact_angle_deg": 60.0}, ["5 to 45 deg, got 60.0"]),
        ({"gear_set.backlash_um": 150000.0}, ["Is it in nm? 150000 nm is 150 um"]),
        ({"steel.youngs_modulus_gpa": 210000.0}, ["Is it in MPa? 210000 MPa is 210 GPa"]),
        ({"vehicle.mass_kg": 1.3}, ["100 to 100000 kg, got 1.3", "1.3 t is 1300 kg"]),
        ({"gear.inertia_kg_m2": 58100.0}, ["58100 kg.mm2 is 0.0581 kg.m2"]),
        ({"gearbox.ratios": [3.0, 3.5]}, ["gearbox: ratios must fall", "First gear comes first"]),
        ({"gearbox.ratios": []}, ["gearbox.ratios"]),
        ({"oil.name": "sae90"}, ["jamali_2015, karagiannis_2012, mohammadpour_2015", "'sae90'"]),
        ({"oil.walther_a": 7.0}, ["walther_a and walther_b must be given together"]),
        (
            {"oil.viscosity_40_degc_mm2_s": 15.0, "oil.viscosity_100_degc_mm2_s": 100.0},
            ["Viscosity must fall with temperature"],
        ),
        (
            {"pinion.bearing.preload_n": 2000.0, "pinion.bearing.interference_um": 5.0},
            ["2000 N and 5 um; give one of them"],
        ),
        ({"pinion.bearing.inner_race_diameter_mm": 50.0}, ["must be given together"]),
        ({"tyre.size": "big"}, ["195/65R16", "'big'"]),
        (
            {"tyre.size": "195/65R16", "tyre.rolling_radius_mm": 320.0},
            ["describe the same tyre; give one"],
        ),
        ({"engine.orders": [2]}, ["the same number of entries, got 1, 0 and 0"]),
        ({"engine.idle_speed_rpm": 7000.0}, ["highest_speed_rpm must be within 7000"]),
        ({"vehicle.drag_area_m2": 0.7, "vehicle.frontal_area_m2": 2.2}, ["give one"]),
        ({"gear_set.mesh_damping": "modal", "gear_set.modal_loss_factor": 0.0}, ["above 0"]),
        ({"pinion.mas_kg": 12.0}, ["is it pinion.mass_kg?"]),
        ({"pinion.bearing.roller_lenght_mm": 12.0}, ["is it pinion.bearing.roller_length_mm?"]),
    ],
)
def test_what_no_axle_has_is_refused_with_value_limit_and_cure(changes, parts):
    said = refusal(changes)
    for part in parts:
        assert part in said, said


def test_all_wrong_fields_are_named_at_once():
    said = refusal(
        {
            "pinion.bearing.rollers": 20,
            "gear.mass_kg": -1.0,
            "oil.name": "water",
            "gearbox.ratios": [1.0, 2.0],
            "vehicle.mass_kg": math.nan,
        }
    )
    assert said.startswith("my.toml has 5 wrong field(s).")
    for part in ("overlap", "gear.mass_kg", "'water'", "must fall", "got nan"):
        assert part in said


def test_a_file_without_gear_set_says_what_it_needs():
    with pytest.raises(ParameterError, match=r"gear_set: mesh_table or gear_file must be given"):
        AxleFile.from_data({"name": "x"}, "my.toml")


def test_a_backlash_in_mm_is_asked_about(caplog, tmp_path):
    path = tmp_path / "axle.toml"
    text = '[gear_set]\nmesh_table = "mohammadpour_2015"\nbacklash_um = 0.13\n'
    path.write_text(text)
    bring_gears_up_to_date(path)
    assert "Is it in mm? 0.13 mm is 130 um." in caplog.text
    notes = {note.field: note for note in AxleFile.from_toml(path).car_axle().inputs}
    assert "Is it in mm?" in notes["gear_set.backlash_um"].why
    caplog.clear()
    for plausible in ("0.0", "30.0"):  # none on purpose, and the least of cut gears
        path.write_text(text.replace("0.13", plausible))
        bring_gears_up_to_date(path)
        assert not caplog.text


STEEL = 7850.0  # kg/m3, of the paper
SHAFT = {
    "frusta_lengths_mm": [33.0, 150.0],
    "frusta_first_diameters_mm": [60.0, 40.0],
    "frusta_last_diameters_mm": [85.0, 40.0],
}


def car(pinion=None, **sections):
    data = {"gear_set": {"mesh_table": "mohammadpour_2015"}, "pinion": pinion or {}, **sections}
    return AxleFile.from_data(data, "my.toml").car_axle()


def test_a_hollow_cylinder_has_its_well_known_mass_and_inertia():
    found = stacked_frusta((0.03,), (0.165,), (0.165,), (0.1,), STEEL)
    mass = STEEL * math.pi / 4.0 * (0.165**2 - 0.1**2) * 0.03
    assert found.mass == pytest.approx(mass, rel=1e-13)
    assert found.inertia == pytest.approx(mass / 8.0 * (0.165**2 + 0.1**2), rel=1e-13)


def test_a_cone_has_a_third_of_the_cylinder_and_three_tenths_of_its_mass_as_inertia():
    found = stacked_frusta((0.05,), (0.08,), (1e-12,), (0.0,), STEEL)
    mass = STEEL * math.pi * 0.04**2 * 0.05 / 3.0
    assert found.mass == pytest.approx(mass, rel=1e-10)  # the tip of 1e-12 m
    assert found.inertia == pytest.approx(0.3 * mass * 0.04**2, rel=1e-10)


def test_a_stack_is_the_sum_of_its_discs():
    lengths, first, last = (0.033, 0.15), (0.06, 0.04), (0.085, 0.036)
    bores = (0.0, 0.012)
    mass = inertia = 0.0
    for length, one, two, bore in zip(lengths, first, last, bores, strict=True):

        def radius(x, length=length, one=one, two=two):
            return 0.5 * (one + (two - one) * x / length)

        def disc(x, power, bore=bore, radius=radius):
            return radius(x) ** power - (0.5 * bore) ** power

        mass += STEEL * math.pi * quad(disc, 0.0, length, args=(2,))[0]
        inertia += STEEL * math.pi / 2.0 * quad(disc, 0.0, length, args=(4,))[0]
    found = stacked_frusta(lengths, first, last, bores, STEEL)
    assert found == pytest.approx((mass, inertia), rel=1e-12)  # polynomials: quadrature is exact


def test_what_the_file_does_not_give_is_inferred_from_the_frusta_and_said_so():
    made = car(pinion=SHAFT)
    expected = stacked_frusta((0.033, 0.15), (0.06, 0.04), (0.085, 0.04), (0.0, 0.0), STEEL)
    axle = made.axle
    assert (axle.pinion_mass, axle.pinion_inertia) == pytest.approx(expected, rel=1e-13)
    assert (axle.gear_mass, axle.gear_inertia) == (49.9, 5.81e-2)  # the paper's
    notes = {note.field: note for note in made.assumed}
    for field, unit in (("pinion.mass_kg", "kg"), ("pinion.inertia_kg_m2", "kg.m2")):
        note = notes[field]
        assert (note.origin, note.unit) == ("inferred", unit)
        assert note.why == "2 frusta, density 7850 kg/m3"
    assert notes["gear.mass_kg"].origin == "assumed"
    given = {note.field: note.origin for note in made.inputs}
    assert given["pinion.frusta_lengths_mm"] == "given"


def test_a_given_mass_goes_before_the_frusta_and_the_density_is_that_of_the_steel():
    made = car(pinion=SHAFT | {"mass_kg": 10.5}, steel={"density_kg_m3": 7700.0}).axle
    assert made.pinion_mass == 10.5
    heavier = car(pinion=SHAFT).axle
    assert made.pinion_inertia == pytest.approx(heavier.pinion_inertia * 7700.0 / STEEL, rel=1e-13)


@each(
    ("changes", "words"),
    [
        ({"frusta_last_diameters_mm": [85.0]}, "same number of entries, got 2, 2, 1"),
        ({"frusta_lengths_mm": None}, "same number of entries, got 0, 2, 2"),
        ({"frusta_bores_mm": [0.0]}, "same number of entries, got 2, 2, 2, 1"),
        ({"frusta_bores_mm": [0.0, 40.0]}, "got 40 mm in frustum 2 of 40 and 40 mm"),
        ({"frusta_lengths_mm": [33.0, 0.0]}, "frusta_lengths_mm"),
        ({"frusta_lengths_mm": [0.1, 0.1], "frusta_first_diameters_mm": [1.0, 1.0],
          "frusta_last_diameters_mm": [1.0, 1.0]}, "pinion_(inertia|mass) must be within"),
    ],
)  # fmt: skip
def test_frusta_that_are_no_solid_are_refused(changes, words):
    pinion = {key: one for key, one in (SHAFT | changes).items() if one is not None}
    with pytest.raises(ParameterError, match=words):
        car(pinion=pinion)
