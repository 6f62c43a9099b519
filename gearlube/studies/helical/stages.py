"""The stages of a study of a helical pair: contact, vibration, stability, friction, geometry."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.page import write_report
from gearlube.studies.helical.film_friction import film_dataset, share_outside
from gearlube.studies.helical.geometry_dataset import gear_file_geometry
from gearlube.studies.helical.operating_point import operating_point, pair_attributes
from gearlube.studies.helical.pair_losses import losses_dataset
from gearlube.studies.helical.separation import separation_dataset
from gearlube.studies.helical.settings import SHOWN_MU, HelicalSettings
from gearlube.studies.helical.stability import stability_dataset
from gearlube.studies.helical.sweep_grid import sweep_dataset
from gearlube_core.dynamics.helical_pair.linear.periodic_response import with_friction
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.helical_contact.contact_dataset import (
    ContactSettings,
    HelicalContact,
    analyse_contact,
)
from gearlube_core.helical_geometry.contact_line import (
    ContactPlane,
    clip_line,
    line_count,
    line_position,
    segment_length,
)
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.iso_6336_stiffness import (
    iso_stiffness,
    stiffness_density,
    tangential_line_load,
)
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.progress import Progress, no_progress
from gearlube_core.units import labelled

_PHASES = 240


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalResults:
    """Results; a stopped study lacks the parts that it did not reach.

    Parameters
    ----------
    settings : HelicalSettings
    datasets : mapping of str to xarray.Dataset
        "contact", "response", "friction_sweep", "sweep", "stability", "separation", "film",
        "losses", "geometry" and "geometry_" with each name in the gear file's `compared_with`.
    mesh : LineMesh, optional
        Of the loaded contact.
    failures : mapping of str to str
        Why a stage found nothing, by its name.
    interrupted : bool
        Whether it was stopped by KeyboardInterrupt.
    """

    settings: HelicalSettings
    datasets: Mapping[str, xr.Dataset]
    mesh: LineMesh | None
    failures: Mapping[str, str]
    interrupted: bool

    def plot(self) -> Any:
        """Return the first figure for which there are data, a figure of matplotlib."""
        from gearlube.studies.helical.figures.catalogue import HELICAL_CATALOGUE

        one = next(one for one in HELICAL_CATALOGUE.values() if one.needs in self.datasets)
        return one.draw(self.datasets[one.needs])

    def report(self, folder: str | Path) -> Path:
        """Write FOLDER/report.html as the command does; return its path."""
        from gearlube.studies.helical.figures.catalogue import save_helical_figures
        from gearlube.studies.helical.report import helical_report

        figures = Path(folder) / "figures"
        save_helical_figures(self.datasets, figures)
        return write_report(helical_report(self, figures), folder)


@dataclass(slots=True, kw_only=True)
class RunningStudy:
    """Results of a running study so far, and its computing resources.

    Parameters
    ----------
    settings : HelicalSettings
    store : Path, optional
        Folder that keeps finished parts of the long stages.
    jobs : int, optional
        Processes; all processors by default.
    datasets : dict of str to xarray.Dataset
    mesh : LineMesh, optional
        Of the loaded contact.
    """

    settings: HelicalSettings
    store: Path | None = None
    jobs: int | None = None
    datasets: dict[str, xr.Dataset] = field(default_factory=dict)
    mesh: LineMesh | None = None

    @property
    def parameters(self) -> HelicalPairParameters:
        """Parameters of the vibrating pair with the mesh of the settings."""
        return self.settings.parameters(self.mesh if self.settings.mesh == "contact" else None)

    def processes(self, seconds: float) -> int | None:
        """Return how many processes pay off for work of so many seconds of one processor."""
        return 1 if seconds < _FEW else self.jobs


@dataclass(frozen=True, slots=True)
class StageReport:
    """Reports the share of a stage that is done [-]; the stage's name is the default text."""

    progress: Progress
    name: str

    def __call__(self, share: float, sentence: str = "") -> None:
        """Report a share of the stage."""
        self.progress(share, sentence or self.name)


