"""The film model in the package against films solved now."""

from __future__ import annotations

import csv
from itertools import pairwise

import numpy as np
import pytest
from typer.testing import CliRunner

from gearlube.command import app
from gearlube.studies.film_model.audit import audit
from gearlube.studies.film_model.draws import widened
from gearlube.studies.film_model.samples import DOMAIN, HYPOID_BOX, axle_contacts, box_contacts
from gearlube.studies.film_model.solve import solve_contact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.lubricant import Lubricant

pytestmark = pytest.mark.slow

OILS = tuple(Lubricant.named(name) for name in ("mohammadpour_2015", "karagiannis_2012"))


def test_bounds_hold_at_contacts_that_were_never_drawn_before():
    mesh = shipped_mesh_table("mohammadpour_2015")
    contacts = [
        *axle_contacts(6, 777, mesh, OILS, DOMAIN),
        *box_contacts(widened(HYPOID_BOX, OILS), 4, 778, random=True),
    ]
    found = audit(FilmModel.named("hypoid_flank"), contacts)
    assert found.outside == 0
    assert len(found.judged) >= 8  # a hot film may fail on the fine grid
    # of at most 10 contacts, three above a 95 % bound have a chance of 1 %
    assert max(found.misses.violations(found.bounds)) <= 2
    # twice a 95 % bound of normal errors is exceeded by one of 10,000; the bound of friction is
    # wide, because the model learnt from films without oil beyond their grid
    assert (np.abs(found.misses.values) < 2.0 * np.array(found.bounds)).all()
    assert np.abs(found.misses.values[:, 0]).max() < 0.05


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
