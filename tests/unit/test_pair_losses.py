"""Losses of a pair alone: parts by their formulas, error bars, table, command."""

from __future__ import annotations

import csv
import io
import math
import re
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from scipy.stats import norm
from typer.testing import CliRunner

from gearlube.command import COMMANDS, command_line
from gearlube.studies.helical import pair_losses
from gearlube.studies.helical.film_friction import film_dataset
from gearlube.studies.helical.pair_losses import PairFactor, losses_csv, losses_dataset
from gearlube.studies.helical.settings import HelicalSettings
from gearlube_core.dynamics.helical_pair.gear_file_pair import gear_file_oil
from gearlube_core.errors import ParameterError
from gearlube_core.friction.line_points import line_points, table_line_load
from gearlube_core.helical_geometry.gear_file import HelicalGearFile

FILE = HelicalGearFile.named("jamali_2015_a")
SETTINGS = HelicalSettings(
    file=FILE,
    pinion_torque=1060.0,
    pinion_speed=235.6,
    parts="losses",
    torques=(300.0, 1060.0),
    speeds=(60.0, 235.6),
    oil_temperatures=(313.15, 363.15),
    draws=0,
    oil="mohammadpour_2015",
)
MESH = SETTINGS.constant_mesh()


@pytest.fixture(scope="module")
def found():
    return losses_dataset(SETTINGS, MESH)


def at(dataset, degc, torque, speed):
    return dataset.sel(temperature=degc, torque=torque).sel(
        speed=speed * 30.0 / math.pi, method="nearest"
    )


def test_sliding_is_that_of_the_film_study(found):
    """The same friction on other points of the mesh period."""
    film = film_dataset(replace(SETTINGS, oil_temperature=313.15), MESH)
    sliding = float(at(found, 40.0, 1060.0, 235.6)["loss"].sel(part="sliding"))
    # 48 phases against 96: the mean converges with 1/phases^2
    assert sliding == pytest.approx(film.attrs["operating_power_loss"], rel=1e-3)


def test_rolling_is_twice_the_force_times_the_speed(found):
    """Biboulet and Houpert's force with Zhu and Cheng's heating, written out over the lines."""
    torque, speed, temperature = 300.0, 60.0, 363.15
    film = SETTINGS.film()
    points = line_points(FILE.helical_pair(), 48, 8)
    q = table_line_load(points, MESH, torque)
    plane = points.pair.plane
    R_p, R_g = points.x, plane.x_g - points.x
    R = R_p * R_g / ((R_p + R_g) * plane.cos_b)
    u_p, u_g = R_p * speed, R_g * speed * plane.r_bp / plane.r_bg
    u = 0.5 * (u_p + u_g)
    solid = film.solid
    E = 2.0 * solid.youngs_modulus / (2.0 * (1.0 - solid.poisson_ratio**2))  # 2 E* of two alike
    eta = film.oil.dynamic_viscosity(temperature)
    h = 1e-3
    beta = -(
        math.log(film.oil.dynamic_viscosity(temperature + h))
        - math.log(film.oil.dynamic_viscosity(temperature - h))
    ) / (2.0 * h)
    U = 2.0 * eta * u / (E * R)
    with np.errstate(divide="ignore", invalid="ignore"):
        W = q / (E * R)
        M = W / np.sqrt(U)
        force = E * R * 1.42 * np.sqrt(U * W) / (1.0 + (0.966 * np.sqrt(M)) ** 10) ** 0.1
        p_H = np.sqrt(q * E / (2.0 * np.pi * R))
        Lt = eta * beta * u**2 / film.oil.conductivity
        heating = (1.0 - 13.2 * p_H / E * Lt**0.42) / (
            1.0 + 0.213 * (1.0 + 2.23 * np.abs((u_p - u_g) / u) ** 0.83) * Lt**0.64
        )
    power = np.where(q > 0.0, 2.0 * force * u * heating, 0.0)
    expected = (power * points.length).sum(axis=(1, 2)).mean()
    rolling = float(at(found, 90.0, torque, speed)["loss"].sel(part="rolling"))
    assert rolling == pytest.approx(expected, rel=1e-6)  # beta by differences


def test_cold_oil_rolls_harder_and_load_slides_more(found):
    loss = found["loss"]
    assert np.all(
        loss.sel(part="rolling", temperature=40.0) > loss.sel(part="rolling", temperature=90.0)
    )
    assert np.all(loss.sel(part="sliding", torque=1060.0) > loss.sel(part="sliding", torque=300.0))


def test_the_parts_are_the_whole_and_the_efficiency(found):
    one = at(found, 40.0, 1060.0, 235.6)
    total = float(one["loss"].sum())
    assert float(one["loss_torque"]) == pytest.approx(total / 235.6, rel=1e-12)
    assert float(one["efficiency"]) == pytest.approx(1.0 - total / (1060.0 * 235.6), rel=1e-12)


