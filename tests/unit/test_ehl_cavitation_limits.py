"""Which point contacts mass-conserving cavitation refuses."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import check_cavitation, refuse_rupture
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import moes_contact

EYRING = film_oil(eta0=0.04, alpha=2e-8, eyring_stress=5e6)
NEWTONIAN = film_oil(eta0=0.04, alpha=2e-8)
CONTACT = moes_contact(50.0, 10.0, nodes=(33, 33), lubricant=EYRING, oil_beyond=False)
CONSERVING = PointSolverSettings(cavitation="mass_conserving")
REYNOLDS = PointSolverSettings()


@pytest.mark.parametrize("sliding", [(1e-3, 2e-3), (-3.0, 4.0), (1.0, 1e-3), (3e-9, 4e-9)])
def test_eyring_oil_that_is_sheared_askew_is_refused(sliding):
    with pytest.raises(ParameterError, match="needs sliding along x or y, got"):
        check_cavitation(replace(CONTACT, sliding=sliding), CONSERVING)
    # neither a Newtonian oil nor the other cavitation minds
    check_cavitation(replace(CONTACT, sliding=sliding, lubricant=NEWTONIAN), CONSERVING)
    check_cavitation(replace(CONTACT, sliding=sliding), REYNOLDS)


@each("sliding", [(2.0, 0.0), (0.0, -2.0), (0.0, 0.0), (3.0, 1e-13), (300.0, 1e-10), None])
def test_sliding_along_an_axis_is_allowed(sliding):
    assert check_cavitation(replace(CONTACT, sliding=sliding), CONSERVING) is None  # no refusal


def test_starved_inlets_need_mass_conservation():
    starved = replace(CONTACT, inlet_layer=1e-7)
    check_cavitation(starved, CONSERVING)
    with pytest.raises(ParameterError, match="inlet_layer is 1e-07 m: a starved inlet needs"):
        check_cavitation(starved, REYNOLDS)


def test_touching_solids_go_with_the_other_cavitation_alone():
    contact = SimpleNamespace(
        solids=object(), lubricant=NEWTONIAN, sliding=None, inlet_layer=None, sides="ambient"
    )
    check_cavitation(contact, REYNOLDS)
    with pytest.raises(ParameterError, match="touching solids"):
        check_cavitation(contact, CONSERVING)


def test_films_that_change_take_the_other_cavitation():
    refuse_rupture(REYNOLDS, "in time")
    with pytest.raises(ParameterError, match="got a film in time"):
        refuse_rupture(CONSERVING, "in time")
