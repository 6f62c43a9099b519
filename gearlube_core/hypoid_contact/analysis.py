"""Tooth contact analysis from a gear file to its dataset."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import xarray as xr

from gearlube_core.hypoid_contact.contact_dataset import contact_dataset
from gearlube_core.hypoid_contact.mesh_cycle import (
    CycleSettings,
    run_cycle,
)
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSettings:
    """Loads, positions and elastic teeth of a contact analysis, for `run_contact`.

    Parameters
    ----------
    cycle : CycleSettings
        Torques and mesh positions.
    body : ToothBodySettings
        Elastic teeth.

    Examples
    --------
    >>> from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
    >>> ContactSettings(cycle=CycleSettings(torques=(10.0, 50.0), positions=12)).cycle.positions
    12
    """

    cycle: CycleSettings = field(default_factory=CycleSettings)
    body: ToothBodySettings = field(default_factory=ToothBodySettings)


def analyse_contact(
    file: HypoidGearFile,
    settings: ContactSettings,
    *,
    store: Path | None = None,
    cache: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return the tooth contact of a gear file, unloaded and loaded, on both sides.

    Parameters
    ----------
    file : HypoidGearFile
    settings : ContactSettings
    store : Path, optional
        Folder that keeps finished positions, so that an interrupted analysis goes on.
    cache : Path, optional
        Folder of tooth compliances; default: the user's cache.
    jobs : int, optional
        Processes; default: all processors.
    progress : callable, optional
        Called with the share of positions that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        When the flanks do not meet; it takes seconds and names the setting that is likely wrong.
    ConvergenceError
        When a position finds no equilibrium.
    """
    progress(0.0, "checking the gear file")
    check_pair(file, settings.cycle.misalignment)
    progress(0.0, "elastic teeth")
    stiffness = pair_stiffness(file, settings.body, cache=cache, jobs=jobs)
    progress(0.0, "loaded contact")
    cycle = run_cycle(file, stiffness, settings.cycle, store=store, jobs=jobs, progress=progress)
    progress(1.0, "unloaded contact")
    return contact_dataset(file, settings.cycle, cycle)
