"""`gearlube measured` on the made data that it writes as an example."""

import csv
import math
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.studies.measured import teeth
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.measured_flanks import EXAMPLE
from gearlube_core.mesh_table.netcdf import read_mesh_table, shipped_mesh_table, write_mesh_table
from tests.helpers.axle_cases import OIL, drive_only
from tests.helpers.loaded_cases import FILE as FILE_SHIPPED
from tests.helpers.loaded_cases import stiffness

FILE = EXAMPLE / "axle_17.toml"


def measured(*arguments):
    return CliRunner().invoke(cli.app, ["measured", *map(str, arguments)])


@pytest.mark.slow
def test_the_example_becomes_a_gear_file_with_a_picture(tmp_path):
    done = measured(FILE, "--out", tmp_path / "m")
    assert done.exit_code == 0, done.output
    file = HypoidGearFile.from_toml(tmp_path / "m" / "axle_17.toml")
    # the pinion's coast flank of the example was cut with 21 um more from toe root to heel tip
    ends = file.correction("pinion", "coast").bends([0.9, 0.3], [0.1, 0.9], 1.0, 1.0).value
    assert 15e-6 < ends[0] - ends[1] < 25e-6
    assert (tmp_path / "m" / "flanks.png").stat().st_size > 10_000
    assert "Deviation of the pinion coast flank" in (tmp_path / "m" / "report.html").read_text()


@pytest.mark.slow
def test_fitted_settings_are_those_with_which_the_example_was_made(tmp_path):
    fields = ["pinion.machine.tilt_angle_deg", "pinion.machine.radial_setting_mm"]
    options = [word for field in fields for word in ("--fit", field)]
    done = measured(FILE, "--out", tmp_path / "m", *options)
    assert done.exit_code == 0, done.output
    rows = list(csv.DictReader((tmp_path / "m" / "settings.csv").open()))
    for row, made in zip(rows, (0.05, 0.03), strict=True):
        # 0.3 um of noise on six teeth's flanks
        assert abs(float(row["cut_with_more"]) - made) < 3.0 * float(row["uncertainty"])
        corrective = float(row["nominal"]) - float(row["cut_with_more"])
        assert abs(float(row["corrective"]) - corrective) < 1e-3


def test_a_wrong_file_ends_with_a_sentence_and_no_folder(tmp_path, caplog):
    (tmp_path / "one.toml").write_text(FILE.read_text().replace("degree = 3", "degree = 9"))
    done = measured(tmp_path / "one.toml", "--out", tmp_path / "m")
    assert done.exit_code != 0
    assert "degree must be a whole number, 0 to 5" in caplog.text
    assert not (tmp_path / "m").exists()


@pytest.mark.slow  # contact of single pairs at four positions
def test_pitch_goes_into_a_mesh_table_that_an_axle_runs_with(tmp_path, monkeypatch):
    both = {"drive": stiffness(), "coast": stiffness()}
    monkeypatch.setattr(teeth, "pair_stiffness", lambda *_, **__: both)
    pitch = ["member,flank,tooth,deviation_um"]
    pitch += [f"pinion,drive,{k + 1},{8.0 * math.cos(2 * math.pi * k / 13):.3f}" for k in range(13)]
    (tmp_path / "pitch.csv").write_text("\n".join(pitch))
    (tmp_path / "one.toml").write_text(
        'name = "one"\nsource = "made"\ngear_file = "mohammadpour_2015"\npitch = "pitch.csv"\n'
    )
    shipped = drive_only(shipped_mesh_table("mohammadpour_2015"))
    write_mesh_table(shipped, tmp_path / "plain.nc")
    done = measured(
        tmp_path / "one.toml", "--table", tmp_path / "plain.nc", "--positions", 4, "--jobs", 1,
        "--out", tmp_path / "m",
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    table = read_mesh_table(tmp_path / "m" / "one.nc")
    assert set(table.shaft_error) == {"pinion"}
    amplitude = np.hypot(*table.shaft_error["pinion"].transpose(2, 0, 1))
    # 8 um at the pitch circle of 25.7 mm, on the arm of the mesh force. Steps keep sinc(1/13) of
    # an order once a turn, a mean over three pitches, the longest contact, sinc(3/13)
    radius = FILE_SHIPPED.blank().pinion.mean_pitch_radius
    for level, torque in enumerate(table.torque):
        expected = 8e-6 * table.mean("R_p", float(torque)) / radius
        assert np.sinc(3 / 13) < amplitude[level, 0] / expected < np.sinc(1 / 13)
    axle = HypoidAxle(replace(mohammadpour_2015_axle(), mesh=table))
    axle.initialise(pinion_speed=145.0, pinion_torque=60.0, wheel_torque=160.0, oil_temperature=OIL)
    axle.step(1e-3, 60.0, 160.0, OIL)
    assert (tmp_path / "m" / "tooth_errors.png").is_file()
    assert "sideband of the pinion" in (tmp_path / "m" / "report.html").read_text()


def test_a_table_without_anything_to_add_is_refused(tmp_path, caplog):
    (tmp_path / "one.toml").write_text(
        'name = "one"\nsource = "made"\ngear_file = "mohammadpour_2015"\n'
    )
    done = measured(tmp_path / "one.toml", "--table", "any.nc", "--out", tmp_path / "m")
    assert done.exit_code != 0
    assert "must name pitch, waviness or an eccentricity, got none" in caplog.text
