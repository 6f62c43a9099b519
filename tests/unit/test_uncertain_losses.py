"""Uncertain data of an axle's losses, and what a map says where an error bar does not hold."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from gearlube.report.churning import churning_regime
from gearlube.report.films import covered_alone, covered_share, points_beyond, solved_films
from gearlube.report.parts import WARNING
from gearlube.studies.drive_cycle import report as drive_cycle
from gearlube.studies.drive_cycle import spread as cycle_spread
from gearlube.studies.loss_map import findings as loss_map
from gearlube.studies.loss_map import sampling
from gearlube.studies.loss_map.run import run_loss_map
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube.studies.runup import findings as runup
from gearlube.studies.sweep import findings as sweep
from gearlube.studies.sweep.datasets import GRID, with_churning_regime
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.uncertain import by_one_film, changed_axle

AXLE = mohammadpour_2015_axle()


def test_preload_is_uncertain_and_ribs_are_where_their_law_counts_them():
    def known(law, **options):
        axle = replace(AXLE, bearing_torque_loss=law)
        return {one.name: one for one in LossMapSettings(axle=axle, **options).uncertain}

    assert "rib_friction" not in known("palmgren")
    assert "preload" not in known("palmgren", calibrated_bearings=True)
    ribbed = known("zhou_hoeprich_1991")
    for name, field, ratio in (
        ("preload", "preload", 2.0),
        ("rib_friction", "rib_boundary_friction", 1.4),
        ("rib_roughness", "rib_roughness", 2.0),
    ):
        # two standard deviations are the factor
        changed = changed_axle(ribbed[name], AXLE, 2.0, np.ones(len(LOSS_SOURCES)))
        for old, new in zip(AXLE.bearings, changed.bearings, strict=True):
            assert getattr(new, field) / getattr(old, field) == pytest.approx(ratio)


def test_the_causes_of_a_cycle_s_spread_are_those_that_made_it():
    rng = np.random.default_rng(3)
    drawn = rng.standard_normal((60, 3))
    inputs = tuple(SimpleNamespace(words=name) for name in ("seals", "drag", "oil"))
    lost = 300.0 * np.exp(drawn @ np.array([0.1, -0.3, 0.0]))
    (first, by), (second, less), (third, none) = cycle_spread._causes(inputs, drawn, lost)
    assert (first, second, third) == ("drag", "seals", "oil")
    # two standard deviations
    assert (by, less) == pytest.approx((math.exp(0.6) - 1.0, math.exp(0.2) - 1.0), rel=1e-9)
    assert none == pytest.approx(0.0, abs=1e-9)
    assert cycle_spread._causes(inputs, drawn[:8], lost[:8]) == ()


def test_both_ends_of_a_datum_are_by_one_film():
    """Solved 100 W, formulas 300 W, and alpha 10 % of it: the ratio is never one of the models."""
    solved = replace(AXLE, film="solved")
    ends = [replace(solved, oil=replace(AXLE.oil, alpha=by * AXLE.oil.alpha)) for by in (1.1, 0.9)]

    def losses(axle):
        own = axle.oil.alpha / AXLE.oil.alpha * np.ones((2, 3))
        if axle.film == "formula":
            return 300.0 * own, np.zeros(2)
        return 100.0 * own, np.array([0.0, 0.2 if axle.oil.alpha > AXLE.oil.alpha else 0.04])

    upper, lower = by_one_film(ends, losses)
    assert upper[:, 0] == pytest.approx([110.0, 330.0])
    assert lower[:, 0] == pytest.approx([90.0, 270.0])


def test_the_bar_of_a_point_that_the_film_model_does_not_cover_is_that_of_the_formulas(monkeypatch):
    """Solved films at the first point; the second is half covered, and not at all by the draw."""
    own = replace(AXLE, film="solved")
    drawn = replace(own, roughness_rms=1.1 * AXLE.roughness_rms)
    rough = own.roughness_rms, drawn.roughness_rms
    lost = {
        (rough[0], "solved"): ([100.0, 200.0], [True, False]),
        (rough[1], "solved"): ([105.0, 330.0], [True, False]),
        (rough[0], "formula"): ([250.0, 300.0], [False, False]),
        (rough[1], "formula"): ([260.0, 330.0], [False, False]),
    }

    def power(settings, axle):
        found, inside = lost[axle.roughness_rms, axle.film]
        return np.array(found)[:, None], np.array(inside)

    monkeypatch.setattr(sampling, "_power", power)
    monkeypatch.setattr(sampling, "_drawn", lambda settings, row: (drawn, np.ones(1)))
    settings = SimpleNamespace(axle=own, shape=(2,), uncertain=(), draws=1, seed=1)
    spread = sampling.spread_of(settings)
    # the draw's own film at the first; at the second 200 W times the formulas' 330/300
    assert spread.high == pytest.approx([105.0, 220.0])


def test_points_that_the_film_model_does_not_cover_are_not_in_its_bound():
    outside = xr.DataArray([0.0, 0.02, 0.5, 0.75], dims="step")
    bound = xr.DataArray(
        covered_alone(np.array([2.0, 3.0, 50.0, 9.0]), outside.values), dims="step"
    )
    assert np.isnan(bound.values).tolist() == [False, False, True, True]
    loss = xr.DataArray([100.0, 100.0, 300.0, 300.0], dims="step")
    assert covered_share(bound, loss) == pytest.approx(5.0 / 200.0)
    said = points_beyond(outside, "steps")
    assert "at 2 of 4 steps, where the model covers 25 to 50 % of the load" in said
    assert "their error bars those of formulas" in said
    none = covered_share(bound[2:], loss[2:])
    assert np.isnan(none)
    assert "covers too little of the load for its bound" in solved_films(none, 0.7, said).headline


def test_a_map_says_where_churning_changes_its_formula():
    power = np.array([2.0, 40.0])[None, :, None, None] * np.ones((2, 1, 3, 1))
    dims = ("temperature", "speed", "torque", "source")
    one = xr.Dataset(
        {"loss": (dims, power), "churning_regime": (dims[:2], [[0.0, 0.0], [0.0, 1.0]])},
        coords={"temperature": [40.0, 80.0], "speed": [1000.0, 2000.0], "source": ["churning"]},
    )
    (said,) = loss_map._churning(one)
    assert "between 1000 and 2000 rpm with 80 °C oil" in said.headline
    assert "from 2.00 W to 40.0 W" in said.headline
    # twice the speed is 2^1.6 = 3 times the power in one regime, and the error bar is a factor of 3
    assert said.level == WARNING
    one["churning_regime"] *= 0.9
    assert not loss_map._churning(one)


# 60 km/h or 500 rad/s at the faster point, half of it at the slower one; 353.15 K is 80 degC
SPEEDS = {"speed_kmh": [30.0, 60.0], "pinion_speed": [250.0, 500.0]}


@pytest.mark.parametrize(
    ("study", "words", "dims", "coords", "more"),
    [
        (drive_cycle, "2387 and 4775 rpm", ("step",), {}, {
            "pinion_speed": (("step",), [2387.3, 4774.6]),
            "oil_temperature": (("time",), [78.0, 82.0, 78.0]),
        }),
        (sweep, "30 and 60 km/h", ("preload", "speed"), {
            "speed": [8.3, 16.7], "speed_kmh": ("speed", [30.0, 60.0]), "preload": [2500.0],
        }, {"oil_temperature": (("preload", "speed"), [[353.15, 353.15]])}),
        (runup, "2387 and 4775 rpm", ("slow_time",), {"slow_time": [1.0, 3.0]}, {
            "time": (("time",), [0.0, 4.0]), "pinion_speed": (("time",), [125.0, 625.0]),
        }),
    ],
)  # fmt: skip
def test_other_studies_say_so_in_the_same_words(study, words, dims, coords, more):
    shape = (1, 2) if len(dims) == 2 else (2,)
    one = xr.Dataset(
        {
            "loss": ((*dims, "source"), np.array([2.0, 40.0]).reshape(*shape, 1)),
            "churning_regime": (dims, np.array([0.0, 1.0]).reshape(shape)),
            **more,
        },
        coords={**coords, "source": ["churning"]},
        attrs={"setting_oil_temperature": 353.15},
    )
    (said,) = study._churning(one)
    assert f"between {words} with 80 °C oil and rises from 2.00 W to 40.0 W" in said.headline
    assert not study._churning(one.drop_vars("churning_regime"))


def test_every_study_keeps_the_regime_of_its_points():
    """The regime is 1/2 where w R b/nu is the geometric mean of 6000 and 9000."""
    axle = replace(AXLE, churning="changenet_velex_2007")
    oil, constants = 353.15, axle.kernel_parameters().churning
    nu = axle.oil.dynamic_viscosity(oil) / axle.oil.density
    gear = [re * nu / (0.5 * constants.ring_diameter * constants.ring_width)
            for re in (5999.0, math.sqrt(6000.0 * 9000.0), 9001.0)]  # fmt: skip
    expected = pytest.approx([0.0, 0.5, 1.0], abs=1e-12)
    assert churning_regime(axle, oil, -np.array(gear)) == expected
    assert churning_regime(replace(axle, churning="boness_1989"), oil, gear) is None
    pinion = axle.mesh.ratio * np.array(gear)
    points = xr.Dataset(
        {"pinion_speed": (GRID, [[*pinion, np.nan]]), "oil_temperature": (GRID, [[oil] * 4])}
    )
    swept = with_churning_regime(points, axle)["churning_regime"].values[0]
    assert swept[:3] == expected
    assert np.isnan(swept[3])
    grid = LossMapSettings(axle=axle, speeds=pinion, torques=np.array([50.0, 60.0]),
                           temperatures=np.array([oil, oil + 1.0]), draws=0)  # fmt: skip
    assert run_loss_map(grid)["churning_regime"].values[0] == expected
