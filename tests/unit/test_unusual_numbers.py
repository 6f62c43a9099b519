"""What every kind of input file does with numbers in wrong units, its files, and its text."""

from __future__ import annotations

import logging
import math
from typing import Any

import pytest

from drivetrain.axle_file.axle_file import AxleFile
from gearlube.output.toml_text import toml_text
from gearlube.variation.keys import file_keys
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.problem import Problem, read_gear_file
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile, read_toml, toml_data
from gearlube_core.oil.oil_file import OilFile
from tests.helpers.each import each

KINDS: tuple[type[InputFile], ...] = (
    AxleFile, BearingFile, BlankFile, HelicalGearFile, HypoidCase, HypoidGearFile, LineCase,
    MeasuredFile, OilFile, OptimisationFile, PointCase, RoughCase,
)  # fmt: skip
# directions and phases may have any value
ANY_VALUE = (
    "phase_deg", "phases_deg", "direction_deg", "lay_deg", "offset_angle_deg", "cradle_angle_deg",
    "swivel_angle_deg", "pinion.machine.machine_root_angle_deg",
)  # fmt: skip
AXLE: dict[str, Any] = {"gear_set": {"mesh_table": "mohammadpour_2015"}}


@each("kind", KINDS)
def test_every_number_with_a_unit_has_a_usual_range_within_its_limits(kind):
    for name, note in field_notes(kind).items():
        if not note.unit or not note.kind.startswith(("number", "list of number")):
            continue
        if name.endswith(ANY_VALUE):
            continue
        assert note.usual is not None, name
        low, high = note.usual
        assert low < high
        assert not note.warning(low), name
        assert not note.warning(math.sqrt(low * high) if low > 0.0 else high), name
        assert "is usual" in note.warning(high + 0.01 * abs(high)), name


@each("kind", [kind for kind in KINDS if kind is not MeasuredFile])
def test_no_shipped_file_is_doubtful(kind):
    found = {name: kind.named(name).unusual_numbers() for name in kind.shipped()}
    assert found == {name: {} for name in kind.shipped()}


# field, number as in another unit, the question; factors by the definition of the units
SLIPS = [
    (AxleFile, AXLE, "pinion.bearing.preload_n", 4.0, "Is it in kN? 4 kN is 4000 N."),
    (AxleFile, AXLE, "housing.immersion_mm", 0.04, "Is it in m? 0.04 m is 40 mm."),
    (AxleFile, AXLE, "vehicle.mass_kg", 1.5e5 / 2.0, "Check the number and its unit."),
    (AxleFile, AXLE, "engine.idle_speed_rpm", 83.8, "Is it in rad/s? 83.8 rad/s is 800.231 rpm."),
    (AxleFile, AXLE, "oil.temperature_high_degc", 233.15, "Is it in K? 233.15 K is -40 degC."),
    (HelicalGearFile, "he_2007", "pair.helix_angle_deg", 0.375, "Is it in rad? 0.375 rad is 21.4"),
    (HelicalGearFile, "he_2007", "pair.backlash_mm", 2.5, "Is it in um? 2.5 um is 0.0025 mm."),
    (HypoidGearFile, "mohammadpour_2015", "pair.offset_mm", 0.024, "Is it in m? 0.024 m is 24 mm"),
    (BearingFile, "wingertszahn_2023", "operation.axial_load_n", [6.0], "6 kN is 6000 N."),
    (OilFile, "iso_vg_220_pao", "density_kg_m3", 1500.0, "Check the number"),
    (OptimisationFile, "helical", "torques_n_m", [0.7], "Is it in kN.m? 0.7 kN.m is 700 N.m."),
    (LineCase, "jamali_2015", "load_n_per_mm", 36000.0, "Is it in N/m? 36000 N/m is 36 N/mm."),
    (BlankFile, "hypoid_13_42", "pair.offset_mm", 0.015, "Is it in m? 0.015 m is 15 mm."),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "base", "field", "value", "question"), SLIPS)
def test_a_number_that_smells_of_another_unit_is_asked_about(
    kind, base, field, value, question, tmp_path, caplog
):
    data = kind.named(base).model_dump(exclude_defaults=True) if isinstance(base, str) else base
    section = data = {key: dict(one) if isinstance(one, dict) else one for key, one in data.items()}
    *sections, key = field.split(".")
    for part in sections:
        section[part] = section = dict(section.get(part, {}))
    section[key] = value
    path = tmp_path / "given.toml"
    path.write_text(toml_text(data))
    with caplog.at_level(logging.WARNING):
        file = kind.from_toml(path)
    assert list(file.unusual_numbers()) == [field]
    assert f"{path}: {field} = " in caplog.text
    assert question in caplog.text


