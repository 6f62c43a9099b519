"""The figures of a pair's geometry, in reading order."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.studies.helical.figures.geometry_gaps import (
    crown_forms,
    equal_relief,
    facet_gaps,
    relief_gaps,
)
from gearlube.studies.helical.figures.geometry_loads import (
    contact_plane,
    relieved_lines,
    unmodified_lines,
)
from gearlube.studies.helical.figures.geometry_path import (
    contact_characteristics,
    lay_angles,
    sliding_on_line,
)

# each takes the datasets of `geometry_dataset` that are drawn side by side
GEOMETRY_CATALOGUE: dict[str, Callable[[Sequence[xr.Dataset]], Any]] = {
    "contact_plane": contact_plane,
    "lines_unmodified": unmodified_lines,
    "lines_relieved": relieved_lines,
    "contact_characteristics": contact_characteristics,
    "sliding_on_line": sliding_on_line,
    "crown_forms": crown_forms,
    "relief_gaps": relief_gaps,
    "equal_relief": equal_relief,
    "facet_gaps": facet_gaps,
    "lay_angles": lay_angles,
}

_NEEDED = {
    "sliding_on_line": "line_sliding",
    "crown_forms": "crown_form",
    "relief_gaps": "line_gap_by_form",
    "equal_relief": "relief_line",
    "lay_angles": "lay_pinion",
}


def drawn_datasets(name: str, datasets: Sequence[xr.Dataset]) -> list[xr.Dataset]:
    """Return those of the datasets that hold what a figure of the catalogue draws.

    None where it has no meaning for the pairs; their attribute `left_out` says why.
    """
    if name == "lines_relieved":
        return [dataset for dataset in datasets if dataset.sizes["relief"] > 1]
    needed = _NEEDED.get(name)
    return [dataset for dataset in datasets if needed is None or needed in dataset]


def save_geometry_figures(datasets: Sequence[xr.Dataset], directory: Path) -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files."""
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, draw in GEOMETRY_CATALOGUE.items():
        drawn = drawn_datasets(name, datasets)
        if drawn:
            path = directory / f"{name}.png"
            draw(drawn).savefig(path, dpi=150)
            files.append(path)
    return files
