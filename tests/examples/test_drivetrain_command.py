"""The command drivetrain: two rotors by closed forms, and the shipped e-axle."""

import math
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

import gearlube as gl
from drivetrain.train.train_file import TrainFile
from gearlube.command import app
from gearlube.studies.drivetrain.clashes import clashes
from gearlube.studies.drivetrain.figures import _mode_figure, losses, transmission_errors
from gearlube.studies.drivetrain.layout import layout
from gearlube.studies.drivetrain.report import findings
from gearlube.studies.drivetrain.run import FILE
from gearlube.studies.drivetrain.space_view import space_view
from tests.helpers.small_trains import BRAKE, FIRST, SECOND, STIFFNESS, WITH_BRAKE


@pytest.fixture(scope="module")
def rotors(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("drivetrain")
    (folder / "rotors.toml").write_text(WITH_BRAKE)
    done = CliRunner().invoke(
        app,
        ["drivetrain", str(folder / "rotors.toml"), "--duration-ms", "20", "--step-us", "1000",
         "--out", str(folder / "out")],
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    return folder / "out"


def test_the_mode_of_two_rotors_is_that_of_the_closed_form(rotors: Path) -> None:
    """w2 = k (1/I1 + 1/I2), and each rotor has the other's share of the inertia in the energy."""
    with xr.open_dataset(rotors / FILE) as found:
        frequency, share = found["frequency"].values, found["share"].values
    w0 = math.sqrt(STIFFNESS * (1.0 / FIRST + 1.0 / SECOND))
    assert frequency == pytest.approx([w0 / (2.0 * math.pi)], rel=1e-6)
    assert share[0] == pytest.approx([SECOND / (FIRST + SECOND), FIRST / (FIRST + SECOND)])


def test_the_brake_loses_its_torque_times_the_speed(rotors: Path) -> None:
    with xr.open_dataset(rotors / FILE) as found:
        lost = losses(found)
        speed = found["load.speed"].values
        # means over each step of a speed that falls evenly
        expected = BRAKE * (0.5 * (speed[1:] + speed[:-1]))[-11:]
        assert lost["brake"] == pytest.approx(expected.mean(), rel=1e-6)
        assert float(found.attrs["imbalance"]) < 1e-7
        assert transmission_errors(found) == {}


def test_the_report_says_where_the_power_goes(rotors: Path) -> None:
    with xr.open_dataset(rotors / FILE) as found:
        said = [one.headline for one in findings(found)]
        for missing, words in ((3e-11, "below 0.01 ppm"), (1.4e-7, "0.14 ppm")):
            told = findings(found.assign_attrs(imbalance=missing))[0].detail
            assert f"Energy balance: {words} of the energy" in told
    assert any(re.match(r"The drivetrain loses 31\d W at the file's speed", one) for one in said), (
        said
    )
    assert not any("unaccounted" in one for one in said)
    assert not any(one.startswith("The speed of") for one in said)  # the brake takes 0.03 %
    page = (rotors / "report.html").read_text("utf-8")
    assert "Natural frequencies, and which bodies move" in page
    assert "Transmission error of every mesh" not in page  # there is none


def test_torques_that_do_not_balance_are_told(rotors: Path) -> None:
    with xr.open_dataset(rotors / FILE) as found:
        faster = found.load()
    faster["load.speed"] = faster["load.speed"] * np.linspace(1.0, 1.5, faster.sizes["time"])
    (said,) = [one for one in findings(faster) if one.headline.startswith("The speed of")]
    assert said.level == "warning"
    assert said.headline == "The speed of load changes from 1000 to 1500 rpm."


def test_a_drivetrain_that_stands_has_no_drift_and_no_losses(rotors: Path) -> None:
    with xr.open_dataset(rotors / FILE) as found:
        still = found.load()
    for name in still.data_vars:
        if str(name).endswith((".speed", ".power_loss")):
            still[name] = 1e-30 * still[name] * np.linspace(0.0, 1.0, still.sizes["time"])
    said = [one.headline for one in findings(still)]
    assert [one for one in said if one.startswith(("The speed of", "The drivetrain loses"))] == []


def test_the_example_is_a_file_to_start_from(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["drivetrain", "--example"])
    assert done.exit_code == 0
    assert 'kind = "helical_mesh"' in done.output
    of_planets = CliRunner().invoke(app, ["drivetrain", "planetary", "--example"])
    assert 'kind = "orbit"' in of_planets.output


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--run-up", "600:600"], "got 600 rpm twice"),
        (["--map-speeds", "0:10:1"], "must be within 0.01 to 100000 rpm, got 0 rpm"),
        (["e_axl"], "No train file is called 'e_axl'. Shipped: e_axle, e_axle_case,"),
        (["no.toml"], "The train file no.toml was not found"),
    ],
)
def test_wrong_options_are_told_before_what_computes_is_loaded(options: list[str], words: str):
    """Loading takes seconds: xarray, among the last of it, is not there after the message."""
    script = (
        "import sys; from gearlube.command import app\n"
        "try: app(sys.argv[1:])\n"
        "finally: assert 'xarray' not in sys.modules"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, "drivetrain", *options], capture_output=True, text=True
    )
    assert done.returncode == 2
    assert words in " ".join((done.stdout + done.stderr).split())


