"""Design a pair: from a blank file to a gear file, a report and a dataset."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import xarray as xr

from gearlube.output.toml_text import toml_text
from gearlube.report.inputs import stored_inputs
from gearlube.report.page import write_report
from gearlube.report.parts import Cell, Column, Report, Table
from gearlube.report.pictures import pictured, save_pictures
from gearlube.report.result import Result, WithResult
from gearlube.studies.design.dataset import design_dataset
from gearlube.studies.design.figures import DESIGN_CATALOGUE
from gearlube.studies.design.findings import findings, numbers
from gearlube.studies.design.problem import PROBLEM, problem_text
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.design import Design, design_pair
from gearlube_core.hypoid_design.pinion_fit import SIDES
from gearlube_core.hypoid_geometry.flank.tooth_form import ToothForm, tooth_form
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.atomic_file import write_dataset, write_text
from gearlube_core.storage.file_names import pair_stem
from gearlube_core.units import DEGREE, MILLIMETRE

_MICRO = 1e-6

_LIMITS = (
    "Contact without load of flanks as cut. `gearlube contact` computes it under load, with teeth "
    "that bend and reliefs.",
    "Blank by ISO 23509 with uniform depth; strength of the teeth is not checked.",
    "The settings are the nearest that the search found; others may exist.",
    "Undercut, topland and slot are those of ideal cutters with sharp points.",
)

_ASKED = (
    ("error", "transmission error", "µrad", _MICRO),
    ("path_angle", "path direction", "°", DEGREE),
    ("length", "ellipse length", "mm", MILLIMETRE),
    ("s", "mean contact, s", "", 1.0),
    ("t", "mean contact, t", "", 1.0),
)

_SHARE = 0.8  # of the time for settings and relief


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignResults(WithResult):
    """Results of a design.

    Parameters
    ----------
    design : Design
    forms : dict of str to ToothForm
        Of "pinion" and "gear".
    dataset : xarray.Dataset
        Unloaded contact and widths of the teeth, see `design_dataset`.
    """

    design: Design
    forms: dict[str, ToothForm]
    dataset: Result
    shown: ClassVar[str] = "dataset"


def run_design(
    file: BlankFile,
    *,
    folder: Path | None = None,
    jobs: int | None = 1,
    progress: Progress = no_progress,
) -> DesignResults:
    """Return the hypoid or bevel pair designed from a blank file, with its unloaded contact.

    Parameters
    ----------
    file : BlankFile
    folder : Path, optional
        Folder for the results of `write_design`, which are written at the end.
    jobs : int, optional
        Processes for the elastic teeth, which the relief needs; None: all processors.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        The blank cannot exist, or no settings were found with which the flanks touch as wanted.

    Examples
    --------
    >>> found = run_design(BlankFile.named("hypoid_13_42"))  # doctest: +SKIP
    >>> found.design.file.pinion.machine.tilt_angle_deg  # doctest: +SKIP
    """
    design = design_pair(file, part_of(progress, 0.0, _SHARE), jobs)
    progress(_SHARE, "form of the teeth")
    forms = {"pinion": tooth_form(design.file, "pinion"), "gear": tooth_form(design.file, "gear")}
    progress(0.88, "ease-off and contact pattern")
    results = DesignResults(
        design=design, forms=forms, dataset=Result.of(design_dataset(design, forms), "design")
    )
    if folder is not None:
        progress(0.92, "writing report and figures")
        write_design(results, folder)
    progress(1.0, "done")
    return results


def axle_stub(name: str) -> str:
    """Return an axle file of the pair, as TOML, for the user to complete."""
    return f"""# The axle of this pair, to complete: bearings, oil, car. What is not here is
# assumed: `gearlube axle show axle.toml` lists it. `gearlube sweep --example`
# prints every field.

name = "{name}"
source = "gears designed by gearlube"

