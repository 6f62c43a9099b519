"""An axle file that names a gear file: its mesh table is computed once, kept, and carried on."""

from __future__ import annotations

import time
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from drivetrain.axle_file.read_axle import read_axle
from fmu_src.build import axle_definition
from fmu_src.hypoid_axle import HypoidAxle, car_axle_in
from gearlube.command import app
from gearlube.studies.sweep.axle_in_fmu import axle_with_oil
from gearlube.variation.file_variants import AxleVariants, files_named
from gearlube_core.errors import GearLubeError, ParameterError, TableError
from gearlube_core.hypoid_contact import kept_table
from gearlube_core.hypoid_contact.kept_table import KeptTable
from gearlube_core.mesh_table.netcdf import read_mesh_table, shipped_mesh_table, write_mesh_table
from gearlube_core.storage.process_pool import ProcessPool

GEARS = files("gearlube_core.hypoid_geometry") / "data" / "mohammadpour_2015.toml"
SHIPPED = shipped_mesh_table("mohammadpour_2015")


@pytest.fixture
def analysed(tmp_path, monkeypatch):
    """Stand in for the analysis: count it, and give a stiffness that tells which one it was."""
    (tmp_path / "gears.toml").write_bytes(GEARS.read_bytes())
    monkeypatch.setenv("GEARLUBE_CACHE", str(tmp_path / "cache"))
    calls = []

    def computed(self, wanted, jobs, progress):
        calls.append(self.gear_file.name)
        progress(1.0, "all")
        series = {**SHIPPED.series, "k_m": len(calls) * SHIPPED.series["k_m"]}
        return replace(SHIPPED, name=self.gear_file.stem, series=series)

    monkeypatch.setattr(KeptTable, "_computed", computed)
    return calls


def stiffness(mesh):
    """How many analyses there had been when the table was made."""
    return round(mesh.mean("k_m", 50.0) / SHIPPED.mean("k_m", 50.0))


def axle_file(folder: Path, gears: str = 'gear_file = "gears.toml"') -> Path:
    path = folder / "axle.toml"
    path.write_text(f'name = "mine"\n[gear_set]\n{gears}\n')
    return path


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def test_the_table_is_computed_once_and_kept_beside_the_gear_file(tmp_path, analysed, caplog):
    axle, shares = axle_file(tmp_path), []
    first = read_axle(axle, progress=lambda share, sentence: shares.append(share))
    assert "gears.toml has no mesh table yet" in caplog.text
    assert shares == [1.0]
    caplog.clear()
    again = read_axle(axle)
    assert analysed == ["gears.toml"]
    assert not caplog.records
    kept = read_mesh_table(tmp_path / "gears.mesh.nc")
    for one in (first, again):
        np.testing.assert_array_equal(one.axle.mesh.series["k_m"], kept.series["k_m"])
    notes = {note.field: (note.value, note.origin) for note in first.inputs}
    assert notes["gear_set.gear_file"] == ("gears.toml", "given")
    assert notes["gear_set.mesh_table"] == ("gears", "inferred")
    drive = tuple(SHIPPED.torque[SHIPPED.torque > 0.0])
    assert notes["gear_set.contact_torques_n_m"] == (drive, "assumed")


def test_what_changes_no_flank_needs_no_new_analysis(tmp_path, analysed):
    axle, gears = axle_file(tmp_path), tmp_path / "gears.toml"
    read_axle(axle)
    tolerance = '\n[tolerances]\n"pair.offset_mm" = { plus_minus = 0.01 }\n'
    gears.write_text("# a remark\r\n" + gears.read_text() + tolerance)
    read_axle(axle)
    gears.rename(tmp_path / "renamed.toml")
    (tmp_path / "gears.mesh.nc").rename(tmp_path / "renamed.mesh.nc")
    read_axle(axle_file(tmp_path, 'gear_file = "renamed.toml"'))
    assert len(analysed) == 1


