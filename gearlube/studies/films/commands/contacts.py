"""The commands `gearlube ehl line`, `point` and `rough`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

from gearlube.cli.example import print_example
from gearlube.cli.exit_codes import exit_if_failed
from gearlube.cli.options import CaseArgument, ExampleOption, FilmRoughnessOption, OverwriteOption
from gearlube.cli.results_folder import results_folder
from gearlube.cli.study_run import progress_on
from gearlube.studies.films.commands.console import (
    FilmErrorOption,
    exit_on_errors,
    film_error_of,
    solve_and_show,
)
from gearlube_core.checks import check_finite

if TYPE_CHECKING:
    from gearlube_core.ehl.case.contact_case import ContactCase

logger = logging.getLogger("gearlube")
Case = TypeVar("Case", bound="ContactCase")

_Entrainment = Annotated[
    float | None,
    typer.Option(help="Mean surface speed along x [m/s].", metavar="M/S"),
]
_SlideRoll = Annotated[
    float | None,
    typer.Option(help="Slide-roll ratio along x, 2 (u1 - u2)/(u1 + u2).", metavar="RATIO"),
]
_Cavitation = Annotated[
    str | None,
    typer.Option(help="Model of the film rupture.", metavar="reynolds|mass_conserving"),
]
_Temperature = Annotated[
    str | None,
    typer.Option(
        help="isothermal, or thermal: with the energy equation of oil and solids.",
        metavar="isothermal|thermal",
    ),
]


def rough(
    case: CaseArgument = "jamali_2015_a",
    steps: Annotated[
        int | None,
        typer.Option(
            help="Time steps to compute. Default: all. A later run continues.", metavar="N"
        ),
    ] = None,
    nodes: Annotated[int | None, typer.Option(help="Number of nodes along x.", metavar="N")] = None,
    rows: Annotated[int | None, typer.Option(help="Number of rows along y.", metavar="N")] = None,
    sides: Annotated[
        str | None, typer.Option(help="Boundary condition along y.", metavar="cyclic|no_flow")
    ] = None,
    threads: Annotated[
        int, typer.Option(help="Number of threads; results do not depend on it.")
    ] = 1,
    statistics: Annotated[
        bool,
        typer.Option("--statistics", help="Only compute statistics of the films stored in OUT."),
    ] = False,
    animation: Annotated[
        bool, typer.Option("--animation", help="Also write the stored films as animation.gif.")
    ] = False,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_ehl_rough"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """March a line contact between rough surfaces; write rough.nc, films, summary and figures.

    A stopped march goes on from its record in OUT. Options given here replace those of the case.
    """
    if example:
        print_example("gearlube_core.ehl.case.rough_case:RoughCase", case, "rough_")
        return
    from gearlube.studies.films.rough.animation import ANIMATION, check_animation, write_animation
    from gearlube.studies.films.rough.files import summary_rows
    from gearlube.studies.films.rough.run import run_rough, statistics_again
    from gearlube_core.ehl.case.rough_case import RoughCase

    with exit_on_errors(out):
        changes = {"solver.nodes_x": nodes, "solver.rows": rows, "side_conditions": sides}
        given = {name: value for name, value in changes.items() if value is not None}
        file = RoughCase.given(case)
        file = file.varied(given) if given else file
        if animation and not statistics:
            check_animation(file, steps)
        with results_folder(out, "ehl rough", overwrite=overwrite, by_parts=True):
            if statistics:
                dataset = statistics_again(file, out)
            else:
                with progress_on("steps") as progress:
                    dataset = run_rough(
                        file, steps=steps, folder=out, threads=threads, progress=progress
                    )
            if animation:
                with progress_on("animation") as progress:
                    write_animation(file, out, progress)
    for quantity, value, unit in summary_rows(dataset):
        logger.info("%s: %.4g%s", quantity.capitalize(), value, "" if unit == "1" else f" {unit}")
    logger.info("Results: %s", out / ("frames.nc" if statistics else "rough.nc"))
    if animation:
        logger.info("Animation: %s", out / ANIMATION)
    outcome = str(dataset.attrs["outcome"])
    exit_if_failed("" if dataset.attrs["converged"] else outcome)
    logger.info("%s", outcome)


def line(
    case: CaseArgument = "jamali_2015",
    load: Annotated[
        float | None, typer.Option(help="Load per length [N/mm].", metavar="N/MM")
    ] = None,
    entrainment: _Entrainment = None,
    slide_roll: _SlideRoll = None,
    nodes: Annotated[
        int | None, typer.Option(help="Nodes of the finest grid.", metavar="N")
    ] = None,
    stencil: Annotated[
        str | None,
        typer.Option(
            help="Difference scheme of the wedge term.",
            metavar="upwind-2|central|upwind-1|galerkin",
        ),
    ] = None,
    cavitation: _Cavitation = None,
    temperature: _Temperature = None,
    roughness_um: FilmRoughnessOption = None,
    film_error: FilmErrorOption = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_ehl_line"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Solve a lubricated line contact; write line.nc, summary.csv and figures.

    Shipped cases: jamali_2015, jamali_2015_thermal. Options given here replace those of the case.
    """
    if example:
        print_example("gearlube_core.ehl.case.contact_case:LineCase", case, "line_")
        return
    from gearlube.studies.films import run_steady
    from gearlube_core.ehl.case.contact_case import LineCase

    with exit_on_errors(out):
        changes = {
            "load_n_per_mm": load,
            "solver.nodes": nodes,
            "solver.stencil": stencil,
            "solver.cavitation": cavitation,
            "roughness_um": roughness_um,
            "temperature": temperature,
        }
        file = _changed(LineCase.given(case), changes, entrainment, slide_roll)
        goal = film_error_of(film_error)
        solve_and_show(
            lambda progress: run_steady.run_line(
                file, film_error=goal, folder=out, progress=progress
            ),
            out,
            "ehl line",
            overwrite=overwrite,
        )


