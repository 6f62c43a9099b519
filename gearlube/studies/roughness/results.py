"""Statistics of a surface as rows, and the files of a result: heights, statistics, figure."""

from __future__ import annotations

import math
from dataclasses import fields
from pathlib import Path
from typing import NamedTuple

from gearlube.output.csv_text import csv_text
from gearlube.studies.roughness.figure import surface_figure
from gearlube_core.storage.atomic_file import atomic_write, write_text
from gearlube_core.surface.files import write_surface
from gearlube_core.surface.generator import Generated
from gearlube_core.surface.heights import HeightMap, Profile, Surface
from gearlube_core.surface.statistics import map_statistics, profile_statistics

_ONES = {"Rsk", "Rku", "Rdq", "steepest", "Ssk", "Sku", "Sdq", "Str"}
_ANGLES = {"fastest_direction"}


class Row(NamedTuple):
    """One number of a surface."""

    name: str
    value: float
    unit: str
    asked: float | None = None


def statistics_rows(surface: Surface) -> list[Row]:
    """Return all statistics in um, deg and 1."""
    of = profile_statistics(surface) if isinstance(surface, Profile) else map_statistics(surface)
    rows = []
    for one in fields(of):
        value = getattr(of, one.name)
        if isinstance(value, tuple):
            rows += [
                _row(f"{one.name} {axis}", one.name, part)
                for axis, part in zip("xy", value, strict=True)
            ]
        else:
            rows.append(_row(one.name, one.name, value))
    return rows


def reached_rows(generated: Generated[Profile] | Generated[HeightMap]) -> list[Row]:
    """Return what a generated surface reached against what was asked."""
    rows = []
    for one in generated.statistics:
        factor, unit = (1e6, "um") if one.unit == "m" else (1.0, one.unit)
        rows.append(Row(one.name, factor * one.reached, unit, factor * one.asked))
    return rows


def write_results(surfaces: dict[str, Surface], out: Path) -> list[Path]:
    """Write heights, statistics and figure of each surface into a folder; return their places."""
    written = []
    for name, surface in surfaces.items():
        rows = statistics_rows(surface)
        heights = out / f"{name}{'.csv' if isinstance(surface, Profile) else '.npz'}"
        write_surface(surface, heights)
        table = out / f"{name}_statistics.csv"
        write_text(
            csv_text(("name", "value", "unit"), ((r.name, f"{r.value:.9g}", r.unit) for r in rows)),
            table,
        )
        picture = out / f"{name}.png"
        with atomic_write(picture) as partial:
            surface_figure(surface).savefig(partial, format="png")
        written += [heights, table, picture]
    return written


def _row(shown: str, name: str, value: float) -> Row:
    if name in _ONES:
        return Row(shown, value, "1")
    if name in _ANGLES:
        return Row(shown, math.degrees(value), "deg")
    return Row(shown, 1e6 * value, "um")
