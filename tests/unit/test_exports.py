"""Exported results are read back by other libraries and are those of the dataset."""

import logging
import sys

import asammdf
import meshio
import numpy as np
import pandas as pd
import pytest
import pyuff
import xarray as xr
from scipy.io import loadmat
from typer.testing import CliRunner

import gearlube as gl
from gearlube.command import app
from gearlube.output import mat_file
from gearlube.output.exports import tables, uff58
from gearlube.output.units import unit_text
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each
from tests.helpers.small_results import small_results

DATASET = small_results()


@pytest.fixture
def run(tmp_path):
    folder = tmp_path / "run"
    folder.mkdir()
    DATASET.to_netcdf(folder / "small.nc")
    return folder


def test_csv_tables_hold_the_dataset_with_units_in_the_headings(run, tmp_path):
    out = tmp_path / "tables"
    written = gl.export_results(run, "csv", out)
    assert set(written) == set(out.iterdir())
    time = pd.read_csv(out / "time.csv")
    assert np.array_equal(time["time [s]"], DATASET["time"])
    for bearing in ("pinion", "gear"):
        for direction in ("axial", "radial 1"):
            column = time[f"bearing_force.{bearing}.{direction} [N]"]
            values = DATASET["bearing_force"].sel(bearing=bearing, direction=direction)
            assert np.allclose(column, values, rtol=5e-7, atol=0.0)  # seven digits
    bins = pd.read_csv(out / "speed_bin.csv")
    assert list(bins)[:3] == ["speed [m/s]", "bin [index from 0]", "frequency [Hz]"]
    assert np.array_equal(
        bins["frequency [Hz]"], DATASET["frequency"].values.ravel(), equal_nan=True
    )
    speed = pd.read_csv(out / "speed.csv", keep_default_na=False)
    assert list(speed) == ["speed [m/s]", "torque [N m]", "message"]
    assert list(speed["message"]) == ["", "left, a range"]
    values = pd.read_csv(out / "values.csv", index_col="name")
    assert values.loc["share", "value"] == "0.25"
    assert values.loc["teeth", "value"] == "13"
    index = pd.read_csv(out / "tables.csv", index_col="variable")
    assert index.loc["bearing_force", "meaning"] == "force on the shaft"
    assert index.loc["share", "unit"] == "not stated"
    assert set(index["table"]) < {path.name for path in written}


def test_mat_holds_arrays_units_and_dimensions(run, tmp_path):
    gl.export_results(run, "mat", tmp_path / "small.mat")
    stored = loadmat(tmp_path / "small.mat", simplify_cells=True)
    for name in ("bearing_force", "dte", "frequency", "dte_spectrum", "torque", "time", "speed"):
        assert np.array_equal(stored[name], DATASET[name].values, equal_nan=True), name
    assert list(stored["bearing"]) == ["pinion", "gear"]
    assert stored["units"]["torque"] == "N m"
    assert stored["units"]["speed"] == "m/s"
    assert stored["units"]["share"] == "not stated"
    assert stored["dimensions"]["bearing_force"] == "time bearing direction"
    assert stored["attributes"]["teeth"] == 13


