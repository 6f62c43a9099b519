"""Put licences of all packages that gearlube loads, from their metadata, into docs/licences.md.

Run `python -m docs.licences` after a change of the dependencies in pyproject.toml. A package that
is not installed keeps the licence that stands in `STATED`.
"""

from __future__ import annotations

import re
import tomllib
from importlib.metadata import PackageNotFoundError, metadata

from docs.page import ROOT, Page

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
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    groups = {"": project["dependencies"], **project["optional-dependencies"]}
    found = {}
    for extra in groups:
        rows = []
        for line in groups[extra]:
            name, versions = re.fullmatch(r"([\w.-]+)(?:\[.*\])?([^;]*).*", line).groups()  # type: ignore[union-attr]
            rows.append((name, versions.strip()))
        found[extra] = rows
    return found


def main() -> None:
    """Put the packages into the chapters of the page."""
    page = Page("licences")
    for extra, rows in requirements().items():
        chapter = f"## Extra `{extra}`:" if extra else "## Always installed"
        packages = ([name, versions, licence_of(name)] for name, versions in rows)
        page.rows("Package | Versions", packages, chapter)
    page.write()


if __name__ == "__main__":
    main()
