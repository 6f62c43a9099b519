"""Tooth contact of a hypoid pair: from a gear file to dataset and mesh table, and files for CAD."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import xarray as xr

from gearlube.report.inputs import file_inputs
from gearlube.report.page import write_report
from gearlube.report.parts import Cell, Column, Figure, Report, Table
from gearlube.report.pictures import pictured, save_pictures
from gearlube.report.result import Result, WithResult
from gearlube.studies.contact.figures.catalogue import CONTACT_CATALOGUE
from gearlube.studies.contact.figures.solid_view import solid_view
from gearlube.studies.contact.findings import contact_summary, findings, numbers
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_contact.mesh_cycle import SIDES
from gearlube_core.hypoid_geometry.flank import step_file
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import (
    FORMATS,
    gear_solid,
    mirror_image,
    tooth_solid,
    write_flank_csv,
    write_solid,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.atomic_file import write_dataset
from gearlube_core.storage.file_names import pair_stem
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE

_COMPUTING = 0.8  # share of the time before files and figures
_LIMITS = (
    "Quasi-static: the pair turns slowly. Vibration, friction and oil film are not in the contact.",
    "Teeth bend and tilt by finite elements; shafts, bearings and housing are rigid. Give "
    "misalignments for their deflection.",
    "Pressures are those of an elastic half-space on cells; at sharp edges they have no finite "
    "value.",
    "Orders above a quarter of the positions of a mesh period are not resolved.",
)

_COLUMNS = (
    Column("flanks"),
    Column("torque", "N·m"),
    Column("secant stiffness", "N/µm"),
    Column("tangent stiffness", "N/µm"),
    Column("pinion arm", "mm", 4),
    Column("pairs"),
    Column("highest pressure", "GPa"),
)

_MAIN = (
    "transmission_error",
    "pressure",
    "solid_view",
    "ease_off",
    "load_share",
    "stiffness_torque",
)
POSITIONS = "positions"  # folder of finished positions, in that of the results


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactResults(WithResult):
    """Results of a tooth contact analysis.

    Parameters
    ----------
    contact : xarray.Dataset
        Unloaded and loaded contact on both sides, see `contact_dataset`.
    mesh_table : MeshTable
        The same as the dynamics read it.
    """

    shown: ClassVar[str] = "contact"
    contact: Result
    mesh_table: MeshTable


def run_contact(
    file: HypoidGearFile,
    settings: ContactSettings,
    *,
    folder: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> ContactResults:
    """Return the tooth contact of a hypoid gear file, without and under load, and its mesh table.

    Parameters
    ----------
    file : HypoidGearFile
    settings : ContactSettings
    folder : Path, optional
        Folder for contact.nc, report.html, figures/ and the mesh table NAME.nc. Finished positions
        are kept in its folder `positions`: after a stop the same call continues.
    jobs : int, optional
        Number of processes; default: all processors.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        A flank is missing or the flanks do not meet.
    ConvergenceError
        A position finds no equilibrium.
    TableError
        At some torque more tooth pairs carry load than a mesh table can hold. All other results are
        written before.

    Examples
    --------
    >>> from gearlube.studies.contact.settings import QUICK
    >>> found = run_contact(HypoidGearFile.named("mohammadpour_2015"), QUICK)  # doctest: +SKIP
    >>> float(found.contact["k_m"].sel(side="drive", torque=50.0).mean())  # doctest: +SKIP
    """
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    store = None if folder is None else folder / POSITIONS
    dataset = Result.of(
        analyse_contact(
            file, settings, store=store, jobs=jobs, progress=part_of(progress, 0.0, _COMPUTING)
        ),
        "contact",
    )
    if folder is not None:
        progress(_COMPUTING, "writing report and figures")
        write_dataset(dataset, folder / "contact.nc")
        save_pictures(CONTACT_CATALOGUE, folder / "figures", dataset)
        write_report(contact_report(dataset, folder / "figures"), folder)
    results = ContactResults(contact=dataset, mesh_table=contact_table(file, dataset))
    if folder is not None:
        write_mesh_table(results.mesh_table, folder / f"{pair_stem(file.name)}.nc")
    progress(1.0, "done")
    return results


def contact_report(contact: xr.Dataset, figures: Path) -> Report:
    """Return the report of a contact analysis; `figures` is the folder of its pictures."""
    attributes = contact.attrs
    torques = ", ".join(f"{one:g}" for one in contact["torque"].values)
    return Report(
        study="contact",
        title=f"Tooth contact of the hypoid pair {attributes['name']}",
        subtitle=f"{attributes['pinion_teeth']} and {attributes['gear_teeth']} teeth, drive and "
        f"coast flanks, {contact.sizes['phase']} positions of a mesh period at {torques} N·m on "
        "the pinion.",
        findings=findings(contact),
        numbers=numbers(contact),
        main_figures=_MAIN,
        figures=[_solid(contact), *pictured(CONTACT_CATALOGUE, figures)],
        tables=[_table(contact)],
        inputs=file_inputs(HypoidGearFile.model_validate_json(attributes["gear_file"])),
        limits=_LIMITS,
        facts=[("source", str(attributes["source"]))] if attributes["source"] else [],
        files=(f"{pair_stem(attributes['name'])}.nc", "contact.nc", "figures/"),
    )


def _solid(contact: xr.Dataset) -> Figure:
    torque = float(contact["torque"][-1])
    return Figure(
        name="solid_view",
        title="The pair in mesh",
        caption=f"Pinion (see-through) and gear, drive flanks at {torque:g} N·m. Turn it with the "
        "mouse; the slider goes through a mesh period. Yellow: high pressure, cut at the end of "
        "the scale where edges press. The contact runs over each tooth; several share the load.",
        chart=solid_view(contact),
    )


def _table(contact: xr.Dataset) -> Table:
    rows: list[list[Cell]] = [
        [
            one.side,
            one.torque,
            1e-6 * one.secant_stiffness,
            1e-6 * one.tangent_stiffness,
            1e3 * one.pinion_arm,
            one.pairs,
            1e-9 * one.highest_pressure if one.highest_pressure < EDGE_PRESSURE else None,
        ]
        for one in contact_summary(contact)
    ]
    return Table(
        title="Loaded contact",
        columns=_COLUMNS,
        rows=rows,
        caption="Means over the mesh; the pressure is the highest of it. –: a sharp edge presses, "
        "whose pressure has no finite value.",
    )


ROLES: tuple[Role, Role] = ("pinion", "gear")


def write_gears(file: HypoidGearFile, folder: Path) -> list[Path]:
    """Write each flank as CSV, those of a tooth as STEP, each tooth and gear as STL and GLB.

    All are of the hand of the file: with a left-handed pinion they are mirrored, y -> -y.
    """
    folder.mkdir(parents=True, exist_ok=True)
    mirrored, files = file.pair.pinion_hand == "left", []
    for role in ROLES:
        tooth = Tooth.from_file(file, role)
        for side in SIDES:
            flank, path = Flank.from_file(file, role, side), folder / f"{role}_{side}.csv"
            files.append(write_flank_csv(flank, path, mirrored=mirrored))
        surfaces = step_file.tooth_surfaces(tooth)
        if mirrored:
            surfaces = {name: step_file.mirror_image(one) for name, one in surfaces.items()}
        files.append(step_file.write_step(surfaces, folder / f"{role}_flanks.step"))
        for name, solid in ((f"{role}_tooth", tooth_solid(tooth)), (role, gear_solid(tooth))):
            one = mirror_image(solid) if mirrored else solid
            files += [write_solid(one, folder / f"{name}.{kind}") for kind in FORMATS]
    return files
