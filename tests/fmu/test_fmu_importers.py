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

from fmu_src.hypoid_axle import DEFINITION, start_axle

H = 2.0**-9  # s; exact in binary and a whole number of nanoseconds, as libcosim counts
STEPS = 16
REALS = {
    "pinion.torque": 80.0,
    "wheel.torque": 200.0,
    "oil.temperature": 333.15,
    "bearing.preload": 4000.0,
    "pinion.speed_start": 150.0,
}
INTEGERS = {"solver.steps_per_mesh_period": 128}
NAMES = [name for name in DEFINITION.output_names if name != "mesh.separated"]


@pytest.fixture(scope="module")
def expected() -> list[float]:
    """The model in Python, without FMI."""
    parameters = {
        v.name: v.decoded(v.start) for v in DEFINITION.variables if v.causality == "parameter"
    }
    values = REALS | INTEGERS
    parameters |= {name: values[name] for name in parameters.keys() & values.keys()}
    inputs = [REALS[name] for name in ("pinion.torque", "wheel.torque", "oil.temperature")]
    axle = start_axle(parameters, inputs)
    for _ in range(STEPS):
        axle.step(H, *inputs)
    outputs = dict(zip(DEFINITION.output_names, axle.outputs.tolist(), strict=True))
    return [outputs[name] for name in NAMES]


@pytest.fixture(scope="module")
def job(fmu_path: Path) -> str:
    references = DEFINITION.references
    content: dict[str, Any] = {
        "fmu": str(fmu_path),
        "step_size": H,
        "steps": STEPS,
        "reals": [(references[name], value) for name, value in REALS.items()],
        "integers": [(references[name], value) for name, value in INTEGERS.items()],
        "references": [references[name] for name in NAMES],
        "named_reals": REALS,
        "named_integers": INTEGERS,
        "names": NAMES,
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


def test_fmpy_gives_the_numbers_of_the_model(fmu_path: Path, expected: list[float]) -> None:
    result = simulate_fmu(
        str(fmu_path),
        stop_time=STEPS * H,
        output_interval=H,
        start_values=REALS | INTEGERS,
        output=NAMES,
    )
    assert [float(result[name][-1]) for name in NAMES] == expected


def test_libcosim_gives_the_numbers_of_the_model(job: str, expected: list[float]) -> None:
    assert _run("importer_libcosim.py", job, {}) == expected


def test_ecos_gives_the_numbers_of_the_model(job: str, expected: list[float]) -> None:
    (library,) = {Path(str(f.locate())).resolve() for f in files("tbb") if f.name == "libtbb.so.12"}
    search = f"{library.parent}{os.pathsep}{os.environ.get('LD_LIBRARY_PATH', '')}"
    assert _run("importer_ecos.py", job, {"LD_LIBRARY_PATH": search}) == expected


def test_without_gearlube_the_fmu_says_what_is_missing(fmu_path: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(fmu_path) as archive:
        script = archive.read("resources/hypoid_axle_slave.py").decode()
    (tmp_path / "hypoid_axle_slave.py").write_text(script)
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", script], capture_output=True, text=True, check=False
    )
    assert done.returncode != 0
    assert "HypoidAxle.fmu needs the Python package gearlube where it runs" in done.stderr
    assert "pip install gearlube" in done.stderr
