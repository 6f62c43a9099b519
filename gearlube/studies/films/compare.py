"""Several marches of helical pairs side by side."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import xarray as xr

from gearlube.studies.films.figures.helical_cycle import compared_cycles
from gearlube.studies.films.results import read_march
from gearlube_core.checks import check_within
from gearlube_core.storage.atomic_file import write_figure


def compare_marches(
    marches: Mapping[str, Path | xr.Dataset],
    *,
    film_exponent: float = 0.0,
    folder: Path | None = None,
) -> xr.Dataset:
    """Return largest pressures and smallest films of several marches, to compare them by step.

    Parameters
    ----------
    marches
        Folders of `run_helical_march`, or its datasets, by the names that the figure shows.
    film_exponent
        Films are divided by (pinion speed / pinion speed of the first march) to this power, -5 to
        5 [-].
    folder
        Folder for compare.png; None: nothing is written.

    Returns
    -------
    xr.Dataset
        `pressure_max` [Pa], `minimum_film` [m], as solved, and `converged` over `march` and
        `step`; not a number at steps that a march does not have.

    Raises
    ------
    ParameterError
        A folder holds no march, or the exponent is out of range.

    Examples
    --------
    >>> from gearlube.studies.films.helical_case import HelicalLineCase
    >>> from gearlube.studies.films.run_march import MarchSteps, run_helical_march
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> gears = HelicalGearFile.named("jamali_2015_a")
    >>> marches = {
    ...     name: run_helical_march(
    ...         HelicalLineCase(file=gears, nodes=(33, 49), newtonian=newtonian),
    ...         MarchSteps(first=300, last=301),
    ...     )
    ...     for name, newtonian in (("Eyring", False), ("Newtonian", True))
    ... }
    >>> compare_marches(marches).sizes["march"]
    2
    """
    check_within("film_exponent", film_exponent, -5.0, 5.0)
    cycles = {
        name: one if isinstance(one, xr.Dataset) else read_march(Path(one))
        for name, one in marches.items()
    }
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        write_figure(compared_cycles(cycles, film_exponent), folder / "compare.png")
    curves = [one[["pressure_max", "minimum_film", "converged"]] for one in cycles.values()]
    names = xr.DataArray(list(cycles), dims="march", name="march")
    failed = [name for name, one in cycles.items() if not one.attrs["converged"]]
    outcome = f"All {len(cycles)} marches converged."
    if failed:
        outcome = f"Steps did not converge in {', '.join(failed)}."
    found = xr.concat(curves, names, join="outer", combine_attrs="override")
    found.attrs = {
        "contact": "helical_marches",
        "film_exponent": film_exponent,
        "converged": int(not failed),
        "outcome": outcome,
    }
    return found
