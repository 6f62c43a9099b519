"""An FMU with the mesh table of another gear pair: it carries the table, and shows it."""

from __future__ import annotations

import logging
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from fmpy import extract
from typer.testing import CliRunner

import build_fmu
from drivetrain.axle_file.axle_file import AxleFile
from fmu_src import build, identity
from fmu_src.build import build_hypoid_axle
from fmu_src.check import problems
from fmu_src.hypoid_axle import DEFINITION, definition_with_table
from fmu_src.identity import write_archive
from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT
from gearlube.studies.sweep import run as sweep_run
from gearlube.studies.sweep.axle_in_fmu import car_axle_of
from gearlube.studies.sweep.point import run_point
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, mohammadpour_2015_axle
from gearlube_core.errors import InterruptedRunError, ParameterError, TableError
from gearlube_core.mesh_table.netcdf import FILE_IN_FMU, shipped_mesh_table, write_mesh_table
from tests.helpers.axle_cases import with_coast_flanks, with_shaft_errors
from tests.helpers.fmu_host import FATAL, OK, Host

SHIPPED = shipped_mesh_table("mohammadpour_2015")
# other teeth that are not all alike, and coast flanks that differ from the drive flanks
OTHER = replace(
    with_shaft_errors(with_coast_flanks(SHIPPED)),
    name="pair_11_43",
    pinion_teeth=11,
    gear_teeth=43,
    source="my.toml",
)
H = 2.0**-10
TORQUES = {"pinion__torque": -40.0, "wheel__torque": -40.0 * 43 / 11}
SHORT = {"settling_time": 0.15, "record_time": 0.15, "cage_turns": 0.9}


