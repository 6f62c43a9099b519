"""Findings and key numbers of a helical pair, from datasets with known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.helical.findings import (
    findings,
    largest_error,
    least_unstable,
    meeting,
)
from gearlube.studies.helical.report import numbers

RPM = np.pi / 30.0
SPEEDS, TEETH = np.array([1000.0, 2000.0, 3000.0]), 30  # rpm; mesh at 500, 1000, 1500 Hz


def sweep(natural=(4000.0,), film=True, margin=0.5, runs_at=2000.0):
    """Order 2 is largest at 2000 rpm, 2 kHz: 1.5 um with the film and 0.7 um at mu 0.1."""
    amplitude = np.full((3, 3), 0.1e-6)
    amplitude[1, 1] = 1.5e-6
    constant = np.full((2, 3, 3), 0.2e-6)
    constant[1, 2, 0] = 0.7e-6
    constant[0, 0, 0] = 9e-6  # at mu 0, not shown
    data = {
        "delta_z_harmonic": (("mu", "speed", "harmonic"), constant),
        "mesh_frequency": ("speed", SPEEDS / 60.0 * TEETH),
        "natural_frequency": ("mode", np.array(natural)),
        "stability_margin": (("mu", "speed"), np.full((2, 3), margin)),
    }
    if film:
        data["film_delta_z_harmonic"] = (("speed", "harmonic"), amplitude)
    return xr.Dataset(
        data,
        coords={"mu": [0.0, 0.1], "speed": SPEEDS * RPM, "harmonic": [1, 2, 3]},
        attrs={"pinion_speed": runs_at * RPM},
    )


def response(natural):
    """Order 2 is largest with the film, the last case: 0.3 um; order 1 at mu 0.1: 0.9 um."""
    return xr.Dataset(
        {
            "natural_frequency": ("mode", np.array(natural)),
            "delta_z_harmonic": (
                ("case", "harmonic"),
                np.array([[0.9e-6, 0.2e-6, 0.0], [0.1e-6, 0.3e-6, 0.2e-6]]),
            ),
        },
        coords={"case": ["0.1", "film"], "harmonic": [1, 2, 3]},
        attrs={"mesh_frequency": 500.0, "pinion_speed": 1000.0 * RPM},
    )


def separation(share, runs_at=5000.0):
    return xr.Dataset(
        {
            "separation_share": (("damping", "row"), np.array([[0.0, share, 0.0]])),
            "speed": (("damping", "row"), np.array([[4000.0, 5000.0, 6000.0]]) * RPM),
            "special_kind": (("damping", "special"), np.array([["fold", "fold", ""]])),
        },
        coords={"damping": [0.05]},
        attrs={"mesh_damping_ratio": 0.05, "pinion_speed": runs_at * RPM},
    )


def contact(pressure):
    peaks = np.array([[[1.0e9]], [[1.2e9]]]) * np.ones((2, 2, 1))
    peaks[0, 1, 0] = pressure
    return xr.Dataset(
        {
            "pressure_max": (("phase", "torque", "line"), peaks),
            "K": (("phase", "torque"), np.array([[1.0, 4e8], [1.0, 6e8]])),
            "transmission_error_ptp": ("torque", np.array([9.0, 0.4e-6])),
        },
        coords={"torque": [10.0, 200.0]},
        attrs={"pinion_torque": 200.0},
    )


def stability(unstable_from):
    factor = np.array([0.0, 1.0, 2.0, 3.0])
    growth = np.where(factor[:, None] >= unstable_from, [1.0, -1.0], -1.0)
    return xr.Dataset(
        {"growth_variation": (("variation", "mesh_frequency"), growth)},
        coords={"variation": factor, "mesh_frequency": [1e3, 2e3]},
    )


def film(ratio, rise=20.0):
    return xr.Dataset(
        {
            "film_ratio": ("point", np.array([4.0, ratio, 0.1])),
            "line_load": ("point", np.array([1.0, 1.0, 0.0])),  # the last carries nothing
            "temperature_rise": ("point", np.array([rise, 20.0, 0.0])),
        },
        attrs={
            "operating_mean_coefficient": 0.04,
            "operating_power_loss": 150.0,
            "roughness_rms": 5e-7,
            "oil_temperature": 353.15,
            "oil_data_high_degc": 150.0,
        },
    )


def losses(rise):
    """Two torques and speeds in oil of 90 degC; the film of one point is warmer."""
    grid = ("temperature", "torque", "speed")
    return xr.Dataset(
        {
            "loss": ((*grid, "part"), np.ones((1, 2, 2, 2))),
            "temperature_rise": (grid, np.array([[[5.0, 8.0], [7.0, rise]]])),
        },
        coords={"temperature": [90.0], "torque": [50.0, 200.0], "speed": [1000.0, 9000.0],
                "part": ["sliding", "rolling"]},
        attrs={"not_modelled": "bearings", "oil_data_high_degc": 150.0},
    )  # fmt: skip


def test_a_film_hotter_than_the_oil_data_is_a_warning_in_losses_and_in_operation():
    hot = [one for one in findings({"losses": losses(383.0)}) if "flank film" in one.headline]
    assert [one.level for one in hot] == [WARNING]
    assert (
        "473 °C at 200 N·m, 9000 rpm and 90 °C oil, is extrapolated" in hot[0].headline
    )  # 90 + 383
    assert "at 25 % of the points" in hot[0].detail  # one of four
    assert not [one for one in findings({"losses": losses(59.0)}) if "film" in one.headline]
    (said,) = (one for one in findings({"film": film(2.0, 75.0)}) if "flank film" in one.headline)
    assert "155 °C" in said.headline
    assert "at 33 % of the points" in said.detail
    assert not [one for one in findings({"film": film(2.0)}) if "flank film" in one.headline]


def test_the_largest_order_is_that_of_the_film_where_there_is_one():
    peak = largest_error(sweep())
    assert (peak.order, peak.film) == (2, True)
    # exact but for the conversion of units
    assert peak.amplitude == pytest.approx(1.5, rel=1e-12)
    assert peak.speed == pytest.approx(2000.0, rel=1e-12)
    assert peak.frequency == pytest.approx(2000.0, rel=1e-12)


def test_without_a_film_the_largest_order_is_that_at_the_shown_coefficient():
    peak = largest_error(sweep(film=False))
    assert (peak.order, peak.film) == (1, False)
    assert peak.amplitude == pytest.approx(0.7, rel=1e-12)
    assert peak.speed == pytest.approx(3000.0, rel=1e-12)


@pytest.mark.parametrize(
    ("natural", "level", "words"),
    [
        ((4000.0,), NOTE, "50.0 % below the natural frequency of 4.00 kHz"),
        ((1900.0, 4000.0), WARNING, "5.3 % above the natural frequency of 1.90 kHz"),
    ],
)
def test_a_peak_near_a_natural_frequency_is_a_warning_where_the_pair_runs(natural, level, words):
    (one,) = findings({"sweep": sweep(natural)})
    assert one.level == level
    assert "1.50 µm: mesh order 2 at 2000 rpm, within 10 % of the 2000 rpm" in one.headline
    assert words in one.detail


def test_a_resonance_at_ten_times_the_speed_of_the_pair_is_no_warning():
    (one,) = findings({"sweep": sweep((1900.0,), runs_at=200.0)})
    assert one.level == NOTE
    assert "at 2000 rpm, 10 times the 200 rpm at which the pair runs" in one.headline


def test_the_first_finding_is_about_the_speed_at_which_the_pair_runs():
    first, *_ = findings({"sweep": sweep(), "response": response([3000.0])})
    assert first.level == NOTE
    assert "At 1000 rpm the largest order" in first.headline
    assert "0.300 µm: mesh order 2, at 1.00 kHz" in first.headline
    assert "Friction of the oil film" in first.detail


def test_an_unstable_sweep_is_told():
    told = findings({"sweep": sweep(margin=-0.1)})
    assert [one.level for one in told] == [NOTE, WARNING]
    assert "unstable" in told[1].headline


def test_the_margin_is_that_to_the_next_natural_frequency():
    met = meeting(3, 500.0, np.array([900.0, 1400.0, 2500.0]))
    assert (met.frequency, met.natural) == (1500.0, 1400.0)
    assert met.margin == pytest.approx(1.0 / 14.0, rel=1e-12)


@pytest.mark.parametrize(("natural", "level"), [(1050.0, WARNING), (3000.0, GOOD)])
def test_an_order_within_a_tenth_of_a_natural_frequency_is_a_warning(natural, level):
    _, one = findings({"response": response([natural])})
    assert one.level == level
    order = 2 if level == WARNING else 3
    assert f"At 1000 rpm mesh order {order}" in one.headline


def test_separation_is_told_with_its_speeds_share_and_folds():
    (apart,) = findings({"separation": separation(0.25)})
    (close,) = findings({"separation": separation(0.0)})
    assert (apart.level, close.level) == (WARNING, GOOD)
    assert "from 5000 to 5000 rpm" in apart.headline
    assert "25 % of the time" in apart.headline
    assert "2 folds" in apart.detail
    assert "runs at 5000 rpm" in apart.detail


def test_teeth_that_separate_at_other_speeds_are_no_warning():
    (far,) = findings({"separation": separation(0.25, runs_at=3000.0)})
    assert far.level == NOTE
    assert "runs at 3000 rpm" in far.detail


@pytest.mark.parametrize(("pressure", "level"), [(4.0e9, WARNING), (1.4e9, GOOD)])
def test_the_highest_pressure_is_that_at_the_operating_torque(pressure, level):
    (one,) = findings({"contact": contact(pressure)})
    assert one.level == level
    assert f"{1e-9 * pressure:.2f} GPa" in one.headline
    assert "200 N·m" in one.headline


@pytest.mark.parametrize(
    ("unstable_from", "level", "least"),
    [(9.0, GOOD, np.nan), (2.0, GOOD, 2.0), (1.0, WARNING, 1.0)],
)
def test_instability_is_a_warning_if_the_pair_itself_has_it(unstable_from, level, least):
    (one,) = findings({"stability": stability(unstable_from)})
    assert one.level == level
    np.testing.assert_equal(least_unstable(stability(unstable_from)), least)


@pytest.mark.parametrize(("ratio", "level"), [(0.7, WARNING), (1.3, NOTE), (3.2, GOOD)])
def test_the_least_film_ratio_is_that_of_loaded_points(ratio, level):
    (one,) = findings({"film": film(ratio)})
    assert one.level == level
    assert f"ratio λ is {ratio:.2f}" in one.headline


def test_key_numbers_have_the_same_names_in_every_run():
    everything = {
        "response": response([3000.0]),
        "sweep": sweep(),
        "contact": contact(1.4e9),
        "separation": separation(0.25),
        "stability": stability(2.0),
        "film": film(1.3),
    }
    full, none = numbers(everything), numbers({})
    assert [one.name for one in full] == [one.name for one in none]
    assert all(np.isnan(one.value) for one in none)
    value = {one.name: one.value for one in full}
    assert value["dynamic transmission error in operation"] == pytest.approx(0.3)
    assert value["largest dynamic transmission error in the sweep"] == pytest.approx(1.5)
    assert value["mean mesh stiffness"] == pytest.approx(500.0)
    assert value["loaded transmission error, peak to peak"] == pytest.approx(0.4)
    assert value["longest time without contact"] == pytest.approx(25.0)
