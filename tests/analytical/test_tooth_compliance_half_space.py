"""Hats on the half-space against closed forms, and finite elements against the half-space."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad
from skfem import Basis, ElementHexS2

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.tooth_compliance.flank_compliance import half_space_compliance
from gearlube_core.tooth_compliance.tooth_geometry import Flank
from gearlube_core.tooth_compliance.tooth_mesh import (
    energy_products,
    normal_hat_loads,
    stiffness_matrix,
)
from tests.helpers.compliance_cases import box_mesh

FACTOR = (1.0 - STEEL.poisson_ratio**2) / (math.pi * STEEL.youngs_modulus)


def flat_flank(height, length, skew=0.0):
    s, t = np.linspace(0.0, height, 9)[:, None], np.linspace(0.0, length, 9)[None, :]
    return Flank(np.stack([0.0 * s * t, s + 0.0 * t, t + skew * s], axis=-1))


def test_uniform_pressure_on_a_square_sinks_by_its_mean():
    side = 8e-3
    nodes = np.linspace(0.0, 1.0, 5)
    C = half_space_compliance(flat_flank(side, side), nodes, nodes, STEEL)
    edge = np.array([0.5, 1.0, 1.0, 1.0, 0.5]) / 4.0  # hats' areas, which add up to one
    f = np.outer(edge, edge).ravel()
    # mean of 1/r between two points of a unit square: 4 ln(1 + sqrt 2) - 4 (sqrt 2 - 1)/3
    mean = 4.0 * math.log(1.0 + math.sqrt(2.0)) - 4.0 * (math.sqrt(2.0) - 1.0) / 3.0
    # 0.2 %: the extrapolation's remainder
    assert f @ C @ f == pytest.approx(FACTOR * mean / side, rel=2e-3)


def test_hats_own_compliance_equals_its_fourier_integral():
    # hats of 2:1 base, as on a flank
    a, b = 1e-3, 2e-3
    nodes = np.linspace(0.0, 1.0, 5)
    C = half_space_compliance(flat_flank(4.0 * a, 4.0 * b), nodes, nodes, STEEL)

    def spectrum(theta, q):  # k = q/(1 - q) maps the half-line to [0, 1)
        k = q / (1.0 - q)
        u, v = 0.5 * k * math.cos(theta), 0.5 * k * (b / a) * math.sin(theta)
        return np.sinc(u / math.pi) ** 4 * np.sinc(v / math.pi) ** 4 / (1.0 - q) ** 2

    # 1/r transforms to 2 pi/k; the k of the area element cancels it
    integral = 4.0 * dblquad(spectrum, 0.0, 0.98, 0.0, 0.5 * math.pi, epsrel=1e-5)[0]
    expected = FACTOR * integral / (2.0 * math.pi * a)
    assert C[12, 12] == pytest.approx(expected, rel=2e-3)  # the extrapolation's remainder


@pytest.mark.parametrize("skew", [0.0, 0.7])
def test_distant_hats_see_point_forces(skew):
    height, length = 4e-3, 40e-3
    s, t = np.linspace(0.0, 1.0, 3), np.linspace(0.0, 1.0, 21)
    C = half_space_compliance(flat_flank(height, length, skew), s, t, STEEL)
    i, j = 21 + 2, 21 + 18  # at mid height
    r = 16 / 20 * length
    # the quadrupoles of the hats: (4 mm/32 mm)^2/12
    assert C[i, j] * r / FACTOR == pytest.approx(1.0, rel=4e-3)


def deep_block(per_hat, layers):
    """Return C_fe and C_hs of 7 x 7 hats on a block held at its back.

    It is 42 times as wide and deep as the middle hats' spacing.
    """
    k, half, hats = 3.0, 1.0, 7
    q = np.linspace(-1.0, 1.0, per_hat * (hats - 1) + 1)
    y = half * np.sinh(k * q) / math.sinh(k)
    depth = 2.0 * half * np.sinh(5.0 * np.linspace(0.0, 1.0, layers + 1)) / math.sinh(5.0)
    mesh = box_mesh(depth, y, y, profile=len(q) - 1)
    nodes = np.linspace(0.0, 1.0, hats)
    forces, _ = normal_hat_loads(mesh, "left", nodes, nodes)
    basis = Basis(mesh.solid, ElementHexS2(), intorder=4)
    K = stiffness_matrix(basis, STEEL)
    across, _, station = Basis(mesh.logical, ElementHexS2(), intorder=1).doflocs
    free = np.flatnonzero(np.repeat(across < mesh.across - 0.25, 3))
    layer = np.repeat(np.floor(station + 0.25).astype(int), 3)[free]
    elastic = energy_products(K[free][:, free], forces[free], layer)

    fine = half * np.sinh(k * np.linspace(-1.0, 1.0, 97)) / math.sinh(k)
    points = np.zeros((97, 97, 3))
    # s runs from the root, which is the row `profile`, to the tip at y[0]
    points[..., 1], points[..., 2] = fine[::-1, None], fine[None, :]
    return elastic, half_space_compliance(Flank(points), nodes, nodes, STEEL)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("per_hat", "layers", "own", "local"),
    [
        # measured: 2.8 and 1.9 % with two quadratic elements to a hat, 1.7 and 0.7 % with
        # three; the part that stays is the block's size, of the order of 1/42
        (2, 5, 0.035, 0.025),
        pytest.param(3, 8, 0.02, 0.01, marks=pytest.mark.slow),
    ],
)
def test_a_deep_block_is_a_half_space_and_leaves_no_image_part(per_hat, layers, own, local):
    """Key to the split: nothing local is counted twice."""
    elastic, half_space = deep_block(per_hat, layers)
    n, middle = 7, 24
    image = elastic - half_space
    assert abs(image[middle, middle]) < own * half_space[middle, middle]
    # what the block's faces do is nearly the same for neighbours and cancels in the difference
    f = np.zeros(n * n)
    f[middle] = 1.0
    f[[middle - 1, middle + 1, middle - n, middle + n]] = -0.25
    assert abs(f @ image @ f) < local * (f @ half_space @ f)
