"""Programs that no one here wrote, and two small ones, each running the same FMU the same way."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import files
from pathlib import Path
from typing import Any, NamedTuple

import fmpy

from fmu_src.definition import Definition

HERE = Path(__file__).parent
TOLERANCE = 1e-8  # relative, of solvers for model exchange


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


def in_fmpy(job: Job, kind: str = "CoSimulation") -> list[float]:
    """Run FMPy, which loads the library into Python; model exchange by CVODE."""
    result = fmpy.simulate_fmu(
        str(job.fmu),
        fmi_type=kind,
        relative_tolerance=TOLERANCE if kind == "ModelExchange" else None,
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


def in_fmusim(job: Job, program: Path, folder: Path, kind: str = "CoSimulation") -> list[float]:
    """Run the simulator of the Reference FMUs, a program in C; model exchange by CVODE."""
    table = folder / f"{job.fmu.stem}.csv"
    command: list[str | Path] = [program, "--interface-type", "cs"]
    if kind == "ModelExchange":
        command = [program, "--interface-type", "me", "--solver", "cvode"]
        command += ["--tolerance", repr(TOLERANCE)]
    command += ["--stop-time", repr(job.stop_time), "--output-interval", repr(job.step_size)]
    for name, value in job.start_values.items():
        command += ["--start-value", name, repr(value)]
    for name in job.names:
        command += ["--output-variable", name]
    output_of([*command, "--output-file", table, job.fmu], {})
    with table.open(encoding="utf-8") as stream:
        last = list(csv.DictReader(stream))[-1]
    return [float(last[name]) for name in job.names]


class Machine(NamedTuple):
    """Where `host.c` runs: a target of zig, the library in the FMU, and what runs its programs."""

    target: str = ""
    library: str = "linux64/{}.so"
    runner: tuple[str, ...] = ()


THIS_ONE = Machine()
WINDOWS = Machine("x86_64-windows-gnu", "win64/{}.dll", ("wine",))
_QEMU = shutil.which("qemu-aarch64") or "qemu-aarch64"
# the C library for arm64 of the same installation, as Debian's libc6-arm64-cross places it
_FOR_ARM64 = str(Path(_QEMU).parent.parent / "aarch64-linux-gnu")
ARM64 = Machine("aarch64-linux-gnu.2.36", "aarch64-linux/{}.so", (_QEMU, "-L", _FOR_ARM64))


def c_host(folder: Path, machine: Machine = THIS_ONE) -> Path:
    """Compile `host.c`."""
    windows = machine is WINDOWS
    path = folder / f"host{machine.target}{'.exe' if windows else ''}"
    headers = Path(fmpy.__file__).parent / "c-code"
    own = shutil.which("cc") if machine is THIS_ONE else None
    target = ["-target", machine.target] if machine.target else []
    zig = [sys.executable, "-m", "ziglang", "cc", *target]
    command = [*([own] if own else zig), "-std=c99", "-O1", f"-I{headers}", HERE / "host.c"]
    output_of([*command, "-o", path, *([] if windows else ["-ldl"])], {})
    return path


def in_c_host(job: Job, folder: Path, machine: Machine = THIS_ONE) -> list[float]:
    """Run `host.c`, in wine or qemu if it is a program for another machine."""
    program = c_host(folder, machine)
    name = machine.library.format(job.description.modelName)
    command: list[str | Path] = [
        *machine.runner,
        program,
        unpacked(job, folder) / "binaries" / name,
    ]
    command += [job.description.guid, repr(job.step_size), str(job.steps)]
    command += [f"r{job.references[name]}={value!r}" for name, value in job.reals.items()]
    command += [f"i{job.references[name]}={value}" for name, value in job.integers.items()]
    command += [f"o{job.references[name]}" for name in job.names]
    prefix = os.environ.get("WINEPREFIX", str(folder / "wine"))
    output = output_of(command, {"WINEPREFIX": prefix, "WINEDEBUG": "-all"})
    return [float(line) for line in output.split()]


def unpacked(job: Job, folder: Path) -> Path:
    """Unpack the FMU into a folder of its own, as a library that is loaded must stay."""
    return Path(fmpy.extract(str(job.fmu), tempfile.mkdtemp(dir=folder)))


def in_fmil(job: Job, library: Path, folder: Path) -> list[float]:
    """Run the FMI Library, FMI 2.0 or 3.0."""
    own = folder / f"fmil_{job.fmu.stem}"
    own.mkdir(exist_ok=True)
    references = job.references
    content = {
        "library": str(library),
        "fmu": str(job.fmu),
        "folder": str(own),
        "standard": job.description.fmiVersion,
        "step_size": job.step_size,
        "steps": job.steps,
        "reals": [(references[name], value) for name, value in job.reals.items()],
        "integers": [(references[name], value) for name, value in job.integers.items()],
        "references": [references[name] for name in job.names],
    }
    return _in_own_process("run_fmil.py", content, {})


def in_omsimulator(job: Job, program: Path, folder: Path) -> list[float]:
    """Run OMSimulator, which takes start values from an SSP archive."""
    path, table = folder / f"{job.fmu.stem}.ssp", folder / f"{job.fmu.stem}_oms.csv"
    used = {*job.start_values, *job.names}
    connectors, values = "", ""
    for one in job.description.modelVariables:
        if one.name in used:
            kind = one.causality.replace("calculatedParameter", "parameter")
            of = "Integer" if one.name in job.integers else "Real"
            connectors += (
                f'<ssd:Connector name="{one.name}" kind="{kind}"><ssc:{of}/></ssd:Connector>'
            )
    for name, value in job.start_values.items():
        of = "Integer" if name in job.integers else "Real"
        values += f'<ssv:Parameter name="{name}"><ssv:{of} value="{value!r}"/></ssv:Parameter>'
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(job.fmu, "resources/pair.fmu")
        archive.writestr(
            "SystemStructure.ssd", _SSD.format(connectors, values, job.stop_time, job.step_size)
        )
    command: list[str | Path] = [program, "--mode=cs", f"--stopTime={job.stop_time!r}"]
    command += [f"--stepSize={job.step_size!r}", f"--intervals={job.steps}"]
    output_of([*command, f"--resultFile={table}", f"--tempDir={folder}", path], {})
    with table.open(encoding="utf-8") as stream:
        last = list(csv.DictReader(stream, skipinitialspace=True))[-1]
    found = {name.partition("hosted.")[2].strip('"'): value for name, value in last.items()}
    return [float(found[name]) for name in job.names]


_SSP = "http://ssp-standard.org/SSP1/SystemStructure"
_SSD = f"""<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="1.0" name="job" xmlns:ssd="{_SSP}Description"
 xmlns:ssc="{_SSP}Common" xmlns:ssv="{_SSP}ParameterValues"
 xmlns:oms="https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd">
