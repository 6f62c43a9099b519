"""Flow factors of Patir and Cheng: their fits, and own solutions beside them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.rough_patch.flow import (
    PEKLENIK,
    pressure_flow_factor,
    shear_flow_factor,
)
from gearlube_core.rough_patch.table import gaussian_patches, patch_table
from tests.helpers.each import each


@each("peklenik", PEKLENIK)
def test_both_forms_of_the_shear_factor_meet(peklenik: float):
    # printed to three or four digits: the forms meet at h/sigma = 5 within 1 %
    near, far = shear_flow_factor(np.array([5.0, 5.0 + 1e-9]), peklenik)
    assert near == pytest.approx(far, rel=0.01)


def test_fits_go_over_into_smooth_surfaces():
    for peklenik in PEKLENIK:
        assert float(pressure_flow_factor(np.array(30.0), peklenik)) == pytest.approx(1.0, abs=0.01)
        assert float(shear_flow_factor(np.array(30.0), peklenik)) == pytest.approx(0.0, abs=0.002)


def test_fits_are_refused_outside_what_they_were_made_for():
    with pytest.raises(ParameterError, match=r"at least 1 for this Peklenik number, got 0\.9"):
        pressure_flow_factor(np.array([0.9, 2.0]), 1.0 / 9.0)
    with pytest.raises(ParameterError, match="peklenik must be one of"):
        shear_flow_factor(np.array(1.0), 2.0)


@pytest.mark.slow
@pytest.mark.parametrize("peklenik", [1.0, 1.0 / 3.0])
def test_own_solutions_lie_near_the_fits(peklenik: float):
    # Another autocorrelation (Gaussian for linear), resolved heights, means of three small patches
    # of ten correlation lengths, whose spread is 0.05 at a film ratio of 2: 0.08 for the pressure
    # factors, 0.12 for the shear factors
    ratios = np.array([2.0, 3.0, 5.0])
    patches = gaussian_patches(4e-7, 2e-5, 2e-5 / peklenik, [1, 2, 3], nodes=96, nodes_per_length=9)
    found = patch_table(patches, ratios, contact=False)
    published = pressure_flow_factor(ratios, peklenik)
    assert found.pressure_x.values == pytest.approx(published, abs=0.08)
    across = pressure_flow_factor(ratios, 1.0 / peklenik)
    assert found.pressure_y.values == pytest.approx(across, abs=0.08)
    assert found.shear_x.values == pytest.approx(shear_flow_factor(ratios, peklenik), abs=0.12)
    # a lay across the flow hinders it, and carries more oil along with its surface
    if peklenik < 1.0:
        assert (found.pressure_x < found.pressure_y).all()
        isotropic = shear_flow_factor(ratios, 1.0)
        assert (found.shear_x.values > isotropic).all()


@pytest.mark.slow
def test_separation_of_gaussian_patches_falls_with_the_logarithm_of_the_load():
    # p ~ exp(-h/(0.48 sigma)) in [almqvist_2011], from theory and solutions of their own
    patches = gaussian_patches(4e-7, 2e-5, 2e-5, [1, 2], nodes=96, nodes_per_length=9)
    table = patch_table(patches, [1.0, 2.0])
    fall = math.log(float(table.asperity_pressure[0] / table.asperity_pressure[1]))
    # peaks of small patches end, so that the fall steepens: 15 %
    assert 1.0 / fall == pytest.approx(0.48, rel=0.15)
