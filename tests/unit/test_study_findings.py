"""Findings of loss map, drive cycle, bearing and variation against made datasets."""

import json

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.report.solved_films import flank_friction
from gearlube.studies.bearing import findings as bearing
from gearlube.studies.bearing.report import bearing_report
from gearlube.studies.drive_cycle import findings as cycle
from gearlube.studies.drive_cycle.report import cycle_report
from gearlube.studies.loss_map import findings as loss_map
from gearlube.studies.loss_map.report import loss_map_report
from gearlube.variation import findings as variation
from gearlube.variation.report import variation_report

GRID = ("temperature", "speed", "torque")


def found(findings, words):
    (one,) = [one for one in findings if words in one.headline]
    return one


@pytest.fixture
def a_map():
    """Loss of flanks 2 % of the power carried, of bearings 10 W; half of it at 80 degC."""
    temperature, speed = np.array([40.0, 80.0]), np.array([1000.0, 2000.0])
    torque = np.array([-50.0, 0.0, 100.0])
    turning = speed[None, :, None] * np.pi / 30.0
    warm = np.array([1.0, 0.5])[:, None, None]
    flanks = 0.02 * np.abs(torque) * turning * warm
    bearings = np.broadcast_to(10.0 * warm, flanks.shape)
    loss = np.stack([flanks, bearings], axis=-1)
    total = loss.sum(axis=-1)
    with np.errstate(divide="ignore"):
        efficiency = 1.0 - total / np.abs(torque * turning)
    efficiency[..., 1] = np.nan
    ratio = np.full(total.shape, 2.0)
    ratio[1, 0, 2] = 0.5
    lines = total / turning
    return xr.Dataset(
        {
            "loss_torque": (GRID, lines),
            "loss": ((*GRID, "source"), loss),
            "efficiency": (GRID, efficiency),
            "film_ratio": (GRID, ratio),
            "flank_temperature": (GRID, np.full(total.shape, 90.0)),
            "range_exceeded": (GRID, np.zeros(total.shape)),
            "status": (GRID, np.zeros(total.shape, dtype=int)),
            "loss_torque_low": (GRID, 0.7 * lines),
            "loss_torque_high": (GRID, 1.4 * lines),
            "swing": (("input", *GRID), np.stack([0.1 * lines, 0.3 * lines])),
        },
        coords={
            "temperature": temperature,
            "speed": speed,
            "torque": torque,
            "source": ["friction_viscous", "bearing_torque"],
            "input": ["viscosity", "bearing_drag"],
        },
        attrs={
            "mesh": "made",
            "oil": "an_oil",
            "not_modelled": "windage",
            "ranges_left": "",
            "reasons": "4: no equilibrium",
            "draws": 60,
            "seed": 1,
            "uncertain": "viscosity: factor 1.1 (k = 2), batches; "
            "bearing_drag: factor 2 (k = 2), not measured",
        },
    )


def test_loss_map_says_its_best_largest_drag_and_error_bar(a_map):
    said = loss_map.findings(a_map)
    # 100 N.m at 2000 rpm are 20944 W: flanks 1 % of it and 5 W at 80 degC
    best = found(said, "at most 99.0 % efficient")
    assert "at 100 N·m, 2000 rpm and 80 °C oil" in best.headline
    largest = found(said, "largest loss")
    assert "is 429 W, at 100 N·m, 2000 rpm and 40 °C oil" in largest.headline  # 418.9 + 10
    assert "flank friction (fluid) 98 %, bearing drag 2 %" in largest.headline
    # 5 W at 209.4 rad/s to 10 W at 104.7 rad/s
    assert "0.0239 N·m to 0.0955 N·m" in found(said, "without load").headline
    assert "lowers the mean loss torque by 50 %" in found(said, "Warming").headline
    bar = found(said, "is known to")
    assert "−30 to +40 %" in bar.headline
    assert bar.detail.startswith("Most of it comes from: bearing drag 30 %, viscosity 10 %")
    film = found(said, "film ratio")
    assert film.level == WARNING
    assert "0.50, at 100 N·m, 1000 rpm and 80 °C" in film.headline
    assert "8 % of the points" in film.detail  # 1 of 12
    assert found(said, "left the range").level == GOOD
    assert found(said, "Not modelled: windage").level == NOTE