def test_one_law_alone_spreads_the_loss_by_its_own_factor(monkeypatch):
    monkeypatch.setattr(pair_losses, "UNCERTAIN", tuple(
        PairFactor(name, 1.5 if name == "sliding" else 1.0, "test")
        for name in ("viscosity", "eyring_stress", "alpha", "roughness", "sliding", "rolling")
    ))  # fmt: skip
    settings = replace(
        SETTINGS, torques=(1060.0,), speeds=(235.6,), oil_temperatures=(313.15,), draws=400
    )
    one = losses_dataset(settings, MESH).squeeze()
    sliding, rolling = one["loss"].values
    spread = 1.5 ** (0.5 * norm.ppf(0.975))
    for name, factor in (("loss_torque_low", 1.0 / spread), ("loss_torque_high", spread)):
        # 400 draws: a percentile at 2.5 % is 0.13 standard deviations off, that is 2.7 %
        assert float(one[name]) == pytest.approx((sliding * factor + rolling) / 235.6, rel=0.06)


def test_the_table_has_all_points(found):
    rows = list(csv.DictReader(io.StringIO(losses_csv(found))))
    assert len(rows) == 8
    row = next(
        r
        for r in rows
        if (r["oil_temperature_degc"], r["pinion_torque_n_m"]) == ("90", "1060")
        and float(r["pinion_speed_rpm"]) < 1000.0
    )
    one = at(found, 90.0, 1060.0, 60.0)
    assert float(row["loss_torque_n_m"]) == pytest.approx(float(one["loss_torque"]), rel=1e-6)
    assert float(row["loss_rolling_w"]) == pytest.approx(
        float(one["loss"].sel(part="rolling")), rel=1e-6
    )


def test_the_oil_of_the_gear_file_is_the_oil_of_its_losses(tmp_path):
    """6.25 mPa s at 90 degC and 13.3 1/GPa of the section [oil], on the slope of the usual oil."""
    oil, usual = replace(SETTINGS, oil=None).film().oil, SETTINGS.film().oil
    assert oil.dynamic_viscosity(363.15) == pytest.approx(0.00625, rel=1e-9)
    assert (oil.alpha, oil.eyring_stress) == pytest.approx((13.3e-9, 10e6))
    slopes = [one.dynamic_viscosity(363.15) / one.dynamic_viscosity(383.15) for one in (oil, usual)]
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-9)
    path = tmp_path / "other.toml"
    path.write_text(
        'name = "other"\nbase_oil = "mineral"\ndensity_kg_m3 = 870.0\n'
        "viscosity_40_degc_mm2_s = 220.0\nviscosity_100_degc_mm2_s = 19.0\n"
    )
    both = FILE.model_copy(update={"film": FILE.film.model_copy(update={"oil_file": str(path)})})
    with pytest.raises(ParameterError, match=r"one oil, got two.*at 90 degC.*0.00625.*10 %"):
        gear_file_oil(both)
    assert gear_file_oil(HelicalGearFile.named("he_2007")).name == "mohammadpour_2015"


def test_the_report_says_what_was_given_and_what_is_a_default(tmp_path):
    out = tmp_path / "out"
    words = ["helical", "jamali_2015_a", "--parts", "losses", "--draws", "0", "--out", str(out)]
    words += ["--roughness-um", "0.5", "--torques", "300", "--speeds-rpm", "500"]
    origins = {}
    for extra in ([], ["--oil", "fva_3", "--overwrite"]):
        ended = CliRunner().invoke(command_line(COMMANDS), [*words, *extra])
        assert ended.exit_code == 0, ended.output
        html = re.sub(r"<[^>]+>", "|", (out / "report.html").read_text(encoding="utf-8"))
        for name in (
            "composite roughness",
            "oil temperature",
            "pinion torque",
            "oil.viscosity_pa_s",
        ):
            row = re.search(rf"\|{name}\|+[^|]*\|+(\w+)\|+([\w ]*)", html)
            origins.setdefault(name, []).append(row and row.groups())
    # typed, though it is the default; a default; of the file; not used with another oil
    assert origins["composite roughness"] == [("given", "option")] * 2
    assert origins["oil temperature"] == [("assumed", "default")] * 2
    assert origins["pinion torque"] == [("given", "gear file")] * 2
    assert origins["oil.viscosity_pa_s"][0][0] == "given"
    assert origins["oil.viscosity_pa_s"][1] is None


def test_temperatures_outside_the_oil_are_refused():
    with pytest.raises(ParameterError, match="oil_temperatures"):
        replace(SETTINGS, oil_temperatures=(313.15, 600.0))
    with pytest.raises(ParameterError, match="must rise"):
        replace(SETTINGS, oil_temperatures=(363.15, 313.15))


def test_the_command_takes_an_oil_file_and_writes_the_losses(tmp_path):
    oil, out = tmp_path / "my_oil.toml", tmp_path / "out"
    printed = CliRunner().invoke(command_line(COMMANDS), ["oil", "--example"])
    oil.write_text(printed.output)
    arguments = ["helical", "jamali_2015_a", "--parts", "losses", "--oil", str(oil)]
    arguments += ["--speeds-rpm", "500", "1500", "--torques", "300", "1060", "--draws", "2"]
    ended = CliRunner().invoke(
        command_line(COMMANDS), [*arguments, "--oil-temperatures", "40", "90", "--out", str(out)]
    )
    assert ended.exit_code == 0, ended.output
    with xr.open_dataset(out / "losses.nc", engine="scipy") as read:
        assert read["loss_torque"].shape == (2, 2, 2)
        assert "churning" in read.attrs["not_modelled"]
    assert (out / "losses.csv").exists()
    assert (out / "figures" / "losses.png").exists()
