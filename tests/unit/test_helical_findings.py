"""Findings and report of a helical study."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from gearlube.plotting.style import new_figure
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.helical.figures.layout import stems
from gearlube.studies.helical.findings import findings, largest_error, least_unstable, meeting
from gearlube.studies.helical.report import _critical_speeds, _inputs, _losses, numbers
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.studies.helical.summary import losses_rows, summary_rows
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.helical_results import (
    RPM,
    TEETH,
    contact,
    everything,
    film,
    losses,
    response,
    separation,
    stability,
    sweep,
)
from tests.helpers.known_answers import assert_cells, assert_findings, assert_numbers, assert_tables


def hot_losses(rise):
    """Two torques and speeds in oil of 90 degC; the film of one point is warmer."""
    grid = ("temperature", "torque", "speed")
    return xr.Dataset(
        {
            "loss": ((*grid, "part"), np.ones((1, 2, 2, 2))),
            "efficiency": (grid, np.full((1, 2, 2), 0.99)),
            "temperature_rise": (grid, np.array([[[5.0, 8.0], [7.0, rise]]])),
        },
        coords={"temperature": [90.0], "torque": [50.0, 200.0], "speed": [1000.0, 9000.0],
                "part": ["sliding", "rolling"]},
        attrs={"not_modelled": "bearings", "oil_data_high_degc": 150.0, "pinion_torque": 50.0,
               "pinion_speed": 1000.0 * RPM, "loads": "static, constant density"},
    )  # fmt: skip


def test_a_film_hotter_than_the_oil_data_is_a_warning_in_losses_and_in_operation():
    hot = [one for one in findings({"losses": hot_losses(383.0)}) if "hotter than" in one.headline]
    assert [one.level for one in hot] == [WARNING]
    assert "at 25 % of the points" in hot[0].headline  # one of four
    assert "at 200 N·m, 9000 rpm and 90 °C oil: 473 °C" in hot[0].detail  # 90 + 383
    assert "no prediction. Usable for 50 N·m, 1000 to 9000 rpm, 90 °C" in hot[0].detail
    assert not [one for one in findings({"losses": hot_losses(59.0)}) if "film" in one.headline]
    (said,) = (one for one in findings({"film": film(2.0, 75.0)}) if "hotter than" in one.headline)
    assert "at 33 % of the points" in said.headline
    assert "155 °C" in said.detail
    assert not [one for one in findings({"film": film(2.0)}) if "hotter than" in one.headline]


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


def test_a_study_has_its_known_key_numbers_with_the_same_names_in_every_run():
    expected = [
        ("power lost in the mesh", 19.0, "W", "19.0"),
        # 19 W of 200 N.m at 100 pi rad/s
        ("efficiency of the mesh", 100.0 - 0.095 / np.pi, "%", "99.97"),
        ("mean coefficient of friction", 0.04, "", "0.0400"),
        ("dynamic transmission error in operation", 0.3, "µm", "0.300"),
        ("number of the largest mesh order, in operation", 2, "", "2"),
        ("largest dynamic transmission error in the sweep", 1.5, "µm", "1.50"),
        ("number of the largest mesh order, in the sweep", 2, "", "2"),
        ("speed of the largest mesh order, in the sweep", 2000.0, "rpm", "2000"),
        ("mean mesh stiffness", 500.0, "N/µm", "500"),
        ("loaded transmission error, peak to peak", 0.4, "µm", "0.400"),
        ("highest pressure", 1.4, "GPa", "1.40"),
        ("longest time without contact", 25.0, "%", "25.0"),
        ("least unstable factor on the swing of the stiffness", 2.0, "", "2.00"),
    ]
    assert_numbers(numbers(everything()), expected)
    none = [(name, np.nan, unit, "–") for name, _, unit, _ in expected]
    assert_numbers(numbers({}), none)
    # no number of a sharp edge: its pressure rises with finer cells
    pressed = {one.name: one.value for one in numbers({"contact": contact(4.0e9)})}
    assert np.isnan(pressed["highest pressure"])


def test_the_band_of_the_losses_stands_in_finding_key_numbers_and_table():
    torque = losses()["loss"].sum("part") / (losses()["speed"] * RPM)
    of = losses().assign(loss_torque_low=0.5 * torque, loss_torque_high=2.0 * torque)
    said = findings({"losses": of})[0].headline
    # 100 - 100 of 38 and 9.5 W over 62.8 kW
    assert "lose 19.0 W (9.50 to 38.0) and are 99.97 % (99.94 to 99.98) efficient" in said
    power, efficiency = numbers({"losses": of})[:2]
    np.testing.assert_allclose(power.band, (9.5, 38.0), rtol=1e-12)
    np.testing.assert_allclose(efficiency.band, (99.93952, 99.98488), rtol=1e-7)
    row = _losses(of.sel(temperature=[40.0])).rows[-1]
    assert row[3:6] == pytest.approx([19.0, 9.5, 38.0])
    assert row[7:10] == pytest.approx([99.96976, 99.93952, 99.98488], rel=1e-7)


def test_of_many_losses_those_at_the_torque_in_operation_are_listed():
    """Of four points three fit: those at 50 N.m, with the 1000 rpm in operation."""
    rows = losses_rows(hot_losses(59.0), 3)
    assert [(float(one["torque"]), float(one["speed"])) for one in rows] == [(50, 1000), (50, 9000)]


def test_a_study_has_its_known_findings():
    said = [
        (NOTE, "teeth lose … efficient … Sliding makes 75 % of it … most over all … windage",
         "200 N·m, 3000 rpm, 40 °C, 19.0 W, 99.97 %, 75 %, 60.0 W, 200 N·m, 3000 rpm, 90 °C"),
        (NOTE, "At … the largest order … oil film", "1000 rpm, 0.300 µm, 2, 1.00 kHz"),
        (GOOD, "mesh order … is … below the natural frequency … nearest",
         "1000 rpm, 3, 50.0 %, 3.00 kHz, 1, 3, 10 %"),
        (NOTE, "Over the sweep the largest order … below the natural frequency … oil film",
         "1.50 µm, 2, 2000 rpm, 10 %, 2000 rpm, 2.00 kHz, 50.0 %, 4.00 kHz, 1000, 3000 rpm"),
        (WARNING, "teeth separate from … folds: the motion jumps",
         "5000, 5000 rpm, 0.05, 25 %, 5000 rpm, 0.05, 2"),
        (GOOD, "No sharp edge presses", "200 N·m, 1.40 GPa, 2.5 GPa"),
        (GOOD, "Parametric instability begins at … itself is stable", "2"),
        (NOTE, "smallest film ratio … mean coefficient of friction … loses … roughness",
         "1.30, 0.0400, 150 W, 0.5 µm, 80 °C, 3"),
    ]  # fmt: skip
    assert_findings(findings(everything()), said)
    own = everything()["sweep"].assign(film_share_outside=("speed", [0.0, 0.3, 0.2]))
    said = [said[3], (WARNING, "in part, are by formulas", "2, 3, 2000, 3000 rpm, 70, 80 %, 95 %")]
    assert_findings(findings({"sweep": own}), said)


def test_solved_films_of_a_study_say_how_far_they_are_to_be_trusted():
    of = film(3.2).assign_attrs(
        film_model="solved",
        film_model_line="mine",
        operating_share_outside=0.03,
        operating_power_loss_bound=4.5,
        operating_efficiency_bound=0.0007,
        pinion_speed=1200.0 * RPM,
    )
    said = [
        (NOTE, "are those of solved films … efficiency … of the load … Model: mine",
         "95 %, 3.0 %, 4.5 W, 0.070 %, 3 %")
    ]  # fmt: skip
    assert_findings(findings({"film": of})[1:], said)
    beyond = of.assign_attrs(operating_share_outside=0.4)
    said = [(WARNING, "by formulas", "1, 1, 1200, 1200 rpm, 60 %, 95 %")]
    assert_findings(findings({"film": beyond})[1:], said)
    outside = [[[0.0, 0.01], [0.02, 0.5]], [[0.0, 0.0], [0.3, 0.04]]]
    said = [
        # 4 % of 60 W at the bound, over the 75 % that slide
        (NOTE, "solved films at … Model: mine", "6, 8, 95 %, 5.3 %, 4.0 %"),
        (WARNING, "Losses are by formulas", "2, 8, 1000, 3000 rpm, 50, 70 %, 95 %"),
    ]
    assert_findings(findings({"losses": losses(outside)})[1:], said)


def test_a_study_has_its_known_rows_of_the_summary():
    of = everything()
    of["contact"] = of["contact"].assign(
        K_tangent=1.1 * of["contact"]["K"], corner_share=0.07 + 0.0 * of["contact"]["K"]
    )
    of["contact"].attrs["iso_mesh_stiffness"] = 4.2e8
    moves = {
        name: ("phase", [0.0, (k + 2) * scale])
        for scale, names in (
            (1e-6, ("delta_z", "u_xp", "u_yp", "u_zp")),
            (10.0, ("F_xp", "F_yp", "F_zp")),
        )
        for k, name in enumerate(names)
    }
    of["response"] = of["response"].assign(moves).assign(friction_power=("case", [7.0, 11.0]))
    of["response"].attrs["mean_mesh_stiffness"] = 4.4e8
    sweep_forces = {
        f"{name}_harmonic": factor * of["sweep"]["delta_z_harmonic"]
        for name, factor in (("F_xp", 2e8), ("F_yp", 3e8), ("F_zp", np.nan))
    }
    of["sweep"] = of["sweep"].assign(sweep_forces)
    of["stability"]["growth_variation_light"] = stability(1.0)["growth_variation"]
    of["separation"]["peak_to_peak"] = 5e-5 * of["separation"]["separation_share"]
    of["film"].attrs["loss_factor"] = 0.12
    of["losses"] = losses(np.full((2, 2, 2), 0.02))
    file = HelicalGearFile.named("he_2007")
    results = SimpleNamespace(settings=SimpleNamespace(file=file), datasets=of)
    pair, *rows = (list(one) for one in summary_rows(results)[2:])
    assert pair[:2] == ["pair", "total contact ratio"]
    unstable = "least factor on the mesh variation that is unstable"
    expected = [
        ["loaded contact", "mean mesh stiffness along x, secant, at 200 N.m", 5e8, "N/m"],
        ["loaded contact", "mean mesh stiffness along x, tangent, at 200 N.m", 5.5e8, "N/m"],
        ["loaded contact", "ISO 6336-1 mesh stiffness along x", 4.2e8, "N/m"],
        ["loaded contact", "secant stiffness, range over mean, at 200 N.m", 0.4, "1"],
        ["loaded contact", "transmission error, peak to peak, at 200 N.m", 0.4e-6, "m"],
        ["loaded contact", "highest share outside the plane of contact, at 200 N.m", 0.07, "1"],
        ["operating point", "mean mesh stiffness along x, of the vibrating pair", 4.4e8, "N/m"],
        *(
            row
            for case, power in (("mu 0.1", 7.0), ("oil film", 11.0))
            for row in (
                *(["operating point", f"{name} peak to peak, {case}", values[1], unit]
                  for name, (_, values) in moves.items()
                  for unit in ("N" if name.startswith("F") else "m",)),
                ["operating point", f"friction power, {case}", power, "W"],
            )
        ),
        # 0.7 um at mu 0.1 and 3000 rpm
        *(
            ["speed sweep", f"{words}largest first mesh order of {name}, mu 0.1", value, unit]
            for name, size, of_it in (
                ("delta_z", 0.7e-6, "m"), ("F_xp", 140.0, "N"), ("F_yp", 210.0, "N")
            )
            for words, value, unit in (("", size, of_it), ("speed of the ", 3000.0, "rpm"))
        ),
        ["speed sweep", "least 1 - |Floquet multiplier|", 0.5, "1"],
        ["stability", f"{unstable}, with the pair's damping", 2.0, "1"],
        ["stability", f"{unstable}, with light damping", 1.0, "1"],
        ["separation", "largest delta_z peak to peak, damping ratio 0.05", 1.25e-5, "m"],
        ["separation", "longest time without contact, damping ratio 0.05", 0.25, "1"],
        ["separation", "folds of the branch, damping ratio 0.05", 2.0, "1"],
        ["oil film", "constant coefficient of friction of the same loss", 0.04, "1"],
        ["oil film", "power loss, static loads", 150.0, "W"],
        ["oil film", "loss factor H_V", 0.12, "1"],
        *(
            ["losses", f"power lost at {torque} N.m, {speed} rpm, {degc} degC, by solved films "
             "(98 % of the load covered)", power, "W"]
            for power, degc, torque, speed in (
                (11.0, 40, 100, 1000), (13.0, 40, 100, 3000), (17.0, 40, 200, 1000),
                (19.0, 40, 200, 3000), (23.0, 90, 100, 1000), (29.0, 90, 100, 3000),
                (31.0, 90, 200, 1000), (60.0, 90, 200, 3000),
            )
        ),
    ]  # fmt: skip
    assert [one[1] for one in rows] == [one[1] for one in expected]
    for got, row in zip(rows, expected, strict=True):
        assert_cells(got, row, row[1])


def test_the_report_of_a_study_has_its_known_tables_and_inputs():
    of = everything()
    of["sweep"].attrs["pinion_teeth"] = TEETH
    one = HelicalSettings(
        file=HelicalGearFile.named("he_2007"),
        pinion_torque=226.0,
        pinion_speed=100.0 * RPM,
        roughness_rms=0.7e-6,
    )
    results = SimpleNamespace(datasets=of, settings=one)
    heads = ["oil [°C]", "torque [N·m]", "speed [rpm]", "lost [W]", "low [W]", "high [W]",
             "of it by rolling [W]", "efficiency [%]", "low [%]", "high [%]",
             "sliding by"]  # fmt: skip
    meets = [f"order {order} meets it at [rpm]" for order in (1, 2, 3)]
    expected = {
        "Critical speeds": [
            ["mode", "natural frequency [kHz]", *meets],
            [1, 4.0, 8000.0, 4000.0, 8000.0 / 3.0],  # 60 4000 Hz over 30 teeth
        ],
        "Losses of the pair": [
            heads,
            *([degc, torque, rpm, w, None, None, 0.25 * w, 100.0 - 100.0 * w / (torque * rpm * RPM),
               None, None, "formulas"]
              for w, degc, torque, rpm in (
                  (11.0, 40.0, 100.0, 1000.0), (13.0, 40.0, 100.0, 3000.0),
                  (17.0, 40.0, 200.0, 1000.0), (19.0, 40.0, 200.0, 3000.0),
                  (23.0, 90.0, 100.0, 1000.0), (29.0, 90.0, 100.0, 3000.0),
                  (31.0, 90.0, 200.0, 1000.0), (60.0, 90.0, 200.0, 3000.0))),
        ],
    }  # fmt: skip
    assert_tables([_critical_speeds(results), _losses(of["losses"])], expected)
    told = {one.name: (one.value, one.unit) for one in _inputs(results)}
    assert told["pinion torque"] == ("226", "N·m")
    assert told["pinion speed"] == ("100", "rpm")
    assert told["composite roughness"] == ("0.7", "µm")
    assert told["oil temperature"] == (f"{one.oil_temperature - 273.15:.4g}", "°C")


def test_stems_stand_beside_each_other_from_a_floor_below_the_smallest():
    """Two spectra of orders 1 to 4: the least is 1, so the floor is 0.3; the top is thrice 8."""
    first, second = np.array([4.0, 2.0, 1.0, 0.0]), np.array([8.0, 0.0, 5.0, 2.5])
    ax = new_figure(3.0, 3.0).subplots()
    stems(ax, np.arange(1.0, 5.0), [(first, "black", "a"), (second, "red", "b")])
    for lines, dots, heights, beside in zip(
        ax.collections, ax.lines, (first, second), (-0.11, 0.11), strict=True
    ):
        seen = heights > 0.0
        places = np.arange(1.0, 5.0)[seen] + beside
        np.testing.assert_allclose(dots.get_xydata(), np.column_stack([places, heights[seen]]))
        ends = np.array(lines.get_segments())
        np.testing.assert_allclose(ends[:, 0], np.column_stack([places, 0.3 + 0.0 * places]))
        np.testing.assert_allclose(ends[:, 1], dots.get_xydata())
    np.testing.assert_allclose(ax.get_ylim(), (0.3, 24.0))
    np.testing.assert_allclose(ax.get_xlim(), (0.3, 4.7))
