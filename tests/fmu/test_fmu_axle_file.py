"""FMUs of axle files: what they carry, how they start, and that they compute that axle."""

from __future__ import annotations

import json
import logging
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from fmpy import extract
from typer.testing import CliRunner

from drivetrain.axle_file.read_axle import read_axle
from fmu_src import build, identity
from fmu_src.axle_arguments import CUSTOM_OIL, axle_parameters, start_arguments
from fmu_src.build import build_hypoid_axle
from fmu_src.check import problems
from fmu_src.hypoid_axle import (
    AXLE_FILE,
    DEFINITION,
    car_axle_in,
    definition_with_axle,
    definition_with_table,
)
from fmu_src.native.hypoid_axle import native_model
from fmu_src.native.model import OK as DONE
from fmu_src.native.model import Operation
from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT
from gearlube.studies.sweep import run as sweep_run
from gearlube.studies.sweep.axle_in_fmu import assumed_inputs, car_axle_of, settings_of
from gearlube.studies.sweep.point import run_point
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.dynamics.hypoid_axle import HypoidAxle
from gearlube_core.errors import InterruptedRunError, ParameterError
from gearlube_core.input_file.input_file import notes_as_text
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.mesh_table.netcdf import FILE_IN_FMU, shipped_mesh_table, write_mesh_table
from tests.helpers.fmu_cases import H
from tests.helpers.fmu_host import OK, Host
from tests.helpers.object_code import LoadedModel

EXAMPLE = Path(__file__).parents[2] / "examples" / "my_axle.toml"
OIL = 353.15  # K
TORQUES = {"pinion.torque": 60.0, "wheel.torque": 160.0, "oil.temperature": OIL}
TEXT = """
name = "two_bearings"
[gear_set]
mesh_table = "own.nc"
backlash_um = 90.0
[pinion]
mass_kg = 9.0
bearing = { preload_n = 3000.0, contact_angle_deg = 18.0, f0 = 5.0 }
[gear]
inertia_kg_m2 = 0.07
bearing = { rollers = 10, roller_length_mm = 18.0, preload_n = 1500.0 }
[oil]
name = "karagiannis_2012"
[model]
friction = "as_printed"
[vehicle]
mass_kg = 1600.0
"""


@pytest.fixture(scope="module")
def axle_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("axle")
    own = replace(shipped_mesh_table("mohammadpour_2015"), name="own", source="a test")
    write_mesh_table(own, folder / "own.nc")
    path = folder / "two_bearings.toml"
    path.write_text(TEXT)
    return path


