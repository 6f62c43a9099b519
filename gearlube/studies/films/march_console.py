"""A contact line through its meshing cycle with progress, records, files and a summary."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import xarray as xr
from rich.console import Console

from gearlube.cli.progress_bar import progress_bar
from gearlube.studies.films.console import warn_of_ends
from gearlube.studies.films.cycle_dataset import cycle_dataset, march_key
from gearlube.studies.films.cycle_lines import CycleLines, step_dataset, with_steady_film
from gearlube.studies.films.figures.catalogue import save_ehl_figures
from gearlube.studies.films.helical_case import HelicalLineCase
from gearlube_core.checks import check_within
from gearlube_core.ehl.gears.helical_cycle import march_helical_cycle, solve_helical_line
from gearlube_core.ehl.gears.helical_film import HelicalFilm
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.storage.atomic_file import write_dataset

logger = logging.getLogger("gearlube")
RECORD_EVERY = 5  # steps of a march


def console_helical_cycle(
    console: Console,
    *,
    case: HelicalLineCase,
    first: int,
    last: int | None,
    snapshots: tuple[int, ...],
    out: Path,
) -> str:
    """March a contact line through its cycle, write to `out`; return why it failed, or nothing.

    The march goes on from its last record in `out`, if there is one. At the steps `snapshots` the
    whole film is written, beside that of the line at rest there.
    """
    film = case.film()
    last = film.steps.count if last is None else last
    for step in snapshots:
        check_within("--snapshots", step, first, last, "", "Name steps of the march.")
    warn_of_ends(film)
    out.mkdir(parents=True, exist_ok=True)
    key = march_key(film, first)
    lines = CycleLines(out / f"lines_{key}.npz")
    with progress_bar(console) as bar:
        task = bar.add_task("steady film at the first step", total=last - first + len(snapshots))

        def observe(n: int, _: int, solution: FilmSolution) -> None:
            lines.add(n, solution)
            if n in snapshots:
                write_dataset(step_dataset(case, film, n, solution, key), _step_file(out, n))
            if n % RECORD_EVERY == 0 or n == last:
                lines.write()
            words = f"smallest film {smallest_film_nm(solution)} nm"
            bar.update(task, completed=n - first, description=words)

        cycle = march_helical_cycle(
            film,
            first=first,
            last=last,
            checkpoint=out / f"march_{key}.npz",
            checkpoint_every=RECORD_EVERY,
            progress=observe,
            throw=False,
        )
        bar.update(task, completed=last - first)
        steady: dict[int, FilmSolution] = {}
        for n in snapshots:
            bar.update(task, description=f"step {n} at rest")
            steady[n] = solve_helical_line(film, float(n), MARCH_SETTINGS, throw=False)
            _finish_step(film, n, steady[n], out, key)
            bar.update(task, advance=1)
        bar.update(task, description="files and figures")
        dataset = cycle_dataset(case, film, cycle, lines).isel(step=slice(0, last - first + 1))
        dataset = _with_steady_points(dataset, steady)
        write_dataset(dataset, out / "cycle.nc")
        save_ehl_figures(dataset, out / "figures")
    logger.info("Largest pressure %.3f GPa.", 1e-9 * float(dataset["pressure_max"].max()))
    logger.info("Smallest film %.1f nm.", 1e9 * float(dataset["minimum_film"].min()))
    logger.info("Results: %s, %s", out / "cycle.nc", out / "figures")
    failed = dataset["step"].values[dataset["converged"].values == 0.0]
    if failed.size:
        return (
            f"{failed.size} of {dataset.sizes['step']} steps did not converge, the first is step "
            f"{failed[0]:.0f}. Take more nodes."
        )
    return ""


def smallest_film_nm(solution: FilmSolution) -> str:
    """Return the smallest film [nm] as the progress bar shows it."""
    return f"{1e9 * solution.minimum_film:.0f}"


def _step_file(out: Path, step: int) -> Path:
    return out / f"step_{step:04d}.nc"


def _finish_step(film: HelicalFilm, step: int, steady: FilmSolution, out: Path, key: str) -> None:
    """Write the film at rest beside that of the march, and their figures."""
    path = _step_file(out, step)
    stored = xr.load_dataset(path, engine="scipy") if path.exists() else None
    if stored is None or stored.attrs.get("march") != key:
        logger.warning(
            "The march passed step %d before its film was asked for. For %s, march into another "
            "folder.", step, path.name,
        )  # fmt: skip
        return
    dataset = with_steady_film(stored, steady)
    write_dataset(dataset, path)
    save_ehl_figures(dataset, out / "figures", prefix=f"{path.stem}_")


def _with_steady_points(dataset: xr.Dataset, steady: dict[int, FilmSolution]) -> xr.Dataset:
    """Return the curves of a cycle with largest pressures and smallest films at rest."""
    if not steady:
        return dataset
    steps = dataset["step"].values
    pressure, film = (np.full(steps.size, np.nan) for _ in range(2))
    for step, solution in steady.items():
        k = int(np.flatnonzero(steps == step)[0])
        pressure[k], film[k] = solution.maximum_pressure, solution.minimum_film
    return dataset.assign(
        steady_pressure_max=(
            "step", pressure, {"units": "Pa", "long_name": "largest pressure, line at rest"},
        ),
        steady_minimum_film=(
            "step", film, {"units": "m", "long_name": "smallest film, line at rest"},
        ),
    )  # fmt: skip
