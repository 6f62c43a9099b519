"""Unilateral contact: bad input, settings, starts, masks, and kernels compiled and in Python."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from gearlube_core.contact import unilateral_kernels as kernels
from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.unilateral import _winkler_forces, solve_rotation, solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem, tangent_stiffness
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.tooth_contact.coupled_strips import StripCompliance
from tests.helpers.each import each

E_STAR, DX, DY, NX, NY, ARM = 115.4e9, 3e-5, 5e-4, 24, 30, 0.022


def crowned_strip(**changes: Any) -> UnilateralProblem:
    """Return one strip with 20 mm radius across and 1.5 m along."""
    x, y = (np.arange(NX) - 11.5) * DX, (np.arange(NY) - 14.5) * DY
    gap = x[:, None] ** 2 / 0.04 + y**2 / 3.0
    fields: dict[str, Any] = {
        "compliance": StripCompliance(
            [HalfSpaceConvolution(love_coefficients(DX, DY, NX, NY, E_STAR))]
        ),
        "gap": gap.ravel(),
        "arm": np.full(NX * NY, ARM),
        "cell_area": np.full(NX * NY, DX * DY),
    }
    return UnilateralProblem(**{**fields, **changes})


def one_entry(values: np.ndarray, cell: int, entry: float) -> np.ndarray:
    changed = values.copy()
    changed[cell] = entry
    return changed


@each(
    ("field", "change", "message"),
    [
        ("gap", lambda v: one_entry(v, 7, math.nan), "NaN or -inf in 1 cells, first in cell 7"),
        ("gap", lambda v: one_entry(v, 7, -math.inf), "gap must be finite or inf"),
        ("gap", lambda v: np.full(v.size, math.inf), "720 masked cells: nothing can touch"),
        ("arm", lambda v: one_entry(v, 3, 0.0), "arm must be above 0 m .* got 0 in cell 3"),
        ("arm", lambda v: one_entry(v, 3, math.nan), "arm must be above 0 m"),
        ("arm", lambda v: v[:-1], "arm must be flat with one entry a cell"),
        ("cell_area", lambda v: -v, "cell_area must be above 0 m2"),
    ],
)
def test_a_bad_field_is_named(
    field: str, change: Callable[[np.ndarray], np.ndarray], message: str
) -> None:
    problem = crowned_strip()
    with pytest.raises(ParameterError, match=message):
        replace(problem, **{field: change(getattr(problem, field))})


@pytest.mark.parametrize("torque", [0.0, -5.0, math.nan, math.inf])
def test_torque_must_close_the_contact(torque: float) -> None:
    with pytest.raises(ParameterError, match="torque must be"):
        solve_torque(crowned_strip(), torque)


def test_settings_are_checked() -> None:
    problem = crowned_strip()
    with pytest.raises(ParameterError, match="tolerance must be within"):
        solve_torque(problem, 5.0, tolerance=0.5)
    with pytest.raises(ParameterError, match="max_iterations must be within"):
        solve_torque(problem, 5.0, max_iterations=0)
    with pytest.raises(ParameterError, match="start must hold one finite force a cell"):
        solve_torque(problem, 5.0, start=np.ones(4))
    with pytest.raises(ParameterError, match="start must hold one finite force a cell"):
        solve_torque(problem, 5.0, start=np.full(NX * NY, math.nan))
    with pytest.raises(ParameterError, match="rotation must be finite"):
        solve_rotation(problem, math.nan)


def test_compliance_that_is_not_one_is_named() -> None:
    with pytest.raises(ParameterError, match="compliance must be positive definite"):
        solve_torque(crowned_strip(compliance=lambda forces: -forces), 5.0)
    with pytest.raises(ParameterError, match="compliance must return a finite displacement"):
        solve_torque(crowned_strip(compliance=lambda forces: forces * math.nan), 5.0)
    with pytest.raises(ParameterError, match="compliance must return a finite displacement"):
        solve_torque(crowned_strip(compliance=lambda forces: forces[1:]), 5.0)


def test_iteration_limit_raises_or_reports() -> None:
    problem = crowned_strip()
    with pytest.raises(ConvergenceError, match=r"got .* after 3 iterations. Raise max_iterations"):
        solve_torque(problem, 5.0, max_iterations=3)
    solution = solve_torque(problem, 5.0, max_iterations=3, throw=False)
    assert solution.outcome.status == "iteration limit"
    assert not solution.outcome.converged
    assert solution.outcome.iterations == 3
    assert len(solution.outcome.history) == 4
    assert solution.outcome.residual == solution.outcome.history[-1] > 1e-6
    # even then the torque balances
    assert solution.torque == pytest.approx(5.0, rel=1e-12)


@pytest.mark.parametrize("torque", [0.4, 3.0, 40.0])
def test_a_torque_starts_from_springs_on_their_own(torque: float) -> None:
    """Forces max(R delta - g, 0)/softness at the rotation that SciPy finds for the torque."""
    softness, masked = 2e-8, 4
    arm = np.array([0.02, 0.03, 0.025, 0.022, 0.05, 0.028])
    gap = np.array([3e-6, 1e-6, 2e-6, 9e-6, math.inf, -1e-6])
    problem = UnilateralProblem(
        compliance=lambda forces: softness * forces, gap=gap, arm=arm, cell_area=np.ones(6)
    )

    def forces(rotation: float) -> np.ndarray:
        return np.maximum(arm * rotation - gap, 0.0) / softness

    rotation = brentq(lambda delta: arm @ forces(delta) - torque, -1e-3, 1.0, xtol=1e-16)
    found = _winkler_forces(problem, torque, softness)
    assert found == pytest.approx(forces(rotation), rel=1e-9, abs=1e-9)
    assert found[masked] == 0.0
    # such springs are solved by their start
    assert solve_torque(problem, torque).outcome.iterations == 0


def test_operations_count_calls_of_the_compliance() -> None:
    calls = 0
    strip = crowned_strip().compliance

    def counted(forces: np.ndarray) -> np.ndarray:
        nonlocal calls
        calls += 1
        return strip(forces)

    problem = crowned_strip(compliance=counted)
    solution = solve_torque(problem, 5.0)
    assert solution.outcome.operations == calls
    calls = 0
    warm = solve_torque(problem, 5.5, start=solution.forces)
    assert warm.outcome.operations == calls
    calls = 0
    turned = solve_rotation(problem, warm.rotation, start=solution.forces)
    assert turned.outcome.operations == calls


@each("start", ["other torque", "uniform", "random", "one cell", "zero"])
def test_answer_does_not_depend_on_the_start(start: str) -> None:
    problem = crowned_strip()
    cold = solve_torque(problem, 20.0, tolerance=1e-8)
    vectors = {
        "other torque": solve_torque(problem, 15.0).forces,
        "uniform": np.ones(NX * NY),
        "random": np.random.default_rng(5).standard_normal(NX * NY),
        "one cell": one_entry(np.zeros(NX * NY), 12, 1.0),
        "zero": np.zeros(NX * NY),
    }
    warm = solve_torque(problem, 20.0, tolerance=1e-8, start=vectors[start])
    assert warm.rotation / cold.rotation == pytest.approx(1.0, rel=1e-7)
    assert warm.strain_energy / cold.strain_energy == pytest.approx(1.0, rel=1e-7)
    np.testing.assert_allclose(warm.forces, cold.forces, atol=1e-5 * cold.forces.max(), rtol=0)


def test_a_solution_is_its_own_start() -> None:
    problem = crowned_strip()
    solution = solve_torque(problem, 20.0)
    again = solve_torque(problem, 20.0, start=solution.forces)
    # an error is judged by the last four steps
    assert again.outcome.iterations == 4
    # both are within the tolerance of 1e-6 of the mean, so their largest entries within 1e-5
    np.testing.assert_allclose(again.forces, solution.forces, atol=1e-5 * solution.forces.mean())


def test_equal_input_gives_equal_bits() -> None:
    first, second = solve_torque(crowned_strip(), 20.0), solve_torque(crowned_strip(), 20.0)
    np.testing.assert_array_equal(first.forces, second.forces)


def test_masked_cells_stay_empty_and_need_no_data() -> None:
    whole = crowned_strip()
    mask = np.zeros((NX, NY), dtype=bool)
    mask[:, :12] = True  # the tooth ends inside the contact
    gap = np.where(mask.ravel(), math.inf, whole.gap)
    arm = np.where(mask.ravel(), math.nan, whole.arm)
    solution = solve_torque(replace(whole, gap=gap, arm=arm), 20.0)
    assert not solution.touching.reshape(NX, NY)[mask].any()
    assert np.isinf(solution.separation[mask.ravel()]).all()
    assert solution.forces.sum() == pytest.approx(20.0 / ARM, rel=1e-12)
    # an end inside the contact raises the pressure there above that of the uncut strip
    assert solution.pressure.max() > 1.1 * solve_torque(whole, 20.0).pressure.max()


def test_a_single_cell_is_a_spring() -> None:
    stiffness = 3e8
    problem = UnilateralProblem(
        compliance=lambda forces: forces / stiffness,
        gap=np.array([2e-6]),
        arm=np.array([ARM]),
        cell_area=np.array([1e-7]),
    )
    solution = solve_torque(problem, 11.0)
    force = 11.0 / ARM
    assert solution.rotation * ARM / (2e-6 + force / stiffness) == pytest.approx(1.0, rel=1e-12)
    assert solution.pressure[0] == pytest.approx(force / 1e-7, rel=1e-12)
    energy = 0.5 * force**2 / stiffness
    assert solution.strain_energy / energy == pytest.approx(1.0, rel=1e-12)
    assert tangent_stiffness(problem, solution) == pytest.approx(stiffness * ARM**2, rel=1e-12)


def test_a_rotation_that_closes_no_gap_loads_nothing() -> None:
    problem = crowned_strip()
    solution = solve_rotation(problem, -1e-6)
    assert solution.outcome.converged
    assert solution.torque == 0.0
    assert not solution.touching.any()
    np.testing.assert_allclose(solution.separation, problem.gap + 1e-6 * ARM, rtol=1e-12)
    with pytest.raises(ParameterError, match="must have loaded cells"):
        tangent_stiffness(problem, solution)


def test_tangent_stiffness_reports_its_iteration_limit() -> None:
    problem = crowned_strip()
    solution = solve_torque(problem, 20.0)
    with pytest.raises(ConvergenceError, match="tangent stiffness must reach"):
        tangent_stiffness(problem, solution, tolerance=1e-10, max_iterations=2)


def kernel_arguments(name: str) -> tuple[Any, ...]:
    random = np.random.default_rng(2)
    forces = np.maximum(random.standard_normal(9), 0.0)
    residual, direction, probe, product, displacement, gap = random.standard_normal((6, 9))
    arm = 1.0 + random.random(9)
    return {
        "update_separation": (forces, displacement, gap, arm, math.nan, residual),
        "conjugate_direction": (forces, residual, arm, 0.4, True, direction, probe),
        "direction_with_penetration": (forces, residual, arm, True, direction, probe),
        "step_length": (residual, direction, probe, product),
        "longest_step": (forces, probe),
        "project": (forces, probe, arm, 0.7, 2.5),
    }[name]


@each(
    "name",
    [
        "update_separation",
        "conjugate_direction",
        "direction_with_penetration",
        "step_length",
        "longest_step",
        "project",
    ],
)
def test_unilateral_kernels_run_the_same_compiled_and_in_python(name: str) -> None:
    function = getattr(kernels, name)
    compiled, plain = kernel_arguments(name), kernel_arguments(name)
    answer, expected = function(*compiled), function.py_func(*plain)
    if expected is not None:
        np.testing.assert_allclose(answer, expected, rtol=1e-14)
    for got, wanted in zip(compiled, plain, strict=True):
        np.testing.assert_allclose(got, wanted, rtol=1e-14)
