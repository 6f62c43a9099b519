"""The film model in the package against films solved now."""

from __future__ import annotations

import csv
from itertools import pairwise

import numpy as np
import pytest
from typer.testing import CliRunner

from gearlube.command import app
from gearlube.studies.film_model.audit import audit
from gearlube.studies.film_model.kinds import (
    BEARING_ROLLER,
    HELICAL_LINE,
    HYPOID_FLANK,
    line_problem,
)
from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.samples import DOMAIN, axle_contacts
from gearlube.studies.film_model.solve import contact_solid, solve_contact
from gearlube_core.ehl.line.problem import LineSettings
from gearlube_core.ehl.line.thermal import ThermalSettings, thermal_line_on_grid
from gearlube_core.film_model.model import shipped_model
from gearlube_core.film_model.rolling import rolling_line
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.lubricant import Lubricant

pytestmark = pytest.mark.slow

OILS = tuple(Lubricant.named(name) for name in ("mohammadpour_2015", "karagiannis_2012"))


@pytest.mark.parametrize(
    ("kind", "visited", "of_box"),
    [(HYPOID_FLANK, 6, 4), (HELICAL_LINE, 10, 6), (BEARING_ROLLER, 10, 6)],
    ids=lambda one: getattr(one, "name", one),
)
def test_bounds_hold_at_contacts_that_were_never_drawn_before(kind, visited, of_box):
    """Fresh contacts of all oils of the library and of the box, on both grids, oil beyond."""
    model, plan = shipped_model(kind.name), FilmPlan(contact=kind.name)
    oils = [Lubricant.named(name) for name in plan.oils]
    contacts = [
        *kind.visits(visited, 777, plan.machines, oils, kind.domain),
        *kind.box_contacts(kind.box, of_box, 778, random=True),
    ]
    found = audit(model, contacts)
    assert len(found.judged) >= 0.7 * len(contacts)  # a hot film may fail, or lie in the border
    # of at most 16 contacts, four above a 95 % bound have a chance of 1 %
    assert max(found.misses.violations(found.bounds)) <= 3


@pytest.mark.parametrize("kind", [HELICAL_LINE, BEARING_ROLLER], ids=lambda one: one.name)
def test_bounds_hold_on_twice_the_domain(kind):
    """The oil beyond the grid is in closed form; here it is solved."""
    model, numbers = shipped_model(kind.name), shipped_model(kind.name).copied_numbers()
    misses = []
    for one in kind.box_contacts(kind.box, 6, 779, random=True):
        line = one if kind is HELICAL_LINE else rolling_line(one)
        wide, nodes = line_problem(line).widened(513)
        solids = (contact_solid(line), contact_solid(line))
        warm = thermal_line_on_grid(
            wide, solids, LineSettings(nodes=nodes, tolerance=1e-6), ThermalSettings(tolerance=1e-2)
        )
        if warm.converged:
            found = kind.predict(numbers, one)
            misses.append(found.central_film / warm.film.central_film - 1.0)
    # two of six above a 95 % bound have a chance of 3 %; the grid is coarse by half a per cent
    assert len(misses) >= 4
    assert (np.abs(misses) > model.film_bound + 0.005).sum() <= 1


def test_a_finer_grid_changes_films_at_second_order():
    # pressure, film and friction in the middle of the domain
    mesh = shipped_mesh_table("mohammadpour_2015")
    contact = axle_contacts(3, 11, mesh, OILS, DOMAIN)[0]
    films = [
        solve_contact(contact, nodes).central_film for nodes in ((65, 17), (129, 33), (257, 65))
    ]
    steps = [b - a for a, b in pairwise(films)]
    # halving the spacing divides the error by four; third-order wedges let it fall a little faster
    assert 0.1 < steps[1] / steps[0] < 0.5


def test_train_runs_from_the_command_line_and_fit_refuses_too_few(tmp_path):
    few = ["--box", "2", "--visited", "1", "--edge", "1", "--calibration", "1", "--fresh", "1"]
    out = tmp_path / "films"
    runner = CliRunner()
    command = ["film-model", "train", *few, "--fine", "0", "--jobs", "1", "--out", str(out)]
    assert runner.invoke(app, command).exit_code == 0
    with (out / "solves.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert [row["kind"] for row in rows] == ["box", "axle", "fresh", "box", "calibration", "edge"]
    assert all(float(row["converged"]) == 1.0 for row in rows)
    fit = runner.invoke(app, ["film-model", "fit", str(out), "--out", str(tmp_path / "m.json")])
    assert fit.exit_code == 2  # too few films
    assert not (tmp_path / "m.json").exists()
