"""Optimise the shipped problems for docs/optimise.md: python -m docs.optimise.make FOLDER [NAME].

Some minutes for each. Results are kept in FOLDER, where a run that was stopped goes on. Figures go
to docs/images, tables to this folder; then the page is written.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from docs.optimise.page import HERE
from docs.optimise.page import main as write_page
from docs.page import IMAGES, Page
from gearlube.output.csv_text import csv_text
from gearlube.studies.optimise.dataset import measure_rows, unit_of
from gearlube.studies.optimise.run import run_optimise
from gearlube_core.flank_optimisation.optimise import Optimised, OptimiseSettings
from gearlube_core.flank_optimisation.problem import values_of
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.storage.atomic_file import write_text


def make(name: str, folder: Path) -> None:
    """Optimise a shipped problem and keep its tables and figures."""
    given = OptimisationFile.named(name)
    hypoid = name == "hypoid"
    settings = OptimiseSettings(nominal=not hypoid, front=4 if hypoid else 5)
    results = run_optimise(given, settings, folder=folder / name)
    found = results.optimised
    write_text(_measures(found), HERE / f"{name}.csv")
    if name == "helical":
        write_text(_values(found), HERE / f"{name}_values.csv")
    if hypoid:
        rows = [(f"{one.whine:.4f}", f"{one.loss:.4f}") for one in found.front]
        write_text(csv_text(("whine", "loss"), rows), HERE / f"{name}_front.csv")
    for path in (folder / name / "figures").glob("*.png"):
        if f"optimise_{name}_{path.name}" in Page("optimise").text:
            shutil.copy(path, IMAGES / f"optimise_{name}_{path.name}")


def _measures(found: Optimised) -> str:
    after = {row[:3]: row.after for row in measure_rows(found)}
    nominal = after
    if found.nominal is not None:
        rows = measure_rows(found, found.nominal.checked)
        nominal = {row[:3]: row.after for row in rows}
    rows = [
        (
            f"{row.torque:g}",
            row.what,
            row.unit,
            f"{row.before:.4g}",
            f"{row.after:.4g}",
            row.change,
            f"{nominal[row[:3]]:.4g}",
            "" if row.limit is None else "kept" if row.is_kept else "not kept",
        )
        for row in measure_rows(found)
    ]
    return csv_text(
        ("torque", "what", "unit", "before", "after", "change", "nominal", "limit"), rows
    )


def _values(found: Optimised) -> str:
    problem = found.problem
    before = values_of(problem.file, problem.names)
    rows = [
        (
            name,
            "" if old != old else f"{old:.6g}",
            f"{new:.6g}",
            f"{low:g}",
            f"{high:g}",
            unit_of(name),
        )
        for name, old, new, low, high in zip(
            problem.names, before, found.better.values, problem.low, problem.high, strict=True
        )
    ]
    return csv_text(("field", "before", "after", "low", "high", "unit"), rows)


if __name__ == "__main__":
    for one in sys.argv[2:] or OptimisationFile.shipped():
        make(one, Path(sys.argv[1]))
    write_page()
