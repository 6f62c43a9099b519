"""Flanks and rollers of a run-up in motion: their loads, places, films, and what is said."""

import dataclasses
import math
import re

import numpy as np
import pytest
import xarray as xr
from PIL import Image
from typer.testing import CliRunner

import gearlube as gl
from gearlube.command import app
from gearlube.output.exports.export import export_results
from gearlube.report.page import report_html
from gearlube.report.parts import Figure, Report
from gearlube.studies.runup.animation.dataset import (
    animate_ramp,
    animation_dataset,
    load_animation,
    roller_variables,
)
from gearlube.studies.runup.animation.frames import PER_PERIOD, Frames
from gearlube.studies.runup.figures.moving.parts import moving_figures, save_moving
from gearlube.studies.runup.figures.moving.pictures import ring_at
from gearlube.studies.runup.figures.moving.words import roller_sentence
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.errors import ParameterError
from tests.helpers.short_ramp import SHORT

OIL = SHORT.oil_temperature
# of the rollers' axes r1, r2 and the shaft's in x, y, z
SHAFT_AXES = ((2, 1, 0), (0, 1, 2))
WIDTH, HEIGHT = 0.030, 0.0076  # m, of the drawn gear tooth


@pytest.fixture(scope="module")
def drive() -> xr.Dataset:
    return animation_dataset(SHORT, 0.5)


@pytest.fixture(scope="module")
def coast() -> xr.Dataset:
    return animation_dataset(dataclasses.replace(SHORT, pinion_torque=-40.0), 0.5)


@pytest.fixture(scope="module")
def figures(drive: xr.Dataset) -> tuple[Figure, Figure]:
    return moving_figures(drive, "Run-up: ")


def apart(dataset: xr.Dataset) -> xr.Dataset:
    """The same with teeth that are apart in all frames."""
    bare = dataset.copy(deep=True)
    for name in bare.data_vars:
        if str(name).startswith("flank_"):
            bare[name].values[:] = np.nan
    bare["side"].values[:] = 0.0
    return bare


def test_loads_of_the_tooth_pairs_add_up_to_the_mesh_force(drive, coast) -> None:
    for dataset, side in ((drive, 1.0), (coast, -1.0)):
        total = np.nansum(dataset["flank_load"].values, axis=1)
        assert total == pytest.approx(side * dataset["mesh_force"].values, rel=1e-12)
        assert (dataset["side"].values == side).all()
    # torque over the arm of the mesh force, 21.4 mm on the drive side; the rest is vibration
    assert float(drive["mesh_force"].mean()) == pytest.approx(80.0 / 0.0214, rel=0.02)


