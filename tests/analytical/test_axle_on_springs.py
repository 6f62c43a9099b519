"""The axle on a bearing type from outside the package: linear springs."""

from functools import cache

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle import OUTPUT_NAMES, mohammadpour_2015_axle
from tests.helpers.own_process import INTERPRETED, report_of
from tests.helpers.spring_bearing import STIFFNESS, TORQUE, along_axes, quantity

PARAMETERS = mohammadpour_2015_axle()
MESH = PARAMETERS.mesh
NORMAL = np.array([MESH.mean(key, TORQUE) for key in ("n_x", "n_y", "n_z")])
R_P = MESH.mean("R_p", TORQUE)


@cache
def interpreted():
    return report_of("spring_bearing", **INTERPRETED)


def test_shafts_move_along_the_mesh_normal_by_force_over_stiffness():
    """At rest m u'' = 0 = -n F - k u on the pinion, +n F - k u on the gear, with F = T/R_p."""
    moved = NORMAL * TORQUE / R_P / STIFFNESS
    outputs = interpreted()["at rest"]
    # the tolerance of the solver of the static equilibrium
    assert along_axes(outputs, "pinion.displacement") == pytest.approx(-moved, rel=1e-6)
    assert along_axes(outputs, "wheel.displacement") == pytest.approx(moved, rel=1e-6)


def test_modes_are_those_of_two_masses_on_springs_and_a_mesh_spring():
    """Across the normal each member swings alone; along it four coordinates share the mesh."""
    size = np.linalg.norm(NORMAL)
    arms = np.array([R_P, -R_P * MESH.ratio, size, -size])
    stiffness = MESH.mean("k_t", TORQUE) * np.outer(arms, arms)
    stiffness += np.diag([0.0, 0.0, STIFFNESS, STIFFNESS])
    masses = np.array([PARAMETERS.pinion_inertia, PARAMETERS.gear_inertia])
    masses = np.append(masses, [PARAMETERS.pinion_mass, PARAMETERS.gear_mass])
    shared = np.sort(np.linalg.eigvals(stiffness / masses[:, None]).real)[1:]
    alone = np.repeat(STIFFNESS / masses[2:], 2)
    expected = np.sqrt(np.sort(np.append(shared, alone))) / (2.0 * np.pi)
    # central differences over 1 nm of forces of 2 kN, rounded to 1e-16 of them
    assert interpreted()["frequencies"] == pytest.approx(expected.tolist(), rel=1e-6)


def test_each_bearing_carries_half_of_the_spring_force():
    outputs = interpreted()["moving"]
    for member, bearings in (("pinion", (1, 2)), ("wheel", (3, 4))):
        half = -0.5 * STIFFNESS * along_axes(outputs, f"{member}.displacement")
        assert np.all(half != 0.0)
        for number in bearings:
            # one product, in another order
            force = along_axes(outputs, f"bearing[{number}].force")
            assert force == pytest.approx(half, rel=1e-14)
            assert quantity(outputs, f"bearing[{number}].roller_load_max") == 0.0
    assert quantity(outputs, "bearing.power_loss") == 0.0


@pytest.mark.slow
def test_compiled_axle_on_springs_equals_the_interpreted_one(tmp_path):
    compiled = report_of("spring_bearing", NUMBA_CACHE_DIR=str(tmp_path))
    for state in ("at rest", "moving"):
        for name, one, two in zip(OUTPUT_NAMES, compiled[state], interpreted()[state], strict=True):
            # rounding of some 1e2 operations; forces and speeds are differences of larger terms
            assert one == pytest.approx(two, rel=1e-9, abs=1e-9), name
