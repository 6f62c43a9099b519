"""The axle on a bearing type from outside the package: linear springs."""

from functools import cache

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle import OUTPUT_NAMES, mohammadpour_2015_axle
from tests.helpers.axle_on_springs import DRAGS, SPEED, STIFFNESS, TORQUE, along_axes, quantity
from tests.helpers.own_process import INTERPRETED, report_of

PARAMETERS = mohammadpour_2015_axle()
MESH = PARAMETERS.mesh
NORMAL = np.array([MESH.mean(key, TORQUE) for key in ("n_x", "n_y", "n_z")])
R_P = MESH.mean("R_p", TORQUE)


@cache
def interpreted():
    return report_of("axle_on_springs", **INTERPRETED)


@pytest.mark.slow
def test_shafts_move_along_the_mesh_normal_by_force_over_stiffness():
    """At rest m u'' = 0 = -n F - k u on the pinion, +n F - k u on the gear, with F = T/R_p."""
    moved = NORMAL * TORQUE / R_P / STIFFNESS
    outputs = interpreted()["at rest"]
    # the tolerance of the solver of the static equilibrium
    assert along_axes(outputs, "pinion.displacement") == pytest.approx(-moved, rel=1e-6)
    assert along_axes(outputs, "wheel.displacement") == pytest.approx(moved, rel=1e-6)


@pytest.mark.slow
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


def test_viscous_drag_takes_its_power_by_every_law_of_drag():
    """P = c_p w_p^2 + c_g w_g^2, with the gear's speed by the ratio of the teeth at rest."""
    _, of_pinion, of_gear = DRAGS
    for outputs in interpreted()["with drag"]:
        speeds = [quantity(outputs, f"{member}.speed") for member in ("pinion", "wheel")]
        assert speeds[0] == pytest.approx(SPEED)
        expected = of_pinion * speeds[0] ** 2 + of_gear * speeds[1] ** 2
        assert quantity(outputs, "bearing.power_loss") == pytest.approx(expected, rel=1e-12)


@pytest.mark.slow
def test_one_file_makes_the_type_known_to_axle_file_error_bars_and_fmu():
    found = report_of("axle_on_springs", "report_names", **INTERPRETED)
    assert "pinion.bearing.type must be a text, tapered_roller, got 'springs'" in found["before"]
    expected = (
        "pinion.bearing: stifness_n_per_um is not a number of springs; is it stiffness_n_per_um?",
        "pinion.bearing: stiffness_n_per_um must be within 1 to 10000 N/um, got 0.3 N/um.",
        "pinion.bearing: drag is not a number of springs; is it drag_n_m_s_per_rad?",
        "pinion.bearing: preload_n is not a number of springs; is it one of stiffness_n_per_um, ",
        "gear_bearing must be a Springs as bearing is, got a TaperedRollerBearing.",
        "model.bearing_approach is only for bearings of the type tapered_roller, got 'full'",
    )
    for refusal, words in zip(found["refusals"], expected, strict=True):
        assert words in refusal
    assert "bearing.preload must stay 0.0, got 2500.0: bearings of the type" in found["left alone"]
    assert found["notes"] == [
        ["gear.bearing.type", "springs", "", "given", ""],
        ["gear.bearing.stiffness_n_per_um", 300.0, "N/um", "assumed", "a guess"],
        ["gear.bearing.drag_n_m_s_per_rad", DRAGS[2], "N.m.s/rad", "given", ""],
    ]
    assert found["varied"] == 2.5e8
    assert found["upper"] == pytest.approx([1.2 * 2e8, 1.2 * 3e8])  # both shafts, by the factor
    assert not found["preload"]  # it has none, so that it is not uncertain
    assert found["code"]  # the GUID changes with the file of the type
    assert found["same references"]
    words = "Stiffness k of both bearings", "Viscous drag c of both bearings"
    assert found["own"] == [
        [f"{m}.bearing.{name}", start, low, high, unit, f"{text}, bearings of the {role} shaft"]
        for m, role, stiffness, drag in (
            ("pinion", "pinion", 2e8, DRAGS[1]),
            ("wheel", "gear", 3e8, DRAGS[2]),
        )
        for name, start, low, high, unit, text in (
            ("stiffness", stiffness, 1e6, 1e10, "N/m", words[0]),
            ("drag", drag, 0.0, 1.0, "N.m.s/rad", words[1]),
        )
    ]
    fixed = {name: values for name, *values in found["fixed"]}
    assert fixed["bearing.preload"] == [0.0, 0.0, 0.0]
    assert fixed["wheel.bearing.preload"] == [-1.0, -1.0, -1.0]
    assert len(fixed) == 8  # contact angle, f0 and f1 of either shaft besides


@pytest.mark.slow
def test_a_native_fmu_has_the_bearings_of_its_axle_file(tmp_path):
    found = report_of("axle_on_springs", "report_native", NUMBA_CACHE_DIR=str(tmp_path))
    for native, python in found:
        # other instructions in object code: rounding of some 1e2 operations, as below
        np.testing.assert_allclose(native, python, rtol=1e-9, atol=1e-9)
    changed = [
        [quantity(native, f"bearing[{i}].force.z") for i in (1, 3)]
        + [quantity(native, "bearing.power_loss")]
        for native, _ in found
    ]
    assert np.all(np.array(changed[0]) != np.array(changed[1]))


@pytest.mark.slow
def test_compiled_axle_on_springs_equals_the_interpreted_one(tmp_path):
    compiled = report_of("axle_on_springs", NUMBA_CACHE_DIR=str(tmp_path))
    for state in ("at rest", "moving"):
        for name, one, two in zip(OUTPUT_NAMES, compiled[state], interpreted()[state], strict=True):
            # rounding of some 1e2 operations; forces and speeds are differences of larger terms
            assert one == pytest.approx(two, rel=1e-9, abs=1e-9), name
