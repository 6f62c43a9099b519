"""How docs/ehl.md counts films about formulas and follows a piece of a profile."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from docs.ehl.film_map import (
    ALPHA,
    COARSE,
    FINE,
    Contact,
    Film,
    add_film,
    grid_error,
    map_contacts,
    read_films,
    spread,
    turned_contacts,
)
from docs.ehl.micro_cavity import FASTER, ROLLING, SLIDING, SPEED, A, Passage, shift_between, speeds
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.film.groups import point_contact_groups

FILM = Film(Contact(2.0, 50.0, 5.0), FINE, True, "upwind-2", 0.0, 2e-7, 1e-7, 0.5)


def test_map_has_at_least_sixty_contacts_all_different():
    assert len(set(map_contacts())) == len(map_contacts()) >= 60
    assert len(set(turned_contacts())) == len(turned_contacts())


@pytest.mark.parametrize("contact", [Contact(1.0, 20.0, 5.0), Contact(3.0, 200.0, 10.0, 60.0)])
def test_contact_has_its_groups_and_ellipticity(contact):
    problem = contact.problem(33)
    groups = point_contact_groups(
        viscosity=problem.lubricant.eta0,
        pressure_viscosity=ALPHA,
        entrainment_speed=math.hypot(*problem.entrainment),
        load=problem.load,
        radius=problem.hertz.R_x,
        reduced_modulus=2.0 * problem.contact_modulus,
    )
    assert groups[3:] == pytest.approx((contact.M, contact.L), rel=1e-12)
    a_x, a_y, _ = hertz_ellipse(
        problem.hertz.R_x, problem.hertz.R_y, problem.contact_modulus, problem.load
    )
    assert a_y / a_x == pytest.approx(contact.ellipticity, rel=1e-6)
    u, v = problem.entrainment
    assert math.degrees(math.atan2(v, u)) == pytest.approx(contact.angle, abs=1e-9)


@pytest.mark.parametrize(
    ("contact", "rigid"),
    [
        (Contact(8.0, 10.0, 10.0), True),
        (Contact(5.0, 10.0, 2.5), True),
        (Contact(1.0, 100.0, 10.0), False),
        (Contact(8.0, 200.0, 5.0), False),
    ],
)
def test_rigid_contacts_are_those_where_kapitzas_film_is_the_thicker_one(contact, rigid):
    problem = contact.problem(33)
    R_x, R_y = problem.hertz.R_x, problem.hertz.R_y
    # Kapitza 1955: W = 12 pi eta u R_x/(3 + 2 R_x/R_y) (2 R_y/h)^(1/2)
    flow = 12.0 * math.pi * problem.lubricant.eta0 * problem.entrainment[0] * R_x
    kapitza = 2.0 * R_y * (flow / (3.0 + 2.0 * R_x / R_y) / problem.load) ** 2
    elastic = contact.formulas()["central film", "Hamrock and Dowson 1977"]
    assert contact.rigid == rigid == (kapitza > elastic)


def test_failures_lie_outside_every_limit():
    found = spread([0.95, 1.15, 1.25], 1, (0.1, 0.2, 0.3))
    assert (found.count, found.failed) == (4, 1)
    assert found.within == pytest.approx((0.25, 0.5, 0.75))
    assert found.mean == pytest.approx(3.35 / 3.0)
    assert (found.low, found.high) == (0.95, 1.25)


def test_films_are_kept_and_a_row_cut_off_is_not_read(tmp_path):
    path = tmp_path / "films.csv"
    failed = replace(FILM, nodes=COARSE, converged=False)
    for film in (FILM, failed):
        add_film(path, film)
    with path.open("a") as file:
        file.write("8.0,20.0,5.0")
    films = read_films(path)
    assert films == {(FILM.contact, FINE): FILM, (FILM.contact, COARSE): failed}
    assert FILM.sound
    assert not films[FILM.contact, COARSE].sound


def test_error_of_the_finer_grid_is_that_of_a_second_order_film():
    def film(nodes):
        height = 1e-7 * (1.0 + 40.0 / (nodes - 1) ** 2)
        return replace(FILM, nodes=nodes, central=height)

    films = {(FILM.contact, n): film(n) for n in (COARSE, FINE)}
    assert grid_error(films, FILM.contact, "central film") == pytest.approx(40.0 / 256**2, rel=0.01)


def test_shift_of_a_hump_between_nodes():
    x = np.linspace(-1.0, 1.0, 81)
    first, second = (np.exp(-(((x - centre) / 0.15) ** 2)) for centre in (-0.3, 0.112))
    start, end = 20, 37
    # a parabola through three nodes of a hump of twelve nodes: a hundredth of a node
    assert shift_between(x, first[start:end], start, second, 0.8) == pytest.approx(
        0.412, abs=0.02 * (x[1] - x[0])
    )


@pytest.mark.parametrize("case", [ROLLING, SLIDING, FASTER])
def test_speeds_of_two_humps_that_part(case):
    """The cavity's hump and the oil's leave one place at the edge of the contact."""
    x = np.linspace(-2.5 * A, 1.5 * A, 193)
    times = np.arange(0.0, 400.0) * 2e-5
    centre = np.array([case.centre(t) for t in times])
    entered = times[int(np.abs(centre + A).argmin())]
    oil = -A + SPEED * (times - entered)

    def hump(place, width):
        return 5e-8 * np.exp(-(((x - place[:, None]) / width) ** 2))

    change = hump(centre, 12e-6) + (hump(oil, 30e-6) if case.slide_roll else 0.0)
    passage = Passage(
        x=x,
        times=times,
        centre=centre,
        film=2e-7 + change,
        pressure=np.zeros_like(change),
        smooth_film=np.full(x.size, 2e-7),
        smooth_pressure=np.zeros(x.size),
        failures=0,
        seconds=0.0,
    )
    hollow, let_in = speeds(case, passage)
    # feet of the humps reach into each other's pieces
    assert hollow == pytest.approx(case.cavity_speed, rel=0.02)
    if case.slide_roll:
        assert let_in == pytest.approx(SPEED, rel=0.02)
