"""Several strips about one rotation: load sharing, energy, tangent stiffness."""

import numpy as np
import pytest

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.unilateral import solve_rotation, solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem, tangent_stiffness
from gearlube_core.tooth_contact.coupled_strips import StripCompliance
from tests.helpers.each import each

E_STAR, DX, DY, NX, NY = 115.4e9, 3e-5, 5e-4, 40, 48
CELLS = NX * NY
X, Y = (np.arange(NX) - 0.5 * (NX - 1)) * DX, (np.arange(NY) - 0.5 * (NY - 1)) * DY
STRIP = HalfSpaceConvolution(love_coefficients(DX, DY, NX, NY, E_STAR))


def hats_along_a_strip(n_hats: int) -> tuple[np.ndarray, np.ndarray]:
    """Return nodes along y and hat functions there, constant across."""
    nodes = np.linspace(Y[0], Y[-1], n_hats)
    hats = np.maximum(0.0, 1.0 - np.abs(Y[:, None] - nodes) / (nodes[1] - nodes[0]))
    return nodes, np.tile(hats, (NX, 1))


def teeth(offsets: list[float], arms: list[float], bending: float = 7e-9) -> UnilateralProblem:
    """Return crowned strips with bending compliance [m/N], shifted apart by offsets [m].

    The local compliance of such a strip under 2 kN is about 6e-9 m/N.
    """
    n = len(offsets)
    nodes, hats = hats_along_a_strip(10)
    shapes = np.kron(np.eye(n), hats)
    influence = bending * np.exp(-np.abs(nodes[:, None] - nodes) / 4e-3)
    # neighbouring teeth share a root: a fifth of the bending couples them
    compliance = np.kron(0.8 * np.eye(n) + 0.2 * np.ones((n, n)), influence)
    crown = (X[:, None] ** 2 / 0.04 + Y**2 / 3.0).ravel()
    return UnilateralProblem(
        compliance=StripCompliance([STRIP] * n, shapes, compliance),
        gap=np.concatenate([crown + offset for offset in offsets]),
        arm=np.repeat(arms, CELLS) * np.tile(1.0 + 0.01 * np.tile(Y / Y[-1], NX), n),
        cell_area=np.full(n * CELLS, DX * DY),
    )


def moments(problem: UnilateralProblem, forces: np.ndarray) -> np.ndarray:
    return (problem.arm * forces).reshape(-1, CELLS).sum(axis=1)


def test_identical_strips_share_the_torque_equally() -> None:
    problem = teeth([0.0, 0.0], [0.022, 0.022])
    solution = solve_torque(problem, 90.0, tolerance=1e-10)
    first, second = solution.forces.reshape(2, -1)
    # rounding tells the strips apart, the iteration spreads it up to its tolerance on gaps
    np.testing.assert_allclose(first, second, atol=1e-6 * first.max(), rtol=0)
    np.testing.assert_allclose(moments(problem, solution.forces), 45.0, rtol=1e-9)


def test_offset_of_two_springs_shifts_their_shares() -> None:
    """Blocks of equal cells on a stiff half-space and soft springs act as two springs."""
    k_1, k_2, arm_1, arm_2, offset = 2.0e8, 3.0e8, 0.022, 0.024, 4e-6
    stiff = HalfSpaceConvolution(love_coefficients(DX, DY, 3, 4, 1e6 * E_STAR))
    shapes = np.kron(np.eye(2), np.ones((12, 1)))
    problem = UnilateralProblem(
        compliance=StripCompliance([stiff, stiff], shapes, np.diag([1.0 / k_1, 1.0 / k_2])),
        gap=np.repeat([0.0, offset], 12),
        arm=np.repeat([arm_1, arm_2], 12),
        cell_area=np.full(24, DX * DY),
    )
    torque = 60.0
    # T = k_1 R_1^2 delta + k_2 R_2 (R_2 delta - offset)
    delta = (torque + k_2 * arm_2 * offset) / (k_1 * arm_1**2 + k_2 * arm_2**2)
    solution = solve_torque(problem, torque)
    # what the blocks add: their compliance is about 1e-6 of the springs'
    assert solution.rotation == pytest.approx(delta, rel=1e-5)
    assert solution.forces[:12].sum() == pytest.approx(k_1 * arm_1 * delta, rel=1e-5)
    assert solution.forces[12:].sum() == pytest.approx(k_2 * (arm_2 * delta - offset), rel=1e-5)
    tangent = k_1 * arm_1**2 + k_2 * arm_2**2
    assert tangent_stiffness(problem, solution) == pytest.approx(tangent, rel=1e-4)
    # below the torque that closes the offset the first carries alone
    alone = solve_torque(problem, 0.9 * k_1 * arm_1**2 * offset / arm_2)
    assert not alone.touching[12:].any()


