"""The surrogate of solved line films: groups, reference friction, kernel, plan."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from gearlube.studies.film_model.calibration import own_steps
from gearlube.studies.film_model.draws import widened
from gearlube.studies.film_model.fits import fit_process
from gearlube.studies.film_model.kinds import HELICAL_LINE, HYPOID_FLANK, kind_of
from gearlube.studies.film_model.line_samples import LINE_DOMAIN
from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.solve import Solved
from gearlube.studies.film_model.solves import SolveRow, SolveTable, failed_row
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.groups import FilmGroups
from gearlube_core.film_model.line_contact import (
    LineContact,
    line_contact_groups,
    line_parts,
    line_reference_film,
)
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.reference_friction import line_reference_friction
from gearlube_core.film_model.solved_film import solved_line, solved_line_at
from gearlube_core.oil.lubricant import Lubricant

E_STAR = 210e9 / (2.0 * (1.0 - 0.3**2))


def contact(**changes: float) -> LineContact:
    """A contact in the middle of the domain: 0.5 GPa, 5 m/s, a sixth of it sliding."""
    one = LineContact(
        line_load=1.1e5,
        contact_modulus=E_STAR,
        R=0.01,
        entrainment_speed=5.0,
        sliding_speed=0.8,
        eta0=0.03,
        alpha=1.8e-8,
        beta=0.031,
        tau0=3e6,
        limiting_stress=0.0,
        limiting_slope=0.0,
        temperature=343.15,
        conductivity=0.13,
        heat_capacity=1.74e6,
        solid_conductivity=46.0,
        solid_heat_capacity=7850.0 * 470.0,
    )
    return one._replace(**changes)


@pytest.fixture(scope="module")
def model() -> FilmModel:
    return FilmModel.named("helical_line")


def test_groups_are_those_of_a_hand_calculation():
    g = line_contact_groups(contact())
    b = math.sqrt(4.0 * 1.1e5 * 0.01 / (math.pi * E_STAR))
    p = 1.1e5 / (2.0 * b)
    inlet = line_parts(contact())[1]
    growth = (1.0 + 5.1e-9 * p) ** (1.8e-8 / (5.1e-9 * 6.163440))
    film = line_reference_film(1.1e5, 5.0, 0.01, inlet)
    film *= 3.94 / (3.94 + (0.031 * 0.03 * 25.0 / 0.13) ** 0.62)  # Murch and Wilson
    thickness = math.log(math.sqrt(film * 0.01) / b)
    by_hand = FilmGroups(
        pressure=math.log(p / E_STAR),
        ellipse=0.0,
        psi=0.0,
        slide_roll=math.log(math.hypot(0.16, 0.003)),
        delta=0.0,
        sharpness=math.log(inlet.alpha * p) - 2.0 / 3.0 * thickness,
        shape=math.log(6.163440 * (growth - 1.0) / (inlet.alpha * p)),  # ln(475.06) = 6.163440
        stress=math.log(3e6 / 1.153846e11),
        limited=0.0,
        rate=math.log(0.03 * 5.0 / (1.153846e11 * 0.01)),
        peclet=math.log(0.05 * 3689500.0 / 46.0),
        cooling=math.log(growth),
        warmth=math.log(0.031 * 343.15),
        conductivity=math.log(0.13 / 46.0),
        capacity=math.log(1.74 / 3.6895),
        heat=math.log(0.031 * 0.03 * 25.0 / 0.13),
        thickness=thickness,
    )
    assert g == pytest.approx(by_hand, abs=2e-6)  # the digits given by hand


def test_reference_film_has_the_regimes_of_gear_lines():
    # without the growth of viscosity and with light load: Martin's rigid film 4.9 R eta0 u/w, whose
    # central film Moes' formula gives as 3 (2 U)^(1/2)/M
    light = contact(line_load=200.0, alpha=1e-13)
    inlet = line_parts(light)[1]
    rigid = 2.0 * 3.0 * 0.03 * 5.0 * 0.01 / 200.0
    # exponents of the formula join the regimes: elastic flattening is left at 2 %
    assert line_reference_film(200.0, 5.0, 0.01, inlet) == pytest.approx(rigid, rel=0.03)
    # heavy load: H = 1.311 M^(-1/8) L^(3/4) is the piezoviscous-elastic regime of the formula
    inlet = line_parts(contact())[1]
    U = 0.03 * 5.0 / (2.0 * E_STAR * 0.01)
    M = 2e6 / (2.0 * E_STAR * 0.01) / math.sqrt(2.0 * U)
    L = inlet.alpha * 2.0 * E_STAR * (2.0 * U) ** 0.25
    heavy = 0.01 * math.sqrt(2.0 * U) * 1.311 * M**-0.125 * L**0.75
    assert line_reference_film(2e6, 5.0, 0.01, inlet) == pytest.approx(heavy, rel=0.1)


def test_reference_friction_is_the_mean_stress_over_the_strip():
    film = 0.6e-6
    one = contact()
    b = math.sqrt(4.0 * one.line_load * one.R / (math.pi * E_STAR))
    p = one.line_load / (2.0 * b)
    alpha = line_parts(one)[1].alpha
    wider = 1.0 + 0.15 * (film * one.R / b**2) ** 1.5 / math.sqrt(alpha * p)
    surfaces = 0.3665 * math.sqrt(b * wider / (46.0 * 7850.0 * 470.0 * 5.0))
    resistance = film / (8.0 * one.conductivity) + surfaces
    log_ratio = math.log(one.eta0 / 63.15e-6)

    def stress(pressure: float, slip: float) -> float:
        growth = (1.0 + 5.1e-9 * pressure) ** (one.alpha / (5.1e-9 * log_ratio))

        def excess(tau: float) -> float:
            rise = tau * slip * resistance
            eta = 63.15e-6 * math.exp(log_ratio * growth / (1.0 + one.beta * rise / log_ratio))
            return tau - one.tau0 * math.asinh(eta * slip / (film * one.tau0))

        return float(brentq(excess, 0.0, 1e9))

    X = (np.arange(400) + 0.5) / 400
    for slip in (1e-5, 0.01, 0.8, 3.0):
        top = 4.0 / math.pi * p / wider
        mean = np.mean([stress(top * math.sqrt(1.0 - x * x), slip) for x in X])
        found = line_reference_friction(film, p, 5.0, slip, b, one.R, line_parts(one)[1])
        # five points instead of 400, and one Newton step
        assert found == pytest.approx(float(mean) * wider / p, rel=0.02), slip


def test_kernel_agrees_with_a_plain_evaluation(model):
    one, n = contact(), model.copied_numbers()
    w, g = model.blocks, np.array(line_contact_groups(one))
    x = (g - w["shift"]) * w["scale"]

    def bend(a: np.ndarray) -> np.ndarray:
        return a / np.sqrt(1.0 + a * a)

    hidden = bend(bend(x @ w["first"] + w["first_offset"]) @ w["second"] + w["second_offset"])
    y = w["straight"] @ x + w["last"] @ hidden + w["last_offset"]
    inlet = line_parts(one)[1]
    cold = line_reference_film(1.1e5, 5.0, 0.01, inlet)
    film = cold * 3.94 / (3.94 + (0.031 * 0.03 * 25.0 / 0.13) ** 0.62) * math.exp(y[0])
    b = math.sqrt(4.0 * one.line_load * one.R / (math.pi * E_STAR))
    friction = line_reference_friction(film, 1.1e5 / (2.0 * b), 5.0, 0.8, b, 0.01, inlet)
    found = solved_line(n, one)
    assert found.outside == 0.0
    assert found.central_film == pytest.approx(film, rel=1e-12)
    assert found.friction_coefficient == pytest.approx(friction * math.exp(y[1]), rel=1e-12)
    assert (found.film_bound, found.friction_bound) == (model.film_bound, model.friction_bound)


def test_a_compiled_line_is_that_of_its_python_function(model):
    place, inlet = line_parts(contact())
    given = model.copied_numbers(), 1.1e5, 5.0, 0.8, place, inlet
    # rounding: sums of the net in another order
    np.testing.assert_allclose(solved_line_at(*given), solved_line_at.py_func(*given), rtol=1e-12)


def test_friction_near_pure_rolling_is_linear_in_sliding(model):
    n = model.copied_numbers()

    def friction(slip: float) -> float:
        return solved_line(n, contact(sliding_speed=slip)).friction_coefficient

    # far below tau0 the film is Newtonian: asinh x = x (1 - x^2/6), x of some thousandths
    assert friction(2e-7) == pytest.approx(2.0 * friction(1e-7), rel=1e-4)
    assert friction(0.0) < 1e-12


def test_light_load_and_a_limiting_stress_lie_outside(model):
    n = model.copied_numbers()
    assert solved_line(n, contact(line_load=200.0)).outside == 1.0
    free = solved_line(n, contact())
    p = math.sqrt(math.pi * E_STAR * 1.1e5 / (16.0 * 0.01))
    assert solved_line(n, contact(limiting_slope=free.friction_coefficient)).outside == 1.0
    assert solved_line(n, contact(limiting_stress=3.0 * free.friction_coefficient * p)).outside == 0
    for load, speed in ((0.0, 0.0), (1e7, 1e3), (1e-9, 1e2)):
        found = solved_line(n, contact(line_load=load, entrainment_speed=speed))
        assert all(map(math.isfinite, found))


def test_films_thinner_than_the_domain_keep_its_correction(model):
    n, most = model.copied_numbers(), model.domain["sharpness"][1]
    found = []
    for speed in (0.02, 0.01):
        one = contact(line_load=1.2e6, entrainment_speed=speed, sliding_speed=0.1 * speed)
        assert line_contact_groups(one).sharpness > most + 0.15  # past the rounded end
        film = solved_line(n, one)
        assert film.outside == 0.0
        inlet = line_parts(one)[1]
        cold = line_reference_film(1.2e6, speed, 0.01, inlet)
        found.append(film.central_film / cold)
    # half the speed: what else changes with it, heat and Peclet number, is gone at creep
    assert found[0] == pytest.approx(found[1], rel=0.02)


def test_a_plan_of_lines_draws_contacts_of_pairs_and_box():
    plan = FilmPlan(
        contact="line",
        box=60,
        visited=20,
        edge=6,
        calibration=10,
        fresh=20,
        fine_box=2,
        fine_visited=1,
        fine_edge=1,
        fine_fresh=1,
    )
    tasks = plan.tasks()
    assert len(tasks) == plan.solves
    assert {task.kind for task in tasks} == {"box", "pair", "edge", "calibration", "fresh"}
    assert FilmPlan.of(plan.described()) == plan
    fresh = [task.contact for task in tasks if task.kind == "fresh"]
    assert all(kind_of(one) is HELICAL_LINE for one in fresh)
    # a pair slides from its roots to its tips: both slow and fast sliding are met
    ratios = [one.sliding_speed / one.entrainment_speed for one in fresh]
    assert min(ratios) < 0.1 < 0.4 < max(ratios) < 0.8
    b = [math.sqrt(4.0 * c.line_load * c.R / (math.pi * E_STAR)) for c in fresh]
    pressures = [c.line_load / (2.0 * half) for c, half in zip(fresh, b, strict=True)]
    assert min(pressures) >= LINE_DOMAIN.least_pressure
    with pytest.raises(
        ParameterError, match=r"contact must be one of flank, .*line.*; got 'point'"
    ):
        FilmPlan(contact="point")


def test_a_table_of_lines_comes_back_and_is_no_table_of_flanks(tmp_path):
    task = FilmPlan(contact="line", box=5, visited=1, edge=1, calibration=1, fresh=1, fine_box=0,
                    fine_visited=0, fine_edge=0, fine_fresh=0).tasks()[0]  # fmt: skip
    row = failed_row(task, ValueError("no film"))
    table = SolveTable(tmp_path / "solves.csv", HELICAL_LINE)
    table.keep("key", row)
    (again,) = SolveTable(tmp_path / "solves.csv", HELICAL_LINE).rows.values()
    assert again.task == task
    with pytest.raises(Exception, match="got other columns"):
        SolveTable(tmp_path / "solves.csv", HYPOID_FLANK)


def test_both_grids_lead_to_the_same_limit():
    # film 1 + c/n^2 on n intervals: 1 is reached from either side
    for kind in (HYPOID_FLANK, HELICAL_LINE):
        first, second = (1.0 + 2.0 / (n - 1.0) ** 2 for n in (kind.nodes[0], kind.second[0]))
        assert first + kind.to_limit * (second - first) == pytest.approx(1.0, abs=1e-12)


def test_a_contact_on_both_grids_takes_its_own_way_to_the_limit():
    plan = FilmPlan(contact="line", box=5, visited=1, edge=1, calibration=3, fresh=1, fine_box=0,
                    fine_visited=0, fine_edge=0, fine_fresh=0, fine_calibration=2)  # fmt: skip
    tasks = [task for task in plan.tasks() if task.kind == "calibration"]
    assert [task.nodes for task in tasks] == 3 * [HELICAL_LINE.nodes] + 2 * [HELICAL_LINE.second]
    rows = []
    for task in tasks:
        film = 1e-6 * (1.0 + task.number) * (1.0 + 500.0 / (task.nodes[0] - 1.0) ** 2)
        rows.append(SolveRow(task, Solved(film, film, 0.01, 1e9, 1.0, 0.0, 1.0, 0.1), ""))
    steps = own_steps(rows, "calibration")
    assert steps.shape == (3, 2)
    found = [
        row.solved.central_film * math.exp(step)
        for row, step in zip(rows[:3], steps[:, 0], strict=True)
    ]
    # of second order, as the step of the logarithm is to first order of 500/512^2
    np.testing.assert_allclose(found[:2], [1e-6, 2e-6], rtol=1e-5)
    assert np.isnan(steps[2]).all()


@pytest.mark.slow
def test_a_process_for_rough_values_learns_a_bend_better():
    rng = np.random.default_rng(5)
    drawn = HELICAL_LINE.box_contacts(HELICAL_LINE.box, 260, 3)
    groups = np.array([HELICAL_LINE.groups(one) for one in drawn])
    thickness = groups[:, -1]
    values = np.abs(thickness - np.median(thickness)) + 1e-3 * rng.standard_normal(len(groups))
    smooth, rough = (
        fit_process(groups[:200], values[:200], smooth=one)(groups[200:]) - values[200:]
        for one in (True, False)
    )
    assert np.sqrt((rough**2).mean()) < 0.1 * values.std()
    assert np.sqrt((rough**2).mean()) < 1.1 * np.sqrt((smooth**2).mean())


def test_the_box_holds_the_oils_of_the_pairs():
    oils = [Lubricant.named(name) for name in FilmPlan().oils]
    assert widened(HELICAL_LINE.box, oils) == HELICAL_LINE.box
