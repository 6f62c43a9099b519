"""Start and natural frequencies of the marching pair against SciPy's and NumPy's solvers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import root

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.pair import bearing_shares
from gearlube_core.dynamics.helical_pair.supports import support_damping
from gearlube_core.errors import ConvergenceError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.each import each
from tests.helpers.helical_march_cases import (
    OIL,
    SPEED,
    TORQUE,
    he_march,
    march_of,
    output,
    started,
)
from tests.helpers.pair_motions import PSI, U_P, V_P, W_G, W_P

PLACES = np.r_[PSI, U_P : U_P + 10]
ROWS = np.r_[W_P, V_P : V_P + 10]
HELD = {"six_dof": [2, 3, 4, 7, 8, 9]}  # of the ten displacements and tilts


def free(model: HelicalPairModel) -> np.ndarray:
    held = HELD.get(model.parameters.form, [])
    return np.delete(np.arange(11), 1 + np.array(held, dtype=int))


def scipy_equilibrium(model: HelicalPairModel) -> np.ndarray:
    """Displacements [m, rad] without acceleration after SciPy, from twice those of the model."""
    state = model.continuous
    places, rows = PLACES[free(model)], ROWS[free(model)]

    def accelerations(micro: np.ndarray) -> np.ndarray:
        at = state.copy()
        at[places] = 1e-6 * micro
        return model.derivative(at)[rows]

    found = root(accelerations, 2e6 * state[places], method="hybr", options={"xtol": 1e-14})
    return 1e-6 * found.x


CASES = [
    {"friction": "off"},
    {"friction_coefficient": 0.1, "form": "six_dof"},
    {"friction_coefficient": 0.1, "equations": "he_2007", "radial_stiffness": 2e8},
    {"friction_coefficient": 0.05, "line_mesh": "he_2007", "bearing_distance": 0.03},
]


def case(settings: dict[str, Any], torque: float, speed: float = SPEED) -> HelicalPairModel:
    if "line_mesh" in settings:
        settings = settings | {"line_mesh": named_line_mesh(settings["line_mesh"])}
    return started(he_march(**settings), torque=torque, speed=speed)


@each("torque", [TORQUE, -0.5 * TORQUE, 0.05])
@each("settings", CASES)
def test_the_start_is_the_equilibrium_that_scipy_finds(
    settings: dict[str, Any], torque: float
) -> None:
    model = case(settings, torque)
    places = PLACES[free(model)]
    expected = scipy_equilibrium(model)
    # SciPy stops where rounding of forces does; of the largest displacement
    apart = np.abs(model.continuous[places] - expected).max()
    assert apart < 1e-9 * np.abs(expected).max()


@each("size", [1e-8, 1e-6, 1e-4, 1e-2])
@each("sense", [1.0, -1.0])
def test_flanks_of_either_side_bear_a_small_torque_at_the_start(size: float, sense: float) -> None:
    """A share of the backlash is far more than such a torque presses the flanks together."""
    torque = size * sense
    model = started(he_march(friction="off"), torque=torque)
    # K = 5e8 N/m times the spacing of numbers at a place behind a backlash of 0.1 mm is 7e-12 N
    assert abs(model.output("mesh.load")) == pytest.approx(
        size / model.parameters.pair.pinion_base_radius / model.parameters.pair.plane.cos_b,
        rel=1e-2,
    )
    assert model.output("mesh.coast_contact") == (sense < 0.0)


def test_film_friction_at_the_start_belongs_to_its_loads() -> None:
    model = started(he_march(friction="film"))
    rates = model.derivative(model.continuous)
    # friction follows the loads of the fourth pass; what is left is far below the mesh's force
    pinion = model.parameters.pinion
    force = TORQUE / model.parameters.pair.pinion_base_radius
    assert np.abs(rates[V_P : V_P + 3] * pinion.mass).max() < 1e-8 * force
    assert abs(rates[W_P] * pinion.polar_inertia) < 1e-8 * TORQUE


def first_order_frequencies(model: HelicalPairModel) -> np.ndarray:
    """Natural frequencies [Hz] from NumPy's eigenvalues of the linear motion, rising."""
    state = model.continuous
    state[[W_P, W_G]] = 0.0
    n = free(model)[1:] - 1
    kept = np.r_[PSI, U_P + n, W_P, W_G, V_P + n]
    matrix = np.empty((kept.size, kept.size))
    for column, place in enumerate(kept):
        step = np.zeros(state.size)
        step[place] = 1e-8
        difference = model.derivative(state + step) - model.derivative(state - step)
        matrix[:, column] = difference[kept] / 2e-8
    values = np.linalg.eigvals(matrix)
    assert np.abs(values.real).max() < 1e-4 * np.abs(values.imag).max()
    return np.sort(values.imag[values.imag > 1.0]) / (2.0 * math.pi)


