"""The same numbers in every importer. Enumerations keep their defaults: two of them know none."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from importlib.metadata import files
from pathlib import Path
from typing import Any

import pytest
from fmpy import simulate_fmu

from tests.helpers.fmu_cases import Case

H = 2.0**-9  # s; exact in binary and a whole number of nanoseconds, as libcosim counts
STEPS = 16


@pytest.fixture(scope="module")
def names(case: Case) -> list[str]:
    return [
        v.name for v in case.definition.variables if v.causality == "output" and v.type == "Real"
    ]


@pytest.fixture(scope="module")
def expected(case: Case, names: list[str]) -> list[float]:
    """The model in Python, without FMI."""
    definition = case.definition
    parameters = {v.name: v.decoded(v.start) for v in definition.variables if v.is_model_parameter}
    values = case.reals | case.integers
    parameters |= {name: values[name] for name in parameters.keys() & values.keys()}
    inputs = [case.reals[name] for name in ("pinion.torque", "wheel.torque", "oil.temperature")]
    model = definition.start_model(parameters, inputs)
    for _ in range(STEPS):
        model.step(H, *inputs)
    outputs = dict(zip(definition.output_names, model.outputs.tolist(), strict=True))
    return [outputs[name] for name in names]


@pytest.fixture(scope="module")
def job(case: Case, fmu_path: Path, names: list[str]) -> str:
    references = case.definition.references
    content: dict[str, Any] = {
        "fmu": str(fmu_path),
        "step_size": H,
        "steps": STEPS,
        "reals": [(references[name], value) for name, value in case.reals.items()],
        "integers": [(references[name], value) for name, value in case.integers.items()],
        "references": [references[name] for name in names],
        "named_reals": case.reals,
        "named_integers": case.integers,
        "names": names,
    }
    return json.dumps(content)


def _run(script: str, job: str, environment: dict[str, str]) -> list[float]:
    done = subprocess.run(
        [sys.executable, str(Path(__file__).with_name(script))],
        input=job,
        capture_output=True,
        text=True,
        env=os.environ | environment,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_fmpy_gives_the_numbers_of_the_model(
    case: Case, fmu_path: Path, names: list[str], expected: list[float]
) -> None:
    result = simulate_fmu(
        str(fmu_path),
        stop_time=STEPS * H,
        output_interval=H,
        start_values=case.reals | case.integers,
        output=names,
    )
    assert [float(result[name][-1]) for name in names] == expected


def test_libcosim_gives_the_numbers_of_the_model(job: str, expected: list[float]) -> None:
    assert _run("importer_libcosim.py", job, {}) == expected


def test_ecos_gives_the_numbers_of_the_model(job: str, expected: list[float]) -> None:
    (library,) = {Path(str(f.locate())).resolve() for f in files("tbb") if f.name == "libtbb.so.12"}
    search = f"{library.parent}{os.pathsep}{os.environ.get('LD_LIBRARY_PATH', '')}"
    assert _run("importer_ecos.py", job, {"LD_LIBRARY_PATH": search}) == expected


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
