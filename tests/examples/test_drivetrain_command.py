"""The command drivetrain: two rotors by closed forms, and the shipped e-axle."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from drivetrain.train.train_file import TrainFile
from gearlube.command import app
from gearlube.studies.drivetrain.layout import layout
from gearlube.studies.drivetrain.report import findings, losses, transmission_errors
from gearlube.studies.drivetrain.run import FILE
from tests.helpers.small_trains import BRAKE, FIRST, SECOND, STIFFNESS, WITH_BRAKE


@pytest.fixture(scope="module")
def rotors(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("drivetrain")
    (folder / "rotors.toml").write_text(WITH_BRAKE)
    done = CliRunner().invoke(
        app,
        ["drivetrain", str(folder / "rotors.toml"), "--duration-ms", "20", "--step-us", "1000",
         "--out", str(folder / "out")],
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    return folder / "out"


def test_the_mode_of_two_rotors_is_that_of_the_closed_form(rotors: Path) -> None:
    """w2 = k (1/I1 + 1/I2), and each rotor has the other's share of the inertia in the energy."""
    with xr.open_dataset(rotors / FILE) as found:
        frequency, share = found["frequency"].values, found["share"].values
    w0 = math.sqrt(STIFFNESS * (1.0 / FIRST + 1.0 / SECOND))
    assert frequency == pytest.approx([w0 / (2.0 * math.pi)], rel=1e-6)
    assert share[0] == pytest.approx([SECOND / (FIRST + SECOND), FIRST / (FIRST + SECOND)])


def test_the_brake_loses_its_torque_times_the_speed(rotors: Path) -> None:
    with xr.open_dataset(rotors / FILE) as found:
        lost = losses(found)
        speed = found["load.speed"].values
        # means over each step of a speed that falls evenly
        expected = BRAKE * (0.5 * (speed[1:] + speed[:-1]))[-11:]
        assert lost["brake"] == pytest.approx(expected.mean(), rel=1e-6)
        assert float(found.attrs["imbalance"]) < 1e-7
        assert transmission_errors(found) == {}


def test_the_report_says_where_the_power_goes(rotors: Path) -> None:
    with xr.open_dataset(rotors / FILE) as found:
        said = [one.headline for one in findings(found)]
    assert any(re.match(r"The drivetrain loses 31\d W\.", one) for one in said), said
    assert any(one.startswith("The energy balance closes") for one in said)
    assert not any(one.startswith("The speed of") for one in said)  # the brake takes 0.03 %
    page = (rotors / "report.html").read_text("utf-8")
    assert "Natural frequencies, and which bodies move" in page
    assert "Transmission error of every mesh" not in page  # there is none


def test_torques_that_do_not_balance_are_told(rotors: Path) -> None:
    with xr.open_dataset(rotors / FILE) as found:
        faster = found.load()
    faster["load.speed"] = faster["load.speed"] * np.linspace(1.0, 1.5, faster.sizes["time"])
    (said,) = [one for one in findings(faster) if one.headline.startswith("The speed of")]
    assert said.level == "warning"
    assert said.headline == "The speed of load changes from 1000 to 1500 rpm."


def test_a_drivetrain_that_stands_has_no_drift_and_no_losses(rotors: Path) -> None:
    with xr.open_dataset(rotors / FILE) as found:
        still = found.load()
    for name in still.data_vars:
        if str(name).endswith((".speed", ".power_loss")):
            still[name] = 1e-30 * still[name] * np.linspace(0.0, 1.0, still.sizes["time"])
    said = [one.headline for one in findings(still)]
    assert [one for one in said if one.startswith(("The speed of", "The drivetrain loses"))] == []


def test_the_example_is_a_file_to_start_from(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["drivetrain", "--example"])
    assert done.exit_code == 0
    assert 'kind = "helical_mesh"' in done.output


def test_a_step_that_is_too_short_is_refused(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "rotors.toml").write_text(WITH_BRAKE)
    done = CliRunner().invoke(
        app,
        ["drivetrain", str(tmp_path / "rotors.toml"), "--duration-ms", "1e6", "--step-us", "1",
         "--out", str(tmp_path / "out")],
    )  # fmt: skip
    assert done.exit_code == 2
    assert "step must be within 0.005 to 0.1 s" in caplog.text


@pytest.mark.slow
def test_the_shipped_axle_balances_its_energy(tmp_path: Path) -> None:
    done = CliRunner().invoke(
        app, ["drivetrain", "e_axle", "--duration-ms", "20", "--out", str(tmp_path)]
    )
    assert done.exit_code == 0, done.output
    with xr.open_dataset(tmp_path / FILE) as found:
        assert float(found.attrs["imbalance"]) < 1e-5
        speeds = [found[f"{body}.speed"].values.mean() for body in ("motor", "counter")]
        assert speeds[0] / speeds[1] == pytest.approx(-31.0 / 25.0, rel=1e-4)  # teeth
        assert np.isfinite(found["stage_1.dte"]).all()
        # helical meshes lose 0.3 to 1.5 % each
        assert 0.97 < float(found["efficiency"][-1]) < 0.995
        assert found.sizes["mode"] == 19  # 20 free coordinates less the turning of the whole


def test_the_picture_places_shafts_by_their_meshes() -> None:
    """Distances are those of the teeth: m z / 2 cos b, added along the chain; a ring is coaxial."""
    axle = layout(TrainFile.named("e_axle_elastic").case().train)
    first = 3.0e-3 * (17 + 31) / (2.0 * math.cos(math.radians(28.0)))
    second = 3.4e-3 * (17 + 74) / (2.0 * math.cos(math.radians(24.0)))
    ways = [np.exp(1j * math.radians(angle)) for angle in (-40.0, 20.0)]
    assert axle.centres["counter"] == pytest.approx(first * ways[0], rel=1e-9)
    assert axle.centres["output"] == pytest.approx(first * ways[0] + second * ways[1], rel=1e-9)
    assert len(axle.seats["input"]) == 3
    stage = layout(TrainFile.named("planetary").case().train)
    assert abs(stage.centres["ring"] - stage.centres["sun"]) < 1e-12
    planets = [centre for name, centre in stage.centres.items() if name.startswith("planet")]
    assert len(planets) == 3
    assert sum(planets) == pytest.approx(0.0, abs=1e-9)
    gearbox = layout(TrainFile.named("nrel_5mw").case().train)
    assert len({one.mesh for one in gearbox.gears}) == 13
    assert abs(gearbox.centres["carrier_2"]) < 1e-12  # on the axis of the first sun
    assert abs(gearbox.centres["pinion"]) == pytest.approx(0.861, rel=1e-9)