<ssd:System name="root"><ssd:Elements>
<ssd:Component name="hosted" type="application/x-fmu-sharedlibrary" source="resources/pair.fmu">
<ssd:Connectors>{{0}}</ssd:Connectors><ssd:ParameterBindings><ssd:ParameterBinding>
<ssd:ParameterValues><ssv:ParameterSet version="1.0" name="start"><ssv:Parameters>{{1}}
</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues></ssd:ParameterBinding>
</ssd:ParameterBindings></ssd:Component></ssd:Elements>
<ssd:Annotations><ssc:Annotation type="org.openmodelica"><oms:Annotations>
<oms:SimulationInformation><oms:FixedStepMaster description="oms-ma" stepSize="{{3!r}}"
 absoluteTolerance="1e-6" relativeTolerance="1e-6"/></oms:SimulationInformation>
</oms:Annotations></ssc:Annotation></ssd:Annotations></ssd:System>
<ssd:DefaultExperiment startTime="0" stopTime="{{2!r}}"/></ssd:SystemStructureDescription>
"""


def in_casadi(job: Job, folder: Path, step: float = 2.0**-17) -> list[float]:
    """Integrate the equations of model exchange by casadi, with steps of Runge and Kutta [s]."""
    import casadi
    from fmpy.fmi2 import FMU2Model

    place = str(unpacked(job, folder))
    started = FMU2Model(
        guid=job.description.guid,
        unzipDirectory=place,
        modelIdentifier=job.description.modelExchange.modelIdentifier,
        instanceName="start",
    )
    started.instantiate()
    started.setupExperiment()
    started.setReal([job.references[name] for name in job.reals], list(job.reals.values()))
    started.setInteger([job.references[name] for name in job.integers], list(job.integers.values()))
    started.enterInitializationMode()
    started.exitInitializationMode()
    dae = casadi.DaeBuilder("pair", place, {})
    dae.set_y(list(job.names))
    inputs = set(dae.u())
    for name, value in job.start_values.items():
        if name not in inputs:
            dae.set(name, value)
    x, u = casadi.MX.sym("x", dae.nx()), casadi.MX.sym("u", dae.nu())
    rates = dae.create("rates", ["x", "u"], ["ode"])
    k1 = rates(x, u)
    k2 = rates(x + 0.5 * step * k1, u)
    k3 = rates(x + 0.5 * step * k2, u)
    k4 = rates(x + step * k3, u)
    after = casadi.Function("after", [x, u], [x + step / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)])
    at_start = started.getReal([job.references[name] for name in dae.x()])
    given = started.getReal([job.references[name] for name in dae.u()])
    last = after.mapaccum("run", round(job.stop_time / step))(at_start, given)[:, -1]
    outputs = dae.create("outputs", ["x", "u"], ["y"])(last, given)
    found = dict(zip(dae.y(), casadi.DM(outputs).full().ravel().tolist(), strict=True))
    return [found[name] for name in job.names]
