"""The command `gearlube roughness`: files, messages, and what it refuses."""

from __future__ import annotations

import csv
import logging

import numpy as np
import pytest
from typer.testing import CliRunner

from gearlube.command import app
from gearlube_core.surface.files import read_surface


def run(*arguments):
    return CliRunner().invoke(app, ["roughness", *map(str, arguments)])


def statistics(path):
    with path.open(encoding="utf-8", newline="") as file:
        return {row["name"]: float(row["value"]) for row in csv.DictReader(file)}


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


def test_a_map_and_a_stand_in_are_written(tmp_path, caplog):
    arguments = ("--rq-um", 0.2, "--width-mm", 0.1, "--period-mm", 0.2, "--points", 128)
    more = ("--rows", 48, "--correlation-um", 12, "--skewness", -0.3, "--cut-peaks-um", 0.4)
    with caplog.at_level(logging.INFO, "gearlube"):
        assert run("make", *arguments, *more, "--out", tmp_path / "map").exit_code == 0
        assert "Model of running-in" in caplog.text
        assert run("stand-in", "C", "--out", tmp_path / "c").exit_code == 0
    assert read_surface(tmp_path / "map" / "surface.npz").height.shape == (128, 48)
    assert "Stand-in. Lay: fast surface 6.504 deg, slow 7.463 deg" in caplog.text
    assert statistics(tmp_path / "c" / "full_statistics.csv")["Ra"] == pytest.approx(0.31)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("make",), "--ra-um or --rq-um"),
        (("make", "--ra-um", "nan"), "--ra-um must be finite"),
        (("make", "--ra-um", 0.3, "--skewness", 1, "--kurtosis", 1.5), "skewness^2 + 1"),
        (("make", "--ra-um", 310), "--ra-um must be within 0 to 100 um, got 310 um"),
        (("make", "--ra-um", 0.3, "--along-um", 40), "got no --width-mm"),
        (("make", "--ra-um", 0.3, "--lay-deg", 8), "got no --width-mm"),
        (("extrude", "missing.csv"), "not a readable CSV file: there is no such file."),
        (("read", "missing.x3p"), "missing.x3p"),
        (("stand-in", "D"), "A, B, C"),
    ],
)
def test_wrong_input_is_told_and_writes_nothing(arguments, words, tmp_path, caplog, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(*arguments).exit_code == 2
    assert words in caplog.text
    assert not list(tmp_path.iterdir())
