"""Every variable of bearings, measured flanks, whine and sound: known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.bearing.run import _bearing_dataset as bearing_dataset
from gearlube.studies.bearing.run import _bearing_rows as bearing_rows
from gearlube.studies.design.dataset import mesh_error
from gearlube.studies.measured.run import flank_dataset
from gearlube.studies.measured.teeth import tooth_error_dataset
from gearlube.studies.sound.dataset import fast_level, sound_dataset
from gearlube.studies.sound.metrics import Curve
from gearlube.studies.sound.report import _numbers
from gearlube.studies.whine import run as whine
from gearlube_core.bearings.losses.loss import PARTS
from tests.helpers.contact_cases import shipped_file
from tests.helpers.known_answers import assert_numbers, assert_variables, named


def test_bearing_variables_and_rows_are_known():
    torques = np.array([2.0, 3.0, 5.0, 7.0]).reshape(1, 2, 1, 1, 2)
    losses = [
        named(
            torque=t, power=11.0 * t, factor=2.0, film_ratio=0.1 * t, rib_film_ratio=0.2 * t,
            rib_friction=0.01 * t, out_of_range=0.03 * t, parts={PARTS[0]: 0.75 * t},
        )
        for t in torques.ravel()
    ]  # fmt: skip
    model = named(law="zhou_hoeprich", inlet_layer=2e-6, temperature_rise=4.0)
    settings = named(
        models=[model], speeds=(100.0, 200.0), axial_loads=(5e3,), radial_loads=(6e3,),
        temperatures=(313.15, 353.15),
    )  # fmt: skip
    file = named(name="made", source="", bearing=named(rolling_scale=1.0))
    made = bearing_dataset(file, named(name="oil"), settings, losses)
    expected = {
        "torque": ("N.m", torques),
        "power": ("W", 11.0 * torques),
        "factor": ("1", 2.0 + 0.0 * torques),
        "film_ratio": ("1", 0.1 * torques),
        "rib_film_ratio": ("1", 0.2 * torques),
        "rib_friction": ("1", 0.01 * torques),
        "out_of_range": ("1", 0.03 * torques),
        "torque_low": ("N.m", torques / 2.0),
        "torque_high": ("N.m", torques * 2.0),
        "part_torque": ("N.m", 0.75 * torques[None]),
        "part": ("", [PARTS[0]]),
        "law": ("", ["zhou_hoeprich"]),
        "speed": ("rad/s", [100.0, 200.0]),
        "axial_load": ("N", [5e3]),
        "radial_load": ("N", [6e3]),
        "temperature": ("K", [313.15, 353.15]),
    }
    assert_variables(made, expected)
    known = {"calibrated": 1, "inlet_layer_m": 2e-6, "temperature_rise_k": 4.0}
    assert {name: made.attrs[name] for name in known} == known
    _, part, whole, *_ = bearing_rows(made).splitlines()
    where = "zhou_hoeprich,954.929659,5000,6000,40"
    assert part == f"{where},{PARTS[0]},1.5,,,150,,,"
    assert whole == f"{where},total,2,1,4,200,100,400,0.06"


def test_variables_of_measured_flanks_are_known():
    places = named(s=np.array([0.25, 0.75]), t=np.array([0.1, 0.5, 0.9]))
    deviation = 1e-6 * np.arange(1.0, 13.0).reshape(2, 2, 3)
    grid = named(places=places, deviation=deviation, teeth=(1, 2), name="gear drive")
    surface = named(residual=1e-7 * deviation[0] * 1e6, residual_rms=3e-7, scatter_rms=5e-7)
    fit = named(
        fields=["pinion.machine.tilt_angle_deg"], units=["deg"], nominal=[15.0], change=[0.05],
        uncertainty=[0.01], corrective=[14.95], before=5e-6, after=4e-7,
    )  # fmt: skip
    flanks = named(
        grids={"a": grid},
        surfaces={"a": surface},
        file=named(name="mine", source="made", degree=3),
        errors=named(is_none=False),
        gear_file=shipped_file,
    )
    row = {
        "s": ("1", [[[0.25] * 3, [0.75] * 3]]),
        "t": ("1", [[[0.1, 0.5, 0.9]] * 2]),
        "deviation": ("m", [1e-6 * np.arange(4.0, 10.0).reshape(2, 3)]),
        "rest": ("m", [1e-7 * np.arange(1.0, 7.0).reshape(2, 3)]),
        "teeth": ("1", [2]),
        "rest_rms": ("m", [3e-7]),
        "scatter_rms": ("m", [5e-7]),
        "flank": ("", ["gear drive"]),
        "setting": ("", fit.fields),
        "setting_unit": ("", ["deg"]),
        "fit_before": ("m", [5e-6]),
        "fit_after": ("m", [4e-7]),
    }
    for name in ("nominal", "change", "uncertainty", "corrective"):
        row[f"setting_{name}"] = ("as in setting_unit", getattr(fit, name))
    made = flank_dataset(flanks, [fit])
    assert_variables(made, row)
    assert (made.attrs["degree"], made.attrs["single_teeth"]) == (3, 1)


def test_variables_of_single_teeth_are_known():
    error = 1e-6 * np.arange(24.0).reshape(2, 3, 4)
    orders = 1e-6 * np.array([[[3.0, 4.0], [5.0, 12.0]], [[8.0, 15.0], [7.0, 24.0]]])
    cycle = named(
        error=error,
        turns=lambda: (None, np.array([1e-8, 2e-8])),
        orders=lambda: {"pinion": orders},
        hunting_orders=lambda: (np.array([1.6]), np.array([[1e-8], [3e-8]])),
        torque=np.array([50.0, 100.0]),
        phases=np.arange(4) / 4,
        pinion_teeth=5,
        gear_teeth=3,
    )
    expected = {
        "error": ("m", error),
        "rest_rms": ("m", [1e-8, 2e-8]),
        "pinion_amplitude": ("m", 1e-6 * np.array([[5.0, 13.0], [17.0, 25.0]])),
        "hunting_amplitude": ("m", [[1e-8], [3e-8]]),
        "hunting_order": ("1", [1.6]),
        "torque": ("N.m", [50.0, 100.0]),
        "phase": ("1", [0.0, 0.25, 0.5, 0.75]),
        "pinion_order": ("", [1, 2]),
    }
    assert_variables(tooth_error_dataset(cycle, "mine"), expected)


def test_whine_variables_are_known(monkeypatch):
    """A motion at one speed, none at the other."""
    size = {"transmission_error": 1e-6, "force": 10.0}
    rates = np.array([[2.0, 3.0, 5.0], [7.0, 11.0, 13.0]])  # parameter, order
    found = named(
        stable=True,
        amplitudes=lambda name: (size[name] * np.array([1.0, 2.0, 3.0]), size[name] * rates),
    )
    parameters = [
        named(name="a", unit="mm", value=1.5, tolerance=0.01),
        named(name="b", unit="um", value=2.5, tolerance=2.0),
    ]
    rotation = 1e-3 * np.arange(8.0)
    table = named(
        parameters=parameters, rotation=rotation, rotation_rate=np.outer([3.0, 4.0], rotation)
    )
    settings = named(
        speeds=(100.0, 200.0), orders=(1, 2, 3), series=named(positions=8, torque=50.0)
    )
    monkeypatch.setattr(whine, "HypoidTorsional", lambda _: named(natural_frequency=1300.0))
    made = whine._dataset(shipped_file(), settings, table, None, [found, None])
    per = "per unit of the parameter"
    missing = np.full((2, 3), np.nan)
    expected = {
        "pinion_speed": ("rad/s", [100.0, 200.0]),
        "order": ("1", [1, 2, 3]),
        "phase": ("1", np.arange(8) / 8),
        "parameter": ("", ["a", "b"]),
        "unit": ("", ["mm", "um"]),
        "value": ("unit of the parameter", [1.5, 2.5]),
        "tolerance": ("unit of the parameter", [0.01, 2.0]),
        "stable": ("1", [1.0, 0.0]),
        "loaded_error": ("rad", rotation),
        "loaded_error_rate": (f"rad {per}", np.outer([3.0, 4.0], rotation)),
    }
    for name, unit in (("transmission_error", "rad"), ("force", "N")):
        expected[name] = (unit, [size[name] * np.array([1.0, 2.0, 3.0]), missing[0]])
        expected[f"{name}_rate"] = (f"{unit} {per}", [size[name] * rates, missing])
    assert_variables(made, expected)
    known = {"torque": 50.0, "pinion_teeth": 13, "kind": "hypoid", "natural_frequency": 1300.0}
    assert {name: made.attrs[name] for name in known} == known


def test_key_numbers_of_a_sound_are_known():
    """At 1 kHz the A-weighting is zero, at 100 Hz -19.1 dB (IEC 61672-1, table 3)."""
    speed = 2.0 * np.pi * np.array([100.0, 1000.0]) / 13.0
    run = xr.Dataset(
        {
            "level_a": ("time", [61.0, 67.0]),
            "pinion_speed": ("time", speed),
            "order_level": (("order", "time"), [[50.0, 40.0], [np.nan, 30.0]]),
            "loudness": ("time", [3.0, 5.0]),
            "loudness_single": 4.5,
            "roughness": ("time", [0.1, 0.2]),
            "roughness_single": 0.19,
        },
        coords={"order": [13.0, 2.0], "time": [0.0, 1.0]},
        attrs={"name": "A", "level_a_mean_db": 63.0, "pinion_teeth": 13},
    )
    found = _numbers(run, several=True)
    known = [
        ("A: largest level", 67.0, "dB(A)", "67.0"),
        ("A: mean level", 63.0, "dB(A)", "63.0"),
        ("A: loudness (N5)", 4.5, "sone", "4.5"),
        ("A: roughness", 0.19, "asper", "0.19"),
    ]
    assert_numbers(found[:4], known)
    mesh, pinion = found[4:]
    assert (mesh.name, mesh.unit) == ("A: largest level of mesh order 1", "dB(A)")
    assert abs(mesh.value - 40.0) < 0.01  # 40 dB at 1 kHz, 50 - 19.1 at 100 Hz
    # order 2 at 153.8 Hz: -13.4 dB at 160 Hz, -16.1 at 125 Hz
    assert pinion.name == "A: largest level of pinion order 2"
    assert 30.0 - 16.1 < pinion.value < 30.0 - 13.4


def test_sound_variables_are_known():
    """A tone of 1 kHz and 0.02 Pa rms, 60 dB with and without A-weighting; orders that end."""
    at = np.arange(96000) / 48000.0
    since = 5.0 + np.array([0.0, 2.0])
    record = named(
        time=since, speed=np.array([100.0, 300.0]), vehicle_speed=np.array([10.0, 30.0]), teeth=13,
        name="A",
    )  # fmt: skip
    pressure = named(
        signal=0.02 * 2.0**0.5 * np.sin(2000.0 * np.pi * at), early=0.1, band=(50.0, 4000.0)
    )
    tracks = named(
        order=np.array([13.0, 26.0]),
        time=np.array([0.0, 1.0, 2.0]),
        rms=2e-5 * np.array([[10.0, 100.0], [10.0, 100.0], [10.0, np.nan]]),
    )
    curves = {
        "loudness": Curve(np.array([0.0, 2.0]), np.array([3.0, 7.0]), 6.5, "a standard"),
        "roughness": Curve(np.array([0.0, 2.0]), np.array([0.1, 0.3]), 0.28, "another"),
    }
    audible = np.array([0.0, 2.0]), np.array([[1.0, 3.0], [2.0, 4.0]]), np.array([5.0, 9.0])
    path = named(source="made", generic=True)
    made = sound_dataset(record, path, pressure, tracks, curves, audible, named(field="free"))
    time = np.arange(0.025, 2.0, 0.05)
    half = time / 2.0
    expected = {
        "time": ("s", time),
        "order": ("1", [13.0, 26.0]),
        "pinion_speed": ("rad/s", 100.0 + 200.0 * half),
        "vehicle_speed": ("m/s", 10.0 + 20.0 * half),
        "level": ("dB", np.full(40, 60.0)),
        "level_a": ("dB", np.full(40, 60.0)),
        "loudness": ("sone", 3.0 + 4.0 * half),
        "loudness_single": ("sone", 6.5),
        "roughness": ("asper", 0.1 + 0.2 * half),
        "roughness_single": ("asper", 0.28),
        # the second order leaves the band between 1 and 2 s: half of the gap is kept
        "order_level": ("dB", [np.full(40, 20.0), np.where(time < 1.5, 40.0, np.nan)]),
        "order_contribution": ("sone", [1.0 + 2.0 * half, 2.0 + 2.0 * half]),
        "steady_loudness": ("sone", 5.0 + 4.0 * half),
    }
    # time weighting F rises with 0.125 s: 0.3 dB are left at 0.34 s
    late = {"time": slice(0.4, None)}
    rising = {"level", "level_a"}
    assert_variables(made.drop_vars(rising), {k: v for k, v in expected.items() if k not in rising})
    for name in rising:
        assert made[name].attrs["units"] == "dB"
        np.testing.assert_allclose(made[name].sel(late), 60.0, atol=0.3)
        assert made[name][-1] == pytest.approx(60.0, abs=0.01)
    known = {"early_share": 0.1, "transfer_path_generic": 1, "band_hz": [50.0, 4000.0]}
    assert {name: made.attrs[name] for name in known} == known
    assert made.attrs["peak_pa"] == pytest.approx(0.02 * 2.0**0.5)
    assert made.attrs["level_mean_db"] == pytest.approx(60.0)
    assert made.attrs["level_a_mean_db"] == pytest.approx(60.0, abs=0.02)


def test_the_level_of_a_tone_that_stops_falls_by_34_7_db_a_second():
    signal = np.where(np.arange(96000) < 48000, 0.02, 0.0) * 2.0**0.5
    first, second = fast_level(signal, 48000.0, np.array([1.1, 1.2]))
    assert first - second == pytest.approx(0.1 / 0.125 * 10.0 / np.log(10.0), rel=1e-6)


def test_the_error_of_a_mesh_is_that_of_the_pair_that_touches_first():
    """A parabola over four pitches, 40 places each: the pair within half a pitch of its crest."""
    place = np.arange(161) / 40.0 - 2.0
    drive = mesh_error(place**2, 1.0)
    phase = np.arange(400) / 400.0
    expected = np.minimum(phase, 1.0 - phase) ** 2
    # chords between the places lie up to (1/80)^2 above the parabola
    np.testing.assert_allclose(drive, expected, atol=1.0 / 6400.0 + 1e-12)
    np.testing.assert_allclose(mesh_error(-(place**2), -1.0), -drive, rtol=1e-12)
    short = np.where(abs(place) < 0.3, place**2, np.nan)
    assert np.isnan(mesh_error(short, 1.0)[200])
