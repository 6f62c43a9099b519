"""Run a resonance study of the torsional hypoid pair: from settings to datasets."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import xarray as xr

from gearlube.studies.resonance.cycle_dataset import cycle_dataset
from gearlube.studies.resonance.datasets import resonance_dataset
from gearlube.studies.resonance.figures import save_resonance_figures
from gearlube.studies.resonance.figures.load_curves import load_curves
from gearlube.studies.resonance.load_response import load_response
from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube.studies.resonance.study import study_resonance
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset


@dataclass(frozen=True, slots=True, kw_only=True)
class ResonanceResults:
    """Results of a resonance study; a stopped study lacks the parts that it did not reach.

    Parameters
    ----------
    response : xarray.Dataset
        Response curves, special points, sweeps in time, see `resonance_dataset`.
    cycle : xarray.Dataset
        Motions, Poincare section, flank contacts, see `cycle_dataset`.
    load : xarray.Dataset, optional
        Response over the pinion torque, see `load_response`; where `settings.load_at` asks for it.
    interrupted : bool
        Whether it was stopped by KeyboardInterrupt.
    """

    response: xr.Dataset
    cycle: xr.Dataset
    load: xr.Dataset | None = None
    interrupted: bool = False


def run_resonance(
    settings: ResonanceSettings,
    *,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> ResonanceResults:
    """Return response curves, motions and flank contacts of the torsional pair.

    After KeyboardInterrupt it returns what it has found so far.

    Parameters
    ----------
    settings : ResonanceSettings
    folder : Path, optional
        Folder for the results of `write_resonance`.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    ConvergenceError
        No periodic motion was found at an end of the range.
    StepError
        A time sweep became infinite or not a number.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
    >>> settings = ResonanceSettings(
    ...     mesh=synthetic_mesh(), friction="off", first=0.6, last=0.7, frequencies=2,
    ...     sweep_frequencies=0, section_starts=0, steps_per_mesh_period=64,
    ... )
    >>> found = run_resonance(settings)
    >>> found.response.sizes["model"], found.interrupted
    (3, False)
    """
    study = study_resonance(settings, progress)
    results = ResonanceResults(
        response=resonance_dataset(study),
        cycle=cycle_dataset(study),
        interrupted=study.interrupted,
    )
    if folder is not None:
        progress(1.0, "writing report and figures")
        write_resonance(results, folder)
    if settings.load_at is not None and not study.interrupted:
        progress(1.0, "response over load")
        results = replace(results, load=load_response(settings, settings.load_at, study.responses))
        if folder is not None:
            _write_load(results, folder)
    return results


def write_resonance(results: ResonanceResults, folder: Path) -> None:
    """Write resonance.nc, cycle.nc and figures/, and load.nc with its figure if computed."""
    folder.mkdir(parents=True, exist_ok=True)
    write_dataset(results.response, folder / "resonance.nc")
    write_dataset(results.cycle, folder / "cycle.nc")
    save_resonance_figures(results.response, results.cycle, folder / "figures")
    _write_load(results, folder)


def _write_load(results: ResonanceResults, folder: Path) -> None:
    if results.load is not None:
        write_dataset(results.load, folder / "load.nc")
        load_curves(results.load).savefig(folder / "figures" / "load_response.png", dpi=150)
