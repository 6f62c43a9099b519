"""Analyses and axle runs of gear files, kept in a folder so that an interrupted study goes on."""

from __future__ import annotations

import hashlib
import logging
from dataclasses import asdict
from pathlib import Path

import numpy as np
import xarray as xr

from fmu_src.build import build_hypoid_axle
from gearlube.studies.sweep.run import SweepModel, run_sweep
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core import __version__
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.storage.atomic_file import write_dataset

logger = logging.getLogger(__name__)

SPEEDS_KMH = (60.0, 100.0)
PRELOAD = 2500.0


def analysed(work: Path, name: str, file: HypoidGearFile, settings: ContactSettings) -> xr.Dataset:
    """Return the tooth contact of a gear file, from the folder where it is known."""
    path = work / "analyses" / f"{name}-{_key(file, settings)}.nc"
    if not path.is_file():
        logger.info("analysing %s", name)
        dataset = analyse_contact(file, settings, store=work / "positions")
        path.parent.mkdir(parents=True, exist_ok=True)
        write_dataset(dataset, path)
    return xr.load_dataset(path, engine="scipy")


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


def _key(file: HypoidGearFile, settings: ContactSettings) -> str:
    digest = hashlib.sha256(__version__.encode())
    digest.update(file.model_dump_json().encode())
    digest.update(repr(asdict(settings)).encode())
    return digest.hexdigest()[:12]
