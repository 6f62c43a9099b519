"""The command `gearlube measured`."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from gearlube.cli.exit_codes import exit_on_error
from gearlube.cli.options import JobsOption, OverwriteOption
from gearlube.cli.results_folder import results_folder
from gearlube.cli.study_run import StudyRun, empty_table, study_run
from gearlube.output.csv_text import csv_text
from gearlube_core.errors import ParameterError
from gearlube_core.storage.file_names import pair_stem

if TYPE_CHECKING:
    from gearlube.studies.measured.teeth import ToothErrorResults
    from gearlube_core.hypoid_contact.settings_fit import SettingsFit
    from gearlube_core.hypoid_geometry.measured.measured_flanks import MeasuredFlanks

FILE = "settings.csv"
HEAD = ("field", "unit", "nominal", "cut_with_more", "uncertainty", "corrective")
logger = logging.getLogger("gearlube")
_SHOWN = 4  # orders of a member in a row


def fitted_settings(
    flanks: MeasuredFlanks, fields: Sequence[str], folder: Path | None = None
) -> list[SettingsFit]:
    """Return the fit of settings for each member that fields name.

    Parameters
    ----------
    flanks : MeasuredFlanks
    fields : sequence of str
        Dotted fields of the gear file, see `fit_settings`.
    folder : Path, optional
        Gets settings.csv.

    Raises
    ------
    ParameterError
        No flank of a member was measured, or a field cannot be fitted.
    """
    from gearlube_core.hypoid_contact.settings_fit import fit_settings
    from gearlube_core.storage.atomic_file import write_text

    members = dict.fromkeys(field.partition(".")[0] for field in fields)
    found = []
    for role in members:
        grids = [grid for (whose, _), grid in flanks.grids.items() if whose == role]
        if not grids:
            measured = ", ".join(grid.name for grid in flanks.grids.values()) or "none"
            raise ParameterError(
                f"settings of {role!r} can be fitted only if its flanks were measured; measured "
                f"flanks: {measured}. Fit fields of a member whose deviations are in the file."
            )
        own = [field for field in fields if field.partition(".")[0] == role]
        found.append(fit_settings(flanks.nominal, grids, own))
    if folder is not None:
        write_text(csv_text(HEAD, [row for fit in found for row in rows(fit)]), folder / FILE)
    return found


def rows(fit: SettingsFit) -> list[tuple[str, ...]]:
    """Return the rows of a fit under `HEAD`, as text."""
    numbers = zip(fit.nominal, fit.change, fit.uncertainty, fit.corrective, strict=True)
    return [
        (field, unit, f"{a:.6g}", f"{b:.4g}", f"{c:.2g}", f"{d:.6g}")
        for field, unit, (a, b, c, d) in zip(fit.fields, fit.units, numbers, strict=True)
    ]


def _write_example(folder: Path | None) -> None:
    """Write the example and stop; needs no other argument."""
    if folder is None:
        return
    from gearlube_core.hypoid_geometry.measured.measured_flanks import write_example

    with exit_on_error():
        written = write_example(folder)
    logger.info("Written: %s", ", ".join(str(path) for path in written))
    logger.info("Next: gearlube measured %s", written[0])
    raise typer.Exit


def measured(
    file: Annotated[
        str,
        typer.Argument(help="Measured-gear file (TOML), its CSV files beside it.", metavar="FILE"),
    ],
    table: Annotated[
        str | None,
        typer.Option(
            help="Mesh table that `gearlube contact` made of the gear file: add to it what single "
            "teeth do (pitch, eccentricity, waves).",
            metavar="TABLE",
        ),
    ] = None,
    positions: Annotated[
        int, typer.Option(help="With --table: positions over a mesh period.", metavar="N")
    ] = 12,
    fit: Annotated[
        list[str] | None,
        typer.Option(
            help="Setting with which the flanks may have been cut, as "
            "pinion.machine.tilt_angle_deg; repeat for more. Writes settings.csv, with corrective "
            "settings.",
            metavar="FIELD",
        ),
    ] = None,
    jobs: JobsOption = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_measured"),
    overwrite: OverwriteOption = False,
    example: Annotated[
        Path | None,
        typer.Option(
            help="Write an example into this folder, a measured-gear file and its CSV files, and "
            "stop.",
            metavar="DIR",
            callback=_write_example,
            is_eager=True,
        ),
    ] = None,
) -> None:
    """Lay measured flanks on a hypoid pair; write its gear file and report.html.

    With --fit: settings that explain the deviations, and corrective ones.
    With --table: the mesh table with the errors of single teeth, tooth_errors.nc and a figure.
    Finished positions are kept in OUT: run the same command again to go on after a stop.
    """
    from gearlube.studies.measured.report import flank_report
    from gearlube.studies.measured.run import flank_dataset, run_measured
    from gearlube_core.storage.atomic_file import write_dataset

    with study_run("measured", out, overwrite=overwrite) as frame:
        if table is not None:
            _teeth(file, table, positions, frame, jobs)
            return
        with results_folder(out, "measured", overwrite=overwrite):
            flanks = run_measured(file, folder=out)
            fits = _fits(flanks, fit or [], out)
            dataset = flank_dataset(flanks, fits)
            write_dataset(dataset, out / "flanks.nc")
        frame.show(_table(flanks))
        for one in fits:
            frame.show(_settings(flanks.file.name, one))
        gear = out / f"{pair_stem(flanks.file.name)}.toml"
        frame.written(gear.name, "flanks.nc", note=" (gear file)")
        frame.finish(flank_report(dataset, out / "flanks.png"))
        logger.info("Next: gearlube contact %s --out %s", gear, out / "contact")


def _fits(flanks: MeasuredFlanks, fields: list[str], out: Path) -> list[SettingsFit]:

    return fitted_settings(flanks, fields, out) if fields else []


def _settings(name: str, fit: SettingsFit) -> Table:

    title = f"{name}: {1e6 * fit.before:.2f} µm rms, with other settings {1e6 * fit.after:.2f} µm"
    table = Table(title=title)
    table.add_column("setting", overflow="fold")
    for heading in ("unit", "nominal", "cut with more by", "uncertain by", "corrective"):
        table.add_column(heading, justify="right")
    for row in rows(fit):
        table.add_row(*row)
    return table


def _teeth(file: str, table: str, positions: int, frame: StudyRun, jobs: int | None) -> None:
    from gearlube.studies.measured.report import tooth_report
    from gearlube.studies.measured.teeth import run_tooth_errors

    with frame.results(2 * positions) as progress:
        found = run_tooth_errors(
            file, table, positions=positions, folder=frame.out, jobs=jobs, progress=progress
        )
    frame.show(_orders(found))
    mesh = f"{pair_stem(found.flanks.file.name)}.nc"
    frame.written(mesh, "tooth_errors.png", note=" (mesh table)")
    frame.finish(tooth_report(found.dataset, frame.out / "tooth_errors.png"))
    logger.info("Next: gearlube sweep --mesh-table %s", frame.out / mesh)


def _orders(found: ToothErrorResults) -> Table:
    import numpy as np

    cycle, rest = found.cycle, found.cycle.turns()[1]
    orders = cycle.orders()
    table = empty_table(
        f"{found.flanks.file.name}: largest orders, amplitude in µm",
        *(">torque [N·m]", *(f"of the {one}" for one in orders), ">hunting turn alone, rms [µm]"),
    )
    for level, torque in enumerate(cycle.torque):
        row = []
        for values in orders.values():
            amplitude = 1e6 * np.hypot(*values[level].T)
            largest = np.argsort(amplitude)[::-1][:_SHOWN]
            row.append(", ".join(f"{k + 1}: {amplitude[k]:.2f}" for k in largest))
        table.add_row(f"{torque:g}", *row, f"{1e6 * rest[level]:.2f}")
    return table


def _table(flanks: MeasuredFlanks) -> Table:
    table = empty_table(
        f"{flanks.file.name}: smooth surface of degree {flanks.file.degree}",
        *("flank", ">teeth", ">points", ">largest [µm]", ">rest rms [µm]", ">teeth apart rms [µm]"),
    )
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
