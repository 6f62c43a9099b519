"""gearlube beside other open programs, on one core, turn by turn: writes docs/peers.md.

`python -m benchmarks.peers [--fbns GIT] [--repeats N] [--only gears rough film]`; the work is
in benchmarks/peer_work. Each peer gets a Python of its own in the cache, by uv (`pip install uv`)
from PyPI; slippy needs Python 3.9. EHL-FBNS is read from its git repository and needs `octave-cli`.
A program that cannot be had, or fails, is named in the page with the reason.
"""

from __future__ import annotations

import argparse
import json
import logging
import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peer_work import cases
from docs.page import Page
from gearlube_core.arrays import Array
from gearlube_core.storage.folders import cache_folder

WORK = Path(__file__).parent / "peer_work"
ROOT = WORK.parents[1]
FBNS = "https://github.com/ErikHansenGit/EHL"
OWN = "gearlube"
THREADS = ("OMP", "OPENBLAS", "MKL", "NUMBA", "NUMEXPR")
PATCH_NODES, FILM_NODES, FINE_FILM = 256, (65, 129), (257, 513)
ASKED = 1e-4  # error of pressures over their mean; of frequencies 10 times that
TOLERANCES = tuple(10.0**-k for k in range(2, 13))
WORDS = {
    "gears": "frequencies of the geared rotors",
    "rough": "rough contact",
    "film": "point film, the same grid",
}
logger = logging.getLogger("benchmarks.peers")


class MissingError(RuntimeError):
    """Why a program cannot be had, or does not do the work."""


@dataclass(frozen=True, kw_only=True)
class Peer:
    """What uv installs for a peer, and for which Python where it is another one."""

    packages: tuple[str, ...] = ()
    python: str = "3.11"
    word: str = ""

    def interpreter(self, name: str) -> list[str]:
        """Return the command of its Python, made if need be."""
        if not self.packages:
            return [sys.executable]
        folder = cache_folder("peers") / name
        python = folder / "bin" / "python"
        if not python.exists():
            logger.info("%s: installing", name)
            known = sorted(Path.home().glob(f".pyenv/versions/{self.python}.*/bin/python"))
            wanted = str(known[-1]) if known else self.python
            uv = [sys.executable, "-m", "uv"]
            try:
                _run([*uv, "venv", "--quiet", "--python", wanted, str(folder)])
                _run([*uv, "pip", "install", "--quiet", "--python", str(python), *self.packages])
            except MissingError:
                shutil.rmtree(folder, ignore_errors=True)
                raise
        return [str(python), "-W", "ignore"]


PEERS = {
    OWN: Peer(),
    "ROSS": Peer(packages=("ross-rotordynamics", "plotly<6"), word="with plotly below 6"),
    "tamaas": Peer(packages=("tamaas",)),
    "ContactMechanics": Peer(packages=("ContactMechanics",)),
    "slippy": Peer(packages=("slippy",), python="3.9", word="its NumPy ends at Python 3.9"),
    "EHL-FBNS": Peer(word="git repository, Octave of the system"),
}


