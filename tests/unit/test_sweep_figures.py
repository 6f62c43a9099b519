"""Figures of a sweep: drawn from any merged dataset, without pyplot, with everything named."""

import math
import sys
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from gearlube.plotting.style import cell_edges
from gearlube.report.page import report_html
from gearlube.studies.sweep.datasets import merge, summary_table
from gearlube.studies.sweep.figures.bubbles import all_lines, highest, lines_of, spectrum_bubbles
from gearlube.studies.sweep.figures.catalogue import CATALOGUE
from gearlube.studies.sweep.figures.orders import DTE, default_top
from gearlube.studies.sweep.peaks import harmonic_amplitude
from gearlube.studies.sweep.point import failed_point, summarise
from gearlube.studies.sweep.report import sweep_report, write_sweep_report
from gearlube.studies.sweep.settings import SweepSettings, quick_sweep_settings
from tests.helpers import sweep_stand_in as stand_in

SPEEDS, PRELOADS = [20.0, 60.0, 100.0], [2500.0, 6000.0]
MESSAGE = "The axle FMU refused the step <at> t = 0.1 s"


@pytest.fixture(scope="module")
def sweep():
    settings = quick_sweep_settings(SweepSettings())
    points = {(v, p): stand_in.point(None, v, p, settings) for v in SPEEDS for p in PRELOADS}
    points[60.0, 6000.0] = failed_point(60.0, 6000.0, MESSAGE)
    dataset = merge(PRELOADS, SPEEDS, points)
    dataset["mode_frequency"] = (("preload", "mode"), np.array([[346.0, 2325.0], [361.0, np.nan]]))
    return dataset.assign_coords(mode=["gear axial", "mesh"]).assign_attrs(
        title="Speed sweep", gearlube_version="1.2.3", setting_oil="mohammadpour_2015"
    )


@pytest.mark.parametrize("entry", CATALOGUE, ids=lambda entry: entry.name)
def test_figure_is_drawn_with_labelled_axes_although_a_point_failed(sweep, entry, tmp_path):
    figure = entry.draw(sweep)
    figure.savefig(tmp_path / "figure.png", dpi=50)
    assert (tmp_path / "figure.png").stat().st_size > 3000
    labels = [ax.get_xlabel() + ax.get_ylabel() for ax in figure.axes]
    assert any(labels)
    assert figure.get_suptitle()


@pytest.mark.parametrize("entry", CATALOGUE, ids=lambda entry: entry.name)
def test_figure_of_a_single_point_is_drawn_without_pyplot(sweep, entry, tmp_path):
    sys.modules.pop("matplotlib.pyplot", None)
    entry.draw(sweep.isel(preload=[0], speed=[0])).savefig(tmp_path / "figure.png")
    assert "matplotlib.pyplot" not in sys.modules


def test_bubbles_show_mesh_lines_at_their_level_and_leave_failed_speeds_empty(sweep):
    points = all_lines(sweep, DTE, 2700.0)
    lines = points[0, 1]
    mesh = float(sweep["mesh_frequency"][0, 1])
    found = dict(zip(np.round(lines.frequency / mesh, 3), lines.level, strict=True))
    # 1 um over the reference of 1 nm is 60 dB; resampling loses less than 1e-2 dB
    assert found[1.0] == pytest.approx(20.0 * math.log10(stand_in.MESH_DTE / 1e-9), abs=1e-2)
    assert found[2.0] == pytest.approx(20.0 * math.log10(stand_in.SECOND_DTE / 1e-9), abs=2e-2)
    assert set(lines.kind[np.isin(np.round(lines.frequency / mesh, 3), (1.0, 2.0))]) == {0}
    assert points[1, 1].frequency.size == 0  # 60 km/h, 6000 N failed
    assert highest(points, 2700.0) == 60.0
    figure = spectrum_bubbles(sweep, DTE)
    drawn = np.concatenate([one.get_offsets() for one in figure.axes[1].collections])
    assert 60.0 not in drawn[:, 0]
    assert 100.0 in drawn[:, 0]


def test_engine_orders_are_told_from_others(sweep):
    point = sweep.isel(preload=0, speed=2)
    bins = point["frequency"].values
    lines = lines_of(point.assign(dte_spectrum=("bin", spikes(bins, (49.0, 75.0)))), DTE, 2700.0)
    assert lines.kind.tolist() == [2, 2]
    coupled = point.assign(dte_spectrum=("bin", spikes(bins, (49.0, 75.0))), crank_frequency=24.5)
    assert lines_of(coupled, DTE, 2700.0).kind.tolist() == [1, 2]


