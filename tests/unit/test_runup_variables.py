"""Every variable of a run-up's dataset: known answers of a record that is written down."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest

from drivetrain.axle_file.read_axle import read_axle
from gearlube.studies.runup import dataset as made_from
from gearlube.studies.runup import rollers
from gearlube.studies.runup.modes import COORDINATES, RampModes
from gearlube.studies.runup.record import AXES, BEARINGS, DIRECTIONS, FORCES, MOTION, RampRecord
from gearlube.studies.runup.settings import RunupSettings
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from tests.helpers.known_answers import assert_variables

START, END, DURATION, RATE, Z = 200.0, 216.0, 1.2, 8192.0, 13
ORDERS = np.arange(1, 5)
DTE, MESH = 1e-6 * np.array([1.0, 0.5, 0.25, 0.125]), np.array([40.0, 30.0, 20.0, 10.0])
FORCE = np.outer(np.arange(1, 7), [10.0, 7.0, 5.0, 3.0])  # N, of six directions and four orders
MOVES = 1e-7 * np.array([4.0, 1.0, 2.0, 3.0, 6.0, 5.0, 7.0, 8.0])  # m at mesh order 1
PHASE = 0.1 * np.arange(1, 9)  # rad
POWERS = np.array([2000.0, 10.0, 4.0, 0.5, 1.0, 20.0, 2.0, 1.5, 3.0])  # W: put in, losses
CURVES = ("order", "frequency", "slice", "time", "frame")


def settings():
    return RunupSettings(
        car_axle=read_axle("mohammadpour_2015"),
        start_speed=START,
        end_speed=END,
        duration=DURATION,
        pinion_torque=80.0,
        sample_rate=RATE,
        highest_frequency=3000.0,
        settling_time=0.1,
    )


def record():
    """Return a ramp whose signals are sums of mesh orders; forces grow in proportion to angle."""
    t = np.arange(round(DURATION * RATE)) / RATE
    rise = (END - START) / DURATION
    angle = START * t + 0.5 * rise * t**2
    wave = np.cos(Z * np.outer(ORDERS, angle))
    motion = dict(zip(MOTION, np.zeros((len(MOTION), t.size)), strict=True))
    moved = MOVES[:, None] * np.cos(Z * angle + PHASE[:, None])
    for name, one in zip(MOTION[6:], np.delete(moved, (0, 4), axis=0), strict=True):
        motion[name] = one
    motion["pinion.angle"], motion["pinion.speed"] = angle, START + rise * t + 1e6 * moved[0]
    motion["wheel.angle"] = angle * 13.0 / 36.0
    motion["wheel.speed"] = (START + rise * t) * 13.0 / 36.0 + 1e6 * moved[4]
    motion["mesh.dte"] = 4e-6 + DTE @ wave
    motion["mesh.dte"][:100] = -1e-6  # apart
    motion["mesh.force"] = 2000.0 + MESH @ wave
    forces = 100.0 * np.arange(1, 7)[:, None] + (1.0 + angle / angle[-1]) * (FORCE @ wave)
    slow = np.arange(61) * DURATION / 60.0
    return RampRecord(
        time=t,
        channels=motion | dict(zip(FORCES, forces, strict=True)),
        slow_time=slow,
        energies=np.outer(slow, POWERS),
        outside=slow < 0.5 * DURATION,
        warnings=("one", "two"),
        torques=(np.linspace(80.0, 90.0, 5), np.full(5, 2.0)),
    )


MODES = RampModes(
    speed=np.array([200.0, 216.0]),
    names=("turning", "axial"),
    frequency=np.array([[440.0, 880.0], [440.0, 880.0]]),
    damping_ratio=np.array([[0.02, 0.05], [0.04, 0.05]]),
    shape=np.stack([[0.5, 0, 0, 0, 0, 0, 0, 0], [0, 0.2, 0, 0, 0, 0, 0, 0.1]], axis=1),
    mass=np.array([4.0, 9.0, 9.0, 9.0, 2.0, 64.0, 64.0, 64.0]),
    radii=(0.02, 0.06),
)


def written_loads(motion, f_ref, eta0, alpha, bearing, side, loads):
    """Stand in for the kernel: load of roller k of a side is 100 N (2 + side) + k N."""
    loads[:] = 100.0 * (2.0 + side) + np.arange(loads.size)


@pytest.fixture(scope="module")
def found():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(made_from, "ramp_modes", lambda *_: MODES)
        patch.setattr(rollers, "roller_loads", written_loads)
        return made_from.runup_dataset(settings(), record())


RISE, WHOLE = (END - START) / DURATION, 0.5 * (START + END) * DURATION  # rad/s2, rad


def time_at(angle):
    return (np.sqrt(START**2 + 2.0 * RISE * angle) - START) / RISE


def blocks():
    """Return middle angle, its time and mean speed of blocks of four turns, one turn apart."""
    starts = 2.0 * np.pi * np.arange(int(WHOLE / (2.0 * np.pi)) - 3)
    middle = starts + 4.0 * np.pi
    return middle, time_at(middle), 8.0 * np.pi / (time_at(starts + 8.0 * np.pi) - time_at(starts))


def test_every_track_loss_mode_and_shape_of_a_ramp_has_its_known_values_and_unit(found):
    middle, at, speed = blocks()
    count, grown = at.size, 1.0 + middle / WHOLE
    force = grown[:, None, None] * FORCE[None]
    # one order: 2 pi 440 Hz / (13 m); the fourth lies beyond a third of the slowest speed
    critical = 2.0 * np.pi * np.outer([440.0, 880.0], 1.0 / (Z * ORDERS))
    critical[0, 3] = np.nan
    damping = np.array([[0.02 + 0.02 * (critical[0, 0] - 200.0) / 16.0, 0.02, 0.02, np.nan],
                        4 * [0.05]])  # fmt: skip
    turns = np.where(np.isin(np.arange(8), (0, 4)), 1e6 / (Z * speed[-1]), 1.0)
    moves = MOVES * turns * np.where(np.arange(8) == 0, 0.02, np.where(np.arange(8) == 4, 0.06, 1))
    delay = np.where(np.isin(np.arange(8), (0, 4)), 0.5 * np.pi, 0.0)
    phase = PHASE - delay
    axial = 0.2 * 9.0 * moves[1] * np.exp(1j * phase[1]) + 0.1 * 64.0 * moves[7] * np.exp(
        1j * phase[7]
    )
    share = np.array([(0.5 * 4.0 * moves[0]) ** 2, abs(axial) ** 2])
    slow = np.arange(60) * DURATION / 60.0 + DURATION / 120.0
    expected = {
        "axis": ("", AXES),
        "slow_time": ("s", slow),
        "power_in": ("W", np.full(60, 2000.0)),
        "range_exceeded": ("1", np.arange(60) < 30),
        "loss": ("W", np.tile(POWERS[1:], (60, 1))),
        "torque_time": ("s", [0.0, 0.3, 0.6, 0.9, 1.2]),
        "pinion_torque": ("N m", [80.0, 82.5, 85.0, 87.5, 90.0]),
        "block_time": ("s", at),
        "block_speed": ("rad s-1", speed),
        "mesh_order": ("1", ORDERS),
        "bearing_force_track": ("N", force.reshape(count, 2, 3, 4)),
        "bearing_force_overall": ("N", np.sqrt(0.5 * (force**2).sum(axis=-1)).reshape(count, 2, 3)),
        "dte_track": ("m", np.tile(DTE, (count, 1))),
        "dte_overall": ("m", np.full(count, math.sqrt(0.5 * (DTE**2).sum()))),
        "mesh_force_track": ("N", np.tile(MESH, (count, 1))),
        "separated_fraction": ("1", 100.0 / 9830.0),
        "mode_speed": ("rad s-1", [200.0, 216.0]),
        "mode_frequency": ("Hz", MODES.frequency),
        "mode_damping": ("1", MODES.damping_ratio),
        "mode_shape": ("m kg^-1/2", MODES.shape),
        "critical_speed": ("rad s-1", critical),
        "critical_damping": ("1", damping),
        "shape_amplitude": ("m", moves),
        "shape_phase": ("rad", phase),
        "shape_share": ("1", share / (MODES.mass * moves**2).sum()),
        "shape_speed": ("rad s-1", speed[-1]),  # the forces grow along the ramp
        "shape_mesh_order": ("1", 1),
        "ring": ("1", [1, 2, 3, 4]),
        "bearing": ("", list(BEARINGS)),
        "direction": ("", list(DIRECTIONS)),
        "source": ("", list(LOSS_SOURCES)),
        "mode": ("", ["turning", "axial"]),
        "coordinate": ("", list(COORDINATES)),
    }
    # cubic interpolation over 5 samples of the fourth order; teeth apart at the start are cut out
    steady = found.drop_dims(CURVES)
    steady["dte_track"][:2], steady["dte_overall"][:2] = DTE, expected["dte_overall"][1][0]
    assert_variables(steady, expected, tolerance=4e-3)
    known = {"pinion_teeth": 13, "gear_teeth": 36, "ramp": "run-up", "setting_pinion_torque": 80.0}
    known |= {"ranges_left": "one\ntwo"}
    inputs = settings().car_axle.inputs
    for name in ("given", "assumed"):
        notes = [one.field for one in inputs if (one.origin == "given") == (name == "given")]
        assert notes
        assert [row[0] for row in json.loads(found.attrs[f"inputs_{name}"])] == notes
    assert {name: found.attrs[name] for name in known} == known


def test_every_curve_and_map_of_a_ramp_has_its_known_values_and_unit(found):
    middle, _, _ = blocks()
    order = np.arange(int(6.5 * Z * 4) + 1) / 4.0
    # a Hann window gives the bins beside a line half of it
    line = np.zeros((4, order.size))
    for row, place in enumerate(Z * ORDERS * 4):
        line[row, place - 1 : place + 2] = 0.5, 1.0, 0.5
    grown = 1.0 + middle / WHOLE
    forces = grown[:, None, None] * (FORCE @ line)[None]
    made, time = record(), np.arange(9830) / RATE
    bins = round(RATE / math.sqrt(RISE * Z / (2.0 * np.pi)))  # of the sharpest first order
    slices = (0.5 * bins + bins // 4 * np.arange(found.sizes["slice"])) / RATE
    frames = 2.0 * np.pi * np.arange(52) / 52.0
    # the middle of the loudest block, the last, is where turn 37 begins: rounding decides which
    first = int(found["frame_time"][0] > 0.5 * (time_at(72.0 * np.pi) + time_at(74.0 * np.pi)))
    turn = 2.0 * np.pi * (36 + first)
    bearing = settings().car_axle.axle.kernel_parameters().bearing_p
    ratios = bearing.cage_ratio * np.array([1.0, 1.0, 13.0 / 36.0, 13.0 / 36.0])
    cage = np.outer(turn + frames, ratios)
    loads = np.array([[300.0, 100.0, 300.0, 100.0]]).T + np.arange(12)
    expected = {
        "time": ("s", time),
        "bearing_force": (
            "N",
            np.stack([made.channels[one] for one in FORCES], 1).reshape(-1, 2, 3),
        ),
        **{
            name: (unit, made.channels[channel])
            for name, channel, unit in (
                ("pinion_speed", "pinion.speed", "rad s-1"),
                ("wheel_speed", "wheel.speed", "rad s-1"),
                ("dte", "mesh.dte", "m"),
                ("mesh_force", "mesh.force", "N"),
            )
        },
        "order": ("1", order),
        "bearing_force_orders": ("N", forces.reshape(-1, 2, 3, order.size)),
        "dte_orders": ("m", np.tile(DTE @ line, (middle.size, 1))),
        "slice_time": ("s", slices),
        "slice_speed": ("rad s-1", START + RISE * slices),
        "frequency": ("Hz", np.arange(int(3000.0 * bins / RATE) + 1) * RATE / bins),
        "frame_time": ("s", time_at(turn + frames)),
        "frame_angle": ("rad", frames),
        "roller_load": ("N", np.tile(loads, (52, 1, 1))),
        "roller_angle": ("rad", np.mod(cage[..., None] + np.pi / 6.0 * np.arange(12), 2.0 * np.pi)),
    }
    drawn = {str(n) for n, one in found.variables.items() if {*CURVES} & {*one.dims}}
    assert drawn == {*expected, "bearing_force_waterfall", "dte_waterfall"}
    shown = found[list(expected)].drop_vars(["bearing", "direction", "ring"])
    shown["dte_orders"][:2] = DTE @ line
    # float32 and cubic interpolation; half of the growth over a block leaks to the third bin
    assert_variables(shown, expected, tolerance=6e-3)
    # a line between two bins loses up to 15 % in a Hann window, here 1 % more by the rising speed
    hertz = Z * (START + RISE * slices) / (2.0 * np.pi)
    for name, sizes, unit in (
        (
            "bearing_force_waterfall",
            10.0 * (1.0 + (START + 0.5 * RISE * slices) * slices / WHOLE),
            "N",
        ),
        ("dte_waterfall", 1e-6 + 0.0 * slices, "m"),
    ):
        one = found[name] if unit == "m" else found[name][:, 0, 0]
        assert one.attrs["units"] == unit
        near = abs(found["frequency"].values - hertz[:, None]) < 3.0 * RATE / bins
        crest = np.where(near, one.values, 0.0).max(axis=1)[1:]
        np.testing.assert_allclose(crest, 0.92 * sizes[1:], rtol=0.09)


@pytest.mark.parametrize(
    ("rise", "duration", "highest", "expected"),
    [
        (2.0 * np.pi / 13.0 * 36.0, 10.0, 4000.0, 6.0),  # root of 36 Hz/s
        (1.0, 10.0, 4000.0, 4.0),  # the finest
        (1.0, 0.5, 4000.0, 8.0),  # four slices at least
        (1.0, 0.5, 2000.0, 5.0),  # 400 bins at least
    ],
)
def test_bins_are_as_wide_as_the_first_order_moves_within_limits(rise, duration, highest, expected):
    one = SimpleNamespace(
        car_axle=read_axle("mohammadpour_2015"),
        ramp=SimpleNamespace(acceleration=-rise),
        duration=duration,
        sample_rate=12000.0,
        highest_frequency=highest,
    )
    assert made_from._resolution(one) == pytest.approx(expected, rel=1e-12)
