"""A map on the grid of heavy-duty axle tests, read back by the rules of VECTO."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

import gearlube as gl
from gearlube.command import COMMANDS, command_line
from gearlube.studies.loss_map.exports import write_regulation_map
from gearlube.studies.loss_map.regulation import regulation_map, wheel_torques
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.uncertain import UNCERTAIN
from gearlube_core.errors import ParameterError
from tests.helpers.vecto_rules import VectoMap

AXLE = replace(mohammadpour_2015_axle(), pinion_seal_torque=0.15, wheel_seal_torque=0.3)
RATIO = AXLE.mesh.ratio
WARM = gl.celsius_to_kelvin(70.0)
DRAG = replace(next(one for one in UNCERTAIN if one.name == "bearing_drag"), factor=8.0)
SETTINGS = gl.LossMapSettings(
    axle=AXLE,
    torques=np.array([-150.0, 0.0, 300.0]),
    speeds=gl.rpm_to_rads(np.array([100.0, 160.0 * RATIO])),
    draws=50,
    uncertain=(DRAG,),
)


def direct(torque, wheel_rpm):
    speed = wheel_rpm * np.pi / 30.0 * RATIO
    found = axle_losses(
        AXLE,
        torques=np.array([torque]),
        speeds=np.array([speed]),
        temperatures=np.array([WARM]),
        extremes=False,
    )
    return found.power[0, 0, 0] / speed


@pytest.fixture(scope="module")
def found():
    return regulation_map(SETTINGS)


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return write_regulation_map(SETTINGS, tmp_path_factory.mktemp("regulation"))


def test_the_grid_has_the_steps_of_the_generic_map():
    """50 rpm; 250 N.m to 1000, 500 to 2000, 1000 to 10000, 2000 beyond, as VECTO's generic axle."""
    steps = np.diff(wheel_torques(15_000.0))
    ends = [int((steps == step).sum()) for step in (250.0, 500.0, 1000.0, 2000.0)]
    assert ends == [4, 2, 8, 2]
    assert wheel_torques(15_000.0)[-1] == 14_000.0


def test_the_points_are_round_at_the_wheels_within_the_ends_of_the_settings(found):
    assert np.unique(found.wheel_speed).tolist() == [0.0, 50.0, 100.0, 150.0]
    # -150 and 300 N.m at the pinion, times 2.77, less losses when driving
    assert np.unique(found.wheel_torque).tolist() == [-250.0, 0.0, 250.0, 500.0, 750.0]
    assert found.torque.max() < 300.0
    assert (found.torque - found.loss) * RATIO == pytest.approx(found.wheel_torque, abs=1e-6)


def test_each_point_loses_what_the_axle_loses_at_its_pinion_torque(found):
    for i in np.flatnonzero(found.wheel_speed > 0.0)[::2]:
        expected = direct(found.torque[i], found.wheel_speed[i]).sum()
        assert found.loss[i] == pytest.approx(expected, rel=1e-7)  # the iteration's end
    rest, slow = (found.loss[found.wheel_speed == rpm] for rpm in (0.0, 50.0))
    assert rest.tolist() == slow.tolist()


def test_vecto_reads_every_point_back(found, path):
    read = VectoMap(path, RATIO)
    for rpm, torque, loss in zip(found.wheel_speed, found.wheel_torque, found.loss, strict=True):
        # four decimals of torque and loss: the ends of the map are those far off a straight line
        inward = torque - np.sign(torque) * 1e-3
        rpm = min(max(rpm, 1e-2), 150.0 - 1e-2)
        assert read.loss(rpm, inward) == pytest.approx(loss, abs=5e-4)


def test_vecto_finds_the_loss_between_the_points(path):
    """2 %: the loss is nearly linear over a cell of 50 rpm and 250 N.m that has no kink."""
    read = VectoMap(path, RATIO)
    for rpm, torque in ((75.0, 375.0), (120.0, 600.0), (60.0, 125.0), (130.0, -125.0)):
        pinion = torque / RATIO
        for _ in range(20):
            pinion = torque / RATIO + direct(pinion, rpm).sum()
        assert read.loss(rpm, torque) == pytest.approx(direct(pinion, rpm).sum(), rel=0.02)


