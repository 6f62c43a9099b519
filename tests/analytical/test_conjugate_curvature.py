"""Relative curvature of conjugate flanks against involute gears, whose radii are known."""

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from tests.helpers.conjugate_curvature import conjugate_relative_curvature
from tests.helpers.each import each

BASE_1, BASE_2 = 0.03, 0.07  # base radii [m]
PRESSURE = math.radians(20.0)
SPEED = 100.0  # of gear 1 [rad/s]
# Positions along the line of action from the foot on base circle 1, as shares of its length.
SHARES = (0.1, 0.25, 0.3, 0.45, 0.8)


def rotation(speed):
    return np.array([0.0, 0.0, speed])


def parallel_pair(share, helix=0.0, internal=False):
    """Arguments for an involute pair about z: gear 1 at the origin, gear 2 at +x.

    Transverse section: the line of action touches base circle 1 at the foot and runs along u.
    The flank of gear 1 at distance rho from the foot has the centre of curvature at the foot.
    """
    sign = 1.0 if internal else -1.0
    centre_distance = (BASE_2 - BASE_1 if internal else BASE_1 + BASE_2) / math.cos(PRESSURE)
    centre_2 = np.array([-sign * centre_distance, 0.0, 0.0])
    # base circle 1 is touched on the side of the pitch point; beside a ring, both feet lie there
    side = sign * math.sin(PRESSURE)
    radial = np.array([math.cos(PRESSURE), side, 0.0])
    u = np.array([math.sin(PRESSURE), -sign * math.cos(PRESSURE), 0.0])
    length = (BASE_1 + BASE_2) * math.tan(PRESSURE)
    rho_1 = share * length
    point = BASE_1 * radial + rho_1 * u
    foot_2 = centre_2 + sign * BASE_2 * radial
    rho_2 = float((foot_2 - point) @ u)
    # base helix: the flank's straight line leans by `helix` in the tangent plane of the base
    # cylinder; its normal leaves the transverse plane by the same angle
    z = np.array([0.0, 0.0, 1.0])
    line_normal = math.cos(helix) * u + math.sin(helix) * z
    across = np.cross(line_normal, -math.sin(helix) * u + math.cos(helix) * z)
    normal = -line_normal  # from gear 2 into gear 1
    kappa_1 = math.cos(helix) / rho_1
    omega_1 = rotation(SPEED)
    omega_2 = rotation(sign * SPEED * BASE_1 / BASE_2)
    arguments = {
        "shape_operator": kappa_1 * np.outer(across, across),
        "normal": normal,
        "velocity_1": np.cross(omega_1, point),
        "velocity_2": np.cross(omega_2, point - centre_2),
        "omega_1": omega_1,
        "omega_2": omega_2,
    }
    # rho_2 < 0 for the hollow flank of a ring, with |rho_2| > rho_1
    return arguments, across, math.cos(helix) * (1.0 / rho_1 + 1.0 / rho_2)


@each("share", SHARES)
@each("helix_deg", [-25.0, 0.0, 15.0, 30.0])
def test_outer_pair_has_the_curvature_of_its_normal_section(share, helix_deg):
    """Radii rho / cos(base helix angle) across the straight line of contact."""
    arguments, across, expected = parallel_pair(share, math.radians(helix_deg))
    result = conjugate_relative_curvature(**arguments)
    # closed form on both sides: rounding
    assert result.curvature == pytest.approx(expected, rel=1e-12)
    assert abs(result.across @ across) == pytest.approx(1.0, rel=1e-14)


@each("share", SHARES)
def test_internal_pair_has_the_difference_of_the_curvatures(share):
    arguments, _, expected = parallel_pair(share, internal=True)
    # closed form on both sides: rounding, magnified by the difference of the radii
    assert conjugate_relative_curvature(**arguments).curvature == pytest.approx(expected, rel=1e-11)


def test_curvature_is_geometry_and_not_speed():
    arguments, _, expected = parallel_pair(0.45)
    fast = {
        key: value * 7.0 if key.startswith(("velocity", "omega")) else value
        for key, value in arguments.items()
    }
    assert conjugate_relative_curvature(**fast).curvature == pytest.approx(expected, rel=1e-12)


def test_surfaces_that_approach_are_no_point_of_contact():
    arguments, _, _ = parallel_pair(0.45)
    speed = np.linalg.norm(arguments["velocity_1"]) + np.linalg.norm(arguments["velocity_2"])
    arguments["velocity_1"] = arguments["velocity_1"] + 0.02 * speed * arguments["normal"]
    with pytest.raises(ParameterError, match=r"n \. v12 must be zero .* check the ratio"):
        conjugate_relative_curvature(**arguments)
