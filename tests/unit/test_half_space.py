"""Half-space cells: influence coefficients by quadrature, convolution by summation."""

import math
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import dblquad

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.errors import ParameterError
from gearlube_core.tooth_contact.coupled_strips import StripCompliance
from tests.helpers.each import each

E_STAR = 115.4e9
DX, DY = 3e-5, 5e-4


def potential_of_a_cell(x: float, y: float) -> float:
    """Return u/F at (x, y) by quadrature of 1/r along y after a closed integral along x."""
    a, b = 0.5 * DX, 0.5 * DY

    def along_x(eta: float) -> float:
        distance = abs(y - eta)
        return math.asinh((x + a) / distance) - math.asinh((x - a) / distance)

    breaks = [-b, *([y] if -b < y < b else []), b]
    total = sum(
        dblquad(lambda eta, _: along_x(eta), 0.0, 1.0, low, high, epsabs=1e-16, epsrel=1e-11)[0]
        for low, high in pairwise(breaks)
    )
    return total / (math.pi * E_STAR * DX * DY)


@each(("i", "j"), [(0, 0), (1, 0), (0, 1), (3, 2), (11, 0), (2, 7)])
def test_centre_coefficient_is_the_integral_of_boussinesq(i: int, j: int) -> None:
    coefficients = love_coefficients(DX, DY, 12, 8, E_STAR)
    # the quadrature's tolerance, spoilt by the logarithm at the observer
    assert coefficients[i, j] / potential_of_a_cell(i * DX, j * DY) == pytest.approx(1.0, rel=1e-8)


# midpoint rule, second order in DX/40: cells that touch bend the field within DX of their edges
@each(
    ("i", "j", "tolerance"),
    [
        (0, 0, 1e-4),
        (1, 0, 1e-4),
        (0, 1, 1e-4),
        (3, 2, 1e-6),
        (0, 2, 1e-6),
        (20, 0, 1e-5),
        (25, 9, 1e-6),
    ],
)
def test_mean_coefficient_averages_the_displacement_over_a_cell(
    i: int, j: int, tolerance: float
) -> None:
    # fine sub-cells of the observing cell, each seen in its centre; (25, 9) lies in the far branch
    x = i * DX + DX * ((np.arange(40) + 0.5) / 40 - 0.5)
    y = j * DY + DY * ((np.arange(800) + 0.5) / 800 - 0.5)
    # Love's corner form in logarithms, independent of the asinh form of the code
    total = 0.0
    for sx in (1, -1):
        for sy in (1, -1):
            X, Y = np.meshgrid(x + sx * DX / 2, y + sy * DY / 2, indexing="ij")
            r = np.hypot(X, Y)
            total = total + sx * sy * (X * np.log(Y + r) + Y * np.log(X + r))
    expected = float(np.mean(total)) / (math.pi * E_STAR * DX * DY)
    value = love_coefficients(DX, DY, 26, 10, E_STAR, "mean")[i, j]
    assert value / expected == pytest.approx(1.0, rel=tolerance)


@pytest.mark.parametrize("observed", ["centre", "mean"])
def test_far_cells_act_as_point_forces(observed: str) -> None:
    coefficients = love_coefficients(DX, DX, 400, 400, E_STAR, observed)
    i, j = np.array([300, 399, 0, 200]), np.array([100, 399, 399, 0])
    point = 1.0 / (math.pi * E_STAR * DX * np.hypot(i, j))
    # (h/r)^2/24 from each of two directions and up to two averages, r >= 200 h
    np.testing.assert_allclose(coefficients[i, j], point, rtol=5e-6)


@pytest.mark.parametrize("observed", ["centre", "mean"])
def test_coefficients_keep_their_digits_at_many_cells(observed: str) -> None:
    double = love_coefficients(DX, DY, 256, 256, E_STAR, observed)
    # E* inverse times length inverse: scaling by a non-power of two changes all roundings
    scaled = 3.7 * love_coefficients(3.7 * DX, 3.7 * DY, 256, 256, E_STAR, observed)
    np.testing.assert_allclose(double, scaled, rtol=1e-8)


@pytest.mark.parametrize("observed", ["centre", "mean"])
def test_operator_is_positive_definite_for_long_cells(observed: str) -> None:
    nx, ny = 14, 9
    C = love_coefficients(DX, DY, nx, ny, E_STAR, observed)
    i, j = np.divmod(np.arange(nx * ny), ny)
    dense = C[np.abs(i[:, None] - i), np.abs(j[:, None] - j)]
    assert np.linalg.eigvalsh(dense).min() > 0.0


