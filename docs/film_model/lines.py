"""Rewrite docs/film_model_line.md and its figures: python -m docs.film_model.lines [TESTS.csv].

Reads the model in the package and what `gearlube film-model fit` wrote beside it, by default
docs/film_model/tests_line.csv; a table that is given is kept there. Seconds; nothing is solved.
"""

from __future__ import annotations

import shutil
import sys

import numpy as np

from docs.film_model.make import HERE, ROOT, Tests, domain_table, error_numbers, errors, read_tests
from docs.film_model.outside_line import MODEL, formula_film, formula_friction, sentences
from docs.film_model.pictures import errors_picture, parity_picture
from gearlube.studies.film_model.draws import ANYWHERE, STEEL
from gearlube.studies.film_model.kinds import HELICAL_LINE
from gearlube.studies.film_model.limiting import limit_in_words
from gearlube.studies.film_model.plan import FilmPlan
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_line
from gearlube_core.friction.line_points import line_friction, line_points, uniform_line_load
from gearlube_core.friction.solved_line import (
    LINE_FORMULA_FILM_BOUND,
    LINE_FORMULA_FRICTION_TOP,
    line_inlet,
    solved_line_friction,
)
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant import Lubricant, lubricant_state
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

PAGE = ROOT / "docs" / "film_model_line.md"
KEPT = HERE / "tests_line.csv"
KINDS = {"fresh": "pair", "calibration": "box"}
_INSTANTS = 3000
_PAIR, _TORQUE = "he_2007", 226.0  # N.m
_SPEEDS, _TEMPERATURES = (500.0, 1000.0, 3000.0, 6000.0), (40.0, 60.0, 90.0)  # rpm, degC


def of_visits(model: FilmModel) -> dict[str, str]:
    """Return shares inside the domain, and formulas over the model there."""
    oils = [read_oil(name).lubricant for name in model.provenance["oils_of_the_pair"]]
    contacts = HELICAL_LINE.visits(_INSTANTS, 5, model.provenance["pairs"], oils, ANYWHERE)
    numbers = model.copied_numbers()
    found = [solved_line(numbers, one) for one in contacts]
    inside = np.array([film.outside == 0.0 for film in found])
    load = np.array([one.line_load for one in contacts])
    sliding = load * np.array([one.sliding_speed for one in contacts])
    shares = {"inside": np.ones(load.size), "inside_load": load, "inside_loss": sliding}
    text = {
        name: f"{100.0 * weights[inside].sum() / weights.sum():.0f}"
        for name, weights in shares.items()
    }
    films, frictions = [], []
    for one, film in zip(contacts, found, strict=True):
        if film.outside == 0.0:
            by_formula = formula_film(one)
            films.append(by_formula / film.central_film)
            frictions.append(formula_friction(one, by_formula) / film.friction_coefficient)
    for short, ratios in (("dt", films), ("ej", frictions)):
        for word, share in (("low", 0.05), ("mid", 0.5), ("high", 0.95)):
            text[f"{short}_{word}"] = f"{np.quantile(ratios, share):.2f}"
    return text


def losses(model: FilmModel) -> str:
    """Return the table of losses of a pair by formula and model."""
    pair = HelicalGearFile.named(_PAIR).helical_pair()
    points = line_points(pair, 16, 6)
    loads = uniform_line_load(points, _TORQUE)
    here = points.length > 0.0
    places = list(zip(points.x[here], points.length[here], loads[here], strict=True))
    oil, surface = Lubricant.named("mohammadpour_2015"), gear_flanks(0.5e-6)
    numbers = model.copied_numbers()
    rows = [
        "| rpm | oil, °C | loss by formula, W | by model, W | bound, W | film ratio, formula | "
        "model | load outside, % |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for rpm in _SPEEDS:
        for temperature in _TEMPERATURES:
            state = lubricant_state(oil.parameters(), celsius_to_kelvin(temperature))
            inlet = line_inlet(state, STEEL, 0.0)
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
            first, second, bound = sums[:3] / points.phase.size
            rows.append(
                f"| {rpm:.0f} | {temperature:.0f} | {first:.1f} | {second:.1f} | {bound:.1f} | "
                f"{least[0]:.2f} | {least[1]:.2f} | {100.0 * sums[3] / sums[4]:.1f} |"
            )
    return "\n".join(rows)


def page(model: FilmModel, tests: Tests) -> str:
    """Return the page."""
    p = model.provenance
    solves = p["solves"]
    text = (HERE / "text_line.md").read_text(encoding="utf-8")
    kind = FilmPlan(contact=model.kind).kind
    return text.format(
        **error_numbers(model, tests, KINDS),
        **of_visits(model),
        losses=losses(model),
        formula_film_bound=f"{100.0 * LINE_FORMULA_FILM_BOUND:.0f}",
        formula_mu_top=f"{LINE_FORMULA_FRICTION_TOP:g}",
        outside=sentences(),
        nodes=kind.nodes[0],
        second=p["fine_solves"],
        second_nodes=kind.second[0],
        box=solves["box"] + solves["edge"],
        pair=solves["pair"],
        calibration=solves["calibration"],
        fresh=solves["fresh"],
        failed=p["failed"],
        grid_film=f"{p['grid_error_left_percent'][0]:.2f}",
        grid_mu=f"{p['grid_error_left_percent'][1]:.2f}",
        seed=p["seed"],
        date=p["date"],
        name=p["name"],
        checksum=model.checksum,
        domain=domain_table(p["box"]),
        limits=limit_in_words(tests["fresh"]["friction_solved"], "films that the pairs visit"),
    )


def main() -> None:
    """Rewrite page and figures."""
    if len(sys.argv) > 1:
        shutil.copyfile(sys.argv[1], KEPT)
    model, tests = FilmModel.named(MODEL), read_tests(KEPT)
    images = ROOT / "docs" / "images"
    bounds = (100.0 * model.film_bound, 100.0 * model.friction_bound)
    by_kind = {KINDS[kind]: errors(tests[kind]) for kind in KINDS}
    errors_picture(by_kind, bounds).savefig(images / "film_model_line_errors.png", dpi=150)
    parity_picture({KINDS[kind]: tests[kind] for kind in KINDS}).savefig(
        images / "film_model_line_parity.png", dpi=150
    )
    PAGE.write_text(page(model, tests), encoding="utf-8")


if __name__ == "__main__":
    main()
