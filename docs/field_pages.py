"""Rewrite the tables of fields in the pages of input files: python -m docs.field_pages.

Also fields.json, by which a command refuses a wrong field before it imports what computes.

All text stands in the pages. A table follows a heading that begins with its section in brackets;
a heading without brackets has the fields outside all sections. Some tables are of other numbers of
the package.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from docs.measured_file.make import lines_rows
from docs.page import Page
from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.read_axle import read_axle
from drivetrain.train.part_section import BODIES, contact_section, files_in, section_of
from drivetrain.train.train_file import TrainFile
from fmu_src.axle_arguments import start_arguments
from fmu_src.variables import HYPOID_AXLE
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.dynamics.train.part import ELEMENTS
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile
from gearlube_core.input_file.early_check import FIELDS
from gearlube_core.input_file.field_notes import FieldNote, field_notes
from gearlube_core.input_file.field_units import attribute_of
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.oil.base_oils import (
    BASE_OILS,
    BOUNDARY_FRICTION,
    BOUNDARY_STRESS,
    EYRING_FACTOR,
    GIVEN_LIMIT_FACTOR,
    HIGH_PRESSURE_FACTOR,
    MEASURED_ALPHA_FACTOR,
    VISCOMETER_FACTOR,
)
from gearlube_core.oil.lubricant import lubricant_names
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.oil.oil_file import OilFile, read_oil

# a page and its model, or those of its chapters "## Fields" in their order
PAGES: dict[str, tuple[type[InputFile], ...]] = {
    "axle_file": (AxleFile,),
    "bearing": (BearingFile,),
    "blank_file": (BlankFile,),
    "ehl_case_file": (LineCase, LineCase, PointCase, HypoidCase, RoughCase),
    "gear_file": (HypoidGearFile,),
    "helical_gear_file": (HelicalGearFile,),
    "measured_file": (MeasuredFile,),
    "oil_file": (OilFile,),
    "problem_file": (OptimisationFile,),
    "train_file": (TrainFile,),
}
_AGAIN = "As above: "
_MANY = 3  # rows that are not written again
_TABLE = re.compile(
    rf"(?<=^### )(.*\n\n\| Field \| Value \|.*\n.*\n)(?:\|.*\n)+(?:\n{_AGAIN}.*\n)?", re.MULTILINE
)
_CLASS = "by class"
_OIL_DEFAULTS = {
    "density_temperature_degc": "15",
    "density_slope_kg_m3_k": _CLASS,
    "viscosity_40_degc_mm2_s": "inferred",
    "viscosity_100_degc_mm2_s": "inferred",
    "viscosity_index": "inferred",
    "alpha_per_gpa": "inferred",
    "alpha_is": "film, of an estimate mean",
    "alpha_pressure_gpa": "0.2",
    "alpha_temperature_degc": "40",
    "alpha_factor": f"{MEASURED_ALPHA_FACTOR:g}, of an estimate by class",
    "high_pressure_factor": f"{HIGH_PRESSURE_FACTOR:g}; {VISCOMETER_FACTOR:g} with viscometer, "
    "more without alpha",
    "eyring_stress_mpa": "inferred",
    "eyring_stress_factor": f"{EYRING_FACTOR:g}, of an estimate that of Lambda",
    "limiting_coefficient": _CLASS,
    "limiting_coefficient_factor": f"{GIVEN_LIMIT_FACTOR:g}, of an estimate by class",
    "limiting_shear_stress_mpa": f"{1e-6 * BOUNDARY_STRESS:g}",
    "boundary_friction": f"{BOUNDARY_FRICTION:g}",
    "conductivity_w_m_k": _CLASS,
    "viscosity_law": _CLASS,
    "heat_capacity_j_kg_k": _CLASS,
    "temperature_low_degc": "0",
    "temperature_high_degc": "150",
}
# fields of the axle file that set an argument of the FMU's model under another name
_ARGUMENTS = {
    "bearing_preload": "pinion.bearing.preload_n",
    "oil": "oil",
    "pinion_seal_torque": "seals.pinion_torque_n_m",
    "wheel_seal_torque": "seals.wheel_torque_n_m",
    "hub_torque": "seals.hub_torque_n_m",
    "rolling": "model.flank_rolling",
    "film": "film.model",
    "film_limiting_slope": "film.limiting_slope",
    "bearing_approach": "model.bearing_approach",
}


def refreshed(name: str) -> Page:
    """Return a page with all its tables as the package has them now."""
    page = Page(name)
    defaults = _DEFAULTS[name]() if name in _DEFAULTS else {}
    if len(PAGES[name]) == 1:
        text, chapters = "", [page.text]
    else:
        text, *chapters = re.split(r"^(?=## Fields)", page.text, flags=re.MULTILINE)
    seen: set[str] = set()
    for model, chapter in zip(PAGES[name], chapters, strict=True):
        notes = field_notes(model) | _OTHER_NOTES.get(name, dict)()
        text += _TABLE.sub(lambda found: found[1] + _rows(found[1], notes, defaults, seen), chapter)  # noqa: B023
    page.text = text
    if name in _OTHER_TABLES:
        _OTHER_TABLES[name](page)
    return page


def _rows(
    heading: str, notes: Mapping[str, FieldNote], defaults: Mapping[str, str], seen: set[str]
) -> str:
    """Return the rows of a section; of those that the page has already, the names alone."""
    bracket = re.match(r'\[([\w.]+)\](?:, kind = "(\w+)")?(?: with (\w+))?', heading)
    section = ".".join(filter(None, bracket.groups())) if bracket else ""
    rows = {}
    for name, note in notes.items():
        if name.rpartition(".")[0] == section:
            value = note.limits or note.kind  # a range is that of a number, names are texts
            if note.limits and note.kind not in ("number", "text"):
                value = f"{note.kind}, {note.limits}"
            if note.unit:
                value += f" {note.unit}" if note.limits else f" in {note.unit}"
            if note.usual is not None:
                value += f"; usual {note.usual[0]:g} to {note.usual[1]:g}"
            field, default = name.rpartition(".")[2], defaults.get(name, note.default) or "required"
            rows[field] = f"| `{field}` | {value} | {default} | {note.meaning} |\n"
    again = [field for field, row in rows.items() if row in seen]
    again = again if _MANY <= len(again) < len(rows) else []
    seen.update(rows.values())
    text = "".join(row for field, row in rows.items() if field not in again)
    return text + (f"\n{_AGAIN}{', '.join(f'`{one}`' for one in again)}.\n" if again else "")


def _axle_defaults() -> dict[str, str]:
    bare = AxleFile.from_data({"gear_set": {"mesh_table": "mohammadpour_2015"}}, "the page")
    assumed = bare.car_axle().assumed
    defaults = {note.field: note.value_text for note in assumed if note.origin == "assumed"}
    for key in ("mass_kg", "inertia_kg_m2"):
        defaults[f"pinion.{key}"] += f", gear {defaults[f'gear.{key}']}"
    return defaults


def _run_time_parameters(page: Page) -> None:
    """Put in which fields of the axle file are parameters of the FMU."""
    fields: dict[str, str] = {}
    for name in field_notes(AxleFile):
        section, _, key = name.rpartition(".")
        prefix = "" if section in ("gear_set", "housing", "model") else f"{section}."
        fields[prefix + attribute_of(key)] = name
    starts = start_arguments(read_axle("mohammadpour_2015").axle)
    rows = []
    for one in HYPOID_AXLE:
        if one.argument in starts:
            role, _, rest = one.argument.partition("_")
            names = (one.argument, f"{role}.{rest.replace('bearing_', 'bearing.')}")
            field = _ARGUMENTS.get(one.argument) or next(fields[n] for n in names if n in fields)
            rows.append([f"`{one.name}`", f"`{field}`"])
    page.rows("Parameter | Input", rows)


def _oils(page: Page) -> None:
    """Put in the classes of base oils with their sources, and the shipped oils."""
    classes: list[list[str]] = []
    sources: dict[str, list[str]] = {}  # of which values, by source
    for name, base in BASE_OILS.items():
        parts = {
            "limiting coefficient": (base.limiting_coefficient, ""),
            "conductivity": (base.conductivity, " W/(m.K)"),
            "heat capacity": (base.heat_capacity, " J/(kg.K)"),
            "density slope": (base.density_slope, " kg/(m3.K)"),
        }
        cells = [f"{one.value:g}{unit}, {one.factor:g}" for one, unit in parts.values()]
        classes.append([f"`{name}`", base.words, *cells, f"factor {base.alpha.factor:g}"])
        for words, (one, _) in parts.items():
            sources.setdefault(one.why, []).append(f"{words} (`{name}`)")
    page.rows("`base_oil` | | Limiting", classes)
    listed = "\n".join(f"- {', '.join(values)}: {why}" for why, values in sources.items())
    page.paragraph("Sources:", listed)
    page.fill("A number for the Eyring stress: factor {}. Values of", f"{EYRING_FACTOR:g}")
    oils = []
    for name in (*lubricant_names(), *OilFile.shipped()):
        described = read_oil(name)
        oil = described.lubricant
        cold, hot = (lubricant_state(oil.parameters(), 273.15 + t) for t in (40.0, 100.0))
        stress = next(n for n in described.inputs if n.field.startswith("eyring_stress"))
        viscosity = f"{1e6 * cold.nu:.3g} / {1e6 * hot.nu:.3g}"
        own = f"{1e-6 * oil.eyring_stress:.3g}, {stress.origin}"
        oils.append([f"`{name}`", viscosity, f"{1e9 * cold.alpha:.1f}", own, described.source])
    page.rows("Name | nu 40", oils)


def _train_parts() -> dict[str, FieldNote]:
    """Return the fields of all kinds of bodies and elements."""
    bodies = {f"bodies.NAME.{kind}": one for kind, one in BODIES.items()}
    shipped = {f"elements.NAME.{kind}": one for kind, one in ELEMENTS.known().items()}
    sections = {name: section_of(kind) for name, kind in (bodies | shipped).items()}
    sections["elements.NAME.gear_mesh.gear_file"] = contact_section()
    return {
        f"{section}.{name}": note
        for section, model in sections.items()
        for name, note in field_notes(model).items()
        if name != "kind"
    }


def _spectrum(page: Page) -> None:
    page.rows("Order of the pinion | | Teeth alike", lines_rows())


_DEFAULTS = {"axle_file": _axle_defaults, "oil_file": lambda: _OIL_DEFAULTS}
_OTHER_NOTES = {"train_file": _train_parts}
_OTHER_TABLES = {
    "axle_file": _run_time_parameters,
    "measured_file": _spectrum,
    "oil_file": _oils,
}

FIELDS_FILE = Path(str(files("gearlube_core.input_file") / FIELDS))


def fields_text() -> str:
    """Return fields.json as the package has it now: a line for each kind of file."""
    kinds = {model.__name__: model for models in PAGES.values() for model in models}
    known = ELEMENTS.known()
    shipped = {kind: one for kind, one in known.items() if one.__module__.startswith("gearlube_")}
    lines = []
    for name, model in kinds.items():
        parts: dict[str, Any] = {}
        if model is TrainFile:
            parts = {
                section: {
                    kind: section_of(one).model_json_schema() | {"files": files_in(one)}
                    for kind, one in known.items()
                }
                for section, known in (("bodies", BODIES), ("elements", shipped))
            }
        kind = {"package": model.package, "prefix": model.prefix, "title": model.title,
                "files": model.files, "unmodelled": dict(model.unmodelled),
                "schema": model.model_json_schema(), "parts": parts}  # fmt: skip
        text = json.dumps(_without_titles(kind), separators=(",", ":"), default=float)
        lines.append(f"{json.dumps(name)}:{text}")
    return "{" + ",\n".join(lines) + "}\n"


def _without_titles(part: Any, *, names: bool = True) -> Any:
    """Return a schema without the titles of its fields; keys may be `names` of fields."""
    if isinstance(part, list):
        return [_without_titles(one, names=False) for one in part]
    if not isinstance(part, dict):
        return part
    return {
        key: _without_titles(one, names=key in ("properties", "$defs"))
        for key, one in part.items()
        if names or key != "title"
    }


if __name__ == "__main__":
    FIELDS_FILE.write_text(fields_text(), encoding="utf-8")
    for each in PAGES:
        refreshed(each).write()
