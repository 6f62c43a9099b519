"""Order spectra against signals whose spectrum is known in closed form."""

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.spectra import (
    angle_window,
    extremes,
    order_spectrum,
    resample,
    whole_revolutions,
)
from tests.helpers.each import each


def amplitude_at(spectrum, order):
    """Amplitude of the bin nearest to an order."""
    return spectrum.amplitude[np.argmin(np.abs(spectrum.order - order))]


def drifting_record(seconds=0.7, rate=20000.0, speed=120.0, drift=6.0, ripple=0.4):
    """Time and exact angle of a shaft that accelerates and oscillates slightly."""
    time = np.arange(int(seconds * rate)) / rate
    phase = 2.0 * math.pi * 30.0 * time
    angle = speed * time + 0.5 * drift * time**2 + ripple / 188.5 * np.sin(phase)
    return time, angle


def test_pure_orders_are_recovered_although_the_speed_drifts():
    time, angle = drifting_record()
    orders = {0.4: 2.0, 1.0: 0.7, 13.0: 3.0, 26.0: 0.5}
    signal = 5.0 + sum(a * np.cos(q * angle + q) for q, a in orders.items())
    window = angle_window(time, angle, revolutions=10, samples_per_revolution=256)
    spectrum = order_spectrum(resample(angle, signal, window), window)
    # Order 26 has 20000 / (26 * 124 / 2 pi) = 39 samples per cycle; the spline error 1/38^4 is
    # 5e-7 of its amplitude 0.5, the others are resolved better.
    for order, amplitude in orders.items():
        assert amplitude_at(spectrum, order) == pytest.approx(amplitude, abs=1e-6)
    assert spectrum.amplitude[0] == pytest.approx(5.0, abs=1e-6)
    others = np.ones(spectrum.order.size, dtype=bool)
    others[[0, *(round(10 * q) for q in orders)]] = False
    assert np.max(spectrum.amplitude[others]) < 1e-6


def test_equal_time_samples_would_smear_the_mesh_order_that_equal_angles_keep():
    time, angle = drifting_record()
    signal = np.cos(26.0 * angle)
    window = angle_window(time, angle, revolutions=10, samples_per_revolution=256)
    start = np.searchsorted(angle, window.start)
    direct = np.abs(np.fft.rfft(signal[start:])) * 2.0 / signal[start:].size
    locked = order_spectrum(resample(angle, signal, window), window)
    assert np.max(direct) < 0.6  # the line has spread over the bins that the speed swept
    assert amplitude_at(locked, 26.0) == pytest.approx(1.0, abs=1e-6)  # spline error, see above


def test_parseval_mean_square_equals_the_sum_over_the_spectrum():
    rng = np.random.default_rng(7)
    time, angle = drifting_record(drift=0.0, ripple=0.0)
    for samples_per_revolution, revolutions in ((64, 5), (63, 5)):  # even and odd window sizes
        window = angle_window(
            time, angle, revolutions=revolutions, samples_per_revolution=samples_per_revolution
        )
        samples = rng.normal(size=window.size)
        amplitude = order_spectrum(samples, window).amplitude
        power = amplitude**2 / 2.0
        power[0] = amplitude[0] ** 2
        if window.size % 2 == 0:
            power[-1] = amplitude[-1] ** 2
        # An identity: only the rounding of 320 additions remains.
        assert np.sum(power) == pytest.approx(np.mean(samples**2), rel=1e-12)


def test_frequency_of_an_order_is_the_order_times_the_mean_rotation_rate():
    time, angle = drifting_record(drift=0.0, ripple=0.0)
    window = angle_window(time, angle, revolutions=5, samples_per_revolution=128)
    spectrum = order_spectrum(np.ones(window.size), window)
    # 120 rad/s exactly; the window start lies on a straight line, so only rounding is left.
    assert spectrum.mean_speed == pytest.approx(120.0, rel=1e-12)
    assert spectrum.frequency[5 * 13] == pytest.approx(13 * 120.0 / (2.0 * math.pi), rel=1e-12)
    assert window.duration == pytest.approx(5 * 2.0 * math.pi / 120.0, rel=1e-12)


