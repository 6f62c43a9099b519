"""Loss map and drive cycle: known answers of made datasets."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.films import flank_friction
from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.drive_cycle import report as cycle
from gearlube.studies.drive_cycle.report import cycle_report
from gearlube.studies.drive_cycle.tables import series_rows, summary_rows
from gearlube.studies.loss_map import findings as loss_map
from gearlube.studies.loss_map.report import loss_map_report
from tests.helpers.known_answers import assert_findings, assert_numbers, assert_tables, quantities

GRID = ("temperature", "speed", "torque")


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


W = 1000.0 * np.pi / 30.0  # rad/s, the slower speed; the other is twice as fast


def test_loss_map_has_its_known_key_numbers_findings_and_tables(a_map):
    a_map["flank_temperature"][0, 1, 0] = 150.0
    a_map["range_exceeded"][0, 0, :2] = 1.0
    a_map.attrs |= {"oil_data_high_degc": 100.0}
    drag = 10.0 * (1.0 + 0.5) / 2.0  # mean over the speeds, with 1/W
    numbers = [
        # flanks 2 %, bearings 10 W; half at 80 degC; 5 kW to 21 kW
        ("best efficiency", 100.0 - 0.5 * (2.0 + 1000.0 / (200.0 * W)), "%", "98.98"),
        ("mean efficiency over the map",
         100.0 - 0.75 * (2.0 + 250.0 * (1 / 50 + 1 / 100) * (1 / W + 0.5 / W)), "%", "98.42"),
        ("largest loss", 0.02 * 200.0 * W + 10.0, "W", "429"),
        ("mean loss torque at the pinion", 0.75 * (0.02 * 50.0 + drag / W), "N·m", "0.804"),
        ("least film ratio", 0.5, "", "0.50"),
        ("films hotter than the oil data", 100.0 / 12.0, "% of points", "8.3"),
        ("points outside a range", 200.0 / 12.0, "%", "17"),
        ("error bar of the loss, low end", -30.0, "%", "−30"),
        ("error bar of the loss, high end", 40.0, "%", "40"),
    ]  # fmt: skip
    assert_numbers(loss_map.numbers(a_map), numbers)
    findings = [
        (NOTE, "mean efficiency … its losses are known to … bearing drag 30 %, viscosity 10 %",
         "98.4 %, −30, +40 %, 95 %, 99.0 %, 100 N·m, 2000 rpm, 80 °C, 30 %, 10 %, 95 %"),
        (NOTE, "largest loss is … flank friction (fluid) … bearing drag",
         "429 W, 100 N·m, 2000 rpm, 40 °C, 98 %, 2 %"),
        (NOTE, "Not modelled: windage", ""),
        # 5 W at 209.4 rad/s to 10 W at 104.7 rad/s
        (NOTE, "load takes … nearest to zero … drag", "0.0239 N·m, 0.0955 N·m, 0 N·m, 100 %"),
        (NOTE, "Warming the oil … lowers the mean loss torque", "40, 80 °C, 50 %"),
        (WARNING, "smallest film ratio … below", "0.50, 100 N·m, 1000 rpm, 80 °C, 1, 8 %"),
        (WARNING, "hotter than the oil data … extrapolated … no prediction",
         "100 °C, 8 %, −50 N·m, 2000 rpm, 40 °C, 150 °C"),
        (GOOD, "No point left", ""),
    ]  # fmt: skip
    rough = loss_map.findings(a_map.assign_attrs(draws=10))[0]
    assert rough.detail.endswith("The ends come from 10 draws, which is rough: take 60 or more.")
    assert_findings(loss_map.findings(a_map), findings)
    heads = ["torque [N·m]", "1000 rpm [N·m]", "2000 rpm [N·m]"]
    tables = {
        f"Loss torque at the pinion [N·m] with oil of {degc} °C": [
            heads,
            *([t, *(part * (0.02 * abs(t) + 10.0 / w) for w in (W, 2.0 * W))]
              for t in (-50.0, 0.0, 100.0)),
        ]
        for degc, part in ((40, 1.0), (80, 0.5))
    } | {
        "Uncertain data and laws": [
            ["input", "known to (95 %)", "moves the loss by [%]", "why"],
            ["viscosity", "factor 1.1", 10.0, "batches"],
            ["bearing drag", "factor 2", 30.0, "not measured"],
        ]
    }  # fmt: skip
    report = loss_map_report(a_map)
    assert_tables(report.tables, tables)
    assert quantities(report.subtitle) == [
        "12",
        "−50.0",
        "100 N·m",
        "1000",
        "2000 rpm",
        "40",
        "80 °C",
    ]
    assert [(one.value, one.unit) for one in report.inputs] == [
        ("an_oil", ""), ("-50 to 100, 3 values", "N·m"), ("1000 to 2000, 2 values", "rpm"),
        ("40 to 80, 2 values", "°C"), ("60", ""), ("1", ""),
    ]  # fmt: skip
    charts = {one.name: one.chart for one in report.figures}
    assert list(charts) == ["loss_torque", "efficiency", "losses", "sensitivity"]
    close = {"rtol": 1e-6}  # charts keep single precision
    np.testing.assert_allclose(charts["sensitivity"].data[0].x, [30.0, 10.0], **close)
    torque = 0.02 * np.array([[50.0], [0.0], [100.0]]) + 10.0 / np.array([W, 2.0 * W])
    efficiency = 100.0 - 100.0 * torque / np.array([[50.0], [np.nan], [100.0]])
    for name, shown in (("loss_torque", torque), ("efficiency", efficiency)):
        np.testing.assert_allclose(charts[name].data[0].z, shown, **close)
    # at 80 degC and 1000 rpm: flanks, bearings, and 0.7 and 1.4 times their sum
    half = np.array([0.5 * 0.02 * W * np.array([50.0, 0.0, 100.0]), [5.0] * 3])
    lines = [half[0], half[1], 0.7 * half.sum(axis=0), 1.4 * half.sum(axis=0)]
    for drawn, shown in zip(charts["losses"].data, lines, strict=False):
        np.testing.assert_allclose(drawn.y, shown, **close)


def test_loss_map_says_failures_films_bulk_steady_oil_and_ranges(a_map):
    sources = ("friction_viscous", "bearing_torque")
    parts = [a_map["loss"].sel(source=one, drop=True) for one in sources]
    marked = xr.zeros_like(parts[0])
    marked[1, 0, 2] = 1.0
    a_map["status"][0, 0, 0], a_map["loss_torque"][0, 0, 0] = 4, np.nan
    a_map["range_exceeded"][0] = 1.0
    a_map["range_exceeded"][0, 0, 1] = 1.0 + 16.0  # torque and film temperature
    a_map["range_exceeded"][1, 0, 0] = 1.0
    a_map["steady_temperature"] = (GRID[1:], np.array([[30.0, 25.0, 60.0], [40.0, np.nan, 90.0]]))
    a_map.attrs |= {
        "ranges_left": "film load (range.film_load)",
        "air_temperature_degc": 20.0,
        "film_model_flank": "mine",
        "film_model_roller": "yours",
    }
    full = a_map.assign(
        friction_bound=0.07 * parts[0],
        share_outside=0.3 * marked,
        efficiency_bound=0.0004 * marked,
        drag_bound=0.03 * parts[1],
        rollers_outside=0.2 * marked,
        bulk_temperature=a_map["temperature"] + 12.0 * marked,
    )
    at = "100 N·m, 1000 rpm, 80 °C"
    expected = [
        (WARNING, "failed … no equilibrium", "1, 12, 4"),
        *(None,) * 6,
        (WARNING, "flanks are those of solved films … efficiency … flanks' load … Model: mine",
         f"95 %, 7.0 %, 0.040 %, 30 %, {at}, 5 %, 1, 12, 70 %"),
        (WARNING, "rollers are those of solved films … bearings' drag loss … Model: yours",
         f"95 %, 3.0 %, 20 %, {at}, 5 %, 1, 12, 80 %"),
        (NOTE, "warms their bulk by up to", f"12 K, {at}"),
        (NOTE, "steady oil temperature is between … with air of", "25, 90 °C, 20 °C"),
        (WARNING, "reach no steady temperature", "1, 6"),
        # 7 of 12 points; without: 2 torques, 2 speeds, the warmer oil
        (WARNING, "are extrapolated. Usable for … not for 40 °C … torque (the mesh table ends) at "
         "… film temperature (the oil",
         "58 %, 0, 100 N·m, 1000, 2000 rpm, 80 °C, 33 %, 40 °C, 58 %, 8 %"),
    ]  # fmt: skip
    found = loss_map.findings(full)
    assert_findings([found[1], *found[7:]], [expected[0], *expected[7:]])
    little = full.assign(share_outside=0.05 * marked)
    (solved,) = [f for f in loss_map.findings(little) if "(film.model = solved)" in f.headline]
    assert solved.level == NOTE  # up to 5 % outside count as solved films
    assert "known to (95 %)" in report_html(loss_map_report(full))


@pytest.mark.parametrize(("fast", "level"), [(45.0, NOTE), (46.0, WARNING)])
def test_loss_map_says_where_churning_changes_its_formula(a_map, fast, level):
    # a step above 3 times 2^1.6 = 9.09, at twice the speed, is a warning
    churning = xr.zeros_like(a_map["loss"].isel(source=[0])).assign_coords(source=["churning"])
    churning[1, :, 1, 0] = [5.0, fast]
    stirred = xr.concat([a_map["loss"], churning], "source").transpose(*GRID, "source")
    regime = (GRID[:2], [[0.0, 0.0], [0.0, 1.0]])
    found = loss_map.findings(
        a_map.drop_vars(["loss", "source"]).assign(loss=stirred, churning_regime=regime)
    )
    (one,) = [one for one in found if "regime" in one.headline]
    numbers = f"1000, 2000 rpm, 80 °C, 5.00 W, {fast:.1f} W"
    assert_findings([one], [(level, "changes its regime between … rises from", numbers)])


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
            "pinion_speed": ("step", [230.0, 460.0, 0.0]),
            "wheel_torque": ("step", [50.0, 100.0, 0.0]),
            "brake_power": ("step", [0.0, 0.0, 1200.0]),
            "loss": (("step", "source"), loss),
            "outside_range": (("step", "range"), zeros),
            "time_outside_range": ("range", [0.0]),
            "energy_outside_range": ("range", [0.0]),
            "energy_in": 80.0,
            "energy_in_pinion": 70.0,
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


def test_cycle_has_its_known_key_numbers_findings_tables_and_rows(a_cycle):
    numbers = [
        ("energy lost in the axle", 4.0, "kJ", "4.000"),
        ("energy lost in the axle, in Wh", 4.0 / 3.6, "Wh", "1.111"),
        ("energy lost in the axle, low end", 3.5, "kJ", "3.500"),
        ("energy lost in the axle, high end", 4.5, "kJ", "4.500"),
        ("energy into the axle", 80.0, "kJ", "80.00"),
        ("efficiency over the cycle", 95.0, "%", "95.00"),
        ("oil at the end", 25.0, "°C", "25.0"),
        ("warmest oil", 26.0, "°C", "26.0"),
        ("lost by flank friction (fluid)", 3.0, "kJ", "3.00"),
        ("lost by bearing drag", 1.0, "kJ", "1.00"),
    ]
    assert_numbers(cycle.numbers(a_cycle), numbers)
    findings = [
        (NOTE, "axle loses … flank friction (fluid) 75 %, bearing drag 25 % … conductances",
         "4.00 kJ, 1.11 Wh, 5.0 %, 75 %, 25 %, 3.50, 4.50 kJ"),
        (NOTE, "The oil goes from … it ends between … air is at",
         "20, 25 °C, 23, 29 °C, 19 °C"),
        (NOTE, "friction brakes take", "12.0 kJ, 0.25"),
        (GOOD, "No step left", ""),
        (NOTE, "Not modelled: windage", ""),
    ]  # fmt: skip
    assert_findings(cycle.findings(a_cycle), findings)
    report = cycle_report(a_cycle)
    tables = {
        "Energy lost by source": [
            ["source", "energy [kJ]", "energy [Wh]", "share [%]"],
            ["flank friction (fluid)", 3.0, 3.0 / 3.6, 75.0],
            ["bearing drag", 1.0, 1.0 / 3.6, 25.0],
            ["all", 4.0, 4.0 / 3.6, 100.0],
        ],
        "Ranges": [
            ["range of a formula or table", "running time outside [%]", "energy lost outside [%]"],
            ["torque (the mesh table ends)", 0.0, 0.0],
        ],
    }
    assert_tables(report.tables, tables)
    assert "30 s and 0.30 km" in report_html(report)  # 10 s at 10 m/s and 10 s at 20 m/s
    assert [(one.value, one.unit) for one in report.inputs] == [
        ("made", ""), ("20", "°C"), ("19", "°C"), ("0.25", ""), ("30", "N·m"), ("18000", "J/K"),
        ("7", "W/K"), ("18", "W/K"),
    ]  # fmt: skip
    drawn = {figure.name: [one.y for one in figure.chart.data] for figure in report.figures}
    shown = {
        "demand": [[36.0, 72.0, 0.0], [20.0, 40.0, 0.0]],
        "losses": [[100.0, 200.0, 0.0], [50.0, 50.0, 0.0]],
        "temperature": [[20.0, 22.0, 26.0, 25.0], [20, 21, 24, 23], [20, 23, 28, 29]],
    }
    for name, lines in shown.items():
        np.testing.assert_array_equal(drawn[name], lines)
    head, rows = series_rows(a_cycle)
    assert ",".join(head) == (
        "time_s,step_s,vehicle_speed_kmh,pinion_speed_rpm,pinion_torque_n_m,wheel_torque_n_m,"
        "brake_power_w,loss_friction_viscous_w,loss_bearing_torque_w,oil_temperature_at_end_degc"
    )
    assert [",".join(row) for row in rows] == [
        "5,10,36,230,20,50,0,100,50,22",
        "15,10,72,460,40,100,0,200,50,26",
        "25,10,0,0,0,0,1200,0,0,25",
    ]


def test_cycle_with_draws_has_their_error_bars_and_what_left_a_range(a_cycle):
    drawn = a_cycle.assign(
        efficiency_low=0.94,
        efficiency_high=0.96,
        end_temperature_low=22.0,
        end_temperature_high=31.0,
        time_outside_range=("range", [0.25]),
        energy_outside_range=("range", [0.625]),  # 2.5 of 4 kJ
        outside_range=(("step", "range"), [[0.0], [1.0], [0.0]]),  # at 72 km/h
    ).assign_attrs(ranges_left="torque (range.torque)", trace_notes="A note.\nAnother.")
    lost, oil, _, left, *notes = cycle.findings(drawn)
    draws = "uncertain data of axle and heat (95 % of the draws)"
    expected = [
        (NOTE, draws, "4.00 kJ, 1.11 Wh, 5.0 %, 75 %, 25 %, 95 %, 3.50, 4.50 kJ"),
        (NOTE, f"{draws} it ends between", "20, 25 °C, 95 %, 22, 31 °C, 19 °C"),
        (
            WARNING,
            "of the energy is lost outside … Usable for … not for … of the running time",
            "62 %, 70 km/h, 0 %, 100 %, 25 %, 62 %",
        ),
        (WARNING, "A note.", ""),
        (WARNING, "Another.", ""),
        (NOTE, "Not modelled", ""),
    ]
    assert_findings([lost, oil, left, *notes], expected)
    assert [",".join(row) for row in summary_rows(drawn)] == [
        "energy into the axle,80,kJ,,",
        "energy into the axle,22.2222,Wh,,",
        "of this by the pinion,70,kJ,,",
        "of this by the pinion,19.4444,Wh,,",
        "energy lost,4,kJ,3.5,4.5",
        "energy lost,1.11111,Wh,0.972222,1.25",
        "lost by flank friction (fluid),3,kJ,,",
        "lost by flank friction (fluid),0.833333,Wh,,",
        "lost by bearing drag,1,kJ,,",
        "lost by bearing drag,0.277778,Wh,,",
        "energy to the friction brakes,12,kJ,,",
        "energy to the friction brakes,3.33333,Wh,,",
        "efficiency,0.95,1,0.94,0.96",
        "efficiency as one number,0.833925,1,,",  # 20.0855 kJ to the wheels of 24.0855 kJ
        "oil temperature at the end,25,degC,22,31",
        "share of the running time outside range.torque,0.25,1,,",
        "share of the energy lost outside range.torque,0.625,1,,",
    ]
    assert [row[3:] for row in summary_rows(a_cycle)][13:15] == [("", ""), ("23", "29")]


def test_cycle_says_how_far_solved_films_are_to_be_trusted(a_cycle):
    # of 3 kJ of friction, 1 in the first step and 2 in the second; of 1 kJ of drag, a half in each
    solved = a_cycle.assign(
        share_outside=("step", [0.09, 0.0, 1.0]),
        energy_lost_bound=0.06,
        efficiency_bound=0.00075,
        rollers_outside=("step", [0.0, 1.0, 0.0]),
        energy_drag_bound=0.05,
        drag_bound=("step", [2.5, np.nan, 0.0]),
    )
    # bounds of the steps whose load lies inside alone
    solved["friction_bound"] = (0.02 * flank_friction(a_cycle["loss"])).where([False, True, False])
    expected = [
        (NOTE, "flanks are … efficiency over the cycle … with … flanks' friction loss",
         "95 %, 2.0 %, 0.060 kJ, 0.075 %, 3.0 %, 5 %, 2, 3, 0, 91 %"),
        (WARNING, "rollers are … of energy lost … bearings' drag loss",
         "95 %, 5.0 %, 0.050 kJ, 50.0 %, 5 %, 1, 3, 0 %"),
    ]  # fmt: skip
    assert_findings(cycle.findings(solved)[3:5], expected)
    more = solved.assign(share_outside=("step", [0.3, 0.0, 0.0]))
    assert cycle.findings(more)[3].level == WARNING
