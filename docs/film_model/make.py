"""Rewrite docs/film_model.md and its figures: python -m docs.film_model.make [TESTS.csv].

Reads the model in the package and what `gearlube film-model fit` wrote beside it, by default
docs/film_model/tests.csv; a table that is given is kept there. Seconds; nothing is solved.
"""

from __future__ import annotations

import csv
import shutil
import sys
from pathlib import Path
from typing import Any

import numpy as np

from docs.film_model.pictures import errors_picture, parity_picture
from gearlube.studies.film_model.draws import ANYWHERE
from gearlube.studies.film_model.limiting import limit_in_words
from gearlube.studies.film_model.samples import axle_contacts
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_film
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.oil_file import read_oil

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
PAGE = ROOT / "docs" / "film_model.md"
KEPT = HERE / "tests.csv"
MODEL = "hypoid_flank"
_INSTANTS = 4000  # of the axle
KINDS = {"fresh": "axle", "calibration": "box"}
Tests = dict[str, dict[str, Array]]  # kind: column: values


def read_tests(path: Path) -> Tests:
    """Return the columns of the table of tests by kind."""
    with path.open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    return {
        kind: {
            name: np.array([float(row[name]) for row in rows if row["kind"] == kind])
            for name in rows[0]
            if name != "kind"
        }
        for kind in KINDS
    }


def errors(columns: dict[str, Array]) -> tuple[Array, Array]:
    """Return relative errors of film and friction [%]."""
    film = columns["film_model_m"] / columns["film_solved_m"]
    friction = columns["friction_model"] / columns["friction_solved"]
    return 100.0 * (film - 1.0), 100.0 * (friction - 1.0)


def numbers(model: FilmModel, tests: Tests) -> dict[str, str]:
    """Return all numbers of the page as text."""
    limits = limit_in_words(tests["fresh"]["friction_solved"], "films that the axle visits")
    return {
        **_of_model(model),
        **inside_shares(model),
        **error_numbers(model, tests, KINDS),
        "limits": limits,
    }


def error_numbers(model: FilmModel, tests: Tests, kinds: dict[str, str]) -> dict[str, str]:
    """Return bounds [%] and errors [%] of the kinds of contacts, under their short names."""
    bounds = (100.0 * model.film_bound, 100.0 * model.friction_bound)
    found = {"film_bound": f"{bounds[0]:.2f}", "mu_bound": f"{bounds[1]:.2f}"}
    for kind, short in kinds.items():
        found[f"{short}_count"] = str(tests[kind]["film_model_m"].size)
        for name, miss, bound in zip(("film", "mu"), errors(tests[kind]), bounds, strict=True):
            found[f"{short}_{name}_rms"] = f"{np.sqrt((miss**2).mean()):.2f}"
            found[f"{short}_{name}_p95"] = f"{np.quantile(np.abs(miss), 0.95):.2f}"
            found[f"{short}_{name}_max"] = f"{np.abs(miss).max():.2f}"
            over = int((np.abs(miss) > bound).sum())
            found[f"{short}_{name}_over"] = f"{over} ({100.0 * over / miss.size:.1f} %)"
    return found


def _of_model(model: FilmModel) -> dict[str, Any]:
    p = model.provenance
    solves = p["solves"]
    return {
        "box": solves["box"] + solves["edge"],
        "edge": solves["edge"],
        "axle": solves["axle"],
        "calibration": solves["calibration"],
        "fresh": solves["fresh"],
        "all_box": solves["box"] + solves["edge"] + solves["calibration"],
        "fine": p["fine_solves"],
        "failed": p["failed"],
        "points": p["fit"]["points"],
        "grid_film": f"{p['grid_error_left_percent'][0]:.2f}",
        "grid_mu": f"{p['grid_error_left_percent'][1]:.2f}",
        "seed": p["seed"],
        "date": p["date"],
        "checksum": model.checksum,
        "domain": domain_table(p["box"]),
    }


def inside_shares(model: FilmModel) -> dict[str, str]:
    """Return the shares of instants, load and load times sliding of the axle inside [%]."""
    oils = [read_oil(name).lubricant for name in model.provenance["oils_of_the_axle"]]
    mesh = shipped_mesh_table(model.provenance["mesh_table"])
    contacts = axle_contacts(_INSTANTS, 5, mesh, oils, ANYWHERE)
    numbers = model.copied_numbers()
    inside = np.array([solved_film(numbers, one).outside == 0.0 for one in contacts])
    load = np.array([one.load for one in contacts])
    sliding = load * np.array([one.sliding_speed for one in contacts])
    shares = {"inside": np.ones(load.size), "inside_load": load, "inside_loss": sliding}
    return {
        name: f"{100.0 * weights[inside].sum() / weights.sum():.{int(name != 'inside')}f}"
        for name, weights in shares.items()
    }


def domain_table(box: dict[str, list[Any]]) -> str:
    """Return the table of a box."""
    rows = [f"| {name} | {low:g} | {high:g} |" for name, (low, high, _) in box.items()]
    return "\n".join(["| Quantity | Least | Most |", "|---|---|---|", *rows])


def page(model: FilmModel, tests: Tests) -> str:
    """Return the page."""
    text = (HERE / "text.md").read_text(encoding="utf-8")
    return text.format(**numbers(model, tests))


def main() -> None:
    """Rewrite page and figures."""
    if len(sys.argv) > 1:
        shutil.copyfile(sys.argv[1], KEPT)
    model, tests = FilmModel.named(MODEL), read_tests(KEPT)
    images = ROOT / "docs" / "images"
    bounds = (100.0 * model.film_bound, 100.0 * model.friction_bound)
    by_kind = {KINDS[kind]: errors(tests[kind]) for kind in KINDS}
    errors_picture(by_kind, bounds).savefig(images / "film_model_errors.png", dpi=150)
    parity_picture({KINDS[kind]: tests[kind] for kind in KINDS}).savefig(
        images / "film_model_parity.png", dpi=150
    )
    PAGE.write_text(page(model, tests), encoding="utf-8")


if __name__ == "__main__":
    main()
