"""The figures of a study of a helical pair, in reading order."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import xarray as xr

from gearlube.report.pictures import Picture
from gearlube.studies.helical.figures.film_friction import film_on_lines, film_over_mesh
from gearlube.studies.helical.figures.friction_sweep import (
    friction_force_harmonics,
    friction_harmonics,
)
from gearlube.studies.helical.figures.geometry_catalogue import save_geometry_figures
from gearlube.studies.helical.figures.load_sharing import harris_map, load_sharing
from gearlube.studies.helical.figures.losses import pair_losses
from gearlube.studies.helical.figures.operating_point import (
    bearing_forces,
    composites,
    displacements,
)
from gearlube.studies.helical.figures.speed_sweep import campbell, friction_speed_maps, order_cuts
from gearlube.studies.helical.figures.stability import instability, separation
from gearlube.studies.helical.figures.tooth_stiffness import constant_stiffness, loaded_stiffness

_MOTIONS = "u: shift of a gear; x along the line of action, y across it, z along the shaft."
# `needs` is the dataset of the study that a figure is drawn from
HELICAL_CATALOGUE: dict[str, Picture] = {
    "load_sharing": Picture(
        load_sharing,
        "Load sharing and highest pressure",
        "Left: one tooth pair from entry to exit. Right: all pairs. Pressures beyond the axis "
        "come from sharp edges.",
        "contact",
    ),
    "harris_map": Picture(
        harris_map,
        "Loaded transmission error",
        "Its range and its mesh orders over the torque. Where they are smallest, the reliefs fit "
        "best.",
        "contact",
    ),
    "tooth_stiffness_loaded": Picture(
        loaded_stiffness,
        "Stiffness of the mesh and of its pairs",
        "From the loaded contact with elastic teeth. Its swing over the mesh excites vibration.",
        "contact",
    ),
    "tooth_stiffness_constant": Picture(
        constant_stiffness,
        "Stiffness with one density",
        "The same with one stiffness per length of contact line, and where each line is.",
        "contact",
    ),
    "campbell": Picture(
        campbell,
        "Campbell diagram of the bearing forces",
        "Lines: mesh orders. Dotted: natural frequencies. Large bright dots: loud. A resonance is "
        "where an order crosses a natural frequency and its dots grow.",
        "sweep",
    ),
    "order_cuts": Picture(
        order_cuts,
        "Mesh orders over speed",
        "Each order by itself, for several coefficients of friction and with the oil film.",
        "sweep",
    ),
    "friction_speed_maps": Picture(
        friction_speed_maps,
        "Bearing forces over friction and speed",
        "Root mean square of all mesh orders. A vertical ridge is a resonance.",
        "sweep",
    ),
    "displacements": Picture(
        displacements,
        "Motions at the operating point",
        f"Over two mesh periods. {_MOTIONS}",
        "response",
    ),
    "composites": Picture(
        composites,
        "Relative motions at the operating point",
        "delta_z is the dynamic transmission error, delta_x and delta_y are the tilts of the mesh.",
        "response",
    ),
    "bearing_forces": Picture(
        bearing_forces,
        "Bearing forces at the operating point",
        "Forces that the gears pass on to the housing, and their mesh orders.",
        "response",
    ),
    "friction_harmonics": Picture(
        friction_harmonics,
        "Motions against friction",
        f"Mesh orders at one speed. {_MOTIONS}",
        "friction_sweep",
    ),
    "friction_force_harmonics": Picture(
        friction_force_harmonics,
        "Bearing forces against friction",
        "Mesh orders at one speed. Friction acts along y, across the line of action.",
        "friction_sweep",
    ),
    "instability": Picture(
        instability,
        "Parametric instability",
        "Red: small disturbances grow, because the stiffness varies. Blue: they die out.",
        "stability",
    ),
    "separation": Picture(
        separation,
        "Tooth separation",
        "Transmission error with teeth that can leave each other: its peak bends to lower speeds. "
        "Between two folds the motion depends on where the speed came from.",
        "separation",
    ),
    "film_on_lines": Picture(
        film_on_lines,
        "Film and friction of a tooth pair from entry to exit",
        "A pair enters on the left. Friction is zero on the dashed pitch line, where the teeth "
        "only roll.",
        "film",
    ),
    "film_over_mesh": Picture(
        film_over_mesh,
        "Friction over the mesh and over speed",
        "Green: oil film. Below: mean coefficient of friction and smallest film (Dowson 1968) over "
        "speed.",
        "film",
    ),
    "losses": Picture(
        pair_losses,
        "Losses of the pair",
        "Power lost in the mesh over speed. Bearings, seals and churning are not included.",
        "losses",
    ),
}


def save_helical_figures(datasets: Mapping[str, xr.Dataset], directory: Path) -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files.

    Those of the geometry lie in `geometry`, those of pairs beside the one studied in `thesis`.
    """
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, one in HELICAL_CATALOGUE.items():
        if one.needs in datasets:
            path = directory / f"{name}.png"
            one.draw(datasets[one.needs]).savefig(path, dpi=150)
            files.append(path)
    if "geometry" in datasets:
        files += save_geometry_figures([datasets["geometry"]], directory / "geometry")
    beside = [dataset for name, dataset in datasets.items() if name.startswith("geometry_")]
    if beside:
        files += save_geometry_figures(beside, directory / "thesis")
    return files
