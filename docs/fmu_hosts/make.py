"""Rewrite docs/fmu_hosts.md: python -m docs.fmu_hosts.make [--fmus DIR] [--fmusim PROGRAM] ...

Builds the native FMUs for Linux and Windows (minutes) unless DIR holds them. fmusim, OMSimulator
and the FMI Library are compiled from their sources; wine and qemu-aarch64 are looked for on the
search path. The row of a host that is not there says so.
"""

from __future__ import annotations

import argparse
import logging
import re
import shutil
import tempfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
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
SHOWN = ("pinion.speed", "mesh.dte")
EXCHANGE, PARTS = "ModelExchange", 8
FMUSIM, FMIL, OMSIMULATOR = "0.0.39", "3.0", "3.0.0.post114"  # that were compiled
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


class Host(NamedTuple):
    """One line of the list of hosts.

    Parameters
    ----------
    name : str
    standards : tuple of str
        Versions of FMI that are tried.
    run : callable, optional
        Takes a job and a folder, returns the values; None for a host that no one has run.
    lacks : str
        Why it cannot run here; empty if it can.
    """

    name: str
    standards: tuple[str, ...]
    run: Callable[[Job, Path], list[float]] | None = None
    lacks: str = ""


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


def hosts_of(given: argparse.Namespace, packed: Mapping[str, list[float]]) -> list[Host]:
    """Return all hosts for co-simulation, with what each lacks here."""
    both, two, neither = ("2.0", "3.0"), ("2.0",), ("2.0, 3.0",)
    toolbox = version("fmu-manipulation-toolbox")
    return [
        Host(f"FMPy {version('fmpy')}", both, lambda job, _: hosts.in_fmpy(job)),
        Host(
            f"libcosim (libcosimpy {version('libcosimpy')})",
            two,
            lambda job, _: hosts.in_libcosim(job),
        ),
        Host(f"Ecos {version('ecospy')}", both, lambda job, _: hosts.in_ecos(job)),
        Host(f"fmucontainer {toolbox}", two, lambda job, _: packed[job.fmu.stem]),
        Host("host.c", two, hosts.in_c_host),
        Host(
            f"fmusim {FMUSIM}",
            both,
            lambda job, folder: hosts.in_fmusim(job, given.fmusim, folder),
            "" if given.fmusim else "no program given",
        ),
        Host(
            f"FMI Library {FMIL}",
            both,
            lambda job, folder: hosts.in_fmil(job, given.fmil, folder),
            "" if given.fmil else "no library given",
        ),
        Host(
            f"OMSimulator {OMSIMULATOR}",
            two,
            lambda job, folder: hosts.in_omsimulator(job, given.omsimulator, folder),
            "" if given.omsimulator else "no program given",
        ),
        Host("host.c, Windows in wine", two, in_machine(hosts.WINDOWS), without("wine")),
        Host("host.c, arm64 in qemu", two, in_machine(hosts.ARM64), without("qemu-aarch64")),
        Host("fmusim 0.8, in Rust", neither, lacks="cargo could not reach crates.io; not on PyPI"),
        Host("PyFMI", neither, lacks="PyPI has sources only, which did not build; else on conda"),
        Host("OpenModelica", neither, lacks="Debian 12 has no package"),
    ]


def exchange_hosts(given: argparse.Namespace) -> list[Host]:
    """Return the hosts that integrate the equations themselves."""
    return [
        Host(
            f"FMPy {version('fmpy')}, CVODE",
            ("2.0", "3.0"),
            lambda job, _: hosts.in_fmpy(finer(job), EXCHANGE),
        ),
        Host(
            f"fmusim {FMUSIM}, CVODE",
            ("2.0", "3.0"),
            lambda job, folder: hosts.in_fmusim(finer(job), given.fmusim, folder, EXCHANGE),
            "" if given.fmusim else "no program given",
        ),
        Host(f"casadi {version('casadi')}, Runge-Kutta", ("2.0",), hosts.in_casadi),
    ]


def finer(job: Job) -> Job:
    """Return the job in shorter steps: CVODE has 500 of its own from one output to the next."""
    return replace(job, step_size=job.step_size / PARTS, steps=PARTS * job.steps)


