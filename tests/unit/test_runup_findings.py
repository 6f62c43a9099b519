"""What is read out of a run-up: crests, critical speeds, operating shape, figures, table."""

import math
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from scipy.interpolate import CubicSpline

from drivetrain.axle_file.read_axle import read_axle
from gearlube.studies.runup import levels
from gearlube.studies.runup.critical import critical_speeds
from gearlube.studies.runup.dataset import operating_shape
from gearlube.studies.runup.figures.catalogue import bearing_spectra
from gearlube.studies.runup.figures.tracks import order_tracks
from gearlube.studies.runup.findings import _of_the_car, findings, numbers, peaks
from gearlube.studies.runup.modes import RampModes
from gearlube.studies.runup.report import summary_csv, tables
from gearlube.studies.runup.run import run_runup
from gearlube.studies.runup.settings import RunupSettings
from gearlube.studies.runup.without_car import HELD, force_without_car
from gearlube_core.dynamics.hypoid_axle import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.linearise import named_modes
from gearlube_core.spectra import OrderBlocks

OIL = 353.15  # K
PAPER = read_axle("mohammadpour_2015")
# a ring between the regimes of churning at these speeds
CAR = replace(PAPER, axle=replace(PAPER.axle, churning="changenet_velex_2007", ring_width=0.026))


SETTINGS = RunupSettings(
    car_axle=CAR, start_speed=280.0, end_speed=300.0, duration=0.8, pinion_torque=80.0,
    oil_temperature=OIL, sample_rate=8192.0, highest_frequency=3000.0, settling_time=0.3,
)  # fmt: skip


@pytest.fixture(scope="module")
def ramp():
    return run_runup(SETTINGS)


@pytest.mark.slow
def test_critical_speeds_are_where_the_mesh_meets_the_modes_of_the_axle(ramp) -> None:
    axle = HypoidAxle(read_axle("mohammadpour_2015").axle)
    axle.initialise(pinion_speed=290.0, pinion_torque=80.0, wheel_torque=221.5, oil_temperature=OIL)
    of_axle = {one.name: one.frequency for one in named_modes(axle, OIL, 80.0)}
    assert list(ramp["mode"].values) == list(of_axle)
    found = {(one.mode, one.mesh_order): one for one in critical_speeds(ramp)}
    # the film and the bearings' stiffness change the modes along the ramp by less than 0.1 %
    axial = found["pinion axial", 1]
    assert axial.speed_rpm == pytest.approx(60.0 * of_axle["pinion axial"] / 13, rel=1e-3)
    assert axial.margin == pytest.approx(axial.speed_rpm / (300.0 * 30.0 / math.pi) - 1.0)
    inside = found["pinion radial 2", 3]
    assert inside.speed_rpm == pytest.approx(60.0 * of_axle["pinion radial 2"] / 39, rel=1e-3)
    assert inside.margin == 0.0
    assert inside.force > 0.0


@pytest.mark.slow
def test_the_loudest_order_rises_towards_its_resonance_and_is_told_first(ramp) -> None:
    top = peaks(ramp)[0]
    assert (top.mesh_order, top.bearing, top.direction) == (1, "pinion", "axial")
    assert top.speed_rpm == pytest.approx(levels.rpm(ramp)[-1])
    first, *others = findings(ramp)
    assert first.level == "warning"
    assert first.headline.startswith("The loudest is mesh order 1: ")
    assert "mode 'pinion axial'" in first.detail
    assert "The peak lies at the end of the ramp" in first.detail
    headlines = " ".join(one.headline for one in others)
    assert "lies above the ramp, 3 % beyond its end: 'pinion axial'" in headlines
    assert "The teeth stay in contact at all speeds." in headlines
    assert {one.unit for one in numbers(ramp)} == {"N rms", "rpm", "µm rms", "", "%", "W"}


def test_an_order_that_grows_at_the_end_is_told_although_another_is_louder(ramp) -> None:
    louder = ramp.copy(deep=True)
    middle = ramp.sizes["block"] // 2
    louder["bearing_force_track"].loc[{"block": middle, "mesh_order": 2}] *= 1e3
    first, *others = findings(louder)
    assert first.headline.startswith("The loudest is mesh order 2: ")
    headlines = " ".join(one.headline for one in others)
    assert "critical speed of mesh order 1 lies above the ramp, 3 % beyond its end" in headlines


