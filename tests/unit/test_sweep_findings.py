"""Findings of a sweep against a dataset whose numbers are written down."""

import math

import numpy as np
import pytest
import xarray as xr

from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.sweep import datasets
from gearlube.studies.sweep.datasets import merge
from gearlube.studies.sweep.findings import findings
from gearlube.studies.sweep.peaks import crossings, numbers, peak_orders
from gearlube.studies.sweep.point import failed_point
from gearlube.studies.sweep.report import sweep_report, tables
from gearlube.studies.sweep.settings import SweepSettings, quick_sweep_settings
from tests.helpers import sweep_stand_in as stand_in
from tests.helpers.known_answers import assert_findings, assert_numbers, assert_tables, quantities

SPEEDS, PRELOAD = [20.0, 60.0, 100.0], 2500.0


def mesh_hz(speed_kmh):
    return stand_in.TEETH * stand_in.pinion_speed_at(speed_kmh) / (2.0 * math.pi)


@pytest.fixture(scope="module")
def sweep():
    settings = quick_sweep_settings(SweepSettings())
    points = {(v, PRELOAD): stand_in.point(None, v, PRELOAD, settings) for v in SPEEDS}
    dataset = merge([PRELOAD], SPEEDS, points)
    modes = [1.05 * mesh_hz(60.0), 3.0 * mesh_hz(110.0)]
    dataset["mode_frequency"] = (("preload", "mode"), np.array([modes]))
    return dataset.assign_coords(mode=["gear axial", "mesh"]).assign_attrs(title="Speed sweep")


def found(dataset, words):
    (one,) = [one for one in findings(dataset) if words in one.headline]
    return one


def test_largest_mesh_order_is_the_one_put_in_and_its_place_is_told(sweep):
    # the signal has 1 um of order 1 and 0.3 um of order 2 at every speed; 60 km/h gets twice that
    louder = sweep.copy(deep=True)
    louder["dte_spectrum"][0, 1] *= 2.0
    one = found(louder, "largest mesh order")
    assert "order 1: 2.00 µm at 60 km/h" in one.headline
    assert f"({mesh_hz(60.0):.0f} Hz)" in one.headline
    assert "order 2 0.600 µm at 60 km/h" in one.detail
    assert one.level == WARNING  # the mode lies 5 % above
    assert "5 % below the nearest natural frequency, 'gear axial'" in one.detail
    assert [p.order for p in peak_orders(louder)] == [1, 2, 3]


def test_a_resonance_of_the_car_is_named_with_what_the_order_is_without_it(sweep):
    springs = ["mesh", "bearings", "propshaft", "half-shafts"]
    strain = [[0.1, 0.2, 0.6, 0.1], [0.9, 0.1, 0.0, 0.0]]
    coupled = sweep.assign(
        mode_strain=(("mode", "spring"), strain), dte_order_held=0.25e-6
    ).assign_coords(spring=springs)
    detail = found(coupled, "largest mesh order").detail
    assert "70 % of its strain energy is in springs of the car, most in the propshaft." in detail
    assert "0.250 µm there, 4.0 times less" in detail  # the signal has 1 um of order 1
    assumed = coupled.assign_attrs(inputs_assumed="driveline.propshaft_stiffness_n_m_per_rad = 3e4")
    assert "whose stiffnesses are assumed" in found(assumed, "largest mesh order").detail
    of_axle = coupled.assign(mode_strain=(("mode", "spring"), strain[::-1]))
    assert "springs of the car" not in found(of_axle, "largest mesh order").detail


def test_a_peak_between_distant_speeds_says_that_it_may_be_larger(sweep):
    # 60 km/h has its neighbours at 20 and 100 km/h
    assert "up to 40 km/h apart here" in found(sweep, "largest mesh order").detail


def test_a_peak_away_from_every_mode_is_no_warning(sweep):
    apart = sweep.assign(mode_frequency=2.5 * sweep["mode_frequency"])
    above = sweep.assign(mode_frequency=0.75 * sweep["mode_frequency"])
    assert "% above the nearest natural frequency" in found(above, "largest mesh order").detail
    assert found(apart, "largest mesh order").level == NOTE
    assert found(sweep.drop_vars("mode_frequency"), "largest mesh order").level == NOTE