def test_channels_are_transformed_independently():
    time, angle = drifting_record()
    window = angle_window(time, angle, revolutions=4, samples_per_revolution=128)
    both = np.stack([np.cos(3.0 * angle), 2.0 * np.cos(7.0 * angle)], axis=1)
    spectrum = order_spectrum(resample(angle, both, window), window)
    single = order_spectrum(resample(angle, both[:, 1], window), window)
    # The same arithmetic on another memory layout: rounding only.
    np.testing.assert_allclose(spectrum.amplitude[:, 1], single.amplitude, rtol=0, atol=1e-14)


def test_five_revolutions_hold_two_turns_of_a_cage_at_two_fifths_of_shaft_speed():
    assert whole_revolutions([0.4], 3) == 5
    assert whole_revolutions([0.4], 11) == 15
    assert whole_revolutions([0.3987, 13.0], 11) == 15
    assert whole_revolutions([1.0], 4) == 4


def test_extremes_between_samples_come_within_the_crest_of_a_coarsely_sampled_sine():
    index = np.arange(400)
    signal = 3.0 + np.sin(2.0 * math.pi * index / 5.3 + 0.1)
    refined = extremes(signal, refine=8)
    # 42 points per cycle after refinement: 1 - cos(pi/42) = 0.3 %, plus the spline error
    # 1/(5.3 - 1)^4 = 0.3 %.
    assert refined.maximum == pytest.approx(4.0, abs=6e-3)
    assert refined.minimum == pytest.approx(2.0, abs=6e-3)
    assert refined.peak_to_peak == pytest.approx(2.0, abs=12e-3)


@each("sign", [1.0, -1.0])
@each(("first", "counts"), [(5, False), (6, True), (12, True), (13, False)])
def test_extremes_between_samples_count_from_the_seventh_to_the_last_but_six(sign, first, counts):
    """The cubic spline through two equal samples among zeros, midway between them.

    Cardinal spline: sqrt(3) sum z^|k| B(x - k), z = sqrt(3) - 2, B(1/2) = 23/48, B(3/2) = 1/48.
    """
    signal = np.zeros(20)
    signal[[first, first + 1]] = sign
    found = extremes(signal, refine=2)
    crest = found.maximum if sign > 0.0 else -found.minimum
    if counts:
        z = math.sqrt(3.0) - 2.0
        exact = 2.0 * math.sqrt(3.0) * (1.0 + z) * (23.0 + z) / 48.0
        assert crest == pytest.approx(exact, rel=z**6)  # the ends are six samples away
    else:
        assert crest == 1.0
    assert found.mean == pytest.approx(0.1 * sign, rel=1e-14)
    plain = extremes(signal)
    assert (plain.minimum, plain.maximum) == (min(sign, 0.0), max(sign, 0.0))


def test_a_window_longer_than_the_record_is_refused_with_the_cure():
    time, angle = drifting_record(seconds=0.1)
    with pytest.raises(ParameterError, match=r"at most 1\.9.* got 3 rev\. Record for longer"):
        angle_window(time, angle, revolutions=3, samples_per_revolution=64)


def test_a_shaft_that_turns_back_is_refused():
    time = np.linspace(0.0, 1.0, 200)
    with pytest.raises(ParameterError, match="turns back"):
        angle_window(time, np.sin(4.0 * time), revolutions=1, samples_per_revolution=64)


def test_samples_of_another_window_are_refused():
    time, angle = drifting_record()
    window = angle_window(time, angle, revolutions=4, samples_per_revolution=64)
    with pytest.raises(ParameterError, match="256 rows"):
        order_spectrum(np.ones(255), window)
