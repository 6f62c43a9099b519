"""Floquet multipliers of the helical pair where they are known, and where it is unstable."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from gearlube.studies.helical.stability import instability_map
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    LinearSystem,
    linear_system,
    natural_frequencies,
    system_moments,
)
from gearlube_core.dynamics.helical_pair.linear.period_march import march_period
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.periodic.floquet import floquet_multipliers
from tests.helpers.each import each
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_dynamics_cases import estimated_pair, spur_pair


def _state_matrix(system: LinearSystem, moments: np.ndarray) -> np.ndarray:
    n = len(system.names)
    K = system.K - system.W @ moments[:, :2] @ system.E
    C = np.diag(system.C)
    C[-1, -1] += system.damping * math.sqrt(moments[0, 0])
    return np.block([[np.zeros((n, n)), np.eye(n)], [-K, -C]])


def _only_rotation(system: LinearSystem) -> LinearSystem:
    """Return the relative rotation alone: all other motions held."""
    return system._replace(
        names=("psi",),
        K=system.K[-1:, -1:].copy(),
        C=system.C[-1:].copy(),
        E=system.E[:, -1:].copy(),
        W=system.W[-1:].copy(),
        f=system.f[-1:].copy(),
    )


def test_constant_mesh_gives_the_matrix_exponential() -> None:
    system = linear_system(he_2007_pair(0.1), variation=0.0)
    period = 2.4e-3
    march = march_period(system, period, 16, 80)
    exact = expm(period * _state_matrix(system, system.mean))
    # states scaled to one size; 80 Runge-Kutta steps an oscillation leave 1e-6
    n = len(system.names)
    scale = np.append(np.ones(n), np.full(n, 1.0 / natural_frequencies(system).max()))
    scale[[3, 4, 8, 9, n + 3, n + 4, n + 8, n + 9]] *= 0.04
    difference = scale[:, None] * (march.transition[-1] - exact) / scale
    assert np.abs(difference).max() < 1e-5
    multipliers = floquet_multipliers(march.transition[-1])
    assert abs(multipliers[0]) == pytest.approx(np.abs(np.linalg.eigvals(exact)).max(), rel=1e-6)


def test_constant_mesh_rests_at_its_static_deflection() -> None:
    system = linear_system(he_2007_pair(0.1), variation=0.0)
    n = len(system.names)
    march = march_period(system, 2.4e-3, 16, 40)
    start = np.linalg.solve(np.eye(2 * n) - march.transition[-1], march.forced[-1])
    stiffness = system.K - system.W @ system.mean[:, :2] @ system.E
    static = np.linalg.solve(stiffness, system.f)
    assert np.allclose(start[:n], static, rtol=1e-9, atol=1e-9 * np.abs(static).max())
    assert np.abs(start[n:]).max() < 1e-6 * np.abs(static).max() * 2.0 * math.pi * 416.0


@each("mesh_frequency", [2000.0, 7000.0, 14900.0])
def test_spur_rotation_alone_is_a_meissner_oscillator(mesh_frequency: float) -> None:
    """Two stiffnesses in turn: trace M = 2 ca cb - (w1/w2 + w2/w1) sa sb exactly."""
    parameters = replace(spur_pair(0.0), mesh_damping_ratio=0.0, support_damping_ratio=0.0)
    system = _only_rotation(linear_system(parameters))
    march = march_period(system, 1.0 / mesh_frequency, 16, 100)
    k_one = parameters.mesh.density.max() * parameters.pair.face_width
    w1, w2 = (math.sqrt(pairs * k_one / parameters.effective_mass) for pairs in (1, 2))
    double = parameters.pair.transverse_contact_ratio - 1.0
    a, b = w1 * (1.0 - double) / mesh_frequency, w2 * double / mesh_frequency
    trace = 2.0 * math.cos(a) * math.cos(b)
    trace -= (w1 / w2 + w2 / w1) * math.sin(a) * math.sin(b)
    # fourth-order steps, 100 and more an oscillation
    assert np.trace(march.transition[-1]) == pytest.approx(trace, abs=2e-5)
    assert np.linalg.det(march.transition[-1]) == pytest.approx(1.0, abs=2e-6)


def test_product_of_multipliers_is_the_damping_integrated_over_a_period() -> None:
    """Liouville: det M = exp(-integral of the damping constants over their masses)."""
    for parameters in (he_2007_pair(0.1), spur_pair(0.1)):
        system, period = linear_system(parameters), 1.2e-4
        march = march_period(system, period, 16, 40)
        phase = (np.arange(4000) + 0.5) / 4000
        roots = np.sqrt(system_moments(system, phase)[:, 0, 0])
        rate = system.C.sum() + system.damping * roots.mean()
        # midpoint rule over jumps of the spur pair
        assert np.log(np.linalg.det(march.transition[-1])) == pytest.approx(
            -rate * period, rel=2e-4
        )


def test_spur_rotation_is_unstable_around_twice_its_frequency_over_whole_numbers() -> None:
    """Lightly damped Hill equation: tongues at 2 f_n/k, nowhere else."""
    parameters = replace(spur_pair(0.0), mesh_damping_ratio=1e-3, support_damping_ratio=1e-3)
    system = _only_rotation(linear_system(parameters))
    f_n = natural_frequencies(system)[0] / (2.0 * math.pi)

    def unstable(frequency: float) -> bool:
        march = march_period(system, 1.0 / frequency, 16, 40)
        return bool(abs(floquet_multipliers(march.transition[-1])[0]) > 1.0)

    grid = f_n * np.linspace(0.6, 2.6, 401)
    grown = grid[[unstable(f) for f in grid]] / f_n
    assert unstable(2.0 * f_n)
    half_width = _first_harmonic(parameters) / 4.0
    first = grown[grown > 1.5]
    # second-order terms of a variation of 43 percent move the edges by some percent
    assert first.min() == pytest.approx(2.0 * (1.0 - half_width), abs=0.06)
    assert first.max() == pytest.approx(2.0 * (1.0 + half_width), abs=0.06)
    others = grown[grown < 1.5]
    assert others.size > 0
    # odd tongues are wide for a square wave, even ones narrow; edges at second order again
    assert np.abs(others[:, None] - 2.0 / np.arange(2, 4)).min(axis=1).max() < 0.06


def _first_harmonic(parameters: HelicalPairParameters) -> float:
    """Return the spur mesh's first harmonic over its mean: one and two pairs in turn."""
    double = parameters.pair.transverse_contact_ratio - 1.0
    return 2.0 / math.pi * math.sin(math.pi * double) / (1.0 + double)


