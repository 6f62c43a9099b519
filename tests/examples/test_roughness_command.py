"""The command `gearlube roughness`: files, messages, and what it refuses."""

from __future__ import annotations

import csv
import logging

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube.command import app
from gearlube_core.surface.files import read_surface
from tests.helpers.each import each


def run(*arguments):
    return CliRunner().invoke(app, ["roughness", *map(str, arguments)])


def statistics(path):
    with path.open(encoding="utf-8", newline="") as file:
        return {row["name"]: float(row["value"]) for row in csv.DictReader(file)}


@pytest.mark.slow
def test_a_made_profile_is_read_filtered_and_drawn_out(tmp_path, caplog):
    made = tmp_path / "made"
    arguments = (
        "--ra-um",
        0.3,
        "--period-mm",
        0.15,
        "--points",
        128,
        "--autocorrelation",
        "gaussian",
    )
    assert run("make", *arguments, "--out", made).exit_code == 0
    of = statistics(made / "surface_statistics.csv")
    assert of["Ra"] == pytest.approx(0.3, rel=1e-6)
    assert of["length"] == pytest.approx(150.0, rel=1e-6)
    assert (made / "surface.png").read_bytes().startswith(b"\x89PNG")

    drawn = tmp_path / "drawn"
    with caplog.at_level(logging.INFO, "gearlube"):
        result = run("extrude", made / "surface.csv", "--rows", 256, "--out", drawn)
    assert result.exit_code == 0
    assert "Lay: 8.5308 deg" in caplog.text  # atan 0.15
    height = read_surface(drawn / "surface.npz").height
    assert height.shape == (128, 256)
    # half the width farther the crests have moved by half a period
    assert height[:, 128] == pytest.approx(np.roll(height[:, 0], 64), abs=1e-14)

    read = tmp_path / "read"
    cut = ("--cutoff-long-um", 50, "--cutoff-short-um", 3, "--ends", "cut")
    assert run("read", made / "surface.csv", *cut, "--out", read).exit_code == 0
    of = statistics(read / "surface_statistics.csv")
    assert of["Rq"] < 0.36
    assert of["length"] == pytest.approx(100.0, abs=3.6)  # three spacings


@pytest.mark.slow
def test_a_map_and_a_stand_in_are_written(tmp_path, caplog):
    arguments = ("--rq-um", 0.2, "--width-mm", 0.1, "--period-mm", 0.2, "--points", 128)
    more = ("--rows", 48, "--correlation-um", 12, "--skewness", -0.3, "--cut-peaks-um", 0.4)
    with caplog.at_level(logging.INFO, "gearlube"):
        assert run("make", *arguments, *more, "--out", tmp_path / "map").exit_code == 0
        assert "Model of running-in" in caplog.text
        assert run("stand-in", "C", "--out", tmp_path / "c").exit_code == 0
    assert read_surface(tmp_path / "map" / "surface.npz").height.shape == (128, 48)
    assert (
        "Made-up profiles. Lay: faster surface 6.504 deg, slower surface 7.463 deg" in caplog.text
    )
    assert statistics(tmp_path / "c" / "full_statistics.csv")["Ra"] == pytest.approx(0.31)


@each(
    ("arguments", "words"),
    [
        (("make",), "--ra-um or --rq-um"),
        (("make", "--ra-um", "nan"), "--ra-um must be finite"),
        (("make", "--ra-um", 0.3, "--skewness", 1, "--kurtosis", 1.5), "skewness^2 + 1"),
        (("make", "--ra-um", 310), "--ra-um must be within 0 to 100 um, got 310 um"),
        (("make", "--ra-um", 0.3, "--along-um", 40), "--width-mm is missing"),
        (("make", "--ra-um", 0.3, "--lay-deg", 8), "--width-mm is missing"),
        (("extrude", "missing.csv"), "The table missing.csv was not found in "),
        (("read", "missing.x3p"), "missing.x3p"),
        (("stand-in", "D"), "A, B, C"),
    ],
)
def test_wrong_input_is_told_and_writes_nothing(arguments, words, tmp_path, caplog, monkeypatch):
    monkeypatch.chdir(tmp_path)
    caplog.clear()
    assert run(*arguments).exit_code == 2
    assert words in caplog.text
    assert not list(tmp_path.iterdir())


def test_flow_factors_of_made_patches_and_of_files(tmp_path):
    made = tmp_path / "made"
    arguments = ("--points", 48, "--seeds", 2, "--film-ratios", "3,6", "--no-contact")
    assert run("flow-factors", *arguments, "--peklenik", 3, "--out", made).exit_code == 0
    with (made / "flow_factors.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["film_ratio"]) for row in rows] == [3.0, 6.0]
    # a lay along the motion lets more pass along than across it
    assert all(float(row["pressure_x"]) > float(row["pressure_y"]) for row in rows)
    assert (made / "flow_factors.png").read_bytes().startswith(b"\x89PNG")
    with xr.open_dataset(made / "flow_factors.nc") as table:
        assert float(table.pressure_x[0]) == pytest.approx(float(rows[0]["pressure_x"]), rel=1e-8)

    # crests along y with h = 3 a: 1/(27 mean(h^-3)) = 2 8^2.5/(19 27)
    turn = 2.0 * np.pi * np.arange(64) / 64
    np.savez(
        tmp_path / "waves.npz",
        x=1e-3 * np.arange(64),
        y=1e-3 * np.arange(8),
        height=0.3 * np.cos(turn)[:, None] + np.zeros(8),
    )
    ratio = 3.0 * np.sqrt(2.0)
    again = ("--film-ratios", ratio, "--no-contact", "--out", tmp_path / "read")
    assert run("flow-factors", tmp_path / "waves.npz", *again).exit_code == 0
    with xr.open_dataset(tmp_path / "read" / "flow_factors.nc") as table:
        assert float(table.pressure_x[0]) == pytest.approx(2.0 * 8.0**2.5 / 513.0, rel=1e-6)


def test_flow_factors_refuse_profiles_and_words(tmp_path, caplog):
    assert run("flow-factors", "--film-ratios", "1;2", "--out", tmp_path / "a").exit_code == 2
    assert "got '1;2'" in caplog.text
    (tmp_path / "p.csv").write_text("x_mm,height_um\n0,0\n1,1\n2,0\n3,1\n")
    assert run("flow-factors", tmp_path / "p.csv", "--out", tmp_path / "b").exit_code == 2
    assert "must hold a map, got a profile" in caplog.text