def test_vecto_extends_the_map_by_a_loss_that_rises_with_torque(found, path):
    plain, extended = VectoMap(path, RATIO), VectoMap(path, RATIO, extended=True)
    assert np.isnan(plain.loss(100.0, 1200.0))
    assert all(slope > 0.0 for slope, _ in extended.lines.values())
    # a point of the extension: twice the largest pinion torque, and its negative
    slope, base = extended.lines[min(extended.lines, key=lambda rpm: abs(rpm - 100.0 * RATIO))]
    torque = 2.0 * found.torque.max()
    loss = slope * torque + base
    for sign in (1.0, -1.0):
        wheel = (sign * torque - loss) * RATIO
        assert extended.loss(100.0, wheel) == pytest.approx(loss, abs=1e-3)
    # the axle itself at 500 N.m: beyond the map the loss bends by less than 1 % off the line
    pinion = torque * 0.8
    wheel = (pinion - direct(pinion, 100.0).sum()) * RATIO
    assert extended.loss(100.0, wheel) == pytest.approx(direct(pinion, 100.0).sum(), rel=0.01)


def test_the_raise_is_the_uncertainty_beyond_what_is_free(found):
    """Drag alone is uncertain: its factor in the draws is known in closed form."""
    raised = regulation_map(SETTINGS, raised=True)
    assert raised.wheel_torque.tolist() == found.wheel_torque.tolist()
    normals = np.random.default_rng(SETTINGS.seed).standard_normal((50, 1))
    highest = np.percentile(np.exp(0.5 * normals * np.log(DRAG.factor)), 97.5)
    seen = []
    for i in np.flatnonzero(found.wheel_speed == 150.0):
        drag = direct(found.torque[i], 150.0)[LOSS_SOURCES.index("bearing_torque")]
        free = max(0.05 * found.loss[i], 1.0)
        seen.append(max(0.0, (highest - 1.0) * drag - free))
        # flanks at 8 angles in place of 32: 4e-4 of the loss
        assert raised.loss[i] - found.loss[i] == pytest.approx(seen[-1], abs=4e-4 * found.loss[i])
    assert max(seen) > 0.1
    assert (raised.torque - raised.loss) * RATIO == pytest.approx(raised.wheel_torque, abs=1e-6)


def test_a_known_loss_is_not_raised(found):
    known = replace(SETTINGS, uncertain=(replace(DRAG, factor=1.02),))
    assert regulation_map(known, raised=True).loss.tolist() == found.loss.tolist()


@pytest.mark.parametrize(
    ("changed", "raised", "words"),
    [
        (
            {"draws": 0},
            True,
            "draws must be at least 20 if the loss is raised by its error bar, got 0",
        ),
        ({"speeds": np.array([5.0])}, False, "wheel speed of 50 rpm.*got pinion speeds up to 47"),
        ({"torques": np.array([1.0, 50.0])}, False, "torque of 250 N.m, got.* 1 to 50 N.m"),
    ],
)
def test_settings_without_a_grid_are_refused(changed, raised, words):
    with pytest.raises(ParameterError, match=words):
        regulation_map(replace(SETTINGS, **changed), raised=raised)


@pytest.mark.slow
def test_the_command_writes_what_was_asked_for(tmp_path):
    words = ["map", "--torques", "-100", "0", "100", "--speeds", "100", "300"]
    words += ["--temperatures", "60", "--draws", "20", "--out", str(tmp_path / "out")]
    ended = CliRunner().invoke(command_line(COMMANDS), [*words, "--regulation-raised"])
    assert ended.exit_code == 0, ended.output
    [path] = (tmp_path / "out").glob("vecto_regulation*")
    assert path.name == "vecto_regulation_raised_70degC.vtlm"
    assert VectoMap(path, RATIO).loss(75.0, 125.0) > 0.0
