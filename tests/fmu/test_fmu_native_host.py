"""Programs that are not Python run the FMUs and end well: Python ends before what it has loaded."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import files
from pathlib import Path

import fmpy
import pytest
from fmpy import read_model_description

from gearlube.cli.native import native_environment, shared_python, shell_lines
from gearlube_core.errors import GearLubeError
from tests.helpers.fmu_cases import CASES, Case, H

STEPS = 16


def python_is_shared() -> bool:
    try:
        shared_python()
    except GearLubeError:
        return False
    return True


# The FMU cannot be loaded there, whatever it does; what the user is told is tested below.
pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux") or not python_is_shared(),
    reason="no shared libpython for a Linux program to load",
)
COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")


def located(package: str, path: str) -> Path:
    (found,) = {Path(str(f.locate())).resolve() for f in files(package) or () if f.match(path)}
    return found


def expected_outputs(case: Case) -> dict[str, float]:
    """Outputs of the model in Python, without FMI."""
    outputs = case.direct(STEPS, oil_temperature=case.start("oil.temperature"))
    computed = [v.name for v in case.definition.variables if v.is_computed]
    return dict(zip(computed, outputs, strict=True))


def run(command: list[str], environment: dict[str, str], **named: object) -> str:
    done = subprocess.run(
        command,
        env=native_environment(environment),
        capture_output=True,
        text=True,
        check=False,
        **named,
    )
    assert done.returncode == 0, done.stderr  # a crash at the end is a negative one
    return done.stdout


@(pytest.mark.slow if COMPILER else lambda test: test)  # the host below ends in all ways
def test_ecos_runs_the_fmu_and_ends_well(case: Case, fmu_path: Path, tmp_path: Path) -> None:
    # A native program that comes with a Python package: it needs no compiler here.
    ecos = Path(shutil.copy(located("ecospy", "binaries/ecos"), tmp_path))
    ecos.chmod(0o755)
    search = f"{located('tbb', 'libtbb.so.12').parent}:{os.environ.get('LD_LIBRARY_PATH', '')}"
    job = ["--path", str(fmu_path), "--stopTime", str(STEPS * H), "--stepSize", str(H)]
    run([str(ecos), "simulate", *job], os.environ | {"LD_LIBRARY_PATH": search}, cwd=tmp_path)
    with (tmp_path / f"{case.name}.csv").open() as stream:
        last = list(csv.DictReader(stream, skipinitialspace=True))[-1]
    expected = expected_outputs(case)
    for name in ("pinion.speed", case.load, "bearing[1].force.x"):
        assert float(last[f"instance::{name}[REAL]"]) == pytest.approx(expected[name], abs=1e-6)


# Several FMUs and endings in one process take a program of our own. Where there is no compiler, the
# test above still holds the commonest sequence: one FMU, freed and closed.
@pytest.mark.slow
@pytest.mark.skipif(COMPILER is None, reason="no C compiler for a host of several FMUs")
@pytest.mark.parametrize(
    "ending",
    [
        pytest.param("free", marks=pytest.mark.slow),
        pytest.param("close", marks=pytest.mark.slow),
        "leave",
    ],
)
def test_a_host_of_both_fmus_ends_well(
    extracted: Callable[[Case], Path], tmp_path: Path, ending: str
) -> None:
    host = tmp_path / "native_host"
    source = Path(__file__).with_name("native_host.c")
    headers = Path(fmpy.__file__).parent / "c-code"
    subprocess.run(
        [str(COMPILER), "-std=c99", f"-I{headers}", str(source), "-o", str(host), "-ldl"],
        check=True,
    )
    arguments, expected = [], []
    for case in CASES:
        folder = extracted(case)
        library = folder / "binaries" / "linux64" / f"{case.name}.so"
        guid = read_model_description(str(folder)).guid
        reference = str(case.definition.references[case.load])
        arguments += [str(library), (folder / "resources").as_uri(), guid, reference]
        expected += 2 * [expected_outputs(case)[case.load]]
    printed = run([str(host), ending, str(STEPS), str(H), *arguments], dict(os.environ))
    assert [float(line) for line in printed.split()] == expected


def test_the_lines_for_a_shell_set_the_same_environment() -> None:
    names = ("LD_PRELOAD", "PATH")
    script = "\n".join([*shell_lines(), *(f'echo "${name}"' for name in names)])
    base = {"PATH": os.environ["PATH"]}
    done = subprocess.run(
        ["/bin/sh", "-c", script], env=base, capture_output=True, text=True, check=True
    )
    environment = native_environment(base)
    assert done.stdout.splitlines() == [environment[name] for name in names]


def test_a_program_gets_its_own_options_and_gives_its_own_exit_code() -> None:
    command = [sys.executable, "-c", "from gearlube.command import main; main()", "native"]
    program = ["sh", "-c", 'echo "$LD_PRELOAD" "$0"; exit 5', "--help"]
    base = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    done = subprocess.run(
        [*command, *program], env=base, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) == (5, f"{shared_python()} --help\n")
