"""Errors of single teeth: from a measured-gear file and a mesh table to a table with them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.report.pictures import save_picture
from gearlube.studies.measured.run import tooth_errors
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_contact.tooth_errors.error_cycle import ToothErrorCycle, tooth_error_cycle
from gearlube_core.hypoid_geometry.measured.measured_flanks import (
    MeasuredFlanks,
    read_measured_flanks,
)
from gearlube_core.mesh_table.netcdf import read_mesh_table, write_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset
from gearlube_core.storage.file_names import pair_stem
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.units import labelled

POSITIONS = 12
STORE = "positions"  # folder of finished positions, in that of the results


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothErrorResults:
    """Results of an analysis of single teeth.

    Parameters
    ----------
    flanks : MeasuredFlanks
    cycle : ToothErrorCycle
    mesh_table : MeshTable
        The given one with the errors.
    """

    flanks: MeasuredFlanks
    cycle: ToothErrorCycle
    mesh_table: MeshTable

    @property
    def dataset(self) -> xr.Dataset:
        """The errors and their orders as arrays, see `tooth_error_dataset`."""
        return tooth_error_dataset(self.cycle, self.flanks.file.name)


def run_tooth_errors(
    path: str | Path,
    table: str | Path,
    *,
    positions: int = POSITIONS,
    body: ToothBodySettings | None = None,
    folder: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> ToothErrorResults:
    """Return a mesh table that includes the measured differences from tooth to tooth.

    These are pitch errors, eccentricity and waves.

    Parameters
    ----------
    path : str or Path
        Measured-gear file with pitch, eccentricity or waves.
    table : str or Path
        Mesh table of the measured flanks, from `gearlube contact`.
    positions : int
        Number of positions in a mesh period; orders are kept up to a quarter of this number times
        the teeth.
    body : ToothBodySettings, optional
        Elastic teeth; default: those of `gearlube contact`.
    folder : Path, optional
        Folder for the mesh table NAME.nc, tooth_errors.nc and tooth_errors.png. Finished positions
        are kept in its folder `positions`: after a stop the same call continues.
    jobs, progress
        As in `run_contact`.

    Raises
    ------
    ParameterError
        A file is wrong, all teeth are equal, or there are too many waves for the positions.
    ConvergenceError
        Errors of single teeth are too large compared with the deflection.

    Examples
    --------
    >>> found = run_tooth_errors(
    ...     "axle_17.toml", "m/contact/axle_17.nc"
    ... )  # doctest: +SKIP
    >>> found.mesh_table.shaft_error["gear"].shape  # doctest: +SKIP
    """
    flanks = read_measured_flanks(path)
    if flanks.errors.is_none:
        raise ParameterError(
            f"{path} must name pitch, waviness or an eccentricity, got none, so all its teeth are "
            "equal. Use the table of `gearlube contact` as it is."
        )
    file, nominal = flanks.gear_file(), read_mesh_table(table).without_shaft_error()
    settings = CycleSettings(positions=positions)
    progress(0.0, "elastic teeth")
    stiffness = pair_stiffness(file, body or ToothBodySettings(), jobs=jobs)
    progress(0.0, "loaded contact of single tooth pairs")
    cycle = tooth_error_cycle(
        file,
        stiffness,
        nominal,
        flanks.errors,
        settings,
        store=None if folder is None else folder / STORE,
        jobs=jobs,
        progress=progress,
    )
    results = ToothErrorResults(flanks=flanks, cycle=cycle, mesh_table=cycle.added_to(nominal))
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        write_mesh_table(results.mesh_table, folder / f"{pair_stem(file.name)}.nc")
        write_dataset(results.dataset, folder / "tooth_errors.nc")
        save_picture(tooth_errors(cycle, file.name), folder / "tooth_errors.png")
    return results


def tooth_error_dataset(cycle: ToothErrorCycle, name: str = "") -> xr.Dataset:
    """Return the added transmission error over the hunting turn, and its orders, as a dataset."""
    data = {
        "error": labelled(
            ("torque", "mesh", "phase"), cycle.error, "m", "added transmission error, the gear lags"
        ),
        "rest_rms": labelled(
            ("torque",), cycle.turns()[1], "m", "part that repeats with the hunting turn alone, rms"
        ),
    }
    for member, orders in cycle.orders().items():
        data[f"{member}_amplitude"] = (
            ("torque", f"{member}_order"),
            np.hypot(orders[..., 0], orders[..., 1]),
            {"units": "m", "long_name": f"amplitude by order of the {member}'s turn"},
        )
    hunting, amplitudes = cycle.hunting_orders()
    data["hunting_amplitude"] = (
        ("torque", "hunting_order"),
        amplitudes,
        {"units": "m", "long_name": "largest orders of the hunting turn alone, not in the table"},
    )
    coords = {
        "hunting_order": ("hunting_order", hunting, {"units": "1", "long_name": "pinion's turn"}),
        "torque": ("torque", cycle.torque, {"units": "N.m", "long_name": "pinion torque"}),
        "phase": ("phase", cycle.phases, {"units": "1", "long_name": "mesh phase"}),
        **{
            f"{member}_order": np.arange(1, orders.shape[1] + 1)
            for member, orders in cycle.orders().items()
        },
    }
    attributes = {"name": name, "pinion_teeth": cycle.pinion_teeth, "gear_teeth": cycle.gear_teeth}
    return xr.Dataset(data, coords=coords, attrs=attributes)
