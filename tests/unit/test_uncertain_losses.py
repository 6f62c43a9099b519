"""Uncertain data of an axle's losses, and what a map says where an error bar does not hold."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from gearlube.report.parts import WARNING
from gearlube.studies.loss_map import findings
from gearlube.studies.loss_map.settings import LossMapSettings
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


def test_a_map_says_where_churning_changes_its_formula():
    power = np.array([2.0, 40.0])[None, :, None, None] * np.ones((2, 1, 3, 1))
    dims = ("temperature", "speed", "torque", "source")
    one = xr.Dataset(
        {
            "loss": (dims, power),
            "churning_regime": (dims[:2], [[0.0, 0.0], [0.0, 1.0]]),
        },
        coords={"temperature": [40.0, 80.0], "speed": [1000.0, 2000.0], "source": ["churning"]},
    )
    (said,) = findings._churning(one)
    assert "between 1000 and 2000 rpm with 80 °C oil" in said.headline
    assert "from 2.00 W to 40.0 W" in said.headline
    # twice the speed is 2^1.6 = 3 times the power in one regime, and the error bar is a factor of 3
    assert said.level == WARNING
    one["churning_regime"] *= 0.9
    assert not findings._churning(one)
