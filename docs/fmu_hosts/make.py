"""Rewrite docs/fmu_hosts.md: python -m docs.fmu_hosts.make [--fmus DIR] [--fmusim PROGRAM].

Builds the native FMUs for Linux and Windows (two minutes) unless DIR holds them. Without the
program fmusim, and without wine on the search path, their rows say so.
"""

from __future__ import annotations

import argparse
import logging
import re
import shutil
import tempfile
import zipfile
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from platform import machine, system
from typing import NamedTuple

from docs.fmu_hosts import hosts
from docs.fmu_hosts.hosts import Job
from docs.page import Page
from fmu_src import build, helical_pair, hypoid_axle
from fmu_src.definition import Definition
from fmu_src.native.build import NativeOptions

STEPS, RATE = 64, 512
SHOWN = ("pinion.speed", "mesh.dte", "friction.power_loss", "efficiency", "bearing[1].force.x")
SMALL = 1e-9  # of the largest output of a unit: below, a value is rounding
REALS = {
    "HypoidAxle": {
        "pinion.torque": 80.0,  # N.m
        "wheel.torque": 200.0,
        "oil.temperature": 333.15,  # K
        "pinion.speed_start": 150.0,  # rad/s
        "bearing.preload": 4000.0,  # N
    },
    "HelicalPair": {
        "pinion.torque": 200.0,
        "wheel.torque": 240.0,
        "oil.temperature": 343.15,
        "pinion.speed_start": 150.0,
        "support.radial_stiffness": 2e9,  # N/m
    },
}
INTEGERS = {
    "HypoidAxle": {"oil.name.number": 2, "solver.steps_per_mesh_period": 128},
    "HelicalPair": {"oil.name.number": 2, "friction.model.number": 2},
}
logger = logging.getLogger("docs.fmu_hosts")


class Row(NamedTuple):
    """What a host gave; no values where it did not run."""

    host: str
    standard: str
    values: list[float] | None
    why_not: str = ""


def job_of(definition: Definition, folder: Path) -> Job:
    """Return the job of the page for the FMI 2.0 archive in a folder."""
    names = [v.name for v in definition.variables if v.causality == "output" and v.type == "Real"]
    return Job(
        fmu=folder / f"{definition.name}.fmu",
        reals=REALS[definition.name],
        integers=INTEGERS[definition.name],
        names=names,
        step_size=1.0 / RATE,
        steps=STEPS,
    )


def scalars(job: Job) -> Job:
    """Return the job for FMI 3.0, where outputs with an index are elements of arrays."""
    fmu = job.fmu.with_name(f"{job.fmu.stem}_FMI3.fmu")
    return replace(job, fmu=fmu, names=[name for name in job.names if "[" not in name])


def rows_of(job: Job, packed: list[float], fmusim: Path | None, folder: Path) -> list[Row]:
    """Run all hosts."""
    three, windows = scalars(job), shutil.which("wine") is not None
    fmpy, ecos = f"FMPy {version('fmpy')}", f"Ecos {version('ecospy')}"
    toolbox = version("fmu-manipulation-toolbox")
    logger.info("%s: hosts", job.fmu.stem)
    rows = [
        Row(fmpy, "2.0", hosts.in_fmpy(job)),
        Row(fmpy, "3.0", hosts.in_fmpy(three)),
        Row(f"libcosim (libcosimpy {version('libcosimpy')})", "2.0", hosts.in_libcosim(job)),
        Row(ecos, "2.0", hosts.in_ecos(job)),
        Row(ecos, "3.0", hosts.in_ecos(three)),
        Row(f"fmucontainer {toolbox}", "2.0", packed),
        Row("host.c", "2.0", hosts.in_c_host(job, hosts.c_host(folder), folder)),
    ]
    for one, standard in ((job, "2.0"), (three, "3.0")):
        found = hosts.in_fmusim(one, fmusim, folder) if fmusim else None
        rows.append(Row("fmusim", standard, found, "no program given"))
    found = None
    if windows:
        program = hosts.c_host(folder, "x86_64-windows-gnu")
        found = hosts.in_c_host(job, program, folder)
    rows.append(Row("host.c, Windows in wine", "2.0", found, "no wine"))
    return rows