def test_a_step_that_is_too_short_is_refused(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "rotors.toml").write_text(WITH_BRAKE)
    done = CliRunner().invoke(
        app,
        ["drivetrain", str(tmp_path / "rotors.toml"), "--duration-ms", "1e6", "--step-us", "1",
         "--out", str(tmp_path / "out")],
    )  # fmt: skip
    assert done.exit_code == 2
    assert "step must be within 0.005 to 0.1 s" in caplog.text


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--run-up", "600"], "--run-up must be two speeds"),
        (["--run-up", "0:600"], "--run-up must be within 0.01 to 100000 rpm, got 0"),
        (["--ramp-s", "3"], "--ramp-s needs --run-up, got 3 s alone"),
        (["--run-up", "600:900"], "needs a port that puts power into the train"),
        (["--map"], "got drive 0 W with torque 0. Correct start.torque_n_m"),
        (["--regeneration", "0.5"], "--regeneration needs --cycle, got none"),
        (["--cycle", "nedc"], "A drive cycle needs a vehicle, got none in"),
        (["--cycle", "nedc", "--map-speeds", "100:200:50"], "--cycle chooses the map"),
        (["--cycle", "nothing"], "A cycle must be one of nedc, wltc, ftp75, got 'nothing'"),
        (["--map-torques", "5:1:1"], "The last value of --map-torques must be at least the first"),
    ],
)
def test_studies_that_cannot_run_are_refused_at_once(
    options: list[str], told: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "rotors.toml").write_text(WITH_BRAKE)
    command = ["drivetrain", str(tmp_path / "rotors.toml"), "--out", str(tmp_path / "out")]
    done = CliRunner().invoke(app, [*command, *options])
    assert done.exit_code == 2
    assert told in caplog.text
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_the_shipped_axle_balances_its_energy(tmp_path: Path) -> None:
    trace = tmp_path / "trace.csv"
    trace.write_text("time_s,speed_kmh\n0,0\n4,30\n8,30\n12,0\n")
    done = CliRunner().invoke(
        app,
        ["drivetrain", "e_axle", "--duration-ms", "20", "--cycle", str(trace),
         "--out", str(tmp_path)],
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    assert {"cycle.nc", "cycle.csv", "loss_map.csv"} <= {one.name for one in tmp_path.iterdir()}
    page = (tmp_path / "report.html").read_text()
    assert "Energy lost by source" in page
    assert "Power lost over the drive cycle" in page
    with xr.open_dataset(tmp_path / FILE) as found:
        assert float(found.attrs["imbalance"]) < 1e-5
        speeds = [found[f"{body}.speed"].values.mean() for body in ("motor", "counter")]
        assert speeds[0] / speeds[1] == pytest.approx(-31.0 / 25.0, rel=1e-4)  # teeth
        assert np.isfinite(found["stage_1.dte"]).all()
        # helical meshes lose 0.3 to 1.5 % each
        assert 0.97 < float(found["efficiency"][-1]) < 0.995
        assert found.sizes["mode"] == 19  # 20 free coordinates less the turning of the whole


def test_the_figure_of_many_modes_has_the_lowest() -> None:
    mode = np.arange(40)
    share = np.full((40, 2), 0.5)
    found = xr.Dataset(
        {"frequency": ("mode", 100.0 * (1 + mode)), "share": (("mode", "body"), share)},
        coords={"body": ["first", "second"]},
    )
    (ax,) = _mode_figure(found).axes
    assert [one.get_text() for one in ax.get_yticklabels()][::29] == ["100 Hz", "3000 Hz"]
    assert ax.get_title() == "the lowest 30 of 40"


def test_the_picture_places_shafts_by_their_meshes() -> None:
    """Distances are those of the teeth: m z / 2 cos b, added along the chain; a ring is coaxial."""
    axle = layout(TrainFile.named("e_axle_elastic").case().train)
    first = 3.0e-3 * (17 + 31) / (2.0 * math.cos(math.radians(28.0)))
    second = 3.4e-3 * (17 + 74) / (2.0 * math.cos(math.radians(24.0)))
    ways = [np.exp(1j * math.radians(angle)) for angle in (-40.0, 20.0)]
    assert axle.centres["counter"] == pytest.approx(first * ways[0], rel=1e-9)
    assert axle.centres["output"] == pytest.approx(first * ways[0] + second * ways[1], rel=1e-9)
    assert len(axle.seats["input"]) == 3
    stage = layout(TrainFile.named("planetary").case().train)
    assert abs(stage.centres["ring"] - stage.centres["sun"]) < 1e-12
    planets = [centre for name, centre in stage.centres.items() if name.startswith("planet")]
    assert len(planets) == 3
    assert sum(planets) == pytest.approx(0.0, abs=1e-9)
    gearbox = layout(TrainFile.named("nrel_5mw").case().train)
    assert len({one.mesh for one in gearbox.gears}) == 13
    assert abs(gearbox.centres["carrier_2"]) < 1e-12  # on the axis of the first sun
    assert abs(gearbox.centres["pinion"]) == pytest.approx(0.861, rel=1e-9)


def about_axis(trace: Any, centre: complex) -> tuple[np.ndarray, np.ndarray]:
    """Return the distances of a drawn body's points from an axis, and their z [m]."""
    x, y, z = (1e-3 * np.asarray(trace[c], float) for c in "xyz")
    return np.hypot(x - centre.real, y - centre.imag), z


def test_the_view_in_space_has_pitch_circles_shafts_and_bearings_in_their_places() -> None:
    axle = layout(TrainFile.named("e_axle_elastic").case().train)
    drawn = {one.name: one for one in space_view(axle).chart.data}
    touching = []
    for stage, bodies in (("stage_1", ("input", "counter")), ("stage_2", ("counter", "output"))):
        radii = [about_axis(drawn[f"{stage}, {one}"], axle.centres[one])[0].max() for one in bodies]
        apart = abs(axle.centres[bodies[0]] - axle.centres[bodies[1]])
        touching.append(sum(radii) - apart)
    assert touching == pytest.approx([0.0, 0.0], abs=1e-7)  # m: 32 bits of 0.3 m
    radius, z = about_axis(drawn["output"], axle.centres["output"])
    assert (radius.min(), radius.max()) == pytest.approx((0.015, 0.030), abs=1e-7)
    assert (z.min(), z.max()) == pytest.approx((0.26, 0.34), abs=1e-7)
    radius, z = about_axis(drawn["output_end"], axle.centres["output"])
    assert radius.min() == pytest.approx(0.030, abs=1e-7)
    assert z.mean() == pytest.approx(0.34, abs=1e-7)
    stage = layout(TrainFile.named("planetary").case().train)
    ring = {one.name: one for one in space_view(stage).chart.data}["ring_mesh_1, ring"]
    inner = next(one.radius for one in stage.gears if one.ring)
    assert about_axis(ring, stage.centres["ring"])[0].min() == pytest.approx(inner, rel=1e-6)


def test_gears_of_two_stages_that_run_through_each_other_are_named() -> None:
    """The output wheel is folded back over the input shaft, which ends at z = 290 mm.

    Pitch radius 137.705 mm, addendum 3.4 mm, shaft 20 mm: 161.11 mm. Centre distances of 81.545 and
    169.340 mm on one line leave 87.795 mm. The wheel's face is z = 270 to 310 mm.
    """
    assert clashes(layout(TrainFile.named("e_axle_elastic").case().train)) == []
    folded = tomllib.loads(TrainFile.shipped_text("e_axle_elastic"))
    folded["elements"]["stage_2"]["azimuth_deg"] = 140.0
    (one,) = clashes(layout(TrainFile.from_data(folded, "folded").case().train))
    assert "output in stage_2 and the shaft input run through each other." in one
    assert "at least 161.11 mm apart" in one
    assert "got 87.795 mm" in one
    assert "z = 270 to 290 mm" in one
    flat = tomllib.loads(TrainFile.shipped_text("e_axle"))  # two gears in one plane: not yet drawn
    flat["elements"]["stage_2"]["pinion_arm_mm"] = -30.0
    assert clashes(layout(TrainFile.from_data(flat, "flat").case().train)) == []


def test_planets_that_touch_each_other_are_named() -> None:
    """13 of 75 steps apart: 2 x 863 mm sin(31.2 deg) = 894 mm, below 2 x (407.5 + 45) mm."""
    stage = tomllib.loads(TrainFile.shipped_text("planetary"))
    apart = 360.0 * 13 / (19 + 56)
    for kind in ("orbit", "pin", "sun_mesh", "ring_mesh"):
        stage["elements"][f"{kind}_2"]["azimuth_deg"] = apart
    # the planet turns with its place, and by the sun's teeth between
    keyed = (apart + 19 * apart / 17) % (360.0 / 17)
    stage["elements"]["ring_mesh_2"]["keyed_angle_deg"] = keyed
    (said,) = clashes(layout(TrainFile.from_data(stage, "near").case().train))
    assert "planet_1 in sun_mesh_1 and planet_2 in sun_mesh_2 run through each other" in said
    assert f"got {2.0 * 863.0 * math.sin(math.radians(31.2)):.5g} mm" in said


def test_nodes_of_a_housing_are_where_its_bearings_are() -> None:
    tube = gl.train.ShaftSection(start=0.0, end=0.1, outer_diameter=0.03)
    shafts = [
        gl.train.Shaft(name=one, sections=[tube], nodes={"gear": 0.02, "end": 0.1}) for one in "ab"
    ]
    places = {"seat": (0.2, 0.1, 0.3), "foot": (0.2, 0.0, 0.35)}  # m, in its own axes
    model = gl.train.ReducedModel(
        stiffness=1e8 * np.eye(6),
        mass=np.eye(6),
        nodes=tuple(gl.train.InterfaceNode(name, *at) for name, at in places.items()),
        owner=np.repeat([0, 1], 3),
        direction=np.tile(np.arange(3), 2),
    )
    teeth = {"teeth_1": 20, "teeth_2": 30, "normal_module": 4e-3, "face_width": 0.02}
    parts = [
        gl.train.GearMesh(name="mesh", first="a.gear", second="b.gear", backlash=1e-4, **teeth),
        gl.train.Joint(name="bearing", first="b.end", second="case.seat", K_xx=1e8, K_yy=1e8),
        gl.train.SpringSupport(name="springs", body="a", K_xx=1e8, K_yy=1e8),
        gl.train.Port(name="load", body="b"),
    ]
    case = gl.train.Housing(name="case", model=model, free=False)
    train = gl.Train([*shafts, case], parts, gl.Lubricant.named("mohammadpour_2015"))
    found = layout(train).housing
    assert found["case.seat"] == (pytest.approx(0.1), pytest.approx(0.1))  # m z/2 along x; end
    assert found["case.foot"] == (pytest.approx(0.1 - 0.1j), pytest.approx(0.15))
    points = space_view(layout(train)).chart.data[-1]
    assert list(points.text) == ["case.seat", "case.foot"]
    assert points.y[1] == pytest.approx(-100.0)
