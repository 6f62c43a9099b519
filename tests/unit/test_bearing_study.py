"""The bearing file, its study and the command `gearlube bearing`."""

from __future__ import annotations

import csv
import logging
import re

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube.command import app
from gearlube.studies.bearing.run import BearingSettings, run_bearing
from gearlube.studies.bearing.summary import bearing_warnings, error_sentences
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.loss import LossModel
from gearlube_core.errors import ParameterError
from tests.helpers.bearing_32216 import BEARING, DEG, RPM
from tests.helpers.each import each
from tests.helpers.units import without_units

FILE = BearingFile.named("wingertszahn_2023")
SMALL = BearingSettings(
    speeds=(0.0, 500 * RPM, 4000 * RPM),
    axial_loads=(6000.0,),
    radial_loads=(0.0, 6500.0),
    temperatures=(323.15,),
    models=tuple(LossModel(law=law) for law in ("zhou_hoeprich", "skf", "biboulet_houpert")),
)


def test_the_shipped_file_is_the_measured_bearing():
    made = FILE.geometry()
    for name in ("pitch_diameter", "roller_diameter", "roller_length", "outer_angle", "n_rollers"):
        assert getattr(made, name) == pytest.approx(getattr(BEARING, name), rel=1e-12)


def test_an_inner_angle_that_is_left_out_closes_the_apex():
    closed = FILE.varied({"bearing.inner_angle_deg": None}).geometry()
    assert closed.inner_angle / DEG == pytest.approx(11.44, abs=0.005)  # as printed elsewhere
    radius = 0.5 * closed.pitch_diameter / np.sin(closed.mean_angle) * np.tan(closed.half_cone)
    assert radius == pytest.approx(8.5e-3, rel=1e-9)


@each(
    ("changes", "words"),
    [
        ({"bearing.rollers": 20}, ["The rollers overlap", "at most 19 fit"]),
        ({"bearing.inner_angle_deg": 16.0}, ["wrong side", "leave the inner angle out"]),
        ({"bearing.inner_angle_deg": 9.0}, ["share their apex", "11.44 deg"]),
        ({"bearing.pitch_diameter_mm": 0.1085}, ["pitch_diameter_mm", "0.1085 m is 108.5 mm"]),
        ({"bearing.contact_angle_deg": None}, ["contact_angle_deg is missing"]),
        ({"bearing.cage": 1.0}, ["bearing.cage is not a field"]),
    ],
)
def test_a_wrong_file_says_what_is_wrong(changes, words):
    with pytest.raises(ParameterError) as refusal:
        FILE.varied(changes)
    assert all(word in str(refusal.value) for word in words), str(refusal.value)


def test_parts_add_up_and_the_error_bar_encloses_the_torque():
    found = run_bearing(FILE, SMALL)
    assert found["torque"].attrs["units"] == "N.m"
    assert found["part_torque"].sum("part").values == pytest.approx(found["torque"].values)
    assert (found["torque"] * found["speed"]).values == pytest.approx(found["power"].values)
    moving = found.isel(speed=slice(1, None))
    assert (moving["torque_low"] < moving["torque"]).all()
    assert (moving["torque_high"] > moving["torque"]).all()
    assert np.isnan(found["part_torque"].sel(law="skf", part="rib")).all()
    assert float(found["power"].isel(speed=0).max()) == 0.0


def test_error_bar_and_range_are_said_in_words():
    found = run_bearing(FILE, SMALL)
    first, second, last = error_sentences(found)
    assert "factor of 2, k = 2, by zhou_hoeprich" in first
    assert "factor of 5, k = 2, by biboulet_houpert" in second
    assert "factor of 5.5, k = 2, by skf" in last
    (warning,) = bearing_warnings(found)
    assert "biboulet_houpert: raceway contacts leave the range" in warning
    assert "4000 rpm" in warning
    calibrated = run_bearing(FILE.varied({"bearing.rolling_scale": 0.9}), SMALL)
    assert "factor of 1.25, k = 2, by zhou_hoeprich, biboulet" in error_sentences(calibrated)[0]


