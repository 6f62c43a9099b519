"""Damage of an axle over bins: sums, factors, verdicts, tables of bins."""

import json
import re

import numpy as np
import pytest
import xarray as xr

from drivetrain.axle_file.read_axle import read_axle
from gearlube.damage.bins import bin_words, is_bins, joined, read_bins
from gearlube.damage.figures import tooth_figure
from gearlube.damage.report import damage_report, findings
from gearlube.damage.run import run_damage
from gearlube.damage.settings import DamageSettings, rated_bearing, rated_pair
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.contact.dang_van import FatigueLimits
from gearlube_core.errors import ParameterError
from gearlube_core.rating.spectrum import DutyBins
from gearlube_core.rating.subsurface import CaseHardening

K_WEAR = 5e-18  # 1/Pa
GEARS, BLANK = rated_pair("mohammadpour_2015", "", "case_hardened", 1500.0, 430.0)


def bins_of(*rows):
    """Torque [N.m], speed [rad/s], temperature [K], hours."""
    torque, speed, temperature, hours = np.array(rows).T
    return DutyBins(torque, speed, temperature, 3600.0 * hours)


HARD = bins_of((550.0, 60.0, 360.0, 30.0), (450.0, 60.0, 360.0, 100.0))
MILD = bins_of((-60.0, 200.0, 350.0, 50.0))


@pytest.fixture(scope="module")
def car():
    return read_axle("mohammadpour_2015")


@pytest.fixture(scope="module")
def run(car):
    bearing = rated_bearing(car.axle.bearing, [88.0, 110.0])

    def made(bins, **given):
        return run_damage(
            DamageSettings(
                car=car, bins=bins, gears=GEARS, blank=BLANK, bearings=(bearing, bearing),
                cleanliness="grease, clean", wear_coefficient=K_WEAR, **given,
            )
        )  # fmt: skip

    return made


@pytest.fixture(scope="module")
def both(run):
    return run(joined(HARD, MILD))


def test_damage_adds_over_bins(run, both):
    hard, mild = run(HARD), run(MILD)
    for name in ("wear_map", "local_damage_map"):
        np.testing.assert_allclose(both[name], hard[name] + mild[name], rtol=1e-12)
    for name in ("contact_damage", "bending_damage", "bearing_damage"):
        np.testing.assert_allclose(
            both[name].sum("bin"), hard[name].sum("bin") + mild[name].sum("bin")
        )
    assert float(both["contact_damage"].sum()) > 0.0


def test_twice_the_time_is_twice_the_damage(run):
    once, twice = run(HARD), run(HARD._replace(time=2.0 * HARD.time))
    for name in ("contact_damage", "bending_damage", "wear", "bearing_damage", "local_damage"):
        np.testing.assert_allclose(twice[name], 2.0 * once[name])


def test_torque_factor_scales_with_the_torque(run):
    factor = {}
    for part in (1.0, 0.8):
        found = run(HARD._replace(torque=part * HARD.torque))
        factor[part] = json.loads(found.attrs["torque_factors"])["breakage"][0]
    # torques that are 0.8 times as large may grow 1.25 times as much to the same bins
    assert factor[0.8] / factor[1.0] == pytest.approx(1.25, rel=1e-6)


def test_coast_bins_wear_the_coast_flanks_alone(run):
    found = run(MILD)
    assert float(found["pressure_map"].sel(side="drive").max()) == 0.0
    assert float(found["wear_map"].sel(side="coast").min("member").max()) > 0.0


def test_local_damage_is_miners_sum_of_the_pressure(run, car):
    """One bin, at the hottest place: cycles over those of the line between 1e5 and 5e7."""
    found = run(bins_of((550.0, 60.0, 360.0, 30.0)))
    rating = DamageSettings(car=car, bins=HARD, gears=GEARS, blank=BLANK).rate(550.0, 60.0, 360.0)
    (n_1, s_1), (n_2, s_2) = rating.contact_lines[0][:2]
    peak = 1e9 * float(found["pressure_map"].max())
    assert s_2 < peak < s_1
    slope = np.log(n_2 / n_1) / np.log(s_1 / s_2)
    lasts = n_2 * (s_2 / peak) ** slope
    expected = float(found["cycles"][0, 0]) / lasts
    assert float(found["local_damage"][0, 0]) == pytest.approx(expected, rel=1e-9)


