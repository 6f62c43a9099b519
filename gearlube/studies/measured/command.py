"""The command `gearlube measured`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from gearlube.cli.console import console
from gearlube.cli.exit_codes import exit_on_error
from gearlube.cli.options import OverwriteOption
from gearlube.cli.results_folder import results_folder

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube_core.hypoid_geometry.measured.measured_flanks import MeasuredFlanks

logger = logging.getLogger("gearlube")


def measured(
    file: Annotated[
        str,
        typer.Argument(help="Measured-gear file (TOML), its CSV files beside it.", metavar="FILE"),
    ],
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_measured"),
    overwrite: OverwriteOption = False,
) -> None:
    """Lay measured flanks on a hypoid pair; write its gear file for `gearlube contact`."""
    from gearlube.studies.measured.run import run_measured

    with exit_on_error():
        with results_folder(out, "measured", overwrite=overwrite):
            flanks = run_measured(file, folder=out)
        console.print(_table(flanks))
        gear = out / f"{flanks.file.name}.toml"
        logger.info("Results: %s (gear file), %s", gear, out / "flanks.png")
        logger.info("Next: gearlube contact %s --out %s", gear, out / "contact")


def _table(flanks: MeasuredFlanks) -> Table:
    table = Table(title=f"{flanks.file.name}: smooth surface of degree {flanks.file.degree}")
    table.add_column("flank")
    for heading in ("teeth", "points", "largest [µm]", "rest rms [µm]", "teeth apart rms [µm]"):
        table.add_column(heading, justify="right")
    for key, grid in flanks.grids.items():
        surface, mean = flanks.surfaces[key], grid.deviation.mean(axis=0)
        table.add_row(
            grid.name,
            str(len(grid.teeth)),
            f"{mean.shape[0]} x {mean.shape[1]}",
            f"{1e6 * max(mean.min(), mean.max(), key=abs):.1f}",
            f"{1e6 * surface.residual_rms:.2f}",
            f"{1e6 * surface.scatter_rms:.2f}",
        )
    return table