@pytest.fixture(scope="module")
def fmu(axle_file: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_hypoid_axle(tmp_path_factory.mktemp("fmu"), axle=axle_file)


@pytest.fixture(scope="module")
def folder(fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return Path(extract(str(fmu), str(tmp_path_factory.mktemp("extracted"))))


def in_python(path: Path, steps: int, h: float) -> HypoidAxle:
    axle = HypoidAxle(read_axle(path).axle)
    axle.initialise(pinion_speed=200.0, pinion_torque=60.0, wheel_torque=160.0, oil_temperature=OIL)
    for _ in range(steps):
        axle.step(h, 60.0, 160.0, OIL)
    return axle


@pytest.mark.slow
def test_the_fmu_in_python_computes_the_axle_of_its_file_bit_for_bit(
    folder: Path, axle_file: Path, host_of: Callable[[Path], Host]
) -> None:
    host = host_of(folder)
    assert host.start(**TORQUES) == OK
    assert host.step(H, 5) == OK
    axle = in_python(axle_file, 5, H)
    assert host.get(*axle.output_names[:4]) == axle.outputs[:4].tolist()
    names = ["mesh.dte", "mesh.force", "bearing[3].force.x", "energy.stored"]
    assert host.get(*names) == [axle.output(name) for name in names]


@pytest.mark.slow
def test_the_fmu_is_sound_and_carries_both_files_to_the_byte(fmu: Path, axle_file: Path) -> None:
    assert problems(fmu) == []
    with zipfile.ZipFile(fmu) as archive:
        assert archive.read(f"resources/{AXLE_FILE}") == axle_file.read_bytes()
        table = axle_file.with_name("own.nc").read_bytes()
        assert archive.read(f"resources/{FILE_IN_FMU}") == table
        description = archive.read("modelDescription.xml").decode()
    assert "axle file two_bearings; mesh table own (13/36 teeth), from a test" in description


def starts(path: Path) -> dict[str, float]:
    return {v.name: v.start for v in definition_with_axle(path).variables if v.start is not None}


def test_the_parameters_start_at_the_values_of_the_file(axle_file: Path) -> None:
    found = starts(axle_file)
    expected = {
        "mesh.backlash": 90e-6,
        "pinion.mass": 9.0,
        "wheel.mass": 49.9,  # of the paper, as the file has none
        "wheel.inertia": 0.07,
        "bearing.preload": 3000.0,
        "wheel.bearing.preload": 1500.0,
        "pinion.bearing.contact_angle": np.radians(18.0),
        "wheel.bearing.contact_angle": np.radians(15.0),
        "pinion.bearing.f0": 5.0,
        "wheel.bearing.f0": 6.0,
        "oil.name": 2,
        "friction.model": 2,
        "pinion.torque": 60.0,
    }
    assert {name: found[name] for name in expected} == expected
    # an oil of its own is the literal after those that ship
    assert starts(EXAMPLE)["oil.name"] == 9
    oil = definition_with_axle(EXAMPLE).variables[DEFINITION.references["oil.name"]]
    assert oil.literals[8:] == (CUSTOM_OIL,)
    names = [v.name for v in definition_with_axle(EXAMPLE).variables]
    assert names == [v.name for v in DEFINITION.variables]
    by_number = definition_with_axle(EXAMPLE).variables[DEFINITION.references["oil.name.number"]]
    assert by_number.range == (0.0, 9.0)


def test_the_load_of_another_ratio_starts_in_balance_with_the_pinion(tmp_path: Path) -> None:
    paper = shipped_mesh_table("mohammadpour_2015")
    write_mesh_table(
        replace(paper, name="own", pinion_teeth=11, gear_teeth=41), tmp_path / "own.nc"
    )
    path = tmp_path / "axle.toml"
    path.write_text('[gear_set]\nmesh_table = "own.nc"\n')
    # the plain FMU has 60 and 160 N.m at 13 to 36 teeth
    assert starts(path)["wheel.torque"] == pytest.approx(160.0 * (41 / 11) / (36 / 13))
    assert starts(path)["pinion.torque"] == 60.0


def test_the_shipped_file_starts_where_the_plain_fmu_starts() -> None:
    plain = {v.name: v.start for v in DEFINITION.variables}
    assert {v.name: v.start for v in definition_with_axle("mohammadpour_2015").variables} == plain


@pytest.mark.slow
def test_the_guid_follows_every_byte_of_file_and_table(axle_file: Path, tmp_path: Path) -> None:
    path, table = tmp_path / "copy.toml", tmp_path / "own.nc"
    path.write_bytes(axle_file.read_bytes())
    table.write_bytes(axle_file.with_name("own.nc").read_bytes())
    guid = identity.guid_of(definition_with_axle(axle_file))
    assert identity.guid_of(definition_with_axle(path)) == guid
    path.write_text(TEXT.replace("1600.0", "1601.0"))
    assert identity.guid_of(definition_with_axle(path)) != guid
    path.write_bytes(axle_file.read_bytes())
    own = shipped_mesh_table("mohammadpour_2015")
    stiffer = {**own.series, "k_m": 1.01 * own.series["k_m"]}
    write_mesh_table(replace(own, name="own", source="a test", series=stiffer), table)
    assert identity.guid_of(definition_with_axle(path)) != guid
    with_table = identity.guid_of(definition_with_table(axle_file.with_name("own.nc")))
    assert len({guid, with_table, identity.guid_of(DEFINITION)}) == 3


def test_lines_that_end_as_on_windows_make_the_same_fmu(axle_file: Path) -> None:
    windows = axle_file.with_name("windows.toml")
    windows.write_bytes(TEXT.replace("\n", "\r\n").encode())
    assert definition_with_axle(windows) is definition_with_axle(axle_file)


def test_arguments_at_their_start_values_leave_an_axle_as_it_is() -> None:
    axle = read_axle(EXAMPLE).axle
    again = axle_parameters(start_arguments(axle), axle)
    np.testing.assert_array_equal(
        flatten(again.kernel_parameters()), flatten(axle.kernel_parameters())
    )


@pytest.mark.parametrize(("gear", "expected"), [(-1.0, 6000.0), (0.0, 0.0), (700.0, 700.0)])
def test_the_preload_of_the_gears_shaft_is_the_pinions_when_below_zero(gear, expected) -> None:
    made = axle_parameters({"bearing_preload": 6000.0, "gear_bearing_preload": gear})
    p = made.kernel_parameters()
    assert (p.preload_p, p.preload_g) == (6000.0, expected)


@pytest.mark.slow  # half a minute of compilation
def test_the_native_fmu_of_the_example_is_its_axle_in_python_over_20_ms() -> None:
    definition = definition_with_axle(EXAMPLE)
    loaded = LoadedModel(native_model(definition))  # holds the machine code that the run enters
    run = loaded.instance({}, list(TORQUES.values()))
    assert run(Operation.START) == DONE
    axle = in_python(EXAMPLE, 0, H)
    np.testing.assert_array_equal(
        run.work[: flatten(axle.kernel_parameters).size], flatten(axle.kernel_parameters)
    )
    for _ in range(20):
        assert run.step(1e-3) == DONE
        axle.step(1e-3, 60.0, 160.0, OIL)
    scale = np.abs(axle.outputs).max()
    for name, one, two in zip(axle.output_names, run.outputs, axle.outputs, strict=True):
        # roundings of another instruction set, of the largest force where forces cancel
        floor = 1e-12 * scale if "force" in name or "acceleration" in name else 1e-15
        assert one == pytest.approx(two, rel=1e-9, abs=floor), name


@pytest.mark.slow
def test_a_sweep_point_takes_car_and_axle_from_the_fmu(folder: Path) -> None:
    made = car_axle_of(folder)
    assert (made.name, made.driveline.road_load.vehicle.mass) == ("two_bearings", 1600.0)
    settings = settings_of(
        made.axle, driver="hold", settling_time=0.05, record_time=0.05, cage_turns=0.3
    )
    point = run_point(folder, 60.0, 3000.0, settings)
    assert int(point["status"]) == 1, str(point["message"].values)
    road = made.driveline.road_load
    # the held speed swings by less than 0.1 % of it, and the load with it
    assert float(point["wheel_torque"]) == pytest.approx(road.ring_gear_torque(60 / 3.6), rel=2e-3)


@pytest.mark.slow
def test_a_point_of_the_shipped_file_is_that_of_the_plain_fmu(
    axle_folder: Path, tmp_path: Path
) -> None:
    fmu = build_hypoid_axle(tmp_path, axle="mohammadpour_2015")
    shipped = Path(extract(str(fmu), str(tmp_path / "shipped")))
    settings = SweepSettings(settling_time=0.02, record_time=0.02, cage_turns=0.1)
    assert settings_of(car_axle_of(shipped).axle) == SweepSettings()
    plain, of_file = (run_point(one, 60.0, 2500.0, settings) for one in (axle_folder, shipped))
    assert int(plain["status"]) == 1, str(plain["message"].values)
    xr.testing.assert_identical(of_file, plain)


def test_settings_of_a_sweep_start_from_the_file(axle_file: Path) -> None:
    settings = settings_of(read_axle(axle_file).axle)
    assert (settings.backlash, settings.oil) == (90e-6, "karagiannis_2012")
    assert (settings.friction, settings.roughness_rms) == ("as_printed", 0.5e-6)
    assert settings_of(read_axle(EXAMPLE).axle).oil == CUSTOM_OIL


def test_the_cache_keeps_one_fmu_for_each_content(
    axle_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("platformdirs.user_cache_path", lambda name: tmp_path / name)
    own = build.cached_hypoid_axle(axle=axle_file, native=False)
    written = own.stat().st_mtime_ns
    copy = axle_file.with_name("copy.toml")
    copy.write_bytes(axle_file.read_bytes())
    assert build.cached_hypoid_axle(axle=copy, native=False) == own
    assert own.stat().st_mtime_ns == written
    copy.write_text(TEXT.replace("9.0", "9.5"))
    assert build.cached_hypoid_axle(axle=copy, native=False) != own
    assert car_axle_of(own).axle.pinion_mass == 9.0


def passed_to_the_sweep(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> dict[str, object]:
    seen: list[dict[str, object]] = []

    def stopped(settings: object, **options: object) -> None:
        seen.append({"settings": settings, **options})
        raise InterruptedRunError("Stopped.")

    monkeypatch.setattr(sweep_run, "run_sweep", stopped)
    result = CliRunner().invoke(cli.app, ["sweep", *arguments])
    assert seen, result.output
    return seen[0]


def test_the_sweep_takes_file_and_options(
    axle_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    seen = passed_to_the_sweep(
        monkeypatch, "--speeds", "40", "60", str(axle_file), "--friction", "off"
    )
    assert (seen["axle"], seen["speeds_kmh"]) == (str(axle_file), (40.0, 60.0))
    assert seen["preloads"] == (3000.0,)
    settings = seen["settings"]
    assert (settings.friction, settings.oil, settings.backlash) == ("off", "karagiannis_2012", 9e-5)
    seen = passed_to_the_sweep(monkeypatch, str(axle_file), "--preload", "500")
    assert list(seen["preloads"]) == [500.0]
    seen = passed_to_the_sweep(monkeypatch)
    assert (seen["axle"], seen["preloads"]) == (None, (2500.0, 6000.0))
    assert seen["settings"].oil == "mohammadpour_2015"


@pytest.mark.parametrize("command", [["sweep"], ["build-fmu", "--axle"], ["axle", "show"]])
def test_a_wrong_file_is_refused_before_any_work(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "wrong.toml"
    cases = {
        '[gear_set]\nmesh_table = "x.nc"\n': ("x.nc was not found in", "x.nc"),
        '[gear_set]\nmesh_table = "x"\n[gear]\nmass_kg = -1.0\n': (
            "gear.mass_kg must be a number",
            "wrong.toml",
        ),
        "[gear_set\n": ("not a readable TOML file", "wrong.toml"),
    }
    for text, (message, named) in cases.items():
        caplog.clear()
        path.write_text(text)
        result = CliRunner().invoke(cli.app, [*command, str(path)])
        assert result.exit_code == BAD_ARGUMENT, result.output
        assert message in caplog.text
        assert named in caplog.text
        assert [entry.name for entry in tmp_path.iterdir()] == ["wrong.toml"]
    caplog.clear()
    assert CliRunner().invoke(cli.app, [*command, "absent.toml"]).exit_code == BAD_ARGUMENT
    assert "absent.toml" in caplog.text


def test_one_gear_set_one_source(
    axle_file: Path, fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    table = str(axle_file.with_name("own.nc"))
    for arguments, message in (
        (["sweep", str(axle_file), "--mesh-table", table], "cannot be combined with an axle file"),
        (["build-fmu", "--axle", str(axle_file), "--mesh-table", table], "gear_set.mesh_table"),
        (["sweep", str(axle_file), "--fmu", str(fmu)], "cannot be combined with --fmu"),
        (
            ["build-fmu", "--axle", str(axle_file), "--model", "helical-pair"],
            "--axle can only be given",
        ),
    ):
        caplog.clear()
        assert CliRunner().invoke(cli.app, arguments).exit_code == BAD_ARGUMENT
        assert message in caplog.text
    assert list(tmp_path.iterdir()) == []


def test_a_road_that_asks_for_too_much_torque_is_refused_before_anything_is_built(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def built(*_arguments: object, **_options: object) -> None:
        raise AssertionError("built")

    monkeypatch.setattr(build, "cached_hypoid_axle", built)
    monkeypatch.setattr(sweep_run, "_modes_aside", lambda *_, **_to_build: None)  # its own process
    lorry = tmp_path / "lorry.toml"
    lorry.write_text('gear_set.mesh_table = "mohammadpour_2015"\nvehicle.mass_kg = 40000.0\n')
    out = tmp_path / "out"
    arguments = ["sweep", str(lorry), "--speeds", "60", "--out", str(out)]
    assert CliRunner().invoke(cli.app, arguments).exit_code == BAD_ARGUMENT
    # 0.0166 * 40 000 kg * 9.80665 m/s2 and 123 N of air, times 0.3203 m * 13/36
    assert "got 767.5 N.m at 60 km/h" in caplog.text
    assert "within -600 to 600 N.m" in caplog.text
    lorry.write_text('gear_set.mesh_table = "mohammadpour_2015"\nvehicle.mass_kg = 25000.0\n')
    caplog.clear()
    with pytest.raises(AssertionError, match="built"), caplog.at_level(logging.WARNING):
        sweep_run.run_sweep(speeds_kmh=[60.0], preloads=[2500.0], axle=lorry)
    assert "the road takes 485" in caplog.text


def test_oil_beyond_its_data_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "oil.toml"
    path.write_text('gear_set.mesh_table = "mohammadpour_2015"\noil.temperature_high_degc = 96.0\n')
    settings = settings_of(read_axle(path).axle, oil_temperature=380.0)
    with pytest.raises(ParameterError, match=r"within 273\.15 to 369\.15 K, got 380 K"):
        sweep_run.run_sweep(settings, speeds_kmh=[60.0], preloads=[2500.0], axle=path)


def test_the_report_lists_what_was_assumed_but_not_what_the_sweep_sets() -> None:
    made = car_axle_in({})
    assumed = {note.field for note in assumed_inputs(made, settings_of(made.axle))}
    assert {"gearbox.ratios", "model.friction"} <= assumed
    assert not assumed & {"vehicle.mass_kg", "pinion.bearing.preload_n"}
    without = {n.field for n in assumed_inputs(made, settings_of(made.axle, friction="off"))}
    assert assumed - without == {"model.friction"}
    rows = json.loads(notes_as_text(assumed_inputs(made, settings_of(made.axle))))
    ratios = next(row for row in rows if row[0] == "gearbox.ratios")
    assert ratios[1] == "3.6, 2.1, 1.4, 1, 0.8"
