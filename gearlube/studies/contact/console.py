"""A tooth contact analysis with messages, a progress bar and files."""

from __future__ import annotations

import logging
import time
from pathlib import Path

import xarray as xr
from rich.console import Console
from rich.table import Table

from gearlube.cli.progress_bar import progress_bar
from gearlube.studies.contact.figures import save_contact_figures
from gearlube_core.hypoid_contact.analysis import (
    ContactSettings,
    analyse_contact,
    check_settings_meet,
)
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_contact.mesh_cycle import SIDES, CycleProgress
from gearlube_core.hypoid_geometry.flank.export import write_flank_csv, write_solid
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role
from gearlube_core.hypoid_geometry.flank.setting_check import setting_report
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form
from gearlube_core.hypoid_geometry.flank.tooth_solid import gear_solid, tooth_solid
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.storage.atomic_file import write_dataset

logger = logging.getLogger("gearlube")
ROLES: tuple[Role, Role] = ("pinion", "gear")


def console_contact(
    console: Console,
    *,
    file: HypoidGearFile,
    settings: ContactSettings,
    out: Path,
    jobs: int | None,
    export: bool,
) -> Path:
    """Analyse a gear file; write dataset, mesh table and figures to `out`; return the table."""
    began = time.monotonic()
    out.mkdir(parents=True, exist_ok=True)
    check_settings_meet(file)
    for sentence in _doubts(file):
        logger.warning("%s", sentence)
    total = len(SIDES) * settings.cycle.positions
    with progress_bar(console) as bar:
        task = bar.add_task("contact", total=total)

        def observe(progress: CycleProgress) -> None:
            where = f"{progress.side} flanks, mesh phase {progress.phase:.2f}"
            bar.update(task, completed=progress.done, description=where)

        dataset = analyse_contact(
            file,
            settings,
            store=out / "positions",
            jobs=jobs,
            announce=lambda text: bar.update(task, description=text),
            observer=observe,
        )
        bar.update(task, completed=total, description="figures")
        table = write_mesh_table(contact_table(file, dataset), out / f"{file.name}.nc")
        write_dataset(dataset, out / "contact.nc")
        save_contact_figures(dataset, out / "figures")
        if export:
            bar.update(task, description="gears")
            write_gears(file, out / "gears")
    console.print(_summary(dataset))
    logger.info("Analysed in %.1f s.", time.monotonic() - began)
    logger.info("Results: %s (mesh table), %s, %s", table, out / "contact.nc", out / "figures")
    return table


def write_gears(file: HypoidGearFile, folder: Path) -> list[Path]:
    """Write each flank as CSV, each tooth and gear as STL and GLB; return the files."""
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for role in ROLES:
        tooth = Tooth.from_file(file, role)
        files += [
            write_flank_csv(Flank.from_file(file, role, side), folder / f"{role}_{side}.csv")
            for side in SIDES
        ]
        for suffix in ("stl", "glb"):
            files.append(write_solid(tooth_solid(tooth), folder / f"{role}_tooth.{suffix}"))
            files.append(write_solid(gear_solid(tooth), folder / f"{role}.{suffix}"))
    return files


def _doubts(file: HypoidGearFile) -> list[str]:
    """Return what is unsound about the settings and the teeth, one sentence each."""
    return setting_report(file) + [
        line for role in ROLES for line in tooth_form(file, role).report()
    ]


def _summary(dataset: xr.Dataset) -> Table:
    table = Table(title=f"{dataset.attrs['name']}: loaded tooth contact, means over the mesh")
    for heading in (
        "flanks",
        "torque [N·m]",
        "secant k [N/µm]",
        "tangent k [N/µm]",
        "R_p [mm]",
        "pairs",
        "highest pressure [GPa]",
    ):
        table.add_column(heading, justify="right")
    for side in SIDES:
        for torque in dataset["torque"].values:
            state = dataset.sel(side=side, torque=torque)
            table.add_row(
                side,
                f"{torque:g}",
                f"{1e-6 * float(state['k_m'].mean()):.0f}",
                f"{1e-6 * float(state['k_t'].mean()):.0f}",
                f"{1e3 * float(state['R_p'].mean()):.2f}",
                f"{float((state['share'] > 1e-3).sum('pair').mean()):.2f}",
                f"{1e-9 * float(state['pressure_max'].max()):.2f}",
            )
    return table
