"""Reduction of a recording to the dataset of a point, against a motion known in closed form."""

import math

import numpy as np
import pytest

from gearlube.studies.sweep.recording import revolutions_to_record
from gearlube.studies.sweep.scalars import separation_class
from gearlube.studies.sweep.settings import SweepSettings, quick_sweep_settings
from gearlube_core.errors import ParameterError
from tests.helpers.each import each
from tests.helpers.sweep_stand_in import (
    CAGE_ORDER,
    INPUT_POWER,
    LOSS_POWERS,
    MEAN_DTE,
    MESH_DTE,
    SECOND_DTE,
    TEETH,
    pinion_speed_at,
    point,
    recorded,
)

SETTINGS = SweepSettings(settling_time=0.05)


@pytest.fixture(scope="module")
def dataset():
    return point(None, 60.0, 2500.0, SETTINGS)


def test_communication_step_divides_the_mesh_period_and_is_at_least_10_khz():
    for speed_kmh in (20.0, 37.0, 100.0):
        recording = recorded(speed_kmh, quick_sweep_settings(SETTINGS))
        period = 2.0 * math.pi / (TEETH * pinion_speed_at(speed_kmh))
        ratio = period / recording.step
        assert ratio == pytest.approx(round(ratio), abs=1e-9)  # rounding of one division
        assert recording.step <= 1e-4


def test_record_holds_whole_pinion_revolutions_and_nearly_whole_cage_turns():
    speed = pinion_speed_at(20.0)
    revolutions = revolutions_to_record(SETTINGS, speed, CAGE_ORDER)
    assert revolutions * 2.0 * math.pi / speed >= SETTINGS.record_time
    assert revolutions * CAGE_ORDER >= SETTINGS.cage_turns
    assert revolutions * CAGE_ORDER == pytest.approx(round(revolutions * CAGE_ORDER), abs=1e-9)


def test_spectrum_of_the_transmission_error_has_the_two_mesh_orders_only(dataset):
    order, amplitude = dataset["order"].values, dataset["dte_spectrum"].values
    # 34 communication steps a mesh period, 17 for the second order: spline error 1/16^4 = 2e-5.
    first = amplitude[np.argmin(abs(order - TEETH))]
    second = amplitude[np.argmin(abs(order - 2 * TEETH))]
    assert first == pytest.approx(MESH_DTE, rel=1e-4)
    assert second == pytest.approx(SECOND_DTE, rel=1e-4)
    assert amplitude[0] == pytest.approx(MEAN_DTE, rel=1e-9)
    rest = np.delete(amplitude, [0, np.argmin(abs(order - TEETH)), np.argmin(abs(order - 26))])
    assert rest.max() < 1e-4 * MESH_DTE


def test_frequency_axis_puts_the_mesh_order_at_the_mesh_frequency(dataset):
    frequency = dataset["frequency"].values[np.argmin(abs(dataset["order"].values - TEETH))]
    expected = TEETH * pinion_speed_at(60.0) / (2.0 * math.pi)
    assert frequency == pytest.approx(expected, rel=1e-9)  # constant speed: rounding
    assert float(dataset["mesh_frequency"]) == pytest.approx(expected, rel=1e-9)


def test_roller_load_spectrum_has_its_line_at_the_cage_order(dataset):
    order, amplitude = dataset["order"].values, dataset["roller_load_spectrum"].values
    line = 1 + np.argmax(amplitude[1:])
    assert order[line] == pytest.approx(CAGE_ORDER, abs=1e-9)
    assert amplitude[line] == pytest.approx(100.0, rel=1e-6)  # 250 samples a cycle


def test_extremes_of_the_transmission_error_are_those_of_the_sum_of_cosines(dataset):
    phase = np.linspace(0.0, 2.0 * math.pi, 20001)
    exact = MEAN_DTE + MESH_DTE * np.cos(phase) + SECOND_DTE * np.cos(2.0 * phase + 0.3)
    # 34 * 4 points a cycle miss the crest by at most 1 - cos(pi/136) = 3e-4 of the amplitude.
    assert float(dataset["dte_max"]) == pytest.approx(exact.max(), abs=1e-9)
    assert float(dataset["dte_min"]) == pytest.approx(exact.min(), abs=1e-9)
    assert float(dataset["dte_pp"]) == pytest.approx(exact.max() - exact.min(), abs=2e-9)