def test_helical_pair_with_five_percent_damping_is_stable_everywhere() -> None:
    frequency = np.linspace(300.0, 30000.0, 40)
    for mu in (0.0, 0.3):
        result = instability_map(he_2007_pair(mu), frequency, "stiffness_variation", [1.0])
        assert not result.unstable.any()
        assert result.growth.max() < -500.0  # 1/s; the slowest mode alone: -0.05 x 2 pi x 3 kHz


def test_spur_pair_is_unstable_at_twice_its_mesh_mode_and_damping_closes_the_tongues() -> None:
    spur = replace(spur_pair(0.0), form="six_dof")
    frequency = np.linspace(4000.0, 16000.0, 61)
    result = instability_map(spur, frequency, "damping_ratio", [0.002, 0.05, 0.2])
    counts = result.unstable.sum(axis=1)
    assert counts[0] > counts[1] > counts[2] == 0
    mesh_mode = result.natural_frequencies[-1]
    nearest = int(np.argmin(np.abs(frequency - 2.0 * mesh_mode)))
    assert result.unstable[0, nearest]
    assert result.multiplier[0, nearest].real < -1.0  # grows at half the mesh frequency
    # [nayfeh_mook_1979 sec. 5.3, 6.2]: tongues grow from 2 f_i/k and (f_i + f_j)/k
    sums = np.add.outer(result.natural_frequencies, result.natural_frequencies).ravel()
    principal = np.concatenate([sums / k for k in range(1, 5)])
    away = np.abs(principal[:, None] / frequency[result.unstable[0]] - 1.0)
    # half-width of the widest tongue by first-order averaging, and a step of the grid
    assert away.min(axis=0).max() < _first_harmonic(spur) / 4.0 + 0.015


def test_map_of_a_constant_mesh_has_growth_and_frequencies_of_its_matrix() -> None:
    parameters = replace(he_2007_pair(0.0), form="six_dof")
    system = linear_system(parameters, variation=0.0)
    result = instability_map(parameters, [2300.0, 900.0], "stiffness_variation", [0.0])
    slowest = np.linalg.eigvals(_state_matrix(system, system.mean)).real.max()
    # 20 Runge-Kutta steps an oscillation of the fastest mode, more of the slowest
    assert result.growth == pytest.approx(np.full((1, 2), slowest), rel=1e-3)
    stiffness = system.K - system.W @ system.mean[:, :2] @ system.E
    hertz = np.sqrt(np.sort(np.linalg.eigvals(stiffness).real)) / (2.0 * math.pi)
    assert result.natural_frequencies == pytest.approx(hertz, rel=1e-9)
    assert np.array_equal(result.mesh_frequency, [2300.0, 900.0])


def test_axes_of_the_map_change_what_they_name() -> None:
    base, at = replace(spur_pair(0.1), form="six_dof"), [7000.0]
    as_it_is = ("stiffness_variation", [1.0])
    for axis, changes in (
        ("damping_ratio", {"support_damping_ratio": 0.03, "mesh_damping_ratio": 0.03}),
        ("mu", {"mu": 0.03}),
    ):
        found = instability_map(base, at, axis, [0.03, 0.2]).multiplier[0, 0]
        other = spur_pair(0.03) if axis == "mu" else replace(base, **changes)
        expected = instability_map(replace(other, form="six_dof"), at, *as_it_is).multiplier[0, 0]
        assert found == pytest.approx(expected, rel=1e-12)


def test_constant_stiffness_is_stable_at_every_frequency() -> None:
    spur = replace(spur_pair(0.0), support_damping_ratio=0.002, mesh_damping_ratio=0.002)
    frequency = np.linspace(4000.0, 16000.0, 25)
    result = instability_map(spur, frequency, "stiffness_variation", [0.0, 1.0])
    assert not result.unstable[0].any()
    assert result.unstable[1].any()


def test_printed_sign_of_the_mesh_deflection_makes_the_pair_unstable() -> None:
    """He et al. 2007 eq. (4) with (7): flanks attract each other."""
    printed = linear_system(replace(estimated_pair(0.0), mesh_sign="as_printed"), variation=0.0)
    values = np.linalg.eigvals(_state_matrix(printed, printed.mean))
    assert values.real.max() == pytest.approx(4.25e4, rel=0.01)  # 1/s, digest
    sound = linear_system(he_2007_pair(0.0), variation=0.0)
    assert np.linalg.eigvals(_state_matrix(sound, sound.mean)).real.max() < 0.0
