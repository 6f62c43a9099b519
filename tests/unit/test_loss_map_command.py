"""What the loss map refuses, and what its command writes."""

from __future__ import annotations

import numpy as np
import pytest
from typer.testing import CliRunner

import gearlube as gl
from gearlube.command import COMMANDS, command_line
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.errors import ParameterError

AXLE = mohammadpour_2015_axle()


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"torques": np.array([50.0, 20.0])}, "rising"),
        ({"speeds": np.array([])}, "speeds must be a list"),
        ({"draws": -1}, "draws"),
        ({"torques": np.linspace(0.0, 1.0, 10_001)}, "at most 200000 points"),
    ],
)
def test_settings_that_make_no_map_are_refused(changed, words):
    with pytest.raises(ParameterError, match=words):
        gl.LossMapSettings(axle=AXLE, **changed)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--torques", "5000"], "--torques must be within -600 to 600 N.m, got 5000"),
        (["--torques", "-700"], "--torques must be within -600 to 600 N.m, got -700"),
        (["--speeds", "60000"], "--speeds must be within 1 to 47000 rpm, got 60000"),
        (["--speeds", "0"], "--speeds must be within 1 to 47000 rpm, got 0"),
        (["--temperatures", "313.15"], "--temperatures must be within -60 to 250 degC, got 313.15"),
        (["--temperatures", "180"], "temperature"),
        (["--speeds", "200:100:20"], "--speeds"),
        (["--draws", "-1"], "draws"),
    ],
)
def test_the_command_refuses_what_tables_and_oil_do_not_cover(tmp_path, caplog, words, said):
    out = tmp_path / "out"
    arguments = ["map", *words, "--out", str(out)]
    ended = CliRunner().invoke(command_line(COMMANDS), arguments)
    assert ended.exit_code == 2
    assert said in caplog.text
    assert not out.exists()


def test_the_command_writes_a_map_and_says_what_it_lacks(tmp_path, caplog):
    out = tmp_path / "out"
    ended = CliRunner().invoke(
        command_line(COMMANDS),
        ["map", "--torques", "-50:150:100", "--speeds", "1000", "--draws", "0", "--out", str(out)],
    )
    assert ended.exit_code == 0, ended.output
    assert (out / "map.csv").exists()
    assert "Loss map of mohammadpour_2015" in (out / "report.html").read_text()
    assert (out / "figures" / "losses.png").exists()
    assert "Not modelled" in caplog.text
    assert "at least 4 points, got 3" in caplog.text  # of a .vtlm file; the others are there
    assert (out / "gem_40degC.csv").exists()
    assert not list(out.glob("*.vtlm"))