class Stage(NamedTuple):
    """One part of a study."""

    name: str
    cost: float  # typical running time [s]
    run: Callable[[RunningStudy, StageReport], None]
    needed: bool = False  # by all later stages


# seconds of one processor; a process costs two or three before it begins
_STATE, _POINT, _CELL, _FEW = 0.07, 0.006, 0.002, 5.0


def stages_of(settings: HelicalSettings) -> list[Stage]:
    """Return the stages that the settings require, in running order."""
    stages = []
    if settings.with_contact:
        stages.append(Stage("loaded contact", 30.0, _contact, settings.mesh == "contact"))
    if settings.with_dynamics:
        stages.append(Stage("operating point", 2.0, _respond))
        stages.append(Stage("friction and speed", 25.0, _sweep))
        stages.append(Stage("parametric instability", 15.0, _stability))
        if settings.separation_speeds > 0:
            stages.append(Stage("tooth separation", 12.0, _separation))
        if settings.friction != "constant":
            stages.append(Stage("friction of the oil film", 1.0, _film))
    if settings.with_losses:
        stages.append(Stage("losses", 5.0, _losses))
    if settings.with_geometry:
        stages.append(Stage("geometry", 2.0, _geometry))
    return stages


def _contact(study: RunningStudy, report: StageReport) -> None:
    settings = study.settings
    work = _STATE * settings.positions * len(settings.load_steps)
    found = analyse_loaded_contact(
        settings, store=study.store, jobs=study.jobs, cycle_jobs=study.processes(work),
        progress=report,
    )  # fmt: skip
    density = settings.stiffness_density
    dataset = found.dataset.merge(_constant_density_stiffness(settings, density))
    dataset.attrs = found.dataset.attrs | {"density": density, "density_units": "N/m2"}
    study.datasets["contact"] = dataset
    study.mesh = found.line_mesh


def _respond(study: RunningStudy, report: StageReport) -> None:
    settings, parameters = study.settings, study.parameters
    response = operating_point(parameters, settings.pinion_speed, SHOWN_MU)
    response.attrs |= pair_attributes(parameters)
    study.datasets["response"] = response
    report(0.3)
    over_friction = sweep_dataset(
        replace(parameters, film=None),
        np.array(settings.mu),
        np.array([settings.pinion_speed]),
        jobs=1,
    )
    over_friction.attrs |= pair_attributes(parameters)
    study.datasets["friction_sweep"] = over_friction


def _sweep(study: RunningStudy, report: StageReport) -> None:
    settings, parameters = study.settings, study.parameters
    speeds = settings.swept_speeds(parameters)
    sweep = sweep_dataset(
        parameters,
        np.array(settings.mu),
        speeds,
        store=study.store,
        jobs=study.processes(_POINT * speeds.size * len(settings.mu)),
        observe=report,
    )
    if parameters.film is not None and parameters.film.film == "solved":
        shares = share_outside(settings, parameters.mesh, speeds)
        words = {"units": "1", "long_name": "static load outside the domain of the film model"}
        sweep["film_share_outside"] = (("speed",), shares, words)
    sweep.attrs |= pair_attributes(parameters)
    study.datasets["sweep"] = sweep


def _stability(study: RunningStudy, report: StageReport) -> None:
    settings, parameters = study.settings, replace(study.parameters, film=None)
    columns, rows = settings.stability_columns, settings.stability_rows
    stability = stability_dataset(
        parameters,
        columns,
        rows,
        store=study.store,
        jobs=study.processes(3.0 * _CELL * columns * rows),
        observe=report,
    )
    stability.attrs |= pair_attributes(parameters)
    study.datasets["stability"] = stability


def _separation(study: RunningStudy, report: StageReport) -> None:
    parameters = with_friction(replace(study.parameters, film=None), SHOWN_MU[-1])
    separation = separation_dataset(parameters, study.settings.separation_speeds, report)
    separation.attrs |= pair_attributes(parameters)
    study.datasets["separation"] = separation


