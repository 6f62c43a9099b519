"""Loaded contact of the pair: dataset, line mesh and the constant density beside it."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.studies.helical.settings import HelicalSettings
from gearlube_core.helical_contact.contact_dataset import contact_dataset
from gearlube_core.helical_contact.line_mesh import line_mesh
from gearlube_core.helical_contact.mesh_cycle import CycleProgress, run_cycle
from gearlube_core.helical_contact.tooth_body import pair_stiffness
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
from gearlube_core.mesh_table.line_mesh import LineMesh

_PHASES = 240


class LoadedContact(NamedTuple):
    """Results of the loaded contact."""

    dataset: xr.Dataset
    mesh: LineMesh


def analyse_loaded_contact(
    settings: HelicalSettings,
    store: Path | None,
    jobs: int | None,
    cycle_jobs: int | None,
    announce: Callable[[str], None],
    observe: Callable[[float], None],
) -> LoadedContact:
    """Return the loaded mesh period of a study; finished positions are kept in `store`.

    Parameters
    ----------
    settings : HelicalSettings
    store : Path, optional
    jobs : int, optional
        Processes for the teeth; all processors by default.
    cycle_jobs : int, optional
        The same for the positions.
    announce : callable
        Told in words what begins.
    observe : callable
        Told the share that is done [-].
    """
    modified, cycle = settings.file.modified_pair(), settings.cycle()
    announce("elastic teeth (kept for the next run)")
    stiffness = pair_stiffness(modified.pair, settings.body, jobs=jobs)
    announce("loaded contact")

    def tell(progress: CycleProgress) -> None:
        observe(progress.done / progress.total)

    record = run_cycle(modified, stiffness, cycle, store=store, jobs=cycle_jobs, observer=tell)
    dataset = contact_dataset(modified, cycle, record)
    pair = modified.pair
    iso = iso_stiffness(pair, line_load=tangential_line_load(pair, settings.pinion_torque))
    dataset.attrs |= {
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
    return LoadedContact(dataset, line_mesh(modified, cycle, record))


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