def test_a_thin_film_of_the_raceways_is_said():
    slow = BearingSettings(
        speeds=(1.0,), axial_loads=(6000.0,), radial_loads=(0.0,), temperatures=(373.15,)
    )
    (warning,) = bearing_warnings(run_bearing(FILE, slow))
    assert "asperities rub on the raceways" in warning


@pytest.mark.parametrize(
    "wrong",
    [
        {"temperatures": (323.15, 500.0)},
        {"speeds": (100.0, 5000.0)},
        {"radial_loads": (0.0, 6500.0, 20000.0)},
        {"axial_loads": (6000.0, 1e7)},
    ],
)
def test_nothing_is_computed_when_one_condition_is_out_of_range(wrong, monkeypatch):
    def never(*_arguments: object, **_named: object) -> None:
        raise AssertionError("computed")

    monkeypatch.setattr("gearlube.studies.bearing.run.bearing_loss", never)
    fields = {name: getattr(SMALL, name) for name in SMALL.__slots__} | wrong
    with pytest.raises(ParameterError):
        run_bearing(FILE, BearingSettings(**fields))


@pytest.mark.slow
def test_command_writes_each_part_on_its_own_line(tmp_path, caplog):
    path = tmp_path / "my_bearing.toml"
    shown = CliRunner().invoke(app, ["bearing", "--example"])
    path.write_text(shown.output.replace('name = "wing', 'name = "my_wing'))
    oil = tmp_path / "my_oil.toml"
    oil.write_text(
        'name = "thin"\nbase_oil = "mineral"\ndensity_kg_m3 = 870.0\n'
        "viscosity_40_degc_mm2_s = 32.0\nviscosity_100_degc_mm2_s = 5.4\n"
    )
    out = tmp_path / "results"
    words = ["bearing", str(path), "--oil", str(oil), "--out", str(out)]
    conditions = ["--speed-rpm", "500", "2000", "--radial-load", "0", "--temperature", "50"]
    with caplog.at_level(logging.INFO):
        done = CliRunner().invoke(app, [*words, *conditions, "--law", "zhou_hoeprich"])
    assert done.exit_code == 0, done.output
    assert {p.name for p in out.iterdir()} >= {"bearing.nc", "bearing.csv", "figures"}
    with (out / "bearing.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert [row["part"] for row in rows[:5]] == ["rolling", "rib", "drag", "hysteresis", "total"]
    torque = [float(row["torque_n_m"]) for row in rows[:5]]
    assert sum(torque[:4]) == pytest.approx(torque[4], rel=1e-5)  # six digits are written
    # the rib, here with a thin oil, widens the factor of 2
    assert 2.0 < float(rows[4]["torque_high_n_m"]) / torque[4] < 2.1
    assert float(rows[4]["power_w"]) == pytest.approx(torque[4] * 500 * RPM, rel=1e-5)
    with xr.open_dataset(out / "bearing.nc") as stored:
        assert not without_units(stored)
        assert stored.attrs["name"] == "my_wingertszahn_2023"
        assert stored["torque"].attrs["units"] == "N.m"
        assert stored["speed"].attrs["units"] == "rad/s"
    said = caplog.text
    assert re.search(r"loses at most \d+ W \(\d+ to \d+, 95 %\)", said)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--temperature", "200"], "within 20 to 120 degC, got 200 degC"),
        (["--speed-rpm", "50000"], "--speed-rpm must be within 0 to 13824.9 rpm, got 50000 rpm"),
        (["--axial-load", "0"], "needs an axial load"),
        (["--law", "nope"], "law must be one of"),
        (["--oil", "olive"], "The oil must be one of fva_3"),
        (["--law", "skf", "--inlet-layer-um", "3"], "takes no heating and no inlet layer"),
    ],
)
def test_command_refuses_before_it_writes(options, words, tmp_path, caplog):
    out = tmp_path / "results"
    done = CliRunner().invoke(app, ["bearing", "--out", str(out), *options])
    assert done.exit_code == 2
    assert words in caplog.text
    assert not out.exists()