def in_machine(machine: hosts.Machine) -> Callable[[Job, Path], list[float]]:
    """Return what runs `host.c` on another machine."""
    return lambda job, folder: hosts.in_c_host(job, folder, machine)


def without(program: str) -> str:
    """Return that a program is not there; empty if it is."""
    return "" if shutil.which(program) else f"no {program} on the search path"


def difference(job: Job, units: dict[str, str], values: list[float], others: list[float]) -> float:
    """Return the largest relative difference [-] of two sets of outputs."""
    largest: dict[str, float] = {}
    for name, other in zip(job.names, others, strict=True):
        largest[units[name]] = max(largest.get(units[name], 0.0), abs(other))
    return max(
        abs(value - other) / max(abs(other), SMALL * largest[units[name]], 1e-300)
        for name, value, other in zip(job.names, values, others, strict=True)
    )


def cells_of(
    units: dict[str, str],
    job: Job,
    listed: Sequence[Host],
    others: Sequence[Sequence[float]],
    folder: Path,
) -> list[list[str]]:
    """Return the rows of hosts; each is compared with the first of them, and with others."""
    cells, first = [], None
    for host in listed:
        for standard in host.standards:
            logger.info("%s: %s, FMI %s", job.fmu.stem, host.name, standard)
            if host.lacks or host.run is None:
                cells.append(
                    [
                        host.name,
                        standard,
                        f"not run: {host.lacks}",
                        *[""] * (len(SHOWN) + len(others)),
                    ]
                )
                continue
            its = scalars(job) if standard == "3.0" else job
            values = host.run(its, folder)
            first = first or values
            pick = [job.names.index(name) for name in its.names]
            far = [
                difference(its, units, values, [one[i] for i in pick]) for one in (first, *others)
            ]
            cells.append([host.name, standard, *_shown(its, values), *(f"{x:.1e}" for x in far)])
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


def put(page: Page, fmus: Path, given: argparse.Namespace, folder: Path) -> None:
    """Run everything and put it into the page."""
    definitions = hypoid_axle.DEFINITION, helical_pair.DEFINITION
    axle, pair = (job_of(definition, fmus) for definition in definitions)
    logger.info("container")
    first, *packed = hosts.in_container([axle, axle, pair], folder)
    if first != packed[0]:
        raise RuntimeError("Two axles in one container give different numbers.")
    by_name = dict(zip((axle.fmu.stem, pair.fmu.stem), packed, strict=True))
    page.fill("gives the same {} and {} Real outputs", len(axle.names), len(pair.names))
    page.fill("their numbers into this page; run on {}.", f"{system()}, {machine()}")
    for definition, job in zip(definitions, (axle, pair), strict=True):
        units = {v.name: v.unit for v in definition.variables}
        in_python = hosts.in_python(job, definition)
        rows = [["Python, no FMI", "", *_shown(job, in_python), "", ""]]
        rows += cells_of(units, job, hosts_of(given, by_name), [in_python], folder)
        head = f"\n## {definition.name}\n"
        page.rows("Host | FMI", rows, head)
        rows = cells_of(units, job, exchange_hosts(given), [], folder)
        page.rows("Model exchange | FMI", rows, head)
    page.fill("the DLLs that it names are {} |", named_dlls(axle.fmu))
    page.fill("That is what they do (FMPy {}):", version("fmpy"))


def main() -> None:
    """Build what is missing, run the hosts and write the page."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmus", type=Path, metavar="DIR", help="native FMUs of build_fmu.py")
    parser.add_argument("--fmusim", type=Path, metavar="PROGRAM", help="of the Reference FMUs")
    parser.add_argument("--fmil", type=Path, metavar="LIBRARY", help="libfmilib_shared")
    parser.add_argument("--omsimulator", type=Path, metavar="PROGRAM", help="version 3")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if given.fmus is None:
            platforms = ["x86_64-linux", "x86_64-windows", "aarch64-linux"]
            build.build_models(folder, native=NativeOptions(platforms=platforms))
        page = Page("fmu_hosts")
        put(page, given.fmus or folder, given, folder)
        page.write()


if __name__ == "__main__":
    main()
