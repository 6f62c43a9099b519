"""Starting film of a rough time step, and peaks that a Newton step leaves without film."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

import gearlube_core.ehl.transient.newton as transient_newton
from gearlube.studies.films.rough.run import run_rough
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.ehl.transient.history import FilmHistory, MarchRecord
from gearlube_core.ehl.transient.level import lifted, lifted_off_solids
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.solution import FilmSolution

# ridges that cross and touch, on a grid that takes seconds
TOUCHING = {
    "name": "touching ridges",
    "source": "made up",
    "radius_mm": 14.0,
    "load_n_per_mm": 360.0,
    "length_mm": 0.25,
    "speed_1_m_s": 7.93,
    "speed_2_m_s": 5.49,
    "reduced_modulus_gpa": 227.5,
    "oil": {
        "viscosity_pa_s": 0.00625,
        "pressure_viscosity_per_gpa": 13.3,
        "eyring_stress_mpa": 10.0,
    },
    "surface_1": {"amplitude_um": 0.4, "period_um": 150.0, "turns": 1},
    "surface_2": {"amplitude_um": 0.4, "period_um": 100.0, "turns": -1},
    "times": {"steps_per_half_width": 24, "until_rough": 0.3, "rough": 0.1, "feed": "in_place"},
    "solver": {"nodes_x": 97, "rows": 16},
}


@cache
def small_march() -> FilmMarch:
    return march_of(RoughCase.from_data(TOUCHING, "touching"))


def march_of(case: RoughCase, record: MarchRecord | None = None) -> FilmMarch:
    step = case.schedule().time_step
    return FilmMarch(case.film(), step, settings=case.settings(), record=record)


def history(pressure: np.ndarray) -> FilmHistory:
    nothing = np.zeros_like(pressure)
    return FilmHistory(SimpleNamespace(pressure=pressure), nothing, nothing, nothing, None)


def test_what_differs_from_the_smooth_pressure_moves_with_the_oil():
    x = np.arange(200.0)
    smooth = np.sqrt(np.maximum(1.0 - ((x - 100.0) / 60.0) ** 2, 0.0))

    def rough(shift):
        return smooth + 0.05 * np.sin(2.0 * np.pi * (x - shift) / 16.0) * (smooth > 0.0)

    before = np.tile(np.maximum(rough(0.0), 0.0), (5, 1))
    moved = history(before).carried(np.tile(smooth, (5, 1)), 0.7)
    inside = slice(50, 150)
    # cubic splines miss a wave of 16 nodes by (2 pi/16)^4/384 of its height, 6e-5
    assert moved[2, inside] == pytest.approx(rough(0.7)[inside], abs=1e-4 * 0.05)
    assert moved[2, inside] != pytest.approx(rough(0.0)[inside], abs=1e-2 * 0.05)


def test_carried_pressure_keeps_its_front():
    smooth, pressure = np.zeros((2, 5, 40))
    smooth[1:-1, 5:35] = 1.0
    pressure[1:-1, 8:30] = 1.0
    moved = history(pressure).carried(smooth, 1.0)
    np.testing.assert_array_equal(moved > 0.0, pressure > 0.0)
    assert moved[pressure > 0.0].min() >= 0.5


def test_few_thin_nodes_are_lifted_by_pressure_of_their_own():
    march = small_march()
    level, start = march._level, march._past.state
    few = np.zeros(level.shape, dtype=bool)
    few[8, 46], few[8, 47], few[13, 52] = True, True, True
    thin = level.state(np.where(few, 0.9 * start.pressure, start.pressure), start.approach)
    least = np.where(few, 1.001 * start.film, 0.5 * start.film)
    assert (thin.film < least).sum() == 3
    found = lifted(level, thin, least)
    assert found is not None
    assert (found.film >= least).all()
    np.testing.assert_array_equal(found.pressure[~few], thin.pressure[~few])
    assert (found.pressure[few] > thin.pressure[few]).all()
    assert found.approach == thin.approach


def test_a_film_that_is_too_thin_everywhere_is_not_lifted():
    march = small_march()
    start = march._past.state
    assert lifted(march._level, start, 1.01 * start.film) is None


@cache
def touching_march() -> FilmMarch:
    """Return the march one step before its end."""
    case = RoughCase.from_data(TOUCHING, "touching")
    march = march_of(case)
    for _ in range(case.schedule().steps - 1):
        march.step()
    return march


@pytest.mark.slow
def test_solids_that_are_pressed_too_far_are_lifted_to_what_the_pressure_holds():
    march = touching_march()
    level, found = march._level, march._past.state
    nanometre = 1e-9 / level.scales.film
    near = level.state(found.pressure, found.approach - 4.0 * nanometre)
    layer = march.film.solids
    pressed = level.scales.pressure * near.pressure
    # the layer's law solved for the film: p = p_half (t/h - 1)^2
    holds = layer.thickness / (1.0 + np.sqrt(pressed / layer.pressure)) / level.scales.film
    thin = (near.film < holds / 1.5) & (near.film * level.scales.film < layer.thickness)
    assert 0 < thin.sum() < 30
    lifted_film = lifted_off_solids(level, near)
    assert (lifted_film.film[thin] >= holds[thin] / 1.5).all()
    # aimed at the film that holds the pressure; neighbours lift each other by some more
    assert lifted_film.film[thin] == pytest.approx(holds[thin], rel=0.5, abs=0.0)
    np.testing.assert_array_equal(lifted_film.pressure[~thin], near.pressure[~thin])
    # nothing is too far in a film that is found
    assert lifted_off_solids(level, found) is found


@pytest.mark.slow
def test_lifted_peaks_leave_the_answer_and_save_steps(monkeypatch, tmp_path):
    case = RoughCase.from_data(TOUCHING, "touching")
    march = touching_march()
    march.save(tmp_path / "march.npz")
    record = MarchRecord.read(tmp_path / "march.npz")

    def next_film() -> FilmSolution:
        return march_of(case, record).step()

    found = next_film()
    assert found.minimum_film < 10e-9  # solids touch
    monkeypatch.setattr(transient_newton, "lifted", lambda level, state, least: None)
    monkeypatch.setattr(transient_newton, "lifted_off_solids", lambda level, state: state)
    monkeypatch.setattr(FilmHistory, "carried", lambda self, smooth, nodes: self.predicted()[0])
    plain = next_film()
    assert found.newton_steps < 0.8 * plain.newton_steps
    # both stop at 1e-4 of unbalanced flow, which counts films of 5 nm least
    assert found.film == pytest.approx(plain.film, rel=1e-3, abs=0.0)


@pytest.mark.slow
def test_a_tenth_of_the_tolerance_changes_no_statistic_by_one_percent():
    # three times the default changes the load on solids of a step by 2 %
    case = RoughCase.from_data(TOUCHING, "touching")
    tolerance = case.solver.tolerance
    found, tight = (
        run_rough(case.varied({"solver.tolerance": share * tolerance})) for share in (1.0, 0.1)
    )
    assert tight["solid_share"].max() > 1e-3  # solids touch
    assert found["newton_steps"].sum() < tight["newton_steps"].sum()
    for name in (
        "pressure_max",
        "pressure_percentile_all",
        "film_min",
        "film_mean",
        "film_percentile_all",
        "contact_share",
        "solid_share",
        "friction_coefficient",
    ):
        wanted = tight[name].values
        # each step's number, to 1 % of the largest of the march: percentiles begin at zero
        largest = float(np.abs(wanted).max())
        np.testing.assert_allclose(found[name].values, wanted, rtol=0.0, atol=0.01 * largest)