@each("shape", [(1, 1), (1, 7), (7, 1), (13, 11), (40, 48)])
def test_convolution_is_the_direct_sum(shape: tuple[int, int]) -> None:
    nx, ny = shape
    C = love_coefficients(DX, DY, nx, ny, E_STAR)
    forces = np.random.default_rng(7).standard_normal(shape)
    i, j = np.divmod(np.arange(nx * ny), ny)
    dense = C[np.abs(i[:, None] - i), np.abs(j[:, None] - j)]
    expected = (dense @ forces.ravel()).reshape(shape)
    cells = HalfSpaceConvolution(C)
    for _ in range(2):  # the second call finds used buffers
        displacement = cells(forces)
    # rounding of a transform relative to the largest value
    np.testing.assert_allclose(displacement, expected, atol=1e-13 * np.abs(expected).max(), rtol=0)


def test_objects_of_different_threads_do_not_disturb_each_other() -> None:
    C = love_coefficients(DX, DY, 40, 48, E_STAR)
    forces = np.random.default_rng(7).random((8, 40, 48))
    expected = [HalfSpaceConvolution(C)(f).copy() for f in forces]

    def plan_and_repeat(f: np.ndarray) -> np.ndarray:
        cells = HalfSpaceConvolution(C)
        for _ in range(50):
            displacement = cells(f)
        return displacement.copy()

    with ThreadPoolExecutor(max_workers=4) as pool:
        for got, wanted in zip(pool.map(plan_and_repeat, forces), expected, strict=True):
            np.testing.assert_array_equal(got, wanted)


def test_strips_do_not_press_on_each_other_but_shapes_do() -> None:
    strip = HalfSpaceConvolution(love_coefficients(DX, DY, 4, 5, E_STAR))
    other = HalfSpaceConvolution(love_coefficients(2 * DX, DY, 3, 2, E_STAR))
    forces = np.random.default_rng(3).random(26)
    alone = StripCompliance([strip, other])(forces).copy()
    np.testing.assert_array_equal(alone[:20].reshape(4, 5), strip(forces[:20].reshape(4, 5)))
    np.testing.assert_array_equal(alone[20:].reshape(3, 2), other(forces[20:].reshape(3, 2)))
    shapes = np.random.default_rng(4).random((26, 3))
    K = np.array([[2.0, 1.0, 0.0], [1.0, -1.0, 0.5], [0.0, 0.5, 3.0]]) * 1e-9
    coupled = StripCompliance([strip, other], shapes, K)(forces)
    np.testing.assert_allclose(coupled - alone, shapes @ K @ shapes.T @ forces, rtol=1e-9)


def test_bad_half_space_input_is_named() -> None:
    with pytest.raises(ParameterError, match="dx must be above 0 m"):
        love_coefficients(0.0, DY, 4, 4, E_STAR)
    with pytest.raises(ParameterError, match="contact_modulus must be finite"):
        love_coefficients(DX, DY, 4, 4, math.nan)
    with pytest.raises(ParameterError, match="nx must be within 1 to 4096, got 0"):
        love_coefficients(DX, DY, 0, 4, E_STAR)
    with pytest.raises(ParameterError, match="observed must be one of centre, mean"):
        love_coefficients(DX, DY, 4, 4, E_STAR, "corner")
    with pytest.raises(ParameterError, match="finite array of shape"):
        HalfSpaceConvolution(np.array([[1.0, math.nan]]))


def test_bad_strip_compliance_is_named() -> None:
    strip = HalfSpaceConvolution(love_coefficients(DX, DY, 2, 2, E_STAR))
    with pytest.raises(ParameterError, match="at least one strip"):
        StripCompliance([])
    with pytest.raises(ParameterError, match="belong together"):
        StripCompliance([strip], np.ones((4, 1)))
    with pytest.raises(ParameterError, match=r"shape \(4, 1\), got \(3, 1\)"):
        StripCompliance([strip], np.ones((3, 1)), np.eye(1))
    with pytest.raises(ParameterError, match="must be symmetric"):
        StripCompliance([strip], np.ones((4, 2)), np.array([[1.0, 2.0], [0.0, 1.0]]))
    with pytest.raises(ParameterError, match="must be square"):
        StripCompliance([strip], np.ones((4, 2)), np.ones((2, 3)))
    with pytest.raises(ParameterError, match="must be finite"):
        StripCompliance([strip], np.ones((4, 1)), np.array([[math.nan]]))
