"""Tables of docs/architecture.md and docs/images/house.svg: `python -m docs.architecture.make`.

Rooms and their floors are read from the import contracts in pyproject.toml, which CI enforces.
What a room holds is the first sentence of its package's docstring.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from html import escape
from importlib import import_module
from typing import NamedTuple

from docs.page import IMAGES, ROOT, Page

_WIDTH, _LEFT, _ROW, _BOX = 1000, 150, 46, 34
_COLOURS = {
    "gearlube": ("#eaf5ea", "#3a7d44"),
    "fmu_src": ("#fdf0d5", "#b7791f"),
    "drivetrain": ("#fdf0d5", "#b7791f"),
    "gearlube_core": ("#e8f1fa", "#2b6ca3"),
}


class Floor(NamedTuple):
    """A row of rooms; `package` is written at its left where it begins."""

    package: str
    rooms: list[str]


def house(floors: list[Floor], notes: Mapping[str, str]) -> str:
    """Return an SVG of `floors`, the top one first; `notes` say more of a room."""
    height = _ROW * len(floors) + 60
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {height}" '
        'font-family="sans-serif" font-size="14">',
        f'<rect width="{_WIDTH}" height="{height}" fill="white"/>',
    ]
    before = None
    for row, floor in enumerate(floors):
        y = 20 + row * _ROW
        if floor.package and floor.package != before:
            parts.append(f'<text x="12" y="{y + 22}" font-weight="bold">{floor.package}</text>')
        before = floor.package
        span = (_WIDTH - _LEFT - 20) / len(floor.rooms)
        for column, room in enumerate(floor.rooms):
            fill, edge = _COLOURS[floor.package or room]
            x = _LEFT + column * span
            label = escape(f"{room}: {notes[room]}" if room in notes else room)
            parts.append(
                f'<rect x="{x:.0f}" y="{y}" width="{span - 8:.0f}" height="{_BOX}" rx="6" '
                f'fill="{fill}" stroke="{edge}"/>'
                f'<text x="{x + (span - 8) / 2:.0f}" y="{y + 22}" text-anchor="middle">'
                f"{label}</text>"
            )
    below = 20 + len(floors) * _ROW
    parts.append(
        f'<text x="{_LEFT}" y="{below + 20}" fill="#444">'
        "A room imports what stands below it. Rooms side by side do not import each other."
        "</text>"
    )
    return "\n".join([*parts, "</svg>", ""])


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