@pytest.fixture(scope="module")
def table(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_mesh_table(OTHER, tmp_path_factory.mktemp("table") / "my_gear.nc")


@pytest.fixture(scope="module")
def other_fmu(table: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_hypoid_axle(tmp_path_factory.mktemp("fmu"), table)


@pytest.fixture(scope="module")
def other_folder(other_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return Path(extract(str(other_fmu), str(tmp_path_factory.mktemp("extracted"))))


@pytest.fixture
def other_host(host_of: Callable[[Path], Host], other_folder: Path) -> Callable[[], Host]:
    return lambda: host_of(other_folder)


def test_the_fmu_computes_with_its_own_table_bit_for_bit(other_host: Callable[[], Host]) -> None:
    host = other_host()
    assert host.start(**TORQUES) == OK
    assert host.step(H, 5) == OK
    axle = HypoidAxle(mohammadpour_2015_axle(mesh=OTHER))
    torques = tuple(TORQUES.values())
    axle.initialise(
        pinion_speed=200.0,
        pinion_torque=torques[0],
        wheel_torque=torques[1],
        oil_temperature=313.15,
    )
    for _ in range(5):
        axle.step(H, *torques, 313.15)
    names = ["mesh.dte", "mesh.force", "mesh.frequency", "wheel.speed"]
    assert host.get(*names) == [axle.outputs[OUTPUT_INDEX[name]] for name in names]
    # the film is warmer than the oil's data reach, and that is all there is to warn of
    warnings = host.messages("logStatusWarning")
    assert warnings.count("pair: ") == warnings.count("pair: range.temperature: ") == 1


def test_the_description_names_table_teeth_and_source(other_folder: Path) -> None:
    text = (other_folder / "modelDescription.xml").read_text()
    assert "mesh table pair_11_43 (11/43 teeth), from my.toml" in text
    page = (other_folder / "documentation" / "index.html").read_text()
    assert "pair_11_43" in page
    # the variables stay those of every axle
    assert [name for name in DEFINITION.references if f'name="{name}"' not in text] == []


@pytest.mark.slow
def test_the_fmu_is_sound_and_carries_the_file_to_the_byte(other_fmu: Path, table: Path) -> None:
    assert problems(other_fmu) == []
    with zipfile.ZipFile(other_fmu) as archive:
        assert archive.read(f"resources/{FILE_IN_FMU}") == table.read_bytes()


def test_the_guid_follows_the_content_of_the_table_not_its_place(
    table: Path, tmp_path: Path
) -> None:
    copy = tmp_path / "elsewhere.nc"
    copy.write_bytes(table.read_bytes())
    guid = identity.guid_of(definition_with_table(table))
    assert guid == identity.guid_of(definition_with_table(copy))
    # only the numbers differ
    stiffer = {**OTHER.series, "k_m": 1.01 * OTHER.series["k_m"]}
    other = write_mesh_table(replace(OTHER, series=stiffer), tmp_path / "stiffer.nc")
    assert definition_with_table(other).description == definition_with_table(table).description
    assert (
        len({guid, identity.guid_of(definition_with_table(other)), identity.guid_of(DEFINITION)})
        == 3
    )


def repacked(fmu: Path, target: Path, content: bytes) -> Path:
    """The FMU with another mesh table in its resources, extracted."""
    with zipfile.ZipFile(fmu) as archive:
        entries = {name: archive.read(name) for name in archive.namelist()}
    entries[f"resources/{FILE_IN_FMU}"] = content
    write_archive(target / "changed.fmu", entries)
    return Path(extract(str(target / "changed.fmu"), str(target / "changed")))


def test_a_table_exchanged_in_the_archive_is_noticed(other_fmu: Path, tmp_path: Path) -> None:
    stiffer = {**OTHER.series, "k_m": 1.01 * OTHER.series["k_m"]}
    file = write_mesh_table(replace(OTHER, series=stiffer), tmp_path / "stiffer.nc")
    host = Host(repacked(other_fmu, tmp_path, file.read_bytes()))
    assert host.start() == OK
    assert "or its resources were changed" in host.messages("logStatusWarning")
    host.close()


def test_a_damaged_table_in_the_archive_is_refused(other_fmu: Path, tmp_path: Path) -> None:
    folder = repacked(other_fmu, tmp_path, b"CDF\x02 no table")
    with pytest.raises(Exception, match="instantiate"):
        Host(folder)
    with pytest.raises(TableError, match=r"mesh_table\.nc is not a readable NetCDF 3 file"):
        car_axle_of(folder)


def test_states_of_two_tables_do_not_mix(
    other_host: Callable[[], Host], host_of: Callable[[Path], Host], axle_folder: Path
) -> None:
    shipped, other = host_of(axle_folder), other_host()
    for host in (shipped, other):
        assert host.start() == OK
    assert other.restore(shipped.save(), 0.0) == FATAL


@pytest.mark.slow
def test_a_sweep_point_takes_the_final_drive_from_the_fmu(other_folder: Path) -> None:
    drive = car_axle_of(other_folder).driveline.road_load.final_drive
    assert (drive.pinion_teeth, drive.gear_teeth) == (11, 43)
    point = run_point(other_folder, 60.0, 2500.0, SweepSettings(driver="vehicle", **SHORT))
    assert int(point["status"]) == 1, str(point["message"].values)
    pinion = float(point["pinion_frequency"])
    # the wheels turn at the speed of the road whatever the gears; 0.1 % as with the shipped pair
    assert float(point["vehicle_speed"]) == pytest.approx(60.0 / 3.6, rel=1e-3)
    assert float(point["mesh_frequency"]) == pytest.approx(11.0 * pinion, rel=1e-12)
    torque_for_losses = float(point["loss"].sum()) / float(point["pinion_speed"])
    expected = float(point["wheel_torque"]) * 11.0 / 43.0 + torque_for_losses
    # power balance as for the shipped pair: engine orders leave 0.5 % in a record of 0.15 s
    assert float(point["pinion_torque"]) == pytest.approx(expected, rel=5e-3)


def old_format(table: Path, folder: Path) -> Path:
    import xarray as xr

    path = folder / "old.nc"
    with xr.open_dataset(table, engine="scipy") as dataset:
        old = dataset.load()
    old.attrs["gearlube_mesh_table"] = 1
    old.to_netcdf(path, engine="scipy")
    return path


@pytest.mark.parametrize("command", ["build-fmu", "sweep"])
def test_a_bad_table_is_refused_before_any_work(
    command: str, table: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    text = tmp_path / "text.nc"
    text.write_text("no table")
    cases = {
        tmp_path / "absent.nc": "mesh table absent.nc was not found in",
        text: "is not a readable NetCDF 3 file",
        old_format(table, tmp_path): "written by an older gearlube",
    }
    for path, message in cases.items():
        caplog.clear()
        out = tmp_path / "out"
        options = [command, "--mesh-table", str(path), "--out", str(out)]
        result = CliRunner().invoke(cli.app, options)
        assert result.exit_code == BAD_ARGUMENT
        assert message in caplog.text
        assert path.name in caplog.text
        assert str(path.parent) in caplog.text
        assert not (out / "points").exists()
        assert not (out / "HypoidAxle.fmu").exists()


def test_the_commands_pass_the_table_on(
    table: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    assert CliRunner().invoke(
        cli.app, ["build-fmu", "--python", "--mesh-table", str(table), "--out", str(tmp_path)]
    ).exit_code == 0  # fmt: skip
    unzipped = Path(extract(str(tmp_path / "HypoidAxle.fmu"), str(tmp_path / "unzipped")))
    assert car_axle_of(unzipped).axle.mesh.name == "pair_11_43"
    with caplog.at_level(logging.INFO):
        assert (
            build_fmu.main(
                ["--python", "--mesh-table", str(table), "--out", str(tmp_path / "again")]
            )
            == 0
        )
    again = tmp_path / "again" / "HypoidAxle.fmu"
    assert again.read_bytes() == (tmp_path / "HypoidAxle.fmu").read_bytes()
    seen: list[dict[str, object]] = []

    def stopped(settings: SweepSettings, **options: object) -> None:
        seen.append(options)
        raise InterruptedRunError("Stopped.")

    monkeypatch.setattr(sweep_run, "run_sweep", stopped)
    monkeypatch.chdir(tmp_path)  # away from results of an earlier sweep
    CliRunner().invoke(cli.app, ["sweep", "--mesh-table", str(table)])
    assert seen[0]["mesh_table"] == table


def test_a_table_beside_an_fmu_is_refused(
    table: Path, axle_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    options = ["sweep", "--mesh-table", str(table), "--fmu", str(axle_path)]
    assert CliRunner().invoke(cli.app, options).exit_code == BAD_ARGUMENT
    assert "--mesh-table cannot be combined with --fmu" in caplog.text


def test_the_cache_keeps_one_fmu_for_each_table(
    table: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("platformdirs.user_cache_path", lambda name: tmp_path / name)
    own, default = (
        build.cached_hypoid_axle(mesh_table, native=False) for mesh_table in (table, None)
    )
    assert own != default
    written = own.stat().st_mtime_ns
    assert build.cached_hypoid_axle(table, native=False) == own
    assert own.stat().st_mtime_ns == written


def test_teeth_that_no_axle_has_are_told() -> None:
    with pytest.raises(ParameterError, match="pinion_teeth must be within 5 to 500, got 2"):
        AxleFile.named("mohammadpour_2015").car_axle(replace(OTHER, pinion_teeth=2))
