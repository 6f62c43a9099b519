"""HelicalPair.fmu with the gear file, and the line mesh, of another pair."""

from __future__ import annotations

import logging
import zipfile
from collections.abc import Callable
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract
from typer.testing import CliRunner

import build_fmu
from fmu_src import identity
from fmu_src.build import build_helical_pair, build_models
from fmu_src.check import problems
from fmu_src.helical_pair import DEFINITION, GEAR_FILE, LINE_MESH_FILE, definition_with
from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_pair.gear_file_pair import iso_mesh
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh_file import write_line_mesh
from tests.helpers.fmu_cases import HELICAL_PAIR, H, helical
from tests.helpers.fmu_host import FATAL, OK, Host

CUSTOM, LINE_MESH = 4, 2  # of gear.name and mesh.stiffness_model


@pytest.fixture(scope="module")
def gear_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Other bearings and backlash than any shipped pair."""
    shipped = files("gearlube_core.helical_geometry") / "data" / "jamali_2015_a.toml"
    text = (
        shipped.read_text()
        .replace("700.507", "900")
        .replace("backlash_mm = 0.1", "backlash_mm = 0.06")
    )
    path = tmp_path_factory.mktemp("gear") / "my_pair.toml"
    path.write_text(text.replace('name = "jamali_2015_a"', 'name = "my_pair"'))
    return path


@pytest.fixture(scope="module")
def line_mesh(gear_file: Path) -> Path:
    plain = iso_mesh(HelicalGearFile.from_toml(gear_file).helical_pair())
    phase = np.arange(8) / 8.0
    wave = 1e-6 * (1.0 + np.sin(2.0 * np.pi * phase))
    shape = (1, 8, plain.lines, 1)
    mesh = replace(
        plain,
        name="breathing",
        phase=phase,
        density=np.full(shape, plain.density.max()),
        offset=np.broadcast_to(wave[None, :, None, None], shape),
        provenance={"density": "made up", "offset": "made up"},
    )
    return write_line_mesh(mesh, gear_file.with_name("my_mesh.nc"))


@pytest.fixture(scope="module")
def fmu(gear_file: Path, line_mesh: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_helical_pair(tmp_path_factory.mktemp("fmu"), gear_file, line_mesh)


@pytest.fixture(scope="module")
def folder(fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return Path(extract(str(fmu), str(tmp_path_factory.mktemp("extracted"))))


def test_the_fmu_computes_with_its_own_pair_bit_for_bit(
    folder: Path, host_of: Callable[[Path], Host], gear_file: Path, line_mesh: Path
) -> None:
    host = host_of(folder)
    started_with = host.get("gear.name", "mesh.stiffness_model", "mesh.backlash")
    assert started_with == [CUSTOM, LINE_MESH, 0.06e-3]
    torques = 900.0, 900.0 * 34 / 33
    assert host.start(pinion__torque=torques[0], wheel__torque=torques[1]) == OK
    assert host.step(H, 5) == OK
    assert host.messages("logStatusWarning") == ""
    carried = definition_with(gear_file, line_mesh)
    parameters = {v.name: v.decoded(v.start) for v in carried.variables if v.is_model_parameter}
    pair = carried.start_model(parameters, [*torques, 333.15])
    for _ in range(5):
        pair.step(H, *torques, 333.15)
    # by name: younger outputs stand at the end of an FMU
    told = [n for n, v in host.variables.items() if v.causality in ("output", "local")]
    assert host.outputs() == [pair.output(name) for name in told]
    # not the numbers of the shipped pair, nor those without the mesh
    gear = HelicalGearFile.from_toml(gear_file)
    parameters["mesh.stiffness_model"] = "uniform"
    plain = carried.start_model(parameters, [*torques, 333.15])
    assert isinstance(plain, HelicalPairModel)
    assert plain.parameters.gear.support.first.K_xx == pytest.approx(900e6)
    assert plain.parameters.pair == gear.helical_pair()
    assert plain.outputs[6] != pair.outputs[6]


def test_a_pair_of_its_own_starts_at_the_balanced_operation_of_its_file(gear_file: Path) -> None:
    starts = {v.name: v.start for v in definition_with(gear_file).variables}
    file = HelicalGearFile.from_toml(gear_file)
    assert file.operation is not None
    torque, rpm = file.operation.pinion_torque_n_m, file.operation.pinion_speed_rpm
    assert starts["pinion.torque"] == torque
    assert starts["wheel.torque"] == pytest.approx(torque * file.gear.teeth / file.pinion.teeth)
    assert starts["pinion.speed_start"] == pytest.approx(rpm * 2.0 * np.pi / 60.0)
    plain = {v.name: v.start for v in DEFINITION.variables}
    assert starts["wheel.torque"] != plain["wheel.torque"]


def test_the_shipped_pairs_are_still_inside(folder: Path, host_of: Callable[[Path], Host]) -> None:
    host = host_of(folder)
    plain = {v.name: v.start for v in DEFINITION.variables}
    assert (
        host.start(
            gear__name=1,
            mesh__stiffness_model=1,
            mesh__backlash=100e-6,
            oil__name=plain["oil.name"],  # the file has an oil of its own
            oil__temperature=333.15,
            pinion__torque=plain["pinion.torque"],
            wheel__torque=plain["wheel.torque"],
            pinion__speed_start=plain["pinion.speed_start"],
        )
        == OK
    )
    assert host.step(H) == OK
    assert host.outputs() == HELICAL_PAIR.direct(1)


def test_an_fmu_without_a_gear_file_refuses_custom(
    extracted: Callable[..., Path], host_of: Callable[[Path], Host]
) -> None:
    host = host_of(extracted(HELICAL_PAIR))
    assert host.start(gear__name=CUSTOM) == FATAL
    assert "carries no gear file" in host.messages("logStatusFatal")
    assert "gearlube build-fmu --gear" in host.messages("logStatusFatal")


def test_a_pair_without_line_mesh_refuses_it(
    extracted: Callable[..., Path], host_of: Callable[[Path], Host], gear_file: Path
) -> None:
    host = host_of(extracted(HELICAL_PAIR))
    assert host.start(gear__name=2, mesh__stiffness_model=LINE_MESH) == FATAL
    assert "'jamali_2015_a' is shipped" in host.messages("logStatusFatal")
    carried = definition_with(gear_file)
    parameters = {v.name: v.decoded(v.start) for v in carried.variables if v.is_model_parameter}
    with pytest.raises(ParameterError, match="this FMU carries no line mesh"):
        carried.start_model(
            parameters | {"mesh.stiffness_model": "line_mesh"}, [900.0, 900.0, 333.15]
        )


@pytest.mark.slow
def test_the_fmu_is_sound_and_carries_the_files_to_the_byte(
    fmu: Path, gear_file: Path, line_mesh: Path, folder: Path
) -> None:
    assert problems(fmu) == []
    with zipfile.ZipFile(fmu) as archive:
        assert archive.read(f"resources/{GEAR_FILE}") == gear_file.read_bytes()
        assert archive.read(f"resources/{LINE_MESH_FILE}") == line_mesh.read_bytes()
    text = (folder / "modelDescription.xml").read_text()
    assert "gear file my_pair (33/34 teeth), line mesh breathing" in text
    assert [name for name in DEFINITION.references if f'name="{name}"' not in text] == []


def test_the_guid_follows_the_content_of_the_files(gear_file: Path, line_mesh: Path) -> None:
    definitions = (
        DEFINITION, definition_with(gear_file), definition_with(gear_file, line_mesh),
    )  # fmt: skip
    assert len({identity.guid_of(d) for d in definitions}) == 3
    copy = gear_file.with_name("copy.toml")
    copy.write_bytes(gear_file.read_bytes())
    assert identity.guid_of(definition_with(copy)) == identity.guid_of(definitions[1])


def test_wrong_files_are_named(gear_file: Path, line_mesh: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.toml"
    bad.write_text("name = 3")
    for path, message in (
        (tmp_path / "absent.toml", "gear file absent.toml was not found in"),
        (bad, r"bad\.toml: The gear file has"),
        (line_mesh, "not a readable TOML file"),
    ):
        with pytest.raises(ParameterError, match=message):
            definition_with(path)
    with pytest.raises(ParameterError, match="--line-mesh needs --gear: give the gear file"):
        definition_with(None, line_mesh)
    with pytest.raises(TableError, match=r"bad\.toml"):
        definition_with(gear_file, bad)
    with pytest.raises(TableError, match=r"line mesh absent\.nc was not found in "):
        definition_with(gear_file, tmp_path / "absent.nc")
    other = write_line_mesh(helical().mesh, tmp_path / "he.nc")
    with pytest.raises(TableError, match=r"he\.nc: mesh must belong to the pair of 33 and 34"):
        definition_with(gear_file, other)


def test_the_commands_build_what_is_asked_for(
    gear_file: Path, line_mesh: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    files_given = ["--gear", str(gear_file), "--line-mesh", str(line_mesh)]
    run = CliRunner().invoke
    assert (
        run(
            cli.app, ["build-fmu", "--python", *files_given, "--out", str(tmp_path / "a")]
        ).exit_code
        == 0
    )
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["HelicalPair.fmu"]
    with caplog.at_level(logging.INFO):
        assert build_fmu.main(["--python", *files_given, "--out", str(tmp_path / "b")]) == 0
    built = [(tmp_path / name / "HelicalPair.fmu").read_bytes() for name in "ab"]
    assert built[0] == built[1]
    one = ["build-fmu", "--python", "--model", "hypoid-axle", "--out", str(tmp_path / "c")]
    assert run(cli.app, one).exit_code == 0
    assert [path.name for path in (tmp_path / "c").iterdir()] == ["HypoidAxle.fmu"]
    names = sorted(path.name for path in build_models(tmp_path / "d"))
    assert names == ["HelicalPair.fmu", "HypoidAxle.fmu"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--model", "spur"], "--model must be one of hypoid-axle, helical-pair"),
        (
            ["--model", "hypoid-axle", "--gear", "GEAR"],
            "--gear can only be given with --model helical",
        ),
        (["--line-mesh", "MESH"], "--line-mesh needs --gear: give the gear file"),
        (["--gear", "MESH"], "not a readable TOML file"),
    ],
)
def test_options_that_do_not_fit_are_refused_before_anything_is_written(
    options: list[str],
    message: str,
    gear_file: Path,
    line_mesh: Path,
    tmp_path: Path,
    caplog: pytest.LogCaptureFixture,
) -> None:
    places = {"GEAR": str(gear_file), "MESH": str(line_mesh)}
    arguments = [places.get(option, option) for option in options]
    result = CliRunner().invoke(cli.app, ["build-fmu", *arguments, "--out", str(tmp_path)])
    assert result.exit_code == BAD_ARGUMENT
    assert message in caplog.text
    assert list(tmp_path.iterdir()) == []
