"""The picture of the house: one row of boxes a floor, imports point down."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import NamedTuple

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
