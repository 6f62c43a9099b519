"""Box of a deflection, slopes of the film's flow, error of time steps, factors at rest."""

from __future__ import annotations

from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest

from gearlube_core.ehl.point.equations import factor_fields
from gearlube_core.ehl.point.equations.factor_fields import ShearUnits
from gearlube_core.ehl.point.settings import AMBIENT
from gearlube_core.ehl.time_error import TimeError
from gearlube_core.ehl.transient import rows
from gearlube_core.ehl.transient.rows import WindowedDeflection
from gearlube_core.kernels.row_workers import ALONE
from gearlube_core.oil.eyring_1936 import Eyring
from tests.helpers.source_of import interpret

SHAPE = (60, 110)


@pytest.fixture
def window(monkeypatch):
    """Box whose deflection is one everywhere, so that the box can be seen."""
    made = []

    def convolution(coefficients, single):
        made.append(coefficients.shape)
        return np.ones_like

    monkeypatch.setattr(rows, "HalfSpaceConvolution", convolution)
    grid = SimpleNamespace(
        shape=SHAPE,
        graded=False,
        coefficients=np.zeros(SHAPE),
        modes=None,
        sides=AMBIENT,
        workers=ALONE,
    )
    return WindowedDeflection(grid), made


def box_of(window: WindowedDeflection, rows: slice, columns: slice) -> tuple:
    free = np.zeros(SHAPE, dtype=bool)
    free[rows, columns] = True
    window.follow(free)
    found = np.argwhere(window(np.zeros(SHAPE)) > 0.0)
    return tuple(found.min(axis=0)), tuple(found.max(axis=0) + 1)


def test_box_spares_a_twenty_fifth_of_the_sides_and_is_cut_anew_when_it_is_left(window):
    box, made = window
    # 3 nodes, and 4 % of 60 and of 110: 2 and 4
    assert box_of(box, slice(20, 30), slice(50, 70)) == ((15, 43), (35, 77))
    assert made == [(20, 34)]
    # pressure may come within two nodes of its border
    kept = (slice(17, 33), slice(45, 75)), (slice(17, 18), slice(45, 75))
    assert box_of(box, *kept[0]) == ((15, 43), (35, 77))
    assert len(made) == 1
    assert box_of(box, slice(16, 33), slice(45, 75)) == ((11, 38), (38, 82))
    assert len(made) == 2
    # the sides of the grid end it
    assert box_of(box, slice(2, 60), slice(0, 110)) == ((0, 0), (60, 110))


def test_box_is_cut_anew_when_it_is_larger_by_three_tenths(window):
    box, made = window
    assert box_of(box, slice(20, 40), slice(20, 80)) == ((15, 13), (45, 87))  # 30 by 74
    # 24 by 74 would do: 1.25 times; 22 by 74: 1.36 times
    assert box_of(box, slice(20, 34), slice(20, 80)) == ((15, 13), (45, 87))
    assert len(made) == 1
    assert box_of(box, slice(20, 32), slice(20, 80)) == ((15, 13), (37, 87))
    box.clear()
    assert box_of(box, slice(20, 32), slice(20, 80)) == ((15, 13), (37, 87))
    assert len(made) == 3


@pytest.mark.parametrize("way", [0.4, -0.4])
def test_error_of_a_step_is_carried_where_the_oil_is_pressed_or_has_left_the_contact(way: float):
    x = np.linspace(0.0, 10.0, 11)
    pressure = np.array([0.0, 0.01, 0.05, 0.5, 0.8, 1.0, 0.6, 0.2, 0.06, 0.02, 0.0])
    before = np.full((1, 11), 2.0)
    steps = TimeError("crank_nicolson", x, before[None], error=np.full((1, 11), 0.7))
    steps.step(before + 0.12, pressure[None], np.array([way]))
    # a first difference at the start; -1/12 of it
    kept = 0.7 - 0.12 / 12.0
    stiff = pressure > 0.1
    behind = (x > 5.0) if way > 0.0 else (x < 5.0)
    expected = np.where(stiff | (behind & (pressure > 0.0)), kept, 0.0)
    assert steps.error[0] == pytest.approx(expected)


def test_film_without_slopes_and_sliding_flows_as_a_newtonian(monkeypatch):
    interpret(monkeypatch, factor_fields)
    along, across = np.full((2, 5, 6), np.nan)
    stress, all_rows = np.full((2, 5, 6), np.nan), ((0, 5), factor_fields.FactorWork.empty(6))
    units = ShearUnits(np.zeros(5), np.full(6, 0.3), 0.2, 0.8, 0.6, 0.0, 0.0)
    flat, thick = np.full((5, 6), 0.4), np.ones((5, 6))
    arguments = Eyring(5e6), flat, thick, thick
    factor_fields.fill_shear_factors(*arguments, units, *all_rows, along, across, stress)
    for one in (along, across):
        assert one == pytest.approx(np.ones((5, 6)), abs=1e-12)
    slopes = np.full((2, 4, 5, 6), np.nan)
    wanted = np.ones((5, 6), dtype=bool)
    rest = units, stress, wanted, *all_rows
    factor_fields.fill_factor_slopes(*arguments, thick, *rest, *slopes)
    assert (slopes == 0.0).all()
    # beside the border a film without height keeps its factors too
    arguments = Eyring(5e6), flat, 0.0 * thick, thick
    factor_fields.fill_shear_factors(*arguments, units, *all_rows, along, across, stress)
    assert (along == 1.0).all()
    factor_fields.fill_factor_slopes(*arguments, thick, *rest, *slopes)
    assert (slopes == 0.0).all()


def test_slopes_of_factors_at_small_stress_grow_with_the_curvature_of_the_law(monkeypatch):
    """Rate of shear 1 + c (tau/tau0)^2 over that of a Newtonian: all factors less 1 have c."""
    interpret(monkeypatch, factor_fields)
    rng = np.random.default_rng(2)
    pressure, film = 1e-3 * rng.random((5, 6)), 1.0 + rng.random((5, 6))
    units = ShearUnits(np.full(5, 2e-3), np.full(6, 0.3), 0.2, 0.8, 0.6, 0.0, 0.0)
    thick, rows = np.ones((5, 6)), ((0, 5), factor_fields.FactorWork.empty(6))

    class Law(NamedTuple):
        c: float

        def rate_ratio(self, q):
            return 1.0 + self.c * q, self.c

    def slopes(c):
        law = Law(c)
        along, across, found = np.empty((5, 6)), np.empty((5, 6)), np.full((2, 4, 5, 6), np.nan)
        stress = np.full((2, 5, 6), np.nan)
        given = law, pressure, film, thick
        factor_fields.fill_shear_factors(*given, units, *rows, along, across, stress)
        wanted = np.ones((5, 6), dtype=bool)
        factor_fields.fill_factor_slopes(*given, thick, units, stress, wanted, *rows, *found)
        return found

    eyring = slopes(1.0 / 6.0)
    assert (np.abs(eyring).max(axis=(2, 3)) > 0.0).all()
    np.testing.assert_allclose(slopes(1.0), 6.0 * eyring, rtol=1e-12)