def test_what_changes_the_table_makes_it_anew_and_is_said(tmp_path, analysed, caplog, monkeypatch):
    axle = axle_file(tmp_path)
    read_axle(axle)
    edit(tmp_path / "gears.toml", "offset_mm = 24.0", "offset_mm = 24.01")
    assert stiffness(read_axle(axle).axle.mesh) == 2
    assert "gears.mesh.nc is out of date: the gear file has changed." in caplog.text
    axle_file(tmp_path, 'gear_file = "gears.toml"\ncontact_torques_n_m = [50.0, 900.0]')
    assert stiffness(read_axle(axle).axle.mesh) == 3
    assert "out of date: other torques are asked for." in caplog.text
    monkeypatch.setattr(kept_table, "_analysis_hash", lambda: "another")
    assert stiffness(read_axle(axle).axle.mesh) == 4
    assert "out of date: it is from another version of the analysis." in caplog.text
    (tmp_path / "gears.mesh.nc").write_bytes(b"half a table")
    assert stiffness(read_axle(axle).axle.mesh) == 5
    assert "out of date: it cannot be read." in caplog.text
    assert stiffness(read_axle(axle).axle.mesh) == 5


def test_a_table_of_other_origin_is_not_overwritten(tmp_path, analysed):
    own = write_mesh_table(SHIPPED, tmp_path / "gears.mesh.nc")
    content = own.read_bytes()
    with pytest.raises(
        TableError, match=r"gears\.mesh\.nc must be the mesh table of the gear file"
    ):
        read_axle(axle_file(tmp_path))
    with pytest.raises(TableError, match="but it comes from elsewhere"):
        KeptTable(tmp_path / "gears.toml").keep(SHIPPED)
    assert own.read_bytes() == content
    assert analysed == []


def test_where_nothing_can_be_written_the_cache_keeps_the_table(tmp_path, analysed, caplog):
    (tmp_path / "gears.mesh.nc").mkdir()  # no file can take its place
    axle = axle_file(tmp_path)
    read_axle(axle)
    assert "The cache folder keeps the mesh table" in caplog.text
    assert stiffness(read_axle(axle).axle.mesh) == 1
    assert len(analysed) == 1


@pytest.mark.parametrize(
    ("gears", "words"),
    [
        ("backlash_um = 100.0", "mesh_table or gear_file must be given, got neither"),
        (
            'gear_file = "a.toml"\nmesh_table = "b.nc"',
            "give mesh_table or gear_file, not both, got 'b.nc' and 'a.toml'",
        ),
        ('gear_file = "table.nc"', r"a name that ends in \.toml, got 'table\.nc'"),
        (
            'mesh_table = "mohammadpour_2015"\ncontact_torques_n_m = [5.0]',
            "contact_torques_n_m is only for gear_file",
        ),
        (
            'gear_file = "gears.toml"\ncontact_torques_n_m = [50.0, 5.0]',
            r"contact_torques_n_m must rise, got \[50\.0, 5\.0\] N\.m",
        ),
        ('gear_file = "none.toml"', r"none\.toml was not found in .*axle\.toml names it in gear"),
    ],
)
def test_gears_that_cannot_be_are_refused(tmp_path, analysed, gears, words):
    with pytest.raises(ParameterError, match=words):
        read_axle(axle_file(tmp_path, gears))
    assert analysed == []


def test_an_fmu_carries_the_table_and_needs_no_gear_file(tmp_path, analysed):
    axle = axle_file(tmp_path)
    definition = axle_definition(None, axle)
    table = (tmp_path / "gears.mesh.nc").read_bytes()
    assert definition.resources == {"axle.toml": axle.read_bytes(), "mesh_table.nc": table}
    elsewhere = tmp_path / "unpacked"
    elsewhere.mkdir()
    for name, content in definition.resources.items():
        (elsewhere / name).write_bytes(content)
    assert HypoidAxle.definition_of(elsewhere) is definition
    assert stiffness(car_axle_in(definition.resources).axle.mesh) == 1
    assert len(analysed) == 1


