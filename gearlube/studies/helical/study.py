"""A study of a helical pair: contact, vibration, stability, friction, geometry, in stages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.studies.helical.film_friction import film_dataset
from gearlube.studies.helical.geometry_dataset import gear_file_geometry
from gearlube.studies.helical.labels import pair_attributes, study_attributes
from gearlube.studies.helical.loaded import analyse_loaded_contact, constant_density_stiffness
from gearlube.studies.helical.operating_point import operating_point
from gearlube.studies.helical.separation import separation_dataset
from gearlube.studies.helical.settings import SHOWN_MU, HelicalSettings
from gearlube.studies.helical.stability import stability_dataset
from gearlube.studies.helical.sweep_grid import sweep_dataset
from gearlube_core.dynamics.helical_pair.linear.periodic_response import with_friction
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.errors import GearLubeError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh import LineMesh

THESIS = ("jamali_2015_a", "jamali_2015_b")  # drawn beside the pair of He et al. 2007


class Stage(NamedTuple):
    """Progress of a study: what runs, and how much of all is done [-]."""

    name: str
    done: float


@dataclass(slots=True, kw_only=True)
class HelicalStudy:
    """What was found; what a stopped study has not reached is absent.

    Parameters
    ----------
    settings : HelicalSettings
    datasets : dict of str to xr.Dataset
        "contact", "response", "friction_sweep", "sweep", "stability", "separation", "film",
        "geometry" and "geometry_" with a name of `THESIS`.
    mesh : LineMesh, optional
        Of the loaded contact.
    failures : dict of str to str
        Why a stage found nothing, by its name.
    interrupted : bool
        Whether it was stopped by KeyboardInterrupt.
    """

    settings: HelicalSettings
    datasets: dict[str, xr.Dataset] = field(default_factory=dict)
    mesh: LineMesh | None = None
    failures: dict[str, str] = field(default_factory=dict)
    interrupted: bool = False

    @property
    def parameters(self) -> HelicalPairParameters:
        """The vibrating pair with the mesh that was asked for."""
        return self.settings.parameters(self.mesh if self.settings.mesh == "contact" else None)


Observer = Callable[[Stage], None]


class _Task(NamedTuple):
    name: str
    cost: float  # typical running time [s]
    run: Callable[[_Report], None]
    needed: bool = False  # by all that follow


@dataclass(slots=True)
class _Report:
    """Passes the share of a task that is done on, as a share of the study."""

    observer: Observer
    task: _Task
    before: float
    total: float
    name: str = ""
    share: float = 0.0

    def __call__(self, share: float) -> None:
        self.share = share
        done = (self.before + share * self.task.cost) / self.total
        self.observer(Stage(self.name or self.task.name, done))

    def announce(self, name: str) -> None:
        """Say what the task does next."""
        self.name = name
        self(self.share)


def study_helical_pair(
    settings: HelicalSettings,
    observer: Observer = lambda stage: None,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    command_line: str = "",
) -> HelicalStudy:
    """Run a study; on KeyboardInterrupt return what was found until then.

    Parameters
    ----------
    settings : HelicalSettings
    observer : callable
        Called with a `Stage` whenever something was done.
    store : Path, optional
        Folder that keeps finished parts of the long stages.
    jobs : int, optional
        Processes; all processors by default.
    command_line : str
        Kept in the datasets.

    Raises
    ------
    GearLubeError
        The loaded contact failed whose mesh all else needs. Failures of other stages are noted.
    """
    study = HelicalStudy(settings=settings)
    tasks = _tasks(study, store, jobs)
    total, before = sum(task.cost for task in tasks), 0.0
    try:
        for task in tasks:
            report = _Report(observer, task, before, total)
            report(0.0)
            try:
                task.run(report)
            except GearLubeError as reason:
                if task.needed:
                    raise
                study.failures[task.name] = str(reason)
            before += task.cost
        observer(Stage("done", 1.0))
    except KeyboardInterrupt:
        study.interrupted = True
    for dataset in study.datasets.values():
        dataset.attrs = study_attributes(settings, command_line) | dataset.attrs
    return study


# seconds of one processor; a process costs two or three before it begins
_STATE, _POINT, _CELL, _FEW = 0.07, 0.006, 0.002, 5.0


def _processes(jobs: int | None, seconds: float) -> int | None:
    """Return how many processes are worth it for so much work."""
    return 1 if seconds < _FEW else jobs


def _tasks(study: HelicalStudy, store: Path | None, jobs: int | None) -> list[_Task]:
    settings, kept = study.settings, study.datasets
    tasks: list[_Task] = []

    def contact(report: _Report) -> None:
        work = _STATE * settings.positions * len(settings.load_steps)
        found = analyse_loaded_contact(
            settings, store, jobs, _processes(jobs, work), report.announce, report
        )
        density = settings.stiffness_density
        kept["contact"] = found.dataset.merge(constant_density_stiffness(settings, density))
        kept["contact"].attrs = found.dataset.attrs | {
            "density": density,
            "density_units": "N/m2",
        }
        study.mesh = found.mesh

    def respond(report: _Report) -> None:
        found = operating_point(study.parameters, settings.pinion_speed, SHOWN_MU)
        found.attrs |= pair_attributes(study.parameters)
        kept["response"] = found
        report(0.3)
        kept["friction_sweep"] = sweep_dataset(
            replace(study.parameters, film=None),
            np.array(settings.mu),
            np.array([settings.pinion_speed]),
            jobs=1,
        )
        kept["friction_sweep"].attrs |= pair_attributes(study.parameters)

    def sweep(report: _Report) -> None:
        parameters = study.parameters
        speeds = settings.swept_speeds(parameters)
        kept["sweep"] = sweep_dataset(
            parameters,
            np.array(settings.mu),
            speeds,
            store=store,
            jobs=_processes(jobs, _POINT * speeds.size * len(settings.mu)),
            observe=report,
        )
        kept["sweep"].attrs |= pair_attributes(parameters)

    def stability(report: _Report) -> None:
        parameters = replace(study.parameters, film=None)
        kept["stability"] = stability_dataset(
            parameters,
            settings.stability_columns,
            settings.stability_rows,
            store=store,
            jobs=_processes(
                jobs, 3.0 * _CELL * settings.stability_columns * settings.stability_rows
            ),
            observe=report,
        )
        kept["stability"].attrs |= pair_attributes(parameters)

    def separation(report: _Report) -> None:
        parameters = with_friction(replace(study.parameters, film=None), SHOWN_MU[-1])
        kept["separation"] = separation_dataset(parameters, settings.separation_speeds, report)
        kept["separation"].attrs |= pair_attributes(parameters)

    def film(report: _Report) -> None:
        kept["film"] = film_dataset(settings, study.parameters.mesh, report)

    def geometry(report: _Report) -> None:
        operation = settings.pinion_torque, settings.pinion_speed
        kept["geometry"] = gear_file_geometry(settings.file, *operation)
        if settings.file.name == "he_2007":
            for name in THESIS:
                report(0.5)
                kept[f"geometry_{name}"] = gear_file_geometry(HelicalGearFile.named(name))

    if settings.with_contact:
        tasks.append(_Task("loaded contact", 30.0, contact, settings.mesh == "contact"))
    if settings.with_dynamics:
        tasks.append(_Task("operating point", 2.0, respond))
        tasks.append(_Task("friction and speed", 25.0, sweep))
        tasks.append(_Task("parametric instability", 15.0, stability))
        if settings.separation_speeds > 0:
            tasks.append(_Task("tooth separation", 12.0, separation))
        if settings.friction == "film":
            tasks.append(_Task("friction of the oil film", 1.0, film))
    if settings.with_geometry:
        tasks.append(_Task("geometry", 2.0, geometry))
    return tasks