def test_uff58_holds_each_history_and_spectrum_with_names_and_units(run, tmp_path):
    gl.export_results(run, "uff58", tmp_path / "small.uff")
    units, *sets = pyuff.UFF(str(tmp_path / "small.uff")).read_sets()
    assert units["units_description"].strip() == "SI"
    found = {(one["id1"].strip(), one["id3"].strip()): one for one in sets}
    forces = [key for key in found if key[0].startswith("bearing_force")]
    assert len(found) == len(sets)
    assert len(forces) == 4
    one = found["bearing_force gear radial 1", "NONE"]
    values = DATASET["bearing_force"].sel(bearing="gear", direction="radial 1")
    assert np.allclose(one["data"], values, rtol=1e-11)  # twelve digits
    assert np.allclose(one["x"], DATASET["time"], rtol=1e-5)  # the step has six
    assert one["id2"].strip() == "force on the shaft"
    assert one["ordinate_axis_units_lab"].strip() == "N"
    assert one["abscissa_axis_units_lab"].strip() == "s"
    assert (one["abscissa_spec_data_type"], one["func_type"]) == (17, 1)
    assert (one["rsp_node"], one["rsp_dir"], one["rsp_ent_name"].strip()) == (2, 2, "gear")
    for k, speed in enumerate((5.0, 10.0)):
        spectrum = found["dte_spectrum", f"speed {speed:g} m/s"]
        there = ~np.isnan(DATASET["frequency"][k].values)
        assert np.allclose(spectrum["x"], DATASET["frequency"][k][there], rtol=1e-5)
        assert np.allclose(spectrum["data"], DATASET["dte_spectrum"][k][there], rtol=1e-11)
        assert spectrum["abscissa_spec_data_type"] == 18
        assert spectrum["z_axis_value"] == speed
        assert spectrum["ordinate_axis_units_lab"].strip() == "m"


def test_uff58_refuses_what_it_cannot_hold(run, tmp_path, monkeypatch):
    out = tmp_path / "out.uff"
    with pytest.raises(gl.ParameterError, match="time histories or spectra, got torque"):
        gl.export_results(run, "uff58", out, variables=["torque"])
    gap = DATASET.copy(deep=True)
    gap["dte"][3] = np.nan
    gap.to_netcdf(run / "gap.nc")
    with pytest.raises(gl.ParameterError, match="none at 1 of 64 points of dte"):
        gl.export_results(run / "gap.nc", "uff58", out)
    monkeypatch.setattr(uff58, "RECORD_LIMIT", 6)
    with pytest.raises(gl.ParameterError, match="at most 6 records, got 7"):
        gl.export_results(run / "small.nc", "uff58", out)
    monkeypatch.setitem(sys.modules, "pyuff", None)
    with pytest.raises(gl.GearLubeError, match=r"gearlube\[sound\]"):
        gl.export_results(run / "small.nc", "uff58", out)
    assert [path.name for path in tmp_path.iterdir()] == ["run"]


def test_mdf4_holds_each_history_with_unit_and_meaning(run, tmp_path):
    gap = DATASET.copy(deep=True)
    gap["dte"][3] = np.nan
    gap.to_netcdf(run / "small.nc")
    gl.export_results(run, "mdf4", tmp_path / "small.mf4")
    with asammdf.MDF(tmp_path / "small.mf4") as file:
        assert file.version == "4.10"
        channels = set(file.channels_db) - {"time"}
        assert len(channels) == 5
        force = file.get("bearing_force.gear.radial 1")
        values = DATASET["bearing_force"].sel(bearing="gear", direction="radial 1")
        assert force.samples.dtype == np.float32
        assert np.array_equal(force.samples, values)
        assert np.array_equal(force.timestamps, DATASET["time"])
        assert (force.unit, force.comment) == ("N", "force on the shaft")
        error = file.get("dte")  # without the value that is not there
        assert np.array_equal(error.samples, np.delete(DATASET["dte"].values, 3))
        assert np.array_equal(error.timestamps, np.delete(DATASET["time"].values, 3))


def test_mdf4_refuses_what_it_cannot_hold(run, tmp_path, monkeypatch):
    out = tmp_path / "out.mf4"
    with pytest.raises(gl.ParameterError, match="time histories, got dte_spectrum"):
        gl.export_results(run, "mdf4", out, variables=["dte_spectrum"])
    falling = DATASET.isel(time=slice(None, None, -1))
    falling.to_netcdf(run / "falling.nc")
    with pytest.raises(gl.ParameterError, match="must rise, got time"):
        gl.export_results(run / "falling.nc", "mdf4", out)
    monkeypatch.setitem(sys.modules, "asammdf", None)
    with pytest.raises(gl.GearLubeError, match=r"gearlube\[export\]"):
        gl.export_results(run / "small.nc", "mdf4", out)
    assert [path.name for path in tmp_path.iterdir()] == ["run"]