def test_variants_name_gear_files_and_each_is_analysed_once(tmp_path, analysed):
    text = (tmp_path / "gears.toml").read_text()
    (tmp_path / "other.toml").write_text(text.replace("offset_mm = 24.0", "offset_mm = 24.01"))
    key = "gear_set.gear_file"
    named = files_named({key: ("gears.toml", "other.toml")})
    variants = AxleVariants.read(str(axle_file(tmp_path))).with_files(named)
    names = ("gears.toml", "other.toml")
    found = [stiffness(variants.car_axle({key: one}).axle.mesh) for one in names]
    assert found == [1, 2]
    assert analysed == ["gears.toml", "other.toml"]
    before = variants.identity
    edit(tmp_path / "other.toml", "offset_mm = 24.01", "offset_mm = 24.02")
    assert variants.identity != before


def test_a_sweep_with_an_oil_file_takes_the_kept_table(tmp_path, analysed):
    oil = Path(__file__).parents[2] / "gearlube_core" / "oil" / "data"
    other = next(iter(sorted(oil.glob("*.toml"))))
    target = tmp_path / "with_oil"
    target.mkdir()
    copy = axle_with_oil(axle_file(tmp_path), None, other, target)
    assert stiffness(read_axle(copy).axle.mesh) == 1
    assert len(analysed) == 1


def test_axle_show_brings_the_table_up_to_date_and_tells_of_it(tmp_path, analysed):
    axle = axle_file(tmp_path)
    done = CliRunner().invoke(app, ["axle", "show", str(axle)])
    assert done.exit_code == 0, done.output
    assert "mesh table gears: 13/36 teeth" in done.output
    assert "loaded contact of gear_file" in done.output
    assert len(analysed) == 1


def test_contact_at_its_usual_settings_gives_the_table_that_an_axle_file_takes(tmp_path, analysed):
    kept = KeptTable(tmp_path / "gears.toml")
    assert kept.keep(SHIPPED) == tmp_path / "gears.mesh.nc"
    read_axle(axle_file(tmp_path))
    assert analysed == []


def interrupted_while_a_process_sleeps():
    with ProcessPool(jobs=1, always_spawn=True).open(1) as workers:
        workers.submit(time.sleep, 60.0)
        raise KeyboardInterrupt


def test_an_interrupt_ends_processes_at_once():
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        interrupted_while_a_process_sleeps()
    assert time.monotonic() - began < 30.0  # of the 60 s that the task takes


@pytest.mark.slow  # a loaded contact analysis
def test_the_kept_table_is_that_of_the_contact_analysis(tmp_path, monkeypatch):
    from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
    from gearlube_core.hypoid_contact.contact_table import contact_table
    from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
    from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

    (tmp_path / "gears.toml").write_bytes(GEARS.read_bytes())
    monkeypatch.setenv("GEARLUBE_CACHE", str(tmp_path / "cache"))
    axle = axle_file(tmp_path, 'gear_file = "gears.toml"\ncontact_torques_n_m = [50.0]')

    def stop(share, sentence):
        if share > 0.1:
            raise GearLubeError("stopped")

    with pytest.raises(GearLubeError, match="stopped"):
        read_axle(axle, jobs=1, progress=stop)
    (store,) = (tmp_path / "cache" / "contact").iterdir()
    assert len(list(store.iterdir())) > 3  # of 40 positions
    shares = []
    mesh = read_axle(axle, progress=lambda share, sentence: shares.append(share)).axle.mesh
    assert min(one for one in shares if one > 0.0) > 0.1  # it went on, not from the start
    assert not store.exists()
    file = HypoidGearFile.named("mohammadpour_2015")
    dataset = analyse_contact(file, ContactSettings(cycle=CycleSettings(torques=(50.0,))))
    direct = contact_table(file, dataset)
    for key in ("k_m", "e", "R_p"):
        np.testing.assert_allclose(mesh.series[key], direct.series[key], rtol=1e-12, atol=0.0)
