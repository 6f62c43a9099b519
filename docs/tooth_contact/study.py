"""Axle runs of gear files, and finer grids and other bodies for their analyses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr

from fmu_src.build import build_hypoid_axle
from gearlube.studies.sweep.run import SweepModel, run_sweep
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity

POSITIONS = 6
TORQUES = (50.0, 200.0)
_HALF_AGAIN = MeshDensity(
    profile=18, lengthwise=36, thickness=6, growth=1.6 ** (2.0 / 3.0), fillet=8, slot=2, rim=5
)


def _settings(
    body: ToothBodySettings | None = None, loaded: LoadedSettings | None = None
) -> ContactSettings:
    cycle = CycleSettings(positions=POSITIONS, torques=TORQUES, loaded=loaded or LoadedSettings())
    return ContactSettings(cycle=cycle, body=body or ToothBodySettings())


def refinements() -> dict[str, ContactSettings]:
    """Return numerical settings in the order of the table: the default, finer, other bodies."""
    fine_hats = CondensationSettings(profile_hats=10, lengthwise_hats=19, density=_HALF_AGAIN)
    fine_cells = LoadedSettings(strips=StripSettings(cells_across=64, cells_along=96))
    fine_elements = CondensationSettings(density=_HALF_AGAIN)
    return {
        "default": _settings(),
        "cells": _settings(loaded=fine_cells),
        "elements": _settings(ToothBodySettings(condensation=fine_elements)),
        "hats": _settings(ToothBodySettings(condensation=fine_hats)),
        "base_2": _settings(ToothBodySettings(base_depth_modules=2.0)),
        "base_4": _settings(ToothBodySettings(base_depth_modules=4.0)),
        "rim_0.5": _settings(ToothBodySettings(neighbour_pitches=0.5)),
        "rim_1.5": _settings(ToothBodySettings(neighbour_pitches=1.5)),
    }


SPEEDS_KMH = (60.0, 100.0)
PRELOAD = 2500.0


def axle_sweep(work: Path, name: str, file: HypoidGearFile, dataset: xr.Dataset) -> xr.Dataset:
    """Return the axle at road load with the mesh table of a dataset, over speed.

    HypoidAxle.fmu with this table, bearing preload 2500 N, slow speed hold.
    """
    folder = work / "axle" / name
    table = write_mesh_table(contact_table(file, dataset), folder / "mesh_table.nc")
    fmu = build_hypoid_axle(folder, table)
    sweep = run_sweep(
        SweepSettings(driver="hold"),
        speeds_kmh=SPEEDS_KMH,
        preloads=[PRELOAD],
        fmu=fmu,
        out=folder / "sweep",
        model=SweepModel(natural_frequencies=None),
    )
    failed = np.flatnonzero(sweep["status"].values.ravel() != 1)
    if failed.size:
        raise SystemExit(f"{name}: {failed.size} speeds failed; see {folder / 'sweep'}")
    return sweep.isel(preload=0)