def test_vtk_holds_film_and_pressure_over_the_plane(tmp_path):
    x, y = np.linspace(-1e-3, 1e-3, 4), np.linspace(0.0, 2e-3, 3)
    pressure = np.random.default_rng(3).random((2, 4, 3))
    fields = xr.Dataset(
        {
            "pressure": (("instant", "x", "y"), pressure, {"units": "Pa"}),
            "film": (("instant", "y", "x"), 1e-7 * pressure.swapaxes(1, 2), {"units": "m"}),
        },
        {
            "x": ("x", x, {"units": "m"}),
            "y": ("y", y, {"units": "m"}),
            "instant": ("instant", [0.1234567, 0.1234568], {"units": "s"}),
        },
    )
    fields.to_netcdf(tmp_path / "film.nc")
    written = gl.export_results(tmp_path / "film.nc", "vtk", tmp_path / "out")
    # six digits of the instants agree, and each has its file
    assert {path.stem for path in written} == {
        "pressure_instant_0.123457",
        "pressure_instant_0.123457_2",
    }
    mesh = meshio.read(tmp_path / "out" / "pressure_instant_0.123457_2.vtu")
    for k, (px, py, _) in enumerate(mesh.points):
        i, j = np.abs(x - px).argmin(), np.abs(y - py).argmin()
        assert mesh.point_data["pressure [Pa]"][k] == pressure[1, i, j]
        assert mesh.point_data["film [m]"][k] == 1e-7 * pressure[1, i, j]
    corners = mesh.points[mesh.cells_dict["quad"]]
    assert len(corners) == 3 * 2
    across = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    area = 0.5 * np.abs(across[0][:, 0] * across[1][:, 1] - across[0][:, 1] * across[1][:, 0])
    assert np.allclose(area, 2e-3 / 3 * 1e-3)  # corners go around the cell


