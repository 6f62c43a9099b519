"""Sound pressure from forces of known frequency through paths of known response."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.io import wavfile

from gearlube.studies.sound.dataset import fast_level
from gearlube.studies.sound.force_record import read_forces
from gearlube.studies.sound.order_tracks import order_signal, pinion_angle, track_orders
from gearlube.studies.sound.pressure import RATE, a_weighted, a_weighting, sound_pressure
from gearlube.studies.sound.transfer_path import generic_path
from gearlube.studies.sound.wav import write_wav
from gearlube_core.errors import ParameterError
from tests.helpers.each import each
from tests.helpers.made_run import made_run, one_path

TURN = 2.0 * np.pi


@each("speed", [TURN * 10.0, TURN * 40.0, TURN * 200.0])  # 130 to 2600 Hz
def test_a_force_of_one_frequency_becomes_gain_times_force(speed):
    record = read_forces(made_run({13.0: 20.0}, start=speed, end=speed))
    pressure = sound_pressure(record, one_path(2e-3))
    middle = pressure.signal[RATE // 4 : 3 * RATE // 4]
    # half a second holds whole periods; 0.01 dB is 1.2e-3
    assert np.sqrt(2.0 * np.mean(middle**2)) == pytest.approx(20.0 * 2e-3, rel=1.2e-3)


def test_a_delay_of_the_path_delays_the_sound_by_as_much():
    delay = 7.3e-3
    record = read_forces(made_run({13.0: 20.0}, start=TURN * 40.0, end=TURN * 40.0))
    pressure = sound_pressure(record, one_path(1e-3, delay))
    at = slice(RATE // 4, 3 * RATE // 4)
    expected = 0.02 * np.cos(13.0 * TURN * 40.0 * (pressure.time[at] - delay))
    # 1e-3 of a period of 1.9 ms is 2 us
    assert np.max(np.abs(pressure.signal[at] - expected)) < 0.02 * TURN * 1e-3


def test_a_pulse_is_not_heard_before_the_force():
    run = made_run({})
    force = run["bearing_force"].values
    force[8192, 0, 0] += 100.0
    pressure = sound_pressure(read_forces(run), generic_path(read_forces(run).paths))
    before = pressure.signal[: RATE // 2 - RATE // 500]
    # the upper end of the band rings symmetrically, 0.1 % of the amplitude 2 ms before
    assert np.max(np.abs(before)) < 5e-3 * np.max(np.abs(pressure.signal))
    assert pressure.early < 1e-5


def test_phases_of_the_other_sign_are_refused():
    record = read_forces(made_run({13.0: 20.0}))
    with pytest.raises(ParameterError, match="change the sign of the phases"):
        sound_pressure(record, one_path(1e-3, delay=-0.02))


def test_the_generic_path_keeps_all_phases_apart_and_has_its_plateau():
    path = generic_path([f"b.{i}" for i in range(6)])
    f = np.array([300.0])
    sizes = np.array([np.abs(path.at(name, f))[0] for name in path.responses])
    assert sizes == pytest.approx(1e-4, rel=0.02)  # (f_1/f)^4 / 2 + (f/f_2)^4 / 2 = 0.7 %
    low, high = np.array([50.0]), np.array([12000.0])
    for at, octaves in ((low, 1.0), (high, 3.0)):  # 12 dB per octave; 1 + r^4 under the root
        expected = 1e-4 / np.sqrt(1.0 + 2.0 ** (4.0 * octaves))
        assert np.abs(path.at("b.0", at))[0] == pytest.approx(expected, rel=1e-3)
    band = np.geomspace(50.0, 8000.0, 40)
    turned = np.unwrap(np.angle(path.at("b.1", band) / path.at("b.0", band)))
    assert np.degrees(turned) == pytest.approx(137.5, abs=6.0)  # the golden angle


# IEC 61672-1, table 3, at exact base-ten frequencies; rounded there to 0.1 dB
@each(("exponent", "level"), [(1.5, -39.4), (2.0, -19.1), (2.5, -6.6), (3.0, 0.0), (4.0, -2.5)])
def test_a_weighting_is_that_of_the_standard(exponent, level):
    frequency = 10.0**exponent
    assert 20.0 * np.log10(a_weighting(np.array([frequency])))[0] == pytest.approx(level, abs=0.06)
    tone = np.sqrt(2.0) * np.cos(TURN * frequency * np.arange(RATE) / RATE)
    found = fast_level(a_weighted(tone, RATE), RATE, np.array([0.9]))[0]
    assert found == pytest.approx(93.98 + level, abs=0.1)


@pytest.mark.parametrize(("rms", "rate"), [(1.0, 48000), (0.02, 48000), (0.02, 24000)])
def test_the_wav_keeps_the_level_within_a_hundredth_of_a_decibel(rms, rate, tmp_path):
    tone = rms * np.sqrt(2.0) * np.sin(TURN * 1000.0 * np.arange(RATE) / RATE)
    write_wav(tone, tmp_path / "tone.wav", full_scale=2.0, rate=rate)
    found, samples = wavfile.read(tmp_path / "tone.wav")
    back = samples * (2.0 / 32767)  # of 16 bits, full scale 2 Pa
    assert found == rate
    middle = back[rate // 4 : 3 * rate // 4]
    assert 20.0 * np.log10(np.sqrt(np.mean(middle**2)) / rms) == pytest.approx(0.0, abs=0.01)


def test_an_order_is_tracked_through_a_run_up_and_can_be_taken_out():
    # amplitudes that are constant along the run have the same level everywhere
    run = made_run({13.0: 30.0, 26.0: 3.0}, start=150.0, end=250.0, duration=3.0)
    record = read_forces(run)
    # with a delay the phase of an order turns with speed
    pressure = sound_pressure(record, one_path(1e-3, delay=3e-3))
    tracks = track_orders(record, pressure, (), revolutions=4)
    assert list(tracks.order) == [13.0, 26.0, 39.0, 52.0]
    inner = slice(3, -3)
    assert tracks.rms[inner, 0] == pytest.approx(0.03 / np.sqrt(2.0), rel=1e-2)
    assert tracks.rms[inner, 1] == pytest.approx(0.003 / np.sqrt(2.0), rel=2e-2)
    assert np.max(tracks.rms[inner, 2]) < 1e-4 * 0.03
    rest = pressure.signal - order_signal(
        tracks, 0, pinion_angle(record, pressure.time), pressure.time
    )
    at = slice(RATE // 2, -RATE // 2)
    left = np.sqrt(2.0 * np.mean(rest[at] ** 2))
    assert left == pytest.approx(0.003, rel=0.05)  # the second order alone
