"""Refining the cells of a unilateral contact: the order of the errors against Hertz."""

import numpy as np
import pytest

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem
from gearlube_core.tooth_contact.coupled_strips import StripCompliance
from tests.references.hertz_reference import HertzContact

HERTZ = HertzContact(R_x=0.02, R_y=0.6, contact_modulus=115.4e9, load=500.0)


def approach_error(n: int, observed: str) -> float:
    """Return the relative error of the approach with n x n cells."""
    dx, dy = 2.6 * HERTZ.semi_minor / n, 2.6 * HERTZ.semi_major / n
    x, y = (np.arange(n) - 0.5 * (n - 1)) * dx, (np.arange(n) - 0.5 * (n - 1)) * dy
    gap = x[:, None] ** 2 / (2.0 * HERTZ.R_x) + y**2 / (2.0 * HERTZ.R_y)
    if observed == "mean":
        gap += dx**2 / (24.0 * HERTZ.R_x) + dy**2 / (24.0 * HERTZ.R_y)
    coefficients = love_coefficients(dx, dy, n, n, HERTZ.contact_modulus, observed)
    problem = UnilateralProblem(
        compliance=StripCompliance([HalfSpaceConvolution(coefficients)]),
        gap=gap.ravel(),
        arm=np.ones(n * n),
        cell_area=np.full(n * n, dx * dy),
    )
    solution = solve_torque(problem, HERTZ.load, tolerance=1e-9)
    return abs(solution.rotation / HERTZ.approach - 1.0)


@pytest.mark.parametrize("observed", ["centre", "mean"])
def test_approach_converges_in_second_order(observed: str) -> None:
    cells = [8, 10, 12, 16, 20, 24, 32, 40, 48, 64, 80, 96]
    error = [approach_error(n, observed) for n in cells]
    # every count cuts the edge differently and scatters the error: fit over many counts,
    # allow half an order for what scatter is left
    order = -np.polyfit(np.log(cells), np.log(error), 1)[0]
    assert order > 1.5
    assert max(error[-4:]) < 2e-4


def test_cell_means_halve_the_error_of_the_approach() -> None:
    cells = [8, 10, 12, 16, 20, 24]
    centre = np.mean([approach_error(n, "centre") for n in cells])
    mean = np.mean([approach_error(n, "mean") for n in cells])
    assert mean < 0.6 * centre
