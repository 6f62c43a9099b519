"""Rupture of the film of a point contact: kernels and limits."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.galerkin import sparse_operator
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.point.solver import check_cavitation, refuse_rupture, solve_point_contact
from gearlube_core.ehl.point.terms.cavitation import fill_ruptured_nodes
from gearlube_core.ehl.point.terms.linearisation import (
    RupturedTransport,
    carried_entries,
    carry_downstream,
)
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import moes_contact, sliding_along

CONSERVING = PointSolverSettings(cavitation="mass_conserving")
SHAPE = (17, 19)


def _patchy(angle: float, layer: float | None = None) -> tuple[PointLevel, FilmState]:
    """Return a grid and a state with full and ruptured patches next to each other."""
    problem = moes_contact(20.0, 5.0, nodes=SHAPE[::-1], angle=angle, oil_beyond=False)
    scales = PointScales.of(problem)
    if layer is not None:
        problem = replace(problem, inlet_layer=layer * scales.film)
    level = PointLevel(problem, scales, SHAPE, "upwind-2", cavitation="mass_conserving")
    level.set_continuation(3e-7, 1.0)  # pressure moves about as much oil as the surfaces
    rng = np.random.default_rng(3)
    pressure = rng.uniform(0.0, 0.4, SHAPE)
    pressure[rng.uniform(size=SHAPE) < 0.5] = 0.0
    pressure[[0, -1]] = pressure[:, [0, -1]] = 0.0
    return level, level.state(pressure, 0.3)


@pytest.mark.parametrize(("angle", "layer"), [(0.0, None), (0.5, None), (0.5, 1.0)])
def test_derivatives_with_carried_oil_are_those_of_differences(
    angle: float, layer: float | None
) -> None:
    level, state = _patchy(angle, layer)
    assert 10 < state.ruptured[1:-1, 1:-1].sum() < 200
    linear = level.linearise(state)
    rng = np.random.default_rng(4)
    pressed = state.pressure > 0.0
    step = np.where(pressed, rng.normal(size=SHAPE) * state.pressure, 0.0)
    for approach in (0.0, 1.0):
        ahead, back = (
            level.state(state.pressure + e * step, 0.3 + e * approach) for e in (1e-6, -1e-6)
        )
        assert (ahead.ruptured == back.ruptured).all()
        expected = (ahead.residual - back.residual) / 2e-6
        change = level.apply(linear, step, approach)
        # rounding of differences over 2e-6
        assert np.abs(change - expected)[pressed].max() < 1e-7 * np.abs(expected).max()
        assert (change[state.ruptured] == 0.0).all()


@pytest.mark.parametrize("angle", [0.0, 0.5])
def test_the_preconditioner_knows_the_way_of_the_oil(angle: float) -> None:
    level, state = _patchy(angle)
    linear = level.linearise(state)
    step = np.where(linear.free, np.random.default_rng(5).normal(size=SHAPE), 0.0)
    exact = level.apply(linear, step, 0.0).copy()
    known = sparse_operator(linear).apply(step, level.grid.deflection(step), 0.0)
    # oil is followed down to a thousandth of what a node passes on
    assert np.abs(known - exact).max() < 5e-3 * np.abs(exact).max()


def test_compiled_kernels_are_those_of_python() -> None:
    level, state = _patchy(0.5)
    full = state.density * state.film
    results = []
    for kernel in (fill_ruptured_nodes, fill_ruptured_nodes.py_func):
        mass, ruptured = full.copy(), np.zeros(SHAPE, dtype=np.bool_)
        residual = np.linspace(-1.0, 1.0, full.size).reshape(SHAPE)
        kernel(
            level.stencil, level.grid.metric, state.pressure, 0.01, np.ones(SHAPE[0]),
            np.zeros(SHAPE), full, mass, ruptured, residual,
        )  # fmt: skip
        results.append((mass, ruptured, residual))
    for one, other in zip(*results, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13, atol=1e-13)
    linear = level.linearise(state)
    transport = linear.transport
    assert isinstance(transport, RupturedTransport)
    way = transport.to_x, transport.to_y, transport.ruptured
    changes = []
    for kernel in (carry_downstream, carry_downstream.py_func):
        change = np.linspace(-1.0, 1.0, full.size).reshape(SHAPE)
        kernel(*way, change)
        changes.append(change)
    np.testing.assert_allclose(*changes, rtol=1e-13, atol=1e-13)
    entries = []
    for kernel in (carried_entries, carried_entries.py_func):
        row, column = np.zeros((2, 20000), dtype=np.int32)
        entry = np.zeros(20000, dtype=np.complex128)
        arguments = linear.offsets, linear.by_pressure, linear.by_film, row, column, entry
        entries.append((kernel(*way, linear.free, *arguments), row, column, entry))
    assert entries[0][0] == entries[1][0] > 100
    for one, other in zip(entries[0][1:], entries[1][1:], strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13)


def test_what_mass_conserving_cavitation_does_not_go_with_is_refused() -> None:
    problem = moes_contact(20.0, 5.0, nodes=(33, 33), oil_beyond=False)
    oblique = replace(sliding_along(problem, 1.0), sliding=(0.1, 0.2))
    refused: tuple[tuple[PointContactProblem, PointSolverSettings, str], ...] = (
        (replace(problem, inlet_layer=1e-7), PointSolverSettings(), "inlet_layer is 1e-07 m"),
        (replace(problem, solids=SolidContact()), CONSERVING, "solids"),
        (oblique, CONSERVING, "sliding along x or y"),
    )
    for wrong, settings, words in refused:
        with pytest.raises(ParameterError, match=words):
            solve_point_contact(wrong, settings)
    with pytest.raises(ParameterError, match="elements cannot be combined"):
        PointSolverSettings(discretisation="elements", cavitation="mass_conserving")
    with pytest.raises(ParameterError, match="inlet_layer must be"):
        replace(problem, inlet_layer=0.0)
    with pytest.raises(ParameterError, match="oil_beyond floods"):
        replace(problem, inlet_layer=1e-7, oil_beyond=True)
    with pytest.raises(ParameterError, match="point contacts, got a film with heat"):
        refuse_rupture(CONSERVING, "with heat")


EYRING = film_oil(eta0=0.04, alpha=2e-8, eyring_stress=5e6)
NEWTONIAN = film_oil(eta0=0.04, alpha=2e-8)
CONTACT = moes_contact(50.0, 10.0, nodes=(33, 33), lubricant=EYRING, oil_beyond=False)
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
