"""Notes of fields, names of files and pages of fields."""

import csv
import re
from dataclasses import replace
from pathlib import Path
from typing import Annotated, ClassVar, Literal

import numpy as np
import pytest
import xarray as xr
from pydantic import Field, TypeAdapter, ValidationError
from typer.testing import CliRunner

from docs.field_pages import PAGES, refreshed
from docs.page import DOCS, Page
from drivetrain.axle_file.axle_file import AxleFile
from gearlube.command import app
from gearlube.output.csv_text import csv_text
from gearlube.output.exports.tables import write_tables
from gearlube.studies.design.run import axle_stub
from gearlube_core.ehl.case.sections import FilmCase
from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.oil.named_laws import ViscosityLaw
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.storage.file_names import Name, as_name, file_stem, pair_stem
from tests.helpers.each import each


class Sample(InputFile):
    """A file with one field of each kind."""

    package: ClassVar[str] = "gearlube_core.ehl"

    smooth: bool = Field(default=False, description="Smooth or not")
    speed_m_s: float = Field(default=1.5, description="Of the surface")
    load_n_per_mm: Annotated[float, Field(gt=0.0, le=10.0)] = Field(description="Of the line")
    load_n: float = Field(default=1.0, description="Load")
    modulus_gpa: float = Field(default=1.0, description="Modulus")
    slope_per_gpa: float = Field(default=1.0, description="Slope")
    oil_temperature_degc: float = Field(default=1.0, description="Of the oil")
    angle_deg: float = Field(default=1.0, description="Angle")
    conductivity_w_m_k: float = Field(default=1.0, description="Of heat")
    nodes: list[int] = Field(default=[], description="Of the grids")
    form: Literal["only"] = Field(default="only", description="One form")


NOTES = field_notes(Sample)


def test_the_longest_ending_of_a_name_is_its_unit():
    units = {name: note.unit for name, note in NOTES.items() if note.unit}
    assert units == {
        "speed_m_s": "m/s",
        "load_n_per_mm": "N/mm",
        "load_n": "N",
        "modulus_gpa": "GPa",
        "slope_per_gpa": "1/GPa",
        "oil_temperature_degc": "degC",
        "angle_deg": "deg",
        "conductivity_w_m_k": "W/(m.K)",
    }


def test_kinds_limits_and_defaults_are_words():
    assert (NOTES["smooth"].kind, NOTES["smooth"].default) == ("true or false", "false")
    assert (NOTES["nodes"].kind, NOTES["nodes"].default) == ("list of whole numbers", "none")
    assert (NOTES["form"].kind, NOTES["form"].limits) == ("text", "only")
    assert NOTES["load_n_per_mm"].limits == "above 0 to 10"
    assert NOTES["speed_m_s"].default == "1.5"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"smooth": "yes"}, "smooth must be true or false, got 'yes'"),
        ({"load_n_per_mm": 11.0}, "must be a number, above 0 to 10 N/mm, got 11.0"),
        ({"form": "other"}, "form must be a text, only, got 'other'"),
    ],
)
def test_what_is_wrong_is_said_in_the_same_words(changes, words):
    with pytest.raises(ParameterError) as refusal:
        Sample.from_data({"load_n_per_mm": 1.0, **changes}, "sample")
    assert words in str(refusal.value)


NAMED = (
    AxleFile,
    BlankFile,
    FilmCase,
    HelicalGearFile,
    HypoidGearFile,
    MeasuredFile,
    OptimisationFile,
)
HOSTILE = {
    "../../x": "without control characters and /",
    "a\\b": "without control characters and /",
    "C:x": "got ':'",
    "a\x01b": "got '\\x01'",
    "a\u202eb": "got '\\u202e'",
    "a\nb": "got '\\n'",
    ".hidden": "begin or end with a space or a point",
    "x ": "begin or end with a space or a point",
    "..": "begin or end with a space or a point",
    "NUL": "device of Windows",
    "com1.txt": "device of Windows",
    "x" * 101: "at most 100 characters, got 101",
}


@each("text", HOSTILE)
def test_a_name_is_no_path_no_device_and_no_control_character(text):
    with pytest.raises(ValidationError) as refused:
        TypeAdapter(Name).validate_python(text)
    assert HOSTILE[text] in str(refused.value)
    stem = file_stem(text)
    assert TypeAdapter(Name).validate_python(stem) == stem
    assert TypeAdapter(Name).validate_python(as_name(text)) == as_name(text)


@each("text", ["small_van", "müll 10-41", "ISO 17, 5.8", "console", "x" * 100])
def test_ordinary_names_stay(text):
    assert TypeAdapter(Name).validate_python(text) == text == as_name(text)


