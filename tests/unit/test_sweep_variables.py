"""Every variable of a sweep point: known answers of an axle whose motion is written down."""

import math

import numpy as np
import pytest

from gearlube.studies.sweep.datasets import merge, summary_csv
from gearlube.studies.sweep.point import summarise
from gearlube.studies.sweep.recording import AXES, BEARINGS, CHANNELS, FLANKS, LOSSES, record
from gearlube.studies.sweep.settings import SweepSettings, quick_sweep_settings
from tests.helpers import sweep_stand_in as stand_in
from tests.helpers.known_answers import assert_variables

KMH, PRELOAD, TEETH = 60.0, 2500.0, stand_in.TEETH
CURVES = ("bin", "pinion_angle", "mesh_phase", "cage_angle")


class Moving(stand_in.AnalyticAxle):
    """The stand-in with axial motion, forces, bounds and all flanks loaded, each its own."""

    def read(self):
        values = dict(zip(CHANNELS, super().read(), strict=True))
        wave = math.cos(TEETH * self.speed * self.time)
        values["pinion.displacement.x"] = 2e-6 * wave
        values["wheel.displacement.z"] = 3e-6 * wave
        values["energy.stored"] = 8.0 * self.time
        for j in BEARINGS:
            for a, axis in enumerate(AXES):
                values[f"bearing[{j}].force.{axis}"] = 100.0 * (3 * j + a) + (10 * j + a) * wave
            values[f"bearing[{j}].roller_load_min"] = 11.0 * j + wave
            values[f"bearing[{j}].roller_load_max"] = 700.0 * j + wave
        for i in FLANKS[1:]:
            for name, value in (("load", 10.0), ("film_thickness", 1e-6), ("film_ratio", 5.0)):
                values[f"flank[{i}].{name}"] = i * value
            values[f"flank[{i}].temperature"] = 350.0 + i
        for i in FLANKS:
            values[f"flank[{i}].friction_coefficient"] = 0.01 * i
        values["friction.power_loss_bound"], values["film.share_outside"] = 7.0, 0.03
        values["bearing.power_loss_bound"], values["bearing.share_outside"] = 9.0, 0.02
        return np.array([values[name] for name in CHANNELS])


@pytest.fixture(scope="module")
def point():
    settings = quick_sweep_settings(SweepSettings())
    speed = stand_in.pinion_speed_at(KMH)
    recording = record(Moving(speed), stand_in.SteadyDriver(), settings, CHANNELS)
    return merge([PRELOAD], [KMH], {(KMH, PRELOAD): summarise(recording, KMH, PRELOAD, settings)})


