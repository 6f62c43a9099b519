"""Stiffness and damping of bearings and shaft ends against beams and the corrected equations."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair.supports import (
    Bearing,
    ShaftEnds,
    ShaftSupport,
    bearing_matrix,
    printed_support_stiffness,
    support_damping,
    support_stiffness,
)
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_dynamics_cases import symmetric_support

_BEARING_1 = Bearing(
    position=0.05, K_xx=3e8, K_yy=4e8, K_zz=1e8, K_theta_x=2e4, K_theta_y=3e4, K_x_theta_y=1e6,
    K_y_theta_x=-2e6,
)  # fmt: skip
_BEARING_2 = Bearing(
    position=-0.08, K_xx=2e8, K_yy=1e8, K_zz=2e8, K_theta_x=1e4, K_theta_y=2e4, K_x_theta_y=-5e5,
    K_y_theta_x=7e5,
)  # fmt: skip
_SUPPORT = ShaftSupport(first=_BEARING_1, second=_BEARING_2)


def test_support_stiffness_has_the_corrected_terms_of_eq_29() -> None:
    K, l1, l2 = support_stiffness(_SUPPORT), 0.05, 0.08
    assert np.abs(K - K.T).max() == 0.0
    assert np.linalg.eigvalsh(K[:5, :5]).min() > 0.0
    assert K[0, 0] == pytest.approx(5e8)
    assert K[2, 2] == pytest.approx(3e8)
    assert K[0, 4] == pytest.approx(l1 * 3e8 - l2 * 2e8 + 1e6 - 5e5)
    assert K[1, 3] == pytest.approx(-l1 * 4e8 + l2 * 1e8 - 2e6 + 7e5)
    tilt_y = l1**2 * 3e8 + l2**2 * 2e8 + 2.0 * l1 * 1e6 + 2.0 * l2 * 5e5 + 3e4 + 2e4
    assert K[4, 4] == pytest.approx(tilt_y)
    tilt_x = l1**2 * 4e8 + l2**2 * 1e8 + 2.0 * l1 * 2e6 + 2.0 * l2 * 7e5 + 2e4 + 1e4
    assert K[3, 3] == pytest.approx(tilt_x)
    assert not K[5].any()


def test_rigid_motion_of_the_member_strains_each_bearing_by_its_own_displacement() -> None:
    rng = np.random.default_rng(1)
    motion = rng.normal(size=6)
    energy = 0.0
    for bearing in (_BEARING_1, _BEARING_2):
        at = motion.copy()
        at[:3] += np.cross(motion[3:], [0.0, 0.0, bearing.position])
        energy += 0.5 * at @ bearing_matrix(bearing, None) @ at
    # rounding
    assert 0.5 * motion @ support_stiffness(_SUPPORT) @ motion == pytest.approx(energy, rel=1e-12)


def test_shaft_in_rigid_pinned_bearings_has_the_stiffness_of_eq_25() -> None:
    """Both ends pinned: 3EI(1/l1^3 + 1/l2^3), 3EI(1/l1 + 1/l2), 3EI|1/l1^2 - 1/l2^2|, AE/l each."""
    l1, l2, shaft = 0.05, 0.08, ShaftEnds(radius=0.012, youngs_modulus=2.07e11)
    EI = 2.07e11 * math.pi * 0.012**4 / 4.0
    rigid = {"K_xx": 1e13, "K_yy": 1e13, "K_zz": 1e13}
    K = support_stiffness(
        ShaftSupport(
            first=Bearing(position=l1, **rigid), second=Bearing(position=-l2, **rigid), shaft=shaft
        )
    )
    tolerance = 5e-4  # bearings of 1e13 N/m are stiff, not rigid
    bending = 3.0 * EI * (1.0 / l1**3 + 1.0 / l2**3)
    printed = 3.0 * EI * (l1 + l2) * ((l1 - l2) ** 2 + l1 * l2) / (l1 * l2) ** 3
    assert bending == pytest.approx(printed, rel=1e-12)
    assert K[0, 0] == pytest.approx(bending, rel=tolerance)
    assert K[3, 3] == pytest.approx(3.0 * EI * (1.0 / l1 + 1.0 / l2), rel=tolerance)
    assert K[4, 4] == pytest.approx(K[3, 3], rel=1e-12)
    assert abs(K[0, 4]) == pytest.approx(3.0 * EI * (l1**-2 - l2**-2), rel=tolerance)
    assert K[1, 3] == pytest.approx(-K[0, 4], rel=1e-12)
    axial = 2.07e11 * math.pi * 0.012**2 * (1.0 / l1 + 1.0 / l2)
    assert K[2, 2] == pytest.approx(axial, rel=tolerance)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_shaft_between_body_and_clamping_bearing_is_a_beam_clamped_at_both_ends(
    side: float,
) -> None:
    """12EI/l^3, 6EI/l^2, 4EI/l at the body's end, the bearing held against everything."""
    length, shaft = 0.06, ShaftEnds(radius=0.012, youngs_modulus=2.07e11)
    rigid = Bearing(
        position=side * length, K_xx=1e13, K_yy=1e13, K_zz=1e13, K_theta_x=1e11, K_theta_y=1e11
    )
    none = Bearing(position=-side * length, K_xx=0.0, K_yy=0.0, K_zz=0.0)
    first, second = (rigid, none) if side > 0.0 else (none, rigid)
    K = support_stiffness(ShaftSupport(first=first, second=second, shaft=shaft))
    EI, tolerance = shaft.bending, 1e-4  # bearings are stiff, not rigid
    assert K[0, 0] == pytest.approx(12.0 * EI / length**3, rel=tolerance)
    assert K[1, 1] == pytest.approx(12.0 * EI / length**3, rel=tolerance)
    assert K[0, 4] == pytest.approx(side * 6.0 * EI / length**2, rel=tolerance)
    assert K[1, 3] == pytest.approx(-side * 6.0 * EI / length**2, rel=tolerance)
    assert K[3, 3] == pytest.approx(4.0 * EI / length, rel=tolerance)
    assert K[4, 4] == pytest.approx(4.0 * EI / length, rel=tolerance)


