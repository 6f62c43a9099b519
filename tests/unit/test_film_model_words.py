"""What the film model's commands print and write, and what it learns from: known answers."""

import math

import numpy as np
import pytest

from gearlube.studies.film_model import audit as audits
from gearlube.studies.film_model.audit import AuditRow, audit, audit_lines, audit_table
from gearlube.studies.film_model.calibration import Misses, conformal_bounds
from gearlube.studies.film_model.calibration import tests_table as table_of_tests
from gearlube.studies.film_model.fits import _film_features
from gearlube.studies.film_model.model_lines import limit_in_words, limits_of, model_lines
from gearlube.studies.film_model.samples import HYPOID_BOX, box_contacts
from gearlube.studies.film_model.solves import failures_in_words
from gearlube_core.errors import ConvergenceError
from gearlube_core.film_model.groups import contact_groups, contact_parts
from gearlube_core.film_model.inlet import oil_under
from gearlube_core.film_model.model import FLANK, LINE
from gearlube_core.film_model.solved_film import SolvedFilm
from tests.helpers.known_answers import named, quantities


@pytest.fixture
def found(monkeypatch):
    """Return an audit of six contacts of load 1 to 6: one outside, one failed, one not converged.

    The others are 10 % too thick, 2 % too thin and right, and friction is right, 4 % and 8 % high.
    Solved on a grid 1 and its second 4, led on by the power 1.5: 8.
    """
    model_film = {1: 1.1, 2: 0.98, 3: 1.0}
    model_friction = {1: 1.0, 2: 1.04, 3: 1.08}

    def predict(numbers, contact):
        n = contact[0]
        film, friction = model_film.get(n, 1.0), model_friction.get(n, 1.0)
        return SolvedFilm(8e-6 * film, 0.08 * friction, 1.0 * (n == 4), 0.0, 0.0)

    def solve(contact, nodes):
        if contact[0] == 5:
            raise ConvergenceError("no film")
        return named(converged=contact[0] != 6, central_film=1e-6 * nodes, friction=0.01 * nodes)

    kind = named(predict=predict, solve=solve, nodes=1.0, second=4.0, to_limit=1.5,
                 groups=lambda contact: [contact[0] * 10.0] * 17)  # fmt: skip
    monkeypatch.setattr(audits, "kind_of", lambda contact: kind)
    model = named(copied_numbers=lambda: None, film_bound=0.05, friction_bound=0.05)
    shares = []
    made = audit(model, [(float(n),) for n in range(1, 7)], progress=lambda s, _: shares.append(s))
    assert shares == pytest.approx([0.2, 0.4, 0.6, 0.8, 1.0])
    return made


def test_an_audit_prints_its_known_numbers(found):
    first, film, friction, verdict = audit_lines(found)
    numbers = {
        first: ["6", "1", "19 %", "3", "2"],  # 4 of a load of 21
        # (10^2 + 2^2 + 0)/3: 5.89 %; one above 5 %
        film: ["5.89 %", "10.00 %", "5.00 %", "1", "5 %", "0.2"],
        friction: ["5.16 %", "8.00 %", "5.00 %", "1", "5 %", "0.2"],  # (4^2 + 8^2)/3
    }
    for line, expected in numbers.items():
        assert quantities(line) == expected, line
    assert film.startswith("central film: error")
    assert friction.startswith("friction: error")
    # one of three above a bound of 95 %: 1 - 0.95^3
    assert found.chances == pytest.approx([1.0 - 0.95**3] * 2)
    assert verdict.startswith("The bounds hold")


def test_an_audit_writes_its_contacts(found):
    head, *rows = (line.split(",") for line in audit_table(found).splitlines())
    assert head[17:] == ["film_model_m", "film_solved_m", "friction_model", "friction_solved",
                         "failure"]  # fmt: skip
    assert [row[0] for row in rows] == ["10", "20", "30", "50", "60"]
    assert rows[0][17:] == ["8.8e-06", "8e-06", "0.08", "0.08", ""]
    assert rows[2][17:] == ["8e-06", "8e-06", "0.0864", "0.08", ""]
    assert [row[18:] for row in rows[3:]] == [["nan", "0.08", "nan", "no film"],
                                              ["nan", "0.08", "nan", "not converged"]]  # fmt: skip
    none = found._replace(rows=(AuditRow((1.0,), found.rows[0].model, 1.0, 1.0, "no"),))
    assert audit_lines(none)[1:] == ["No contact was solved: no verdict."]


