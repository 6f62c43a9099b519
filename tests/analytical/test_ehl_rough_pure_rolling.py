"""Two rough surfaces of one speed with an Eyring oil: the limit of small sliding."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from gearlube.studies.films.rough.files import new_statistics
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import moving_section
from gearlube_core.ehl.transient.solution import FilmSolution

U = 6.71  # m/s
CASE = {
    "name": "rolling waves",
    "source": "made up",
    "radius_mm": 14.0,
    "load_n_per_mm": 200.0,
    "length_mm": 1.0,
    "speed_1_m_s": U,
    "speed_2_m_s": U,
    "reduced_modulus_gpa": 227.5,
    "oil": {
        "viscosity_pa_s": 0.00625,
        "pressure_viscosity_per_gpa": 13.3,
        # low, so that sliding thins the oil of the inlet as well
        "eyring_stress_mpa": 1.0,
    },
    "surface_1": {"amplitude_um": 0.05, "period_um": 260.0, "turns": 1},
    "surface_2": {"amplitude_um": 0.05, "period_um": 200.0, "turns": -1},
    "times": {"steps_per_half_width": 20, "until_rough": 0.2, "rough": 0.16, "feed": "in_place"},
    "solver": {"nodes_x": 81, "rows": 16, "tolerance": 1e-9, "load_tolerance": 1e-9},
}


@cache
def marched(ratio: float) -> FilmSolution:
    """Return the last film of surfaces that slide by a ratio of U past heights that roll at U."""
    rolling = RoughCase.from_data(CASE, "rolling")
    slid = rolling.varied(
        {"speed_1_m_s": U * (1.0 - 0.5 * ratio), "speed_2_m_s": U * (1.0 + 0.5 * ratio)}
    )
    film = moving_section(slid.section(), rolling.roughness())
    schedule = rolling.schedule()
    march = FilmMarch(film, schedule.time_step, settings=rolling.settings())
    for _ in range(schedule.steps):
        found = march.step()
    return found


@pytest.mark.slow
def test_the_film_in_pure_rolling_is_the_limit_of_small_sliding():
    for name in ("film", "pressure"):
        rolling, *slid = (getattr(marched(ratio), name) for ratio in (0.0, 5e-4, 1e-3))
        small, double = (np.abs(one - rolling).max() for one in slid)
        # shear thinning is even in the sliding speed: four times as much at twice the speed, less
        # the fourth order, whose share is the square of the Couette stress over 1 MPa, 0.05
        assert double / small == pytest.approx(4.0, rel=0.05), name
        assert small < 1e-4 * rolling.max()


@pytest.mark.slow
def test_either_surface_may_be_the_faster_one():
    # the mean speed and the magnitude of sliding are the same: rounding alone differs
    one, other = marched(5e-4), marched(-5e-4)
    assert other.film == pytest.approx(one.film, rel=1e-9, abs=0.0)


@pytest.mark.parametrize(("ratio", "coefficient"), [(0.0, 0.0), (1e-3, 0.1)])
def test_solids_that_roll_upon_each_other_without_sliding_make_no_friction(ratio, coefficient):
    case = RoughCase.from_data(CASE, "rolling").varied({"speed_2_m_s": U * (1.0 + ratio)})
    statistics = new_statistics(case, smooth=False)
    shape = statistics.zone.inside.shape
    statistics.add(0.0, np.full(shape, 5e-9), np.full(shape, 2e9))
    found = statistics.dataset().isel(time=0)
    on_solids = float(found.solid_share * found.film_load)
    assert on_solids > 0.0
    assert float(found.solid_friction) == pytest.approx(coefficient * on_solids)
    if ratio == 0.0:
        # nothing drives the oil at mid-film
        assert float(found.friction_coefficient) == 0.0