def test_without_material_there_is_no_strength_but_all_else(car):
    found = run_damage(DamageSettings(car=car, bins=MILD))
    modes = [row[0] for row in json.loads(found.attrs["summary"])]
    assert not any(one.startswith(("pitting", "local", "breakage", "bearing")) for one in modes)
    assert any("scuffing" in mode for mode in modes)
    assert any("1500 and 430" in one.detail for one in findings(found))


def test_without_a_coefficient_no_wear_is_shown(car):
    found = run_damage(DamageSettings(car=car, bins=MILD))
    assert not any("wear" in str(name) for name in found.data_vars)
    assert not any("wear" in row[0] for row in json.loads(found.attrs["summary"]))
    told = [
        one for one in findings(found) if "Not given" in one.headline and "wear" in one.headline
    ]
    assert len(told) == 1
    assert "--wear-coefficient" in told[0].detail
    assert findings(found)[0].headline.startswith("No mode of failure has a limit")


def test_wear_too_deep_for_a_new_flank_is_a_warning(run):
    found = run(HARD._replace(time=1e4 * HARD.time))
    depth = float(found["wear_map"].max())
    assert depth > 2.0  # um
    warned = [one.headline for one in findings(found) if one.level == "warning"]
    assert any("wear, pinion: too deep for the rate of a new flank" in one for one in warned)
    assert "wear" not in findings(found)[0].headline  # the rate ends there, not the gear


def test_a_life_that_fails_is_a_warning(run):
    found = run(HARD._replace(time=1e3 * HARD.time))
    verdicts = {row[0]: row[5] for row in json.loads(found.attrs["summary"])}
    assert verdicts["pitting, drive, pinion"] == "fails"
    warned = [one.headline for one in findings(found) if one.level == "warning"]
    assert any("pitting, drive, pinion: fails" in one for one in warned)
    assert re.match(r"It does not last by pitting, drive, pinion \(safety 0\.\d+\)", warned[0])
    assert any("beyond the torques of the mesh table" in one for one in warned)


def test_scuffing_risk_needs_the_temperature_of_the_oil(run):
    def verdict(**given):
        rows = json.loads(run(HARD, **given).attrs["summary"])
        return next(row[5] for row in rows if row[0].startswith("scuffing"))

    assert verdict() == "no limit given"
    assert verdict(scuffing_temperature=600.0).startswith("low risk")
    assert verdict(scuffing_temperature=330.0).startswith("high risk")


def test_bearing_bears_what_its_rollers_do(run):
    found = run(HARD)
    used = found["bearing_damage"].values
    # the most loaded bearing of the pinion uses most of its life, with the exponent 10/3
    radial = found["radial_load"].values[:, 0]
    assert (used[:, 0] > used[:, 1]).all()
    rate = used[:, 0] / found["cycles"].values[:, 0]
    assert rate[0] / rate[1] == pytest.approx((radial[0] / radial[1]) ** (10.0 / 3.0), rel=0.2)


def test_modified_life_without_its_data_is_withheld(car):
    bearing = rated_bearing(car.axle.bearing, [88.0])  # no C_0
    found = run_damage(
        DamageSettings(car=car, bins=MILD, bearings=(bearing, None), cleanliness="grease, clean")
    )
    rows = {row[0]: row[5] for row in json.loads(found.attrs["summary"])}
    assert rows["bearing, pinion, first: basic life used"] == "lasts"
    assert "C_0 is missing" in rows["bearing, pinion, first: modified life used"]
    assert not any("bearing, gear" in one for one in rows)


def test_files_and_report(run, tmp_path, car):
    wears = DamageSettings(car=car, bins=MILD, wear_coefficient=K_WEAR)
    found = run_damage(wears, folder=tmp_path)
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"damage.nc", "damage.csv", "summary.csv", "figures"}
    assert (tmp_path / "damage.csv").read_text().startswith("torque_n_m,speed_rpm,temperature_degc")
    report = damage_report(found, tmp_path / "figures")
    assert [one.name for one in report.figures] == ["maps_coast", "bins"]


