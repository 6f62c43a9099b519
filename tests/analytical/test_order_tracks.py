"""Order tracks and waterfalls of signals whose answer is known."""

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.spectra import order_blocks, samples_for, waterfall

RATE = 16384.0  # Hz


def ramp(start: float, end: float, duration: float) -> tuple[np.ndarray, np.ndarray]:
    """Times and angles of a shaft whose speed [rad/s] changes linearly."""
    time = np.arange(round(duration * RATE)) / RATE
    return time, start * time + 0.5 * (end - start) / duration * time**2


def test_order_tracks_recover_the_amplitudes_and_phases_of_a_synthetic_run_up() -> None:
    time, angle = ramp(60.0, 200.0, 10.0)
    growing = 2.0 + 0.3 * time
    signal = growing * np.cos(13 * angle + 0.7) + 0.5 * np.cos(26 * angle - 1.2) + 40.0
    signal += 0.8 * np.cos(14.5 * angle)  # six bins of 0.25 beside the first
    found = order_blocks(
        time, angle, signal, revolutions=4, samples_per_revolution=512, highest_order=40.0
    )
    first, second = found.amplitude[:, 13 * 4], found.amplitude[:, 26 * 4]
    # the amplitude's own growth within a block and the spline's error stay below 1e-3
    assert np.abs(first) == pytest.approx(2.0 + 0.3 * found.time, rel=1e-3)
    assert np.angle(first) == pytest.approx(0.7, abs=2e-3)
    assert np.abs(second) == pytest.approx(0.5, rel=2e-3)
    assert np.angle(second) == pytest.approx(-1.2, abs=5e-3)
    assert found.speed == pytest.approx(60.0 + 14.0 * found.time, rel=2e-3)
    # the overall level has all three lines, and not the mean
    expected = np.sqrt(0.5 * ((2.0 + 0.3 * found.time) ** 2 + 0.5**2 + 0.8**2))
    assert found.rms == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("duration", [12.0, 36.0])
def test_a_slow_ramp_of_an_oscillator_gives_its_steady_response(duration: float) -> None:
    """x'' + 2 z w0 x' + w0^2 x = w0^2 cos(angle of 13 per turn), through its resonance."""
    natural, damping, order = 2.0 * math.pi * 200.0, 0.03, 13
    time, angle = ramp(60.0, 140.0, duration)
    # exact for a force that is linear between samples
    from scipy.signal import cont2discrete, lfilter

    system = [natural**2], [1.0, 2.0 * damping * natural, natural**2]
    above, below, _ = cont2discrete(system, 1.0 / RATE, method="foh")
    motion = lfilter(np.ravel(above), below, np.cos(order * angle))
    found = order_blocks(
        time, angle, motion, revolutions=4, samples_per_revolution=512, highest_order=20.0
    )
    ratio = order * found.speed / natural
    steady = 1.0 / np.hypot(1.0 - ratio**2, 2.0 * damping * ratio)
    level = np.abs(found.amplitude[:, order * 4])
    # At resonance the motion lags by 1/(z w0) behind the sweep of r [Hz/s], so its axis is
    # shifted by r/(z w0). The steepest flank, at half power, falls by 1/(2 z f0) a Hz: 3.1 % in
    # 12 s, 1.0 % in 36 s. Half as much again for what is not linear.
    rate = order * 80.0 / duration / (2.0 * math.pi)
    tolerance = 1.5 * rate / (damping * natural) * math.pi / (damping * natural)
    settled = found.time > 0.5
    assert level[settled] == pytest.approx(steady[settled], rel=tolerance)
    assert level.max() == pytest.approx(steady.max(), rel=0.3 * tolerance)


def test_a_waterfall_has_the_amplitude_of_a_steady_tone_on_a_bin() -> None:
    time = np.arange(round(2.0 * RATE)) / RATE
    found = waterfall(
        3.0 + 0.25 * np.sin(2.0 * math.pi * 440.0 * time),
        RATE,
        resolution=8.0,
        highest_frequency=1000.0,
    )
    assert found.frequency[[0, -1]].tolist() == [0.0, 1000.0]
    assert found.amplitude[:, 55] == pytest.approx(0.25, rel=1e-6)
    # neighbours of a Hann window: half; all others nothing
    assert found.amplitude[:, 54] == pytest.approx(0.125, rel=1e-6)
    assert found.amplitude[:, 60:].max() < 1e-9
    assert np.all((found.time > 0.06) & (found.time < 1.94))


def test_samples_hold_the_highest_frequency_at_the_slowest_speed() -> None:
    # 2.56 * 4000 Hz at 50 rad/s = 7.96 rev/s: 1287, the next power of two
    assert samples_for(4000.0, 50.0) == 2048


def test_a_shaft_that_turns_back_is_refused() -> None:
    time, angle = ramp(60.0, 80.0, 1.0)
    angle[100] = angle[99]
    with pytest.raises(ParameterError, match="stops or turns back"):
        order_blocks(
            time, angle, angle, revolutions=4, samples_per_revolution=64, highest_order=8.0
        )
    time, angle = ramp(60.0, 80.0, 1.0)
    with pytest.raises(ParameterError, match="hold a block of 40 rev, got 11 whole rev"):
        order_blocks(
            time, angle, angle, revolutions=40, samples_per_revolution=64, highest_order=8.0
        )


def test_an_order_between_bins_is_read_with_its_amplitude_and_phase():
    time = np.arange(40_000) / 20_000.0
    angle = 2.0 * math.pi * (10.0 * time + 2.0 * time**2)
    signal = 3.0 * np.cos(9.3226 * angle + 0.4)
    found = order_blocks(
        time, angle, signal, revolutions=4, samples_per_revolution=512, highest_order=20.0,
        orders=np.array([9.3226]),
    )  # fmt: skip
    # leakage of the image at -9.3 orders through a Hann window, 75 bins away
    np.testing.assert_allclose(found.amplitude[:, 0], 3.0 * np.exp(0.4j), rtol=1e-4)