def test_a_refusal_asks_about_numbers_that_may_be_its_reason():
    data = HelicalGearFile.named("he_2007").model_dump(exclude_none=True)
    data["pair"]["backlash_mm"] = 8.0  # more than the gap between teeth can be
    with pytest.raises(ParameterError, match=r"backlash must be .*8 um is 0\.008 mm"):
        HelicalGearFile.from_data(data, "pair.toml")


def test_a_question_stands_in_the_notes_of_an_axle_and_0_is_no_question():
    file = AxleFile.from_data({**AXLE, "pinion": {"bearing": {"preload_n": 4.0}}}, "x")
    notes = {note.field: note.why for note in file.car_axle().inputs}
    assert "Is it in kN?" in notes["pinion.bearing.preload_n"]
    none = AxleFile.from_data({**AXLE, "pinion": {"bearing": {"preload_n": 0.0}}}, "x")
    assert none.unusual_numbers() == {}


NAMED = [(kind, field) for kind in KINDS for field in kind.files]


@pytest.mark.parametrize(("kind", "field"), NAMED)
def test_a_path_in_a_file_counts_from_that_file(kind, field, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sub").mkdir()
    for text, place in (("data.bin", "sub/data.bin"), ("../data.bin", "sub/../data.bin")):
        data: dict[str, Any] = {}
        section = data
        for part in field.split(".")[:-1]:
            section[part] = section = {}
        key = field.rpartition(".")[2]
        section[key] = text
        (places,) = kind._places(data, tmp_path / "sub").values()
        assert places == tmp_path / place
        assert section[key] == (str(tmp_path / place) if kind.absolute_files else text)
        section[key] = "shipped_name"
        assert kind._places(data, tmp_path / "sub") == {}


def test_an_oil_beside_a_bearing_file_is_found_from_anywhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    cars = tmp_path / "cars"
    cars.mkdir()
    (cars / "my_oil.toml").write_text(OilFile.shipped_text("iso_vg_220_pao"))
    text = BearingFile.shipped_text("wingertszahn_2023").replace(
        'oil = "fva_3"', 'oil = "my_oil.toml"'
    )
    (cars / "bearing.toml").write_text(text)
    assert BearingFile.from_toml("cars/bearing.toml").oil == str(cars / "my_oil.toml")
    (cars / "my_oil.toml").unlink()
    (tmp_path / "my_oil.toml").write_text("not this one")
    with pytest.raises(
        ParameterError, match=rf"my_oil\.toml was not found in {cars}; .*\. cars/bearing\.toml na"
    ):
        BearingFile.from_toml("cars/bearing.toml")


# what a command prints to start from; measured gears are a folder
EXAMPLES = {
    "axle file", "gear file", "blank file", "bearing file", "train file", "oil file",
    "problem file", "point contact", "line contact", "hypoid flank", "rough line contact",
}  # fmt: skip


@each("kind", KINDS)
def test_a_file_that_is_not_there_is_not_found(kind, tmp_path):
    with pytest.raises(
        ParameterError, match=rf"gone\.toml was not found in {tmp_path}[.;]"
    ) as told:
        kind.given(str(tmp_path / "gone.toml"))
    assert kind.title in str(told.value)
    assert ("--example > gone.toml` writes one" in str(told.value)) == (kind.title in EXAMPLES)
    with pytest.raises(ParameterError, match=rf"was not found in {tmp_path}[.;]"):
        kind.given(str(tmp_path / "no" / ".." / "gone.toml"))
    with pytest.raises(ParameterError, match=r"in .*/no, which is no folder"):
        kind.given(str(tmp_path / "no" / "gone.toml"))
    with pytest.raises(ParameterError, match="cannot be read: it is a folder"):
        kind.from_toml(tmp_path)


def test_a_gear_file_of_either_kind_counts_from_its_folder(tmp_path):
    (tmp_path / "oil.toml").write_text(OilFile.shipped_text("iso_vg_220_pao"))
    path = tmp_path / "pair.toml"
    path.write_text(HelicalGearFile.shipped_text("he_2007") + '\n[film]\noil_file = "oil.toml"\n')
    assert read_gear_file(str(path)).film.oil_file == str(tmp_path / "oil.toml")


TEXT = "# Zähnezahl\nname = 'Ölbad'\n"
CONTENTS = {
    "UTF-8 with mark": (b"\xef\xbb\xbf" + TEXT.encode(), ""),
    "Windows lines": (TEXT.replace("\n", "\r\n").encode(), ""),
    "UTF-16": (TEXT.encode("utf-16"), "it is in UTF-16. Save it as text in UTF-8"),
    "UTF-16 without mark": (TEXT.encode("utf-16-le"), "bytes that are no text"),
    "cp1252": (TEXT.encode("cp1252"), "line 1 holds the byte 0xe4, which is not UTF-8"),
    "empty": (b"", "is empty"),
    "comments alone": (b"# nothing\n", "is empty"),
}


@each("name", CONTENTS)
def test_text_of_windows_editors_is_read_or_refused_with_a_cure(name, tmp_path):
    content, refusal = CONTENTS[name]
    path = tmp_path / "given.toml"
    path.write_bytes(content)
    if not refusal:
        assert read_toml(path) == {"name": "Ölbad"}
        return
    with pytest.raises(ParameterError, match=refusal):
        read_toml(path)
    with pytest.raises(ParameterError, match=refusal):
        toml_data(content, "the resource of an FMU")


WRONG = [
    ({"pinion": {"mass_kg": "3"}}, r"pinion.mass_kg must be a number, .*kg, got '3'.*without quot"),
    ({"pinion": {"mass_kg": [3.0]}}, r"pinion.mass_kg must be a number.*without brackets"),
    ({"pinion": {"mass_kg": True}}, r"pinion.mass_kg must be a number.*got True"),
    ({"pinion": {"bearing": {"rollers": 20.0}}}, r"whole number, 3 to 40, got 20.0.*Write 20,"),
    ({"gearbox": {"ratios": 3.0}}, r"gearbox.ratios must be a list.*got 3.0.*in brackets"),
    ({"name": 3}, r'name must be a text, got 3.*in quotes, such as "name"'),
    ({"oil": "fva_3"}, r"oil must be a section \[oil\], got 'fva_3'"),
    ({"pinion": [{"mass_kg": 3.0}]}, r"pinion must be a section \[pinion\].*in single brackets"),
]  # fmt: skip


@each(("more", "said"), WRONG)
def test_a_value_of_the_wrong_type_is_refused_with_a_cure(more, said):
    with pytest.raises(ParameterError, match=said):
        AxleFile.from_data({**AXLE, **more}, "my.toml")


def test_a_catalogue_serves_bearing_files_and_axle_files_alike():
    # 32216 with its 16 rollers of 17 mm; catalogues print C = 187 kN, and a length of 22.7 mm has
    # 179 kN by ISO 281, where C goes with L^(7/9): 24.0 mm, to the digits of 179
    catalogue = {
        "bore_diameter_mm": 80.0, "outside_diameter_mm": 140.0, "pitch_diameter_mm": 108.5,
        "rollers": 16, "roller_diameter_mm": 17.0, "contact_angle_deg": 15.64,
        "dynamic_load_rating_kn": 187.0,
    }  # fmt: skip
    file = BearingFile.from_data({"name": "32216", "bearing": catalogue}, "bearing.toml")
    length = file.geometry().roller_length
    assert length == pytest.approx(22.7e-3 * (187.0 / 179.0) ** (9 / 7), rel=0.005)
    assert [note.field for note in file.inferred_notes()] == ["bearing.roller_length_mm"]
    bearing = {"bearing": {**catalogue, "rollers": 16}}
    axle = AxleFile.from_data({**AXLE, "gear": bearing}, "axle.toml").car_axle().axle
    assert axle.bearings[1].roller_length == pytest.approx(length, rel=1e-12)  # same law


def test_bore_outside_diameter_and_angle_are_enough_for_a_bearing_file():
    sizes = {"bore_diameter_mm": 80.0, "outside_diameter_mm": 140.0, "contact_angle_deg": 15.64}
    file = BearingFile.from_data({"name": "32216", "bearing": sizes}, "bearing.toml")
    notes = {note.field: note.value for note in file.inferred_notes()}
    # 0.57 of half of 60 mm; rollers fill 0.8 of the circle of 110 mm; 1.5 diameters long
    assert notes == {
        "bearing.pitch_diameter_mm": pytest.approx(110.0),
        "bearing.rollers": 16,
        "bearing.roller_diameter_mm": pytest.approx(17.1),
        "bearing.roller_length_mm": pytest.approx(25.65),
    }


def test_bounds_of_a_problem_and_values_of_a_variation_are_asked_about(caplog):
    given = OptimisationFile.named("helical").model_dump(exclude_defaults=True)
    given["parameters"] = {"gear.flank.crown_um": {"low": 0.0, "high": 0.02, "start": 0.01}}
    Problem.of(OptimisationFile.from_data(given, "p"))
    assert "gear.flank.crown_um = 0.02 um is unusual" in caplog.text
    assert "Is it in mm? 0.02 mm is 20 um." in caplog.text
    key = file_keys(field_notes(BearingFile))["bearing.contact_angle_deg"]
    assert key.note is not None
    assert "Is it in rad? 0.26 rad is 14.8969 deg." in key.note.warning((15.0, 0.26))