def test_bins_are_read_and_refused(tmp_path):
    path = tmp_path / "bins.csv"
    path.write_text(
        "torque_n_m;speed_rpm;temperature_degc;hours\n250;600;90;20\n", encoding="utf-8"
    )
    assert is_bins(str(path))
    found = read_bins(path)
    assert found.time[0] == 72_000.0
    assert found.revolutions[0] == pytest.approx(600 * 60 * 20)
    path.write_text("torque_n_m,speed_rpm,hours\n250,600,20\n", encoding="utf-8")
    with pytest.raises(ParameterError, match="missing: temperature_degc"):
        read_bins(path)
    head = "torque_n_m,speed_rpm,temperature_degc,"
    for row, words in (
        ("1,-5,90,20", "speed_rpm must be a finite number within 0.01"),
        ("1,5,363,20", "363 K are 90 degC"),
        ("1,5,90,0", "line 2: hours must be a finite number within 1e-09 to 1e.07 h, got '0'"),
        ("1,5,90,nan", "Fill the gap"),
    ):
        path.write_text(f"{head}hours\n{row}\n", encoding="utf-8")
        with pytest.raises(ParameterError, match=words):
            read_bins(path)
    path.write_text(f"{head}seconds\n1,5,90,20\n", encoding="utf-8")
    assert is_bins(str(path))  # no drive cycle: the message names the hours
    with pytest.raises(ParameterError, match="missing: hours"):
        read_bins(path)
    path.write_text("time_s,speed_kmh\n0,5\n", encoding="utf-8")
    assert not is_bins(str(path))


def test_bins_have_words_without_powers_of_ten():
    assert bin_words(bins_of((12345.0, 100.0, 353.15, 1.0)), 0) == "12345 N·m, 955 rpm, 80 °C"
    assert bin_words(bins_of((-999.7, 100.0, 353.15, 1.0)), 0).startswith("-1000 N·m")


def test_bad_settings_are_refused(car):
    with pytest.raises(ParameterError, match="torque of a bin"):
        DamageSettings(car=car, bins=bins_of((5000.0, 60.0, 360.0, 1.0)))
    with pytest.raises(ParameterError, match="temperature of a bin"):
        DamageSettings(car=car, bins=bins_of((50.0, 60.0, 900.0, 1.0)))
    with pytest.raises(ParameterError, match="time of all bins must be above 0 s, got 0"):
        DamageSettings(car=car, bins=bins_of((50.0, 60.0, 360.0, 0.0)))
    with pytest.raises(ParameterError, match="cleanliness must be one of"):
        DamageSettings(car=car, bins=MILD, cleanliness="clean")
    with pytest.raises(ParameterError, match=r"case_depth must be within 1e-05 to 0\.02 m"):
        DamageSettings(car=car, bins=MILD, case=CaseHardening(720.0, 342.0, 0.8))  # mm
    with pytest.raises(ParameterError, match=r"bending must be within 1e\+07 to 3e\+09 Pa"):
        FatigueLimits(bending=398.0, torsion=260.0)  # MPa
    with pytest.raises(ParameterError, match="1500 and 430 MPa are an example"):
        rated_pair("mohammadpour_2015", "", "case_hardened", 1500.0, None)
    with pytest.raises(ParameterError, match="C and C_0"):
        rated_bearing(TaperedRollerBearing.mohammadpour_2015(), [1.0, 2.0, 3.0])


def test_a_run_that_was_stopped_goes_on_with_the_bins_that_it_lacks(car, tmp_path, monkeypatch):
    settings = DamageSettings(car=car, bins=HARD)
    asked, states = [], settings.teeth.states

    def stopped(*at):
        asked.append(at)
        if len(asked) == 2:
            raise KeyboardInterrupt
        return states(*at)

    monkeypatch.setitem(vars(settings), "teeth", settings.teeth._replace(states=stopped))
    with pytest.raises(KeyboardInterrupt):
        run_damage(settings, folder=tmp_path)
    (tmp_path / "bins" / "my_table.csv").touch()
    found = run_damage(settings, folder=tmp_path)
    assert [at[0] for at in asked] == [550.0, 450.0, 450.0]
    xr.testing.assert_identical(found, run_damage(DamageSettings(car=car, bins=HARD)))
    # what somebody else keeps there is left alone
    assert [one.name for one in (tmp_path / "bins").iterdir()] == ["my_table.csv"]


def test_every_frame_of_the_maps_has_a_map(both):
    """An odd number of maps leaves no empty frame."""
    figure = tooth_figure(both.sel(side="drive").drop_vars("heat_map"), "drive")
    assert all(ax.collections for ax in figure.axes)


def test_ratings_of_bearings_in_newtons_are_refused(car):
    with pytest.raises(ParameterError, match="88 kN is 88, not 88000"):
        rated_bearing(car.axle.bearing, [88000.0])
