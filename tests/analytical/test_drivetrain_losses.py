"""Loss map of two gears and a seal, whose losses have a closed form."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube.studies.drivetrain.losses import loss_figure, map_losses, of_map
from gearlube_core.errors import ParameterError
from tests.analytical.test_drivetrain_runup import SEAL, case
from tests.helpers.elastic_e_axle import case as elastic

SPEEDS, TORQUES = np.array([150.0, 300.0]), np.array([-20.0, 25.0, 50.0])


def test_a_seal_loses_its_torque_times_the_speed_at_all_points():
    found = map_losses(case(), speeds=SPEEDS, torques=TORQUES)
    lost = found["loss"].sel(source="seal.seals").values
    # the seal lacks 0.01 rad/s over the speed, and the speed drifts by less than 1e-3
    np.testing.assert_allclose(lost, np.outer(SEAL * SPEEDS, np.ones(3)), rtol=1e-3)
    # dampers of mesh and supports take less than 1e-4 of that at 1 % waves
    np.testing.assert_allclose(found["load_torque"], [TORQUES - SEAL] * 2, atol=2e-3 * SEAL)
    braking, driving = 1.0 - SEAL / (20.0 + SEAL), 1.0 - SEAL / TORQUES[1:]
    np.testing.assert_allclose(found["efficiency"], [[braking, *driving]] * 2, rtol=1e-4)
    best = of_map(found)[0].headline
    assert f"{100.0 * driving[-1]:.1f}" in best
    assert "50 N·m" in best


@pytest.mark.slow
def test_a_slow_train_loses_at_the_speed_that_the_map_says():
    """Its loads do not balance over a mesh cycle: it drifts, but a seal knows the speed alone."""
    speeds, torques = np.array([3.2, 18.0]) * math.pi / 30.0, np.array([-170.0, 100.0, 160.0])
    found = map_losses(TrainFile.named("e_axle").case(), speeds=speeds, torques=torques)
    lost = found["loss"].sel(source="seal.seals").values[1]
    # the seal is not quite linear: 0.2 of 7 % drift; without the mean speed 15 % are found
    np.testing.assert_allclose(lost / lost.mean(), np.ones(3), atol=0.02)
    assert all("drifts to" in one and "3.2 rpm" in one for one in found["failure"].values[0])
    assert of_map(found)[-1].headline == "3 of 6 points of the map have no equilibrium."


def test_losses_of_the_elements_add_up_to_those_of_the_train():
    axle, apart = (elastic().train.changed(losses_by_element=one) for one in (False, True))
    given = elastic()
    for train in (axle, apart):
        train.initialise(given.speeds, given.torques, given.oil_temperature)
        train.step(1e-3, given.torques, given.oil_temperature)
    for kind, lost in axle.lost.items():
        own = [v for name, v in apart.lost.items() if name.rpartition(".")[2] == kind]
        assert len(own) > 1
        assert sum(own) == pytest.approx(lost, rel=1e-12)  # rounding of sums


def test_a_stopped_map_goes_on_from_the_points_that_it_has(tmp_path: Path):
    class Stopped(Exception):  # noqa: N818
        pass

    def stop(share: float, _sentence: str) -> None:
        if share > 0.4:
            raise Stopped

    grid = {"speeds": SPEEDS, "torques": TORQUES, "folder": tmp_path}
    with pytest.raises(Stopped):
        map_losses(case(), **grid, progress=stop)
    kept = {one: one.stat().st_mtime_ns for one in (tmp_path / "parts").iterdir()}
    assert 2 <= len(kept) < 6
    found = map_losses(case(), **grid)
    assert np.isfinite(found["efficiency"]).all()
    assert all(one.stat().st_mtime_ns == time for one, time in kept.items())
    assert len(list((tmp_path / "parts").iterdir())) == 6


def test_a_point_without_equilibrium_is_told_and_torques_must_rise():
    found = map_losses(case(), speeds=SPEEDS[:1], torques=np.array([50.0, 1e7]))
    assert np.isfinite(found["efficiency"][0, 0])
    assert np.isnan(found["efficiency"][0, 1])
    assert of_map(found)[-1].headline == "1 of 2 points of the map have no equilibrium."
    with pytest.raises(ParameterError, match="torques of the map must be rising"):
        map_losses(case(), torques=TORQUES[::-1])


@pytest.mark.parametrize(
    ("speeds", "torques", "over"),
    [
        (SPEEDS, TORQUES[2:], "speed of pinion [rpm]"),
        (SPEEDS[:1], TORQUES, "torque of pinion [N·m]"),
    ],
)
def test_a_map_of_one_row_is_a_line_of_losses(speeds, torques, over):
    axes = loss_figure(map_losses(case(), speeds=speeds, torques=torques)).axes[0]
    assert axes.get_xlabel() == over
    assert axes.get_ylabel() == "power lost [W]"
    # the seal's loss, with 1e-3 for the drift of its speed and the dampers
    drawn = axes.lines[0].get_ydata()
    np.testing.assert_allclose(drawn[~np.isnan(drawn)][-1], SEAL * speeds[-1], rtol=2e-3)


def test_a_single_braking_torque_is_in_the_picture_of_a_map():
    """No area joins it to those that drive: its point shows it, at the loss of the seal."""
    left, right, *_ = loss_figure(map_losses(case(), speeds=SPEEDS, torques=TORQUES)).axes
    assert set(left.lines[0].get_ydata()) == set(TORQUES)
    torque, lost = right.lines[0].get_data()
    # 1e-3 for the drift of the speed and the dampers
    assert lost[list(torque).index(TORQUES[0])] == pytest.approx(SEAL * SPEEDS[1], rel=2e-3)