def test_every_number_of_a_point_has_its_known_value_and_unit(point):
    speed = stand_in.pinion_speed_at(KMH)
    hz, ratio = speed / (2.0 * math.pi), TEETH / stand_in.WHEEL_TEETH
    a = np.linspace(0.0, 2.0 * np.pi, 100_001)
    dte = stand_in.MEAN_DTE + 1e-6 * np.cos(a) + 3e-7 * np.cos(2.0 * a + 0.3)
    steps = math.ceil(1.0 / (TEETH * hz * 1e-4))  # of the longest step, 0.1 ms
    losses = [10.0, 4.0, 0.5, 1.0, 20.0, 2.0, 1.5, 3.0]  # 42 W of 2 kW
    scalars = {
        "status": ("1", 1),
        "message": ("", ""),
        "range_exceeded": ("1", 0.0),
        "range_message": ("", ""),
        "vehicle_speed": ("m s-1", 16.7),
        "pinion_speed": ("rad s-1", speed),
        "pinion_torque": ("N m", 30.0),
        "wheel_torque": ("N m", 80.0),
        "mesh_frequency": ("Hz", TEETH * hz),
        "pinion_frequency": ("Hz", hz),
        "wheel_frequency": ("Hz", ratio * hz),
        "pinion_cage_frequency": ("Hz", 0.4 * hz),
        "wheel_cage_frequency": ("Hz", 0.4 * ratio * hz),
        "record_revolutions": ("1", 5.0),  # two turns of the cage
        "communication_step": ("s", 1.0 / (TEETH * hz * steps)),
        "oil_temperature": ("K", 368.15),
        "dte_min": ("m", dte.min()),
        "dte_max": ("m", dte.max()),
        "dte_mean": ("m", 4e-6),
        "dte_pp": ("m", np.ptp(dte)),
        "dte_rms": ("m", 1e-6 * math.sqrt(0.5 * (1.0 + 0.09))),
        "separation": ("1", 0),
        "separated_fraction": ("1", 0.0),
        "mesh_force_min": ("N", 1800.0),
        "mesh_force_max": ("N", 2200.0),
        "mesh_force_mean": ("N", 2000.0),
        "dynamic_factor": ("1", 1.1),
        "radial_min": ("m", 2e-6),
        "radial_max": ("m", 4e-6),
        "radial_mean": ("m", 3e-6),
        "radial_pp": ("m", 2e-6),
        "axial_pp": ("m", 4e-6),
        "wheel_axial_pp": ("m", 6e-6),
        "roller_load_min": ("N", 400.0),
        "roller_load_max": ("N", 600.0),
        "roller_load_mean": ("N", 500.0),
        "bearing_roller_load_min": ("N", [10.0, 21.0, 32.0, 43.0]),
        "bearing_roller_load_max": ("N", [701.0, 1401.0, 2101.0, 2801.0]),
        "bearing_force_mean": ("N", 100.0 * np.arange(3, 15).reshape(4, 3)),
        "bearing_force_pp": ("N", 2.0 * np.add.outer([10, 20, 30, 40], [0, 1, 2])),
        "friction_loss_bound": ("W", 7.0),
        "efficiency_bound": ("1", 7.0 / 2000.0),
        "share_outside": ("1", 0.03),
        "drag_bound": ("W", 9.0),
        "rollers_outside": ("1", 0.02),
        "power_in": ("W", 2000.0),
        "loss": ("W", losses),
        "efficiency_mesh": ("1", 1.0 - 14.0 / 2000.0),
        "efficiency_axle": ("1", 1.0 - 42.0 / 2000.0),
        "energy_closure_error": ("1", -8.0 / 2000.0),  # 8 W are stored that nothing brings
        "film_thickness_min": ("m", 0.5e-6),
        "film_ratio_min": ("1", 1.0),
        "flank_temperature_max": ("K", 370.0),
    }
    grid = {
        "preload": ("N", [PRELOAD]),
        "speed": ("m s-1", [KMH / 3.6]),
        "speed_kmh": ("km h-1", [KMH]),
        "bearing": ("1", [1, 2, 3, 4]),
        "axis": ("", ["x", "y", "z"]),
        "source": ("", list(LOSSES)),
        "flank": ("1", [1, 2, 3]),
    }
    expected = {name: (unit, np.array(one)[None, None]) for name, (unit, one) in scalars.items()}
    # 34 samples a mesh period meet a crest to 1 - cos(pi/34) = 0.4 % of its wave, which is up to a
    # tenth of its mean; the whole record has a sample or two more than whole turns
    smooth = ("separation", "separated_fraction", "range_exceeded")
    assert_variables(point.drop_dims(CURVES), expected | grid, tolerance=1e-3, zero=smooth)
    head, row = summary_csv(point).splitlines()
    table = dict(zip(head.split(","), row.split(","), strict=True))
    assert table["efficiency_axle [1]"] == "0.979"
    assert table["loss_bearing_torque [W]"] == "20"
    assert table["preload [N]"] == "2500"
    numbers = [name for name in scalars if not name.startswith("bearing_") and name != "loss"]
    assert [name.partition(" ")[0] for name in table] == [
        "preload", "speed_kmh", *numbers, *(f"loss_{one}" for one in LOSSES)
    ]  # fmt: skip