def test_loss_map_says_how_far_solved_films_are_to_be_trusted(a_map):
    assert not [one for one in loss_map.findings(a_map) if "solved films" in one.headline]
    friction = a_map["loss"].sel(source="friction_viscous", drop=True)
    outside = xr.zeros_like(friction)
    outside[1, 0, 2] = 0.3
    doubt = xr.full_like(friction, np.nan)
    doubt[0, 0, 2] = 0.0004
    solved = a_map.assign(
        friction_bound=0.02 * friction, share_outside=outside, efficiency_bound=doubt
    )
    said = found(loss_map.findings(solved), "solved films")
    assert "at most 0.040 % of efficiency" in said.detail
    assert "2.0 % of the flanks' friction loss" in said.headline
    assert "Model:" not in said.detail
    named = loss_map.findings(solved.assign_attrs(film_model_flank="mine (checksum 12)"))
    assert "Model: mine (checksum 12)." in found(named, "solved films").detail
    assert said.level == WARNING
    torque, speed = (float(a_map[name][k]) for name, k in (("torque", 2), ("speed", 0)))
    assert f"at most 30 % of the flanks' load, at {torque:.4g} N·m, {speed:.4g} rpm" in said.detail
    assert "more than 5 % at 1 of 12 points" in said.detail
    little = loss_map.findings(solved.assign(share_outside=0.1 * outside))
    assert found(little, "solved films").level == NOTE


def test_loss_map_says_how_far_solved_films_of_rollers_are_to_be_trusted(a_map):
    drag = a_map["loss"].sel(source="bearing_torque", drop=True)
    outside = xr.zeros_like(drag)
    outside[1, 0, 2] = 0.2
    solved = a_map.assign(drag_bound=0.03 * drag, rollers_outside=outside)
    solved = solved.assign_attrs(film_model_roller="mine (checksum 13)")
    said = found(loss_map.findings(solved), "solved films")
    assert "rolling friction of the rollers" in said.headline
    assert "3.0 % of the bearings' drag loss" in said.headline
    assert "at most 20 % of the rollers' load, at 100 N·m, 1000 rpm" in said.detail
    assert "Model: mine (checksum 13)." in said.detail
    assert said.level == WARNING


def test_loss_map_says_how_warm_the_flanks_get_by_their_own_friction(a_map):
    assert not [one for one in loss_map.findings(a_map) if "warms their bulk" in one.headline]
    rise = xr.zeros_like(a_map["film_ratio"])
    rise[1, 0, 2] = 12.0
    said = found(
        loss_map.findings(a_map.assign(bulk_temperature=a_map["temperature"] + rise)), "their bulk"
    )
    degc = float(a_map["temperature"][1])
    assert "by up to 12 K over the oil" in said.headline
    assert f"{degc:.4g} °C oil" in said.headline


def test_loss_map_warns_of_failures_and_ranges_and_steady_points_without_rest(a_map):
    a_map["status"][0, 0, 0] = 4
    a_map["range_exceeded"][0] = 1.0
    a_map["range_exceeded"][0, 0, 1] = 1.0 + 16.0  # torque and film temperature
    a_map.attrs |= {"ranges_left": "film load (range.film_load)", "air_temperature_degc": 20.0}
    a_map["steady_temperature"] = (GRID[1:], np.array([[30.0, 25.0, 60.0], [40.0, np.nan, 90.0]]))
    said = loss_map.findings(a_map)
    assert found(said, "1 of 12 points failed").level == WARNING
    left = found(said, "left the range")
    assert "50 % of the points left the range" in left.headline
    assert "torque (the mesh table ends) at 50 %; film temperature (the oil" in left.detail
    assert "data end) at 8 % of the points" in left.detail
    assert "between 25 and 90 °C" in found(said, "steady oil temperature is between").headline
    assert found(said, "1 of 6 torques").level == WARNING
    html = report_html(loss_map_report(a_map))
    assert "known to (95 %)" in html


