"""Traces and their refusals, and what `gearlube cycle` writes."""

from __future__ import annotations

import csv
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

import gearlube as gl
from gearlube.command import COMMANDS, command_line
from gearlube.studies.drive_cycle.loss_field import at_temperatures
from gearlube_core.errors import ParameterError
from tests.helpers.each import each
from tests.helpers.units import without_units

CAR = gl.read_axle("mohammadpour_2015")


def trace(**columns):
    count = len(next(iter(columns.values())))
    return gl.studies.DriveCycle(**({"name": "mine", "time": np.arange(float(count))} | columns))


STEADY = np.full(20, 10.0)
COARSE = gl.studies.LossGrid(torques=8, speeds=6, temperature_step=45.0)


def test_the_hardest_braking_and_gaining_that_tyres_hold_are_taken():
    speed = np.array([0.0, 7.9, 15.8, 11.9, 0.0, 0.0])
    assert np.diff(trace(speed=speed).speed).min() == pytest.approx(-11.9)


def changed(row, value, values=STEADY):
    new = np.array(values, dtype=float)
    new[row] = value
    return new


@each(
    ("columns", "words"),
    [
        ({"speed": changed(4, np.nan)}, r"speed of mine must be finite, got nan in row 5"),
        ({"speed": changed(4, -1.0)}, r"at least -0\.5 km/h, got -3\.6 km/h in row 5, and 1 such"),
        ({"speed": changed(4, 120.0)}, r"0 to 90 m/s, got 120 m/s in row 5\. Are these km/h"),
        ({"speed": STEADY, "speed_unit": "knots"}, "speed_unit must be one of m/s, km/h, mph"),
        ({"speed": changed(4, 22.0)}, r"within -12 to 8 m/s2.*got 12 m/s2 before row 5"),
        (
            {"speed": changed(range(9, 20), 0.0, np.full(20, 12.5))},
            r"within -12 to 8 m/s2.*got -12\.5 m/s2 before row 10",
        ),
        ({"speed": changed(range(9, 20), 25.0)}, r"got 15 m/s2 before row 10.*km/h"),
        (
            {"speed": STEADY, "time": changed(7, 3.0, np.arange(20.0))},
            "must rise, got 3 s in row 8",
        ),
        (
            {"speed": STEADY, "time": np.arange(20.0) + np.where(np.arange(20) > 5, 30.0, 0.0)},
            r"at most 5 s, got 31 s before row 7\. Fill the gap",
        ),
        ({"speed": STEADY, "time": 1000.0 * np.arange(20)}, "at most 5 s, got 1000 s.*in seconds"),
        (
            {"speed": STEADY, "time": 0.1 * np.arange(20) + np.where(np.arange(20) > 5, 3.0, 0.0)},
            "at most 2 s, got 3.1 s",
        ),
        ({"speed": STEADY, "grade": np.full(20, 5.0)}, r"grade of mine.*got 5 in row 1\. 5 % is"),
        ({"speed": np.full((20, 2), 1.0)}, r"got shape \(20, 2\)"),
        ({"speed": STEADY[:3], "time": np.arange(4.0)}, r"got shape \(3,\), and 4 times"),
        ({"speed": STEADY[:1]}, "a list of 2 to"),
        (
            {"pinion_speed": STEADY},
            "either speed, or pinion speed and pinion torque; got pinion_sp",
        ),
        (
            {"speed": STEADY, "pinion_speed": STEADY, "pinion_torque": STEADY},
            "Give one kind of trace",
        ),
        ({"grade": STEADY}, "got none of them"),
        ({"pinion_speed": STEADY, "pinion_torque": STEADY, "grade": STEADY}, "but got a grade too"),
        (
            {"pinion_speed": changed(2, -5.0), "pinion_torque": STEADY},
            "pinion_speed of mine must be at least -15.3 rpm, got -47.7 rpm in row 3",
        ),
    ],
)
def test_a_wrong_row_is_named_with_limit_and_cure(columns, words):
    with pytest.raises(ParameterError, match=words):
        trace(**columns)


