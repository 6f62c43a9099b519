"""The command `gearlube roughness flow-factors`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gearlube.cli.exit_codes import console, exit_on_error
from gearlube.cli.options import OverwriteOption
from gearlube.cli.results_folder import results_folder
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube_core.surface.heights import HeightMap

logger = logging.getLogger("gearlube")
_MICRO = 1e-6  # m


def flow_factors(
    files: Annotated[
        list[str] | None,
        typer.Argument(
            help="Maps that repeat along both sides: seeds or cuts of one surface. Default: made.",
            metavar="[FILE]...",
        ),
    ] = None,
    rq_um: Annotated[float, typer.Option(help="Rms height of made patches [um].")] = 0.4,
    correlation_um: Annotated[
        float, typer.Option(help="Autocorrelation length of made patches to 0.2, along x [um].")
    ] = 20.0,
    peklenik: Annotated[
        float, typer.Option(help="Autocorrelation length along x (motion) over that along y.")
    ] = 1.0,
    seeds: Annotated[int, typer.Option(help="Number of made patches.")] = 5,
    points: Annotated[int, typer.Option(help="Points along each side of made patches.")] = 192,
    film_ratios: Annotated[
        str, typer.Option(help="Distances of the mean planes over the rms height.")
    ] = "0.5,0.75,1,1.5,2,3,4,6",
    contact: Annotated[
        bool, typer.Option("--contact/--no-contact", help="Also solve the dry elastic contact.")
    ] = True,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path(
        "gearlube_flow_factors"
    ),
    overwrite: OverwriteOption = False,
) -> None:
    """Solve Reynolds' equation on rough patches: flow factors, and asperity load, as a table."""
    with exit_on_error(f"Stopped; {out} may be incomplete. Run the same command again."):
        from rich.progress import Progress

        from gearlube.studies.roughness.results import flow_results, shown_rows
        from gearlube_core.rough_patch.table import gaussian_patches, patch_table

        try:
            ratios = [float(one) for one in film_ratios.split(",")]
        except ValueError:
            raise ParameterError(
                f"--film-ratios must be numbers with commas between, got {film_ratios!r}."
            ) from None
        known: float | None = None
        if files:
            patches = [_patch(one) for one in files]
        else:
            known = check_within("--peklenik", peklenik, 0.01, 100.0)
            check_within("--seeds", seeds, 1, 100)
            length = check_positive("--correlation-um", correlation_um, "um") * _MICRO
            rms = check_positive("--rq-um", rq_um, "um") * _MICRO
            patches = gaussian_patches(
                rms,
                length,
                length / known,
                range(1, seeds + 1),
                nodes=int(check_within("--points", points, 48, 1024)),
                nodes_per_length=12.0,
            )
        with results_folder(out, "roughness flow-factors", overwrite=overwrite):
            with Progress(console=console) as bar:
                task = bar.add_task("patches", total=1.0)
                table = patch_table(
                    patches,
                    ratios,
                    contact=contact,
                    progress=lambda share, words: bar.update(
                        task, completed=share, description=words
                    ),
                )
            written = flow_results(table, out, known)
        _show(*shown_rows(table))
        logger.info("Results: %s", ", ".join(str(one) for one in written))


def _patch(file: str) -> HeightMap:
    from dataclasses import replace

    from gearlube_core.surface.files import read_surface
    from gearlube_core.surface.heights import HeightMap

    surface = read_surface(file)
    if not isinstance(surface, HeightMap):
        raise ParameterError(
            f"{file} must hold a map, got a profile. Make a map of it with gearlube roughness "
            "extrude."
        )
    return replace(surface, periodic=(True, True), name=file)


def _show(headings: tuple[str, ...], rows: list[tuple[str, ...]]) -> None:
    from rich.table import Table

    table = Table(title="means over patches")
    for heading in headings:
        table.add_column(heading, justify="right")
    for row in rows:
        table.add_row(*row)
    console.print(table)
