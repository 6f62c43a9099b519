"""The command `gearlube vary`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from gearlube.cli.exit_codes import exit_if_failed
from gearlube.cli.options import JobsOption, OverwriteOption

if TYPE_CHECKING:
    from gearlube.variation.point_study import PointStudy

logger = logging.getLogger("gearlube")

Study = Literal["map", "sweep", "whine", "cycle", "bearing", "helical", "contact", "resonance"]


def vary(
    study: Annotated[
        Study,
        typer.Argument(
            help="map, sweep, whine, cycle, bearing, helical, contact or resonance.",
            metavar="STUDY",
        ),
    ],
    file: Annotated[
        str | None,
        typer.Argument(
            help="Axle file (TOML) or the name of a shipped one; for bearing, helical and contact "
            "a bearing or gear file, for resonance a mesh table. Default: the shipped one.",
            metavar="FILE",
        ),
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            "--vary",
            help="Any parameter: KEY=first:last:step or KEY=a,b,c, all combined; KEY=low:high is "
            "sampled by --design, KEY=value+-width likewise, normal. --keys lists them.",
            metavar="KEY=VALUES...",
        ),
    ] = None,
    design: Annotated[
        str | None,
        typer.Option(
            help="lhs:200, sobol:256 or random:200 samples. Default with --scatter: lhs:1000.",
            metavar="METHOD:COUNT",
        ),
    ] = None,
    scatter: Annotated[
        bool,
        typer.Option("--scatter", help="Sample the [tolerances] of the file as well."),
    ] = False,
    tolerances: Annotated[
        Path | None,
        typer.Option(
            help="Sample the [tolerances] of this file as well, of any parameter in --keys.",
            metavar="FILE",
        ),
    ] = None,
    parts: Annotated[
        int | None,
        typer.Option(
            help="Predict this number of parts by a model trained on the points, and check it.",
            metavar="N",
        ),
    ] = None,
    seed: Annotated[int, typer.Option(help="Random seed of the samples.")] = 1,
    limit: Annotated[
        list[str] | None,
        typer.Option(
            help="Report the share of points above a limit: QUANTITY=VALUE, in the unit of --keys.",
            metavar="QUANTITY=VALUE...",
        ),
    ] = None,
    jobs: JobsOption = None,
    scheduler: Annotated[
        str | None,
        typer.Option(help="Address of a running Dask scheduler instead of local processes."),
    ] = None,
    block: Annotated[
        int | None,
        typer.Option(
            help="Points in one block; a block is computed and saved as a "
            "whole. Default: some seconds of work.",
            metavar="N",
        ),
    ] = None,
    quick: Annotated[
        bool,
        typer.Option(
            "--quick",
            help="Coarse settings for a first look (sweep, whine, helical, contact, resonance).",
        ),
    ] = False,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_vary"),
    overwrite: OverwriteOption = False,
    keys: Annotated[
        bool,
        typer.Option("--keys", help="List the parameters and the computed quantities, and stop."),
    ] = False,
) -> None:
    """Vary any parameter of an axle, bearing or gear pair in a study: a grid, or samples.

    Writes results.zarr, points.csv, summary.csv, sensitivity.csv, report.html and figures. Finished
    blocks of points are kept: run the same command again to go on after a stop.
    """
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.cli.study_run import study_run
    from gearlube.variation.design import Design
    from gearlube.variation.figures import save_variation_figures
    from gearlube.variation.file_variants import GEAR_FILE
    from gearlube.variation.parts import check_parts, scattered_parts
    from gearlube.variation.parts_report import save_parts
    from gearlube.variation.point_study import OF_AXLE, point_study, prepared
    from gearlube.variation.point_study import scatter as scatter_of_study
    from gearlube.variation.report import variation_report
    from gearlube.variation.run import MOST_BLOCK, run_variation
    from gearlube.variation.scatter import spreads_in
    from gearlube.variation.summary import write_summary
    from gearlube.variation.vary_option import (
        SCATTER_DESIGN,
        limits_from,
        sampling_from,
        varied_from,
    )
    from gearlube_core.checks import check_address, check_within

    with study_run(f"vary {study}", out, overwrite=overwrite) as run:
        if study in OF_AXLE:
            bring_gears_up_to_date(file, jobs=jobs)
        chosen = point_study(study, file, quick=quick)
        if keys:
            typer.echo(_listed(chosen), nl=False)
            return
        given = varied_from(vary or [], chosen.keys)
        for axis in given.axes:
            note = chosen.keys[axis.key].note
            if note is not None and (warning := note.warning(axis.values)):
                logger.warning("--vary: %s", warning)
        limits = limits_from(limit or [], [one.name for one in chosen.quantities])
        if block is not None:
            check_within("--block", block, 1, MOST_BLOCK, "", "Leave it out for the default.")
        if scheduler is not None:
            check_address(scheduler)
        spreads = given.spreads
        if scatter or tolerances is not None:
            typed = {axis.key for axis in given.axes} | {one.key for one in spreads}
            inside = scatter_of_study(chosen) if scatter else ()
            own = () if tolerances is None else spreads_in(tolerances, chosen)
            of_files = {one.key: one for one in (*inside, *own)}.values()
            spreads = (*spreads, *(one for one in of_files if one.key not in typed))
            design = SCATTER_DESIGN if design is None else design
        plan = Design(axes=given.axes, spreads=spreads, sampling=sampling_from(design, seed))
        if parts is not None:
            check_parts(plan, parts)
        gears = [str(one) for axis in given.axes if axis.key == GEAR_FILE for one in axis.values]
        bring_gears_up_to_date(file if gears else None, gears, jobs=jobs)
        chosen = prepared(chosen, plan)
        logger.info("%d points: %s.", plan.size, ", ".join(plan.keys))
        with run.results(plan.size, bar="points") as progress:
            done = run_variation(
                chosen,
                plan,
                out=out,
                jobs=jobs,
                scheduler=scheduler,
                block=block,
                overwrite=overwrite,
                progress=progress,
            )
            results, summary = write_summary(out, limits)
            save_variation_figures(results, summary, out / "figures")
            report = variation_report(results, summary)
            if parts is not None:
                many = scattered_parts(results, plan, parts=parts, limits=limits, seed=seed)
                report = save_parts(results, many, report, out)
        logger.info("%d points computed.", done.computed)
        if done.lost:
            logger.warning(
                "%d points are lost to memory, disk or program, not to physics. Run the same "
                "command again to compute them.",
                done.lost,
            )
        run.written(done.store.path.name, "summary.csv", "figures")
        run.finish(report)
        failures = int(summary["failed"].sum())
        exit_if_failed(f"{failures} points failed; points.csv says why." if failures else "")


def _listed(study: PointStudy) -> str:
    """Return all inputs and results, one a line."""
    lines = ["Parameters (--vary):"]
    for key in study.keys.values():
        usual = "" if key.usual is None else f"; usually {key.usual}"
        lines.append(f"  {key.name:44} {key.unit or '-':10} {key.kind}; {key.meaning}{usual}")
    lines.append("Quantities:")
    lines += [f"  {one.name:44} {one.unit or '-':10} {one.meaning}" for one in study.quantities]
    return "\n".join(lines) + "\n"