def test_a_torque_beyond_the_mesh_table_is_refused_before_anything_is_computed(monkeypatch):
    monkeypatch.setattr("gearlube.studies.drive_cycle.loss_field.axle_losses", None)
    cycle = trace(pinion_speed=STEADY, pinion_torque=changed(6, 1500.0, np.full(20, 50.0)))
    with pytest.raises(ParameterError, match=r"within -600 to 600 N\.m, got 775 N\.m at 5 s"):
        gl.run_cycle(gl.DriveCycleSettings(car=CAR, cycle=cycle))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"start_temperature": 20.0}, "start_temperature"),
        ({"air_temperature": 900.0}, "air_temperature"),
        ({"regeneration": 40.0}, r"regeneration must be within 0 to 1, got 40\. A half is 0\.5"),
        ({"coast_torque": -30.0}, "coast_torque"),
    ],
)
def test_settings_out_of_range_are_refused(options, words):
    with pytest.raises(ParameterError, match=words):
        gl.DriveCycleSettings(car=CAR, cycle=trace(speed=STEADY), **options)


def written(folder, text):
    path = folder / "trace.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "quantity", "expected"),
    [
        ("time_s,speed_kmh\n0,36\n1,39.6\n", "speed", [10.0, 11.0]),
        ("# of a car\ntime_s;speed_m_s;grade_percent\n0;10;5\n1;11;-5\n", "grade", [0.05, -0.05]),
        ("time_s,speed_mph\n0,0\n1,10\n", "speed", [0.0, 4.4704]),
        (
            "\ufefftime_s\tpinion_speed_rpm\tpinion_torque_n_m\n0\t3000\t-5\n1\t3000\t5\n",
            "pinion_speed",
            [314.159265] * 2,
        ),
    ],
)
def test_columns_carry_their_units(tmp_path, text, quantity, expected):
    cycle = gl.studies.DriveCycle.given(str(written(tmp_path, text)))
    assert getattr(cycle, quantity) == pytest.approx(np.array(expected), rel=1e-8)
    assert cycle.name == "trace"


@each(
    ("text", "words"),
    [
        ("time_s,speed\n0,1\n1,1\n", "got 'speed'. Rename or remove"),
        ("time_s,speed_kmh,speed_m_s\n0,1,1\n1,1,1\n", "got speed in several columns"),
        ("speed_kmh\n0\n1\n", "must have the column time_s"),
        ("time_s,speed_kmh\n0,1\n1,\n", "line 3: speed_kmh must be a finite number, got ''. Fill"),
        ("time_s,speed_kmh\n0,1\n1,3,5\n", "line 3: has 3 of 2 columns, got '1,3,5'. With commas"),
        ("time_s,speed_kmh\n0,1\n", "at least 2 rows of values.*, got 1"),
        ("time_s,speed_kmh\n0,1\n1,nan\n", "line 3: speed_kmh must be a finite number, got 'nan'"),
    ],
)
def test_a_wrong_file_is_refused(tmp_path, text, words):
    with pytest.raises(ParameterError, match=words):
        gl.studies.DriveCycle.read(written(tmp_path, text))


def test_files_that_are_no_traces_are_refused(tmp_path):
    with pytest.raises(ParameterError, match=r"The table gone\.csv was not found in "):
        gl.studies.DriveCycle.given(str(tmp_path / "gone.csv"))
    workbook = tmp_path / "trace.xlsx"
    workbook.write_bytes(b"PK\x03\x04\xff\xfe\x80")
    with pytest.raises(ParameterError, match="not as a workbook"):
        gl.studies.DriveCycle.given(str(workbook))
    with pytest.raises(ParameterError, match="one of nedc, wltc, ftp75, got 'wltz'"):
        gl.studies.DriveCycle.given("wltz")


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cycle")
    text = "time_s,speed_kmh\n0,-0.05\n" + "".join(f"{i},{min(2 * i, 40)}\n" for i in range(1, 40))
    ended = CliRunner().invoke(
        command_line(COMMANDS),
        [
            "cycle",
            *("--cycle", str(written(folder, text)), "--out", str(folder / "out")),
            *("--start-temperature", "100", "--air-temperature", "90", "--draws", "8"),
        ],
    )
    assert ended.exit_code == 0, ended.output
    return folder / "out"


