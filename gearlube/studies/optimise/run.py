"""Optimise flanks: from a problem file to a better gear file, a report and a dataset."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from gearlube.output.toml_text import toml_text
from gearlube.report.page import write_report
from gearlube.report.pictures import save_pictures
from gearlube.report.result import Result, WithResult
from gearlube.studies.optimise.dataset import optimise_dataset
from gearlube.studies.optimise.figures import drawn_figures
from gearlube.studies.optimise.report import optimise_report
from gearlube_core.flank_optimisation.optimise import Optimised, OptimiseSettings, optimise
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_text
from gearlube_core.storage.file_names import pair_stem


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimiseResults(WithResult):
    """Results of an optimisation.

    Parameters
    ----------
    optimised : Optimised
        Better pair, its check by the plain analysis, front.
    dataset : xarray.Dataset
        The same as labelled arrays, see `optimise_dataset`.
    """

    optimised: Optimised
    dataset: Result
    shown: ClassVar[str] = "dataset"


def run_optimise(
    given: OptimisationFile,
    settings: OptimiseSettings | None = None,
    *,
    folder: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> OptimiseResults:
    """Return flanks with the smallest mesh orders under the limits of a problem file.

    Parameters
    ----------
    given : OptimisationFile
    settings : OptimiseSettings, optional
        Rounds, resolution of the check, front, nominal pair.
    folder : Path, optional
        Folder for the better gear file, report.html, optimise.nc and figures/. Evaluations and
        positions are kept there: after a stop the same call continues.
    jobs : int, optional
        Number of processes; default: all processors.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        The problem or its gear file is wrong.
    ConvergenceError
        The pair finds no equilibrium under load.

    Examples
    --------
    >>> found = run_optimise(OptimisationFile.named("helical"))  # doctest: +SKIP
    >>> found.dataset["whine"].sel(error="none")  # doctest: +SKIP
    """
    problem = Problem.of(given)
    found = optimise(problem, settings, folder=folder, jobs=jobs, progress=progress)
    results = OptimiseResults(
        optimised=found, dataset=Result.of(optimise_dataset(found), "optimise")
    )
    if folder is not None:
        progress(1.0, "writing report and figures")
        write_optimise(results, folder)
    return results


def write_optimise(results: OptimiseResults, folder: Path) -> Path:
    """Write gear file, report.html, optimise.nc and figures/; return the gear file."""
    folder.mkdir(parents=True, exist_ok=True)
    found = results.optimised
    path = folder / f"{pair_stem(found.problem.given.name)}.toml"
    file = found.better.file.model_copy(
        update={
            "name": found.problem.given.name,
            "source": f"{found.better.file.source}; flanks optimised by gearlube",
        }
    )
    write_text(toml_text(file.model_dump(exclude_defaults=True)), path)
    write_dataset(results.dataset, folder / "optimise.nc")
    save_pictures(drawn_figures(results.dataset), folder / "figures", results.dataset)
    write_report(optimise_report(results.dataset, folder / "figures"), folder)
    return path
