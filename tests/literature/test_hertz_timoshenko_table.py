"""Semi-axis coefficients of Hertz contact as tabulated in Timoshenko and Goodier 1951, art. 139."""

import math

import pytest

from gearlube_core.contact.hertz import hertz_ellipse
from tests.helpers.each import each

# theta [deg], m, n with a = m L, b = n L, L^3 = 3 P/(4 E* (A + B)), cos theta = (B - A)/(B + A)
TABLE = [
    (30.0, 2.731, 0.493),
    (35.0, 2.397, 0.530),
    (40.0, 2.136, 0.567),
    (45.0, 1.926, 0.604),
    (50.0, 1.754, 0.641),
    (55.0, 1.611, 0.678),
    (60.0, 1.486, 0.717),
    (65.0, 1.378, 0.759),
    (70.0, 1.284, 0.802),
    (75.0, 1.202, 0.846),
    (80.0, 1.128, 0.893),
    (85.0, 1.061, 0.944),
    (90.0, 1.000, 1.000),
]


@each(("theta_deg", "m", "n"), TABLE)
def test_semi_axes_agree_with_the_textbook_table(theta_deg: float, m: float, n: float) -> None:
    A_plus_B, P, E_star = 30.0, 400.0, 1.1e11
    difference = A_plus_B * math.cos(math.radians(theta_deg))
    # A = 1/(2 R_y) and B = 1/(2 R_x)
    R_x, R_y = 1.0 / (A_plus_B + difference), 1.0 / (A_plus_B - difference)
    length = (3.0 * P / (4.0 * E_star * A_plus_B)) ** (1.0 / 3.0)
    b, a, _ = hertz_ellipse(R_x, R_y, E_star, P)
    # the table goes back to Hertz 1882, with errors up to 0.0021 at 70 deg (noted by Cooper 1969)
    assert a / length == pytest.approx(m, abs=0.0025)
    assert b / length == pytest.approx(n, abs=0.0025)
