"""The command `gearlube ehl compare`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gearlube.studies.films.outcome import told
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError

if TYPE_CHECKING:
    import xarray as xr

logger = logging.getLogger("gearlube")


def compare(
    marches: Annotated[
        list[str],
        typer.Argument(
            help="Folders of marches, or NAME=FOLDER to name them.", metavar="FOLDER..."
        ),
    ],
    film_exponent: Annotated[
        float,
        typer.Option(
            help="Divide films by the pinion speed, over that of the first, to this power.",
            metavar="N",
        ),
    ] = 0.0,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_ehl_compare"),
) -> None:
    """Draw largest pressures and smallest films of several marches over their steps.

    For instance of one pair with other tip reliefs, crowns, facets or speeds, each marched before
    by gearlube ehl helical --march. Writes compare.png.
    """
    from gearlube.studies.films.figures.helical_cycle import compared_cycles

    with told(out):
        check_within("--film-exponent", film_exponent, -5.0, 5.0)
        cycles: dict[str, xr.Dataset] = {}
        for entry in marches:
            name, given, folder = entry.rpartition("=")
            where = Path(folder if given else entry)
            label = name if given else where.name
            if label in cycles:
                raise ParameterError(
                    f"Names of marches must differ, got {label!r} twice. Write NAME=FOLDER."
                )
            cycles[label] = _cycle(where)
        out.mkdir(parents=True, exist_ok=True)
        compared_cycles(cycles, film_exponent).savefig(out / "compare.png", dpi=150)
        logger.info("Results: %s", out / "compare.png")


def _cycle(folder: Path) -> xr.Dataset:
    import xarray as xr

    path = folder / "cycle.nc" if folder.is_dir() else folder
    try:
        dataset = xr.load_dataset(path, engine="scipy")
    except (OSError, ValueError, TypeError) as reason:
        raise ParameterError(
            f"{path} is not the cycle of a march: {reason}. March before with "
            "gearlube ehl helical --march."
        ) from None
    if dataset.attrs.get("contact") != "helical_cycle":
        raise ParameterError(f"{path} must be the cycle.nc of a march, got another dataset.")
    return dataset
