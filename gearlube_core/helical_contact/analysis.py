"""Loaded tooth contact of a helical pair from its flanks to dataset and line mesh."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import xarray as xr

from gearlube_core.helical_contact.contact_dataset import contact_dataset
from gearlube_core.helical_contact.loaded_line_mesh import line_mesh
from gearlube_core.helical_contact.mesh_cycle import CycleProgress, CycleSettings, run_cycle
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.mesh_table.line_mesh import LineMesh


class HelicalContact(NamedTuple):
    """What a loaded mesh period gives: to look at, and for the dynamics."""

    dataset: xr.Dataset
    line_mesh: LineMesh


def analyse_helical_contact(
    modified: ModifiedPair,
    cycle: CycleSettings,
    body: HelicalBodySettings,
    *,
    store: Path | None = None,
    cache: Path | None = None,
    jobs: int | None = None,
    announce: Callable[[str], None] = lambda text: None,
    observer: Callable[[CycleProgress], None] | None = None,
) -> HelicalContact:
    """Return the loaded contact of a pair over a mesh period.

    Parameters
    ----------
    modified : ModifiedPair
        Gears with the modifications of their flanks.
    cycle : CycleSettings
        Torques and positions.
    body : HelicalBodySettings
        The teeth's elastic bodies.
    store : Path, optional
        Folder that keeps finished positions, so that an interrupted analysis goes on.
    cache : Path, optional
        Folder of tooth compliances; default: the user's cache.
    jobs : int, optional
        Processes; default: all processors.
    announce : callable, optional
        Told what begins.
    observer : callable, optional
        Called after each position.

    Raises
    ------
    ParameterError
        When a tooth is pointed or cannot be meshed, or corners carry most of a torque.
    ConvergenceError
        When a position finds no equilibrium.
    """
    announce("tooth compliance")
    stiffness = pair_stiffness(modified.pair, body, cache=cache, jobs=jobs)
    announce("loaded contact")
    record = run_cycle(modified, stiffness, cycle, store=store, jobs=jobs, observer=observer)
    return HelicalContact(
        contact_dataset(modified, cycle, record), line_mesh(modified, cycle, record)
    )