@pytest.fixture
def a_cycle():
    steps = np.full(3, 10.0)
    loss = np.array([[100.0, 50.0], [200.0, 50.0], [0.0, 0.0]])
    energy = 1e-3 * (loss * steps[:, None]).sum(axis=0)  # 3 and 1 kJ
    zeros = np.zeros((3, 1))
    return xr.Dataset(
        {
            "oil_temperature": ("time", [20.0, 22.0, 26.0, 25.0]),
            "oil_temperature_low": ("time", [20.0, 21.0, 24.0, 23.0]),
            "oil_temperature_high": ("time", [20.0, 23.0, 28.0, 29.0]),
            "duration": ("step", steps),
            "vehicle_speed": ("step", [36.0, 72.0, 0.0]),
            "pinion_torque": ("step", [20.0, 40.0, 0.0]),
            "loss": (("step", "source"), loss),
            "outside_range": (("step", "range"), zeros),
            "time_outside_range": ("range", [0.0]),
            "energy_outside_range": ("range", [0.0]),
            "energy_in": 80.0,
            "energy_lost": ("source", energy),
            "energy_lost_low": 3.5,
            "energy_lost_high": 4.5,
            "energy_brakes": 12.0,
            "efficiency": 0.95,
        },
        coords={
            "time": [0.0, 10.0, 20.0, 30.0],
            "step": [5.0, 15.0, 25.0],
            "source": ["friction_viscous", "bearing_torque"],
            "range": ["range.torque"],
        },
        attrs={
            "cycle": "made",
            "axle": "an axle",
            "oil": "an_oil",
            "not_modelled": "windage",
            "ranges_left": "",
            "start_temperature_degc": 20.0,
            "air_temperature_degc": 19.0,
            "regeneration": 0.25,
            "coast_torque_n_m": 30.0,
            "capacity_j_k": 18000.0,
            "conductance_at_rest_w_k": 7.0,
            "conductance_at_100_kmh_w_k": 18.0,
        },
    )


def test_cycle_says_energy_lost_with_its_parts_oil_and_brakes(a_cycle):
    said = cycle.findings(a_cycle)
    lost = found(said, "axle loses")
    assert "4.00 kJ (1.11 Wh) in the cycle, 5.0 % of the energy put in" in lost.headline
    assert "flank friction (fluid) 75 %, bearing drag 25 %" in lost.headline
    assert "3.50 to 4.50 kJ" in lost.detail
    oil = found(said, "The oil goes from 20 to 25 °C")
    assert "between 23 and 29 °C; air is at 19 °C" in oil.detail
    assert "12.0 kJ" in found(said, "friction brakes").headline
    assert found(said, "No step left").level == GOOD
    left = a_cycle.assign_attrs(ranges_left="torque (range.torque)")
    left["energy_outside_range"][0] = 0.4
    assert found(cycle.findings(left), "Up to 40 % of the energy").level == WARNING
    html = report_html(cycle_report(a_cycle))
    assert "30 s and 0.30 km" in html  # 10 s at 10 m/s and 10 s at 20 m/s


