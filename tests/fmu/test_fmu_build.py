from __future__ import annotations

import hashlib
import logging
import os
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest

from build_fmu import main
from fmu_src import identity
from fmu_src.check import problems
from fmu_src.identity import write_archive
from tests.helpers.fmu_cases import CASES, Case


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_two_builds_in_different_processes_are_equal_bit_for_bit(
    case: Case, fmu_path: Path, tmp_path: Path
) -> None:
    code = f"import sys; from fmu_src.build import {case.build.__name__} as b; b(sys.argv[1])"
    environment = os.environ | {"PYTHONHASHSEED": "4711", "TZ": "Pacific/Auckland"}
    subprocess.run([sys.executable, "-c", code, str(tmp_path)], env=environment, check=True)
    assert _digest(tmp_path / f"{case.name}.fmu") == _digest(fmu_path)


def test_building_leaves_the_imports_of_the_process_alone(case: Case, tmp_path: Path) -> None:
    path_before = list(sys.path)
    case.build(tmp_path)
    assert sys.path == path_before
    assert Path(case.script).stem not in sys.modules


def test_a_build_replaces_the_file_and_leaves_nothing_else(case: Case, tmp_path: Path) -> None:
    (tmp_path / f"{case.name}.fmu").write_bytes(b"old")
    built = case.build(tmp_path)
    assert zipfile.is_zipfile(built)
    assert [path.name for path in tmp_path.iterdir()] == [f"{case.name}.fmu"]


def test_a_failed_write_leaves_the_old_file(tmp_path: Path) -> None:
    target = tmp_path / "a.zip"
    target.write_bytes(b"old")
    with pytest.raises(TypeError):
        write_archive(target, {"a": b"x", "b": None})  # type: ignore[dict-item]
    assert target.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [target]


def test_the_guid_follows_the_interface(case: Case) -> None:
    definition = case.definition
    changed = replace(definition, variables=definition.variables[:-1])
    assert identity.guid_of(changed) != identity.guid_of(definition)


def test_the_command_builds_and_checks(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.INFO):
        assert main(["--python", "--out", str(tmp_path), "--check"]) == 0
    assert "no problem found by fmpy and fmutool" in caplog.text
    assert {path.name for path in tmp_path.iterdir()} == {f"{case.name}.fmu" for case in CASES}


@pytest.mark.slow
def test_the_check_reports_an_output_without_unit(fmu_path: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(fmu_path) as archive:
        content = {name: archive.read(name) for name in archive.namelist()}
    xml = content["modelDescription.xml"]
    content["modelDescription.xml"] = xml.replace(b'<Unit name="J">', b'<Unit name="calorie">')
    broken = tmp_path / "broken.fmu"
    write_archive(broken, content)
    assert any('unit "J"' in problem for problem in problems(broken))


@pytest.mark.slow
def test_the_check_reports_an_output_missing_from_the_structure(
    case: Case, fmu_path: Path, tmp_path: Path
) -> None:
    with zipfile.ZipFile(fmu_path) as archive:
        content = {name: archive.read(name) for name in archive.namelist()}
    xml = content["modelDescription.xml"]
    first = 1 + case.definition.references_of("output")[0]
    unknown = f'<Unknown index="{first}" dependencies="" />'.encode()
    assert unknown in xml
    content["modelDescription.xml"] = xml.replace(unknown, b"", 1)
    broken = tmp_path / "broken.fmu"
    write_archive(broken, content)
    found = problems(broken)
    assert any(problem.startswith("fmpy") for problem in found)
    assert any(problem.startswith("fmutool") for problem in found)
