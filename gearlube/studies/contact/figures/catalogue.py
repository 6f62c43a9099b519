"""The figures of a tooth contact analysis, in reading order."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from gearlube.report.pictures import Picture, save_pictures
from gearlube.studies.contact.figures.flank_maps import ease_off_map, pressure_maps
from gearlube.studies.contact.figures.mesh_period import (
    stiffness_against_torque,
    stiffness_and_radii,
    transmission_errors,
)
from gearlube.studies.contact.figures.pair_cycle import contact_properties, load_shares

CONTACT_CATALOGUE = {
    "pressure": Picture(
        pressure_maps,
        "Contact pattern and pressure on the gear tooth",
        "Highest pressure at each place of the gear tooth while it passes through the mesh, for "
        "each side and torque. A good pattern stays inside the outline. Blue lines at tip or root "
        "are sharp edges that press into the flank; tip relief helps there.",
    ),
    "ease_off": Picture(
        ease_off_map,
        "Contact pattern without load",
        "Gap between the flank and one that would roll without error, with the path of contact "
        "and the pattern of a marking test. Compare the red outline with the pattern of your "
        "testing machine.",
    ),
    "transmission_error": Picture(
        transmission_errors,
        "Transmission error",
        "Static error over two mesh periods along the line of action, for some torques. The swing "
        "of a curve excites the whine at its torque; the torque with the smallest swing is "
        "quietest.",
    ),
    "load_share": Picture(
        load_shares,
        "A tooth pair from entry to exit",
        "Share of the torque that one pair carries, and its highest pressure. Pressure peaks at "
        "entry or exit come from edge contact.",
    ),
    "stiffness": Picture(
        stiffness_and_radii,
        "Mesh stiffness and contact radii",
        "Over two mesh periods, for some torques. Secant: force over closing; tangent: slope of "
        "force over closing, which governs vibration.",
    ),
    "stiffness_torque": Picture(
        stiffness_against_torque,
        "Mesh stiffness over torque",
        "Mean stiffness over the mesh, and the number of pairs that carry load. Both grow with the "
        "torque, because the contact spreads.",
    ),
    "contact_properties": Picture(
        contact_properties,
        "Curvature and motion in the contact",
        "At the centre of force of one pair from entry to exit: relative radii, entrainment and "
        "sliding per pinion speed. Entrainment builds the film; sliding makes heat.",
    ),
}


def save_contact_figures(dataset: xr.Dataset, directory: Path) -> list[Path]:
    """Draw every figure into `directory` as PNG and return the files."""
    return save_pictures(CONTACT_CATALOGUE, directory, dataset)
