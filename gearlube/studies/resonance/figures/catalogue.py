"""The figures of a resonance study, in reading order."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.studies.resonance.figures.flank_contacts import contact_properties
from gearlube.studies.resonance.figures.motions import (
    constant_radii,
    dry_and_lubricated,
    phase_portraits,
    poincare_section,
    spectra,
    time_histories,
)
from gearlube.studies.resonance.figures.response_curves import (
    harmonics,
    response_curves,
    stability,
)
from gearlube.studies.resonance.figures.traction import traction_curves, traction_map

Draw = Callable[[xr.Dataset, xr.Dataset], Any]


def _of_cycle(draw: Callable[[xr.Dataset], Any]) -> Draw:
    return lambda _, cycle: draw(cycle)


# what a figure needs of the datasets, and how it is drawn
RESONANCE_CATALOGUE: dict[str, tuple[str, Draw]] = {
    "response": ("peak_to_peak", lambda response, _: response_curves(response)),
    "harmonics": ("harmonics", lambda response, _: harmonics(response)),
    "stability": ("multiplier", lambda response, _: stability(response)),
    "time_histories": ("x", _of_cycle(time_histories)),
    "spectra": ("spectrum", _of_cycle(spectra)),
    "constant_radii": ("x", _of_cycle(constant_radii)),
    "phase_portraits": ("rate", _of_cycle(phase_portraits)),
    "poincare_section": ("section_x", _of_cycle(poincare_section)),
    "dry_and_lubricated": ("load", _of_cycle(dry_and_lubricated)),
    "traction_map": ("load", _of_cycle(traction_map)),
    "traction_curves": ("load", _of_cycle(traction_curves)),
    "contact_properties": ("load", _of_cycle(contact_properties)),
}


def save_resonance_figures(response: xr.Dataset, cycle: xr.Dataset, directory: Path) -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files."""
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, (needed, draw) in RESONANCE_CATALOGUE.items():
        if all(needed not in dataset or dataset[needed].size == 0 for dataset in (response, cycle)):
            continue
        path = directory / f"{name}.png"
        draw(response, cycle).savefig(path, dpi=150)
        files.append(path)
    return files
