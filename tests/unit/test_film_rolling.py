"""Film and rolling friction of rollers: kernel, draws and solutions of the film model's kind."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from gearlube.studies.film_model.kinds import BEARING_ROLLER, kind_of
from gearlube.studies.film_model.line_samples import (
    ROLLER_BOX,
    ROLLER_DOMAIN,
    roller_box_contacts,
    roller_contact_of,
    roller_contacts,
    roller_fits,
)
from gearlube.studies.film_model.model_lines import model_lines
from gearlube.studies.film_model.plan import FilmPlan, FilmTask
from gearlube.studies.film_model.solve import Solved
from gearlube.studies.film_model.solves import (
    PLAN,
    SolveRow,
    SolveTable,
    check_plan,
    row_key,
    stored_plan,
)
from gearlube_core.errors import ParameterError
from gearlube_core.film_model import net
from gearlube_core.film_model.groups import N_GROUPS
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.rolling import (
    RollerContact,
    rolling_groups,
    rolling_line,
    solved_rolling,
)
from gearlube_core.oil.lubricant import Lubricant

OIL = Lubricant.named("fva_3")
E_STAR = 210e9 / (2.0 * (1.0 - 0.3**2))


def roller(load: float = 6e4, speed: float = 1.4, tau0: float = 5e6) -> RollerContact:
    """The outer race of the bearing 32216 at 6 kN and 500 rpm, oil of 50 degC."""
    return roller_contact_of(load, 9.8e-3, speed, OIL, 323.15, (tau0, 0.0))


def plain_model() -> FilmModel:
    """A model that corrects nothing, in a domain of everything."""
    blocks = {
        "domain_low": np.full(N_GROUPS, -100.0),
        "domain_high": np.full(N_GROUPS, 100.0),
        "bounds": np.array([0.01, 0.02]),
        "contact_modulus": np.array([E_STAR]),
        "border": np.array([0.1]),
    }
    for name, shape in {
        "shift": (N_GROUPS,),
        "scale": (N_GROUPS,),
        "first": (N_GROUPS, net.WIDTH),
        "first_offset": (net.WIDTH,),
        "second": (net.WIDTH, net.WIDTH),
        "second_offset": (net.WIDTH,),
        "straight": (net.N_OUTPUTS, N_GROUPS),
        "last": (net.N_OUTPUTS, net.WIDTH),
        "last_offset": (net.N_OUTPUTS,),
    }.items():
        blocks[name] = np.zeros(shape)
    return FilmModel.of_blocks(blocks, {})


def corrected(film: float, friction: float) -> FilmModel:
    """A model that multiplies film and friction."""
    model = plain_model()
    offsets = np.log([film, friction])
    return FilmModel.of_blocks({**model.blocks, "last_offset": offsets}, {})


def test_a_heavy_roller_has_the_rolling_friction_of_its_limit():
    # F = 1.47 E' R U^(3/4) with U = 2 eta0 u/(E' R), free of load; mu = 2 F/w
    one = roller(load=3e6)
    U = 2.0 * one.eta0 * 1.4 / (2.0 * E_STAR * 9.8e-3)
    limit = 2.0 * 2.0 * E_STAR * 9.8e-3 * 1.47 * U**0.75 / 3e6
    heat = one.beta * one.eta0 * 1.4**2 / one.conductivity
    limit *= 3.94 / (3.94 + heat**0.62)  # Murch and Wilson
    found = solved_rolling(plain_model().copied_numbers(), one)
    assert found.friction_coefficient == pytest.approx(limit, rel=2e-3)  # three printed digits
    assert found.outside == 0.0
    assert found[3:] == (0.01, 0.02)


def test_the_model_multiplies_film_and_rolling_friction():
    plain = solved_rolling(plain_model().copied_numbers(), roller())
    found = solved_rolling(corrected(0.8, 1.1).copied_numbers(), roller())
    assert found.central_film == pytest.approx(0.8 * plain.central_film, rel=1e-12)
    # its reference does not take the film
    assert found.friction_coefficient == pytest.approx(1.1 * plain.friction_coefficient, rel=1e-12)


def test_compiled_kernel_agrees_with_python_and_is_finite_for_anything():
    numbers = corrected(0.8, 1.1).copied_numbers()
    compiled, plain = solved_rolling(numbers, roller()), solved_rolling.py_func(numbers, roller())
    assert np.array(compiled) == pytest.approx(np.array(plain), rel=1e-12)  # rounding
    for load, speed in ((0.0, 0.0), (1e-3, 1e-9), (1e9, 1e3)):
        assert np.isfinite(solved_rolling(numbers, roller(load, speed))).all()


def test_a_solved_roller_agrees_with_the_fits_of_others():
    """Biboulet and Houpert's rolling force, fitted to their solutions, and Dowson's film."""
    one = roller()
    found = BEARING_ROLLER.solve(one, (257, 1))
    assert found.converged == 1.0
    # their fit is within some 5 %, isothermal and Newtonian; the coarse grid within 2 %
    U = 2.0 * one.eta0 * 1.4 / (2.0 * E_STAR * 9.8e-3)
    force = 2.0 * E_STAR * 9.8e-3 * 1.47 * U**0.75  # M = 3: the heavy limit
    assert found.friction == pytest.approx(2.0 * force / 6e4, rel=0.1)
    # h_min of Dowson 1968, 2.65 U^0.7 G^0.54 W^-0.13, compressible solutions are up to 20 % thinner
    E = 2.0 * E_STAR
    film = 2.65 * 9.8e-3 * (0.5 * U) ** 0.7 * (one.alpha * E) ** 0.54 * (6e4 / E / 9.8e-3) ** -0.13
    assert found.minimum_film == pytest.approx(film, rel=0.2)
    assert found.minimum_film < found.central_film
    # without sliding only compression and flow by pressure warm the oil
    assert 0.0 < found.rise < 5.0


def test_groups_are_those_of_a_line_without_sliding():
    still = rolling_groups(roller())
    assert rolling_line(roller()).sliding_speed == 0.0
    assert (still.ellipse, still.psi, still.delta) == (0.0, 0.0, 0.0)
    # speed times f, load times f^(1/2): M of Moes stays, and thickness with it at the same L
    faster = rolling_groups(roller(6e4 * math.sqrt(2.0), 2.8))
    assert faster.rate - still.rate == pytest.approx(math.log(2.0), abs=1e-12)
    assert faster.pressure - still.pressure == pytest.approx(0.25 * math.log(2.0), abs=1e-12)
    assert faster.slide_roll == pytest.approx(still.slide_roll, abs=1e-12)


def test_the_model_of_the_package_tells_its_domain_without_what_is_constant_in_it():
    lines = model_lines(FilmModel.named("roller_race"))
    assert any("mean pressure over E*" in line for line in lines)
    assert not any(words in line for line in lines for words in ("a_y/a_x", "[deg]", "sliding"))


def test_draws_lie_in_the_domain_and_the_shipped_bearings_in_the_box():
    drawn = roller_box_contacts(ROLLER_BOX, 200, 3, random=True)
    assert len(drawn) == 200
    assert all(roller_fits(one, ROLLER_DOMAIN) for one in drawn)
    oils = [Lubricant.named(name) for name in ("mohammadpour_2015", "fva_3")]
    found = roller_contacts(200, 3, FilmPlan().bearings, oils, ROLLER_DOMAIN)
    assert all(kind_of(one) is BEARING_ROLLER for one in found)
    for name, values in (
        ("u [m/s]", [one.speed for one in found]),
        ("R [mm]", [1e3 * one.R for one in found]),
        ("conductivity [W/(m K)]", [one.conductivity for one in found]),
    ):
        low, high, _ = ROLLER_BOX[name]
        assert low <= min(values) < max(values) <= high
    with pytest.raises(ParameterError, match="at least one bearing"):
        roller_contacts(1, 3, (), oils, ROLLER_DOMAIN)


def test_rollers_are_kept_in_a_table_and_their_plan_in_its_folder(tmp_path):
    table = SolveTable(tmp_path / "solves.csv", BEARING_ROLLER)
    solved = Solved(4e-7, 3e-7, 2e-3, 5e8, 0.5, 0.0, 1.0, 0.1)
    row = SolveRow(FilmTask("bearing", 7, (513, 1), roller()), solved, "")
    table.keep(row_key(row.task), row)
    assert list(SolveTable(tmp_path / "solves.csv", BEARING_ROLLER).rows.values()) == [row]
    plan = FilmPlan(contact="roller", oils=("fva_3",))
    described = plan.described()
    # a plan from before there were bearings in it is still the same
    older = {name: value for name, value in described.items() if name != "bearings"}
    for stored in (described, older):
        (tmp_path / PLAN).write_text(json.dumps(stored))
        assert stored_plan(tmp_path) == plan
        check_plan(plan, tmp_path)
    with pytest.raises(ParameterError, match="bearings"):
        check_plan(FilmPlan(contact="roller", oils=("fva_3",), bearings=("x",)), tmp_path)
