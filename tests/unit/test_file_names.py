"""Names from users and from files of others: what becomes of them on disk."""

import csv

import numpy as np
import pytest
import xarray as xr
from pydantic import TypeAdapter, ValidationError
from typer.testing import CliRunner

from drivetrain.axle_file.axle_file import AxleFile
from gearlube.command import app
from gearlube.output.csv_text import csv_text
from gearlube.output.exports.tables import write_tables
from gearlube.studies.design.run import axle_stub
from gearlube_core.ehl.case.grids import FilmCase
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.storage.file_names import Name, as_name, file_stem, pair_stem
from tests.helpers.each import each

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
