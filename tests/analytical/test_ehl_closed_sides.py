"""Films whose sides along y are closed: lines, shifts, mirrors, seams, in time with solids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.contact.half_space_periodic import PeriodicDeflection, periodic_modes
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.transient import LineHistory, LineMarch
from gearlube_core.ehl.point.contact_domain import elliptical_contact, line_section
from gearlube_core.ehl.point.problem import EllipticParaboloid
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.history import MarchRecord
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import moving_section
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil import film_properties
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import dry_contact

# [jamali_2015] Table 7.1: 720 N over 2 mm, mean 6.71 m/s, slide-roll ratio 0.36
R, W, FAST, SLOW, MODULUS = 0.014, 3.6e5, 7.9178, 5.5022, 0.5 * 227.5e9
EYRING = film_oil(eta0=0.00625, alpha=13.3e-9, eyring_stress=10e6)
NEWTONIAN = film_oil(eta0=0.00625, alpha=13.3e-9)
L = 0.4e-3
QUICK = PointSolverSettings(estimate_error=False)
STRICT = replace(QUICK, tolerance=1e-9, load_tolerance=1e-10)


def section(nodes=(129, 16), *, oil=EYRING, length=L, sides="cyclic", line_load=W):
    return line_section(
        R_x=R,
        length=length,
        line_load=line_load,
        speed_1=FAST,
        speed_2=SLOW,
        contact_modulus=MODULUS,
        lubricant=oil,
        nodes=nodes,
        sides=sides,
    )


def line(part, nodes, gap=None, **settings):
    problem = LineProblem(
        lubricant=part.lubricant,
        radius=R,
        line_load=part.line_load,
        reduced_modulus=2.0 * MODULUS,
        speed_1=FAST,
        speed_2=SLOW,
        domain=part.x_limits,
        gap=gap,
    )
    return solve_line(problem, LineSettings(nodes=nodes, **settings))


@pytest.mark.slow
def test_smooth_section_is_the_line_contact():
    # 801 columns: both solvers differ by second order in the spacing at the spike
    part = section((801, 16), length=2e-3)
    film, reference = solve_point_contact(part, QUICK), line(part, 801)
    assert film.pressure == pytest.approx(
        np.tile(reference.pressure[:, None], 16), abs=1e-3 * reference.pressure.max()
    )
    assert film.minimum_film == pytest.approx(reference.minimum_film, rel=1e-3)
    # the thesis: 0.95 GPa; the line solver on 20001 nodes: 0.958 GPa and 0.2075 um
    assert film.maximum_pressure == pytest.approx(0.958e9, rel=1e-3)
    assert film.minimum_film == pytest.approx(0.2075e-6, rel=1e-3)
    # rows that equal each other to the tolerance of the flow
    assert np.ptp(film.film, axis=1).max() < 1e-6 * film.minimum_film
    assert film.load == pytest.approx(720.0, rel=1e-6)
    assert "cuts the contact" not in film.outcome.sentence


@pytest.mark.slow
def test_friction_of_a_section_counts_every_row():
    part = section((201, 16))
    film, reference = solve_point_contact(part, QUICK), line(part, 201)
    # 16 rows of 25 um each, the trapezoidal rule between them would leave one out: 6 %; the two
    # films differ by 0.3 % on this grid
    assert film.friction_coefficient == pytest.approx(abs(reference.friction_coefficient), rel=5e-3)


def wavy(part, across=2, amplitude=0.1e-6, phase=0.0):
    """Crossing waves: 8 cells and more a wave, across whole waves over the length."""
    k_x, k_y = 2.0 * np.pi / (0.4e-3), 2.0 * np.pi * across / L

    def gap(x, y):
        return part.gap(x, y) - amplitude * np.cos(k_x * x + k_y * y + phase)

    return replace(part, gap=gap)


@pytest.mark.slow
@pytest.mark.parametrize("sides", ["cyclic", "no_flow"])
def test_film_of_shifted_solids_is_shifted_where_the_sides_are_cyclic(sides):
    # k rows are a phase of 2 pi k/8: where oil passes the sides no row is special
    part = section(sides=sides)
    film = solve_point_contact(wavy(part), STRICT)
    for rows in (1, 5):
        moved = solve_point_contact(wavy(part, phase=2.0 * np.pi * rows / 8.0), STRICT)
        off = np.abs(np.roll(film.pressure, -rows, axis=1) - moved.pressure).max()
        if sides == "cyclic":
            assert off < 1e-7 * film.maximum_pressure  # 100 times the tolerance of the flow
            assert np.roll(film.film, -rows, axis=1) == pytest.approx(moved.film, rel=1e-7)
        else:
            assert off > 1e-3 * film.maximum_pressure


@pytest.mark.parametrize("sides", ["cyclic", "no_flow"])
def test_what_enters_the_columns_leaves_them(sides):
    # flow through a column of faces: between columns under pressure it does not change, so
    # nothing is lost or made at the sides. In rows alone it does change: oil goes round.
    part = wavy(section(sides=sides, oil=NEWTONIAN))
    film = solve_point_contact(part, replace(STRICT, wedge="upwind-1"))
    x, p, h = part.x, film.pressure, film.film
    eta, _, rho, _ = film_properties(NEWTONIAN, p, None)
    # through faces where pressure falls downstream: plain mean of 1/eta, mean of ln(rho h^3)
    carried = 0.5 * (FAST + SLOW) * (rho * h)[:-1]
    mobility = np.sqrt((rho * h**3)[:-1] * (rho * h**3)[1:]) / 12.0
    mobility *= 0.5 * (1.0 / eta[:-1] + 1.0 / eta[1:])
    flow = carried - mobility * np.diff(p, axis=0) / (x[1] - x[0])
    falling = (np.diff(p, axis=0) < 0.0).all(axis=1) & (p[1:] > 0.0).all(axis=1)
    falling = np.flatnonzero(falling & (x[1:] > 0.05e-3))
    assert falling.size >= 5
    total = flow[falling].sum(axis=1)
    # the unbalanced flow of 1e-9 counts once
    assert total == pytest.approx(np.full(total.size, total[0]), rel=1e-8)
    assert np.abs(flow[falling] / flow[falling[0]] - 1.0).max() > 1e-4


@pytest.mark.slow
def test_closed_sides_are_mirrors_where_the_solids_are_symmetric_about_them():
    # cos(k y) is even about y = 0 and y = L: no oil would pass there anyway
    k = 2.0 * np.pi / L

    def even(part):
        return replace(part, gap=lambda x, y: part.gap(x, y) - 0.1e-6 * np.cos(k * y))

    cyclic = solve_point_contact(even(section()), STRICT)
    closed = solve_point_contact(even(section(sides="no_flow")), STRICT)
    assert closed.pressure == pytest.approx(cyclic.pressure, abs=1e-7 * cyclic.maximum_pressure)
    assert cyclic.pressure[:, ::-1] == pytest.approx(
        cyclic.pressure, abs=1e-7 * cyclic.maximum_pressure
    )
    # while for solids that are not, the mirror image of a film is the film of the mirror image
    odd = section(sides="no_flow")
    turned = replace(odd, gap=lambda x, y: wavy(odd).gap(x, L - y))
    film, image = (solve_point_contact(one, STRICT) for one in (wavy(odd), turned))
    off = np.abs(film.pressure[:, ::-1] - image.pressure).max()
    assert off < 1e-7 * film.maximum_pressure


def test_two_periods_hold_the_film_of_one_twice():
    one = solve_point_contact(wavy(section()), STRICT)
    two = solve_point_contact(wavy(section((129, 32), length=2.0 * L)), STRICT)
    assert two.pressure == pytest.approx(np.tile(one.pressure, 2), abs=1e-7 * one.maximum_pressure)
    assert two.load == pytest.approx(2.0 * one.load)


@pytest.mark.slow
def test_elements_find_the_film_of_differences_between_cyclic_sides():
    film = solve_point_contact(wavy(section((257, 16))), QUICK)
    other = solve_point_contact(wavy(section((257, 16))), replace(QUICK, discretisation="elements"))
    # two discretisations of second order, 8 nodes a wave along y; the constriction differs more
    flat = np.abs(film.problem.x) < 0.1e-3
    assert other.film[flat] == pytest.approx(film.film[flat], rel=0.02)
    moved, again = (
        solve_point_contact(
            wavy(section(), phase=phase), replace(STRICT, discretisation="elements")
        )
        for phase in (np.pi / 4.0, 0.0)
    )
    assert np.roll(again.film, -1, axis=1) == pytest.approx(moved.film, rel=1e-6)


def test_dry_cylinders_that_repeat_are_hertz():
    part = section((401, 16))
    dry = dry_contact(part)
    a, _, pressure = part.hertz_contact
    hertz = pressure * np.sqrt(np.maximum(1.0 - (part.x / a) ** 2, 0.0))
    # cells at the edge of the contact, 100 a half width: (1/100)^(1/2) of 0.1 of p_max
    assert dry.pressure == pytest.approx(np.tile(hertz[:, None], 16), abs=0.03 * pressure)
    assert dry.pressure[np.abs(part.x).argmin()] == pytest.approx(np.full(16, pressure), rel=1e-3)
    assert not dry.touches_border


def straight_wave(x, time, amplitude=0.1e-6, wavelength=0.2e-3):
    """A wave of the faster solid that comes in from upstream, smoothly."""
    behind = np.clip((FAST * time - x - 0.2e-3) / 0.2e-3, 0.0, 1.0)
    grown = behind * behind * (3.0 - 2.0 * behind)
    return amplitude * grown * np.cos(2.0 * np.pi * (x - FAST * time) / wavelength)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("discretisation", "nodes", "steps", "closest", "thinnest"),
    [
        # of the largest pressure and the smallest film; on half the spacing a third of it, of
        # elements 0.44 of the pressure, where the line has a spike
        ("differences", 201, 30, 0.018, 0.018),
        ("elements", 201, 30, 0.035, 0.018),
        pytest.param("differences", 801, 220, 1.2e-3, 1.2e-3, marks=pytest.mark.slow),
        pytest.param("elements", 401, 60, 0.016, 6e-3, marks=pytest.mark.slow),
    ],
)
def test_straight_waves_in_time_are_the_line_in_time(
    discretisation, nodes, steps, closest, thinnest
):
    # every step, of 2 columns; both march by the same formula, with other means on the faces
    part = section((nodes, 16))
    film = moving_section(part, lambda x, y, t: straight_wave(x[:, None], t) + 0.0 * y)
    dt = 2.0 * part.spacing[0] / FAST
    settings = replace(QUICK, wedge="upwind-2", tolerance=1e-7, discretisation=discretisation)
    march = FilmMarch(film, dt, settings=settings)

    def gap(x, t):
        return x * x / (2.0 * R) - straight_wave(x, t)

    start = line(part, nodes, gap=lambda x: gap(x, 0.0))
    reference, changed = LineMarch(start, LineHistory(gap=gap), dt), 0.0
    for _ in range(steps):
        now, then = march.step(), reference.step()
        off = np.abs(now.pressure.mean(axis=1) - then.pressure).max()
        assert off < closest * then.pressure.max()
        assert now.minimum_film == pytest.approx(then.minimum_film, rel=thinnest)
        assert np.ptp(now.film, axis=1).max() < 1e-6 * now.minimum_film
        changed = max(changed, abs(now.minimum_film / start.minimum_film - 1.0))
    assert changed > 0.03


# films of elements in time between these sides are in the default run with straight waves
@pytest.mark.slow
@pytest.mark.parametrize(
    "discretisation", ["differences", pytest.param("elements", marks=pytest.mark.slow)]
)
def test_shifted_roughness_that_touches_moves_the_film_by_rows(discretisation):
    # touching solids, crossing waves of both surfaces; a march cannot tell the seam from a row
    part = section((129, 16), line_load=2e5)

    def heights(rows):
        def given(x, y, t):
            y = y[None, :] + rows * L / 16.0
            grown = min(1.0, t / 4e-6) * 0.6e-6
            k_x, k_y = 2.0 * np.pi / 0.15e-3, 2.0 * np.pi / L
            one = np.cos(k_x * (x[:, None] - FAST * t) + k_y * y)
            return grown * (one + np.cos(k_x * (x[:, None] - SLOW * t) - k_y * y)) * 0.5

        return given

    films = []
    for rows in (0, 3):
        march = FilmMarch(
            moving_section(part, heights(rows), SolidContact(thickness=0.15e-6)),
            0.5 * part.spacing[0] / FAST,
            settings=replace(
                QUICK,
                wedge="quick",
                tolerance=1e-7,
                load_tolerance=1e-8,
                discretisation=discretisation,
            ),
        )
        for _ in range(12):
            solution = march.step()
        films.append(solution)
    assert films[0].touch.share > 1e-4
    assert np.roll(films[0].film, -3, axis=1) == pytest.approx(films[1].film, rel=1e-5)
    assert films[1].load == pytest.approx(2e5 * L, rel=1e-8)


def test_elements_in_time_refuse_what_they_have_not():
    film = moving_section(section((65, 16)), lambda x, y, t: 0.0 * x[:, None] * y)
    elements = replace(QUICK, discretisation="elements")
    with pytest.raises(ParameterError, match=r"crank_nicolson, got elements.*Take bdf2"):
        FilmMarch(film, 1e-7, scheme="crank_nicolson", settings=elements)
    long = replace(film, sides="ambient", y_limits=(0.0, 10.0 * L), nodes=(65, 17))
    with pytest.raises(ParameterError, match=r"rows .* times as far apart.*more rows"):
        FilmMarch(long, 1e-7, settings=elements)


@pytest.mark.slow
def test_march_between_cyclic_sides_resumes_bit_for_bit(tmp_path):
    part = section((65, 16))
    k = 2.0 * np.pi / L

    def heights(x, y, t):
        return 0.05e-6 * np.cos(k * (x[:, None] - SLOW * t)) * np.cos(k * y)

    film, dt = moving_section(part, heights), part.spacing[0] / FAST
    march = FilmMarch(film, dt)
    march.step()
    march.save(tmp_path / "march.npz")
    ahead = [march.step() for _ in range(2)][-1]
    again = FilmMarch(film, dt, record=MarchRecord.read(tmp_path / "march.npz"))
    behind = [again.step() for _ in range(2)][-1]
    assert np.array_equal(ahead.pressure, behind.pressure)
    assert np.array_equal(ahead.film, behind.film)


def test_deflection_of_single_precision_is_that_of_double():
    modes = periodic_modes(1e-6, 2e-6, 30, 16, MODULUS, 1e-3)
    pressure = np.random.default_rng(2).random((16, 30)) * 1e9
    exact = np.array(PeriodicDeflection(modes, 16, "first")(pressure))
    rough = PeriodicDeflection(modes, 16, "first", single=True)(pressure)
    # 24 bits, a few hundred additions
    assert rough == pytest.approx(exact, abs=1e-5 * np.ptp(exact))


@each(
    ("change", "words"),
    [
        ({"nodes": (129, 17)}, "nodes along y must be even, within 16 to 2048"),
        ({"nodes": (129, 14)}, "got 14. Take 16"),
        ({"entrainment": (6.71, 1.0)}, "entrainment along y must be 0 m/s"),
        ({"inlet_layer": 1e-6}, "oil_beyond and inlet_layer cannot be combined with sides cyclic"),
        ({"sides": "round"}, "sides must be one of"),
        ({"sides": "no_flow", "sliding": (1.0, 1.0)}, "drives oil through them"),
    ],
)
def test_what_does_not_go_with_closed_sides_is_refused(change, words):
    with pytest.raises(ParameterError, match=words):
        replace(section(), **change)


def test_closed_sides_want_reynolds_cavitation_and_no_heat():
    with pytest.raises(ParameterError, match="needs sides ambient, got cyclic"):
        solve_point_contact(section(), replace(QUICK, cavitation="mass_conserving"))


def test_films_in_time_refuse_entrainment_towards_a_closed_side():
    film = moving_section(section(), lambda x, y, t: np.zeros((x.size, y.size)))

    def oblique(x, y, t):
        return replace(film.conditions(x, y, t), slope=0.1)

    with pytest.raises(ParameterError, match="entrainment along y must be 0"):
        FilmMarch(replace(film, conditions=oblique), 1e-7)


def test_point_contacts_keep_their_ambient_sides():
    ball = elliptical_contact(
        R_x=R, R_y=R, entrainment=(6.71, 0.0), load=20.0, contact_modulus=MODULUS, lubricant=EYRING
    )
    assert ball.sides == "ambient"
    assert ball.y[[0, -1]] == pytest.approx(ball.y_limits)
    assert ball.spacing[1] == pytest.approx(ball.y[1] - ball.y[0])
    assert isinstance(ball.hertz, EllipticParaboloid)
