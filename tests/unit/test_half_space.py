"""Elastic half-space: coefficients, moduli, strips and transforms."""

import dataclasses
import inspect
import math
import sys
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import dblquad

from gearlube.studies.contact.command import contact
from gearlube.studies.helical.command import helical
from gearlube_core.contact import fftw, half_space, half_space_periodic
from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.solid import (
    STEEL_MOHAMMADPOUR_2015,
    contact_modulus,
    pi_contact_modulus,
    reduced_modulus,
    solid_parameters,
)
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.tooth_contact.coupled_strips import (
    StripCompliance,
    StripGrowth,
    solve_on_growing_strips,
)
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


STEEL = STEEL_MOHAMMADPOUR_2015


def test_equal_solids_have_half_the_plane_strain_modulus() -> None:
    assert contact_modulus(STEEL, STEEL) == pytest.approx(210e9 / (2 * (1 - 0.3**2)), rel=1e-14)


def test_a_rigid_partner_doubles_the_contact_modulus() -> None:
    rigid = dataclasses.replace(STEEL, youngs_modulus=1.9e12, poisson_ratio=0.5)
    expected = 1.0 / (0.91 / 210e9 + 0.75 / 1.9e12)
    assert contact_modulus(STEEL, rigid) == pytest.approx(expected, rel=1e-14)


def test_the_three_moduli_stand_as_one_to_two_to_pi() -> None:
    e_star = contact_modulus(STEEL, STEEL)
    assert reduced_modulus(STEEL, STEEL) / e_star == 2.0
    assert pi_contact_modulus(STEEL, STEEL) / e_star == pytest.approx(math.pi, rel=1e-15)


def test_a_pair_of_like_solids_keeps_its_thermal_data() -> None:
    pair = solid_parameters(STEEL, STEEL)
    assert (pair.conductivity, pair.density, pair.heat_capacity) == (46.0, 7850.0, 470.0)


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("youngs_modulus", 210.0, "210 GPa is 2.1e11 Pa"),
        ("poisson_ratio", 0.7, "poisson_ratio must be within 0 to 0.5"),
        ("density", 7.85, "7.85 g/cm3 is 7850 kg/m3"),
        ("conductivity", float("nan"), "conductivity must be finite"),
    ],
)
def test_wrong_solid_data_are_refused_with_a_cure(field: str, value: float, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        dataclasses.replace(STEEL, **{field: value})


GROWTH = StripGrowth(factor=1.5, margin=1.1, attempts=6)
LENGTH, HALF_WIDTH = 8e-3, 0.3e-3  # m, of a contact that the strips must hold


def solution(_, width):
    """A contact of fixed half-width on four cells across a strip of `width`."""
    forces = np.zeros((4, 3))
    forces[1:3] = 1.0
    forces[[0, -1]] = float(width < HALF_WIDTH)
    outcome = SimpleNamespace(converged=True)
    return width, SimpleNamespace(forces=(forces,), solution=SimpleNamespace(outcome=outcome))


def grown(closing, width, growth=GROWTH):
    tried = []

    def solve(closing, width):
        tried.append((closing, width))
        return solution(closing, width)

    solve_on_growing_strips(
        solve, lambda _: LENGTH, closing=closing, width=width, growth=growth,
        tolerance=1e-5, where="mesh phase 0.250 and 50 N.m", cure=", or crown the flanks",
    )  # fmt: skip
    return tried


def test_strips_that_hold_the_contact_are_kept():
    assert grown(1.01 * LENGTH, HALF_WIDTH) == [(1.01 * LENGTH, HALF_WIDTH)]


def test_a_strip_that_is_too_narrow_only_widens():
    tried = grown(2.0 * LENGTH, 0.5 * HALF_WIDTH)
    assert [closing for closing, _ in tried] == [2.0 * LENGTH] * 3  # 0.5, 0.75, 1.125
    assert tried[-1][1] == pytest.approx(1.125 * HALF_WIDTH)


def test_a_closing_that_is_too_small_is_what_was_needed_and_a_margin():
    tried = grown(0.1 * LENGTH, HALF_WIDTH)
    assert tried[1] == (pytest.approx(1.1 * LENGTH), HALF_WIDTH)
    assert len(tried) == 2


def test_contact_that_always_leaves_is_an_error_with_place_and_cure():
    words = r"mesh phase 0.250 and 50 N.m still .* 2 enlargements. Reduce .*, or crown the flanks."
    with pytest.raises(ConvergenceError, match=words):
        grown(LENGTH, 1e-3 * HALF_WIDTH, StripGrowth(factor=1.5, margin=1.1, attempts=2))


def test_contact_that_is_not_found_names_place_residual_and_options_that_exist():
    outcome = SimpleNamespace(converged=False, residual=0.0125, iterations=2000)
    lost = SimpleNamespace(forces=(), solution=SimpleNamespace(outcome=outcome))
    words = "phase 0.250 and 50 N.m .* within 1e-05, got 0.0125 after 2000 .*--torques.*--positions"
    with pytest.raises(ConvergenceError, match=words):
        solve_on_growing_strips(
            lambda closing, width: (width, lost), lambda _: LENGTH, closing=LENGTH, width=1.0,
            growth=GROWTH, tolerance=1e-5, where="mesh phase 0.250 and 50 N.m",
        )  # fmt: skip
    for asked in (contact, helical):
        assert {"torques", "positions"} <= set(inspect.signature(asked).parameters)


def half_space_under(single):
    coefficients = half_space.love_coefficients(1e-5, 2e-5, 40, 27, E_STAR)
    return half_space.HalfSpaceConvolution(coefficients, single=single), (40, 27)


def periodic_under(axis, nx, ny):
    modes = half_space_periodic.periodic_modes(1e-5, 2e-5, nx, ny, E_STAR, 1e-3)
    shape = (nx, ny) if axis == "last" else (ny, nx)
    return half_space_periodic.PeriodicDeflection(modes, ny, axis), shape


@pytest.mark.parametrize(
    ("build", "arguments", "within"),
    [
        (half_space_under, (False,), 1e-13),
        (half_space_under, (True,), 1e-6),  # float32
        (periodic_under, ("last", 33, 12), 1e-13),
        (periodic_under, ("first", 33, 12), 1e-13),
        (periodic_under, ("first", 400, 200), 1e-13),  # in blocks: more than 1 MB
    ],
)
def test_deflections_are_those_of_fftw_to_round_off(monkeypatch, build, arguments, within):
    found = []
    for transforms in (fftw.pyfftw, fftw.scipy_transforms):
        for module in (half_space, half_space_periodic):
            monkeypatch.setattr(module, "pyfftw", transforms)
        deflection, shape = build(*arguments)
        pressure = np.random.default_rng(1).random(shape)
        for _ in range(2):  # buffers are used again
            found.append(deflection(pressure).copy())
    assert np.ptp(found[0]) > 0.0
    for one in found[1:]:
        assert np.abs(one - found[0]).max() < within * np.abs(found[0]).max()


def test_scipy_takes_over_where_pyfftw_is_not_installed(monkeypatch):
    assert fftw._installed() is fftw.pyfftw
    monkeypatch.setitem(sys.modules, "pyfftw", None)  # as if it were not installed
    assert fftw._installed() is fftw.scipy_transforms