def test_losses_are_the_slopes_of_the_cumulative_energies(dataset):
    for name, power in LOSS_POWERS.items():
        # Differences of energies of 500 J: rounding.
        assert float(dataset["loss"].sel(source=name)) == pytest.approx(power, rel=1e-9)
    friction = LOSS_POWERS["friction_viscous"] + LOSS_POWERS["friction_boundary"]
    assert float(dataset["efficiency_mesh"]) == pytest.approx(1.0 - friction / INPUT_POWER)
    total = sum(LOSS_POWERS.values())
    assert float(dataset["efficiency_axle"]) == pytest.approx(1.0 - total / INPUT_POWER)
    assert abs(float(dataset["energy_closure_error"])) < 1e-9


def test_mean_passage_of_a_tooth_pair_keeps_the_film_in_phase_with_the_pinion_angle(dataset):
    film = dataset["flank_film_thickness"].sel(flank=1).values
    phase = dataset["mesh_phase"].values
    # Linear interpolation between 102 samples a period: (2 pi/102)^2/8 = 0.05 % of the wave.
    np.testing.assert_allclose(
        film,
        0.5e-6 * (1.1 + 0.1 * np.cos(2.0 * np.pi * phase / 3.0)),
        rtol=0,
        atol=0.5e-6 * 0.1 * 0.001,
    )


def test_roller_zone_follows_the_cage_angle(dataset):
    angle = dataset["cage_angle"].values
    # Sectors of 3 degrees: the mean over one differs from its centre by less than 0.03 * 100 N.
    np.testing.assert_allclose(
        dataset["roller_zone_mean"].values, 500.0 + 100.0 * np.cos(angle), rtol=0, atol=3.0
    )


def test_vehicle_speed_is_that_of_the_driver(dataset):
    assert float(dataset["vehicle_speed"]) == pytest.approx(16.7, rel=1e-12)  # rounding


def test_every_variable_carries_a_unit(dataset):
    without = [
        name
        for name in dataset.data_vars
        if "units" not in dataset[name].attrs or "long_name" not in dataset[name].attrs
    ]
    assert not without


@each(
    ("low", "high", "expected"),
    [
        (1e-6, 5e-6, 0),
        (-1e-6, 5e-6, 1),
        (-149e-6, 5e-6, 1),
        (-150e-6, 5e-6, 2),
        (-160e-6, 0.0, 2),
        (-160e-6, -151e-6, 0),
        (-100e-6, -50e-6, 1),
    ],
)
def test_contact_loss_is_classed_by_the_flanks_that_are_hit(low, high, expected):
    assert separation_class(low, high, 150e-6) == expected


def test_settings_that_differ_in_anything_have_different_keys():
    base = {"speed_kmh": 20.0, "preload": 2500.0, "fmu_guid": "a", "version": "1"}
    key = SETTINGS.key(**base)
    assert key == SweepSettings(settling_time=0.05).key(**base)
    others = [
        SETTINGS.key(**{**base, "speed_kmh": 21.0}),
        SETTINGS.key(**{**base, "preload": 6000.0}),
        SETTINGS.key(**{**base, "fmu_guid": "b"}),
        SETTINGS.key(**{**base, "version": "2"}),
        quick_sweep_settings(SETTINGS).key(**base),
    ]
    assert len({key, *others}) == 6


def test_a_sweep_takes_the_roughness_and_backlash_that_its_axle_takes():
    taken = SweepSettings(roughness_rms=2e-5, backlash=0.0)
    assert (taken.roughness_rms, taken.backlash) == (2e-5, 0.0)
    for beyond in ({"roughness_rms": 2.1e-5}, {"backlash": -1e-9}, {"backlash": 2.1e-3}):
        with pytest.raises(ParameterError, match=f"{next(iter(beyond))} must be within"):
            SweepSettings(**beyond)
