"""The report of a tooth contact analysis: findings, figures, table, inputs, limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.report.inputs import file_inputs
from gearlube.report.page import write_report
from gearlube.report.parts import Cell, Column, Figure, Report, Table
from gearlube.report.pictures import pictured
from gearlube.studies.contact.figures.catalogue import CONTACT_CATALOGUE
from gearlube.studies.contact.figures.charts import (
    load_share_chart,
    stiffness_chart,
    transmission_chart,
)
from gearlube.studies.contact.figures.solid_view import solid_view
from gearlube.studies.contact.findings import findings, numbers
from gearlube.studies.contact.summary import contact_summary
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.file_names import pair_stem

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


def write_contact_report(contact: xr.Dataset, folder: Path | str, command_line: str = "") -> Path:
    """Write report.html beside the figures that lie in FOLDER/figures; return its path.

    Examples
    --------
    >>> contact = xr.load_dataset("gearlube_contact/contact.nc")  # doctest: +SKIP
    >>> write_contact_report(contact, "gearlube_contact")  # doctest: +SKIP
    """
    folder = Path(folder)
    return write_report(contact_report(contact, folder / "figures", command_line), folder)


def contact_report(contact: xr.Dataset, figures: Path, command_line: str = "") -> Report:
    """Return the report of a contact analysis; `figures` is the folder of its pictures."""
    attributes = contact.attrs
    torques = ", ".join(f"{one:g}" for one in contact["torque"].values)
    charts: dict[str, Any] = {
        "transmission_error": transmission_chart(contact),
        "load_share": load_share_chart(contact),
        "stiffness_torque": stiffness_chart(contact),
    }
    return Report(
        study="contact",
        title=f"Tooth contact of the hypoid pair {attributes['name']}",
        subtitle=f"{attributes['pinion_teeth']} and {attributes['gear_teeth']} teeth, drive and "
        f"coast flanks, {contact.sizes['phase']} positions of a mesh period at {torques} N·m on "
        "the pinion.",
        findings=findings(contact),
        numbers=numbers(contact),
        figures=[_solid(contact), *pictured(CONTACT_CATALOGUE, figures, charts)],
        tables=[_table(contact)],
        inputs=file_inputs(HypoidGearFile.model_validate_json(attributes["gear_file"])),
        limits=_LIMITS,
        facts=[
            (name, text)
            for name, text in (("command", command_line), ("source", str(attributes["source"])))
            if text
        ],
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
            1e-9 * one.highest_pressure,
        ]
        for one in contact_summary(contact)
    ]
    return Table(
        title="Loaded contact",
        columns=_COLUMNS,
        rows=rows,
        caption="Means over the mesh; the pressure is the highest of it.",
    )
