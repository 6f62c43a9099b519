"""Outputs of the contact lines against sums by hand over made-up points."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair.march import line_outputs
from gearlube_core.dynamics.helical_pair.march import line_outputs as module
from gearlube_core.dynamics.helical_pair.march.flanks import (
    FLANK_POINTS,
    LINES_MAX,
    POINTS_PER_LINE,
    FlankView,
)
from gearlube_core.dynamics.ranges import LEAST_FILM_RATIO
from gearlube_core.film.groups import line_groups
from gearlube_core.friction.flank_laws import FORMULA, SOLVED
from gearlube_core.oil.lubricant_state import LubricantState
from tests.helpers.source_of import interpret, source_of

OIL = LubricantState(0.03, 2.1e-8, 0.045, 3.5e-5, 4e6, 0.0, 0.07, 0.15, 350.0, 1.74e6, 2.1e-8)
HOT, SIGMA, MODULUS = 350.0, 4e-7, 1.15e11  # K, m, E* in Pa
LINES, FIRST, PHASE = 3, 5, 7.4  # line i has the place (7 - i) mod 3
RNG = np.random.default_rng(6)
# load [N/m], length [m], film [m], sliding, entrainment [m/s], rise [K], pressure [Pa], R [m]
LOW = np.array([1e4, 2e-3, 2e-7, -3.0, 4.0, 2.0, 4e8, 0.01])
POINTS = LOW * (1.0 + RNG.random((LINES, POINTS_PER_LINE, 8)))
POINTS[0, :2, 1] = 0.0  # no line before the pitch line: what stands there must not count
POINTS[0, :2, 0] = 1e6
POINTS[1, 2, 0] = 0.0  # apart, with a length
POINTS[2, :, 3] *= -1.0
MU_OF = 0.02 + 0.05 * RNG.random((LINES, POINTS_PER_LINE))
BOUNDS = RNG.random((LINES, POINTS_PER_LINE, 3))  # share outside, bounds of film and coefficient
MU = 5  # place of the coefficients
COEFFICIENTS = 0.02 + 0.05 * RNG.random(2 * FLANK_POINTS)


def written(monkeypatch, friction_form=1.0, points=POINTS, ratio_of=None, mu_at=MU, film=FORMULA):
    interpret(monkeypatch, module)
    s = np.concatenate([np.zeros(MU), COEFFICIENTS])

    def line_point(view, coast, line, place, pinion_speed, data, lubricant, p):
        assert (view.phase, pinion_speed, data, lubricant) == (PHASE, 120.0, "data", OIL)
        assert coast == (mu_at != MU)
        w, length, film, sliding, entrainment, rise, pressure, R = points[line, place]
        motion = SimpleNamespace(sliding=sliding, entrainment=entrainment, R=R)
        ratio = film / SIGMA if ratio_of is None else ratio_of
        state = SimpleNamespace(
            film_thickness=film, film_ratio=ratio, temperature_rise=rise, mean_pressure=pressure,
            friction_coefficient=MU_OF[line, place],
        )  # fmt: skip
        outside, of_film, of_friction = BOUNDS[line, place]
        return (
            w,
            length,
            motion,
            SimpleNamespace(
                state=state, outside=outside, film_bound=of_film, coefficient_bound=of_friction
            ),
        )

    monkeypatch.setattr(module, "line_point", line_point)
    p = SimpleNamespace(
        flanks=SimpleNamespace(lines=float(LINES)),
        solid=SimpleNamespace(contact_modulus=MODULUS),
        surface=SimpleNamespace(sigma=SIGMA),
        friction_form=friction_form,
        film=film,
    )
    size = len(module.LINE_OUTPUTS)
    end = FIRST + size + 1
    out = np.full(end + len(line_outputs.LINE_BOUNDS) + 1, -7.0)
    view = FlankView(0.0, 0.0, PHASE)
    given = view, mu_at != MU, s, mu_at, -120.0, HOT, "data", OIL, p
    found = source_of(module.write_lines)(*given, FIRST, end, out)
    assert np.all(out[:FIRST] == -7.0)
    assert out[end - 1] == out[-1] == -7.0
    if film == SOLVED:
        return out[end:-1].reshape(LINES_MAX, 2), found
    assert np.all(out[end:-1] == 0.0)
    return out[FIRST : end - 1].reshape(LINES_MAX, 8), found


@pytest.mark.parametrize("mu_at", [MU, MU + FLANK_POINTS])
@pytest.mark.parametrize("friction_form", [-1.0, 0.0, 1.0])
def test_outputs_of_every_line_are_means_over_its_load(monkeypatch, mu_at, friction_form):
    rows, _ = written(monkeypatch, friction_form, mu_at=mu_at)
    coefficients = COEFFICIENTS[mu_at - MU :].reshape(-1, POINTS_PER_LINE)
    for line, slot in ((0, 1), (1, 0), (2, 2)):
        w, length, film, sliding, _, rise, _, _ = POINTS[line].T
        part = w * length
        mean = [np.sum(part * q) / part.sum() for q in (film, coefficients[slot], abs(sliding))]
        hotter = np.sum(part * rise) / part.sum() if friction_form > 0.0 else 0.0
        thin = film[part > 0.0].min()
        expected = [part.sum(), length.sum(), thin, mean[0], thin / SIGMA, *mean[1:], HOT + hotter]
        np.testing.assert_allclose(rows[slot], expected, rtol=1e-13)
    # a line that is not there
    np.testing.assert_array_equal(rows[LINES:], [[0.0] * 7 + [HOT]] * (LINES_MAX - LINES))


def test_bounds_are_means_over_load_and_friction_and_loss(monkeypatch):
    rows, found = written(monkeypatch, film=SOLVED)
    load = POINTS[..., 0] * POINTS[..., 1]
    load[POINTS[..., 1] == 0.0] = 0.0
    force = MU_OF * load
    outside, of_film, of_friction = np.moveaxis(BOUNDS, -1, 0)
    for line, slot in ((0, 1), (1, 0), (2, 2)):
        film = np.sum(of_film[line] * load[line]) / load[line].sum()
        friction = np.sum(of_friction[line] * load[line]) / force[line].sum()
        np.testing.assert_allclose(rows[slot], [film, friction], rtol=1e-13)
    assert np.all(rows[LINES:] == 0.0)
    assert found.outside == pytest.approx(np.sum(outside * load) / load.sum(), rel=1e-13)
    speed = abs(POINTS[..., 3])
    wanted = np.sum(of_friction * load * speed) / np.sum(force * speed)
    assert found.loss_bound == pytest.approx(wanted, rel=1e-13)


def test_order_of_the_outputs():
    names = module.LINE_OUTPUTS
    assert names[:3] == ("line[1].load", "line[1].length", "line[1].film_thickness_min")
    assert names[-1] == f"line[{LINES_MAX}].temperature"
    assert len(set(names)) == 8 * LINES_MAX
    order = module.LINE_QUANTITIES
    assert order.index("film_ratio") == module.FILM_RATIO == 4
    assert order.index("sliding_speed") == module.SLIDING_SPEED == 6


@pytest.mark.parametrize("friction_form", [-1.0, 0.0, 1.0])
def test_ranges_are_those_of_the_point_with_most_load_per_length(monkeypatch, friction_form):
    _, found = written(monkeypatch, friction_form)
    counts = (POINTS[..., 0] > 0.0) & (POINTS[..., 1] > 0.0)
    most = np.argmax(np.where(counts, POINTS[..., 0], 0.0))
    w, _, film, _, entrainment, rise, pressure, R = POINTS.reshape(-1, 8)[most]
    groups = line_groups(
        viscosity=OIL.eta0, pressure_viscosity=OIL.alpha, entrainment_speed=entrainment,
        line_load=w, radius=R, reduced_modulus=2.0 * MODULUS,
    )  # fmt: skip
    assert found.film_load == pytest.approx(groups.M, rel=1e-12)
    assert found.film_material == pytest.approx(groups.L, rel=1e-12)
    with_film = friction_form > 0.0
    # alpha p + ln 2 K eta0/(beta (tau0 h)^2)
    traction = 2.1e-8 * pressure + math.log(2.0 * 0.15 * 0.03 / (0.045 * (4e6 * film) ** 2))
    assert found.traction == pytest.approx(with_film * traction, rel=1e-12)
    assert found.temperature == pytest.approx(HOT + with_film * rise, rel=1e-14)
    assert found.pressure == pytest.approx(4.0 / math.pi * pressure, rel=1e-14)  # of Hertz' line
    assert found.thinnest_film == POINTS[..., 2][counts].min()


def test_film_formulas_are_out_of_use_where_roughness_carries(monkeypatch):
    found = written(monkeypatch, ratio_of=0.9 * LEAST_FILM_RATIO)[1]
    assert (found.film_load, found.film_material, found.traction) == (0.0, 0.0, 0.0)
    assert found.pressure > 0.0


def test_entrainment_counts_without_its_sign_and_load_however_small(monkeypatch):
    points = POINTS.copy()
    points[..., 4] *= -1.0
    assert written(monkeypatch, points=points)[1] == written(monkeypatch)[1]
    points = POINTS.copy()
    points[..., 0] *= 1e-6  # below 1 N/m
    points[..., 1] *= 1e-3
    rows, found = written(monkeypatch, points=points)
    plain, _ = written(monkeypatch)
    np.testing.assert_allclose(rows[:LINES, 0], 1e-9 * plain[:LINES, 0], rtol=1e-13)
    np.testing.assert_allclose(rows[:LINES, 2:], plain[:LINES, 2:], rtol=1e-13)
    assert found.film_load > 0.0


def test_flank_without_load_has_no_films(monkeypatch):
    points = POINTS.copy()
    points[..., 0] = 0.0
    rows, found = written(monkeypatch, points=points)
    assert tuple(found) == (0.0,) * 8
    lengths = [points[line, :, 1].sum() for line in (1, 0, 2)]
    np.testing.assert_allclose(rows[:LINES, 1], lengths, rtol=1e-14)
    assert np.all(rows[:, [0, 2, 3, 4, 5, 6]] == 0.0)
    assert np.all(rows[:, 7] == HOT)
