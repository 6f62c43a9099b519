"""Parts of the line contact's Newton iteration on made-up systems of few nodes."""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.line import newton as module
from gearlube_core.ehl.line.system import LineState
from tests.helpers.each import each


def system(**given):
    """Five nodes; the deflection is a tenth of the pressure, the gap one."""
    n = 5
    rows = SimpleNamespace(
        residual=np.array([9.0, 0.2, -0.3, 0.5, 9.0]),
        rho=np.array([1.0, 1.1, 1.2, 1.1, 1.0]),
        by_pressure=np.tile([7.0, 7.0, -3.0, 7.0, 7.0], (n, 1)),
        eta_slope=np.full(n, 4.0),
    )
    found = SimpleNamespace(
        rows=rows, mass_conserving=False, least=0.0, H=np.array([2.0, 0.6, 0.5, 0.7, 3.0]),
        touching=np.zeros(n, dtype=bool),
        coefficients=SimpleNamespace(speed=-0.8, storage=0.0, step=0.25),
        deflection=lambda P: 0.1 * P,
        evaluate=lambda state: None,
    )  # fmt: skip
    found.film = lambda state: state.H0 + 1.0 + found.deflection(state.P)
    vars(found).update(given)
    return found


P = np.array([0.0, 0.2, 1.0, 0.8, 0.0])
STATE = LineState(P, np.zeros(5), -0.5)
LOADED = 0.5 * (1.2 * 0.5 + 1.1 * 0.7)  # mean of rho H where the pressure is above 0.3


def test_flow_through_the_contact_is_the_scale_of_residuals():
    assert module.flow_scale(system(), STATE) == pytest.approx(0.8 * LOADED, rel=1e-14)
    still = SimpleNamespace(speed=0.0, storage=300.0, step=0.25)
    found = module.flow_scale(system(coefficients=still), STATE)
    assert found == pytest.approx(0.3 * LOADED, rel=1e-14)


@pytest.mark.parametrize(
    ("conserving", "touching", "wrong"),
    [
        # node 1 is free, the others broken: what they lack counts, what they gain does not
        (False, False, 0.2 + 0.3),
        (True, False, 0.2 + 0.3 + 0.5),
        # node 3 is held at the least film of 0.05 and may press, not suck
        (False, True, 0.2 + 0.3 + 0.65),
        (True, True, 0.2 + 0.3 + 0.65),
    ],
)
def test_residual_counts_what_each_kind_of_node_may_not_do(conserving, touching, wrong):
    given = system(mass_conserving=conserving, least=0.05)
    given.touching[3] = touching
    free = np.array([True, True, False, False, True])
    found = module.flow_residual(given, STATE, free)
    assert found == pytest.approx(wrong / (0.8 * LOADED), rel=1e-13)


def test_rounding_is_that_of_carried_and_pumped_flow():
    coefficients = SimpleNamespace(speed=-0.8, storage=2.0, step=0.25)
    given = system(coefficients=coefficients)
    carried = 1.3 * (2.0 + 0.66 + 0.6 + 0.77 + 3.0)  # |speed| and storage over a step
    pumped = 0.1 * 3.0 * 2.0
    expected = 20.0 * 2.0**-52 * (carried + pumped) / (0.8 * LOADED)
    assert module.rounding_floor(given, STATE) == pytest.approx(expected, rel=1e-13, abs=0.0)


@each(
    ("dP", "dH0", "least", "expected"),
    [
        (0.1, 0.0, 0.0, 1.0),
        (0.0, -1.0, 0.0, 0.45),  # 0.9 of the least film, 0.5
        (0.0, -1.0, 0.01, 1.0),  # solids stop it
        (-1.0, 0.0, 0.01, 0.6),  # rise of pressure
        (1.0, 0.0, 0.0, 0.6),
        (0.1, 0.0, 0.0, 0.15),  # with oil that thickens by exp(400 p)
    ],
)
def test_step_leaves_a_tenth_of_the_film_and_bounded_changes(dP, dH0, least, expected):
    given = system(least=least)
    if expected == 0.15:
        given.rows.eta_slope[2] = -400.0
    change = np.array([0.0, 0.0, dP, 0.0, 0.0])
    found = module._step_length(given, STATE, change, dH0)
    assert found == pytest.approx(expected, rel=1e-14)


FULL = np.array([False, True, True, True, False])


def advanced(given, dP, dvoid=(0.0,) * 5, dH0=0.0, s=1.0, state=STATE, full=FULL):
    change = np.array(dP), np.array(dvoid), dH0
    return module._advance(given, state, full, change, s)


def test_step_moves_pressure_and_approach_and_cuts_suction_off():
    given = system()
    trial, full = advanced(given, [0.0, -0.6, 0.4, -0.2, 0.0], dH0=0.2, s=0.5)
    np.testing.assert_allclose(trial.P, [0.0, 0.0, 1.2, 0.7, 0.0], atol=1e-15)
    assert pytest.approx(-0.4, rel=1e-14) == trial.H0
    # node 1 would suck and keeps oil: it breaks; a broken node that lacks oil fills again
    np.testing.assert_array_equal(full, [False, False, True, True, False])
    assert not given.touching.any()
    empty = LineState(np.zeros(5), np.zeros(5), -0.5)
    _, full = advanced(system(), np.zeros(5), state=empty)
    np.testing.assert_array_equal(full, [False, False, True, False, False])


def test_voids_stay_between_nothing_and_all_and_close_where_the_film_is_full():
    given = system(mass_conserving=True)
    state = LineState(
        np.array([0.0, 0.5, 0.0, 0.0, 0.0]), np.array([0.3, 0.2, 0.4, 0.1, 0.9]), -0.5
    )
    full = np.array([False, True, False, False, False])
    trial, full = advanced(
        given, [0.0, 0.1, 0.2, 0.0, 0.0], (-0.4, 0.3, 0.3, -0.2, 0.4), state=state, full=full
    )
    # node 3 has more oil than room: full; node 2 is broken whatever its pressure
    np.testing.assert_array_equal(full, [False, True, False, True, False])
    np.testing.assert_allclose(trial.void, [0.0, 0.0, 0.7, 0.0, 1.0], atol=1e-15)


def test_solids_meet_below_the_least_film_and_part_where_they_would_suck():
    given = system(least=0.55)
    given.touching[:] = [False, False, False, True, False]
    # films 0.5 + P/10 are 0.50, 0.52, 0.60, 0.58 and 0.50
    _, full = advanced(given, np.zeros(5))
    # 1 meets; 3 has pressure and gains oil: it stays; the ends never touch
    np.testing.assert_array_equal(given.touching, [False, True, False, True, False])
    np.testing.assert_array_equal(full, [False, True, True, True, False])
    given.rows.residual[3] = -0.1
    advanced(given, np.zeros(5))
    np.testing.assert_array_equal(given.touching, [False, True, False, False, False])
    film_only = system(least=0.0)
    film_only.touching[1] = True
    advanced(film_only, np.zeros(5), dH0=-1.0)
    assert not film_only.touching.any()
