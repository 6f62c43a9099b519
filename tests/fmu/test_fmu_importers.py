"""The same numbers in every importer. Enumerations keep their defaults: two of them know none."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from docs.fmu_hosts import hosts
from docs.fmu_hosts.hosts import Job
from tests.helpers.fmu_cases import Case


@pytest.fixture(scope="module")
def job(case: Case, fmu_path: Path) -> Job:
    outputs = [v for v in case.definition.variables if v.causality == "output"]
    return Job(
        fmu=fmu_path,
        reals=case.reals,
        integers=case.integers,
        names=[v.name for v in outputs if v.type == "Real"],
    )


@pytest.fixture(scope="module")
def expected(case: Case, job: Job) -> list[float]:
    """The model in Python, without FMI."""
    return hosts.in_python(job, case.definition)


def test_fmpy_gives_the_numbers_of_the_model(job: Job, expected: list[float]) -> None:
    assert hosts.in_fmpy(job) == expected


def test_libcosim_gives_the_numbers_of_the_model(job: Job, expected: list[float]) -> None:
    assert hosts.in_libcosim(job) == expected


@pytest.mark.slow
def test_ecos_gives_the_numbers_of_the_model(job: Job, expected: list[float]) -> None:
    assert hosts.in_ecos(job) == expected


def test_without_gearlube_the_fmu_says_what_is_missing(
    case: Case, fmu_path: Path, tmp_path: Path
) -> None:
    with zipfile.ZipFile(fmu_path) as archive:
        script = archive.read(f"resources/{case.script}").decode()
    (tmp_path / case.script).write_text(script)
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", script], capture_output=True, text=True, check=False
    )
    assert done.returncode != 0
    assert f"{case.name}.fmu needs the Python package gearlube where it runs" in done.stderr
    assert "pip install gearlube" in done.stderr