def test_a_resonance_of_the_car_is_said_to_depend_on_its_assumed_stiffness(ramp) -> None:
    strain = np.where(ramp["mode"].values == ramp["mode"].values[0], 0.8, 0.0)
    coupled = ramp.assign(mode_car_strain=("mode", strain))
    coupled.attrs["inputs_assumed"] = '[["driveline.propshaft_stiffness"]]'
    words = _of_the_car(coupled.assign({HELD: 20.0}), str(ramp["mode"].values[0]), 60.0)
    assert words.startswith("80 % of its strain energy is in springs of the car, whose stiffnesses")
    assert "Without the car, at held speed, the order has 20.0 N rms there, 3.0 times less" in words
    assert not _of_the_car(coupled, str(ramp["mode"].values[1]), 60.0)
    assert not _of_the_car(ramp, str(ramp["mode"].values[0]), 60.0)


@pytest.mark.slow
def test_at_held_speed_the_loudest_order_is_as_loud_as_in_a_slow_ramp_without_a_car(ramp) -> None:
    middle = ramp.sizes["block"] // 2
    force = levels.total_force(ramp, "bearing_force_track").values[middle]
    # order 1 grows by 2 % from block to block and is late by a quarter of that; order 2 hardly does
    for order, follows in ((1, 0.008), (2, 0.003)):
        louder = ramp.copy(deep=True)
        louder["bearing_force_track"].loc[{"block": middle, "mesh_order": order}] *= 1e3
        held = force_without_car(SETTINGS, louder)
        assert held == pytest.approx(force[order - 1], rel=follows), order


def test_table_and_summary_have_every_crest_and_block(ramp) -> None:
    crests, critical = tables(ramp)
    assert [row[0] for row in crests.rows] == [one.mesh_order for one in peaks(ramp)]
    assert len(critical.rows) == len(critical_speeds(ramp))
    lines = summary_csv([ramp]).splitlines()
    assert lines[0].startswith("ramp,time_s,pinion_speed_rpm,vehicle_speed_kmh,")
    assert len(lines) == 1 + ramp.sizes["block"]
    # 0.32033 m wheels at 13/36
    row = lines[1].split(",")
    assert float(row[3]) == pytest.approx(
        float(row[2]) * math.pi / 30 * 13 / 36 * 0.32033 * 3.6, 1e-3
    )


def test_order_tracks_show_levels_and_mark_critical_speeds(ramp) -> None:
    figure = order_tracks(ramp)
    overall = figure.axes[0].lines[0]
    force = ramp["bearing_force_overall"].values
    expected = 10.0 * np.log10((force**2).sum(axis=(1, 2)))
    assert overall.get_ydata() == pytest.approx(expected)
    assert figure.axes[0].get_ylabel() == "bearing forces [dB re 1 N rms]"
    assert any("pinion radial 2, H3" in text.get_text() for text in figure.axes[0].texts)


def test_a_motion_in_a_mode_is_wholly_of_that_mode() -> None:
    """Two modes of a made-up axle, orthogonal with respect to its masses."""
    mass = np.array([2.0, 1.0, 1.0, 1.0, 4.0, 1.0, 1.0, 1.0])
    one, two = np.zeros(8), np.zeros(8)
    one[[0, 4]] = 0.5, 0.5 / math.sqrt(2.0)  # 2 * 0.25 + 4 * 0.125 = 1
    two[1] = 1.0
    made = RampModes(
        speed=np.array([100.0, 200.0]),
        names=("turning", "axial"),
        frequency=np.full((2, 2), 500.0),
        damping_ratio=np.full((2, 2), 0.03),
        shape=np.stack([one, two], axis=1),
        mass=mass,
        radii=(0.02, 0.06),
    )
    speed, order = 150.0, 13
    # speeds of the shafts that turn them as in the first mode, and a quarter as much of the second
    amplitude = np.zeros((1, order + 1, 8), dtype=complex)
    motion = 1e-6 * one + 0.5e-6 * two
    amplitude[0, order] = motion
    amplitude[0, order, 0] *= 1j * order * speed / 0.02
    amplitude[0, order, 4] *= 1j * order * speed / 0.06
    blocks = OrderBlocks(
        time=np.zeros(1),
        speed=np.array([speed]),
        order=np.arange(order + 1.0),
        amplitude=amplitude,
        rms=np.zeros((1, 8)),
    )
    found = operating_shape(blocks, 0, 1, order, made)
    assert found.motion == pytest.approx(motion, abs=1e-18)
    assert found.share == pytest.approx([0.8, 0.2])
    assert made.critical_speed(0, 25.0) == pytest.approx(2.0 * math.pi * 500.0 / 25.0)
    assert math.isnan(made.critical_speed(0, 1.0))  # 3142 rad/s, far above


