"""Errors of films that are estimated, and bookkeeping of films."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest

from gearlube.studies.films.commands.console import film_error_of
from gearlube_core.ehl.gears.helical_film import COLUMNS
from gearlube_core.ehl.grid_error import FilmError, FilmNumbers, doubled, estimated_error, halved
from gearlube_core.ehl.point.equations import factor_fields
from gearlube_core.ehl.point.equations.factor_fields import ShearUnits
from gearlube_core.ehl.point.settings import AMBIENT
from gearlube_core.ehl.time_error import SAFETY_IN_TIME, TimeError
from gearlube_core.ehl.transient import rows
from gearlube_core.ehl.transient.curves import FilmCurves, NumberedSteps, with_time_errors
from gearlube_core.ehl.transient.rows import WindowedDeflection
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.row_workers import ALONE
from gearlube_core.oil.eyring_1936 import Eyring
from tests.helpers.each import each
from tests.helpers.source_of import interpret


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_a_value_of_known_order_has_twice_its_true_error(order):
    finest, middle, coarse = (1.0 + 0.01 * spacing**order for spacing in (1.0, 2.0, 4.0))
    estimate = estimated_error([finest, middle, coarse])
    assert estimate * finest == pytest.approx(2.0 * 0.01, rel=1e-12)


def test_a_value_of_higher_order_is_not_trusted_beyond_second_order():
    values = [1.0 + 0.01 * spacing**4 for spacing in (1.0, 2.0, 4.0)]
    # d_2/4 stands for d_1, divided by 2^2 - 1 and doubled
    assert estimated_error(values) == pytest.approx(2.0 * (0.01 * 240.0 / 4.0) / 3.0 / values[0])


def test_two_values_that_agree_by_chance_are_not_believed():
    # the last difference is nothing, the one before it 4 %
    assert estimated_error([1.0, 1.0, 1.04]) == pytest.approx(2.0 * 0.01 / 3.0)


def test_values_that_turn_count_with_the_larger_safety():
    assert estimated_error([1.0, 1.01, 1.0]) == pytest.approx(3.0 * 0.01)


def test_a_grid_of_first_order_leaves_half_of_the_error_before():
    assert estimated_error([1.0, 1.001, 1.041], formal=1.0) == pytest.approx(2.0 * 0.02)
    assert estimated_error([1.0, 1.03], formal=1.0) == pytest.approx(3.0 * 0.03)


def test_two_grids_count_with_the_larger_safety():
    assert estimated_error([1.0, 1.03]) == pytest.approx(3.0 * 0.03 / 3.0)


def test_a_single_grid_or_an_unknown_value_gives_no_estimate():
    assert math.isnan(estimated_error([1.0]))
    assert math.isnan(estimated_error([1.0, math.nan, 1.0]))
    # no sliding, no friction, no error
    assert estimated_error([0.0, 0.0, 0.0]) == 0.0


def test_grids_are_halved_to_nodes_of_the_finer_and_not_below_17():
    assert halved((129, 65)) == (65, 33)
    assert doubled((65, 33)) == (129, 65)
    assert halved((65, 31)) is None


class _Flat:
    """A film whose pressure has a spike that the coarser grid does not show."""

    def __init__(self, nodes, spike, coarser=()):
        self.nodes, self.coarser, self.converged = (nodes,), coarser, True
        self.formal_order, self.wider = 2.0, None
        self.axes = (np.linspace(0.0, 1.0, nodes),)
        self.pressure = np.where(np.abs(self.axes[0] - 0.75) < 1e-9, spike, 0.5)
        self.pressure[nodes // 4] = 1.0
        self.numbers = FilmNumbers(1.0, 0.8, float(self.pressure.max()), 0.0)


def test_a_spike_that_grows_with_the_grid_makes_the_pressure_uncertain():
    film = _Flat(33, 0.9, (_Flat(17, 0.6),))
    # the largest pressure is 1.0 on both grids; the spike may come to 0.9 + 0.3
    assert film.numbers.maximum_pressure == film.coarser[0].numbers.maximum_pressure
    assert FilmError.of(film).maximum_pressure == pytest.approx(0.2)


def test_the_errors_are_told_and_large_ones_warn():
    error = FilmError(0.01, 0.06, 0.001, math.nan, ((65, 65), (33, 33)))
    assert error.film == error.largest == 0.06
    assert "smallest film 6 %" in error.sentence
    assert "33 x 33" in error.sentence
    assert "above 5 %: take more nodes" in error.sentence
    assert "friction" not in error.sentence
    small = FilmError(0.01, 0.04, 0.001, 0.0, ((65, 65), (33, 33)))
    assert "take more nodes" not in small.sentence
    assert "The error of the domain is not known." in small.sentence
    unknown = FilmError(*4 * [math.nan], ((33, 33),))
    assert "not known" in unknown.sentence


def test_the_error_of_the_domain_is_twice_what_twice_the_domain_changes():
    film = _Flat(33, 0.9, (_Flat(17, 0.9),))
    film.wider = _Flat(33, 0.9)
    film.wider.numbers = FilmNumbers(1.25, 0.8, math.nan, 0.0)
    error = FilmError.of(film)
    # 2 (1.25 - 1)/1.25, and a friction that is zero on both
    assert error.domain == pytest.approx((0.4, 0.0, math.nan, 0.0), nan_ok=True)
    assert error.largest_of_domain == pytest.approx(0.4)
    assert (
        "from one twice as wide: central film 40 %, smallest film 0 %, friction" in error.sentence
    )
    assert "take a wider domain" in error.sentence


def _advected(scheme, steps):
    """Largest estimated and true error of a wave that is carried over its length.

    Exact in space: m = 2 + exp(i k x) amplitude, dm/dt = -u dm/dx, of which the scheme multiplies
    the amplitude.
    """
    x = np.linspace(0.0, 1.0, 2001)
    k, dt = 2.0 * math.pi, 1.0 / steps
    rate = -1j * k * dt

    def mass(amplitude):
        return (2.0 + (np.exp(1j * k * x) * amplitude).real)[None]

    amplitudes = [1.0 + 0.0j]
    estimate = TimeError(scheme, x, mass(1.0)[None])
    largest = 0.0
    for n in range(1, steps + 1):
        if scheme == "crank_nicolson":
            new = amplitudes[-1] * (1.0 + 0.5 * rate) / (1.0 - 0.5 * rate)
        elif n == 1:
            new = np.exp(rate)  # the first step of backward Euler is not looked at
        else:
            new = (2.0 * amplitudes[-1] - 0.5 * amplitudes[-2]) / (1.5 - rate)
        amplitudes.append(new)
        estimate.step(mass(new), np.ones((1, x.size)), np.array([dt]))
        if n == 3:
            estimate.error[:] = 0.0  # what steps without a third difference have added
            begin = new
        if n > 3:
            exact = begin * np.exp(rate * (n - 3))
            largest = float(np.abs(mass(new) - mass(exact)).max())
    inside = slice(1200, None)  # oil that has come from inside the domain
    return float(np.abs(estimate.error[0, inside]).max()), largest


@pytest.mark.parametrize("scheme", ["bdf2", "crank_nicolson"])
def test_the_error_of_time_steps_follows_a_carried_wave(scheme):
    found, true = _advected(scheme, 100)
    # of third order in the step relative to it: 2 pi/100 and the three steps of its start
    assert found == pytest.approx(true, rel=0.1)
    finer, _ = _advected(scheme, 200)
    assert found / finer == pytest.approx(4.0, rel=0.1)


def test_the_smallest_film_takes_the_worst_error_of_thin_nodes():
    masses = np.array([[[1.0, 2.0, 1.05, 4.0]]])
    estimate = TimeError("bdf2", np.arange(4.0), masses, np.array([[0.01, 1.0, -0.021, 1.0]]))
    assert estimate.of_smallest_film(masses[0]) == pytest.approx(SAFETY_IN_TIME * 0.02)


def _curves(step, count, every):
    """Curves over `count` steps whose smallest film is off by 1 % a unit of `step`."""
    table = np.zeros((count, len(COLUMNS)))
    table[:, COLUMNS.index("minimum_film")] = 1.0 + 0.01 * step * (np.arange(count) * every > 0)
    table[:, COLUMNS.index("pressure_max")] = 2.0
    return FilmCurves(COLUMNS, table, {})


@pytest.mark.parametrize(("every", "count"), [(1, 5), (2, 3)])
def test_a_march_repeated_with_longer_steps_tells_their_error(every, count):
    curves = with_time_errors(_curves(1.0, 5, 1), _curves(2.0, count, every), every)
    found = curves["time_error"]
    assert found[0] == 0.0
    np.testing.assert_allclose(found[1:], 0.01 / 1.01, rtol=1e-12)
    np.testing.assert_array_equal(curves["time_error_pressure"], 0.0)


def test_longer_steps_are_every_step_or_every_other_one():
    odd = NumberedSteps(10, 15, 1.0, 0.1)
    assert odd.longer() == NumberedSteps(10, 12, 1.0, 0.2)
    even = NumberedSteps(10, 15, 1.0, 0.1, substeps=4)
    assert even.longer() == NumberedSteps(10, 15, 1.0, 0.1, substeps=2)


@pytest.mark.parametrize(("text", "share"), [("1%", 0.01), ("0.01", 0.01), (" 2.5 % ", 0.025)])
def test_a_film_error_is_a_share_or_per_cent(text, share):
    assert film_error_of(text) == pytest.approx(share)
    assert film_error_of(None) is None


@each("text", ["", "small", "nan%", "inf", "200%", "-1%", "0"])
def test_a_film_error_that_is_none_is_refused(text):
    with pytest.raises(ParameterError, match="--film-error"):
        film_error_of(text)


def _place(scheme, masses):
    """A march whose error is 1, 2, ... from left to right; its nodes are 1 apart."""
    rows, nodes = np.shape(masses[0])
    error = np.tile(np.arange(1.0, nodes + 1.0), (rows, 1))
    return TimeError(scheme, np.arange(float(nodes)), np.array(masses), error)


def test_oil_brings_its_error_along_and_forgets_it_where_the_film_follows_the_gap():
    nodes = 9
    masses = 3 * [np.ones((2, nodes))]
    estimate = _place("bdf2", masses)
    # the peak is at node 5 and above a tenth of it node 3 carries oil; then no pressure from 8 on
    row = np.array([0.0, 0.05, 0.09, 0.2, 0.7, 1.0, 0.08, 0.02, 0.0])
    # the second row goes the other way
    estimate.step(masses[0], np.array([row, row[::-1]]), np.array([0.5, -0.5]))
    expected = np.arange(1.0, nodes + 1.0) - 0.5
    expected[[0, 1, 2, 8]] = 0.0
    np.testing.assert_allclose(estimate.error[0], expected, atol=1e-13)
    expected = np.arange(1.0, nodes + 1.0) + 0.5
    expected[[0, 6, 7, 8]] = 0.0
    np.testing.assert_allclose(estimate.error[1], expected, atol=1e-13)


@pytest.mark.parametrize(
    ("scheme", "shares"),
    # of the first step's first difference, the second's second one, then third ones
    [("bdf2", (0.5, 1.0 / 3.0, 1.0 / 3.0)), ("crank_nicolson", (-1 / 12, -1 / 12, -1 / 12))],
)
def test_every_step_adds_a_share_of_the_last_difference_it_knows(scheme, shares):
    # m = t^3 at t = 0, 1, ...: first differences 1, 7, 19; second 6, 12; third 6
    masses = [np.full((1, 5), float(n) ** 3) for n in range(6)]
    estimate = TimeError(scheme, np.arange(5.0), masses[0][None])
    added = (1.0 * shares[0], 6.0 * shares[1], *(3 * [6.0 * shares[2]]))
    total = 0.0
    for n, one in enumerate(added, 1):
        estimate.step(masses[n], np.ones((1, 5)), np.zeros(1))
        total += one
        np.testing.assert_allclose(estimate.error, total, rtol=1e-13)
        np.testing.assert_array_equal(estimate.masses, masses[n::-1][:3])


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


CONSTANT = np.ones((5, 6)), np.zeros((5, 6))  # one Eyring stress at all nodes


def test_film_without_slopes_and_sliding_flows_as_a_newtonian(monkeypatch):
    interpret(monkeypatch, factor_fields)
    along, across = np.full((2, 5, 6), np.nan)
    stress, all_rows = np.full((2, 5, 6), np.nan), ((0, 5), factor_fields.FactorWork.empty(6))
    units = ShearUnits(np.zeros(5), np.full(6, 0.3), 0.2, 0.8, 0.6, 0.0, 0.0, *CONSTANT)
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
    units = ShearUnits(np.full(5, 2e-3), np.full(6, 0.3), 0.2, 0.8, 0.6, 0.0, 0.0, *CONSTANT)
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
