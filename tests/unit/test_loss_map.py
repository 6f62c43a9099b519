"""The loss map as a user gets it: error bars, and files that other tools read by their rules."""

from __future__ import annotations

import csv
import math
import re
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from scipy.interpolate import LinearNDInterpolator
from scipy.io import loadmat
from scipy.stats import norm
from typer.testing import CliRunner

import gearlube as gl
from gearlube.command import COMMANDS, command_line
from gearlube.report.parts import WARNING
from gearlube.studies.loss_map.exports import lossy_gear_table
from gearlube.studies.loss_map.findings import findings
from gearlube.studies.loss_map.report import no_load_table
from gearlube.studies.loss_map.sampling import moving_inputs
from gearlube_core.bearings.followed_shaft import BEARING_LAWS, TORQUE_LOSSES
from gearlube_core.bearings.losses.laws import LAWS
from gearlube_core.bearings.losses.loss import CALIBRATED, UNCALIBRATED
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.uncertain import UNCERTAIN
from gearlube_core.errors import ParameterError
from tests.helpers.each import each
from tests.helpers.units import without_units

AXLE = replace(
    mohammadpour_2015_axle(),
    churning="changenet_velex_2007",
    rolling="biboulet_houpert_2010",
    pinion_seal_torque=0.15,
    wheel_seal_torque=0.3,
)
TORQUES = np.array([-100.0, -40.0, 0.0, 50.0, 150.0, 300.0])
SPEEDS = np.array([50.0, 150.0, 300.0])
DEGC = (60.0, 90.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("map")


@pytest.fixture(scope="module")
def found(folder):
    settings = gl.LossMapSettings(
        axle=AXLE, torques=TORQUES, speeds=SPEEDS, temperatures=np.array(DEGC) + 273.15, draws=4
    )
    return gl.run_loss_map(settings, folder=folder)


@pytest.mark.slow
def test_the_sources_are_the_whole(found):
    turning = found["speed"] * np.pi / 30.0
    whole = (found["loss_torque"] * turning).transpose(*found["loss"].dims[:-1])
    assert found["loss"].sum("source").values == pytest.approx(whole.values, rel=1e-12)


@pytest.mark.slow
def test_the_mesh_is_not_damped_in_steady_running(found):
    # the shafts do not vibrate: 1e-28 W was rounding, and stood so in map.csv
    assert np.all(found["loss"].sel(source="mesh_damping").values == 0.0)


def test_a_film_hotter_than_the_oil_data_is_reported_as_extrapolated(found):
    warm, hot = (
        found.assign(flank_temperature=xr.full_like(found["efficiency"], degc))
        for degc in (149.0, 151.0)
    )
    hot["flank_temperature"][0, 1, 5] = 518.2
    warm["flank_temperature"][0, 1, 5] = np.nan  # a point that failed
    assert not [one for one in findings(warm) if "hotter than" in one.headline]
    (said,) = (one for one in findings(hot) if "hotter than" in one.headline)
    assert said.level == WARNING
    # the library's data of this oil end at 150 degC
    assert "which end at 150 °C, at 100 % of the points" in said.headline
    assert "at 300 N·m, 1432 rpm and 60 °C oil: 518 °C" in said.detail  # 150 rad/s


def test_a_map_with_solved_rollers_has_their_bound(found, tmp_path):
    settings = gl.LossMapSettings(
        axle=replace(AXLE, bearing_torque_loss="solved_films"),
        torques=np.array([20.0, 50.0]),
        speeds=np.array([100.0, 150.0]),
        temperatures=np.array([333.15]),
        draws=0,
    )
    made = gl.run_loss_map(settings, folder=tmp_path)
    drag = made["loss"].sel(source="bearing_torque")
    # raceways have the model's bound of 0.55 %, ribs and oil none; a few rollers lie outside
    share = (made["drag_bound"] / drag).values
    assert np.all((share > 0.002) & (share < 0.05))
    assert np.all(made["rollers_outside"].values < 0.1)
    assert "drag_bound" not in found


def test_input_less_output_is_the_loss(found):
    ratio = found.attrs["ratio"]
    lost = found["torque"] - found["wheel_torque"] / ratio
    assert lost.transpose(*found["loss_torque"].dims).values == pytest.approx(
        found["loss_torque"].values, rel=1e-12
    )


def test_coast_efficiency_is_that_of_the_other_way(found):
    """With the wheels driving, the input is what they put in."""
    one = found.isel(temperature=0, speed=1).sel(torque=-100.0)
    speed = float(one["speed"]) * np.pi / 30.0
    put_in = -float(one["wheel_torque"]) * speed / found.attrs["ratio"]
    assert float(one["efficiency"]) == pytest.approx(100.0 * speed / put_in, rel=1e-12)


def test_no_efficiency_without_load(found):
    assert np.isnan(found["efficiency"].sel(torque=0.0).values).all()


def test_one_law_alone_spreads_the_loss_by_its_own_factor():
    """Drag is scaled by exp(z ln(f)/2): percentiles of the draws, and the swing in closed form."""
    drag = next(one for one in UNCERTAIN if one.name == "bearing_drag")
    settings = gl.LossMapSettings(
        axle=AXLE,
        torques=np.array([80.0]),
        speeds=np.array([200.0]),
        temperatures=np.array([333.15]),
        draws=2000,
        uncertain=(drag,),
    )
    one = gl.run_loss_map(settings).squeeze()
    lost = dict(zip(LOSS_SOURCES, one["loss"].values, strict=True))
    other = sum(power for name, power in lost.items() if name != "bearing_torque")
    spread = drag.factor ** (0.5 * norm.ppf(0.975))
    for name, factor in (("loss_torque_low", 1.0 / spread), ("loss_torque_high", spread)):
        expected = (other + factor * lost["bearing_torque"]) / 200.0
        # 2000 draws: a percentile at 2.5 % is 0.06 standard deviations off, that is 3.3 % of drag
        off = 0.06 * 0.5 * math.log(drag.factor) * factor * lost["bearing_torque"] / 200.0
        assert float(one[name]) == pytest.approx(expected, abs=2.0 * off)
    swing = 0.5 * (drag.factor - 1.0 / drag.factor) * lost["bearing_torque"] / 200.0
    # flanks at 8 angles in place of 32 cancel in the difference
    assert float(one["swing"]) == pytest.approx(swing, rel=1e-9)


def drag_of(law, **options):
    axle = replace(AXLE, bearing_torque_loss=law)
    known = gl.LossMapSettings(axle=axle, **options).uncertain
    return next(one for one in known if one.name == "bearing_drag")


# docs/bearing.md: 2 a priori, more from two measured bearings
@each(
    ("law", "factor"),
    [
        ("palmgren", 3.0),
        ("zhou_hoeprich_1991", 2.0),
        ("biboulet_houpert_2010", 5.0),
        ("aihara_1987", 3.0),
        ("palmgren_loaded", 3.0),
        ("skf_2013", 5.5),
        ("solved_films", 5.5),
    ],
)
def test_bearing_drag_is_as_uncertain_as_the_law_of_a_single_bearing(law, factor):
    assert drag_of(law).factor == factor
    assert UNCALIBRATED[BEARING_LAWS[law]] == factor
    assert "no torque measured" in drag_of(law).why


def test_every_law_of_the_axle_is_a_law_of_a_single_bearing():
    assert set(BEARING_LAWS) == set(TORQUE_LOSSES) - {"none"}
    assert set(BEARING_LAWS.values()) <= set(LAWS)


def test_measured_torques_narrow_the_bar_of_palmgrens_law_alone():
    known = drag_of("palmgren", calibrated_bearings=True)
    assert known.factor == CALIBRATED == 1.25
    assert "measured torques" in known.why
    with pytest.raises(ParameterError, match=r"law palmgren.*got aihara_1987"):
        drag_of("aihara_1987", calibrated_bearings=True)


@pytest.mark.slow
def test_the_command_tells_a_calibrated_map_from_another(tmp_path):
    words = ["map", "--torques", "80", "--speeds", "1000", "2000", "--temperatures", "60"]
    width = {}
    for name, more, factor in (("usual", [], 3), ("measured", ["--calibrated-bearings"], 1.25)):
        out = tmp_path / name
        ended = CliRunner().invoke(command_line(COMMANDS), [*words, *more, "--out", str(out)])
        assert ended.exit_code == 0, ended.output
        with xr.open_dataset(out / "map.nc", engine="scipy") as read:
            one = read.isel(speed=0).squeeze()
            width[name] = float(one["swing"].sel(input="bearing_drag"))
            assert f"bearing_drag: factor {factor:g} (k" in one.attrs["uncertain"]
    # half of f - 1/f: 4/3 and 0.225 of the drag
    assert width["measured"] / width["usual"] == pytest.approx(0.225 * 0.75, rel=1e-6)


def test_the_same_seed_gives_the_same_bars(found):
    again = gl.run_loss_map(
        gl.LossMapSettings(
            axle=AXLE, torques=TORQUES, speeds=SPEEDS, temperatures=np.array(DEGC) + 273.15, draws=4
        )
    )
    assert again["loss_torque_high"].values.tolist() == found["loss_torque_high"].values.tolist()


@pytest.mark.parametrize("name", [one.name for one in UNCERTAIN if one.name != "high_pressure"])
def test_every_uncertain_input_moves_the_loss(found, name):
    swing = found["swing"].sel(input=name).transpose("temperature", "speed", "torque").values
    loaded = np.abs(TORQUES) > 0.0
    assert np.all(swing[:, :, loaded] > 0.0)


def test_viscosity_at_1_gpa_moves_the_loss_of_an_oil_with_a_pressure_factor(found):
    assert "high_pressure" not in found["input"].values  # the paper's oil has none
    axle = replace(AXLE, oil=gl.Lubricant.named("fva_3a"), roughness_rms=5e-8)
    settings = gl.LossMapSettings(
        axle=axle, torques=np.array([100.0]), speeds=SPEEDS[:1], temperatures=np.array([353.15]),
        draws=2,
    )  # fmt: skip
    swing = gl.run_loss_map(settings)["swing"].sel(input="high_pressure").item()
    assert swing > 0.0


def test_the_netcdf_file_holds_the_map(found, folder):
    with xr.open_dataset(folder / "map.nc", engine="scipy") as read:
        assert not without_units(read)
        xr.testing.assert_allclose(gl.studies.Result.of(read, "map"), found)  # of one class


def test_the_table_has_a_row_for_each_point(found, folder):
    with (folder / "map.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(DEGC) * len(SPEEDS) * len(TORQUES)
    row = next(
        one
        for one in rows
        if (float(one["oil_temperature_degc"]), float(one["pinion_torque_n_m"])) == (90.0, 150.0)
    )
    point = found.sel(temperature=90.0, torque=150.0).isel(speed=0)
    assert float(row["loss_torque_n_m"]) == pytest.approx(float(point["loss_torque"]), rel=1e-6)
    assert float(row["loss_bearing_torque_w"]) == pytest.approx(
        float(point["loss"].sel(source="bearing_torque")), rel=1e-6
    )


def test_vecto_reads_its_map_back(found, folder):
    """VECTO interpolates over input speed and output torque (input less loss) by triangles."""
    head, *lines = (folder / "vecto_60degC.vtlm").read_text().splitlines()
    assert head == "Input Speed [rpm],Input Torque [Nm],Torque Loss [Nm]"
    speed, torque, loss = np.array([[float(x) for x in line.split(",")] for line in lines]).T
    assert len(lines) >= 4
    assert np.all(loss > 0.0)
    assert torque.min() < 0.0
    inside = LinearNDInterpolator(
        np.column_stack([speed / speed.max(), (torque - loss) / torque.max()]), loss
    )
    # at rest the losses of the lowest speed, so that no start is beyond the map
    lowest = speed[speed > 0.0].min()
    assert np.array_equal(torque[speed == 0.0], torque[speed == lowest])
    assert np.array_equal(loss[speed == 0.0], loss[speed == lowest])
    assert speed[0] == 0.0
    point = found.sel(temperature=60.0, torque=150.0).isel(speed=1)
    output = 150.0 - float(point["loss_torque"])
    read = float(inside(float(point["speed"]) / speed.max(), output / torque.max()))
    assert read == pytest.approx(float(point["loss_torque"]), abs=2e-4)  # its decimals


def test_gem_rows_have_its_roundings(found, folder):
    with (folder / "gem_60degC.csv").open() as file:
        head, *rows = list(csv.reader(file))
    assert head == ["wheel_speed_rpm", "output_torque_n_m", "power_loss_kw"]
    speed, torque, power = (float(one) for one in rows[-1])
    assert re.fullmatch(r"\d+\.\d", rows[-1][0])
    assert re.fullmatch(r"\d+\.\d{4}", rows[-1][2])
    # output and loss make the input again: 300 N.m at the highest speed
    turning = speed * np.pi / 30.0
    assert (torque * turning + 1e3 * power) / (turning * found.attrs["ratio"]) == pytest.approx(
        300.0, rel=1e-4
    )


def test_the_lossy_gear_loses_what_the_map_does(found):
    """By the equations of Modelica's LossyGear, with the misfit that the file states."""
    one = found.sel(temperature=60.0)
    table = lossy_gear_table(one)
    for row, speed in zip(table.rows, one["speed"].values, strict=True):
        assert row[0] == pytest.approx(speed * np.pi / 30.0)
        for torque in TORQUES:
            drive = (1.0 - row[1]) * torque + row[3]
            coast = (1.0 - 1.0 / row[2]) * torque + row[4]
            lost = drive if torque > 0.0 else coast
            expected = float(one["loss_torque"].sel(speed=speed, torque=torque))
            assert lost == pytest.approx(expected, abs=table.misfit * (1.0 + 1e-9) + 1e-12)
    assert table.misfit < 0.1 * float(one["loss_torque"].max())


def test_matlab_reads_breakpoints_and_table(found, folder):
    read = loadmat(folder / "map.mat", squeeze_me=True)
    assert read["torque_Nm"].tolist() == TORQUES.tolist()
    assert read["torque_loss_Nm"].shape == (3, 6, 2)
    expected = found["loss_torque"].isel(speed=2).sel(torque=50.0, temperature=90.0)
    assert read["torque_loss_Nm"][2, 3, 1] == float(expected)


@pytest.mark.slow
def test_a_point_drawn_by_power_laws_has_the_bars_of_the_map():
    """`drawn_losses` of a sweep: the same draws as the map's, that computes the axle again."""
    from gearlube_core.dynamics.hypoid_axle.uncertain import drawn_losses

    axle = mohammadpour_2015_axle()
    for torque, speed, temperature in ((60.0, 200.0, 333.15), (300.0, 60.0, 368.15)):
        settings = gl.LossMapSettings(
            axle=axle,
            torques=np.array([torque]),
            speeds=np.array([speed]),
            temperatures=np.array([temperature]),
            draws=100,
        )
        one = gl.run_loss_map(settings).squeeze()
        found = drawn_losses(
            axle,
            one["loss"].values,
            torque=torque,
            speed=speed,
            temperature=temperature,
            draws=100,
            seed=settings.seed,
        )
        low, high = np.percentile(found, (2.5, 97.5)) / speed
        # no exact power laws: the Eyring stress is drawn within a factor of 2
        assert low == pytest.approx(float(one["loss_torque_low"]), rel=0.02)
        assert high == pytest.approx(float(one["loss_torque_high"]), rel=0.02)


def test_inputs_without_effect_have_no_bar():
    # this axle has no churning, so its factor moves nothing; bearing drag does
    swing = xr.DataArray(
        [[0.2], [0.0]], dims=("input", "torque"), coords={"input": ["bearing_drag", "churning"]}
    )
    moving, still = moving_inputs(xr.Dataset({"swing": swing, "loss_torque": ("torque", [2.0])}))
    assert moving == {"bearing_drag": pytest.approx(0.1)}
    assert still == ["churning"]


def test_the_parts_without_load_add_up_to_the_loss_there(found):
    (table,) = no_load_table(found)
    parts = {row[0]: np.array(row[1:]) for row in table.rows}
    whole = parts.pop("whole")
    assert sum(parts.values()) == pytest.approx(whole, rel=1e-12)
    idle = found["loss_torque"].sel(torque=0.0).isel(temperature=1)
    assert whole == pytest.approx(idle.values, rel=1e-12)  # three speeds: all are shown
    assert parts["seal of the pinion"] == pytest.approx([0.15] * 3)
    ratio = AXLE.mesh.ratio
    # the factor w/sqrt(w^2 + 1) through rest takes 0.3 % at 14 rad/s of the gear
    assert parts["wheel ends: seals and hubs"] == pytest.approx([0.3 / ratio] * 3, rel=5e-3)
    # like bearings with like preload: the slower shaft counts 1/ratio^(2/3) times 1/ratio by
    # Palmgren's viscous part and 1/ratio by the part of the preload
    share = (
        parts["bearings of the gear's shaft (differential)"]
        / parts["bearings of the pinion's shaft"]
    )
    assert np.all((share > ratio ** (-5.0 / 3.0)) & (share < 1.0 / ratio))


def test_preload_drags_without_load(found):
    loose = replace(AXLE, bearing=replace(AXLE.bearing, preload=0.5 * AXLE.bearing.preload))
    lost = (
        axle_losses(
            loose, torques=np.zeros(1), speeds=SPEEDS, temperatures=np.array([363.15]), angles=8
        )
        .power[0, :, 0]
        .sum(-1)
    )
    torque = lost / SPEEDS
    assert np.all(torque < 0.98 * found["loss_torque"].sel(torque=0.0, temperature=90.0).values)
