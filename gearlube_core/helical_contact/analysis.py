"""Loaded tooth contact of a helical pair from its flanks to dataset and line mesh."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import xarray as xr

from gearlube_core.helical_contact.contact_dataset import contact_dataset
from gearlube_core.helical_contact.line_mesh import line_mesh
from gearlube_core.helical_contact.mesh_cycle import CycleSettings, run_cycle
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.progress import Progress, no_progress


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSettings:
    """Loads and positions of an analysis, and the elastic bodies.

    Parameters
    ----------
    cycle : CycleSettings
    body : HelicalBodySettings
    """

    cycle: CycleSettings
    body: HelicalBodySettings = field(default_factory=HelicalBodySettings)


class HelicalContact(NamedTuple):
    """Results of a loaded mesh period: a dataset, and the line mesh for dynamics."""

    dataset: xr.Dataset
    line_mesh: LineMesh


def analyse_contact(
    modified: ModifiedPair,
    settings: ContactSettings,
    *,
    store: Path | None = None,
    cache: Path | None = None,
    jobs: int | None = None,
    cycle_jobs: int | None = None,
    progress: Progress = no_progress,
) -> HelicalContact:
    """Return the loaded contact of a pair over a mesh period.

    Parameters
    ----------
    modified : ModifiedPair
        Gears with the modifications of their flanks.
    settings : ContactSettings
    store : Path, optional
        Folder that keeps finished positions, so that an interrupted analysis goes on.
    cache : Path, optional
        Folder of tooth compliances; default: the user's cache.
    jobs : int, optional
        Processes; default: all processors.
    cycle_jobs : int, optional
        Processes for the positions, if other than `jobs`.
    progress : callable, optional
        Called with the share of positions that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        When a tooth is pointed or cannot be meshed, or corners carry most of a torque.
    ConvergenceError
        When a position finds no equilibrium.
    """
    cycle = settings.cycle
    progress(0.0, "elastic teeth (kept for the next run)")
    stiffness = pair_stiffness(modified.pair, settings.body, cache=cache, jobs=jobs)
    progress(0.0, "loaded contact")
    record = run_cycle(
        modified, stiffness, cycle, store=store, jobs=cycle_jobs or jobs, progress=progress
    )
    return HelicalContact(
        contact_dataset(modified, cycle, record), line_mesh(modified, cycle, record)
    )