def _film(study: RunningStudy, report: StageReport) -> None:
    study.datasets["film"] = film_dataset(study.settings, study.parameters.mesh, report)


def _losses(study: RunningStudy, report: StageReport) -> None:
    settings = study.settings
    mesh = study.mesh if study.mesh is not None else settings.constant_mesh()
    study.datasets["losses"] = losses_dataset(settings, mesh, report)


def _geometry(study: RunningStudy, report: StageReport) -> None:
    settings = study.settings
    study.datasets["geometry"] = gear_file_geometry(
        settings.file, settings.pinion_torque, settings.pinion_speed
    )
    for name in settings.file.compared_with:
        report(0.5)
        study.datasets[f"geometry_{name}"] = gear_file_geometry(HelicalGearFile.named(name))


def analyse_loaded_contact(
    settings: HelicalSettings,
    *,
    store: Path | None = None,
    jobs: int | None = None,
    cycle_jobs: int | None = None,
    progress: Progress = no_progress,
) -> HelicalContact:
    """Return the loaded mesh period of a study, with ISO 6336-1 in the dataset's attributes.

    Parameters
    ----------
    settings : HelicalSettings
    store : Path, optional
        Folder that keeps finished positions.
    jobs : int, optional
        Processes for the teeth; all processors by default.
    cycle_jobs : int, optional
        The same for the positions, if other than `jobs`.
    progress : callable, optional
        Called with the share of positions that is done [-] and a sentence on what runs.
    """
    modified = settings.file.modified_pair()
    found = analyse_contact(
        modified,
        ContactSettings(cycle=settings.cycle(), body=settings.body),
        store=store,
        jobs=jobs,
        cycle_jobs=cycle_jobs,
        progress=progress,
    )
    pair = modified.pair
    iso = iso_stiffness(pair, line_load=tangential_line_load(pair, settings.pinion_torque))
    found.dataset.attrs |= {
        "contact_start": pair.contact_start,
        "contact_end": pair.contact_end,
        "pitch_point": pair.pitch_point,
        "line_lag": pair.face_width * math.tan(pair.base_helix_angle),
        "path_units": "m",
        "iso_mesh_stiffness": iso.mesh * pair.face_width,
        "iso_mesh_stiffness_units": "N/m",
        "iso_density": stiffness_density(iso.mesh, pair),
        "iso_density_units": "N/m2",
        "iso_outside": "; ".join(iso.outside) or "none",
    }
    return found


def _constant_density_stiffness(settings: HelicalSettings, density: float) -> xr.Dataset:
    """Return the stiffness of each line and of all with one density: [he_2007 fig. 4].

    Parameters
    ----------
    settings : HelicalSettings
    density : float
        [N/m2]

    Returns
    -------
    xarray.Dataset
        K_line_constant of dimensions (zone_phase, constant_line) along the line of action [N/m].
    """
    plane = settings.file.helical_pair().plane
    phase = np.arange(_PHASES + 1) / _PHASES
    lines = np.arange(int(line_count(plane)))
    length = np.array(
        [[_length(min(p, 1.0 - 1e-12), int(i), plane) for i in lines] for p in phase.tolist()]
    )
    stiffness = density * plane.cos_b**2 * length
    return xr.Dataset(
        {
            "K_line_constant": (
                ("zone_phase", "constant_line"),
                stiffness,
                {"units": "N/m", "long_name": "stiffness of a line with one density, along x"},
            )
        },
        coords={
            "zone_phase": ("zone_phase", phase, {"units": "1", "long_name": "mesh phase"}),
            "constant_line": labelled(
                "constant_line", lines, "1", "contact line by age, 0 enters at phase 0"
            ),
        },
    )


def _length(phase: float, line: int, plane: ContactPlane) -> float:
    segment = clip_line(line_position(phase, line, plane), plane)
    return float(segment_length(segment, plane))