[gear_set]
gear_file = "{name}.toml"      # its loaded contact is analysed once, some minutes
# mesh_table = "contact/{name}.nc"   # in place of gear_file, if `gearlube contact` has written it
"""


def write_design(results: DesignResults, folder: Path) -> Path:
    """Write gear file, axle.toml, problem.toml, report, design.nc, figures/; return the first."""
    folder.mkdir(parents=True, exist_ok=True)
    file = results.design.file
    path = folder / f"{pair_stem(file.name)}.toml"
    write_text(toml_text(file.model_dump(exclude_defaults=True)), path)
    write_text(axle_stub(pair_stem(file.name)), folder / "axle.toml")
    write_text(problem_text(results.design), folder / PROBLEM)
    write_dataset(results.dataset, folder / "design.nc")
    save_pictures(DESIGN_CATALOGUE, folder / "figures", results.dataset)
    report = design_report(results.dataset, folder / "figures")
    write_report(report, folder)
    return path


def design_report(dataset: xr.Dataset, figures: Path) -> Report:
    """Return the report of a design; `figures` is the folder of its pictures."""
    attributes = dataset.attrs
    return Report(
        study="design",
        title=f"Designed pair {attributes['name']}",
        subtitle=f"Blank by ISO 23509, method {attributes['method']}, uniform depth. Gear "
        f"{attributes['cut']}, pinion generated with cutter tilt.",
        findings=findings(dataset),
        numbers=numbers(dataset),
        figures=pictured(DESIGN_CATALOGUE, figures),
        tables=[_contact(dataset), _teeth(dataset), _blank(dataset), _settings(dataset)],
        inputs=stored_inputs(attributes, "inputs"),
        limits=_LIMITS,
        files=(
            f"{pair_stem(attributes['name'])}.toml",
            "axle.toml",
            "problem.toml",
            "design.nc",
            "figures/",
        ),
    )


def _contact(dataset: xr.Dataset) -> Table:
    rows: list[list[Cell]] = []
    for side in SIDES:
        part = dataset.sel(side=side)
        for name, words, unit, scale in _ASKED:
            asked, found = (float(part[f"{one}_{name}"]) / scale for one in ("asked", "found"))
            rows.append([side, words, _text(asked), _text(found), unit])
        centre = float(part["missed_centre"]) / MILLIMETRE
        relieved = float(part["relieved_error"]) / _MICRO
        rows += [
            [side, "mean contact off by", "", _text(centre), "mm"],
            [side, "transmission error with relief", "", _text(relieved), "µrad"],
            [side, "path of contact", "", _text(float(part["path_contact_ratio"])), "pitches"],
        ]
    return Table(
        title="Contact: wanted and found",
        caption="Path directions on the gear flank, from the root line towards the heel and "
        "positive towards the tip. s: root 0 to tip 1; t: toe 0 to heel 1.",
        columns=[Column(one) for one in ("flanks", "", "asked", "found", "unit")],
        rows=rows,
    )


def _text(value: float) -> str:
    return "none" if math.isnan(value) else f"{value:.4g}"


def _teeth(dataset: xr.Dataset) -> Table:
    rows: list[list[Cell]] = []
    for member in dataset["member"].values:
        part = dataset.sel(member=member)
        for name, words in (("topland", "topland"), ("slot", "slot at the root")):
            width = part[name].values / MILLIMETRE
            rows.append(
                [str(member), f"{words}, toe to heel", f"{width[0]:.2f} to {width[-1]:.2f} mm"]
            )
        rows.append(
            [
                str(member),
                "blade points at most",
                f"{float(part['slot'].min()) / MILLIMETRE:.2f} mm",
            ]
        )
        for side in SIDES:
            deepest = float(part["undercut"].sel(side=side))
            cut = "none" if math.isnan(deepest) else f"below s = {deepest:.2f}"
            rows.append([str(member), f"undercut of the {side} flank", cut])
        rows.append([str(member), "reach of the mate's tip, s", f"{float(part['active']):.2f}"])
    return Table(title="Teeth", columns=[Column("member"), Column(""), Column("value")], rows=rows)


def _blank(dataset: xr.Dataset) -> Table:
    return Table(
        title="Blank",
        columns=[Column("what"), Column("value"), Column("unit")],
        rows=[
            [field, value, unit] for field, value, unit, *_ in json.loads(dataset.attrs["blank"])
        ],
        folded=True,
    )


def _settings(dataset: xr.Dataset) -> Table:
    return Table(
        title="Machine settings and cutters",
        columns=[Column("field"), Column("value"), Column("origin")],
        rows=json.loads(dataset.attrs["settings"]),
        caption="As in the gear file.",
        folded=True,
    )
