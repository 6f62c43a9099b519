"""The figures of a tooth contact analysis, in reading order."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from gearlube.studies.contact.figures.flank_maps import ease_off_map, pressure_maps
from gearlube.studies.contact.figures.mesh_period import (
    stiffness_against_torque,
    stiffness_and_radii,
    transmission_errors,
)
from gearlube.studies.contact.figures.pair_cycle import contact_properties, load_shares

CONTACT_CATALOGUE = {
    "ease_off": ease_off_map,
    "transmission_error": transmission_errors,
    "load_share": load_shares,
    "stiffness": stiffness_and_radii,
    "stiffness_torque": stiffness_against_torque,
    "pressure": pressure_maps,
    "contact_properties": contact_properties,
}


def save_contact_figures(dataset: xr.Dataset, directory: Path) -> list[Path]:
    """Draw every figure into `directory` as PNG and return the files."""
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, draw in CONTACT_CATALOGUE.items():
        path = directory / f"{name}.png"
        draw(dataset).savefig(path, dpi=150)
        files.append(path)
    return files
