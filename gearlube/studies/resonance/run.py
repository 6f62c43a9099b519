"""Run a resonance study of the torsional hypoid pair: from settings to datasets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.page import write_report
from gearlube.studies.resonance.cycle_dataset import cycle_dataset
from gearlube.studies.resonance.datasets import resonance_dataset
from gearlube.studies.resonance.figures.catalogue import load_curves, save_resonance_figures
from gearlube.studies.resonance.response import Response
from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube.studies.resonance.study import study_resonance
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.period_problem import LoadProblem
from gearlube_core.periodic import Branch, follow, solve_periodic
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_figure

FORMS = ("two_dof", "one_dof")

SPAN = (0.3, 2.0)  # of the pinion torque asked for

_STEPS = 256  # a mesh period
_BESIDE = 1.01  # start over the torque asked for, which may be a corner: a level of the mesh table
_SAME = 1e-5  # scaled distance of two solutions that are one [-]

_UNITS = {
    "torque": ("N.m", "pinion torque"),
    "peak_to_peak": ("m", "transmission error, peak to peak"),
    "minimum": ("m", "least transmission error"),
    "separation_share": ("1", "time without contact"),
    "stable": ("1", "1 where the motion is stable"),
    "special_torque": ("N.m", "folds and bifurcations"),
    "special_peak_to_peak": ("m", "transmission error there, peak to peak"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class _LoadBranch:
    """Motions in the order in which they lie along a branch over the pinion torque.

    Parameters
    ----------
    problem : LoadProblem
    torque : ndarray of shape (n,)
        [N.m]
    unknowns : ndarray of shape (n, m)
        z of `problem`.
    stable : ndarray of shape (n,)
        1.0 where the motion is stable.
    special : ndarray of shape (k,)
        Torque at folds and bifurcations [N.m].
    special_unknowns : ndarray of shape (k, m)
        Unknowns z at the special points.
    """

    problem: LoadProblem
    torque: Array
    unknowns: Array
    stable: Array
    special: Array
    special_unknowns: Array

    def holds(self, unknowns: Array, torque: float) -> bool:
        """Whether a motion lies on the branch, which must have rows at that torque."""
        there = np.abs(self.torque - torque) <= 1e-6 * float(np.ptp(self.torque))
        scale = self.problem.equations().unknown_scale
        if self.unknowns.shape[1] != unknowns.size:
            return False
        apart = np.abs(self.unknowns[there] - unknowns) / scale
        return bool(np.any(np.max(apart, axis=1, initial=0.0) < _SAME))


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

    def plot(self) -> Any:
        """Return the first figure, a figure of matplotlib."""
        from gearlube.studies.resonance.figures.response_curves import response_curves

        return response_curves(self.response)

    def report(self, folder: str | Path) -> Path:
        """Write FOLDER/report.html as the command does; return its path."""
        from gearlube.studies.resonance.report import resonance_report

        figures = Path(folder) / "figures"
        save_resonance_figures(self.response, self.cycle, figures)
        return write_report(resonance_report(self.response, figures, self.load), folder)


def run_resonance(
    settings: ResonanceSettings, *, folder: Path | None = None, progress: Progress = no_progress
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
        write_figure(load_curves(results.load), folder / "figures" / "load_response.png")


def load_response(
    settings: ResonanceSettings, relative: float, responses: Mapping[str, Response]
) -> xr.Dataset:
    """Return stable and unstable motions of the dry pair over the pinion torque.

    One branch comes down from the highest torque. Every motion that a response over the speed has
    at this frequency and lies on none of the branches yet starts another: a branch of motions with
    teeth apart may be closed in itself, so that no other branch leads to it.

    Parameters
    ----------
    settings : ResonanceSettings
    relative : float
        Mesh frequency over the natural frequency at the torque asked for [-]; the speed stays.
    responses : dict of str to Response
        By model, see `MODELS`, with rows at `relative`; those that are missing start nothing.

    Returns
    -------
    xarray.Dataset
        Each variable of dimensions (form, branch, row), rows along the branch, padded with NaN.
    """
    found = {form: _load_branches(settings, relative, form, responses.get(form)) for form in FORMS}
    columns = {
        (form, number): _columns(branch)
        for form, branches in found.items()
        for number, branch in enumerate(branches)
    }
    most = max(len(branches) for branches in found.values())
    length = max(len(values) for kept in columns.values() for values in kept.values())
    data: dict[str, Any] = {}
    for name, (unit, text) in _UNITS.items():
        values = np.full((len(FORMS), most, length), np.nan)
        for (form, number), kept in columns.items():
            values[FORMS.index(form), number, : len(kept[name])] = kept[name]
        data[name] = (("form", "branch", "row"), values, {"units": unit, "long_name": text})
    return xr.Dataset(
        data,
        coords={"form": list(FORMS), "branch": np.arange(most)},
        attrs={"relative_frequency": relative, "torque_asked_for": settings.pinion_torque},
    )


def _load_branches(
    settings: ResonanceSettings, relative: float, form: str, response: Response | None
) -> list[_LoadBranch]:
    """Return the branches of one form, see `load_response`."""
    parameters, torque = settings.parameters(form), settings.pinion_torque
    limits = SPAN[0] * torque, SPAN[1] * torque
    model = HypoidTorsional(parameters)
    speed = model.pinion_speed(relative * model.natural_frequency)
    problem = LoadProblem(parameters, speed, steps_per_mesh_period=_STEPS)

    def way(of: LoadProblem, start: Array, begin: float, heading: float) -> Branch:
        return follow(of.equations(), start, begin, limits=limits, heading=heading, at=[torque])

    high = limits[1]
    branches = [_joined(problem, [way(problem, problem.initial_guess(high), high, -1.0)])]
    for segment, row in response.motions(relative) if response is not None else []:
        problem = LoadProblem(
            parameters, speed, periods=segment.problem.periods, steps_per_mesh_period=_STEPS
        )
        motion = solve_periodic(
            problem.equations(), segment.branch.unknowns[row], torque, throw=False
        )
        periods = segment.problem.periods
        known = (b for b in branches if b.problem.periods == periods)
        if not motion.converged or any(b.holds(motion.unknowns, torque) for b in known):
            continue
        start, begin = motion.unknowns, torque
        beside = solve_periodic(problem.equations(), start, _BESIDE * torque, throw=False)
        if beside.converged:
            start, begin = beside.unknowns, _BESIDE * torque
        ways = [way(problem, start, begin, -1.0)]
        if ways[0].ending != "closed":
            ways.append(way(problem, start, begin, 1.0))
        branches.append(_joined(problem, ways))
    return branches


def _joined(problem: LoadProblem, ways: list[Branch]) -> _LoadBranch:
    """Return one branch from the two ways in which it leaves its start, or from one."""
    back = ways[1] if len(ways) == 2 else None

    def rows(values: Array, turned: Array | None) -> Array:
        if turned is None:
            return values
        return np.concatenate([turned[:0:-1], values])

    points = [point for branch in ways for point in branch.special if point.kind != "exchange"]
    size = ways[0].unknowns.shape[1]
    return _LoadBranch(
        problem=problem,
        torque=rows(ways[0].parameter, None if back is None else back.parameter),
        unknowns=rows(ways[0].unknowns, None if back is None else back.unknowns),
        stable=rows(
            ways[0].stable.astype(float), None if back is None else back.stable.astype(float)
        ),
        special=np.array([point.parameter for point in points]),
        special_unknowns=np.array([point.unknowns for point in points]).reshape(-1, size),
    )


def _columns(branch: _LoadBranch) -> dict[str, Array]:
    """Return the rows of each variable of the dataset."""
    orbits = [
        branch.problem.orbit(z, torque)
        for z, torque in zip(branch.unknowns, branch.torque, strict=True)
    ]
    return {
        "torque": branch.torque,
        "peak_to_peak": np.array([np.ptp(orbit.x) for orbit in orbits]),
        "minimum": np.array([orbit.x.min() for orbit in orbits]),
        "separation_share": np.array([orbit.separation_share for orbit in orbits]),
        "stable": branch.stable,
        "special_torque": branch.special,
        "special_peak_to_peak": np.array(
            [
                np.ptp(branch.problem.orbit(z, torque).x)
                for z, torque in zip(branch.special_unknowns, branch.special, strict=True)
            ]
        ),
    }
