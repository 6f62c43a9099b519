"""Loaded contact of the pair, compared with ISO 6336-1 and a constant stiffness density."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.studies.helical.settings import HelicalSettings
from gearlube_core.helical_contact.analysis import ContactSettings, HelicalContact, analyse_contact
from gearlube_core.helical_geometry.contact_line import (
    ContactPlane,
    clip_line,
    line_count,
    line_position,
    segment_length,
)
from gearlube_core.helical_geometry.iso_6336_stiffness import (
    iso_stiffness,
    stiffness_density,
    tangential_line_load,
)
from gearlube_core.progress import Progress, no_progress

_PHASES = 240


def analyse_loaded_contact(
    settings: HelicalSettings,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    cycle_jobs: int | None = None,
    progress: Progress = no_progress,
) -> HelicalContact:
    """Return the loaded mesh period of a study, with ISO 6336-1 in the dataset's attributes.

    Parameters
    ----------
    settings : HelicalSettings
    store : Path, optional
        Folder that keeps finished positions.
    jobs : int, optional
        Processes for the teeth; all processors by default.
    cycle_jobs : int, optional
        The same for the positions, if other than `jobs`.
    progress : callable, optional
        Called with the share of positions that is done [-] and a sentence on what runs.
    """
    modified = settings.file.modified_pair()
    found = analyse_contact(
        modified,
        ContactSettings(cycle=settings.cycle(), body=settings.body),
        store=store,
        jobs=jobs,
        cycle_jobs=cycle_jobs,
        progress=progress,
    )
    pair = modified.pair
    iso = iso_stiffness(pair, line_load=tangential_line_load(pair, settings.pinion_torque))
    found.dataset.attrs |= {
        "contact_start": pair.contact_start,
        "contact_end": pair.contact_end,
        "pitch_point": pair.pitch_point,
        "line_lag": pair.face_width * math.tan(pair.base_helix_angle),
        "path_units": "m",
        "iso_mesh_stiffness": iso.mesh * pair.face_width,
        "iso_mesh_stiffness_units": "N/m",
        "iso_density": stiffness_density(iso.mesh, pair),
        "iso_density_units": "N/m2",
        "iso_outside": "; ".join(iso.outside) or "none",
    }
    return found


def constant_density_stiffness(settings: HelicalSettings, density: float) -> xr.Dataset:
    """Return the stiffness of each line and of all with one density: [he_2007 fig. 4].

    Parameters
    ----------
    settings : HelicalSettings
    density : float
        [N/m2]

    Returns
    -------
    xarray.Dataset
        K_line_constant of dimensions (zone_phase, constant_line) along the line of action [N/m].
    """
    plane = settings.file.helical_pair().plane
    phase = np.arange(_PHASES + 1) / _PHASES
    lines = np.arange(int(line_count(plane)))
    length = np.array(
        [[_length(min(p, 1.0 - 1e-12), int(i), plane) for i in lines] for p in phase.tolist()]
    )
    stiffness = density * plane.cos_b**2 * length
    return xr.Dataset(
        {
            "K_line_constant": (
                ("zone_phase", "constant_line"),
                stiffness,
                {"units": "N/m", "long_name": "stiffness of a line with one density, along x"},
            )
        },
        coords={
            "zone_phase": ("zone_phase", phase, {"units": "1", "long_name": "mesh phase"}),
            "constant_line": (
                "constant_line",
                lines,
                {"units": "1", "long_name": "contact line by age, 0 enters at phase 0"},
            ),
        },
    )


def _length(phase: float, line: int, plane: ContactPlane) -> float:
    segment = clip_line(line_position(phase, line, plane), plane)
    return float(segment_length(segment, plane))
