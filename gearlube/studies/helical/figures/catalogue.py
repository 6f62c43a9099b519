"""The figures of a study of a helical pair, in reading order."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.studies.helical.figures.film_friction import film_on_lines, film_over_mesh
from gearlube.studies.helical.figures.friction_sweep import (
    friction_force_harmonics,
    friction_harmonics,
)
from gearlube.studies.helical.figures.geometry_catalogue import save_geometry_figures
from gearlube.studies.helical.figures.losses import pair_losses
from gearlube.studies.helical.figures.operating_point import (
    bearing_forces,
    composites,
    displacements,
)
from gearlube.studies.helical.figures.speed_sweep import campbell, friction_speed_maps, order_cuts
from gearlube.studies.helical.figures.stability import instability, separation
from gearlube.studies.helical.figures.tooth_stiffness import (
    constant_stiffness,
    harris_map,
    load_sharing,
    loaded_stiffness,
)

# the dataset of the study that a figure is drawn from, and how
HELICAL_CATALOGUE: dict[str, tuple[str, Callable[[xr.Dataset], Any]]] = {
    "tooth_stiffness_loaded": ("contact", loaded_stiffness),
    "tooth_stiffness_constant": ("contact", constant_stiffness),
    "load_sharing": ("contact", load_sharing),
    "harris_map": ("contact", harris_map),
    "displacements": ("response", displacements),
    "bearing_forces": ("response", bearing_forces),
    "composites": ("response", composites),
    "friction_harmonics": ("friction_sweep", friction_harmonics),
    "friction_force_harmonics": ("friction_sweep", friction_force_harmonics),
    "campbell": ("sweep", campbell),
    "order_cuts": ("sweep", order_cuts),
    "friction_speed_maps": ("sweep", friction_speed_maps),
    "instability": ("stability", instability),
    "separation": ("separation", separation),
    "film_on_lines": ("film", film_on_lines),
    "film_over_mesh": ("film", film_over_mesh),
    "losses": ("losses", pair_losses),
}


def save_helical_figures(datasets: Mapping[str, xr.Dataset], directory: Path) -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files.

    Those of the geometry lie in `geometry`, those of pairs beside the one studied in `thesis`.
    """
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, (needed, draw) in HELICAL_CATALOGUE.items():
        if needed in datasets:
            path = directory / f"{name}.png"
            draw(datasets[needed]).savefig(path, dpi=150)
            files.append(path)
    if "geometry" in datasets:
        files += save_geometry_figures([datasets["geometry"]], directory / "geometry")
    beside = [dataset for name, dataset in datasets.items() if name.startswith("geometry_")]
    if beside:
        files += save_geometry_figures(beside, directory / "thesis")
    return files