@each("kind", NAMED)
def test_every_file_whose_name_becomes_one_refuses_a_path(kind):
    field = kind.model_fields["name"]
    checks = TypeAdapter(tuple[Name]).core_schema["items_schema"][0]["function"]["function"]
    assert checks in [getattr(one, "func", None) for one in field.metadata]


@each("name", ["contact", "Axle", "problem", "design", "flanks", "optimise"])
def test_a_pair_called_as_a_file_of_a_study_has_a_file_of_its_own(name):
    assert pair_stem(name) == f"{name}_2"
    assert f'gear_file = "{name}_2.toml"' in axle_stub(pair_stem(name))


def test_tables_of_a_dataset_stay_in_their_folder_and_replace_no_other(tmp_path):
    data = {
        "a": ("../../evil", np.arange(2.0)),
        "b": ("tables", np.arange(3.0)),
        "c": ("values", np.arange(4.0)),
        "d": (("x", "y"), np.ones((2, 2))),
        "e": ("x_y", np.arange(5.0)),
    }
    out = tmp_path / "deep" / "down" / "out"
    written = write_tables(xr.Dataset(data), out)
    assert {path.parent for path in written} == {out} == {p.parent for p in tmp_path.rglob("*.csv")}
    names = {"tables.csv", "values.csv", "evil.csv", "tables_2.csv", "values_2.csv"}
    assert {path.name for path in written} == names | {"x_y.csv", "x_y_2.csv"}
    with (out / "tables.csv").open() as stream:
        listed = {row["variable"]: row["table"] for row in csv.DictReader(stream)}
    assert (listed["b"], listed["c"], listed["e"]) == ("tables_2.csv", "values_2.csv", "x_y_2.csv")


def test_formulas_are_text_in_csv_and_numbers_stay_numbers():
    rows = [["=1+1", "-1.5", -2.0], ["@SUM(A1)", "+nan", "- no"], ["\t=1", "-1e-3", "a=b"]]
    assert csv_text(["=h"], rows).splitlines() == [
        "'=h",
        "'=1+1,-1.5,-2.0",
        "'@SUM(A1),+nan,'- no",
        "'\t=1,-1e-3,a=b",
    ]


def test_no_planted_link_is_written_through(tmp_path, monkeypatch):
    monkeypatch.setattr("os.getpid", lambda: 4711)
    other, target = tmp_path / "other.txt", tmp_path / "a.txt"
    other.write_text("precious")
    (tmp_path / "a.txt.4711.part").symlink_to(other)
    names = set()
    for _ in range(2):
        with atomic_write(target) as partial:
            names.add(partial.name)
            partial.write_text("new")
    assert (other.read_text(), target.read_text(), len(names)) == ("precious", "new", 2)
    umask = 0o777 & ~(tmp_path / "other.txt").stat().st_mode
    assert target.stat().st_mode & 0o777 == 0o666 & ~umask  # as any other new file


@pytest.mark.parametrize("command", ["sweep", "vary map", "contact", "optimise x", "runup"])
def test_no_processes_and_no_folder_are_refused_at_once(command, tmp_path, monkeypatch, caplog):
    monkeypatch.chdir(tmp_path)
    arguments = command.split()
    found = CliRunner().invoke(app, [*arguments, "--out", ""])
    assert found.exit_code == 2
    assert "must be a path" in found.output
    if command != "runup":
        assert CliRunner().invoke(app, [*arguments, "--jobs", "0"]).exit_code == 2
        assert "--jobs must be within 1 to 1024, got 0" in caplog.text
    assert not list(tmp_path.iterdir())


FILES = [name for name in PAGES if name.endswith("_file")]


@each("name", PAGES)
def test_page_is_up_to_date(name):
    """If not: python -m docs.field_pages."""
    assert refreshed(name).text == Page(name).text


@each("name", PAGES)
def test_every_field_stands_on_the_page(name):
    text = Page(name).text
    for model in PAGES[name]:
        for dotted, note in field_notes(model).items():
            field = dotted.rpartition(".")[2]
            assert re.search(rf"\| `{field}` \|.*{re.escape(note.meaning)} \|", text), dotted


@each("name", FILES)
def test_what_the_page_points_to_exists(name):
    text = Page(name).text
    links = re.findall(r"\]\(([^)#]+)", text)
    assert links
    for link in links:
        assert (DOCS / link).is_file(), link
    for path in re.findall(r"`((?:examples|tests|gearlube_core|drivetrain)/[\w./]+)`", text):
        assert (Path(DOCS).parent / path).exists(), path


def test_names_of_laws_stand_in_one_order_whichever_file_was_imported_first():
    kind = ViscosityLaw.kind
    last_file_first = sorted(kind.parts.items(), key=lambda one: one[1].__module__, reverse=True)
    backwards = replace(kind, parts=dict(last_file_first))
    assert list(backwards.known()) == list(kind.known())
    assert list(kind.known())[:3] == ["barus", "roelands", "houpert"]  # those beside the base
