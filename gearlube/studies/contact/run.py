"""Analyse the tooth contact of a hypoid pair: from a gear file to a dataset and a mesh table."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import xarray as xr

from gearlube.studies.contact.figures import save_contact_figures
from gearlube.studies.contact.report import write_contact_report
from gearlube_core.hypoid_contact.analysis import ContactSettings, analyse_contact
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset
from gearlube_core.storage.file_names import pair_stem

POSITIONS = "positions"  # folder of finished positions, in that of the results


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactResults:
    """Results of a tooth contact analysis.

    Parameters
    ----------
    contact : xarray.Dataset
        Unloaded and loaded contact on both sides, see `contact_dataset`.
    mesh_table : MeshTable
        The same as the dynamics read it.
    """

    contact: xr.Dataset
    mesh_table: MeshTable


def run_contact(
    file: HypoidGearFile,
    settings: ContactSettings,
    *,
    folder: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
    command_line: str = "",
) -> ContactResults:
    """Return the tooth contact of a hypoid gear file, without and under load, and its mesh table.

    Parameters
    ----------
    file : HypoidGearFile
    settings : ContactSettings
    folder : Path, optional
        Folder for contact.nc, report.html, figures/ and the mesh table NAME.nc. Finished positions
        are kept in its folder `positions`: after a stop the same call continues.
    jobs : int, optional
        Number of processes; default: all processors.
    progress : callable, optional
        Called with the share of positions that is done [-] and a sentence on what runs.
    command_line : str
        Command that the report shows.

    Raises
    ------
    ParameterError
        A flank is missing or the flanks do not meet.
    ConvergenceError
        A position finds no equilibrium.
    TableError
        At some torque more tooth pairs carry load than a mesh table can hold. All other results are
        written before.

    Examples
    --------
    >>> from gearlube.studies.contact.settings import QUICK
    >>> found = run_contact(HypoidGearFile.named("mohammadpour_2015"), QUICK)  # doctest: +SKIP
    >>> float(found.contact["k_m"].sel(side="drive", torque=50.0).mean())  # doctest: +SKIP
    """
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    store = None if folder is None else folder / POSITIONS
    dataset = analyse_contact(file, settings, store=store, jobs=jobs, progress=progress)
    if folder is not None:
        progress(1.0, "writing report and figures")
        write_dataset(dataset, folder / "contact.nc")
        save_contact_figures(dataset, folder / "figures")
        write_contact_report(dataset, folder, command_line)
    results = ContactResults(contact=dataset, mesh_table=contact_table(file, dataset))
    if folder is not None:
        write_mesh_table(results.mesh_table, folder / f"{pair_stem(file.name)}.nc")
    return results