def test_every_curve_of_a_point_has_its_known_values_and_unit(point):
    turn, phase = np.arange(TEETH * 64) / 64, np.arange(192) / 64  # mesh periods
    sector = (np.arange(120) + 0.5) * np.pi / 60.0
    wave = np.cos(2.0 * np.pi * turn)
    orders = np.arange(point.sizes["bin"]) / 5.0
    hz, angle = stand_in.pinion_speed_at(KMH) / (2.0 * np.pi), 2.0 * np.pi * turn / TEETH
    last = 2  # the turn drawn: settling and five turns are 2 turns and a part after a multiple of 5

    def spectrum(**lines):
        found = np.zeros(orders.size)
        for order, value in lines.items():
            found[round(5.0 * float(order[1:].replace("_", ".")))] = value
        return found

    flank_1 = (1000.0, 0.5e-6 * (1.1 + 0.1 * np.cos(2.0 * np.pi * phase / 3.0)),
               1.1 + 0.1 * np.cos(2.0 * np.pi * phase), 0.01, 370.0)  # fmt: skip
    each = (flank_1, (20.0, 2e-6, 10.0, 0.02, 352.0), (30.0, 3e-6, 15.0, 0.03, 353.0))
    names = ("load", "film_thickness", "film_ratio", "friction_coefficient", "temperature")
    units = ("N", "m", "1", "1", "K")
    flanks = {
        f"flank_{name}": (unit, [one[k] + 0.0 * phase for one in each])
        for k, (name, unit) in enumerate(zip(names, units, strict=True))
    }
    curves = {
        "frequency": ("Hz", hz * orders),
        "order": ("1", orders),
        "dte_spectrum": ("m", spectrum(q0=4e-6, q13=1e-6, q26=3e-7)),
        "radial_spectrum": ("m", spectrum(q0=3e-6, q13=1e-6)),
        "axial_spectrum": ("m", spectrum(q13=2e-6)),
        "bearing_force_spectrum": ("N", spectrum(q0=400.0, q13=11.0)),  # bearing 1 along y
        "roller_load_spectrum": ("N", spectrum(q0=500.0, q0_4=100.0)),
        "dte_wave": ("m", 4e-6 + 1e-6 * wave + 3e-7 * np.cos(4.0 * np.pi * turn + 0.3)),
        "mesh_force_wave": ("N", 2000.0 + 200.0 * wave),
        "pinion_y_wave": ("m", 3e-6 + 1e-6 * wave),
        "pinion_z_wave": ("m", 0.0 * wave),
        "roller_load_wave": ("N", 500.0 + 100.0 * np.cos(0.4 * (angle + 2.0 * np.pi * last))),
        **flanks,
    }  # fmt: skip
    expected = {name: (unit, np.array(one)[None, None]) for name, (unit, one) in curves.items()}
    axes = {"pinion_angle": ("rad", angle), "mesh_phase": ("1", phase)}
    # cubic interpolation over 34 samples a period
    shown = point[[*expected, *axes]].drop_vars(["preload", "speed", "speed_kmh", "flank"])
    assert_variables(shown, expected | axes, tolerance=1e-3, zero=("pinion_z_wave",))
    # a sector of 3 deg has loads that differ by up to 100 N sin(3 deg) = 5.2 N
    load = 500.0 + 100.0 * np.cos(sector)
    zone = {f"roller_zone_{name}": ("N", load[None, None]) for name in ("mean", "min", "max")}
    around = point[[*zone, "cage_angle"]].drop_vars(["preload", "speed", "speed_kmh"])
    assert_variables(around, zone | {"cage_angle": ("rad", sector)}, tolerance=5.2 / 600.0)
    drawn = {*expected, *axes, *zone, "cage_angle"}
    assert drawn == {str(n) for n, one in point.variables.items() if {*CURVES} & {*one.dims}}
