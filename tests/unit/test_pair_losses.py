"""Losses of gear pairs, and steady temperatures."""

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

import gearlube as gl
from drivetrain.steady_temperature import Cooling, steady_temperatures
from gearlube.command import COMMANDS, command_line
from gearlube.studies.helical.film_friction import film_dataset
from gearlube.studies.helical.pair_losses import losses_csv, losses_dataset
from gearlube.studies.helical.settings import HelicalSettings
from gearlube_core.dynamics import helical_uncertain
from gearlube_core.dynamics.helical_pair.gear_file_pair import gear_file_oil
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.dynamics.hypoid_axle.uncertain import Uncertain
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
    monkeypatch.setattr(helical_uncertain, "UNCERTAIN", tuple(
        Uncertain(name, name, 1.5 if name == "sliding" else 1.0, "test")
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


CAR = gl.read_axle("mohammadpour_2015")
COLD_AIR = gl.celsius_to_kelvin(5.0)
COOLING = Cooling(driveline=CAR.driveline, air_temperature=COLD_AIR)
TORQUES, SPEEDS = np.array([-40.0, 0.0, 120.0]), np.array([60.0, 300.0])


@pytest.fixture(scope="module")
def steady():
    return steady_temperatures(CAR.axle, COOLING, torques=TORQUES, speeds=SPEEDS)


def test_the_air_takes_what_the_axle_loses_there(steady):
    """hA by hand: 7 W/K at rest and 18 at 100 km/h, with V^0.8 between."""
    temperatures, lost = steady
    radius = CAR.driveline.road_load.tyre.rolling_radius
    for j, speed in enumerate(SPEEDS):
        vehicle = speed / CAR.axle.mesh.ratio * radius * 3.6
        conductance = 7.0 + 11.0 * (vehicle / 100.0) ** 0.8
        taken = conductance * (temperatures[j] - COLD_AIR)
        assert lost[j] == pytest.approx(taken, rel=1e-9)
        for k, torque in enumerate(TORQUES):
            direct = axle_losses(
                CAR.axle,
                torques=np.array([torque]),
                speeds=np.array([speed]),
                temperatures=temperatures[j, k : k + 1],
                extremes=False,
            )
            # cubics between temperatures 4.5 K apart, and 8 angles in place of 32
            assert lost[j, k] == pytest.approx(direct.total[0, 0, 0], rel=1e-3)


def test_it_is_that_of_one_point_alone(steady):
    for j, k in ((0, 2), (1, 0), (1, 2)):
        alone = gl.studies.steady_temperature(
            CAR, torque=TORQUES[k], speed=SPEEDS[j], air_temperature=COLD_AIR
        )
        # 0.1 % of the loss is as much of the rise, some 50 K
        assert steady[0][j, k] == pytest.approx(alone, abs=0.05)


def test_more_torque_and_warmer_air_make_warmer_oil(steady):
    temperatures = steady[0]
    assert np.all(temperatures > COLD_AIR)
    assert np.all(temperatures[:, 2] > temperatures[:, 1])
    warmer = replace(COOLING, air_temperature=COLD_AIR + 30.0)
    above, _ = steady_temperatures(CAR.axle, warmer, torques=TORQUES, speeds=SPEEDS)
    rise = above - temperatures
    # the loss falls with temperature, so the oil follows the air only in part
    assert np.all((rise > 0.0) & (rise < 30.0))


def test_oil_that_comes_to_no_rest_has_no_temperature():
    poor = replace(
        COOLING, heat=gl.studies.SumpHeat(conductance_at_rest=0.5, conductance_at_100_kmh=0.5)
    )
    found, lost = steady_temperatures(
        CAR.axle, poor, torques=np.array([0.0, 300.0]), speeds=np.array([1.0, 300.0])
    )
    assert np.isfinite(found[0, 0])
    assert np.isnan(found[1, 1])
    assert np.isnan(lost[1, 1])


@pytest.mark.parametrize(
    ("air", "words"), [(200.0, "air_temperature"), (423.15, "below the upper limit of the oil")]
)
def test_air_that_the_oil_does_not_know_is_refused(air, words):
    with pytest.raises(ParameterError, match=words):
        steady_temperatures(
            CAR.axle, replace(COOLING, air_temperature=air), torques=TORQUES, speeds=SPEEDS
        )


WORDS = ["map", "--torques", "60", "300", "--speeds", "2000", "--draws", "0"]


def test_the_command_writes_the_steady_temperature(tmp_path, caplog):
    out = tmp_path / "out"
    more = ["--steady-temperature", "--air-temperature", "10", "--conductance-at-rest", "0.5"]
    more += ["--conductance-at-100", "6", "--temperatures", "40", "80", "--out", str(out)]
    ended = CliRunner().invoke(command_line(COMMANDS), [*WORDS, *more])
    assert ended.exit_code == 0, ended.output
    heat = gl.studies.SumpHeat(conductance_at_rest=0.5, conductance_at_100_kmh=6.0)
    with pytest.raises(ParameterError, match="steady oil temperature must be below"):
        gl.studies.steady_temperature(
            CAR, torque=300.0, speed=2000.0 * np.pi / 30.0, air_temperature=283.15, heat=heat
        )
    assert "1 of 2 torques and speeds reach no steady temperature" in caplog.text
    with xr.open_dataset(out / "map.nc", engine="scipy") as found:
        assert found["steady_temperature"].dims == ("speed", "torque")
        assert found["steady_temperature"].attrs["units"] == "degC"
        assert found.attrs["air_temperature_degc"] == pytest.approx(10.0)
    with (out / "map.csv").open() as file:
        rows = list(csv.DictReader(file))
    steady = [one["steady_oil_temperature_degc"] for one in rows]
    # a row for each of two temperatures; it depends on torque and speed alone
    assert steady[0] == steady[2] != ""
    assert steady[1] == steady[3] == ""
    lost = float(rows[0]["steady_loss_torque_n_m"]) * 2000.0 * np.pi / 30.0
    radius, ratio = CAR.driveline.road_load.tyre.rolling_radius, CAR.axle.mesh.ratio
    vehicle = 2000.0 * np.pi / 30.0 / ratio * radius * 3.6
    conductance = 0.5 + 5.5 * (vehicle / 100.0) ** 0.8
    assert lost == pytest.approx(conductance * (float(steady[0]) - 10.0), rel=1e-5)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--air-temperature", "10"], "--air-temperature works only with --steady-temperature"),
        (["--steady-temperature", "--air-temperature", "283"], "air_temperature"),
        (["--steady-temperature", "--conductance-at-100", "-1"], "conductance_at_100_kmh"),
    ],
)
def test_the_command_refuses_cooling_that_cannot_be(tmp_path, caplog, more, words):
    out = tmp_path / "out"
    ended = CliRunner().invoke(command_line(COMMANDS), [*WORDS, *more, "--out", str(out)])
    assert ended.exit_code == 2
    assert words in caplog.text
    assert not out.exists()


@pytest.mark.parametrize("field", ["pinion_torque", "torques"])
def test_a_torque_that_no_flank_carries_is_refused(field):
    """p_0 = (w E/(2 pi (1 - nu^2) R))^0.5 of two steel cylinders, E = 210 GPa, nu = 0.3."""
    pair = SETTINGS.file.helical_pair()
    first, whole, cosine = pair.pitch_point, pair.tangent_length, math.cos(pair.base_helix_angle)
    radius = first * (whole - first) / whole / cosine
    line_load = 4e9**2 * 2.0 * math.pi * 0.91 * radius / 210e9
    most = line_load * pair.mean_contact_length * pair.pinion_base_radius * cosine

    def with_torque(value):
        return replace(SETTINGS, **{field: (value,) if field == "torques" else value})

    with_torque(0.999 * most)
    with pytest.raises(ParameterError, match=f"{field} must be .*more than 4 GPa"):
        with_torque(1.001 * most)
