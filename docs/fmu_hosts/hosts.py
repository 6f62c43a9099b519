"""Programs that no one here wrote, and two small ones, each running the same FMU the same way."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import files
from pathlib import Path
from typing import Any

import fmpy

from fmu_src.definition import Definition

HERE = Path(__file__).parent


@dataclass(frozen=True, kw_only=True, eq=False)
class Job:
    """What a host is asked to do: start, make equal steps under constant inputs, read outputs.

    Parameters
    ----------
    fmu : path
    reals, integers : mapping of str to number
        Start values of inputs and parameters by name.
    names : sequence of str
        Real outputs.
    step_size : float
        Exact in binary and a whole number of nanoseconds, as libcosim counts [s].
    steps : int
    """

    fmu: Path
    reals: Mapping[str, float]
    integers: Mapping[str, int]
    names: Sequence[str]
    step_size: float = 2.0**-9
    steps: int = 16

    @cached_property
    def description(self) -> Any:
        """Model description as FMPy reads it."""
        return fmpy.read_model_description(str(self.fmu))

    @cached_property
    def references(self) -> dict[str, int]:
        """Value reference of every variable."""
        return {v.name: v.valueReference for v in self.description.modelVariables}

    @property
    def start_values(self) -> dict[str, float]:
        """All start values by name."""
        return {**self.reals, **self.integers}

    @property
    def stop_time(self) -> float:
        """End of the last step [s]."""
        return self.steps * self.step_size


def output_of(
    command: Sequence[str | Path], environment: Mapping[str, str], given: str = ""
) -> str:
    """Run a program and return what it wrote; raise a RuntimeError with its last words."""
    done = subprocess.run(
        [str(word) for word in command],
        input=given,
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        check=False,
    )
    if done.returncode != 0:
        raise RuntimeError(f"{command[0]}: exit status {done.returncode}\n{done.stderr[-2000:]}")
    return done.stdout


def in_python(job: Job, definition: Definition) -> list[float]:
    """Run the model in Python, without FMI."""
    values = job.start_values
    parameters = {}
    for variable in definition.variables:
        if variable.is_model_parameter:
            number = values.get(f"{variable.name}.number", 0)
            value = values.get(variable.name, variable.start or 0.0)
            parameters[variable.name] = variable.decoded(number or value)
    inputs = [
        values.get(v.name, v.start or 0.0) for v in definition.variables if v.causality == "input"
    ]
    model = definition.start_model(parameters, inputs)
    for _ in range(job.steps):
        model.step(job.step_size, *inputs)
    outputs = dict(zip(definition.output_names, model.outputs.tolist(), strict=True))
    return [outputs[name] for name in job.names]


def in_fmpy(job: Job) -> list[float]:
    """Run FMPy, which loads the library into Python."""
    result = fmpy.simulate_fmu(
        str(job.fmu),
        stop_time=job.stop_time,
        output_interval=job.step_size,
        start_values=job.start_values,
        output=list(job.names),
    )
    return [float(result[name][-1]) for name in job.names]


def in_libcosim(job: Job) -> list[float]:
    """Run libcosim, FMI 2.0 only."""
    references = job.references
    return run_libcosim(
        {
            "fmu": str(job.fmu),
            "step_size": job.step_size,
            "steps": job.steps,
            "reals": [(references[name], value) for name, value in job.reals.items()],
            "integers": [(references[name], value) for name, value in job.integers.items()],
            "references": {"pair": [references[name] for name in job.names]},
        }
    )


def run_libcosim(content: Mapping[str, Any]) -> list[float]:
    """Run `run_libcosim.py` in a process of its own."""
    return _in_own_process("run_libcosim.py", content, {})


def in_ecos(job: Job) -> list[float]:
    """Run Ecos, FMI 2.0 or 3.0."""
    return run_ecos(
        {
            "fmu": str(job.fmu),
            "step_size": job.step_size,
            "steps": job.steps,
            "named_reals": job.reals,
            "named_integers": job.integers,
            "names": [f"pair::{name}" for name in job.names],
        }
    )


def run_ecos(content: Mapping[str, Any]) -> list[float]:
    """Run Ecos, which looks for a library of another package."""
    found = {
        Path(str(f.locate())).resolve() for f in files("tbb") or () if f.name == "libtbb.so.12"
    }
    search = f"{found.pop().parent}{os.pathsep}{os.environ.get('LD_LIBRARY_PATH', '')}"
    return _in_own_process("run_ecos.py", content, {"LD_LIBRARY_PATH": search})


def _in_own_process(
    script: str, content: Mapping[str, Any], environment: Mapping[str, str]
) -> list[float]:
    output = output_of([sys.executable, HERE / script], environment, json.dumps(content))
    return json.loads(output.splitlines()[-1])


def in_container(jobs: Sequence[Job], folder: Path) -> list[list[float]]:
    """Pack the FMUs of all jobs into one FMU and run that in FMPy; jobs of the same steps."""
    packed = [f"part{k}.fmu" for k in range(len(jobs))]
    for job, name in zip(jobs, packed, strict=True):
        shutil.copy(job.fmu, folder / name)
    parts = list(zip(packed, jobs, strict=True))
    plan = {
        "name": "container.fmu",
        "step_size": jobs[0].step_size,
        "auto_input": False,
        "auto_link": False,
        "auto_output": False,
        "fmu": packed,
        "start": [[part, n, v] for part, job in parts for n, v in job.start_values.items()],
        "output": [[part, n, f"{part}.{n}"] for part, job in parts for n in job.names],
    }
    (folder / "container.json").write_text(json.dumps(plan), encoding="utf-8")
    command = "from fmu_manipulation_toolbox.cli.fmucontainer import fmucontainer; fmucontainer()"
    arguments = ["-container", "container.json", "-fmu-directory", folder]
    output_of([sys.executable, "-c", command, *arguments], {})
    whole = Job(
        fmu=folder / "container.fmu",
        reals={},
        integers={},
        names=[f"{part}.{name}" for part, job in parts for name in job.names],
        step_size=jobs[0].step_size,
        steps=jobs[0].steps,
    )
    values = iter(in_fmpy(whole))
    return [[next(values) for _ in job.names] for job in jobs]


def in_fmusim(job: Job, program: Path, folder: Path) -> list[float]:
    """Run the simulator of the Reference FMUs, a program in C."""
    table = folder / f"{job.fmu.stem}.csv"
    command: list[str | Path] = [program, "--interface-type", "cs"]
    command += ["--stop-time", repr(job.stop_time), "--output-interval", repr(job.step_size)]
    for name, value in job.start_values.items():
        command += ["--start-value", name, repr(value)]
    for name in job.names:
        command += ["--output-variable", name]
    output_of([*command, "--output-file", table, job.fmu], {})
    with table.open(encoding="utf-8") as stream:
        last = list(csv.DictReader(stream))[-1]
    return [float(last[name]) for name in job.names]


def c_host(folder: Path, target: str = "") -> Path:
    """Compile `host.c`: for this machine, or for a target of zig."""
    path = folder / ("host.exe" if "windows" in target else "host")
    headers = Path(fmpy.__file__).parent / "c-code"
    own = shutil.which("cc") if not target else None
    zig = [sys.executable, "-m", "ziglang", "cc", *(["-target", target] if target else [])]
    command = [*([own] if own else zig), "-std=c99", "-O1", f"-I{headers}", HERE / "host.c"]
    output_of([*command, "-o", path, *([] if "windows" in target else ["-ldl"])], {})
    return path


def in_c_host(job: Job, program: Path, folder: Path) -> list[float]:
    """Run `host.c`; a Windows program runs the FMU's Windows library in wine."""
    windows = program.suffix == ".exe"
    binary = "win64/{}.dll" if windows else "linux64/{}.so"
    extracted = Path(fmpy.extract(str(job.fmu), str(folder / job.fmu.stem)))
    library = extracted / "binaries" / binary.format(job.description.modelName)
    command: list[str | Path] = [program, library, job.description.guid]
    command += [repr(job.step_size), str(job.steps)]
    command += [f"r{job.references[name]}={value!r}" for name, value in job.reals.items()]
    command += [f"i{job.references[name]}={value}" for name, value in job.integers.items()]
    command += [f"o{job.references[name]}" for name in job.names]
    environment = {"WINEPREFIX": str(folder / "wine"), "WINEDEBUG": "-all"} if windows else {}
    output = output_of([*(["wine"] if windows else []), *command], environment)
    return [float(line) for line in output.split()]