def _run(command: Sequence[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no words"])[-1]
        raise MissingError(last[:160])
    return done.stdout.strip()


@dataclass
class Side:
    """A program that does one kind of work whenever it is asked."""

    name: str
    script: str
    arguments: tuple[str, ...] = ()
    version: str = ""
    walls: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        variables = {f"{one}_NUM_THREADS": "1" for one in THREADS}
        variables["PYTHONPATH"] = str(ROOT) if self.name == OWN else ""
        command = [*PEERS[self.name].interpreter(self.name), str(WORK / self.script)]
        self._log = tempfile.TemporaryFile("w+")  # noqa: SIM115  as long as the process
        self._process = subprocess.Popen(
            [*command, *self.arguments], env={**os.environ, **variables}, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._log,
            cwd=tempfile.mkdtemp(),  # slippy writes files where it is
        )  # fmt: skip
        self.version = self._answer()["version"]

    def ask(self, **task: Any) -> dict[str, Any]:
        """Return what it found; `seconds` are those of its work."""
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(task) + "\n")
        self._process.stdin.flush()
        found = self._answer()
        if "error" in found:
            raise MissingError(found["error"])
        logger.info("%s %s: %.2f s", self.name, task, found["seconds"])
        return found

    def _answer(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            if line.startswith("{"):  # not what a program prints when it is imported
                return dict(json.loads(line))
        self._log.seek(0)
        raise MissingError((self._log.read().strip().splitlines() or ["it ended"])[-1][:160])

    def end(self) -> None:
        """End its process."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()


class Work:
    """One kind of work, and the programs that do it."""

    def __init__(self, sides: Mapping[str, tuple[str, ...]], missing: dict[str, str]) -> None:
        self.missing = missing
        self.sides: list[Side] = []
        for name, (script, *arguments) in sides.items():
            try:
                self.sides.append(Side(name, script, tuple(arguments)))
            except MissingError as why:
                missing[name] = str(why)
        self.own = self.sides[0]

    def first(self, tasks: Mapping[str, Mapping[str, Any]]) -> dict[str, dict[str, Any]]:
        """Return what each side finds; one that fails is left out from here on."""
        found = self.once(tasks)
        for side in list(self.sides):
            if "error" in found[side.name]:
                self.missing[side.name] = found.pop(side.name)["error"]
                self.sides.remove(side)
        return found

    def once(self, tasks: Mapping[str, Mapping[str, Any]]) -> dict[str, dict[str, Any]]:
        """Return what each side finds, or its `error`."""
        found: dict[str, dict[str, Any]] = {}
        for side in self.sides:
            try:
                found[side.name] = side.ask(**tasks[side.name])
            except MissingError as why:
                found[side.name] = {"error": str(why)}
        return found

    def time(self, tasks: Mapping[str, Mapping[str, Any]], repeats: int) -> None:
        """Let all do their work in turn; what they did before was not counted."""
        for _ in range(repeats):
            for side in self.sides:
                side.walls.append(side.ask(**tasks[side.name])["seconds"])

    def times(self, side: Side) -> list[str]:
        """Return cells: seconds, and those over gearlube's in the same turn."""
        ratios = [a / b for a, b in zip(side.walls, self.own.walls, strict=True)]
        return [_spread(side.walls, 3), "1" if side is self.own else _spread(ratios, 2)]

    def faster(self, what: str) -> list[str]:
        """Return what peers do in less time than gearlube in most turns."""
        return [
            f"{one.name}: {what}"
            for one in self.sides[1:]
            if statistics.median(one.walls) < statistics.median(self.own.walls)
        ]


def _spread(values: Sequence[float], digits: int) -> str:
    ordered = (min(values), statistics.median(values), max(values))
    return " / ".join(f"{one:.{digits}g}" for one in ordered)


def gear_pair(page: Page, repeats: int, missing: dict[str, str]) -> Work:
    """Compare frequencies of geared rotors."""
    work = Work({OWN: ("pair_gearlube.py",), "ROSS": ("pair_ross.py",)}, missing)
    # one element for each section, then finer: [m] and elements for each section
    meshes = {OWN: [10.0, 2.0, 1.0, 0.5, 0.25, 0.125], "ROSS": [1, 2, 4, 8, 16, 32]}
    coarse = work.first({name: {"mesh": sizes[0]} for name, sizes in meshes.items()})
    converged = np.array(work.own.ask(mesh=0.05)["frequencies"])
    apart = ["?"] * 4
    if "ROSS" in coarse:
        one, other = (np.array(found["frequencies"]) for found in coarse.values())
        finest = np.array(work.sides[1].ask(mesh=32, matrices=True)["frequencies"])
        apart = [f"{_largest(one, other):.0e}", f"{_largest(converged, finest):.0e}"]
        files = [f"{tempfile.mkdtemp()}/rotor.npz" for _ in (0, 1)]
        held = work.sides[1].ask(mesh=8, matrices=True, files=files)
        read = np.array(work.own.ask(mesh=0.0, files=files)["frequencies"])
        apart.append(f"{_largest(read, np.array(held['frequencies'])):.0e}")
        apart.append(f"{held['seconds'] - held['building']:.2g}")
    page.fill("agree to {} with one element for each section, and to {} with", *apart[:2])
    page.fill("such a pair has the frequencies that ROSS finds, to {}.", apart[2])
    page.fill("its matrices, solved by SciPy, give the frequencies in {} s", apart[3])
    tasks, rows = {}, {}
    for side in work.sides:
        for mesh in meshes[side.name]:
            found = side.ask(mesh=mesh)
            error = _largest(np.array(found["frequencies"]), converged)
            if error < 10.0 * ASKED:
                break
        tasks[side.name] = {"mesh": mesh}
        asked = f"{mesh:g} m" if side is work.own else f"{mesh} a section"
        rows[side.name] = [side.name, asked, f"{error:.1e}"]
    work.time(tasks, repeats)
    alone = []
    for side in work.sides:
        last = side.ask(**tasks[side.name])
        alone.append(f"{last['seconds'] - last['building']:.2g}")
    page.rows("Program | elements", [
        [*rows[side.name], solved, *work.times(side)]
        for side, solved in zip(work.sides, alone, strict=True)
    ])  # fmt: skip
    return work


def _largest(found: Array, right: Array) -> float:
    return float(np.abs(found / right - 1.0).max())


def _off(path: Path, right: Array) -> float:
    """Return the largest rms error of pressures over their mean."""
    return max(
        float(np.sqrt(np.mean((one - two) ** 2)) / two.mean())
        for one, two in zip(np.load(path), right, strict=True)
    )


def rough(page: Page, repeats: int, missing: dict[str, str]) -> Work:
    """Compare rough contacts."""
    folder = Path(tempfile.mkdtemp())
    sides = {
        OWN: ("rough_gearlube.py",),
        "tamaas": ("rough_tamaas.py",),
        "ContactMechanics": ("rough_contactmechanics.py",),
    }
    work = Work(sides, missing)
    base = {"nodes": PATCH_NODES}
    work.own.ask(**base, tolerance=1e-9, out=str(folder / "right.npy"))
    right = np.load(folder / "right.npy")
    apart = "?"
    for peer in (one for one in work.sides if one.name == "tamaas"):
        peer.ask(**base, tolerance=1e-12, out=str(folder / "tight.npy"))
        apart = f"{_off(folder / 'tight.npy', right):.0e}"
    page.fill("its pressures and those of tamaas at 1e-12 differ by {} of the mean", apart)
    closed = cases.westergaard(PATCH_NODES)[1][None]
    tasks, rows = {}, {}
    for side in work.sides:
        out = folder / f"{side.name}.npy"
        side.ask(**base, tolerance=1e-8, out=str(out), wave=True)
        wave = _off(out, closed)
        for tolerance in TOLERANCES:
            task = {**base, "tolerance": tolerance, "out": str(out)}
            side.ask(**task)
            error = _off(out, right)
            if error < ASKED:
                break
        shares = ", ".join(f"{100.0 * np.mean(one > 0.0):.2f}" for one in np.load(out))
        tasks[side.name] = task
        errors = f"{error:.0e}", shares, f"{100.0 * wave:.3f} %"
        rows[side.name] = [side.name, f"{tolerance:.0e}", *errors]
    work.time(tasks, repeats)
    page.rows("Program | tolerance", [
        [*rows[side.name], *work.times(side)] for side in work.sides
    ])  # fmt: skip
    return work


def film(page: Page, repeats: int, missing: dict[str, str], repository: str) -> Work:
    """Compare point films."""
    sides: dict[str, tuple[str, ...]] = {OWN: ("film_gearlube.py",), "slippy": ("film_slippy.py",)}
    if repository:
        sides["EHL-FBNS"] = ("film_fbns.py", repository)
    work = Work(sides, missing)
    fine = [work.own.ask(nodes=nodes) for nodes in FINE_FILM]
    # both errors fall with the square of the step
    limit = {k: (4.0 * fine[1][k] - fine[0][k]) / 3.0 for k in ("central", "minimum")}
    shown = [f"{1e9 * one:.1f}" for one in limit.values()]
    page.fill("points a side, extrapolated, are {} nm in the centre and {} nm at", *shown)
    coarse = work.first(tasks := {side.name: {"nodes": FILM_NODES[0]} for side in work.sides})
    finer = work.once({one.name: {"nodes": FILM_NODES[1]} for one in work.sides})
    value = "?"
    if "central" in finer.get("EHL-FBNS", {}):
        two = [found["EHL-FBNS"]["central"] for found in (coarse, finer)]
        value = f"{1e9 * (4.0 * two[1] - two[0]) / 3.0:.1f}"
    page.fill("EHL-FBNS has {} nm in the centre, extrapolated", value)
    first_order = work.own.ask(nodes=FILM_NODES[0], wedge="upwind-1")["central"]
    page.fill("gearlube has {} nm with such a one, on 65 x 65", f"{1e9 * first_order:.1f}")
    work.time(tasks, repeats)
    rows = []
    for side in work.sides:
        for nodes, found in zip(FILM_NODES, (coarse, finer), strict=True):
            one, size = found[side.name], f"{nodes} x {nodes}"
            if "error" in one:
                rows.append([side.name, size, one["error"], "", "", ""])
                continue
            cells = [
                f"{1e9 * one[k]:.1f} ({100.0 * (one[k] / limit[k] - 1.0):+.1f} %)" for k in limit
            ]
            once = [one["seconds"], one["seconds"] / found[OWN]["seconds"]]
            timed = [f"{once[0]:.2g}, once", f"{once[1]:.2g}" if side is not work.own else "1"]
            timed = work.times(side) if found is coarse else timed
            rows.append([side.name, size, *cells, *timed])
    page.rows("Program | points", rows)
    return work


def repository_of(given: str | None, missing: dict[str, str]) -> str:
    """Return the folder of EHL-FBNS's repository, fetched if need be; empty if it is not there."""
    try:
        if not shutil.which("octave-cli"):
            raise MissingError("no octave-cli on the search path")
        if given:
            return str(Path(given).resolve())
        folder = cache_folder("peers") / "EHL-FBNS-repository"
        if not folder.exists():
            _run(["git", "clone", "--quiet", "--depth", "1", FBNS, str(folder)])
        return str(folder)
    except MissingError as why:
        missing["EHL-FBNS"] = str(why)
        return ""


def main() -> None:
    """Do the work and write the page."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fbns", metavar="GIT", help=f"copy of {FBNS}")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--only", nargs="+", choices=tuple(WORDS), default=tuple(WORDS))
    given = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):  # all programs on one and the same core
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    page, missing, versions = Page("peers"), {}, {}
    faster: list[str] = []
    for name in given.only:
        if name == "gears":
            work = gear_pair(page, given.repeats, missing)
        elif name == "rough":
            work = rough(page, given.repeats, missing)
        else:
            work = film(page, given.repeats, missing, repository_of(given.fbns, missing))
        faster += work.faster(WORDS[name])
        for side in work.sides:
            versions[side.name] = side.version
            side.end()
    logger.info("faster: %s, missing: %s", faster, missing)
    if set(given.only) == set(WORDS):
        rows = [
            [name, versions.get(name, f"not run: {missing.get(name)}"), peer.word]
            for name, peer in PEERS.items()
        ]
        page.rows("Program | version", rows)
        lines = "\n".join(f"- {one}" for one in faster or ["none"])
        page.paragraph("Faster than gearlube here:", lines)
        page.fill("Run on {}, Python {}, turns: {}, {}.", _processor(), platform.python_version(),
                  given.repeats, date.today().isoformat())  # fmt: skip
    page.write()


def _processor() -> str:
    """Return the name of the processor."""
    info = Path("/proc/cpuinfo")
    known = info.read_text() if info.exists() else ""
    return known.partition("model name\t: ")[2].partition("\n")[0] or platform.machine()


if __name__ == "__main__":
    main()