def test_strip_that_lags_takes_less() -> None:
    problem = teeth([0.0, 6e-6], [0.022, 0.022])
    shares = [moments(problem, solve_torque(problem, T).forces)[1] / T for T in (5.0, 30.0, 200.0)]
    assert shares[0] == 0.0
    assert 0.0 < shares[1] < shares[2] < 0.5


@pytest.mark.slow
def test_work_of_the_torque_becomes_strain_energy() -> None:
    """dU = T d delta: closed gaps stay closed and open ones carry no force."""
    problem = teeth([3e-6, 0.0, 5e-6], [0.022, 0.0222, 0.0224])
    torques = np.linspace(30.0, 150.0, 21)
    states = [solve_torque(problem, float(T), tolerance=1e-8) for T in torques]
    rotation = np.array([state.rotation for state in states])
    work = float(np.sum(0.5 * (torques[1:] + torques[:-1]) * np.diff(rotation)))
    stored = states[-1].strain_energy - states[0].strain_energy
    # trapezium rule on 20 intervals of up to a fifth of the torque, on a slightly curved T(delta)
    assert stored == pytest.approx(work, rel=4e-4)
    # the other half of T delta is lost to the gaps, so the check is not trivially met
    assert states[-1].strain_energy < 0.49 * torques[-1] * rotation[-1]


@each("torque", [10.0, 60.0, 200.0])
def test_tangent_stiffness_is_the_slope_of_the_torque(torque: float) -> None:
    problem = teeth([3e-6, 0.0, 5e-6], [0.022, 0.0222, 0.0224])
    state = solve_torque(problem, torque, tolerance=1e-9)
    tangent = tangent_stiffness(problem, state, tolerance=1e-6)
    # small enough a step that hardly a cell changes
    step = 1e-4 * torque
    rotations = [
        solve_torque(problem, T, tolerance=1e-10, start=state.forces).rotation
        for T in (torque - step, torque + step)
    ]
    # a cell that enters adds stiffness in a step: one of hundreds, each worth below 1e-3
    assert tangent == pytest.approx(2.0 * step / (rotations[1] - rotations[0]), rel=2e-3)


def test_tangent_stiffness_is_exact_while_the_cells_hold() -> None:
    """Without gaps T is proportional to delta whatever the cells that touch."""
    problem = teeth([0.0, 0.0], [0.022, 0.0222])
    flat = UnilateralProblem(
        compliance=problem.compliance,
        gap=0.0 * problem.gap,
        arm=problem.arm,
        cell_area=problem.cell_area,
    )
    low, high = (solve_torque(flat, T, tolerance=1e-9) for T in (400.0, 500.0))
    np.testing.assert_array_equal(low.touching, high.touching)
    slope = 100.0 / (high.rotation - low.rotation)
    assert tangent_stiffness(flat, low, tolerance=1e-8) == pytest.approx(slope, rel=1e-7)


@each("torque", [2.0, 30.0, 400.0])
def test_given_rotation_returns_the_torque(torque: float) -> None:
    problem = teeth([3e-6, 0.0, 5e-6], [0.022, 0.0222, 0.0224])
    balanced = solve_torque(problem, torque, tolerance=1e-8)
    turned = solve_rotation(problem, balanced.rotation, tolerance=1e-8)
    # both within 1e-8 of complementarity, times the stiffness tangent/secant of about two
    assert turned.torque == pytest.approx(torque, rel=1e-6)
    np.testing.assert_allclose(
        turned.forces, balanced.forces, atol=1e-4 * balanced.forces.max(), rtol=0
    )


@pytest.mark.slow
def test_stiff_bending_does_not_spoil_convergence() -> None:
    """Polonsky and Keer's step for penetrating cells diverges here at given rotation."""
    problem = teeth([3e-6, 0.0, 5e-6], [0.022, 0.0222, 0.0224], bending=1e-7)
    solution = solve_torque(problem, 150.0)
    turned = solve_rotation(problem, solution.rotation)
    assert solution.outcome.iterations < 300
    assert turned.torque == pytest.approx(150.0, rel=1e-4)
