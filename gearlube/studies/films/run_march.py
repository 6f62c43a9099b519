"""The film of a helical pair's contact line through its meshing cycle, and several beside it."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import xarray as xr

from gearlube.report.inputs import remark_attributes
from gearlube.report.result import Result
from gearlube.studies.films.datasets.helical import (
    CycleLines,
    cycle_dataset,
    helical_dataset,
    march_key,
    step_dataset,
    with_steady_film,
    with_steady_points,
)
from gearlube.studies.films.figures.helical_cycle import compared_cycles
from gearlube.studies.films.helical_case import HelicalLineCase
from gearlube.studies.films.results import (
    begin,
    finished,
    read_march,
    step_file,
    write_film_results,
)
from gearlube.studies.films.run_steady import note_roughness, warn_of_ends, warn_of_grid
from gearlube_core.checks import check_within
from gearlube_core.ehl.gears.helical_film import march_helical_cycle, solve_helical_line
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import read_dataset, write_dataset, write_figure

logger = logging.getLogger("gearlube")

MOST_STEPS = 100_000


@dataclass(frozen=True, slots=True, kw_only=True)
class MarchSteps:
    """Steps of the meshing cycle that `run_helical_march` covers, and what it keeps of them.

    Parameters
    ----------
    first, last
        First and last step; `last` None: that of the cycle. The film is steady at the first.
    snapshots
        Steps whose whole film is written, together with the steady film of the same line. They need
        a folder.
    record_every
        Number of steps between two records of the march. A stopped march continues from its last
        record.

    Examples
    --------
    >>> MarchSteps(first=60, last=110).record_every
    5
    """

    first: int = 0
    last: int | None = None
    snapshots: tuple[int, ...] = ()
    record_every: int = 5
    repeat: bool = False

    def __post_init__(self) -> None:
        check_within("the first step", self.first, 0, MOST_STEPS, "", "Write FIRST:LAST.")
        if self.last is not None:
            check_within("the last step", self.last, 0, MOST_STEPS, "", "Write FIRST:LAST.")
            if self.last <= self.first:
                cure = (
                    f"Write them as {self.last}:{self.first}."
                    if self.last < self.first
                    else "The film at rest is that of a step, not of a march."
                )
                raise ParameterError(
                    f"the last step must be above the first, got {self.first} and {self.last}. "
                    f"{cure}"
                )
        check_within("record_every", self.record_every, 1, MOST_STEPS)


def run_helical_march(
    case: HelicalLineCase,
    steps: MarchSteps | None = None,
    *,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the film of a helical pair's contact line through its meshing cycle, with squeeze.

    Parameters
    ----------
    case
        Gear pair, operation, oil and grid; its `step` and `position` are not used.
    steps
        Steps of the march; default: the whole cycle.
    folder
        Folder for cycle.nc, figures, snapshots and records of the march. If there is a record, the
        march continues from it. None: nothing is written.
    progress
        Called with the share done and a sentence on what runs.

    Returns
    -------
    xr.Dataset
        See `cycle_dataset`. The attribute `converged` is 0 if any step did not converge.

    Raises
    ------
    ParameterError
        The case is incomplete or out of range, or a record in `folder` cannot be read.

    Examples
    --------
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> case = HelicalLineCase(file=HelicalGearFile.named("jamali_2015_a"), nodes=(33, 49))
    >>> run_helical_march(case, MarchSteps(first=300, last=302)).sizes["step"]
    3
    """
    steps = steps or MarchSteps()
    film = case.film()
    names = {"name": case.file.name, "source": case.file.source}
    first = steps.first
    last = film.steps.count if steps.last is None else steps.last
    check_within("the last step", last, first + 1, film.steps.count, "", "The cycle ends there.")
    for step in steps.snapshots:
        check_within("snapshots", step, first, last, "", "Name steps of the march.")
    if steps.snapshots and folder is None:
        raise ParameterError(
            "snapshots need a folder in which they are written, got none. Give a folder."
        )
    warn_of_ends(film)
    key = march_key(film, first)
    begin(folder, progress, "steady film at the first step")
    lines = CycleLines(None if folder is None else folder / f"lines_{key}.npz")
    films = last - first + len(steps.snapshots)

    def report(solved: int, sentence: str) -> None:
        # files and figures count as much as one more film
        progress(solved / (films + 1), sentence)

    def observe(step: int, _: int, solution: FilmSolution) -> None:
        lines.add(step, solution)
        if folder is not None and step in steps.snapshots:
            line = helical_dataset(film, float(step), solution, **names)
            write_dataset(step_dataset(line, key), step_file(folder, step))
        if step % steps.record_every == 0 or step == last:
            lines.write()
        report(step - first, f"smallest film {1e9 * solution.minimum_film:.0f} nm")

    cycle = march_helical_cycle(
        film,
        first=first,
        last=last,
        checkpoint=None if folder is None else folder / f"march_{key}.npz",
        checkpoint_every=steps.record_every,
        progress=observe,
        repeat=steps.repeat,
        throw=False,
    )
    # a record may hold more steps than are asked for now
    cycle = replace(cycle, table=cycle.table[: last - first + 1])
    start = solve_helical_line(film, float(first), MARCH_SETTINGS, throw=False)
    steady: dict[int, FilmSolution] = {}
    for done, step in enumerate(steps.snapshots, last - first):
        report(done, f"steady film at step {step}")
        steady[step] = solve_helical_line(film, float(step), MARCH_SETTINGS, throw=False)
        if folder is not None:
            _finish_snapshot(folder, step, key, steady[step])
    curves = cycle_dataset(film, cycle, lines, start=start, repeated=steps.repeat, **names)
    dataset = with_steady_points(curves, steady)
    dataset.attrs |= remark_attributes(case.file)
    note_roughness(dataset, case.roughness_um)
    warn_of_grid(dataset)
    return finished(dataset, folder, progress, films / (films + 1))


def _finish_snapshot(folder: Path, step: int, key: str, steady: FilmSolution) -> None:
    """Add the steady film to the snapshot written by the march `key`, and draw both."""
    path = step_file(folder, step)
    stored = read_dataset(path, engine="scipy") if path.exists() else None
    if stored is None or stored.attrs.get("march") != key:
        logger.warning(
            "The march has already passed step %d, so its film cannot be kept. For %s, run it "
            "with another folder.", step, path.name,
        )  # fmt: skip
        return
    write_film_results(with_steady_film(stored, steady), folder)


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
