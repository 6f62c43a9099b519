"""Cost of native and Python FMUs in a C program: `python -m benchmarks.bench_native_fmu`.

Compiles tests/fmu/native_host.c, which steps two instances, reads one output after each step and
says how much CPU time that took. Linux.
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

from drivetrain.train.train_file import TrainFile
from fmu_src.build import build_models
from fmu_src.native.build import NativeOptions
from fmu_src.native.platforms import platform_of_this_machine
from gearlube.cli.native import native_environment

_LOGGER = logging.getLogger("bench_native_fmu")
_SOURCE = Path(__file__).parents[1] / "tests" / "fmu" / "native_host.c"
_INSTANCES = 2
_SIMULATED = 0.5  # s
_TURNS = 3


def compiled(folder: Path, source: Path = _SOURCE) -> Path:
    """Return the program that a C file becomes."""
    host = folder / source.stem
    headers = Path(fmpy.__file__).parent / "c-code"
    command = [
        sys.executable,
        "-m",
        "ziglang",
        "cc",
        "-std=gnu99",
        "-O2",
        f"-I{headers}",
        str(source),
        "-o",
        str(host),
        "-ldl",
    ]
    subprocess.run(command, check=True)
    return host


def arguments(fmu: Path, folder: Path) -> list[str]:
    extracted = Path(extract(str(fmu), str(folder / fmu.stem)))
    description = read_model_description(str(extracted))
    read = next(v for v in description.modelVariables if v.name.endswith(".dte"))
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


def rate(host: Path, of_fmu: Sequence[str], h: float) -> float:
    """Return the simulated seconds a second of CPU time, in steps of `h` [s]."""
    command = [str(host), "free", str(round(_SIMULATED / h)), str(h), *of_fmu]
    return _INSTANCES * _SIMULATED / statistics.median(cpu_time(command) for _ in range(_TURNS))


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        host = compiled(folder)
        of_this_machine = NativeOptions(platforms=[platform_of_this_machine()], fmi=["2"])
        native = build_models(folder / "native", native=of_this_machine)
        # the car has no FMU in Python, and comes last
        for of_native, of_python in zip(native, build_models(folder / "python"), strict=False):
            for h in (1e-4, 1e-3, 1e-2):
                rates = [
                    rate(host, arguments(fmu, fmu.parent), h) for fmu in (of_native, of_python)
                ]
                _LOGGER.info(
                    "%s, %g s: %.1f simulated seconds a second native, %.1f in Python, ratio %.2f",
                    of_native.stem, h, *rates, rates[0] / rates[1],
                )  # fmt: skip
        for name in TrainFile.shipped():
            (fmu,) = build_models(folder / "trains", train=name, native=of_this_machine)
            for h in (1e-4, 1e-3, 1e-2):
                found = rate(host, arguments(fmu, fmu.parent), h)
                _LOGGER.info("%s, %g s: %.1f simulated seconds a second", fmu.stem, h, found)


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    main()
