"""Record the numbers that the commands give, and compare two such records.

    python -m benchmarks.record take FOLDER       run every case below, about fifteen minutes
    python -m benchmarks.record compare OLD NEW   exit code 1 where numbers differ

Take one record before a change that must keep the numbers, one after it, on the same machine. The
cases run the command `gearlube` and the FMUs only, so that code may move between the two records.
A number agrees if it differs by at most TOLERANCE of the largest magnitude of its variable. Model
descriptions agree if they are equal but for GUID, time and version of the tool: value references
are among what must not change. Times are processor seconds; they are printed, not judged.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import numpy as np
import xarray as xr

TOLERANCE = 1e-12

COMMANDS = {
    "contact": ["contact"],
    "contact_face_milled": ["contact", "examples/gears/face_milled.toml", "--quick"],
    "sweep": ["sweep", "--jobs", "2"],
    "sweep_as_printed": ["sweep", "--quick", "--equations", "as_printed"],
    "map": [
        "map", "--torques", "-50:200:125", "--speeds", "500:2500:1000", "--temperatures",
        "60:100:40", "--draws", "20",
    ],
    "cycle": ["cycle"],
    "bearing": ["bearing"],
    "drivetrain": ["drivetrain", "--duration-ms", "20"],
    "whine": ["whine", "--speeds-rpm", "1000:3000:500"],
    "runup": ["runup", "--quick"],
    "resonance": ["resonance", "--quick", "--load-at", "0.9"],
    "resonance_synthetic": [
        "resonance", "--quick", "--mesh", "synthetic", "--mismatch", "0.3", "--radii", "paper",
    ],
    "helical": ["helical", "--quick"],
    "helical_solved": [
        "helical", "--quick", "--parts", "losses", "--film-model", "solved", "--speeds-rpm", "1500",
    ],
    "helical_jamali": ["helical", "jamali_2015_a", "--quick", "--parts", "contact"],
    "line": ["ehl", "line"],
    "line_thermal": ["ehl", "line", "jamali_2015_thermal"],
    "line_mass_conserving": ["ehl", "line", "--cavitation", "mass_conserving", "--nodes", "401"],
    "line_galerkin": ["ehl", "line", "--stencil", "galerkin", "--nodes", "401"],
    "point": ["ehl", "point", "--nodes", "129"],
    "point_sliding": ["ehl", "point", "--nodes", "97", "--slide-roll", "0.5"],
    "point_elliptical": ["ehl", "point", "elliptical"],
    "point_thermal": ["ehl", "point", "elliptical_thermal"],
    "point_mass_conserving": [
        "ehl", "point", "--nodes", "97", "--cavitation", "mass_conserving"
    ],
    "helical_line": ["ehl", "helical", "--step", "300"],
    "helical_march": [
        "ehl", "helical", "--march", "60:66", "--nodes-across", "65", "--nodes-along", "129",
    ],
    "helical_facets": [
        "ehl", "helical", "--march", "60:64", "--facets", "40", "--nodes-across", "65",
        "--nodes-along", "129", "--spacing", "exit",
    ],
    "hypoid_film": ["ehl", "hypoid", "--quick"],
}  # fmt: skip

# variables that tell of the run, not of physics; what is left unbalanced near convergence is
# rounding, and its history with it
_OF_THE_RUN = (
    "seconds",
    "wall",
    "duration",
    "real_time",
    "residual_history",
    "load_error_history",
    "heat_balance_history",
)

_OF_THE_BUILD = re.compile(
    r'\b(guid|instantiationToken|generationDateAndTime|generationTool|version)="[^"]*"'
)


def take(folder: Path, names: list[str]) -> None:
    """Run the cases `names`, all if empty, and both FMUs; write to `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in names or [*COMMANDS, "fmu", "compilation"]:
        print(name, flush=True)  # noqa: T201
        place = folder / name
        place.mkdir(exist_ok=True)
        before = _children_s()
        if name == "fmu":
            _fmu_trajectories(place)
        elif name == "compilation":
            with tempfile.TemporaryDirectory() as empty:
                _run(["sweep", "--quick"], place, {"NUMBA_CACHE_DIR": empty})
        else:
            _run(COMMANDS[name], place)
        (place / "seconds.txt").write_text(f"{_children_s() - before:.2f}\n")


def _children_s() -> float:
    """Return the processor time of all programs that were run [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _run(arguments: list[str], folder: Path, settings: dict[str, str] | None = None) -> None:
    command = [str(Path(sys.executable).with_name("gearlube")), *arguments, "--out", str(folder)]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, env={**os.environ, **(settings or {})}
    )
    (folder / "exit_code.txt").write_text(f"{done.returncode}\n")
    if done.returncode:
        print(done.stderr, file=sys.stderr)  # noqa: T201


def _fmu_trajectories(folder: Path) -> None:
    """March both FMUs for 0.05 s and keep every output, and all model descriptions."""
    from fmpy import read_model_description, simulate_fmu

    _run(["build-fmu"], folder)
    for model in ("HypoidAxle", "HelicalPair"):
        path = str(folder / f"{model}.fmu")
        variables = read_model_description(path).modelVariables
        outputs = [v.name for v in variables if v.causality == "output" and v.type == "Real"]
        result = simulate_fmu(path, stop_time=0.05, output_interval=1e-3, output=outputs)
        columns = {name: ("time", result[name]) for name in result.dtype.names}
        xr.Dataset(columns).to_netcdf(folder / f"{model}.nc", engine="scipy")
    for path in folder.glob("*.fmu"):
        with zipfile.ZipFile(path) as archive:
            text = archive.read("modelDescription.xml").decode()
        (folder / f"{path.stem}.xml").write_text(_OF_THE_BUILD.sub("", text), "utf-8")


def compare(old: Path, new: Path) -> bool:
    """Print each file and variable that differ; return True if none does by over TOLERANCE."""
    agree, identical, variables = True, 0, 0
    for path in sorted(old.rglob("*.nc")):
        where = path.relative_to(old)
        if not (new / where).exists():
            if "points" not in where.parts and "parts" not in where.parts:
                print(f"{where}: missing")  # noqa: T201
                agree = False
            continue
        with xr.open_dataset(path) as first, xr.open_dataset(new / where) as second:
            for name in sorted({*first.variables, *second.variables}):
                if any(word in name for word in _OF_THE_RUN):
                    continue
                variables += 1
                if name not in first.variables or name not in second.variables:
                    print(f"{where}: {name} in one record only")  # noqa: T201
                    agree = False
                    continue
                difference = _difference(first[name].values, second[name].values)
                identical += difference == 0.0
                if difference:
                    print(f"{where}: {name} differs by {difference:.1e}")  # noqa: T201
                agree &= difference <= TOLERANCE
    for path in sorted([*old.rglob("exit_code.txt"), *old.glob("fmu/*.xml")]):
        where = path.relative_to(old)
        if not (new / where).exists() or path.read_text() != (new / where).read_text():
            print(f"{where}: other text")  # noqa: T201
            agree = False
    for path in sorted(old.rglob("seconds.txt")):
        where = path.relative_to(old)
        if (new / where).exists():
            one, two = (float((folder / where).read_text()) for folder in (old, new))
            print(f"{where.parent}: {one:.1f} s, {two:.1f} s, ratio {two / one:.2f}")  # noqa: T201
    print(json.dumps({"variables": variables, "identical": identical, "agree": agree}))  # noqa: T201
    return agree


def _difference(first: np.ndarray, second: np.ndarray) -> float:
    """Return the largest difference over the largest magnitude, inf where they do not compare."""
    if first.shape != second.shape:
        return np.inf
    if first.dtype.kind not in "fc":
        return 0.0 if np.array_equal(first, second) else np.inf
    if np.array_equal(first, second, equal_nan=True):
        return 0.0
    if not np.array_equal(np.isnan(first), np.isnan(second)):
        return np.inf
    scale = float(np.nanmax(np.abs(first)))
    return float(np.nanmax(np.abs(second - first))) / scale if scale else np.inf


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    actions = parser.add_subparsers(dest="action", required=True)
    taking = actions.add_parser("take")
    taking.add_argument("folder", type=Path)
    taking.add_argument("cases", nargs="*", help="names of cases; all if left out")
    comparing = actions.add_parser("compare")
    comparing.add_argument("old", type=Path)
    comparing.add_argument("new", type=Path)
    given = parser.parse_args()
    if given.action == "take":
        take(given.folder, given.cases)
    elif not compare(given.old, given.new):
        sys.exit(1)


if __name__ == "__main__":
    main()
