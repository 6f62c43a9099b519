"""Cost of the FMUs in a program that is not Python: `python -m benchmarks.bench_native_fmu`.

Compiles tests/fmu/native_host.c, which steps two instances, reads one output after each step and
says how much CPU time that took. Linux, with a C compiler.
"""

from __future__ import annotations

import logging
import os
import re
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import fmpy
from fmpy import extract, read_model_description

from fmu_src.build import build_models
from fmu_src.native_host import native_environment

_LOGGER = logging.getLogger("bench_native_fmu")
_SOURCE = Path(__file__).parents[1] / "tests" / "fmu" / "native_host.c"
_INSTANCES = 2
_SIMULATED = 0.5  # s
_TURNS = 3


def compiled(folder: Path) -> Path:
    host = folder / "native_host"
    headers = Path(fmpy.__file__).parent / "c-code"
    command = ["cc", "-std=c99", "-O2", f"-I{headers}", str(_SOURCE), "-o", str(host), "-ldl"]
    subprocess.run(command, check=True)
    return host


def arguments(fmu: Path, folder: Path) -> list[str]:
    extracted = Path(extract(str(fmu), str(folder / fmu.stem)))
    description = read_model_description(str(extracted))
    (read,) = (v for v in description.modelVariables if v.name == "mesh.dte")
    library = extracted / "binaries" / "linux64" / f"{fmu.stem}.so"
    resources = (extracted / "resources").as_uri()
    return [str(library), resources, description.guid, str(read.valueReference)]


def cpu_time(command: Sequence[str]) -> float:
    """Return what the steps of a host took [s]."""
    done = subprocess.run(
        command,
        env=native_environment(os.environ),
        capture_output=True,
        text=True,
        check=True,
    )
    return float(re.findall(r"^steps: (\S+) s$", done.stderr, re.MULTILINE)[-1])


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        host = compiled(folder)
        for fmu in build_models(folder):
            of_fmu = arguments(fmu, folder)
            for h in (1e-4, 1e-3, 1e-2):
                steps = round(_SIMULATED / h)
                command = [str(host), "free", str(steps), str(h), *of_fmu]
                took = statistics.median(cpu_time(command) for _ in range(_TURNS))
                rate = _INSTANCES * _SIMULATED / took
                _LOGGER.info("%s, %g s: %.1f simulated seconds a second", fmu.stem, h, rate)


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    main()
