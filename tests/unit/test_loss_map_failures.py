"""A map whose points fail by their input: rows with reasons, and files that leave them out."""

from __future__ import annotations

import csv

import numpy as np
import pytest
import xarray as xr
from scipy.io import loadmat
from typer.testing import CliRunner

import gearlube as gl
from gearlube.command import COMMANDS, command_line
from gearlube.studies.loss_map.exports import lossy_gear_table
from gearlube.studies.loss_map.regulation import regulation_map
from gearlube_core.errors import ParameterError

# rough flanks with junctions so strong that friction takes what the pinion gives: no torque of the
# teeth balances. Without load the axle turns
LOCKING = """
[gear_set]
mesh_table = "mohammadpour_2015"
roughness_rms_um = 8
[oil]
boundary_friction = 1.0
limiting_shear_stress_mpa = 300
eyring_stress_mpa = 300
viscosity_40_degc_mm2_s = 6
viscosity_100_degc_mm2_s = 3
"""
REASON = "the torques on the pinion did not balance"


@pytest.fixture(scope="module")
def axle(tmp_path_factory):
    path = tmp_path_factory.mktemp("axle") / "locking.toml"
    path.write_text(LOCKING)
    return path


def mapped(axle, out, *words):
    arguments = ["map", str(axle), "--speeds", "1000", "2000", "--temperatures", "40", *words]
    return CliRunner().invoke(command_line(COMMANDS), [*arguments, "--out", str(out)])


@pytest.fixture(scope="module")
def out(axle, tmp_path_factory):
    folder = tmp_path_factory.mktemp("map") / "out"
    ended = mapped(axle, folder, "--torques", "-50", "0", "1", "100", "--draws", "2")
    assert ended.exit_code == 1, ended.output
    return folder


@pytest.mark.slow
def test_a_point_that_fails_is_a_row_with_its_reason(out):
    with (out / "map.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 8
    for row in rows:
        failed = abs(float(row["pinion_torque_n_m"])) > 20.0
        assert row["reason"].startswith(REASON) == failed
        assert (row["loss_torque_n_m"] == "") == failed
        assert (row["loss_friction_boundary_w"] == "") == failed
        if not failed:
            assert 0.0 < float(row["loss_torque_low_n_m"]) < float(row["loss_torque_high_n_m"])


def test_the_netcdf_and_matlab_files_hold_what_was_found(out):
    with xr.open_dataset(out / "map.nc", engine="scipy") as found:
        failed = (found["status"] != 0).values
        assert failed[0].tolist() == [[True, False, False, True]] * 2
        assert np.isnan(found["loss_torque"].values).tolist() == failed.tolist()
        assert REASON in found.attrs["reasons"]
    table = loadmat(out / "map.mat", squeeze_me=True)["torque_loss_Nm"]
    assert np.isnan(table).tolist() == [[True, False, False, True]] * 2


def test_files_for_other_tools_have_the_other_points_alone(out):
    lines = (out / "vecto_40degC.vtlm").read_text().splitlines()[1:]
    assert [float(line.split(",")[1]) for line in lines] == [0.0, 1.0] * 3  # and at rest
    with (out / "gem_40degC.csv").open() as file:
        assert len(list(csv.DictReader(file))) == 4
    assert "nan" not in (out / "lossy_gear_40degC.mo").read_text().lower()
    assert (out / "figures" / "losses.png").exists()


def test_a_lossy_gear_is_never_lossless_where_nothing_was_found():
    """Line 1 + 0.02 T in drive; no coast; one speed without any point."""
    torque = np.array([0.0, 50.0, 100.0])
    loss = np.array([1.0 + 0.02 * torque, [np.nan] * 3])
    found = lossy_gear_table(
        xr.Dataset(
            {"loss_torque": (("speed", "torque"), loss)},
            coords={"speed": [1000.0, 2000.0], "torque": torque},
        )
    )
    [row] = found.rows
    assert row[0] == pytest.approx(1000.0 * np.pi / 30.0)
    assert row[1] == pytest.approx(0.98)
    # coast like drive: T = -100 loses (1 - 1/eta2) T + tau2 = 3 N.m
    assert (1.0 - 1.0 / row[2]) * -100.0 + row[4] == pytest.approx(3.0)
    assert row[3] == pytest.approx(1.0)


def test_no_lossy_gear_gains_power():
    """A loss that falls with torque, as it may near none, is no efficiency above 1."""
    torque = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
    dataset = xr.Dataset(
        {"loss_torque": (("speed", "torque"), [[0.6, 0.7, 0.9, 0.8, 0.7]])},
        coords={"speed": [1000.0], "torque": torque},
    )
    [row] = lossy_gear_table(dataset).rows
    assert row[1] == 1.0
    assert row[2] == 1.0
    assert row[3] == pytest.approx(0.8)  # means of 0.9, 0.8, 0.7 and of 0.6, 0.7, 0.9
    assert row[4] == pytest.approx(2.2 / 3.0)


def test_a_map_of_failures_alone_keeps_its_table_and_no_file_of_an_earlier_map(
    axle, tmp_path, caplog
):
    out = tmp_path / "out"
    out.mkdir()
    (out / "vecto_40degC.vtlm").write_text("of an earlier map")
    (out / "gem_55degC.csv").write_text("of an earlier map")
    ended = mapped(axle, out, "--torques", "100", "300", "--draws", "0", "--overwrite")
    assert ended.exit_code == 1, ended.output
    assert "4 points failed; map.csv says why" in caplog.text
    for name in ("vecto_40degC.vtlm", "gem_40degC.csv", "lossy_gear_40degC.mo"):
        assert f"No {name}" in caplog.text
    assert {one.suffix for one in out.iterdir()} == {".nc", ".csv", ".mat", ".json", ".html"}
    assert not (out / "gem_55degC.csv").exists()
    with (out / "map.csv").open() as file:
        assert all(row["reason"].startswith(REASON) for row in csv.DictReader(file))


def test_a_grid_or_a_cycle_that_needs_every_point_says_which_failed(axle):
    car = gl.read_axle(axle)
    with pytest.raises(ParameterError, match=rf"none was found at .* N.m: {REASON}"):
        regulation_map(gl.LossMapSettings(axle=car.axle, draws=0))
    cycle = gl.studies.DriveCycle(name="cruise", time=np.arange(5.0), speed=np.full(5, 25.0))
    hot = gl.celsius_to_kelvin(130.0)
    with pytest.raises(ParameterError, match=rf"every point of the map.*{REASON}"):
        gl.run_cycle(
            gl.DriveCycleSettings(car=car, cycle=cycle, start_temperature=hot, air_temperature=hot)
        )


def test_a_draw_beyond_the_limits_is_refused_before_anything_is_computed(
    tmp_path, caplog, monkeypatch
):
    def computed(*_args, **_options):
        raise AssertionError("computed")

    monkeypatch.setattr("gearlube.studies.loss_map.run.axle_losses", computed)
    path, out = tmp_path / "edge.toml", tmp_path / "out"
    path.write_text(LOCKING.replace("roughness_rms_um = 8", "roughness_rms_um = 19"))
    assert mapped(path, out, "--draws", "2").exit_code == 2
    assert "The error bars draw the roughness of the flanks at 1.4 times" in caplog.text
    assert "--draws 0" in caplog.text
    assert not out.exists()