def test_cycle_says_how_far_solved_films_are_to_be_trusted(a_cycle):
    assert not [one for one in cycle.findings(a_cycle) if "solved films" in one.headline]
    # of the 3 kJ of friction, 1 in the first step and 2 in the second
    solved = a_cycle.assign(
        share_outside=("step", [0.09, 0.0, 1.0]), energy_lost_bound=0.06, efficiency_bound=0.00075
    )
    # bounds of the steps whose load lies inside alone
    solved["friction_bound"] = (0.02 * flank_friction(a_cycle["loss"])).where([False, True, False])
    said = found(cycle.findings(solved), "solved films")
    assert "2.0 % of the flanks' friction loss" in said.headline
    assert said.level == NOTE
    assert "0.060 kJ of energy lost and 0.075 % of efficiency over the cycle" in said.detail
    assert "with 3.0 % of the flanks' friction loss; more than 5 % at 2 of 3 steps" in said.detail
    assert "covers 0 to 91 % of the load" in said.detail
    more = solved.assign(share_outside=("step", [0.3, 0.0, 0.0]))
    assert found(cycle.findings(more), "solved films").level == WARNING


def test_cycle_says_how_far_solved_films_of_rollers_are_to_be_trusted(a_cycle):
    # of the 1 kJ of drag in all; the whole of the second step lies outside
    drag = a_cycle["loss"].sel(source="bearing_torque") * a_cycle["duration"]
    share = float(drag[1] / drag.sum())
    solved = a_cycle.assign(rollers_outside=("step", [0.0, 1.0, 0.0]), energy_drag_bound=0.04)
    solved["drag_bound"] = 0.04 * a_cycle["loss"].sel(source="bearing_torque", drop=True)
    said = found(cycle.findings(solved), "solved films")
    assert "4.0 % of the bearings' drag loss" in said.headline
    assert "0.040 kJ of energy lost" in said.detail
    assert f"with {100.0 * share:.1f} % of the bearings' drag loss" in said.detail


@pytest.fixture
def a_bearing():
    dims = ("law", "speed", "axial_load", "radial_load", "temperature")
    torque = np.array([[[2.0, 1.0], [4.0, 2.0]], [[1.0, 0.5], [2.0, 1.0]]]).reshape(2, 2, 1, 1, 2)
    speed = np.array([100.0, 200.0])
    power = torque * speed[None, :, None, None, None]
    parts = np.stack([0.75 * torque, 0.25 * torque])
    ones = np.ones(torque.shape)
    return xr.Dataset(
        {
            "torque": (dims, torque),
            "power": (dims, power),
            "factor": (dims, 2.0 * ones),
            "film_ratio": (dims, 3.0 * ones),
            "out_of_range": (dims, 0.0 * ones),
            "torque_low": (dims, 0.5 * torque),
            "torque_high": (dims, 2.0 * torque),
            "part_torque": (("part", *dims), parts),
        },
        coords={
            "law": ["zhou_hoeprich", "palmgren"],
            "speed": speed,
            "axial_load": [5000.0],
            "radial_load": [0.0],
            "temperature": [313.15, 353.15],
            "part": ["rolling", "rib"],
        },
        attrs={
            "name": "made",
            "source": "",
            "oil": "an_oil",
            "inlet_layer_m": 0.0,
            "temperature_rise_k": 0.0,
        },
    )


def test_bearing_says_its_largest_loss_the_laws_and_the_oil(a_bearing):
    said = bearing.findings(a_bearing)
    largest = found(said, "loses at most")
    assert "800 W, with a torque of 4.00 N·m, at 1910 rpm, 5000 N axial" in largest.headline
    assert "0 N radial and 40 °C" in largest.headline
    assert "rolling 75 %, rib 25 %" in largest.detail
    assert "factor of 2: Palmgren has the least" in found(said, "laws differ").headline
    assert "from 40 to 80 °C lowers the mean torque by 50 %" in found(said, "Warming").headline
    assert found(said, "All laws are within their range").level == GOOD
    a_bearing["film_ratio"][0, 0] = 0.4
    assert found(bearing.findings(a_bearing), "film of the raceways falls to 0.4").level == WARNING
    known = {one.name: one.value for one in bearing.numbers(a_bearing)}
    assert known["largest power loss"] == 800.0
    assert known["largest over least law, mean"] == pytest.approx(2.0)
    html = report_html(bearing_report(a_bearing))
    assert "flooded" in html


