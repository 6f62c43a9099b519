"""Domain of a point contact: start, edges and deflection within a window."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.contact.findings import edge_warnings
from gearlube_core.ehl.gears.helical_film import solve_helical_line
from gearlube_core.ehl.point.contact_domain import elliptical_contact, line_section
from gearlube_core.ehl.point.equations.grid import PointGrid, ShortDeflection
from gearlube_core.ehl.point.equations.stencil import Grading
from gearlube_core.ehl.point.far_field import border_pressure
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.newton import flow_residual
from gearlube_core.ehl.point.newton.transfer import Transfer
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem, expected_film
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.solver import _hertz_start, solve_point_contact
from gearlube_core.ehl.point.start import zero_border
from gearlube_core.ehl.transient.rows import WindowedDeflection
from gearlube_core.kernels.row_workers import ALONE, RowWorkers
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.tooth_contact.sharp_edge import edges_that_carry
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import ALPHA, RADIUS, REDUCED_MODULUS, moes_contact, moes_film
from tests.helpers.jamali_2015 import jamali_2015_film


def level_of(problem, nodes):
    scales = PointScales.of(problem)
    shape = nodes if scales.swap else nodes[::-1]
    return PointLevel(problem, scales, shape, "upwind-1")


def widened(problem):
    """Semi-axes of the dry ellipse, widened to where a rigid film of that height carries."""
    a_x, a_y, _ = problem.hertz_contact
    film = expected_film(problem)
    return math.sqrt(a_x**2 + RADIUS * film), math.sqrt(a_y**2 + 3.0 * RADIUS * film)


@each("nodes", [(33, 33), (9, 33), (33, 9)])
@each("load", [3.0, 300.0])
def test_start_is_an_ellipse_of_pressure_that_carries_the_load(load, nodes):
    """As wide as a rigid film asks for, and as the grid can show."""
    problem = moes_contact(load, 5.0, nodes=(33, 33), radius_ratio=3.0)
    level = level_of(problem, nodes)
    state = _hertz_start(problem, level)
    inner = zero_border(state.pressure)  # the border has the pressure of the oil beyond it
    assert level.grid.integral(inner) == pytest.approx(level.load, rel=1e-12)
    squares = np.zeros(nodes)
    for axis, (at, semi_axis) in enumerate(
        zip((level.grid.x, level.grid.y), widened(problem), strict=True)
    ):
        width = max(semi_axis, 2.5 * (at[1] - at[0]))
        assert (width > semi_axis) == (nodes[axis] == 9)
        squares += np.expand_dims(at / width, 1 - axis) ** 2
    ellipse = zero_border(np.sqrt(np.maximum(0.0, 1.0 - squares)))
    largest = level.scales.outward(inner).max() / ellipse.max()
    np.testing.assert_allclose(level.scales.outward(inner), largest * ellipse, atol=1e-9 * largest)


@pytest.mark.parametrize("load", [30.0, 300.0])
def test_start_leaves_the_film_that_is_expected(load):
    problem = moes_contact(load, 5.0, nodes=(33, 33), radius_ratio=3.0)
    level = level_of(problem, (33, 33))
    film = _hertz_start(problem, level).film.min() * level.scales.film
    # the pressure of the oil beyond the border adds a little where the load is small
    assert film == pytest.approx(expected_film(problem), rel=1e-3)


def test_flow_that_is_unbalanced_counts_where_the_oil_is_free_over_that_through_the_dry_width():
    pressure = np.array([[0.0, 1.0, 0.0], [0.2, 2.0, 1.7], [0.0, 1.4, 0.0]])
    state = SimpleNamespace(
        pressure=pressure,
        residual=np.array([[9.0, -0.2, 0.3], [0.1, 0.4, -0.1], [9.0, 0.2, 9.0]]),
        free=np.array([[False, True, True], [True, True, True], [False, True, False]]),
        film=np.array([[5.0, 2.0, 5.0], [2.0, 0.6, 0.8], [5.0, 1.5, 5.0]]),
        contact=SimpleNamespace(unbalanced=lambda residual, grid: 0.25),
    )
    grid = SimpleNamespace(integral=lambda values: 0.5 * values.sum())
    level = SimpleNamespace(grid=grid, half_width=0.4)
    # 0.5 x 1.3 and 0.25 of solids; nodes above 0.8 of the largest pressure have films 0.6 and 0.8
    assert flow_residual(level, state) == pytest.approx(0.9 / (0.8 * 0.7), rel=1e-14)
    state.film = -state.film
    assert flow_residual(level, state) == math.inf


def _expected_group(M, ratio):
    """H of an isoviscous contact after the formulas of rigid and of soft solids, lam = 1/ratio."""
    lam = 1.0 / ratio
    rigid = 2.0 * ratio * (6.0 * math.pi / ((3.0 + 2.0 * lam) * M)) ** 2
    c = 1.0 + 0.006 * math.log(lam) + 0.63 * lam ** (4.0 / 7.0)
    soft = 3.18 * c**-0.56 * lam ** (-1.0 / 15.0) * M ** (-2.0 / 15.0)
    return max(rigid, min(soft, 1.8 / lam))


@each("ratio", [1.0, 3.0])
@each("M", [1.0, 5.0, 20.0, 300.0])
def test_expected_film_of_a_constant_viscosity_is_that_of_rigid_or_soft_solids(M, ratio):
    # Kapitza; Nijenbanning, Venner and Moes
    problem = moes_contact(M, 0.0, nodes=(33, 33), radius_ratio=ratio)
    assert moes_film(problem, expected_film(problem)) == pytest.approx(
        _expected_group(M, ratio), rel=1e-12
    )


@each("angle", [0.0, 0.4, 0.5 * math.pi])
@each("turned", [False, True])
def test_expected_film_of_a_piezoviscous_oil_is_that_of_chittenden(angle, turned):
    problem = moes_contact(100.0, 12.0, nodes=(33, 33), radius_ratio=2.0, angle=angle)
    if turned:  # the same contact with its axes exchanged
        shape = EllipticParaboloid(2.0 * RADIUS, RADIUS)
        problem = replace(problem, gap=shape, hertz=shape, entrainment=problem.entrainment[::-1])
    cos, sin = math.cos(angle) ** 2, math.sin(angle) ** 2
    R_e, R_s = RADIUS / (cos + 0.5 * sin), RADIUS / (sin + 0.5 * cos)
    E, oil = REDUCED_MODULUS, problem.lubricant
    U = oil.eta0 * math.hypot(*problem.entrainment) / (E * R_e)
    side_flow = 1.0 - math.exp(-1.23 * (R_s / R_e) ** (2.0 / 3.0))
    film = 4.31 * R_e * U**0.68 * (ALPHA * E) ** 0.49 * (problem.load / (E * R_e**2)) ** -0.073
    assert expected_film(problem) == pytest.approx(film * side_flow, rel=1e-12)


@pytest.mark.parametrize(("M", "films"), [(1.0, 320.0), (20.0, None), (300.0, None)])
def test_flooded_domain_reaches_to_a_gap_of_20_films_and_of_320_under_thick_ones(M, films):
    problem = moes_contact(M, 0.0, nodes=(33, 33), oil_beyond=False)
    a, film = problem.hertz_contact[0], expected_film(problem)
    thickness = min(1.0, film * RADIUS / a**2)
    if films is None:
        assert thickness < 1.0
        films = 20.0 * (1.0 + 15.0 * thickness**4)
    else:
        assert thickness == 1.0
    flooded = a + math.sqrt(2.0 * RADIUS * films * film)
    side = max(2.0 * a, (0.6 + 0.4 * thickness) * flooded)
    assert problem.x_limits == pytest.approx((-max(2.5 * a, flooded), max(1.5 * a, 0.3 * flooded)))
    assert problem.y_limits == pytest.approx((-side, side))
    # oil beyond the border makes up for what a near border leaves out
    near = moes_contact(M, 0.0, nodes=(33, 33), oil_beyond=True)
    reach = max(2.5 * a, a + math.sqrt(2.0 * RADIUS * 20.0 * film))
    assert near.x_limits[0] == pytest.approx(-reach)


def contact(edge=None, pressure=1.0):
    """Pressures of a band from (6, 10) to (20, 40) on 24 x 48 cells, with one cell at an edge."""
    s, t = np.meshgrid(np.arange(24), np.arange(48), indexing="ij")
    inside = 1.0 - ((s - 13.0) / 8.0) ** 2 - ((t - 25.0) / 16.0) ** 2
    found = 1.2e9 * np.sqrt(np.maximum(inside, 0.0))
    if edge is not None:
        found[edge] = pressure * found.max()
    return found


@pytest.mark.parametrize(
    ("edge", "name"),
    [((23, 30), "gear tip"), ((2, 20), "pinion tip"), ((12, 0), "toe"), ((12, 47), "heel")],
)
def test_an_edge_carries_where_the_highest_pressure_is(edge, name):
    assert edges_that_carry(contact()) == {}
    assert edges_that_carry(contact(edge, 1.1)) == {name: pytest.approx(1.1 * 1.2e9, rel=0.01)}
    assert edges_that_carry(contact(edge, 0.5)) == {}


def test_the_torque_from_which_on_an_edge_carries_is_named_once():
    maps = [contact(), contact((23, 30), 1.1), contact((23, 30), 2.0)]
    sound = [contact()] * 3
    found = edge_warnings(
        xr.Dataset(
            {"pressure_map": (("side", "torque", "s", "t"), np.array([maps, sound]))},
            coords={"side": ["drive", "coast"], "torque": [50.0, 150.0, 300.0]},
        )
    )
    assert len(found) == 1
    assert "from 150 N.m on a sharp edge carries, at the gear tip" in found[0]
    assert "gear.drive_flank.tip_relief_um" in found[0]


PLACES = {"small x": (1, 4), "large x": (-2, 4), "small y": (4, 1), "large y": (4, -2)}


@pytest.mark.parametrize("side", PLACES)
def test_side_with_the_most_pressure_is_named(side):
    pressure, film = np.zeros((9, 9)), np.ones((9, 9))
    pressure[4, 4] = 2.0
    assert border_pressure(pressure, film).sentence == ""
    pressure[PLACES[side]] = 0.5
    found = border_pressure(pressure, film)
    assert found.share == 0.25
    assert found.side == side
    assert f"{side} is 25 %" in found.sentence


def test_pressure_beside_the_end_of_a_tooth_is_no_cut():
    pressure, film = np.zeros((9, 9)), np.ones((9, 9))
    pressure[:, 1:-1] = 1.0
    pressure[[0, 1, -2, -1]] = 0.0
    assert border_pressure(pressure, film).share == 1.0
    film[:, [0, -1]] = 50.0
    assert border_pressure(pressure, film).sentence == ""


def test_spoilt_pressure_says_nothing():
    assert border_pressure(np.full((9, 9), np.nan), np.ones((9, 9))).sentence == ""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("velocity", "kept", "end"),
    [
        (2.5, 0.6, "large x"),
        (-2.5, 0.6, "small x"),
        # cut so near its middle that no film is found: hundreds of steps
        pytest.param(2.5, 0.3, "large x", marks=pytest.mark.slow),
        pytest.param(-2.5, 0.3, "small x", marks=pytest.mark.slow),
    ],
)
def test_point_contact_cut_behind_its_middle_says_so(velocity, kept, end):
    problem = elliptical_contact(
        R_x=0.0177,
        R_y=0.05,
        entrainment=(velocity, 0.0),
        load=400.0,
        contact_modulus=115.4e9,
        lubricant=film_oil(eta0=0.0171, alpha=2.38e-8),
        nodes=(33, 33),
    )
    whole = solve_point_contact(problem)
    assert "cuts" not in whole.outcome.sentence
    low, high = problem.x_limits
    limits = (low, kept * high) if velocity > 0.0 else (kept * low, high)
    cut = solve_point_contact(replace(problem, x_limits=limits), throw=False)
    assert f"at {end} is" in cut.outcome.sentence
    assert "Widen" in cut.outcome.sentence


@pytest.mark.slow
def test_steep_relief_is_pushed_out_of_the_domain_of_the_thesis():
    # Jamali 2015 sec. 5.4: k = 0.02 at step 500; his domain ends 1.775 semi-widths behind the line
    film = jamali_2015_film("a", k=0.02, nodes=(49, 97))
    cut = solve_helical_line(film, 500, throw=False)
    assert cut.border_pressure > 0.05
    assert "at large x is" in cut.outcome
    wide = solve_helical_line(replace(film, extent=(-2.75, 2.75)), 500, throw=False)
    assert wide.border_pressure < 0.01
    assert "cuts" not in wide.outcome


def closed_grid(sides: str) -> PointGrid:
    section = line_section(
        R_x=0.014,
        length=2e-3,
        line_load=3.6e5,
        speed_1=7.9,
        speed_2=5.5,
        contact_modulus=1.1e11,
        lubricant=film_oil(eta0=0.00625, alpha=13.3e-9),
        nodes=(101, 32),
        sides=sides,
    )
    return PointGrid(section, PointScales.of(section), (32, 101))


def open_grid() -> PointGrid:
    contact = moes_contact(50.0, 5.0, nodes=(65, 49))
    return PointGrid(contact, PointScales.of(contact), (49, 65))


@each("halved", [(False, True), (True, True)])
@each("grid", [closed_grid("cyclic"), closed_grid("no_flow"), open_grid()])
def test_short_waves_deflect_as_the_whole_transform_says(grid, halved):
    ny, nx = grid.y.size, grid.x.size
    smaller = grid.sides.halved(ny) if halved[0] else ny, (nx - 1) // 2 + 1 if halved[1] else nx
    transfer = Transfer((ny, nx), smaller, grid.sides)
    pressure = np.zeros(grid.shape, dtype=np.float32)
    grid.sides.inner(pressure)[...] = np.random.default_rng(3).normal(size=(ny, nx))
    for _ in range(3):  # once leaves a part of the waves that the coarser grid has
        pressure -= transfer.up(transfer.down(pressure))
    grid.sides.fill(pressure)
    expected = np.array(grid.single_deflection(pressure))
    found = grid.short_deflection(pressure, halved)
    # waves about twice as long as the shortest are in part on either grid
    error = np.sqrt(np.mean((found - expected) ** 2) / np.mean(expected**2))
    assert error < 0.1


def test_only_some_dozens_of_neighbours_count():
    grid = closed_grid("cyclic")
    assert ShortDeflection(grid.coefficients, grid.sides, (False, True)).weights.size < 40


def test_threads_change_no_bit(monkeypatch):
    monkeypatch.setattr("gearlube_core.kernels.row_workers._FEW", 1)
    grid = closed_grid("cyclic")
    short = ShortDeflection(grid.coefficients, grid.sides, (False, True))
    pressure = np.random.default_rng(4).normal(size=grid.shape).astype(np.float32)
    assert (short(pressure, ALONE) == short(pressure, RowWorkers(3))).all()


SHAPE = (97, 41)  # (ny, nx)


def level(grading: Grading | None = None) -> PointLevel:
    hertz = EllipticParaboloid(0.01, 0.4)
    problem = PointContactProblem(
        gap=hertz,
        entrainment=(1.0, 0.0),
        load=100.0,
        contact_modulus=1.1e11,
        lubricant=film_oil(eta0=0.05, alpha=15e-9),
        x_limits=(-1e-3, 1e-3),
        y_limits=(-5e-3, 5e-3),
        nodes=(SHAPE[1], SHAPE[0]),
        hertz=hertz,
    )
    return PointLevel(problem, PointScales.of(problem), SHAPE, "upwind-2", grading)


def patch(rows: slice, columns: slice) -> np.ndarray:
    free = np.zeros(SHAPE, dtype=bool)
    free[rows, columns] = True
    return free


@pytest.mark.parametrize("grading", [None, Grading((-1e-3, 0.0, 1e-3), (2.0, 1.0, 1.0))])
def test_box_follows_the_pressure(grading):
    grid, random = level(grading).grid, np.random.default_rng(3)
    window = WindowedDeflection(grid)
    # a line that grows, moves on and shrinks
    for rows in (slice(1, 9), slice(1, 60), slice(5, 62), slice(40, 96), slice(90, 96)):
        free = patch(rows, slice(7, 33))
        window.follow(free)
        pressure = np.where(free, random.random(SHAPE), 0.0)
        whole = grid.deflection(pressure)
        seen = patch(slice(max(rows.start - 2, 0), rows.stop + 2), slice(5, 35))
        # single precision: 6e-8 a number, some times that after transforms of 10^4 numbers
        assert window(pressure)[seen] == pytest.approx(whole[seen], rel=3e-6)


def test_box_of_a_part_leaves_the_rest_zero():
    grid = level().grid
    window = WindowedDeflection(grid)
    window.follow(patch(slice(10, 20), slice(10, 20)))
    film = window(np.where(patch(slice(10, 20), slice(10, 20)), 1.0, 0.0))
    assert film[15, 15] > 0.0
    assert not film[60:].any()


def test_box_of_nothing_is_there():
    window = WindowedDeflection(level().grid)
    window.follow(np.zeros(SHAPE, dtype=bool))
    assert not window(np.zeros(SHAPE)).any()
