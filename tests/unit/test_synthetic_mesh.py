"""The synthetic mesh against its formulas at single angles."""

import math

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
from gearlube_core.errors import ParameterError

MESH = synthetic_mesh(
    stiffness=3e8, pinion_radius=0.02, stiffness_harmonics=((0.1, 0.02), (-0.03, 0.04)),
    error_harmonics=((1e-6, -2e-6),), radius_mismatch=0.01, radius_modulation=0.03,
    contact_ratio=2.2, pinion_teeth=11, gear_teeth=33, torque=70.0,
)  # fmt: skip


def value(key, angle):
    """Sum of a series at a mesh angle."""
    coefficients = MESH.series[key][0]
    return sum(
        a * math.cos(h * angle) + b * math.sin(h * angle) for h, (a, b) in enumerate(coefficients)
    )


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.5])
def test_series_are_those_of_the_docstring(angle):
    c, s = math.cos(angle), math.sin(angle)
    c2, s2 = math.cos(2.0 * angle), math.sin(2.0 * angle)
    k = 3e8 * (1.0 + 0.1 * c + 0.02 * s - 0.03 * c2 + 0.04 * s2)
    expected = {
        "k_m": k, "k_t": k, "R_p": 0.02 * (1.0 + 0.04 * c), "R_g": 0.06 * (1.0 + 0.03 * c),
        "e": 1e-6 * c - 2e-6 * s, "n_x": 1.0, "n_y": 0.0, "n_z": 0.0,
    }  # fmt: skip
    for key, number in expected.items():
        assert value(key, angle) == pytest.approx(number, rel=1e-13, abs=1e-20), key
    assert (MESH.pinion_teeth, MESH.gear_teeth, MESH.torque.tolist()) == (11, 33, [70.0])


@pytest.mark.parametrize("contact_ratio", [1.01, 1.7, 2.2, 3.0])
def test_shares_are_half_sines_over_the_length_of_contact_that_add_up_to_one(contact_ratio):
    mesh = synthetic_mesh(contact_ratio=contact_ratio)
    share = mesh.windows["share"][0]
    assert share.size == 60

    def weight(position):  # mesh periods from the middle of the window
        away = np.abs(position)
        return np.where(away < 0.5 * contact_ratio, np.cos(np.pi * away / contact_ratio), 0.0)

    position = np.arange(60) / 20.0 - 1.5
    # its neighbours stand a period before and after it, and there are no more within reach
    total = sum(weight(position + n) for n in range(-3, 4))
    np.testing.assert_allclose(share, weight(position) / total, atol=1e-12)
    assert share.reshape(3, 20).sum(axis=0) == pytest.approx(np.ones(20), rel=1e-14)
    assert mesh.contact_ratio == contact_ratio


def test_contact_that_ends_where_the_next_begins_is_refused():
    with pytest.raises(ParameterError, match=r"contact_ratio must be within 1\.01 to 3"):
        synthetic_mesh(contact_ratio=1.0)
