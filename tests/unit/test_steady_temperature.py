"""Oil temperature at constant running, over a map and as `gearlube map` tells it."""

from __future__ import annotations

import csv
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

import gearlube as gl
from drivetrain.steady_temperature import Cooling, steady_temperatures
from gearlube.command import COMMANDS, command_line
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.errors import ParameterError

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
        alone = gl.steady_temperature(
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
    poor = replace(COOLING, heat=gl.SumpHeat(conductance_at_rest=0.5, conductance_at_100_kmh=0.5))
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
    heat = gl.SumpHeat(conductance_at_rest=0.5, conductance_at_100_kmh=6.0)
    with pytest.raises(ParameterError, match="steady oil temperature must be below"):
        gl.steady_temperature(
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
