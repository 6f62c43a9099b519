"""Rewrite a table of docs/fmu_hosts.md: python -m docs.fmu_hosts.steps FMUS [--fmusim PROGRAM].

Runs the archives in FMUS by their defaults and in other steps; OMSimulator is looked for on the
search path. A host that is not there is named in the table.
"""

from __future__ import annotations

import argparse
import csv
import math
import shutil
import subprocess
import tempfile
from pathlib import Path

import fmpy
import numpy as np

from docs.page import Page

STOPS = {None: None, 1e-5: 0.01, 1e-4: 0.1, 1e-3: 0.5, 1e-2: 1.0, 0.1: 1.0}  # step: stop time [s]
KINDS = {"cs": "CoSimulation", "me": "ModelExchange"}


def in_fmpy(fmu: Path, kind: str, step: float | None, stop: float) -> bool:
    """Whether FMPy reaches the stop time with finite outputs."""
    try:
        end = None if step is None else stop
        result = fmpy.simulate_fmu(
            str(fmu), fmi_type=KINDS[kind], output_interval=step, stop_time=end
        )
    except Exception:  # whatever ends the run is the finding
        return False
    last = np.hstack([np.ravel(value) for value in result[-1].tolist()])
    return reached(last.tolist(), stop, 0.0)


def reached(last: list[float], stop: float, short: float) -> bool:
    """Whether the last row is finite and its time is the stop time, or short of it by a bit."""
    return abs(last[0] - stop) <= short + 1e-9 and all(map(math.isfinite, last))


def in_program(
    program: str, fmu: Path, kind: str, step: float | None, stop: float, folder: Path
) -> bool:
    """Whether fmusim or OMSimulator does."""
    out = folder / "steps.csv"
    out.unlink(missing_ok=True)
    if Path(program).name == "fmusim":
        command = [program, "--interface-type", kind, "--output-file", str(out)]
        command += ["--solver", "cvode"] if kind == "me" else []
        if step is not None:
            command += ["--output-interval", repr(step), "--stop-time", repr(stop)]
        short = 1.01e-5  # fmusim takes times closer than 1e-5 s as equal
    else:
        command = [program, f"--mode={kind}", f"--resultFile={out}", f"--tempDir={folder}"]
        if step is not None:
            command += [f"--stepSize={step!r}", f"--stopTime={stop!r}"]
            command += [f"--intervals={max(2, round(stop / step))}"]
        short = 0.0
    done = subprocess.run([*command, str(fmu)], capture_output=True, cwd=folder, check=False)
    if done.returncode != 0 or not out.is_file():
        return False
    with out.open(encoding="utf-8") as stream:
        last = list(csv.reader(stream))[-1]
    flags = {"true": 1.0, "false": 0.0}
    numbers = [flags[x] if x in flags else float(x) for x in " ".join(last).split()]
    return reached(numbers, stop, short)


def main() -> None:
    """Run the hosts and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fmus", type=Path, metavar="FMUS")
    parser.add_argument("--fmusim", metavar="PROGRAM")
    given = parser.parse_args()
    programs = {"fmusim": given.fmusim, "OMSimulator": shutil.which("OMSimulator")}
    rows: dict[tuple[str, ...], list[str]] = {}  # hosts by archive, kind and outcomes
    with tempfile.TemporaryDirectory() as name:
        for fmu in sorted(given.fmus.resolve().glob("*.fmu")):
            described = fmpy.read_model_description(str(fmu))
            kinds = {"cs": described.coSimulation, "me": described.modelExchange}
            for kind in (kind for kind, there in kinds.items() if there is not None):
                for host in ("FMPy", *programs):
                    cells = []
                    for step, stop in STOPS.items():
                        end = float(described.defaultExperiment.stopTime) if stop is None else stop
                        if host == "FMPy":
                            good = in_fmpy(fmu, kind, step, end)
                        elif programs[host] is None:
                            cells.append("not run")
                            continue
                        else:
                            good = in_program(programs[host], fmu, kind, step, end, Path(name))
                        cells.append("yes" if good else "no")
                    rows.setdefault((fmu.name, KINDS[kind], *cells), []).append(host)
    page = Page("fmu_hosts")
    page.rows(
        "Archive | Kind",
        [[*key[:2], ", ".join(on), *key[2:]] for key, on in rows.items()],
    )
    page.write()


if __name__ == "__main__":
    main()
