"""Grids of point contacts, and film maps."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from docs.ehl.film_map import (
    ALPHA,
    COARSE,
    FINE,
    Contact,
    Film,
    all_films,
    grid_error,
    map_contacts,
    spread,
    turned_contacts,
)
from docs.ehl.micro_cavity import FASTER, ROLLING, SLIDING, SPEED, A, Passage, shift_between, speeds
from docs.kept_films import KeptFilms
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.ehl.point.newton import smoother, transfer
from gearlube_core.ehl.point.newton.single_stencil import SingleStencil
from gearlube_core.ehl.point.newton.smoother import ColumnSmoother, RowSmoother
from gearlube_core.ehl.point.newton.transfer import Hierarchy, grid_shapes
from gearlube_core.ehl.point.newton.wave import uniform_wave_deflection
from gearlube_core.ehl.point.settings import AMBIENT
from gearlube_core.ehl.point.terms.differences import Differences
from gearlube_core.ehl.point.terms.elements import Elements
from gearlube_core.film.groups import point_contact_groups
from gearlube_core.kernels.row_workers import ALONE
from tests.helpers.each import each
from tests.helpers.row_operators import dense_row, operator_of, some_entries
from tests.helpers.source_of import interpret


@each(
    ("nodes", "steps", "coarser"),
    [
        # up to 1300 nodes are solved directly
        ((26, 50), (1.0, 1.0), []),
        ((27, 49), (1.0, 1.0), [(14, 25)]),
        ((1, 1301), (1.0, 1.0), [(1, 651)]),
        # spacings within a ratio of 1.5 are halved together, else the smaller one first
        ((65, 65), (1.45, 1.0), [(33, 33)]),
        ((65, 65), (1.0, 1.45), [(33, 33)]),
        ((65, 65), (1.55, 1.0), [(33, 17), (65, 33)]),
        ((65, 65), (1.0, 1.55), [(17, 33), (33, 65)]),
        # 129 steps become 64 and their ratio 1.493; 128 become 64 and the ratio 1.505
        ((40, 130), (3.01, 1.0), [(20, 33), (40, 65)]),
        ((40, 129), (3.01, 1.0), [(20, 17), (40, 33), (40, 65)]),
        # sides of 12 nodes are not halved, also where theirs is the smaller spacing
        ((13, 401), (1.0, 0.9), [(7, 101), (7, 201)]),
        ((12, 401), (1.0, 0.9), [(12, 101), (12, 201)]),
        ((401, 12), (0.9, 1.0), [(101, 12), (201, 12)]),
        ((12, 200), (0.5, 1.0), [(12, 100)]),
        ((200, 12), (1.0, 0.5), [(100, 12)]),
    ],
)
def test_sides_are_halved_until_the_grid_is_solved_directly(nodes, steps, coarser):
    assert grid_shapes(nodes, steps) == [*coarser, nodes]


@pytest.mark.parametrize("swap", [False, True])
@pytest.mark.parametrize(
    ("ratio", "shapes"),
    [
        # dy/dx of 64 and 59 steps; with a node more or less on either side it is beyond 1.5
        (1.505, [(30, 17), (60, 33), (60, 65)]),
        (1.495, [(30, 33), (60, 65)]),
    ],
)
def test_grids_of_a_problem_are_those_of_its_limits(monkeypatch, swap: bool, ratio, shapes):
    made = []
    monkeypatch.setattr(transfer, "PointLevel", lambda *given, **more: made.append((given, more)))
    monkeypatch.setattr(transfer, "Transfer", lambda fine, coarse, sides: (fine, coarse))
    # 64 steps along x over 64 m, 59 along y over 59 ratio m
    problem = SimpleNamespace(nodes=(65, 60), spacing=(1.0, ratio), sides="ambient")
    scales = SimpleNamespace(swap=swap)
    grids = transfer.build_hierarchy(problem, scales, "quick", "elements", "jfo")
    if swap:
        shapes = [shape[::-1] for shape in shapes]
    assert [given for given, _ in made] == [(problem, scales, shape, "quick") for shape in shapes]
    assert made[0][1] == {"scheme": Elements, "cavitation": "jfo"}
    assert grids.transfers == [(fine, coarse) for coarse, fine in pairwise(shapes)]
    transfer.build_hierarchy(problem, scales, "quick")
    assert made[-1][1] == {"scheme": Differences, "cavitation": "reynolds"}


def test_grids_below_keep_the_transfers_between_them():
    levels, transfers = list("abcd"), ["a-b", "b-c", "c-d"]
    below = Hierarchy(levels, transfers).below(3)
    assert (below.levels, below.transfers) == (["a", "b", "c"], ["a-b", "b-c"])
    assert Hierarchy(levels, transfers).below(1).transfers == []


SHAPE = (7, 16)
GRID = SimpleNamespace(
    shape=SHAPE,
    modulus=0.02,
    graded=False,
    sides=AMBIENT,
    workers=ALONE,
    own_deflection=np.ones(SHAPE),
)


def solved(entries, free, residual, halved, spacing) -> np.ndarray:
    """Solve rows one by one, at 0.55 of the shortest wave across them and 0.35 of that along."""
    dy, dx = spacing
    wave = max(halved[0] * 0.55 * np.pi / dy, halved[1] * 0.35 * np.pi / dx)
    local = uniform_wave_deflection(free.shape[1], dx, GRID.modulus, wave)
    across = np.cos(np.arange(5) * min(wave * dy, 0.55 * np.pi))
    return np.array(
        [
            np.linalg.solve(
                dense_row(entries, free, local, across, j, 2, smoother.REACH), row * free[j]
            )
            for j, row in enumerate(residual)
        ]
    )


@pytest.mark.parametrize("halved", [(True, False), (False, True), (True, True)])
@pytest.mark.parametrize("spacing", [(0.02, 0.05), (0.05, 0.02)])
def test_rows_and_columns_are_solved_as_dense_matrices_say(monkeypatch, halved, spacing):
    interpret(monkeypatch, smoother)
    free = np.random.default_rng(9).random(SHAPE) < 0.85
    entries = some_entries(free)
    operator = operator_of(entries, free)
    dy, dx = spacing
    grid = SimpleNamespace(**vars(GRID) | {"dx": dx, "dy": dy})
    residual = np.random.default_rng(1).normal(size=SHAPE)
    stencil = SingleStencil.of(operator.matrix, SHAPE, 0, grid.own_deflection[0])
    found = RowSmoother(grid, operator, stencil, halved, 0.7)(residual)
    expected = 0.7 * solved(entries, free, residual, halved, spacing)
    # factors of single precision
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-4 * np.abs(expected).max())

    found = ColumnSmoother(grid, operator, halved, 0.7)(residual)
    turned = {(i, j, ii, jj): entry for (j, i, jj, ii), entry in entries.items()}
    expected = 0.7 * solved(turned, free.T, residual.T, halved[::-1], spacing[::-1]).T
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-4 * np.abs(expected).max())


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


def test_films_are_kept_and_missing_ones_left_out(tmp_path, monkeypatch):
    made = {COARSE: replace(FILM, nodes=COARSE, converged=False), FINE: FILM}
    for name, value in {
        "map_contacts": lambda: [FILM.contact],
        "turned_contacts": list,
        "solve": lambda contact, nodes: made[nodes],
    }.items():
        monkeypatch.setattr(f"docs.ehl.film_map.{name}", value)
    films = all_films(KeptFilms(tmp_path))
    assert films == {(FILM.contact, nodes): film for nodes, film in made.items()}
    assert FILM.sound
    assert not films[FILM.contact, COARSE].sound
    next(tmp_path.glob(f"*_{COARSE}.npz")).unlink()
    assert all_films(KeptFilms(tmp_path, compute=False)) == {(FILM.contact, FINE): FILM}


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
