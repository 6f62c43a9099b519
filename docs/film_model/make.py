"""Numbers of docs/film_model.md and its figures: python -m docs.film_model.make [TESTS.csv].

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

from docs.page import IMAGES, Page
from gearlube.plotting.style import BLUE, VERMILLION, house_style, new_figure
from gearlube.studies.film_model.draws import ANYWHERE
from gearlube.studies.film_model.model_lines import limit_in_words
from gearlube.studies.film_model.samples import axle_contacts
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_film
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.oil_file import read_oil

_WORDS = {
    "axle": ("what the axle visits, not trained on", BLUE),
    "pair": ("what the helical pairs visit, not trained on", BLUE),
    "box": ("anywhere in the domain, not trained on", VERMILLION),
}
_NAMES = ("central film", "friction coefficient")


def _back_first(kind: str) -> bool:
    """Draw the box behind what a machine visits."""
    return kind != "box"


def errors_picture(errors: dict[str, tuple[Array, Array]], bounds: tuple[float, float]) -> Any:
    """Return the distribution of the errors [%] with the bounds [%]."""
    with house_style():
        figure = new_figure(9.0, 4.4)
        for n, ax in enumerate(figure.subplots(1, 2)):
            most = max(bounds[n], max(np.abs(errors[kind][n]).max() for kind in errors))
            edges = np.linspace(-1.05 * most, 1.05 * most, 43)
            for kind in sorted(errors, key=_back_first):
                filled = kind != "box"
                words, colour = _WORDS[kind]
                miss = errors[kind][n]
                ax.hist(
                    miss,
                    edges,
                    weights=np.full(miss.size, 100.0 / miss.size),
                    histtype="stepfilled" if filled else "step",
                    color=colour,
                    alpha=0.55 if filled else 1.0,
                    linewidth=1.4,
                    label=words,
                )
            for side in (-bounds[n], bounds[n]):
                label = "bound, 95 % of the domain" if side > 0.0 else None
                ax.axvline(side, color="k", linestyle="--", linewidth=1.0, label=label)
            ax.set_xlabel(f"error of the {_NAMES[n]} [%]")
            ax.set_ylabel("share of contacts [%]")
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3)
        figure.suptitle("How far the model is off in contacts that it was not trained on")
        return figure


HERE = Path(__file__).parent
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


def domain_rows(model: FilmModel) -> list[list[str]]:
    """Return quantity, least and most; other models have only what differs from the flanks'."""
    flanks = FilmModel.named(MODEL).provenance["box"] if model.name != MODEL else {}
    return [
        [name, f"{ends[0]:g}", f"{ends[1]:g}"]
        for name, ends in model.provenance["box"].items()
        if ends != flanks.get(name)
    ]


def put_errors(page: Page, model: FilmModel, tests: Tests, machine: str) -> None:
    """Put in errors [%] beside their bounds [%], the domain, and what the grid's part misses."""
    bounds = (100.0 * model.film_bound, 100.0 * model.friction_bound)
    rows: list[list[str | None]] = []
    for kind in KINDS:
        count = str(tests[kind]["film_model_m"].size)
        for miss, bound in zip(map(np.abs, errors(tests[kind])), bounds, strict=True):
            over = int((miss > bound).sum())
            found = (np.sqrt((miss**2).mean()), np.quantile(miss, 0.95), miss.max(), bound)
            share = f"{over} ({100.0 * over / miss.size:.1f} %)"
            rows.append([count, None, *(f"{one:.2f}" for one in found), share])
    page.cells("Contacts | Number", rows, first=1)
    p = model.provenance
    page.rows("Quantity | Least", domain_rows(model))
    page.fill("checksum {}, {}.\n\n", model.checksum, p["date"])
    limits = limit_in_words(tests["fresh"]["friction_solved"], f"films that the {machine}")
    begins = "A limiting shear stress of "
    page.fill(f"{begins}{{}}, Eyring stresses of 1 to 10 MPa alike", limits.removeprefix(begins))


def refreshed(model: FilmModel, tests: Tests) -> Page:
    """Return the page with the model's numbers."""
    page, p = Page("film_model"), model.provenance
    put_errors(page, model, tests, "axle visits")
    page.fill(
        "On the shipped axle {} % of the instants of a pair lie inside, with {} % of the load and "
        "{} % of load times sliding speed.",
        *inside_shares(model),
    )
    solves = p["solves"]
    page.fill(
        "**Films**: {} contacts of the domain ({} of them near its thick films) and {} of the "
        "axle, for training; {} of the domain for the bounds and {} of the axle for the test, "
        "drawn independently. Seed {}. {} solutions failed",
        solves["box"] + solves["edge"],
        *(solves[key] for key in ("edge", "axle", "calibration", "fresh")),
        p["seed"],
        p["failed"],
    )
    page.fill("**Grid**: {} contacts were also solved", p["fine_solves"])
    page.fill(
        "left out is {} % rms of the film and {} % rms of the friction.",
        *(f"{one:.2f}" for one in p["grid_error_left_percent"]),
    )
    page.fill("learns from {} points of them", p["fit"]["points"])
    return page


def inside_shares(model: FilmModel) -> list[str]:
    """Return the shares of instants, load and load times sliding of the axle inside [%]."""
    oils = [read_oil(name).lubricant for name in model.provenance["oils_of_the_axle"]]
    mesh = shipped_mesh_table(model.provenance["mesh_table"])
    contacts = axle_contacts(_INSTANTS, 5, mesh, oils, ANYWHERE)
    numbers = model.copied_numbers()
    inside = np.array([solved_film(numbers, one).outside == 0.0 for one in contacts])
    load = np.array([one.load for one in contacts])
    sliding = load * np.array([one.sliding_speed for one in contacts])
    weights = (np.ones(load.size), load, sliding)
    percent = [100.0 * one[inside].sum() / one.sum() for one in weights]
    return [f"{percent[0]:.0f}", *(f"{one:.1f}" for one in percent[1:])]


def draw(model: FilmModel, tests: Tests, kinds: dict[str, str], name: str) -> None:
    """Draw the errors of kinds of contacts."""
    bounds = (100.0 * model.film_bound, 100.0 * model.friction_bound)
    made = errors_picture({kinds[kind]: errors(tests[kind]) for kind in kinds}, bounds)
    made.savefig(IMAGES / f"{name}_errors.png", dpi=150)


def main() -> None:
    """Rewrite page and figures."""
    if len(sys.argv) > 1:
        shutil.copyfile(sys.argv[1], KEPT)
    model, tests = FilmModel.named(MODEL), read_tests(KEPT)
    draw(model, tests, KINDS, "film_model")
    refreshed(model, tests).write()


if __name__ == "__main__":
    main()
