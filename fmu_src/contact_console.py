"""A tooth contact analysis with messages, a progress bar and files."""

from __future__ import annotations

import logging
import os
import time
from pathlib import Path

import xarray as xr
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Table

from drivetrain.contact_figures import save_contact_figures
from gearlube_core.flank_surface.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.tooth_contact.analysis import ContactSettings, analyse_contact
from gearlube_core.tooth_contact.contact_table import contact_table
from gearlube_core.tooth_contact.mesh_cycle import SIDES, CycleProgress

logger = logging.getLogger("gearlube")


def console_contact(
    console: Console,
    *,
    file: HypoidGearFile,
    settings: ContactSettings,
    out: Path,
    jobs: int | None,
) -> Path:
    """Analyse a gear file; write dataset, mesh table and figures to `out`; return the table."""
    began = time.monotonic()
    out.mkdir(parents=True, exist_ok=True)
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    total = len(SIDES) * settings.cycle.positions
    with Progress(*columns, console=console) as bar:
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
        _write(dataset, out / "contact.nc")
        save_contact_figures(dataset, out / "figures")
    console.print(_summary(dataset))
    logger.info("Analysed in %.1f s.", time.monotonic() - began)
    logger.info("Results: %s (mesh table), %s, %s", table, out / "contact.nc", out / "figures")
    return table


def _write(dataset: xr.Dataset, path: Path) -> None:
    partial = path.with_suffix(".part")
    dataset.to_netcdf(partial, engine="scipy", format="NETCDF3_64BIT")
    os.replace(partial, path)


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
