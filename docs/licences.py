"""Write docs/licences.md: licences of all packages that gearlube loads, from their metadata.

Run `python -m docs.licences` after a change of the dependencies in pyproject.toml. A package that
is not installed keeps the licence that stands in `STATED`.
"""

from __future__ import annotations

import re
import tomllib
from importlib.metadata import PackageNotFoundError, metadata
from pathlib import Path

HERE = Path(__file__).parent
PAGE = HERE / "licences.md"
# licences that the metadata does not say, or says at length
STATED = {
    "scipy": "BSD-3-Clause",
    "casadi": "LGPL-3.0-or-later",
    "pyfftw": "BSD-3-Clause; it brings FFTW, **GPL-2.0-or-later**",
    "fmpy": "BSD-2-Clause",
    "matplotlib": "matplotlib licence (PSF-like)",
    "trimesh": "MIT",
    "plotly": "MIT; its JavaScript (MIT) is inside each report",
    "tbb": "Intel Simplified Software License",
    "fastsim": "Apache-2.0",
    "wltp": "EUPL 1.1 or later",
    "phonometry": "see the package",
}
PURPOSES = {
    "": "always installed",
    "native": "compiler of native FMUs",
    "surfaces": "measured surfaces",
    "sound": "loudness, tonality; measured transfer paths",
    "export": "VTK files, measurement files",
    "cycles": "driving cycles",
    "cluster": "points on other machines",
    "film-model": "fit of film models",
    "docs": "this site",
    "test": "tests",
    "lint": "checks of the code",
    "release": "wheel, upload and list of parts",
}

_HEAD = """# Licences

Written by `python -m docs.licences`; not edited by hand.

gearlube has the MIT licence. Its wheel holds gearlube alone, and no other package. The packages
below are loaded where you install them. A container made by `Containerfile` holds those that are
always installed and those of `native`, with Python and its base system. Who passes on a container
must keep all their licences.

- **What a native FMU holds**: machine code of gearlube's own kernels (MIT) with mathematical
  functions of numba (BSD-2-Clause), C code of gearlube, the headers of the FMI standard
  (BSD-2-Clause), start code of zig (MIT) and, for Windows, of mingw-w64 (ZPL-2.1). Their texts are
  in the folder `documentation/licenses` of each FMU. A driveline also holds C code that casadi
  writes for gearlube's equations.
- **FFTW is GPL.** pyfftw brings it. A native FMU holds nothing of it. Who passes on a program or a
  container with pyfftw must follow the GPL for it: FFTW's source, or a written offer of it, goes
  with the copy. Using gearlube inside a company is no such case. Who will not do that removes
  pyfftw: SciPy's transforms take over, with the same numbers to round-off.
- **casadi is LGPL.** It is loaded as a separate library, which a user can exchange. No native FMU
  holds it.
- **asammdf is LGPL.** It comes with the extra `export` alone, is loaded as it is, only while a
  measurement file (MDF 4) is written, and no FMU or wheel holds it.
- An FMU that computes in Python loads the packages of the machine where it runs.
- **plotly's JavaScript** (MIT) is inside each report.
"""


def licence_of(name: str) -> str:
    """Return the licence of a package as stated here, or by its metadata."""
    if name in STATED:
        return STATED[name]
    try:
        found = metadata(name)
    except PackageNotFoundError:
        return "see the package"
    short = found["License-Expression"] or found["License"]  # None where it is not given
    if short and "\n" not in short and len(short) < 60:
        return str(short)
    classes = [c for c in found.get_all("Classifier") or [] if c.startswith("License ::")]
    return ", ".join(c.rsplit(" :: ", 1)[-1] for c in classes) or "see the package"


def requirements() -> dict[str, list[tuple[str, str]]]:
    """Return name and version range of each package, by extra; "" is always installed."""
    project = tomllib.loads((HERE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    groups = {"": project["dependencies"], **project["optional-dependencies"]}
    found = {}
    for extra in groups:
        rows = []
        for line in groups[extra]:
            name, versions = re.fullmatch(r"([\w.-]+)(?:\[.*\])?([^;]*).*", line).groups()  # type: ignore[union-attr]
            rows.append((name, versions.strip()))
        found[extra] = rows
    return found


def page() -> str:
    """Return the page."""
    parts = [_HEAD]
    for extra, rows in requirements().items():
        title = f"Extra `{extra}`: {PURPOSES[extra]}" if extra else "Always installed"
        parts += [f"\n## {title}\n\n| Package | Versions | Licence |\n|---|---|---|\n"]
        parts += [f"| {name} | {versions} | {licence_of(name)} |\n" for name, versions in rows]
    return "".join(parts)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