def difference(job: Job, units: dict[str, str], values: list[float], others: list[float]) -> float:
    """Return the largest relative difference [-] of two sets of outputs."""
    largest: dict[str, float] = {}
    for name, other in zip(job.names, others, strict=True):
        largest[units[name]] = max(largest.get(units[name], 0.0), abs(other))
    return max(
        abs(value - other) / max(abs(other), SMALL * largest[units[name]], 1e-300)
        for name, value, other in zip(job.names, values, others, strict=True)
    )


def cells_of(definition: Definition, job: Job, rows: list[Row]) -> list[list[str]]:
    """Return the rows of a model's table."""
    units = {v.name: v.unit for v in definition.variables}
    in_python = hosts.in_python(job, definition)
    reference = rows[0].values or []
    cells = [["Python, no FMI", "", *_shown(job, in_python), "", ""]]
    for row in rows:
        if row.values is None:
            cells.append([row.host, row.standard, f"not run: {row.why_not}", *[""] * 6])
            continue
        its = scalars(job) if row.standard == "3.0" else job
        pick = [job.names.index(name) for name in its.names]
        far = [
            difference(its, units, row.values, [one[i] for i in pick])
            for one in (reference, in_python)
        ]
        cells.append([row.host, row.standard, *_shown(its, row.values), *(f"{x:.1e}" for x in far)])
    return cells


def _shown(job: Job, values: list[float]) -> list[str]:
    by_name = dict(zip(job.names, values, strict=True))
    return [f"{by_name[name]:.12g}" if name in by_name else "in an array" for name in SHOWN]


def named_dlls(fmu: Path) -> str:
    """Return the DLLs that the Windows library names, itself left out."""
    with zipfile.ZipFile(fmu) as archive:
        library = archive.read(f"binaries/win64/{fmu.stem}.dll")
    found = {name.decode() for name in re.findall(rb"[\w.-]+\.dll", library, re.IGNORECASE)}
    families = {re.sub(r"(api-ms-win-crt)-.*", r"\1-*.dll", name) for name in found}
    return ", ".join(sorted(families - {f"{fmu.stem}.dll"}, key=str.lower))


def put(page: Page, fmus: Path, fmusim: Path | None, folder: Path) -> None:
    """Run everything and put it into the page."""
    definitions = hypoid_axle.DEFINITION, helical_pair.DEFINITION
    axle, pair = (job_of(definition, fmus) for definition in definitions)
    logger.info("container")
    packed = hosts.in_container([axle, axle, pair], folder)
    if packed[0] != packed[1]:
        raise RuntimeError("Two axles in one container give different numbers.")
    page.fill("gives the same {} and {} Real outputs", len(axle.names), len(pair.names))
    page.fill("their numbers into this page; run on {}.", f"{system()}, {machine()}")
    for definition, job, own in zip(definitions, (axle, pair), packed[1:], strict=True):
        rows = rows_of(job, own, fmusim, folder)
        page.rows("Host | FMI", cells_of(definition, job, rows), f"\n## {definition.name}\n")
    page.fill("the DLLs that it names are {} |", named_dlls(axle.fmu))
    page.fill("That is what they do (FMPy {}):", version("fmpy"))


def main() -> None:
    """Build what is missing, run the hosts and write the page."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmus", type=Path, metavar="DIR", help="native FMUs of build_fmu.py")
    parser.add_argument("--fmusim", type=Path, metavar="PROGRAM", help="of the Reference FMUs")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if given.fmus is None:
            platforms = ["x86_64-linux", "x86_64-windows"]
            build.build_models(folder, native=NativeOptions(platforms=platforms))
        page = Page("fmu_hosts")
        put(page, given.fmus or folder, given.fmusim, folder)
        page.write()


if __name__ == "__main__":
    main()
