"""Numbers of docs/film_model_line.md, figures: python -m docs.film_model.lines [TESTS.csv].

Reads the model in the package and what `gearlube film-model fit` wrote beside it, by default
docs/film_model/tests_line.csv; a table that is given is kept there. Seconds; nothing is solved.
"""

from __future__ import annotations

import shutil
import sys

import numpy as np

from docs.film_model.make import HERE, Tests, draw, put_errors, read_tests
from docs.film_model.outside_line import MODEL, formula_film, formula_friction, put_outside
from docs.page import Page
from gearlube.studies.film_model.draws import ANYWHERE, STEEL
from gearlube.studies.film_model.kinds import HELICAL_LINE
from gearlube.studies.film_model.plan import FilmPlan
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.film_model.inlet import model_inlet
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_line
from gearlube_core.friction.line_points import line_friction, line_points, uniform_line_load
from gearlube_core.friction.solved_line import (
    LINE_FORMULA_FILM_BOUND,
    LINE_FORMULA_FRICTION_TOP,
    solved_line_friction,
)
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

KEPT = HERE / "tests_line.csv"
KINDS = {"fresh": "pair", "calibration": "box"}
_INSTANTS = 3000
_PAIR, _TORQUE = "he_2007", 226.0  # N.m
_SPEEDS, _TEMPERATURES = (500.0, 1000.0, 3000.0, 6000.0), (40.0, 90.0)  # rpm, degC


def put_visits(page: Page, model: FilmModel) -> None:
    """Put in shares inside the domain, and formulas over the model there."""
    oils = [read_oil(name).lubricant for name in model.provenance["oils_of_the_pair"]]
    contacts = HELICAL_LINE.visits(_INSTANTS, 5, model.provenance["pairs"], oils, ANYWHERE)
    numbers = model.copied_numbers()
    found = [solved_line(numbers, one) for one in contacts]
    inside = np.array([film.outside == 0.0 for film in found])
    load = np.array([one.line_load for one in contacts])
    sliding = load * np.array([one.sliding_speed for one in contacts])
    page.fill(
        "Inside the domain lie {} % of the places and times, with {} % of the load and {} % of "
        "load times sliding.",
        *(
            f"{100.0 * weights[inside].sum() / weights.sum():.0f}"
            for weights in (np.ones(load.size), load, sliding)
        ),
    )
    films, frictions = [], []
    for one, film in zip(contacts, found, strict=True):
        if film.outside == 0.0:
            by_formula = formula_film(one)
            films.append(by_formula / film.central_film)
            frictions.append(formula_friction(one, by_formula) / film.friction_coefficient)
    ratios = [np.quantile(one, (0.05, 0.5, 0.95)) for one in (films, frictions)]
    cells = [[f"{value:.2f}" for value in one] for one in ratios]
    page.cells("Formula over model", cells, first=1)


def losses(model: FilmModel) -> list[list[str]]:
    """Return the rows of losses of a pair by formula and model."""
    pair = HelicalGearFile.named(_PAIR).helical_pair()
    points = line_points(pair, 16, 6)
    loads = uniform_line_load(points, _TORQUE)
    here = points.length > 0.0
    places = list(zip(points.x[here], points.length[here], loads[here], strict=True))
    oil, surface = Lubricant.named("mohammadpour_2015"), gear_flanks(0.5e-6)
    numbers = model.copied_numbers()
    rows = []
    for rpm in _SPEEDS:
        for temperature in _TEMPERATURES:
            state = lubricant_state(oil.parameters(), celsius_to_kelvin(temperature))
            inlet = model_inlet(state, STEEL, 0.0)
            sums = np.zeros(5)
            least = np.full(2, np.inf)
            for x, length, w in places:
                m = line_kinematics(x, rpm_to_rads(rpm), pair.plane)
                given = (w, m.R, m.entrainment, m.sliding, state, surface, STEEL)
                old = line_friction(*given)
                new = solved_line_friction(*given, inlet, numbers)
                power = w * length * abs(m.sliding)
                sums += (
                    old.friction_coefficient * power,
                    new.state.friction_coefficient * power,
                    new.coefficient_bound * power,
                    new.outside * w * length,
                    w * length,
                )
                least = np.minimum(least, (old.film_ratio, new.state.film_ratio))
            cells = [f"{rpm:.0f}", f"{temperature:.0f}"]
            cells += [f"{one:.1f}" for one in sums[:3] / points.phase.size]
            cells += [f"{one:.2f}" for one in least]
            rows.append([*cells, f"{100.0 * sums[3] / sums[4]:.1f}"])
    return rows


def refreshed(model: FilmModel, tests: Tests) -> Page:
    """Return the page with the model's numbers."""
    page, p = Page("film_model_line"), model.provenance
    solves, kind = p["solves"], FilmPlan(contact=model.kind).kind
    put_errors(page, model, tests, "pairs visit")
    put_visits(page, model)
    put_outside(page)
    page.rows("rpm | oil, °C", losses(model))
    page.fill(
        "the film is at most {} % thinner, and friction between zero and {} times that of an "
        "isothermal Eyring film",
        f"{100.0 * LINE_FORMULA_FILM_BOUND:.0f}",
        f"{LINE_FORMULA_FRICTION_TOP:g}",
    )
    page.fill(
        "{} nodes, led to the limit of fine grids by {} films on {} nodes",
        kind.nodes[0],
        p["fine_solves"],
        kind.second[0],
    )
    page.fill(
        "Seed {}; {} contacts of the box and {} of the pairs for training, {} of the box for the "
        "bounds, {} of the pairs for the test; {} solutions failed. What the grid's correction "
        "misses: {} % rms of the film, {} % of friction.",
        p["seed"],
        solves["box"] + solves["edge"],
        *(solves[key] for key in ("pair", "calibration", "fresh")),
        p["failed"],
        *(f"{one:.2f}" for one in p["grid_error_left_percent"]),
    )
    return page


def main() -> None:
    """Put the numbers into the page; draw its figures."""
    if len(sys.argv) > 1:
        shutil.copyfile(sys.argv[1], KEPT)
    model, tests = FilmModel.named(MODEL), read_tests(KEPT)
    draw(model, tests, KINDS, "film_model_line")
    refreshed(model, tests).write()


if __name__ == "__main__":
    main()