def test_orders_meet_natural_frequencies_where_their_frequencies_are_equal(sweep):
    by_order = {(c.mode, c.order): c for c in crossings(sweep)}
    for order in (1, 2, 3):
        # f_m is in proportion to speed
        assert by_order["gear axial", order].speed_kmh == pytest.approx(63.0 / order, rel=1e-4)
    assert by_order["mesh", 3].speed_kmh == pytest.approx(110.0, rel=1e-4)
    assert by_order["mesh", 3].margin == pytest.approx(10.0 / 110.0, rel=1e-3)
    assert by_order["mesh", 1].margin == pytest.approx(230.0 / 330.0, rel=1e-3)
    one = found(sweep, "meet natural frequencies")
    assert "3 times between 20 and 100 km/h; 1 of these are order 1" in one.headline
    assert "at 63 km/h" in one.detail


def test_margin_is_told_where_no_order_meets_a_mode(sweep):
    far = sweep.assign(mode_frequency=sweep["mode_frequency"].isel(mode=[1]))
    one = found(far, "the smallest margin is 9 %")
    assert one.level == NOTE  # below 10 %
    farther = far.assign(mode_frequency=2.0 * far["mode_frequency"])
    assert found(farther, "the smallest margin is 55 %").level == GOOD  # (220 - 100) / 220


def test_film_contact_and_rollers_have_the_levels_of_their_numbers(sweep):
    film = found(sweep, "smallest film ratio")
    assert "is 1.0, at" in film.headline  # 1.1 - 0.1
    assert film.level == NOTE
    assert found(sweep.assign(film_ratio_min=sweep["film_ratio_min"] * 0.5), "ratio").level == (
        WARNING
    )
    assert found(sweep.assign(film_ratio_min=sweep["film_ratio_min"] * 4.0), "ratio").level == GOOD
    assert found(sweep, "stay in contact").level == GOOD
    apart = sweep.copy(deep=True)
    apart["separation"][0, 0] = 1
    apart["separation"][0, 2] = 2
    apart["separated_fraction"][0, 2] = 0.25
    one = found(apart, "teeth separate")
    assert "at 2 of 3 points: 20, 100 km/h" in one.headline
    assert "At most 25 % of the time" in one.detail
    assert "At 1 points the coast flanks come into contact too" in one.detail
    free = sweep.copy(deep=True)
    free["bearing_roller_load_min"][:] = 5.0
    assert found(free, "Every roller stays loaded: at least 5.00 N").level == GOOD
    free["bearing_roller_load_min"][0, 1, 3] = 0.0
    assert "at 1 of 3 points: 60 km/h" in found(free, "Rollers leave").headline


def test_ranges_balance_and_failed_points(sweep, monkeypatch):
    assert found(sweep, "No finished point left").level == GOOD
    left = sweep.copy(deep=True)
    left["range_exceeded"][0, 1] = 2
    assert "1 of 3 points left" in found(left, "left the range").headline
    assert found(sweep, "energy balance closes").level == GOOD
    opened = sweep.copy(deep=True)
    opened["energy_closure_error"][0, 1] = -0.02
    assert "up to 20000 ppm" in found(opened, "energy balance has an error").headline
    failed = merge([PRELOAD], [20.0], {(20.0, PRELOAD): failed_point(20.0, PRELOAD, "no")})
    for indexed in (failed, failed.set_xindex("speed_kmh")):
        monkeypatch.setattr(datasets, "read_dataset", lambda _, one=indexed: one)
        loaded = datasets.load_sweep("sweep.nc")
        assert "speed_kmh" in loaded.xindexes
        at = loaded.sel(speed_kmh=20.0, preload=PRELOAD)
        assert float(at["speed"]) == pytest.approx(20.0 / 3.6)
    (only,) = findings(failed)
    assert only.headline == "1 of 1 points failed."
    assert numbers(failed) == []