def test_errors_and_bounds_are_known():
    errors = np.array([[0.03, -0.01], [-0.04, 0.02]])
    known = {
        "contacts": 2, "film_rms_percent": 3.5355, "film_max_percent": 4.0,
        "friction_rms_percent": 1.5811, "friction_max_percent": 2.0,
    }  # fmt: skip
    assert Misses(errors).summary() == known
    assert Misses(errors).violations((0.035, 0.005)) == (1, 2)
    ranked = np.arange(1.0, 40.0)[:, None] * np.array([[1.0, -0.1]])
    assert conformal_bounds(ranked) == pytest.approx((38.0, 3.8))  # the 38th of 39
    sheet = table_of_tests({"fresh": np.array([[1e-6, 0.05]])}, {"fresh": np.array([[2e-6, 0.06]])})
    assert sheet.splitlines() == [
        "kind,film_model_m,film_solved_m,friction_model,friction_solved",
        "fresh,1e-06,2e-06,0.05,0.06",
    ]


def test_limits_and_failures_in_words_have_their_known_numbers():
    friction = np.array([0.01, 0.04, 0.06, 0.09])
    words = limit_in_words(friction, "films")
    assert quantities(words) == ["0.035", "0.05", "0.08", "75", "50", "25 %"]

    def row(kind, nodes, friction, failure=""):
        task = named(kind=kind, number=7, nodes=nodes)
        return named(task=task, solved=named(friction=friction), failure=failure)

    rows = [row("visited", (9, 9), 0.06), row("visited", (9, 9), 0.01), row("box", (9, 9), 0.09),
            row("visited", (5, 5), 0.09), row("visited", (9, 9), 0.09, "lost")]  # fmt: skip
    kind = named(name=FLANK, visited="visited", nodes=(9, 9))
    table = named(kind=kind, rows=dict(enumerate(rows)))
    (line,) = limits_of(table)
    assert quantities(line) == ["0.035", "0.05", "0.08", "50", "50", "0 %"]
    assert failures_in_words(table) == ["1 of 5 films failed.", "visited-7-9x9: lost"]


def test_a_model_is_shown_with_its_known_numbers():
    domain = {
        "pressure": (math.log(0.002), math.log(0.01)),
        "psi": (0.0, math.radians(30.0)),
        "delta": (math.radians(-5.0), math.radians(5.0)),
        "thickness": (math.log(0.5), math.log(3.0)),
    }
    model = named(
        checksum="abc", provenance={"box": [1], "oils": ["a", "b"], "tests": {"rms": 2}},
        film_bound=0.0123, friction_bound=0.0456, kind=FLANK, domain=domain,
    )  # fmt: skip
    shown = [
        "checksum: abc", "oils: a, b", "tests: rms 2",
        "bounds, 95 %: central film 1.23 %, friction 4.56 %", "domain:",
        "mean pressure over E* 0.002 to 0.01", "entrainment from the minor axis [deg] 0 to 30",
        "sliding from entrainment [deg] -5 to 5", "(h R_x)^(1/2)/a_x 0.5 to 3",
        "This model is a trial. Do not use its results.",
    ]  # fmt: skip
    assert [" ".join(line.split()) for line in model_lines(model)] == shown
    model.kind, model.provenance = LINE, {"state": "final"}
    lines = [" ".join(line.split()) for line in model_lines(model)]
    assert lines == [shown[0], "state: final", *shown[3:6], shown[8]]


def test_films_are_learnt_from_numbers_of_the_contact():
    """Of box contacts in SI: alpha, Moes' material group, alpha p, viscosity and shear."""
    contacts = box_contacts(HYPOID_BOX, 20, seed=3)
    groups = np.array([contact_groups(one) for one in contacts])
    features = _film_features(groups)
    for c, of, found in zip(contacts, groups, features, strict=True):
        g = dict(zip(contact_groups(c)._fields, of, strict=True))
        inlet = contact_parts(c)[1]
        across = c.entrainment_speed * math.cos(g["psi"])
        rolling = c.eta0 * across / (c.contact_modulus * c.R_x)
        pressure = math.exp(g["pressure"]) * c.contact_modulus  # Pa
        under = oil_under(pressure, inlet)
        # over R_x, but for a factor
        film = math.exp(2.0 * (g["thickness"] + g["pressure"]))
        shear = c.eta0 * c.sliding_speed / (film * c.R_x * under.stress)
        expected = [
            g["thickness"], math.log(inlet.alpha * c.contact_modulus * rolling**0.25),
            math.log(inlet.alpha * pressure), math.log(under.stress / pressure),
            under.log_ratio, math.log(shear),
        ]  # fmt: skip
        assert found[[0, 1, 2, 3, 15, 16]] == pytest.approx(expected, rel=1e-9)
