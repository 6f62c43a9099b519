"""The commands `gearlube film-model train`, `fit`, `show` and `audit`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.exit_codes import exit_if_failed, exit_on_error
from gearlube.cli.options import JobsOption, OverwriteOption

logger = logging.getLogger("gearlube")

film_model = typer.Typer(
    name="film-model",
    help="Train, fit, show and audit surrogates of solved thermal films: hypoid flanks, lines, "
    "rollers.",
    no_args_is_help=True,
)

_FolderArgument = Annotated[
    Path, typer.Argument(help="Folder of `gearlube film-model train`.", metavar="FOLDER")
]
_ModelArgument = Annotated[
    str, typer.Argument(help="Film model (.json) or the name of a shipped one.", metavar="MODEL")
]


@film_model.command()
def train(
    contact: Annotated[
        str,
        typer.Option(
            help="flank: ellipses of a hypoid axle; line: lines of helical and spur pairs; "
            "roller: rollers on the races of bearings.",
            metavar="KIND",
        ),
    ] = "flank",
    oil: Annotated[
        list[str] | None,
        typer.Option(
            help="Shipped oil or oil file (TOML) that the gears run in; may be given again. "
            "Default: all shipped ones.",
            metavar="OIL",
        ),
    ] = None,
    mesh_table: Annotated[
        str, typer.Option(help="Shipped mesh table of the axle, for flanks.", metavar="TABLE")
    ] = "mohammadpour_2015",
    box: Annotated[int, typer.Option(help="Contacts of the box of groups.", metavar="N")] = 760,
    visited: Annotated[
        int, typer.Option(help="Contacts that axle, helical pairs or bearings visit.", metavar="N")
    ] = 300,
    edge: Annotated[
        int, typer.Option(help="More contacts of the box with thick films.", metavar="N")
    ] = 160,
    calibration: Annotated[
        int, typer.Option(help="Independent contacts of the box, for the bounds.", metavar="N")
    ] = 250,
    fresh: Annotated[
        int, typer.Option(help="Independent visited contacts, for the test.", metavar="N")
    ] = 304,
    fine: Annotated[
        int,
        typer.Option(help="Contacts of the box that a second grid solves as well.", metavar="N"),
    ] = 60,
    seed: Annotated[int, typer.Option(help="Random seed of all draws.")] = 20,
    jobs: JobsOption = None,
    scheduler: Annotated[
        str | None,
        typer.Option(help="Dask scheduler whose workers solve the films.", metavar="ADDRESS"),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder of the films.")] = Path("gearlube_film_model"),
    overwrite: OverwriteOption = False,
) -> None:
    """Solve the films that a model learns from: a second of a processor each, lines a fifth.

    Writes solves.csv, one row a film; a film that fails keeps its reason. A stopped run goes on
    when the same command runs again.
    """
    from gearlube.cli.results_folder import results_folder
    from gearlube.cli.study_run import progress_on
    from gearlube.studies.film_model.model_lines import limits_of
    from gearlube.studies.film_model.plan import FilmPlan
    from gearlube.studies.film_model.solves import failures_in_words, pool_of, train

    with exit_on_error():
        plan = FilmPlan(
            contact=contact,
            oils=tuple(oil) if oil else FilmPlan().oils,
            mesh_table=mesh_table,
            box=box,
            visited=visited,
            edge=edge,
            calibration=calibration,
            fresh=fresh,
            fine_box=fine,
            fine_visited=min(visited, fine // 2),
            fine_edge=min(edge, fine // 3),
            fine_fresh=min(fresh, fine // 3),
            seed=seed,
        )
        with (
            results_folder(out, "film-model", overwrite=overwrite),
            progress_on("films") as progress,
        ):
            table = train(plan, out, pool=pool_of(jobs, scheduler), progress=progress)
        for line in (*failures_in_words(table), *limits_of(table)):
            logger.info("%s", line)
        lost = plan.solves - len(table.rows)
        exit_if_failed(f"{lost} films are lost. Run the same command again." if lost else "")
        logger.info("Films: %s. Now `gearlube film-model fit %s`.", out / "solves.csv", out)


@film_model.command()
def fit(
    folder: _FolderArgument = Path("gearlube_film_model"),
    points: Annotated[
        int, typer.Option(help="Points that the net learns from.", metavar="N")
    ] = 8000,
    steps: Annotated[int, typer.Option(help="Most steps of the net's fit.", metavar="N")] = 150,
    start: Annotated[
        str | None,
        typer.Option(
            help="Go on from the net of this model of the same oils: fewer steps do.",
            metavar="MODEL",
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="File for the model (.json).")] = Path(
        "film_model.json"
    ),
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace an existing OUT file.")
    ] = False,
) -> None:
    """Fit a model to solved films: processes, net, bounds, test. Some minutes."""
    from gearlube.cli.study_run import progress_on
    from gearlube.studies.film_model.calibration import tests_table
    from gearlube.studies.film_model.fit import FitSettings, fit_model
    from gearlube.studies.film_model.model_lines import model_lines
    from gearlube.studies.film_model.solves import SOLVES, SolveTable, stored_plan
    from gearlube_core.errors import ParameterError
    from gearlube_core.film_model.model import FilmModel
    from gearlube_core.storage.atomic_file import write_text

    with exit_on_error("Stopped; nothing was written."):
        if out.suffix != ".json":
            raise ParameterError(f"--out must be a file whose name ends in .json, got {out}.")
        if out.exists() and not overwrite:
            raise ParameterError(f"--out must be a new file, got {out}. Add --overwrite.")
        plan = stored_plan(folder)
        rows = list(SolveTable(folder / SOLVES, plan.kind).rows.values())
        with progress_on("fit") as progress:
            fitted = fit_model(
                rows,
                plan,
                FitSettings(points=points, steps=steps),
                name=out.stem,
                start=None if start is None else FilmModel.named(start),
                progress=progress,
            )
        fitted.model.write(out)
        tests = out.with_name(f"{out.stem}_tests.csv")
        write_text(tests_table(fitted.predicted, fitted.solved), tests)
        for line in model_lines(fitted.model):
            typer.echo(line)
        logger.info("Model: %s; tests: %s", out, tests)


@film_model.command()
def show(model: _ModelArgument = "hypoid_flank") -> None:
    """Print where a model comes from, its domain, its bounds and its errors."""
    from gearlube.studies.film_model.model_lines import model_lines
    from gearlube_core.film_model.model import FilmModel

    with exit_on_error():
        for line in model_lines(FilmModel.named(model)):
            typer.echo(line)


@film_model.command()
def audit(
    run: Annotated[
        Path,
        typer.Argument(
            help="Folder of `gearlube map` or `gearlube cycle`, or a CSV file with "
            "pinion_speed_rpm, pinion_torque_n_m and oil_temperature_degc.",
            metavar="RUN",
        ),
    ],
    model: Annotated[
        str | None,
        typer.Option(
            help="Film model (.json) or the name of a shipped one. Default: that of the axle.",
            metavar="MODEL",
        ),
    ] = None,
    axle: Annotated[
        str,
        typer.Option(help="Axle of the run: file (TOML) or the name of a shipped one."),
    ] = "mohammadpour_2015",
    count: Annotated[
        int, typer.Option(help="Contacts drawn from the run, 20 to 10000.", metavar="N")
    ] = 100,
    eyring_stress: Annotated[
        float | None,
        typer.Option(help="Eyring stress [MPa]. Default: that of the axle's oil.", metavar="MPA"),
    ] = None,
    seed: Annotated[int, typer.Option(help="Random seed of the draws.")] = 1,
    out: Annotated[Path | None, typer.Option(help="Write the contacts to this CSV file.")] = None,
) -> None:
    """Solve contacts again that a run has visited, on the full grid, and judge the bounds.

    About 4 s a contact. Exit code 1 where the bounds do not hold.
    """
    from drivetrain.axle_file.read_axle import read_axle
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.cli.exit_codes import exit_if_failed
    from gearlube.cli.study_run import progress_on
    from gearlube.studies.film_model import audit as audits
    from gearlube.studies.film_model.audit import visited_contacts, visited_points
    from gearlube_core.checks import check_within
    from gearlube_core.film_model.chosen_model import chosen_model
    from gearlube_core.film_model.model import FLANK, shipped_model
    from gearlube_core.storage.atomic_file import write_text

    with exit_on_error("Stopped; nothing was written."):
        check_within("--count", count, 20, 10_000)
        if eyring_stress is not None:
            check_within("--eyring-stress", eyring_stress, 0.01, 1000.0, "MPa")
        given = None if model is None else chosen_model(model, FLANK, "--model")
        points = visited_points(run)
        bring_gears_up_to_date(axle)
        of_run = read_axle(axle).axle
        judged = given or of_run.flank_film_model or shipped_model(FLANK)
        contacts = visited_contacts(
            points,
            of_run,
            count,
            seed,
            None if eyring_stress is None else (1e6 * eyring_stress, 0.0),
        )
        with progress_on("audit") as progress:
            found = audits.audit(judged, contacts, progress=progress)
        for line in audits.audit_lines(found):
            typer.echo(line)
        if out is not None:
            write_text(audits.audit_table(found), out)
            logger.info("Contacts: %s", out)
        exit_if_failed("" if found.holds else "The bounds do not hold for this run.")