def test_the_regime_of_churning_is_kept_with_the_losses(ramp) -> None:
    """Of 290 rad/s at the pinion at half time, by the smooth step in ln(w R b/nu)."""
    ring, oil = CAR.axle.kernel_parameters().churning, CAR.axle.oil
    nu = oil.dynamic_viscosity(OIL) / oil.density
    time, regime = ramp["slow_time"].values, ramp["churning_regime"].values
    gear = np.interp(time, [0.0, 0.8], [280.0, 300.0]) / CAR.axle.mesh.ratio
    s = np.log(gear * 0.5 * ring.ring_diameter * ring.ring_width / nu / 6000.0) / np.log(1.5)
    s = np.clip(s, 0.0, 1.0)
    # the speed's swing at the mesh and the ends of the smoothing: below 0.5 %
    assert regime == pytest.approx(s * s * (3.0 - 2.0 * s), abs=0.02)
    assert 0.5 < regime[0] < regime[-1] < 0.9


def test_the_rollers_together_carry_the_recorded_force(ramp) -> None:
    """The loads that are drawn are those of the march: their axial sum is the bearing force."""
    bearing = read_axle("mohammadpour_2015").axle.bearings[0]
    load = ramp["roller_load"]
    sine = math.sin(bearing.contact_angle)
    axial = -sine * (load.isel(ring=0).sum("roller") - load.isel(ring=1).sum("roller"))
    recorded = ramp["bearing_force"].sel(bearing="pinion", direction="axial").astype(float)
    at = CubicSpline(ramp["time"].values, recorded.values)(ramp["frame_time"].values)
    # at 8192 Hz a mode of 2.3 kHz has four samples a cycle, which a spline keeps to 1 % of it
    assert axial.values == pytest.approx(at, rel=1e-3)
    turned = ramp["frame_angle"].values
    assert turned[-1] < 2.0 * math.pi <= turned[-1] + turned[1] + 1e-9


def test_spectra_are_those_of_the_blocks_at_a_quarter_half_and_three_quarters_of_the_speeds():
    """Block k has a level of k dB for the pinion and 10 dB more for the gear, at all orders."""
    level = np.arange(9.0)[:, None] + np.array([0.0, 10.0])
    force = np.sqrt(2.0) * 10.0 ** (level / 20.0)
    places = ("bearing", "direction")
    dataset = xr.Dataset(
        {
            "block_speed": ("block", 100.0 + 10.0 * np.arange(9.0)),
            "bearing_force_orders": (
                ("block", *places, "order"), force[:, :, None, None] * np.ones((3, 4))
            ),
            "axis": (places, [["x", "y", "z"]] * 2),
        },
        coords={"order": [0.0, 13.0, 26.0, 60.0], "bearing": ["pinion", "gear"],
                "direction": ["axial", "radial 1", "radial 2"]},
        attrs={"pinion_teeth": 13, "setting_pinion_torque": 80.0, "ramp": "run-up"},
    )  # fmt: skip
    figure = bearing_spectra(dataset)
    for block, row in zip((2, 4, 6), np.array(figure.axes).reshape(3, 3), strict=True):
        turns = (100.0 + 10.0 * block) / (2.0 * np.pi)
        said = f"{60.0 * turns:.0f} rpm, H1 = {13.0 * turns:.0f} Hz"
        assert row[0].get_ylabel().startswith(said)
        for ax in row:
            for lines, tops in zip(ax.collections, (block, block + 10.0), strict=True):
                ends = np.array(lines.get_segments())  # orders above 4.3 of the mesh are left out
                np.testing.assert_allclose(ends[:, :, 0], [[13.0, 13.0], [26.0, 26.0]])
                np.testing.assert_allclose(ends[:, 1, 1], tops, atol=1e-9)
    assert figure.axes[0].get_ylim()[1] == 20.0  # the next five above 16
