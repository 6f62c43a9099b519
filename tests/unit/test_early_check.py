"""A wrong input file is refused before what computes is imported, in the words of its model."""

import copy
import subprocess
import sys
import tomllib

import pytest

from docs.field_pages import FIELDS_FILE, PAGES, fields_text
from drivetrain.train.train_file import TrainFile
from gearlube.variation.command import Study
from gearlube.variation.point_study import STUDIES
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.early_check import check_early

MODELS = sorted({one for models in PAGES.values() for one in models if one.shipped()}, key=str)


def _leaves(data, place=()):
    for key, value in data.items():
        if isinstance(value, dict):
            yield (*place, key), value
            yield from _leaves(value, (*place, key))
        elif isinstance(value, str | float | int):
            yield (*place, key), value


def _changed(data, place, value, name=None):
    data = copy.deepcopy(data)
    section = data
    for part in place[:-1]:
        section = section[part]
    del section[place[-1]]
    if value is not None:
        section[name or place[-1]] = value
    return data


def _refusal(check, *given):
    try:
        check(*given)
    except ParameterError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("model", MODELS, ids=lambda one: one.__name__)
def test_a_wrong_file_is_refused_in_the_words_of_its_model(model, tmp_path, monkeypatch):
    """Every field of a shipped file misspelt, left out, of another type, out of range.

    What fields say together needs the model: where that alone refuses, the file passes here.
    """
    text = model.shipped_text(model.shipped()[0])
    right = tomllib.loads(text)
    monkeypatch.setattr(
        "gearlube_core.input_file.early_check.read_toml", lambda path, what: tomllib.loads(text)
    )
    assert _refusal(check_early, "my.toml", [model.__name__]) == ""
    refused = 0
    for place, value in list(_leaves(right))[:25]:
        for wrong in (
            _changed(right, place, value, f"{place[-1]}x"),
            _changed(right, place, None),
            _changed(right, place, ["a"]),
            _changed(right, place, -1e15),
        ):
            monkeypatch.setattr(
                "gearlube_core.input_file.early_check.read_toml", lambda *_, wrong=wrong: wrong
            )
            said = _refusal(check_early, "my.toml", [model.__name__])
            if said:
                late = _refusal(model.from_data, copy.deepcopy(wrong), "my.toml")
                assert said.partition("field(s). ")[2] in late, place
                refused += 1
    assert refused > 8


def test_a_train_file_names_a_wrong_field_of_an_element(tmp_path):
    path = tmp_path / "my.toml"
    head, bodies, rest = TrainFile.shipped_text("e_axle").partition("[bodies.")
    path.write_text(f"{head}{bodies}{rest.replace('mass_kg', 'mas_kg', 1)}")
    with pytest.raises(ParameterError, match=r"bodies\.\w+\.mas_kg .* is it mass_kg") as early:
        check_early(path, ["TrainFile"])
    with pytest.raises(ParameterError) as late:
        TrainFile.from_toml(path)
    assert str(early.value) == str(late.value)


def test_a_file_that_another_names_and_is_not_there_is_named_with_what_writes_it(tmp_path):
    path = tmp_path / "my.toml"
    path.write_text('[gear_set]\nmesh_table = "sub/x.nc"\n')
    with pytest.raises(ParameterError) as found:
        check_early(path, ["AxleFile"])
    assert str(found.value) == (
        f"The mesh table x.nc was not found in {tmp_path}/sub, which is no folder. {path} names it "
        "in gear_set.mesh_table; a relative path in a file counts from the folder of that file. "
        "`gearlube contact my_gears.toml` writes one."
    )


@pytest.mark.parametrize(
    "arguments",
    [["map", "bad.toml"], ["runup", "bad.toml"], ["damage", "mohammadpour"],
     ["vary", "map", "bad.toml"], ["build-fmu", "--axle", "bad.toml"], ["drivetrain", "train.toml"],
     ["cycle", "--cycle", "wltp"]],
    ids=" ".join,
)  # fmt: skip
def test_a_typo_is_refused_before_what_computes_is_imported(arguments, tmp_path):
    """Numba and SciPy take seconds to import; the train file names one with a wrong field."""
    (tmp_path / "bad.toml").write_text("[gear_sett]\nx = 1\n")
    train = TrainFile.shipped_text("e_axle").replace('"he_2007"', '"bad.toml"')
    (tmp_path / "train.toml").write_text(train)
    script = (
        "import sys\nfrom gearlube.command import app\ntry:\n    app(sys.argv[1:])\n"
        "except SystemExit as end:\n    print(end.code, {'numba', 'scipy'} & sys.modules.keys())"
    )
    run = subprocess.run(
        [sys.executable, "-c", script, *arguments],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.stdout == "2 set()\n"


def test_the_studies_that_can_be_varied_are_those_of_the_command():
    assert Study.__args__ == STUDIES


def test_the_file_of_fields_is_that_of_the_models():
    """If not: python -m docs.field_pages."""
    assert FIELDS_FILE.read_text() == fields_text()