# (preload, speed) or (preload, speed, ...), two of each; no two values alike
GRID = {
    "mesh_frequency": [[100.0, 300.0], [100.0, 300.0]],
    "dte_min": [[3.1e-6, 2.9e-6], [2.3e-6, 1.9e-6]],
    "dte_max": [[8.3e-6, 8.9e-6], [9.7e-6, 10.1e-6]],
    "dte_pp": [[5e-6, 11e-6], [7e-6, 3e-6]],
    "separation": [[0, 0], [0, 0]],
    "radial_pp": [[0.41e-6, 0.43e-6], [0.47e-6, 0.53e-6]],
    "pinion_torque": [[59.0, 61.0], [67.0, 71.0]],
    "wheel_torque": [[73.0, 79.0], [83.0, 89.0]],
    "mesh_force_mean": [[1009.0, 1013.0], [1019.0, 1021.0]],
    "dynamic_factor": [[1.11, 1.13], [1.17, 1.19]],
    "roller_load_min": [[101.0, 103.0], [107.0, 109.0]],
    "roller_load_max": [[501.0, 503.0], [507.0, 509.0]],
    "oil_temperature": [[313.15, 323.15], [333.15, 343.15]],
    "film_thickness_min": [[0.23e-6, 0.29e-6], [0.31e-6, 0.37e-6]],
    "film_ratio_min": [[1.3, 1.7], [0.7, 1.9]],
    "flank_temperature_max": [[374.15, 376.15], [380.15, 382.15]],
    "efficiency_mesh": [[0.987, 0.983], [0.981, 0.979]],
    "efficiency_axle": [[0.95, 0.97], [0.96, 0.93]],
    "energy_closure_error": [[1e-5, -3e-5], [2e-5, 0.5e-5]],
    "range_exceeded": [[0.0, 0.0], [0.0, 0.0]],
    "separated_fraction": [[0.0, 0.0], [0.0, 0.0]],
    "status": [[1, 1], [1, 1]],
}
LOSS = [[[100.0, 20.0], [310.0, 70.0]], [[170.0, 30.0], [290.0, 130.0]]]
DTE = [[[0.0, 2.0, 0.3, 0.05], [0.0, 3.0, 0.5, 0.07]], [[0.0, 1.1, 0.2, 0.03], [0, 7.0, 0.4, 0.02]]]
FORCE = [[[0.0, 11, 13, 17], [0, 19, 23, 29]], [[0.0, 31, 37, 41], [0, 43, 47, 53.0]]]


def made(**changes):
    """Return a sweep of two preloads and two speeds, 5 Hz of the mesh a km/h."""
    data = {name: (("preload", "speed"), one) for name, one in (GRID | changes).items()}
    data["loss"] = (("preload", "speed", "source"), LOSS)
    bins = ("preload", "speed", "bin")
    data["frequency"] = (bins, [[[0.0, 100, 200, 300], [0, 300, 600, 900]]] * 2)
    data["dte_spectrum"] = (bins, 1e-6 * np.array(DTE))
    data["bearing_force_spectrum"] = (bins, FORCE)
    least = [[[13.0, 17.0], [19.0, 23.0]], [[29.0, 31.0], [37.0, 41.0]]]
    data["bearing_roller_load_min"] = (("preload", "speed", "bearing"), least)
    data["bearing_roller_load_max"] = (("preload", "speed", "bearing"), 10.0 * np.array(least))
    data["mode_frequency"] = (("preload", "mode"), [[310.0, 2000.0], [330.0, 2100.0]])
    return xr.Dataset(
        data,
        coords={
            "preload": [1000.0, 2000.0],
            "speed_kmh": ("speed", [20.0, 60.0]),
            "mode": ["axial", "mesh"],
            "source": ["friction_viscous", "bearing_torque"],
        },
    )


