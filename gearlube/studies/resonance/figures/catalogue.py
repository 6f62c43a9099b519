"""The figures of a resonance study, in reading order."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.report.pictures import Picture, save_pictures
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


# `needs`: a variable of the datasets without which there is no figure
RESONANCE_CATALOGUE: dict[str, Picture] = {
    "response": Picture(
        lambda response, _: response_curves(response),
        "Response over mesh frequency",
        "Transmission error and time without contact of all periodic motions; dashed: unstable "
        "ones, which do not run by themselves. Between two folds there are two stable motions: "
        "which one runs depends on whether the speed rose or fell. Triangles are slow sweeps in "
        "time, as a check.",
        "peak_to_peak",
    ),
    "harmonics": Picture(
        lambda response, _: harmonics(response),
        "Mesh orders over mesh frequency",
        "Order n has its peak at 1/n of the natural frequency: there its excitation meets the "
        "resonance.",
        "harmonics",
    ),
    "stability": Picture(
        lambda response, _: stability(response),
        "Stability",
        "Factor by which a small disturbance grows or dies out in one mesh period. Above 1 the "
        "motion is unstable and does not run by itself. Near 1 a disturbance dies out slowly.",
        "multiplier",
    ),
    "time_histories": Picture(
        _of_cycle(time_histories),
        "Waveforms",
        "Transmission error over two mesh periods at some frequencies; more than one line: "
        "coexisting motions. In grey the teeth are apart.",
        "x",
    ),
    "spectra": Picture(
        _of_cycle(spectra),
        "Orders of the transmission error",
        "Amplitudes of mesh orders at some frequencies, one scale for all. At the natural "
        "frequency order 1 stands out, below it the order that meets it.",
        "spectrum",
    ),
    "constant_radii": Picture(
        _of_cycle(constant_radii),
        "Constant contact radii",
        "Waveforms and orders with mean radii: both models then agree, which checks them.",
        "x",
    ),
    "phase_portraits": Picture(
        _of_cycle(phase_portraits),
        "Phase portraits",
        "Rate over transmission error. A loop that enters the grey is an impact.",
        "rate",
    ),
    "poincare_section": Picture(
        _of_cycle(poincare_section),
        "Where motions from many starts end",
        "State once a mesh period, from many starts; the colour says which motion was reached.",
        "section_x",
    ),
    "dry_and_lubricated": Picture(
        _of_cycle(dry_and_lubricated),
        "With and without flank friction",
        "Waveforms of both, and their difference on a scale of its own, in nm.",
        "load",
    ),
    "traction_map": Picture(
        _of_cycle(traction_map),
        "Regime of the film",
        "All contacts of the cycles on the traction map: right of the line the film shears as an "
        "Eyring fluid, left of it heat limits the traction.",
        "load",
    ),
    "traction_curves": Picture(
        _of_cycle(traction_curves),
        "Traction over shear rate",
        "Traction of the most heavily loaded contact, by four laws. Heat bends the curves down.",
        "load",
    ),
    "contact_properties": Picture(
        _of_cycle(contact_properties),
        "A tooth pair from entry to exit",
        "Load, film, temperature and friction of one pair from entry to exit, one line for each "
        "case. Warm oil: thinner film, boundary friction appears.",
        "load",
    ),
}


def save_resonance_figures(response: xr.Dataset, cycle: xr.Dataset, directory: Path) -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files."""
    drawn = {
        name: one
        for name, one in RESONANCE_CATALOGUE.items()
        if any(one.needs in data and data[one.needs].size for data in (response, cycle))
    }
    return save_pictures(drawn, directory, response, cycle)