@pytest.mark.slow
def test_the_report_says_what_was_taken_as_rest(out):
    assert "1 of 40 rows have a speed from -0.05 km/h to 0" in (out / "report.html").read_text()


@pytest.mark.slow
def test_the_files_hold_the_same_cycle(out):
    with xr.open_dataset(out / "drive_cycle.nc", engine="scipy") as found:
        assert not without_units(found)
        found.load()
    with (out / "drive_cycle.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == found.sizes["step"] == 39
    assert float(rows[9]["vehicle_speed_kmh"]) == pytest.approx(19.0, rel=1e-6)
    lost = sum(float(row[f"loss_{source}_w"]) for row in rows for source in found["source"].values)
    energy = float(found["energy_lost"].sum())
    assert 1e-3 * lost == pytest.approx(energy, rel=1e-5)  # steps of 1 s, seven digits
    with (out / "summary.csv").open() as file:
        summary = list(csv.DictReader(file))
    kj, wh = (float(row["value"]) for row in summary if row["quantity"] == "energy lost")
    assert kj == pytest.approx(energy, rel=1e-5)
    assert wh == pytest.approx(energy / 3.6, rel=1e-5)
    parts = [
        float(row["value"])
        for row in summary
        if row["quantity"].startswith("lost by") and row["unit"] == "kJ"
    ]
    assert len(parts) == found.sizes["source"]
    assert sum(parts) == pytest.approx(kj, rel=1e-5)
    assert (out / "figures" / "drive_cycle.png").stat().st_size > 10_000
    one = next(row["value"] for row in summary if row["quantity"] == "efficiency as one number")
    for name in ("fastsim.yaml", "co2mpas.csv"):
        assert f"{float(one):.6f}" in (out / name).read_text()


def test_the_figure_says_what_is_not_modelled(out):
    from gearlube.studies.drive_cycle.figures import cycle_figure

    with xr.open_dataset(out / "drive_cycle.nc", engine="scipy") as found:
        drawn = cycle_figure(found)
    words = drawn._supxlabel.get_text()
    assert "windage" in words
    assert "heat from brakes" in words


def test_assumed_heat_makes_a_band_and_given_heat_none():
    settings = gl.DriveCycleSettings(car=CAR, cycle=trace(speed=STEADY), draws=0, grid=COARSE)
    assumed = gl.run_cycle(settings)
    width = assumed["oil_temperature_high"] - assumed["oil_temperature_low"]
    assert float(width[-1]) > 0.0
    heat = gl.studies.SumpHeat(capacity=17e3, conductance_at_rest=6.0, conductance_at_100_kmh=20.0)
    given = gl.run_cycle(replace(settings, heat=heat))
    assert (
        given["oil_temperature_high"].values.tolist()
        == given["oil_temperature_low"].values.tolist()
    )


def test_the_command_refuses_an_unknown_cycle_and_leaves_no_folder(tmp_path, caplog):
    folder = tmp_path / "out"
    ended = CliRunner().invoke(
        command_line(COMMANDS), ["cycle", "--cycle", "artemis", "--out", str(folder)]
    )
    assert ended.exit_code == 2
    assert "one of nedc, wltc, ftp75, got 'artemis'" in caplog.text
    assert not folder.exists()


@pytest.mark.slow
def test_the_error_bars_of_a_cycle_are_those_of_drawn_axles():
    """Each draw computed again: the axle changed, its map again, its sources scaled."""
    from gearlube.studies.drive_cycle.loss_field import at_temperatures, demand_of, losses_along
    from gearlube.studies.drive_cycle.spread import uncertain_inputs

    draws = 12
    heat = gl.studies.SumpHeat(capacity=1e7, conductance_at_rest=6.0, conductance_at_100_kmh=20.0)
    settings = gl.DriveCycleSettings(
        car=CAR,
        cycle=trace(speed=np.linspace(5.0, 25.0, 30)),
        heat=heat,  # given, and so large that the oil stays at 60 degC
        start_temperature=333.15,
        air_temperature=333.15,
        grid=COARSE,
        draws=draws,
        seed=3,
    )
    found = gl.run_cycle(settings)
    rng, lost = np.random.default_rng(3), []
    demand, inputs = demand_of(settings), uncertain_inputs(settings)
    for _ in range(draws):
        normals = rng.standard_normal(len(inputs))
        rng.uniform(size=2)  # heat data, that are given here
        axle, factors = CAR.axle, dict.fromkeys(found["source"].values.tolist(), 1.0)
        for one, normal in zip(inputs, normals, strict=True):
            by = one.factor ** (0.5 * normal)
            if one.changed is not None:
                axle = one.changed(axle, by)
            for source in one.sources:
                factors[source] *= by
        drawn = losses_along(replace(settings, car=replace(CAR, axle=axle)), demand)
        power = at_temperatures(drawn.power, drawn.temperatures, np.full(29, 333.15))
        lost.append(1e-3 * demand.steps @ power @ np.array(list(factors.values())))
    low, high = np.percentile(lost, (2.5, 97.5))
    # losses are no exact powers of the data: the Eyring stress within a factor of 2
    assert float(found["energy_lost_low"]) == pytest.approx(low, rel=0.02)
    assert float(found["energy_lost_high"]) == pytest.approx(high, rel=0.02)
    assert low < 0.85 * found["energy_lost"].sum() < high
    efficiency = [float(found[f"efficiency{end}"]) for end in ("_low", "", "_high")]
    assert efficiency == sorted(efficiency)


def test_without_draws_there_is_no_error_bar_of_the_efficiency():
    short = trace(speed=STEADY[:5])
    found = gl.run_cycle(gl.DriveCycleSettings(car=CAR, cycle=short, draws=0, grid=COARSE))
    assert "efficiency_low" not in found


def test_noise_of_a_sensor_at_rest_is_zero_and_said():
    cycle = gl.studies.DriveCycle(
        name="mine", time=np.arange(4.0), speed=np.array([0.0, -0.02, 0.1, 0.5])
    )
    assert cycle.speed.tolist() == [0.0, 0.0, 0.1, 0.5]
    assert cycle.notes == (
        "1 of 4 rows have a speed from -0.072 km/h to 0: noise of a sensor at rest, taken as 0.",
    )
    turning = np.array([-1.0, 0.0, 5.0, 9.0])
    cycle = gl.studies.DriveCycle(
        name="m", time=np.arange(4.0), pinion_speed=turning, pinion_torque=turning
    )
    assert cycle.pinion_speed.tolist() == [0.0, 0.0, 5.0, 9.0]
    assert "from -9.55 rpm to 0" in cycle.notes[0]


def test_a_cycle_of_vecto_over_time_is_read_with_its_grade(tmp_path):
    path = tmp_path / "time.vdri"
    path.write_text(
        "<t> [s],<v> [km/h],<grad> [%],<gear>\nc [s],[km/h],[%],[-]\n0.5,0,-2,0\n1.5,3.6,4,1\n"
    )
    cycle = gl.studies.DriveCycle.given(str(path))
    assert cycle.time.tolist() == [0.5, 1.5]
    assert cycle.speed.tolist() == [0.0, 1.0]
    assert cycle.grade.tolist() == [-0.02, 0.04]
    assert cycle.notes == ("Columns of the cycle that are not used: <gear>.",)
    path.write_text("<v>\n0\n3.6\n7.2\n")  # a row each second
    assert gl.studies.DriveCycle.given(str(path)).time.tolist() == [0.0, 1.0, 2.0]


def test_a_cycle_of_vecto_over_distance_is_driven_within_the_limits_of_its_driver(tmp_path):
    path = tmp_path / "distance.vdri"
    path.write_text("<s>,<v>,<grad>,<stop>\n0,0,1,2\n1,18,1,0\n101,18,3,0\n200,0,3,7\n400,0,0,0\n")
    cycle = gl.studies.DriveCycle.given(str(path))
    # 18 km/h and 1 m/s2 both ways: 2 s and 7 s of rest, each way 5 s and 12.5 m up and down. After
    # the stop no target follows, so that the last one above 0 holds to the end, where it stands
    legs = [5.0 + (way - 25.0) / 5.0 + 5.0 for way in (200.0, 200.0)]
    # each of 4 ramps ends between places 2 m apart, passed at 4.58 to 5 m/s in place of 5 m/s
    assert cycle.duration == pytest.approx(2.0 + 7.0 + sum(legs), abs=4 * 0.0175)
    # a row each second cuts corners of the speed by at most 1/8 m each
    assert cycle.distance == pytest.approx(400.0, abs=8 / 8)
    assert cycle.speed.max() == pytest.approx(5.0)
    gained = np.diff(cycle.speed) / np.diff(cycle.time)
    assert np.abs(gained).max() <= 1.0 + 1e-9
    # the grade is that of the row before the place, 101 m is passed after 2 + 5 + 17.7 s
    assert cycle.grade[24] == 0.01
    assert cycle.grade[25] == 0.03
    assert "over distance" in cycle.notes[0]


@each(
    ("last", "words"),
    [
        ("2,-5", "got -5 km/h in line 6 of its file, and 1 such"),
        # 90 m/s, -12 and 8 m/s2, times 3.6
        ("2,400", r"within 0 to 324 km/h, got 400 km/h in line 6 of its file\. Correct the rows"),
        ("2,100", r"-43.2 to 28.8 km/h per s, .*got 100 km/h per s before line 6 of its file"),
        ("1,0", "got 1 s in line 6 of its file after 1 s"),
        ("9,0", "got 8 s before line 6 of its file"),
    ],
)
def test_a_refused_trace_names_the_line_of_its_file(last, words, tmp_path):
    path = tmp_path / "trace.csv"
    path.write_text(f"# measured\ntime_s,speed_kmh\n0,0\n\n1,0\n{last}\n")
    with pytest.raises(ParameterError, match=words) as told:
        gl.studies.DriveCycle.read(path)
    assert "name the column" not in str(told.value)  # it has that name already


@each(
    ("text", "words"),
    [
        ("<t>,<Pwheel>\n0,1\n1,2\n", "must have the column <v>.*Cycles of engine or wheel power"),
        ("<t>,<v> [m/s]\n0,1\n1,2\n", r"<v> must be in km/h, got \[m/s\]"),
        ("<s>,<v>,<stop>\n0,0,1\n0,20,0\n", "rising distances.*got 0 m, 20 km/h and 0 s in line 3"),
        (
            "<s>,<v>,<grad>\n0,20,0\n\n9,20,80\n99,9,0\n",
            "grade of wrong.* 0.8 in line 4 of its file",
        ),
        ("<t>,<v>\nc no row\n0,0\n1,90\n", "got 90 km/h per s before line 4 of its file"),
        ("<s>,<v>,<stop>\n0,0,1\n9,0,0\n", "some above 0"),
        ("<t>,<v>,v\n0,1,2\n1,2,3\n", "must have <v> once"),
    ],
)
def test_a_wrong_cycle_of_vecto_is_refused(text, words, tmp_path):
    path = tmp_path / "wrong.vdri"
    path.write_text(text)
    with pytest.raises(ParameterError, match=words):
        gl.studies.DriveCycle.given(str(path))


def test_losses_between_oil_temperatures_lie_on_the_line_between_their_neighbours():
    nodes = np.array([280.0, 300.0, 350.0, 360.0])
    at = np.array([280.0, 290.0, 300.0, 337.0, 360.0])
    values = np.tile(np.stack([nodes, -2.0 * nodes], axis=-1), (at.size, 1, 1))
    np.testing.assert_allclose(at_temperatures(values, nodes, at), np.stack([at, -2.0 * at], -1))
