"""Tables of docs/architecture.md and docs/images/house.svg: `python -m docs.architecture.make`.

Rooms and their floors are read from the import contracts in pyproject.toml, which CI enforces.
What a room holds is the first sentence of its package's docstring.
"""

from __future__ import annotations

import tomllib
from importlib import import_module

from docs.architecture.picture import Floor, house
from docs.page import IMAGES, ROOT, Page

PICTURE = IMAGES / "house.svg"


def layers(name: str) -> tuple[list[list[str]], str]:
    """Return the floors of a contract, top first, and the package that they are in."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    for contract in contracts["tool"]["importlinter"]["contracts"]:
        if contract["name"] == name:
            floors = [[room.strip("() ") for room in row.split("|")] for row in contract["layers"]]
            return floors, contract.get("containers", [""])[0]
    raise KeyError(name)


def summary(module: str) -> str:
    """Return the first line of a module's docstring, without its full stop."""
    text = import_module(module).__doc__ or ""
    return text.splitlines()[0].removesuffix(".")


def table(name: str) -> list[list[str]]:
    """Return the rows of a contract's floors."""
    floors, container = layers(name)
    rows = []
    for height, rooms in zip(range(len(floors), 0, -1), floors, strict=True):
        for room in rooms:
            module = f"{container}.{room}" if container else room
            rows.append([f"{height}", f"`{module}`", summary(module)])
    return rows


def picture() -> str:
    """Return the SVG of the house."""
    top = [Floor("gearlube", rooms) for rooms in layers("Inside gearlube")[0]]
    middle = [Floor("", [room]) for room in ("fmu_src", "drivetrain")]
    core = [Floor("gearlube_core", rooms) for rooms in layers("Inside the core")[0]]
    studies = sorted(p.parent.name for p in (ROOT / "gearlube" / "studies").glob("*/__init__.py"))
    return house([*top, *middle, *core], {"studies": ", ".join(studies)})


def refreshed() -> Page:
    """Return the page with the floors of now."""
    page = Page("architecture")
    page.rows("Layer | Module", table("Inside gearlube"), "\n## gearlube\n")
    page.rows("Layer | Module", table("Inside the core"), "\n## gearlube_core\n")
    return page


def main() -> None:
    """Write page and picture."""
    refreshed().write()
    PICTURE.write_text(picture(), encoding="utf-8")


if __name__ == "__main__":
    main()
