"""Line contact of rough bodies in time: every step solved, load carried, contact reported."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.ehl.line.problem import LineSettings
from gearlube_core.ehl.line.rows import fill_rows, local_rows
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.system import LineState, LineSystem
from gearlube_core.ehl.line.transient import LineHistory, LineMarch
from tests.helpers.ehl_line_cases import thesis_line

LENGTH = 2e-3  # of the profiles, which repeat [m]


def rough_profile(average: float, shortest: float, seed: int):
    """Return a periodic profile z(x) [m] of given mean amplitude [m] and shortest wave [m]."""
    rng = np.random.default_rng(seed)
    k = 2.0 * np.pi * np.arange(1, int(LENGTH / shortest)) / LENGTH
    size = rng.normal(size=k.size) * (1.0 + (k * 8.0 * shortest / (2.0 * np.pi)) ** 2) ** -0.75
    phase = rng.uniform(0.0, 2.0 * np.pi, k.size)

    def raw(x):
        return np.cos(np.multiply.outer(x, k) + phase) @ size

    scale = average / np.abs(raw(np.linspace(0.0, LENGTH, 2000))).mean()
    return lambda x: scale * raw(x)


def march_rough(average: float, steps: int, settings: LineSettings):
    contact = thesis_line(domain=(-0.7e-3, 0.38e-3))
    smooth = solve_line(contact, settings)
    dx = smooth.x[1] - smooth.x[0]
    above, below = (rough_profile(average, 10.0 * dx, seed) for seed in (1, 2))
    growth = 2.0 * contact.half_width / contact.speed_1

    def gap(x, t):
        profile = below(x - contact.speed_1 * t) + above(x - contact.speed_2 * t)
        return x * x / (2.0 * contact.radius) + min(1.0, t / growth) * profile

    march = LineMarch(smooth, LineHistory(gap=gap), dx / (2.0 * contact.speed_1))
    return [march.step(throw=False) for _ in range(steps)]


@pytest.mark.slow
def test_rough_film_that_stays_whole_is_solved_in_every_step():
    # 0.1 um a surface under a film of 0.24 um
    films = march_rough(0.1e-6, 250, LineSettings(nodes=251))
    assert all(film.converged for film in films)
    assert not any(film.contact.any() for film in films)
    for film in films[::25]:
        assert film.mass_flow.size == film.x.size - 1
        assert film.film.min() > 0.0
        assert film.pressure.min() >= 0.0
        carried = film.pressure.sum() * (film.x[1] - film.x[0])
        assert carried == pytest.approx(360e3, rel=1e-8)
    # roughness raises the pressure above the smooth 0.96 GPa
    assert max(film.maximum_pressure for film in films) > 1.2e9


@pytest.mark.slow
def test_rough_bodies_that_touch_carry_the_load_and_say_where():
    films = march_rough(0.5e-6, 200, LineSettings(nodes=251))
    assert all(film.converged for film in films)
    touching = [film for film in films if film.contact.any()]
    assert touching
    for film in touching:
        assert film.film[film.contact] == pytest.approx(1e-9, rel=1e-3)
        assert film.film.min() > 0.99e-9
        assert np.all(film.pressure[film.contact] > 0.0)
        assert film.pressure.sum() * (film.x[1] - film.x[0]) == pytest.approx(360e3, rel=1e-8)
        assert "touch" in film.outcome
        # the oil alone would need more inflow there: held films make oil, they never take it
        assert film.contact_flow >= 0.0


@pytest.mark.parametrize("stencil", ["central", "upwind-1", "upwind-2", "galerkin"])
def test_compiled_balance_equals_its_python(stencil):
    contact = thesis_line()
    system = LineSystem(contact, 33, stencil, stencil != "galerkin")
    rng = np.random.default_rng(5)
    state = LineState(rng.uniform(0.0, 0.6, 33), np.zeros(33), 2.0)
    system.coefficients = replace_storage(system.coefficients)
    system.evaluate(state)
    rows = local_rows(33)
    arguments = (system.cooling, system.dilation, system.source, system.coefficients, system.oil)
    fill_rows.py_func(state.P, system.H, state.void, *arguments, rows)
    for compiled, interpreted in zip(system.rows, rows, strict=True):
        # order of additions
        assert compiled == pytest.approx(interpreted, rel=1e-11, abs=1e-12)


def replace_storage(coefficients):
    return coefficients._replace(storage=2.0, weight=0.5)


@pytest.mark.slow
def test_contact_can_be_forbidden():
    films = march_rough(0.5e-6, 200, LineSettings(nodes=251, contact_film=0.0))
    assert not any(film.contact.any() for film in films)
    # what then fails is said, not hidden
    failed = [film for film in films if not film.converged]
    assert failed
    assert all("Not converged" in film.outcome for film in failed)
