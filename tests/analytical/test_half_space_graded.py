"""Displacement under cells of different width: uniform cells, symmetry, Hertz contacts."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.contact.half_space import (
    GradedConvolution,
    HalfSpaceConvolution,
    graded_coefficients,
    love_coefficients,
)
from gearlube_core.ehl.point.equations.stencil import Grading, cell_faces
from gearlube_core.errors import ParameterError

E = 1.15e11


def _graded_nodes(a: float, count: int) -> np.ndarray:
    return Grading((-3.0 * a, -1.2 * a, 1.2 * a, 2.0 * a), (6.0, 1.0, 1.0, 4.0)).nodes(
        (-3.0 * a, 2.0 * a), count
    )


def test_equal_cells_are_those_of_the_uniform_grid() -> None:
    dx, dy, nx, ny = 1.3e-5, 4.0e-5, 13, 10
    nodes = (np.arange(nx) - 4.0) * dx
    pressure = np.random.default_rng(5).random((ny, nx))
    pressure[:, [0, 7]] = 0.0
    graded = GradedConvolution(graded_coefficients(cell_faces(nodes), nodes, dy, ny, E))
    uniform = HalfSpaceConvolution(love_coefficients(dy, dx, ny, nx, E) * dx * dy)(pressure)
    # the same closed form; rounding only
    assert np.abs(graded(pressure) - uniform).max() < 1e-12 * uniform.max()
    single = GradedConvolution(
        graded_coefficients(cell_faces(nodes), nodes, dy, ny, E), single=True
    )
    # float32 has 7 digits
    assert np.abs(single(pressure) - uniform).max() < 1e-5 * uniform.max()


@pytest.mark.slow
def test_a_hertz_contact_flattens_a_ball_on_a_graded_grid_to_second_order() -> None:
    a, errors = 1.0e-4, []
    for count in (65, 129):
        x = _graded_nodes(a, count)
        ny = count
        dy = 3.0 * a / (ny - 1)
        y = (np.arange(ny) - 0.5 * (ny - 1)) * dy
        r2 = (x / a) ** 2 + (y[:, None] / a) ** 2
        pressure = np.sqrt(np.maximum(0.0, 1.0 - r2))
        solid = GradedConvolution(graded_coefficients(cell_faces(x), x, dy, ny, E))
        # Johnson 1985 eq. (3.41a): (pi p_0/(4 E* a)) (2 a^2 - r^2) within the contact
        exact = np.pi * a / (4.0 * E) * (2.0 - r2)
        inside = r2 < 0.8
        errors.append(np.abs(solid(pressure) - exact)[inside].max() / exact.max())
    # the edge, where pressure rises with a root, limits the order to 3/2
    assert errors[1] < 2e-3
    assert errors[1] < 0.5 * errors[0]


def test_a_long_strip_flattens_a_roller_on_a_graded_grid() -> None:
    a = 1.0e-4
    x = _graded_nodes(a, 129)
    ny, dy = 201, 4.0 * a
    pressure = np.repeat(np.sqrt(np.maximum(0.0, 1.0 - (x / a) ** 2))[None], ny, axis=0)
    solid = GradedConvolution(graded_coefficients(cell_faces(x), x, dy, ny, E))
    middle = solid(pressure)[ny // 2]
    # Johnson 1985 eq. (4.45): u(x) - u(0) = -x^2/(2 R), 1/R = 2 p_0/(E* a), whatever the length
    inside = np.abs(x) < 0.9 * a
    fall = np.interp(0.0, x, middle) - middle[inside]
    exact = x[inside] ** 2 / (E * a)
    # 1 % of the largest fall at some 55 cells over the contact
    assert np.abs(fall - exact).max() < 0.01 * exact.max()


def test_inputs_are_checked() -> None:
    nodes = np.array([0.0, 1.0, 3.0])
    with pytest.raises(ParameterError, match="faces must rise"):
        graded_coefficients(cell_faces(nodes)[::-1], nodes, 1.0, 2, E)
    solid = GradedConvolution(graded_coefficients(cell_faces(nodes), nodes, 1.0, 2, E))
    with pytest.raises(ParameterError, match="pressure must have shape"):
        solid(np.zeros((3, 3)))
    for at, spacing, match in (
        ((1.0, -1.0), (1.0, 2.0), "two rising positions"),
        ((1.0,), (1.0,), "two rising positions"),
        ((-1.0, 1.0), (1.0, 0.0), "spacing must be"),
        ((-1.0, 1.0), (1.0, 21.0), "largest over smallest"),
    ):
        with pytest.raises(ParameterError, match=match):
            Grading(at, spacing)


def test_a_grading_has_the_proportions_asked_for_on_nested_grids() -> None:
    grading = Grading((-3.0, -1.0, 1.0, 2.0), (6.0, 1.0, 1.0, 4.0))
    x = grading.nodes((-3.0, 2.0), 401)
    steps = np.diff(x)
    middle = 0.5 * (x[1:] + x[:-1])
    fine = steps[np.abs(middle) < 0.9].mean()
    # to the limits from half a step away, at a growth of 7 % a step
    assert 2.0 * steps[0] - 0.5 * (steps[0] + steps[1]) == pytest.approx(6.0 * fine, rel=0.02)
    assert 2.0 * steps[-1] - 0.5 * (steps[-1] + steps[-2]) == pytest.approx(4.0 * fine, rel=0.02)
    # every second node, but for rounding
    assert np.abs(grading.nodes((-3.0, 2.0), 201) - x[::2]).max() < 1e-12
    assert (np.abs(np.diff(steps)) < 0.08 * np.minimum(steps[1:], steps[:-1])).all()