def spikes(bins, frequencies):
    values = np.zeros(bins.size)
    for one in frequencies:
        values[int(np.nanargmin(np.abs(bins - one)))] = 1e-7
    return values


def test_frequency_axis_ends_above_the_highest_mode_and_within_the_spectra(sweep):
    assert default_top(sweep) == pytest.approx(2700.0)  # 1.15 * 2325, rounded up to 100 Hz
    assert default_top(sweep.drop_vars("mode_frequency")) == 2500.0


def test_order_cut_reads_the_amplitudes_that_were_put_in(sweep):
    row = sweep.isel(preload=0)
    # 20 steps a mesh cycle at 100 km/h, 10 for the second order: spline error 1/9^4 = 1.5e-4.
    np.testing.assert_allclose(harmonic_amplitude(row, 1), stand_in.MESH_DTE, rtol=1e-4)
    np.testing.assert_allclose(harmonic_amplitude(row, 2), stand_in.SECOND_DTE, rtol=1e-3)
    assert math.isnan(harmonic_amplitude(sweep.isel(preload=1), 1)[1])


def test_cells_touch_half_way_between_speeds():
    np.testing.assert_allclose(cell_edges(np.array([20.0, 30.0, 50.0])), [15.0, 25.0, 40.0, 60.0])


def test_report_contains_its_pictures_settings_points_and_failures(sweep, tmp_path):
    path = write_sweep_report(sweep, tmp_path, CATALOGUE[:3])
    html = path.read_text(encoding="utf-8")
    assert html.count('class="plot"') == 3
    assert 'src="http' not in html
    assert 'href="http' not in html
    assert "mohammadpour_2015" in html
    assert "1.2.3" in html
    assert "<td>95.0</td>" in html  # oil of a point [degC]
    assert "refused the step &lt;at&gt; t = 0.1 s" in html
    assert html.count("single-sided") + html.count(">none</td>") >= 5
    assert len(list((tmp_path / "figures").glob("*.png"))) == 3


def test_report_of_steady_oil_names_the_air_and_no_temperature_of_all_points():
    point = failed_point(20.0, 2500.0, "out of range")
    dataset = merge([2500.0], [20.0], {(20.0, 2500.0): point}).assign_attrs(title="Speed sweep")
    kelvin = {"setting_oil_temperature": 368.15, "setting_air_temperature": 283.15}
    steady = report_html(sweep_report(dataset.assign_attrs(setting_oil_state="steady", **kelvin)))
    assert "10.0 °C" in steady
    assert "95.0 °C" not in steady
    given = report_html(sweep_report(dataset.assign_attrs(setting_oil_state="given", **kelvin)))
    assert "95.0 °C" in given
    assert "10.0 °C" not in given


def test_report_of_a_sweep_in_which_everything_failed_names_the_failures():
    point = failed_point(20.0, 2500.0, "out of range")
    dataset = merge([2500.0], [20.0], {(20.0, 2500.0): point}).assign_attrs(title="Speed sweep")
    assert isinstance(dataset, xr.Dataset)
    html = report_html(sweep_report(dataset))
    assert "out of range" in html
    assert "<img" not in html


def test_points_that_left_a_range_are_flagged_and_named_in_the_report():
    settings = quick_sweep_settings(SweepSettings())
    recording = stand_in.recorded(60.0, settings)
    said = "range.torque: torque should be within -400 to 400 N.m, got 450 N.m."
    left = replace(recording, warnings=("built from other sources", said))
    points = {
        (60.0, 2500.0): summarise(recording, 60.0, 2500.0, settings),
        (60.0, 6000.0): summarise(left, 60.0, 6000.0, settings),
    }
    dataset = merge(PRELOADS, [60.0], points).assign_attrs(title="Speed sweep")
    table = summary_table(dataset)
    assert table["range_exceeded"].tolist() == [0.0, 1.0]
    assert table["range_message"].tolist() == ["", said]
    html = report_html(sweep_report(dataset, entries=()))
    # for readers without the name of the output
    assert html.count("Torque should be within -400 to 400 N.m, got 450 N.m.") == 1
    assert "range.torque" not in html
    assert "left the range of a formula" in html
    sound = report_html(sweep_report(dataset.isel(preload=[0]), entries=()))
    assert "No finished point left the range" in sound