def a_variation(*, sampled):
    """Loss 10 W for each N of preload at 40 degC, half of it at 80 degC; 20 preloads."""
    preload = np.linspace(1.0, 20.0, 20)
    loss = np.array([10.0 * preload, 5.0 * preload])
    inputs = [
        {"key": "oil", "unit": "degC", "meaning": "Of the oil", "sampled": False},
        {"key": "preload", "unit": "N", "meaning": "Of a bearing", "sampled": sampled},
    ]
    results = xr.Dataset(
        {"loss": ("point", loss.ravel(), {"units": "W", "long_name": "power lost in all"})},
        coords={
            "oil": ("point", np.repeat([40.0, 80.0], 20)),
            "preload": ("point", np.tile(preload, 2)),
        },
        attrs={
            "title": "map of made, oil, preload varied",
            "study": "map",
            "shown": ["loss"],
            "shape": [2, 20] if sampled else [2, 20, 1],
            "inputs": json.dumps(inputs),
        },
    )
    names = ["mean", "low", "p2.5", "p50", "p97.5", "high", "deviation"]
    if sampled:
        columns = [
            [r.mean(), r.min(), *np.percentile(r, [2.5, 50.0, 97.5]), r.max(), r.std()]
            for r in loss
        ]
        axes, failed = ["oil"], np.zeros(2, dtype=int)
        statistics = np.array(columns)[:, None, :]
    else:
        axes, failed = ["oil", "preload"], np.zeros((2, 20), dtype=int)
        statistics = np.repeat(loss[..., None, None], len(names), axis=-1)
    sampled_inputs = ["preload"] if sampled else []
    ranks = np.ones((*failed.shape, 1, len(sampled_inputs)))
    summary = xr.Dataset(
        {
            "statistics": ((*axes, "quantity", "statistic"), statistics),
            "rank_correlation": ((*axes, "quantity", "input"), ranks),
            "failed": (axes, failed),
        },
        coords={
            "oil": [40.0, 80.0],
            **({} if sampled else {"preload": preload}),
            "quantity": ["loss"],
            "unit": ("quantity", ["W"]),
            "statistic": names,
            "input": np.array(sampled_inputs, dtype=object),
        },
    )
    return results, summary


def test_variation_says_range_effects_and_what_a_quantity_follows():
    results, summary = a_variation(sampled=True)
    one = found(variation.findings(results, summary), "Power lost in all")
    assert "5.00 to 200 W, mean 78.8 W" in one.headline  # (105 + 52.5) / 2
    assert "Over oil 40 to 80 it changes by −50.0 %" in one.detail
    assert "follows most preload (+1.00)" in one.detail
    limited = summary.assign(share_above=(("oil", "limited"), [[0.5], [0.0]])).assign_coords(
        limited=["loss"], limit=("limited", [100.0])
    )
    over = found(variation.findings(results, limited), "25 % of the points")
    assert "a loss above 100 W" in over.headline
    assert over.level == WARNING
    html = report_html(variation_report(results, summary))
    assert html.count('class="plot"') == 3  # over the axis, distributions, ranks


def test_variation_on_a_grid_has_a_line_of_all_values_for_each_other_axis():
    results, summary = a_variation(sampled=False)
    report = variation_report(results, summary)
    (figure,) = report.figures
    assert [len(line.x) for line in figure.chart.data] == [20, 20]
    np.testing.assert_allclose(figure.chart.data[1].y, 5.0 * np.linspace(1.0, 20.0, 20), rtol=1e-6)
    one = found(variation.findings(results, summary), "Power lost in all")
    assert "Over preload 1 to 20 it changes by +1900 %" in one.detail
