"""Stored data with one wrong bit, cut or gone: never another number, always the file's name."""

import json
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from gearlube.variation import run
from gearlube.variation.design import Axis, Design
from gearlube.variation.run import run_variation
from gearlube.variation.store import open_variation
from gearlube_core.errors import FileError, TableError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.mesh_table.line_mesh_file import read_line_mesh
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.storage.atomic_file import (
    open_dataset,
    read_arrays,
    read_dataset,
    write_arrays,
    write_compressed_dataset,
    write_dataset,
)
from tests.helpers.variation_stand_in import AreaStudy

TABLES = files("gearlube_core.mesh_table") / "data"
WAVE = xr.Dataset({"wave": ("x", np.linspace(0.0, 1.0, 400) ** 2)}, attrs={"text": "of any length"})


def flipped(content, count, seed=36):
    """Yield copies with one wrong bit each, at even and random places."""
    rng = np.random.default_rng(seed)
    places = np.unique(rng.integers(0, 8 * len(content), count))
    for place in places:
        wrong = bytearray(content)
        wrong[place // 8] ^= 1 << (place % 8)
        yield bytes(wrong)


@pytest.mark.parametrize(
    ("name", "read"),
    [("mohammadpour_2015.nc", read_mesh_table), ("line_mesh_he_2007.nc", read_line_mesh)],
)
def test_each_wrong_bit_of_a_mesh_table_is_found(name, read, tmp_path, caplog):
    path, content = tmp_path / name, (TABLES / name).read_bytes()
    ends = content[-83:]
    assert ends.startswith(b"\ngearlube SHA-256 ")
    accepted = named = 0
    trials = list(flipped(content, 300))
    for wrong in trials:
        path.write_bytes(wrong)
        try:
            read(path)
        except TableError as refused:
            named += name in str(refused)
        else:  # only where the line of the checksum itself is no longer one
            assert wrong[: -len(ends)] == content[: -len(ends)]
            accepted += 1
    assert (accepted <= 2, named) == (True, len(trials) - accepted)
    path.write_bytes(content[: -len(ends)])
    caplog.clear()
    read(path)
    assert f"{name} has no checksum" in caplog.text


@pytest.mark.parametrize("write", [write_dataset, write_compressed_dataset])
def test_each_wrong_bit_of_a_dataset_is_found_and_other_programs_read_it(write, tmp_path):
    path = tmp_path / "wave.nc"
    write(WAVE, path)
    xr.testing.assert_equal(xr.load_dataset(path), WAVE)
    xr.testing.assert_equal(read_dataset(path, sealed=True), WAVE)
    content = path.read_bytes()
    for wrong in flipped(content, 60):
        path.write_bytes(wrong)
        with pytest.raises(FileError, match=r"wave\.nc"):
            open_dataset(path, sealed=True)
    for size in (0, 3, 100, len(content) // 2, len(content) - 1):
        path.write_bytes(content[:size])
        with pytest.raises(FileError, match=r"wave\.nc"):
            read_dataset(path, sealed=True)


def test_each_wrong_bit_of_arrays_is_found(tmp_path):
    path = tmp_path / "wave.npz"
    write_arrays(path, {"wave": WAVE["wave"].values})
    with np.load(path) as stored:
        assert np.array_equal(stored["wave"], WAVE["wave"])
    for wrong in flipped(path.read_bytes(), 100):
        path.write_bytes(wrong)
        with pytest.raises(FileError, match=r"wave\.npz"):
            read_arrays(path, sealed=True)


def test_the_provenance_of_a_film_model_is_within_its_checksum(tmp_path, caplog):
    path, model = tmp_path / "own.json", FilmModel.named("hypoid_flank")
    model.write(path)
    content = json.loads(path.read_text())
    assert FilmModel.read(path).provenance == model.provenance
    path.write_text(json.dumps(content))  # another layout, the same content
    FilmModel.read(path)
    content["provenance"]["solves"] = 10_000_000
    path.write_text(json.dumps(content))
    with pytest.raises(FileError, match=r"own\.json is damaged"):
        FilmModel.read(path)
    del content["file_checksum"]
    path.write_text(json.dumps(content))
    assert not caplog.text
    FilmModel.read(path)
    assert "own.json has no checksum of the whole file" in caplog.text


@pytest.fixture(autouse=True)
def quick_hash(monkeypatch):
    """The hash of all code takes a tenth of a second; none of these tests is about it."""
    monkeypatch.setattr(run, "code_hash", lambda: "code")


WIDTHS = (1.0, 2.0, 3.0, 4.0)
DESIGN = Design(axes=(Axis("width_mm", WIDTHS),))
BLOCK = ["results/1.0", "status/1", "message/1"]


def flip(path):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0x10
    path.write_bytes(content)


def cut(path):
    path.write_bytes(path.read_bytes()[:-3])


DAMAGES = {"flipped": flip, "cut": cut, "gone": Path.unlink, "empty": lambda p: p.write_bytes(b"")}


@pytest.mark.slow
@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("file", BLOCK)
def test_a_damaged_block_is_refused_by_name_and_computed_again(file, damage, tmp_path, caplog):
    run_variation(AreaStudy(), DESIGN, out=tmp_path, jobs=1, block=2)
    whole = open_variation(tmp_path)["area"].values.tolist()
    DAMAGES[damage](tmp_path / "results.zarr" / file)
    with pytest.raises(FileError, match=file):
        open_variation(tmp_path)
    assert run_variation(AreaStudy(), DESIGN, out=tmp_path, jobs=1, block=2).computed == 2
    assert "1 of 2 blocks" in caplog.text
    assert "computed again" in caplog.text
    assert open_variation(tmp_path)["area"].values.tolist() == whole
    assert run_variation(AreaStudy(), DESIGN, out=tmp_path, jobs=1, block=2).computed == 0


@pytest.mark.parametrize("file", ["width_mm/0", "results/.zarray", ".zattrs"])
def test_damaged_inputs_or_descriptions_are_never_read(file, tmp_path, caplog):
    run_variation(AreaStudy(), DESIGN, out=tmp_path, jobs=1, block=2)
    path = tmp_path / "results.zarr" / file
    content = path.read_bytes()
    path.write_bytes(content.replace(b"mm2", b"mn2") if file == ".zattrs" else content[:-1] + b" ")
    assert path.read_bytes() != content
    with pytest.raises(FileError, match=file):
        open_variation(tmp_path)
    assert run_variation(AreaStudy(), DESIGN, out=tmp_path, jobs=1, block=2).computed == 4
    assert f"{file} is damaged. All is computed again." in caplog.text
    open_variation(tmp_path)


def test_the_list_of_checksums_is_one_that_other_tools_check(tmp_path):
    run_variation(AreaStudy(), DESIGN, out=tmp_path, jobs=1, block=2)
    lines = (tmp_path / "results.zarr.sha256").read_text().splitlines()
    names = {line[66:] for line in lines}
    assert {"results/0.0", "results/1.0", "status/0", "width_mm/0", ".zattrs"} <= names
    assert all(len(line.split("  ")[0]) == 64 for line in lines)


def test_a_dataset_with_an_empty_dimension_is_read_as_it_was(tmp_path: Path) -> None:
    """Such as the folds of a pair whose teeth never part."""
    folds = xr.Dataset({"speed": (("row", "fold"), np.zeros((2, 0))), "name": ("row", ["a", "b"])})
    write_dataset(folds, tmp_path / "separation.nc")
    xr.testing.assert_identical(read_dataset(tmp_path / "separation.nc", sealed=True), folds)
