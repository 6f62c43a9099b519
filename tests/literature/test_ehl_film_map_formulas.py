"""Solved films of smooth contacts within the published scatter of the film formulas."""

from __future__ import annotations

import pytest

from docs.ehl.film_map import CHITTENDEN, HAMROCK_DOWSON, NIJENBANNING, Contact, solve

CENTRAL, MINIMUM = "central film", "minimum film"
NODES = 97  # films of these contacts lie within 1 % of those on 257 by 257
CONTACTS = (
    Contact(1.0, 20.0, 5.0),
    pytest.param(Contact(1.0, 50.0, 10.0), marks=pytest.mark.slow),
    pytest.param(Contact(2.0, 100.0, 5.0), marks=pytest.mark.slow),
    pytest.param(Contact(3.0, 50.0, 10.0), marks=pytest.mark.slow),
    pytest.param(Contact(5.0, 200.0, 5.0), marks=pytest.mark.slow),
    Contact(8.0, 100.0, 10.0),
)
_FILMS = {}


def film(contact):
    if contact not in _FILMS:
        _FILMS[contact] = solve(contact, NODES)
    return _FILMS[contact]


@pytest.mark.slow
@pytest.mark.parametrize("contact", CONTACTS)
def test_films_lie_within_the_scatter_of_the_formulas(contact):
    found = film(contact)
    assert found.sound
    # the fits scatter by 10 % to 20 % about computed films; that of Nijenbanning et al. knows no
    # density, which takes 7 % to 12 % off
    for source in (HAMROCK_DOWSON, CHITTENDEN, NIJENBANNING):
        assert found.ratio(CENTRAL, source) == pytest.approx(1.0, abs=0.2)
    # as above, at loads and ellipticities where the formulas hold
    for source in (HAMROCK_DOWSON, CHITTENDEN):
        assert found.ratio(MINIMUM, source) == pytest.approx(1.0, abs=0.2)


def test_central_over_smallest_film_grows_with_load_and_the_formulas_do_not_know():
    """Lubricants 6 (2018) 80: computed ratios span 1 to more than 3, those of formulas do not."""
    light, heavy = CONTACTS[0], Contact(1.0, 500.0, 5.0)
    ratio = [film(one).central / film(one).minimum for one in (light, heavy)]
    assert ratio[1] > 1.4 * ratio[0]
    formulas = [one.formulas() for one in (light, heavy)]
    by_formula = [f[CENTRAL, HAMROCK_DOWSON] / f[MINIMUM, HAMROCK_DOWSON] for f in formulas]
    # the powers of load differ by 0.006
    assert by_formula[1] == pytest.approx(by_formula[0], rel=0.03)


@pytest.mark.slow
@pytest.mark.parametrize(
    "angle",
    [pytest.param(30.0, marks=pytest.mark.slow), 60.0, pytest.param(90.0, marks=pytest.mark.slow)],
)
def test_central_films_entrained_at_an_angle_follow_chittenden(angle):
    found = film(Contact(2.0, 50.0, 10.0, angle))
    assert found.sound
    assert found.ratio(CENTRAL, CHITTENDEN) == pytest.approx(1.0, abs=0.2)
