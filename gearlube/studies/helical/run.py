"""Run a study of a helical pair: from settings to datasets and line mesh; its flanks for CAD."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from gearlube.studies.helical.operating_point import study_attributes
from gearlube.studies.helical.pair_losses import losses_csv
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.studies.helical.stages import HelicalResults, RunningStudy, StageReport, stages_of
from gearlube.studies.helical.summary import summary_csv, summary_rows
from gearlube_core.errors import GearLubeError
from gearlube_core.helical_contact.tooth_body import half_angle, tooth_form
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.involute import MEMBERS
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.hypoid_geometry.flank.step_file import (
    COLUMNS,
    ROWS,
    SplineSurface,
    surface_through,
    write_step,
)
from gearlube_core.mesh_table.line_mesh_file import write_line_mesh
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.atomic_file import write_dataset, write_text

PARTS = "parts"  # subfolder for finished parts
_COMPUTING = 0.7  # share of the running time before files and figures


def run_helical(
    settings: HelicalSettings,
    *,
    folder: Path | None = None,
    store: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> HelicalResults:
    """Return contact, vibration, instability, separation, film and geometry of a helical pair.

    After KeyboardInterrupt it returns what it has found so far.

    Parameters
    ----------
    settings : HelicalSettings
    folder : Path, optional
        Folder for the results of `write_helical`.
    store : Path, optional
        Folder for finished parts: after a stop the same call continues. Default: `parts` in
        `folder`.
    jobs : int, optional
        Number of processes; default: all processors.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    GearLubeError
        The loaded contact, whose mesh all other parts need, failed. Failures of other parts are in
        `failures`.

    Examples
    --------
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> settings = HelicalSettings(
    ...     file=HelicalGearFile.named("jamali_2015_a"), pinion_torque=1060.0, pinion_speed=235.6,
    ...     parts="geometry",
    ... )
    >>> found = run_helical(settings)
    >>> list(found.datasets)
    ['geometry']
    >>> print(f"{found.datasets['geometry'].attrs['transverse_contact_ratio']:.2f}")
    1.55
    """
    if store is None and folder is not None:
        store = folder / PARTS
    results = _solved(settings, store, jobs, part_of(progress, 0.0, _COMPUTING))
    if folder is not None:
        progress(_COMPUTING, "stopped" if results.interrupted else "files and figures")
        write_helical(results, folder)
    if not results.interrupted:
        progress(1.0, "done")
    return results


def write_helical(results: HelicalResults, folder: Path) -> None:
    """Write NAME.nc for each dataset, line_mesh.nc, summary.csv, figures/ and report.html.

    A stopped study has no figures and no report.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name, dataset in results.datasets.items():
        write_dataset(dataset, folder / f"{name}.nc")
    if "losses" in results.datasets:
        write_text(losses_csv(results.datasets["losses"]), folder / "losses.csv")
    if results.mesh is not None:
        write_line_mesh(results.mesh, folder / "line_mesh.nc")
    write_text(summary_csv(summary_rows(results)), folder / "summary.csv")
    if not results.interrupted:
        results.report(folder)


def _solved(
    settings: HelicalSettings, store: Path | None, jobs: int | None, progress: Progress
) -> HelicalResults:
    study = RunningStudy(settings=settings, store=store, jobs=jobs)
    stages = stages_of(settings)
    total, before = sum(stage.cost for stage in stages), 0.0
    failures: dict[str, str] = {}
    interrupted = False
    try:
        for stage in stages:
            part = part_of(progress, before / total, (before + stage.cost) / total)
            report = StageReport(part, stage.name)
            report(0.0)
            try:
                stage.run(study, report)
            except GearLubeError as reason:
                if stage.needed:
                    raise
                failures[stage.name] = str(reason)
            before += stage.cost
    except KeyboardInterrupt:
        interrupted = True
    for dataset in study.datasets.values():
        dataset.attrs = study_attributes(settings) | dataset.attrs
    return HelicalResults(
        settings=settings,
        datasets=study.datasets,
        mesh=study.mesh,
        failures=failures,
        interrupted=interrupted,
    )


def write_gears(file: HelicalGearFile, folder: Path) -> list[Path]:
    """Write both flanks of one tooth of each member as FOLDER/MEMBER_flanks.step."""
    folder.mkdir(parents=True, exist_ok=True)
    pair = file.helical_pair()
    return [
        write_step(tooth_surfaces(pair, member), folder / f"{member}_flanks.step")
        for member in MEMBERS
    ]


def tooth_surfaces(pair: HelicalPair, member: str) -> dict[str, SplineSurface]:
    """Return the flanks of one tooth of the "pinion" or the "gear", without modifications.

    From the start of the involute to the tip, about the member's own axis, z, with mid-face at
    z = 0. The pinion's tooth points towards +y, the gear's towards -y.
    """
    form, start = tooth_form(pair, member), pair.involute_starts[MEMBERS.index(member)]
    s, t = np.linspace(0.0, 1.0, ROWS), np.linspace(0.0, 1.0, COLUMNS)
    tip = math.sqrt(form.tip_radius**2 - form.base_radius**2)
    roll = (start.roll + (tip - start.roll) * s)[:, None]
    z = ((t - 0.5) * pair.face_width)[None, :]
    radius = np.hypot(form.base_radius, roll)
    lead = z * math.tan(pair.base_helix_angle) / form.base_radius
    up = 1.0 if member == "pinion" else -1.0
    found = {}
    for name, side in (("drive", up), ("coast", -up)):
        angle = lead + side * half_angle(form, radius)
        points = [radius * np.sin(angle), up * radius * np.cos(angle), z + 0.0 * angle]
        found[f"{member} {name} flank"] = surface_through(np.stack(points, axis=-1), s, t)
    return found