@pytest.mark.parametrize("series", ["beam", "term_by_term"])
def test_shaft_ends_soften_and_vanish_when_stiff(series: str) -> None:
    soft = symmetric_support(
        K_xx=2e8, K_yy=2e8, K_zz=2e8, distance=0.05,
        shaft=ShaftEnds(radius=0.01, youngs_modulus=2.07e11, series=series),
    )  # fmt: skip
    stiff = replace(soft, shaft=replace(soft.shaft, radius=1.0))
    free, K = support_stiffness(replace(soft, shaft=None)), support_stiffness(soft)
    assert np.linalg.eigvalsh(free - K).min() > -1e-9 * free.max()
    assert K[0, 0] < 0.9 * free[0, 0]
    # 3 E I/l^3 is 4e7 times the bearing's stiffness at 1 m radius
    assert np.allclose(support_stiffness(stiff), free, rtol=1e-5, atol=1e-6 * free[3, 3])


def test_a_pinned_bearing_takes_the_shaft_in_series_with_its_translation() -> None:
    """Without stiffness against tilting both series agree: 1/k = 1/k_b + l^3/(3 E I)."""
    matrices = []
    for series in ("beam", "term_by_term"):
        shaft = ShaftEnds(radius=0.01, youngs_modulus=2.07e11, series=series)
        K = bearing_matrix(Bearing(position=0.05, K_xx=1e8, K_yy=1e8, K_zz=1e8), shaft)
        matrices.append(K)
    bending = 3.0 * shaft.bending / 0.05**3
    assert matrices[0][0, 0] == pytest.approx(1.0 / (1e-8 + 1.0 / bending), rel=1e-12)
    assert np.allclose(matrices[0], matrices[1], rtol=1e-12, atol=1e-6)


def test_printed_moments_cancel_the_stiffness_against_tilting() -> None:
    """He et al. 2007 eq. (29): signs of the second bearing's moments."""
    support = he_2007_pair(0.1).pinion_support
    printed, K = printed_support_stiffness(support), support_stiffness(support)
    assert abs(printed[3, 3]) < 1e-9 * K[3, 3]
    assert abs(printed[4, 4]) < 1e-9 * K[4, 4]
    assert np.abs(printed - printed.T).max() > 1e7  # N: translation gives moments, not inversely
    assert np.array_equal(np.diag(printed)[:3], np.diag(K)[:3])


def test_printed_damping_sums_roots_of_the_bearings_stiffness() -> None:
    """Eq. (32) against the paper's own bearing force: sqrt(2) for equal bearings."""
    support = he_2007_pair(0.1).pinion_support
    total, printed = (support_damping(support, 2.2, 6e-4, 0.05, each) for each in (False, True))
    assert np.allclose(printed[:3] / total[:3], math.sqrt(2.0), rtol=1e-12)
    assert np.array_equal(printed[3:], total[3:])
    K = support_stiffness(support)
    # c/(2 sqrt(K m)) of each motion alone
    assert total[0] == pytest.approx(0.1 * math.sqrt(K[0, 0] * 2.2), rel=1e-12)
    assert total[4] == pytest.approx(0.1 * math.sqrt(K[4, 4] * 6e-4), rel=1e-12)
    assert total[5] == 0.0
