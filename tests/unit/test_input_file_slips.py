"""Slips of a first user: a file of another kind, a decimal comma, a path, kelvin for degC."""

import pytest

from drivetrain.axle_file.axle_file import AxleFile
from gearlube.cli.oil_option import oil_kelvin
from gearlube.cli.ranges import numbers_from
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.input_file import read_toml
from gearlube_core.oil.oil_file import OilFile
from tests.helpers.each import each

KINDS = {
    AxleFile: ("mohammadpour_2015", "an axle file"),
    HypoidGearFile: ("mohammadpour_2015", "a gear file of a hypoid pair"),
    HelicalGearFile: ("he_2007", "a gear file of a helical pair"),
    BlankFile: ("hypoid_13_42", "a blank file"),
    OilFile: ("iso_vg_220_pao", "an oil file"),
}


@each("asked", KINDS)
@each("given", KINDS)
def test_a_file_of_another_kind_is_called_by_its_name(asked, given, tmp_path):
    name, words = KINDS[given]
    path = tmp_path / "given.toml"
    path.write_text(given.shipped_text(name), encoding="utf-8")
    if asked is given:
        assert asked.from_toml(path)
        return
    with pytest.raises(ParameterError, match=f"those of {words}") as told:
        asked.from_toml(path)
    assert len(str(told.value)) < 400  # not a list of fields


def test_a_wrong_field_of_the_right_kind_is_still_named(tmp_path):
    path = tmp_path / "axle.toml"
    path.write_text('[gear_set]\nmesh_table = "mohammadpour_2015"\nbacklash = 1.0\n')
    with pytest.raises(ParameterError, match=r"is it gear_set\.backlash_um"):
        AxleFile.from_toml(path)


def test_a_misspelt_field_is_told_together_with_fields_that_contradict_each_other(tmp_path):
    path = tmp_path / "axle.toml"
    text = '[gear_set]\nmesh_table = "mohammadpour_2015"\nbacklash = 90.0\ngear_file = "g.toml"\n'
    path.write_text(text)
    with pytest.raises(ParameterError, match=r"2 wrong field\(s\)") as told:
        AxleFile.from_toml(path)
    assert "is it gear_set.backlash_um?" in str(told.value)
    assert "give mesh_table or gear_file, not both" in str(told.value)
    # under the name that is meant, the value is wrong too
    path.write_text(text.replace("90.0", "-1.0").replace('gear_file = "g.toml"\n', ""))
    with pytest.raises(ParameterError, match="0 to 2000 um, got -1"):
        AxleFile.from_toml(path)


def test_a_misspelt_field_that_is_needed_is_not_called_missing(tmp_path):
    path = tmp_path / "axle.toml"
    path.write_text('[gear_set]\nmesh_tabel = "mohammadpour_2015"\n')
    with pytest.raises(ParameterError, match=r"1 wrong field\(s\).*is it gear_set.mesh_table\?"):
        AxleFile.from_toml(path)
    path.write_text('[gear_set]\nquux = "mohammadpour_2015"\n')  # means nothing that is known
    with pytest.raises(ParameterError, match=r"1 wrong field\(s\).*quux is not a field"):
        AxleFile.from_toml(path)


def test_a_decimal_comma_and_a_missing_file_have_a_cure(tmp_path):
    path = tmp_path / "axle.toml"
    path.write_text('a = [1, 2]\nname = "x, 1,5"\npreload_n = 5000,5  # N\n')
    with pytest.raises(ParameterError, match=r"Write 5000\.5, with a point"):
        read_toml(path)
    path.write_text("a = [1, 2\n")
    with pytest.raises(ParameterError) as told:
        read_toml(path)
    assert "point" not in str(told.value)
    with pytest.raises(ParameterError, match=rf"file none\.toml was not found in {tmp_path}\."):
        read_toml(tmp_path / "none.toml")


def test_kelvin_for_degc_is_asked_about():
    with pytest.raises(ParameterError, match=r"Is it in K\? 353 K is 79\.85 degC"):
        oil_kelvin(353.0, "mohammadpour_2015")
    with pytest.raises(ParameterError, match=r"353 K is 79\.85 degC"):
        numbers_from("--t", ["40", "353"], "degC", -60.0, 250.0, example="40:100:20")
    with pytest.raises(ParameterError) as told:
        oil_kelvin(900.0, "mohammadpour_2015")
    assert "in K" not in str(told.value)


@each(
    ("kind", "field", "meant"),
    [
        (HelicalGearFile, "pinion.profile_shift", "pinion.profile_shift_coefficient?"),
        (
            HelicalGearFile,
            "pair.profile_shift",
            "gear.profile_shift_coefficient or pinion.profile_shift_coefficient?",
        ),
        (HelicalGearFile, "pinion_teeth", "pinion.teeth?"),
        (HelicalGearFile, "pair.facewidth_mm", "pair.face_width_mm?"),
        (HelicalGearFile, "pair.center_distance_mm", "pair.centre_distance_mm?"),
        (HelicalGearFile, "gear.tip_dia_mm", "gear.tip_diameter_mm?"),
        (HelicalGearFile, "pinion.x", ""),
        (HelicalGearFile, "pinion.profile_angle", ""),
        (BlankFile, "pair.cone_angle_deg", ""),
        (BlankFile, "cutter.blades", "cutter.blade_groups?"),
        (AxleFile, "oil.immersion", "housing.immersion_mm?"),
    ],
)
def test_an_unknown_field_is_asked_for_by_its_words_or_not_at_all(kind, field, meant):
    """profile_shift has twelve letters of profile_slope_um, but not its second word."""
    *sections, key = field.split(".")
    data = {sections[0]: {key: 1.0}} if sections else {key: 1.0}
    with pytest.raises(ParameterError) as told:
        kind.from_data(data, "mine")
    said = str(told.value).partition(f"{field} is not a field of this file")[2]
    assert said.startswith(f"; is it {meant}" if meant else ".")