@pytest.mark.parametrize("settings", [*CASES[:1], {"friction": "off", "form": "six_dof"}, CASES[3]])
def test_natural_frequencies_are_those_of_the_undamped_motion(settings: dict[str, Any]) -> None:
    undamped = {"mesh_damping_ratio": 0.0, "support_damping_ratio": 0.0, "friction": "off"}
    model = case(settings | undamped, TORQUE, speed=0.0)
    found = model.natural_frequencies()
    assert found.size == free(model).size
    # both from differences over 1e-8 m of a motion without kinks
    np.testing.assert_allclose(found, first_order_frequencies(model), rtol=1e-6)
    # twice from differences of the same forces; eigenvalues and their modulus to round-off
    assert model.step_control.highest_frequency == pytest.approx(found[-1], rel=1e-10)


def test_equal_bearings_with_pairs_of_equal_frequencies_start() -> None:
    """Two double eigenvalues, on which an iteration for single ones may stall."""
    parameters = march_of(
        HelicalGearFile.named("jamali_2015_a"),
        friction="film",
        bearing_distance=0.010848298065511302,
        roughness_rms=7.312952775391591e-07,
        backlash=0.000781245390301689,
        mesh_damping_ratio=0.18361402656411152,
        support_damping_ratio=0.11008993593013348,
    )
    model = HelicalPairModel(parameters)
    model.initialise(
        pinion_speed=-385.40459816910476,
        pinion_torque=-33.98157276530504,
        wheel_torque=-33.98157276530504,
        oil_temperature=329.8954064557473,
    )
    found = model.natural_frequencies()
    np.testing.assert_allclose(found[[5, 8]], found[[6, 9]], rtol=1e-8)


def test_without_torque_the_drive_flanks_just_touch() -> None:
    """The lowest line of the shipped mesh lies below zero: there the tangent springs begin."""
    mesh = named_line_mesh("he_2007")
    model = started(he_march(line_mesh=mesh), torque=0.0)
    assert output(model, "mesh.load") == pytest.approx(0.0, abs=1e-9)  # N
    pair = model.parameters.pair
    touching = float(mesh.offset[0].min()) / math.cos(pair.base_helix_angle)
    assert output(model, "mesh.dte") == pytest.approx(touching, rel=1e-12)


def test_a_start_that_fails_leaves_the_model_as_it_was() -> None:
    soft = {"radial_stiffness": 1e4, "stiffness_density": 2e7}  # N/m, N/m2: metres of deflection
    model = started(he_march(friction="off", **soft), torque=1.0)
    before = model.get_state()
    with pytest.raises(ConvergenceError, match=r"no static equilibrium at .* 80000 N\.m"):
        model.initialise(
            pinion_speed=SPEED, pinion_torque=8e4, wheel_torque=8e4, oil_temperature=OIL
        )
    np.testing.assert_array_equal(model.get_state(), before)


def test_bearings_share_a_members_support_and_damping() -> None:
    parameters = he_march(support_damping_ratio=0.1)
    shares = bearing_shares(parameters).reshape(2, 2, 8).sum(axis=1)
    for body, both in zip((parameters.pinion, parameters.gear), shares, strict=True):
        total = body.support.first.K_xx + body.support.second.K_xx
        assert both[:5] == pytest.approx([total, 0.0, total, 0.0, total], abs=1e-6)
        damping = support_damping(body.support, body.mass, body.inertia, 0.1, False)
        np.testing.assert_allclose(both[5:], damping[:3], rtol=1e-14)