def point(
    case: CaseArgument = "mourier_2006",
    load: Annotated[float | None, typer.Option(help="Load [N].", metavar="NEWTON")] = None,
    entrainment: _Entrainment = None,
    slide_roll: _SlideRoll = None,
    nodes: Annotated[
        int | None, typer.Option(help="Nodes along x and along y.", metavar="N")
    ] = None,
    wedge: Annotated[
        str | None,
        typer.Option(
            help="Difference scheme of the wedge term.", metavar="upwind-2|upwind-1|central|quick"
        ),
    ] = None,
    cavitation: _Cavitation = None,
    roughness_um: FilmRoughnessOption = None,
    film_error: FilmErrorOption = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_ehl_point"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Solve a lubricated point contact; write point.nc, summary.csv and figures.

    Shipped cases: mourier_2006, elliptical, jamali_2015_section. Options given here replace those
    of the case.
    """
    if example:
        print_example("gearlube_core.ehl.case.contact_case:PointCase", case, "point_")
        return
    from gearlube.studies.films import run_steady
    from gearlube_core.ehl.case.contact_case import PointCase

    with exit_on_errors(out):
        changes = {
            "load_n": load,
            "solver.nodes_x": nodes,
            "solver.nodes_y": nodes,
            "solver.wedge": wedge,
            "solver.cavitation": cavitation,
            "roughness_um": roughness_um,
        }
        file = _changed(PointCase.given(case), changes, entrainment, slide_roll)
        goal = film_error_of(film_error)
        solve_and_show(
            lambda progress: run_steady.run_point(
                file, film_error=goal, folder=out, progress=progress
            ),
            out,
            "ehl point",
            overwrite=overwrite,
        )


def _changed(
    case: Case, changes: dict[str, Any], entrainment: float | None, slide_roll: float | None
) -> Case:
    """Return the case with the values that the options give."""
    given = {field: value for field, value in changes.items() if value is not None}
    for name, value, unit in (
        ("--entrainment", entrainment, "m/s"),
        ("--slide-roll", slide_roll, ""),
    ):
        if value is not None:
            check_finite(name, value, unit)
    given |= case.speeds_at(entrainment, slide_roll)
    return case.varied(given) if given else case