def test_vtk_lays_the_pressure_on_the_gear_flank(tmp_path):
    file = HypoidGearFile.named("mohammadpour_2015")
    cells = np.arange(12.0).reshape(1, 3, 4)
    contact = xr.Dataset(
        {"pressure_map": (("side", "map_s", "map_t"), cells, {"units": "Pa"})},
        {"side": ["drive"], "map_s": (np.arange(3) + 0.5) / 3, "map_t": (np.arange(4) + 0.5) / 4},
        {"gear_file": file.model_dump_json(exclude_none=True)},
    )
    contact.to_netcdf(tmp_path / "contact.nc")
    gl.export_results(tmp_path / "contact.nc", "vtk", tmp_path / "out")
    mesh = meshio.read(tmp_path / "out" / "pressure_map_drive.vtu")
    middles = mesh.points[mesh.cells_dict["quad"]].mean(axis=1)
    flank = FlankPair.from_file(file, "drive").gear
    for value, middle in zip(mesh.cell_data["pressure_map [Pa]"][0], middles, strict=True):
        s, t = (int(value) // 4 + 0.5) / 3, (int(value) % 4 + 0.5) / 4
        on_flank = flank.sample(np.array([s]), np.array([t])).r[0]
        # a flat cell leaves the curved flank by less than a tenth of its length
        assert np.linalg.norm(middle - on_flank) < 0.1 * file.gear.face_width_mm * 1e-3 / 4


def test_vtk_refuses_a_dataset_without_fields(run, tmp_path):
    with pytest.raises(gl.ParameterError, match="fields over x and y"):
        gl.export_results(run, "vtk", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_variables_and_spans_choose_a_part(run, tmp_path):
    gl.export_results(
        run, "mat", tmp_path / "a.mat", variables=["dte"], spans={"time": ("0.01", "0.02")}
    )
    stored = loadmat(tmp_path / "a.mat", simplify_cells=True)
    inside = DATASET["dte"].sel(time=slice(0.01, 0.02))
    assert np.array_equal(stored["dte"], inside)
    assert "torque" not in stored
    gl.export_results(run, "mat", tmp_path / "b.mat", spans={"bearing": ("gear", "gear")})
    stored = loadmat(tmp_path / "b.mat", simplify_cells=True)
    assert np.array_equal(
        stored["bearing_force"], DATASET["bearing_force"].sel(bearing=["gear"])[:, 0]
    )


def test_what_a_format_cannot_hold_is_refused_and_nothing_is_written(run, tmp_path, monkeypatch):
    monkeypatch.setattr(tables, "ROW_LIMIT", 50)
    with pytest.raises(gl.ParameterError, match=r"at most 50 rows, got 64 over time .*--span"):
        gl.export_results(run, "csv", tmp_path / "out")
    monkeypatch.setattr(mat_file, "SIZE_LIMIT", 1000)
    with pytest.raises(gl.ParameterError, match=r"1000 bytes, got 1024 in bearing_force"):
        gl.export_results(run, "mat", tmp_path / "out.mat")
    assert [path.name for path in tmp_path.iterdir()] == ["run"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--to", "xls"], "must be one of csv"),
        (["--to", "csv", "--variable", "dtee"], "no variable dtee. It has: bearing_force"),
        (["--to", "csv", "--span", "time"], "NAME=FIRST:LAST"),
        (["--to", "csv", "--span", "time=a:b"], "must have numbers, got 'a'"),
        (["--to", "csv", "--span", "time=5:6"], "the dataset has 0.0 to 0.0615234375 s"),
        (["--to", "csv", "--span", "bearing=rear"], "pinion"),
        (["--to", "csv", "--span", "frequency=1:2"], "over one dimension, got frequency"),
    ],
)
def test_bad_options_are_refused(run, tmp_path, caplog, options, said):
    command = ["export", str(run), "--out", str(tmp_path / "out"), *options]
    assert CliRunner().invoke(app, command).exit_code == 2
    assert said in caplog.text
    assert not (tmp_path / "out").exists()


def test_command_writes_once_and_says_what_has_no_unit(run, tmp_path, caplog):
    caplog.set_level(logging.INFO, logger="gearlube")
    command = ["export", str(run / "small.nc"), "--to", "mat", "--out", str(tmp_path / "a.mat")]
    assert CliRunner().invoke(app, command).exit_code == 0
    assert "These variables have no unit: share" in caplog.text
    assert CliRunner().invoke(app, command).exit_code == 2
    assert "exists already" in caplog.text
    assert CliRunner().invoke(app, [*command, "--overwrite"]).exit_code == 0


def test_a_folder_needs_one_dataset(run, tmp_path):
    DATASET.to_netcdf(run / "other.nc")
    with pytest.raises(gl.ParameterError, match=r"has 2: other.nc, small.nc. Give one"):
        gl.export_results(run, "csv", tmp_path / "out")
    with pytest.raises(gl.GearLubeError, match="got none"):
        gl.export_results(tmp_path, "csv", tmp_path / "out")
    (run / "broken.nc").write_text("no dataset")
    with pytest.raises(gl.GearLubeError, match="must be a NetCDF file"):
        gl.export_results(run / "broken.nc", "csv", tmp_path / "out")


@each(
    ("stated", "shown"),
    [
        ("N m", "N m"),
        ("N.m", "N m"),
        ("rad s-1", "rad/s"),
        ("rad/s", "rad/s"),
        ("kg/(m s)", "kg/(m s)"),
        ("W/m/K", "W/(m K)"),
        ("m s^-2", "m/s2"),
        ("m**2", "m2"),
        ("1", "1"),
        ("1/K", "1/K"),
        ("degC", "degC"),
        ("%", "%"),
        ("N/(m/s)", "N/(m/s)"),
        ("", ""),
    ],
)
def test_units_have_one_spelling(stated, shown):
    assert unit_text(stated) == shown