def test_loads_of_the_rollers_add_up_to_the_force_of_each_bearing(drive, coast) -> None:
    for dataset in (drive, coast):
        load, angle = dataset["roller_load"].values, dataset["roller_angle"].values
        for ring in range(4):
            bearing = SHORT.car_axle.axle.bearings[ring // 2]
            r1, r2, axial = SHAFT_AXES[ring // 2]
            lean, side = bearing.contact_angle, 1 - 2 * (ring % 2)
            force = dataset["ring_force"].values[:, ring]
            w = load[:, ring]
            size = w.sum(axis=1)
            # a roller pushes the shaft away from where it stands, across its cone
            for axis, share in (
                (r1, -math.cos(lean) * np.cos(angle[:, ring])),
                (r2, -math.cos(lean) * np.sin(angle[:, ring])),
                (axial, np.full_like(w, -side * math.sin(lean))),
            ):
                found = (w * share).sum(axis=1)
                assert found / size == pytest.approx(force[:, axis] / size, abs=1e-9)


def test_cages_turn_at_their_share_of_the_shafts_speed(drive) -> None:
    times = drive["frame_time"].values
    speed = float(drive["pinion_speed"].mean())
    for ring, shaft_speed in ((0, speed), (1, speed), (2, speed * 13 / 36), (3, speed * 13 / 36)):
        turned = np.unwrap(drive["roller_angle"].values[:, ring, 0])
        ratio = SHORT.car_axle.axle.bearings[ring // 2].parameters().cage_ratio
        # shafts turn evenly but for vibration, 0.1 % of the speed
        rate = np.polyfit(times, turned, 1)[0]
        assert abs(rate) == pytest.approx(ratio * shaft_speed, rel=5e-3)


def test_a_pair_is_after_a_mesh_period_where_the_one_before_it_was(drive, coast) -> None:
    for dataset in (drive, coast):
        phase = dataset["mesh_phase"].values
        assert phase[0] == pytest.approx(0.0, abs=1e-3)
        assert phase[PER_PERIOD] == pytest.approx(1.0, abs=1e-3)
        load, place = dataset["flank_load"].values, dataset["flank_centre"].values
        later, now = load[PER_PERIOD:], np.roll(load[:PER_PERIOD], -1, axis=1)
        # 290 rad/s is between resonances: what is no mesh order vibrates little
        top = np.nanmax(load)
        assert np.nan_to_num(later) == pytest.approx(np.nan_to_num(now), abs=0.02 * top)
        both = (later > 0.02 * top) & (now > 0.02 * top)
        moved = place[PER_PERIOD:] - np.roll(place[:PER_PERIOD], -1, axis=1)
        assert np.abs(moved[both]).max() < 5e-5  # m; a contact moves by 0.1 mm in a frame


def test_contacts_move_over_the_tooth_and_hertz_ellipses_carry_their_loads(drive, coast) -> None:
    for dataset, down in ((drive, True), (coast, False)):
        load, centre = dataset["flank_load"].values, dataset["flank_centre"].values
        loaded = np.isfinite(load)
        assert np.isfinite(centre[loaded]).all()
        assert (centre[loaded] > 0.0).all()
        assert (centre[loaded] < [WIDTH, HEIGHT]).all()
        # the pinion's root drives the gear's tip first; in coast the mesh runs the other way up
        both = loaded[1:] & loaded[:-1] & (np.abs(np.diff(centre[..., 1], axis=0)) > 0.0)
        upwards = np.diff(centre[..., 1], axis=0)[both] > 0.0
        assert upwards.mean() == pytest.approx(0.0 if down else 1.0, abs=0.05)
        minor, major = (dataset[f"flank_{name}"].values for name in ("minor", "major"))
        assert (np.linalg.norm(minor, axis=-1) < np.linalg.norm(major, axis=-1))[loaded].all()
        # on the drawn tooth lengths shrink, so that the ellipse carries no more than it does
        carried = 2.0 / 3.0 * np.pi * dataset["flank_pressure"].values
        carried *= np.linalg.norm(minor, axis=-1) * np.linalg.norm(major, axis=-1)
        assert (carried[loaded] < load[loaded]).all()
        assert (carried[loaded] > 0.6 * load[loaded]).all()


@pytest.mark.slow
def test_films_of_the_rollers_are_solved_ones_where_the_axle_takes_them() -> None:
    axle = HypoidAxle(dataclasses.replace(SHORT.car_axle.axle, bearing_torque_loss="solved_films"))
    axle.initialise(pinion_speed=290.0, pinion_torque=80.0, wheel_torque=220.0, oil_temperature=OIL)
    frames = Frames(
        axle=axle,
        time=np.zeros(1),
        ramp_time=0.0,
        torque=80.0,
        states=axle.state_view.copy()[None],
        outputs=axle.outputs.copy()[None],
    )
    film = roller_variables(frames, OIL)["roller_film"][1][0]
    for ring in range(4):
        thinnest = axle.output(f"bearing[{ring + 1}].film_thickness")
        assert np.nanmin(film[ring]) == pytest.approx(thinnest, rel=1e-12)


@pytest.mark.slow
def test_a_figure_begins_with_its_range_and_has_a_slider_with_few_small_frames(
    drive, figures
) -> None:
    flanks, rollers = figures
    load, film = drive["flank_load"].values, 1e6 * drive["flank_film"].values
    assert flanks.title == "Run-up: flanks in motion"
    assert flanks.caption.startswith(
        f"On the drive flank a contact carries {np.nanmin(load):.3g} to "
    )
    assert f" to {np.nanmax(film):.3g} µm thick" in flanks.caption
    assert "A roller carries" in rollers.caption
    assert "Loaded zone of all bearings: all around" in rollers.caption
    for figure in (flanks, rollers):
        chart = figure.chart
        assert 2 * PER_PERIOD == len(chart.frames) <= 60  # for a page that stays small
        names = [step.label for step in chart.layout.sliders[0].steps]
        assert names == [frame.name for frame in chart.frames]
        assert len(set(names)) == len(names)
    page = report_html(Report(study="runup", title="Run-up", figures=[flanks, rollers]))
    still = report_html(Report(study="runup", title="Run-up", figures=[flanks]))
    empty = report_html(Report(study="runup", title="Run-up"))
    assert len(page) - len(still) < 1e6
    assert len(still) - len(empty) < 4e6  # of these plotly has 2


@pytest.mark.slow
def test_bars_of_the_chart_are_the_loads_of_the_frame(drive, figures) -> None:
    chart = figures[1].chart
    for number in (0, 17):
        bars = [one for one in chart.frames[number].data if one.type == "barpolar"]
        for ring, trace in enumerate(bars):
            load = drive["roller_load"].values[number, ring]
            assert np.asarray(trace.r) == pytest.approx(load, rel=1e-6)
        assert chart.frames[number].layout.to_plotly_json() == {}  # axes stay as they are


def test_a_loaded_zone_is_where_all_rollers_that_pass_carry(drive) -> None:
    half = drive.copy(deep=True)
    half["roller_load"].values[:, 0][half["roller_angle"].values[:, 0] > np.pi] = 0.0
    begin, end = ring_at(half, 0, 0).zone
    bin_width = 2.0 * np.pi / 72
    assert begin == pytest.approx([0.0], abs=bin_width)
    # a zone ends where the next roller is seen idle; rollers stand 30 degrees apart, the cage
    # turns by 23 in the frames
    assert np.pi - bin_width <= end[0] <= np.pi + math.radians(8.0) + bin_width
    zone, others = re.search(r"bearing 1: (\d+)°, (.*?)\.", roller_sentence(half)).groups()
    # mean share of 12 rollers over 23 of the 30 degrees to the next: within a quarter of one
    assert abs(int(zone) - 180) < 8
    assert others == "2: all around, 3: all around, 4: all around"


@pytest.mark.slow
def test_teeth_that_are_apart_are_said_and_drawn(drive, tmp_path) -> None:
    some = drive.isel(frame=slice(0, 7)).copy(deep=True)
    some["side"].values[:5] = 0.0
    flanks, _ = moving_figures(some)
    assert flanks.caption.startswith("On the drive flank a contact carries")
    assert "The teeth are apart in 5 of 7 frames." in flanks.caption
    assert flanks.chart.frames[0].name == "0.00 (0.00 ms), teeth apart"
    bare = apart(drive).isel(frame=slice(0, 2))
    flanks, _ = moving_figures(bare)
    assert flanks.caption.startswith("No tooth pair carries load")
    assert len(save_moving(bare, tmp_path)) == 2


@pytest.mark.slow
def test_an_animation_is_written_read_exported_and_shown_without_a_tooth(drive, tmp_path) -> None:
    few = drive.isel(frame=slice(0, 3))
    files = save_moving(few, tmp_path)
    assert [path.name for path in files] == ["runup_flanks.gif", "runup_rollers.gif"]
    for path in files:
        with Image.open(path) as picture:
            assert picture.n_frames == 3
    bare = few.drop_vars(["flank_centre", "flank_minor", "flank_major"])
    assert len(moving_figures(bare)[0].chart.frames) == 3
    drive.to_netcdf(tmp_path / "runup.nc")
    read = load_animation(tmp_path / "runup.nc")
    assert read["flank_film"].attrs["units"] == "m"
    written = export_results(tmp_path / "runup.nc", "mat", tmp_path / "runup.mat")
    assert written[0].stat().st_size > 0


def test_a_speed_that_the_ramp_does_not_pass_is_refused(tmp_path, caplog) -> None:
    ramp = xr.Dataset()
    with pytest.raises(ParameterError, match=r"2673\.8\S* to 2864\.\S* rpm.*got 2000"):
        animate_ramp(SHORT, ramp, speed=gl.rpm_to_rads(2000.0))
    with pytest.raises(ParameterError, match="shape_speed"):
        animate_ramp(SHORT, ramp)
    with pytest.raises(ParameterError, match="time"):
        animation_dataset(SHORT, 1.0)
    out = tmp_path / "ramp"
    told = CliRunner().invoke(
        app,
        "runup --rpm --from 600 --to 4000 --duration 20 --torque 80 --animate-rpm 5000 "
        f"--out {out}".split(),
    )
    assert told.exit_code == 2
    assert "--animate-rpm must be within 600 to 4000 rpm, got 5000" in " ".join(caplog.text.split())
    assert not out.exists()