def test_a_sweep_has_its_known_key_numbers_and_findings():
    known = [
        ("largest mesh order of the transmission error, amplitude", 7.0, "µm", "7.00"),
        ("largest mesh order of the transmission error, order", 1, "", "1"),
        ("largest mesh order of the transmission error, at", 60.0, "km/h", "60"),
        ("largest mesh order of the bearing forces, amplitude", 53.0, "N", "53.0"),
        ("largest mesh order of the bearing forces, order", 3, "", "3"),
        ("largest mesh order of the bearing forces, at", 60.0, "km/h", "60"),
        ("largest transmission error, peak to peak", 11.0, "µm", "11.0"),
        ("least efficiency of the axle", 93.0, "%", "93.00"),
        ("best efficiency of the axle", 97.0, "%", "97.00"),
        ("largest loss", 290.0 + 130.0, "W", "420"),
        ("least film on a flank", 0.23, "µm", "0.230"),
        ("least film ratio", 0.7, "", "0.70"),
        ("largest roller load", 410.0, "N", "410"),
        ("least roller load", 13.0, "N", "13.0"),
        ("warmest flank film", 382.15 - 273.15, "°C", "109"),
    ]
    assert_numbers(numbers(made()), known)
    expected = [
        (NOTE, "Bearing 1 shakes … mesh order 3",
         "1, 3, 53.0 N, 60 km/h, 900 Hz, 2000 N, 40 km/h"),
        (WARNING, "is order 1 … The others: … below the nearest … 'axial' … resonance … apart here",
         "1, 7.00 µm, 60 km/h, 300 Hz, 2000 N, 2, 0.500 µm, 60 km/h, 3, 0.0700 µm, 60 km/h, "
         "9 %, 330 Hz, 40 km/h"),  # 300 to 330
        (GOOD, "stay in contact", "1.90 µm"),
        # 310 Hz over 5 Hz per km/h: 62, 31 and 20.7 km/h
        (NOTE, "meet natural frequencies … order 3 with 'axial' … order 2 with 'axial'",
         "1, 3, 2, 20, 60 km/h, 0, 1, 1000 N, 3, 310 Hz, 21 km/h, 2, 310 Hz, 31 km/h"),
        (NOTE, "largest loss … flank friction (fluid) … bearing drag … efficiency … windage",
         "420 W, 60 km/h, 2000 N, 69 %, 31 %, 93.0, 97.0 %"),
        (WARNING, "smallest film ratio … Below 1", "0.70, 20 km/h, 2000 N, 0.310 µm, 1"),
        (GOOD, "Every roller stays loaded: at least", "13.0 N, 410 N"),
        (GOOD, "No finished point left", ""),
        (GOOD, "energy balance closes", "30 ppm"),
    ]  # fmt: skip
    assert_findings(findings(made()), expected)


def test_a_sweep_has_its_known_tables():
    where = [
        (row, k, p, v) for row, p in enumerate((1000.0, 2000.0)) for k, v in ((0, 20.0), (1, 60.0))
    ]

    def table(heads, *columns):
        """Rows of preload, speed and the named columns in their shown units."""
        rows = [[p, v, *(shown(row, k) for shown in columns)] for row, k, p, v in where]
        return [["preload [N]", "speed [km/h]", *heads], *rows]

    def of(name, factor=1.0, shift=0.0):
        return lambda row, k: factor * GRID[name][row][k] + shift

    orders = [lambda row, k, n=n: DTE[row][k][n] for n in (1, 2, 3)]
    celsius = {"shift": -273.15}
    expected = {
        "Natural frequencies, and the speeds at which mesh orders meet them": [
            ["mode", "preload 1000 N [Hz]", "preload 2000 N [Hz]",
             *(f"order {n} meets it at [km/h]" for n in (1, 2, 3))],
            ["axial", 310.0, 330.0, 62.0, 31.0, 62.0 / 3.0],
            ["mesh", 2000.0, 2100.0, 400.0, 200.0, 400.0 / 3.0],
        ],
        "Points: vibration": table(
            ["mesh frequency [Hz]", "DTE least [µm]", "DTE largest [µm]", "DTE peak to peak [µm]",
             "order 1 [µm]", "order 2 [µm]", "order 3 [µm]", "separation",
             "radial, peak to peak [µm]"],
            of("mesh_frequency"), *(of(f"dte_{one}", 1e6) for one in ("min", "max", "pp")),
            *orders, lambda *_: "none", of("radial_pp", 1e6),
        ),
        "Points: loads": table(
            ["pinion torque [N·m]", "wheel torque [N·m]", "mean mesh force [N]", "dynamic factor",
             "roller 1 least [N]", "roller 1 largest [N]"],
            *map(of, ("pinion_torque", "wheel_torque", "mesh_force_mean", "dynamic_factor",
                      "roller_load_min", "roller_load_max")),
        ),
        "Points: films and losses": table(
            ["oil [°C]", "film least [µm]", "film ratio λ least", "flank film warmest [°C]",
             "efficiency mesh [%]", "efficiency axle [%]", "losses [W]", "ranges left",
             "energy balance [ppm of input]"],
            of("oil_temperature", **celsius), of("film_thickness_min", 1e6), of("film_ratio_min"),
            of("flank_temperature_max", **celsius), of("efficiency_mesh", 100.0),
            of("efficiency_axle", 100.0), lambda row, k: sum(LOSS[row][k]), of("range_exceeded"),
            of("energy_closure_error", 1e6),
        ),
    }  # fmt: skip
    assert_tables(tables(made()), expected)


