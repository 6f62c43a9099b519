"""Motion under the films of a hypoid tooth pair: samples of the running axle, and at rest."""

import numpy as np
import pytest

from gearlube.studies.films import run_hypoid
from gearlube.studies.films.hypoid import flank
from tests.helpers.known_answers import named

SPEED, TORQUE, TEETH, RATIO = 300.0, 50.0, 13, 3.0
WINDOW = 3.0 * 2.0 * np.pi / TEETH  # three mesh periods


class Axle:
    """A pinion of 0.01 kg m2 that runs 5 % too fast; load, film and friction tell its angle."""

    made = None

    def __init__(self, parameters):
        self.outputs = np.zeros(64)
        self.steps, self.times = [], 0.0
        Axle.made = self

    def initialise(self, *, pinion_speed, pinion_torque, wheel_torque, oil_temperature):
        assert (pinion_torque, wheel_torque, oil_temperature) == (TORQUE, RATIO * TORQUE, 353.0)
        self.angle, self.speed = 0.0, 1.05 * pinion_speed
        self.write()

    def step(self, h, torque, wheel_torque, oil_temperature):
        assert torque == TORQUE
        self.speed += h * (torque - wheel_torque / RATIO) / 0.01
        self.angle += h * self.speed
        self.times += h
        self.steps.append(h)
        self.write()

    def write(self):
        turned = self.angle % WINDOW
        places = (flank._PHI, flank._SPEED, flank._LOAD, flank._FILM, flank._MU)
        values = (self.angle, self.speed, 1.0 + turned, 2.0 + turned, 3.0 + turned)
        self.outputs[list(places)] = values


def test_samples_of_the_running_axle_are_those_of_one_window(monkeypatch):
    monkeypatch.setattr(flank, "HypoidAxle", Axle)
    parameters = named(mesh=named(ratio=RATIO, pinion_teeth=TEETH))
    drive = flank.dynamic_drive(parameters, SPEED, TORQUE, 353.0)
    h = 2.0 * np.pi / (TEETH * SPEED * 128)  # 128 steps a mesh period
    assert set(Axle.made.steps) == {h}
    # 0.8 s to settle, then at most two windows
    assert 0.8 < Axle.made.times < 0.8 + 2.1 * WINDOW / SPEED
    # the excess dies as exp(-10 t), with what the reset adds: below 1e-3 of it after 0.8 s
    assert drive.speed == pytest.approx(SPEED, rel=1e-4)
    assert drive.time == pytest.approx(h * np.arange(3 * 128), rel=1e-12)
    # the window begins within a step of its first sample
    assert 0.0 <= drive.angle[0] < 1.01 * h * SPEED
    assert np.diff(drive.angle) == pytest.approx(h * SPEED, rel=1e-4)
    for offset, values in ((1.0, drive.load), (2.0, drive.axle_film), (3.0, drive.axle_friction)):
        assert values == pytest.approx(offset + drive.angle, rel=1e-9)


def test_a_pair_at_constant_speed_has_its_share_of_the_mesh_force(monkeypatch):
    share = np.linspace(0.0, 1.0, 3 * 128)
    monkeypatch.setattr(flank, "phase_of", lambda mesh, angle: angle)
    monkeypatch.setattr(flank, "pair_contact", lambda mesh, torque, phase: named(share=share))
    parameters = named(mesh=named(pinion_teeth=TEETH, mean=lambda name, torque: 0.02))
    drive = flank.static_drive(parameters, SPEED, -TORQUE)
    assert drive.load == pytest.approx(TORQUE / 0.02 * share)
    assert drive.angle == pytest.approx(WINDOW * np.arange(384) / 384)
    assert drive.time == pytest.approx(drive.angle / SPEED)
    assert (drive.speed == SPEED).all()
    assert np.isnan([drive.axle_film, drive.axle_friction]).all()


@pytest.mark.parametrize(
    ("load", "film", "warned"),
    [("dynamic", [1.0, np.nan], True), ("dynamic", [1.0, 2.0], False), ("static", [np.nan], False)],
)
def test_samples_without_a_film_are_a_warning_where_the_axle_runs(caplog, load, film, warned):
    run_hypoid._warn_of_separation(
        named(case=named(load=load), drive=named(axle_film=np.array(film)))
    )
    assert ("gives no film at some samples" in caplog.text) == warned


def test_the_loaded_span_is_that_around_the_largest_load():
    load = np.array([5.0, 0.1, *np.linspace(1.0, 9.0, 9), 0.5, 6.0])
    case = named(smallest_load=0.1, first_phase=0.0, last_phase=20.0)
    phase = np.arange(13.0)
    assert flank.loaded_span(case, phase, load) == slice(2, 11)
    case.first_phase, case.last_phase = 3.0, 10.0
    assert flank.loaded_span(case, phase, load) == slice(3, 11)
