"""Design a pair: from a blank file to a gear file, a report and a dataset."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import xarray as xr

from gearlube.output.toml_text import toml_text
from gearlube.report.pictures import save_pictures
from gearlube.studies.design.dataset import design_dataset
from gearlube.studies.design.figures import DESIGN_CATALOGUE
from gearlube.studies.design.problem import PROBLEM, problem_text
from gearlube.studies.design.report import write_design_report
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.design import Design, design_pair
from gearlube_core.hypoid_geometry.flank.tooth_form import ToothForm, tooth_form
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_text
from gearlube_core.storage.file_names import pair_stem

_SHARE = 0.9  # of the time for the settings


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignResults:
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
    dataset: xr.Dataset


def run_design(
    file: BlankFile,
    *,
    folder: Path | None = None,
    jobs: int | None = 1,
    progress: Progress = no_progress,
    command_line: str = "",
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
    command_line : str
        Command that the report shows.

    Raises
    ------
    ParameterError
        The blank cannot exist, or no settings were found with which the flanks touch as wanted.

    Examples
    --------
    >>> found = run_design(BlankFile.named("hypoid_13_42"))  # doctest: +SKIP
    >>> found.design.file.pinion.machine.tilt_angle_deg  # doctest: +SKIP
    """
    design = design_pair(file, lambda share, said: progress(_SHARE * share, said), jobs)
    progress(_SHARE, "form of the teeth")
    forms = {
        "pinion": tooth_form(design.file, "pinion"),
        "gear": tooth_form(design.file, "gear"),
    }
    progress(_SHARE + 0.02, "ease-off and contact pattern")
    results = DesignResults(design=design, forms=forms, dataset=design_dataset(design, forms))
    if folder is not None:
        progress(0.98, "writing report and figures")
        write_design(results, folder, command_line)
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


def write_design(results: DesignResults, folder: Path, command_line: str = "") -> Path:
    """Write gear file, axle.toml, problem.toml, report, design.nc, figures/; return the first."""
    folder.mkdir(parents=True, exist_ok=True)
    file = results.design.file
    path = folder / f"{pair_stem(file.name)}.toml"
    write_text(toml_text(file.model_dump(exclude_defaults=True)), path)
    write_text(axle_stub(pair_stem(file.name)), folder / "axle.toml")
    write_text(problem_text(results.design), folder / PROBLEM)
    write_dataset(results.dataset, folder / "design.nc")
    save_pictures(DESIGN_CATALOGUE, folder / "figures", results.dataset)
    write_design_report(results.dataset, folder, command_line)
    return path