def test_a_sweep_with_solved_films_says_how_far_they_are_to_be_trusted():
    # 7 % of 870 W of friction and 3 % of 250 W of drag
    solved = made(
        friction_loss_bound=[[10.0, 20.0], [15.0, 15.9]],
        share_outside=[[0.0, 0.04], [0.02, 0.01]],
        efficiency_bound=[[1e-4, 2e-4], [4e-4, 3e-4]],
        drag_bound=[[1.0, 2.5], [1.5, 2.5]],
        rollers_outside=[[0.1, 0.0], [0.2, 0.15]],
    ).assign_attrs(film_model_flank="mine", film_model_roller="yours")
    expected = [
        (NOTE, "flanks are those of solved films … efficiency … flanks' load … Model: mine",
         "95 %, 7.0 %, 0.040 %, 4 %, 60 km/h, 1000 N"),
        (WARNING, "rollers are those of solved films … rollers' load … Model: yours",
         "95 %, 3.0 %, 20 %, 20 km/h, 2000 N, 5 %, 3, 4, 80, 90 %"),
    ]  # fmt: skip
    assert_findings(findings(solved)[6:8], expected)


@pytest.mark.parametrize(
    ("state", "shown"),
    [
        ("constant", [("oil temperature", "80.0", "°C")]),
        ("steady", [("air temperature", "20.0", "°C"), ("conductance at rest", "7", "W/K")]),
    ],
)
def test_the_report_of_a_sweep_says_what_was_set(state, shown):
    settings = {
        "title": "Speed sweep",
        "axle": "made",
        "setting_oil_state": state,
        "setting_oil_temperature": 353.15,
        "setting_air_temperature": 293.15,
        "setting_conductance_at_rest": 7.0,
        "setting_roughness_rms": 5e-7,
        "setting_communication_step": 1e-4,
        "setting_driver": "vehicle",
        "inputs_given": '[["oil", "an_oil", "", "given", ""]]',
        "wall_time": 12.34,
        "computed_points": 3,
    }
    report = sweep_report(made().assign_attrs(settings), entries=())
    assert quantities(report.subtitle) == ["2", "20", "60 km/h", "1000", "2000 N", "4", "4"]
    assert [(one.name.removeprefix("sweep: "), one.value, one.unit) for one in report.inputs] == [
        ("oil state", state, ""),
        *shown,
        ("roughness rms", "0.5", "µm"),
        ("communication step", "0.1", "ms"),
        ("driver", "vehicle", ""),
        ("oil", "an_oil", ""),
    ]
    facts = dict(report.facts)
    assert facts["points"] == "4 of 4 finished"
    assert facts["time"] == "12.3 s for 3 computed points"


def test_the_largest_loss_carries_its_band():
    lost = made()["loss"].sum("source")
    sweep = made().assign(loss_low=0.5 * lost, loss_high=2.0 * lost)
    (tile,) = [one for one in numbers(sweep) if one.name == "largest loss"]
    assert tile.band == (210.0, 840.0)
    assert "420 W (95 %: 210 to 840 W)" in " ".join(one.headline for one in findings(sweep))
