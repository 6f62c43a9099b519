"""The axle with a law of friction and a film formula from outside the package."""

from functools import cache

import numpy as np
import pytest

from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, OUTPUT_NAMES, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshAtLoad, MeshLevels, blend_mesh
from gearlube_core.dynamics.packed_mesh import ENTRAIN, N_CHANNELS, R_E, pack_mesh
from gearlube_core.mesh_table.kernels import pair_channels
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.constant_friction import COEFFICIENTS, OIL, SPEED, TORQUE
from tests.helpers.own_process import INTERPRETED, report_of

FLANKS = (1, 2, 3)
LINE_LENGTH = 0.02  # m, of the law


@cache
def interpreted():
    return report_of("constant_friction", **INTERPRETED)


def value(outputs, name):
    return outputs[OUTPUT_INDEX[name]]


@pytest.mark.slow
@pytest.mark.parametrize("case", [0, 1])
def test_loaded_flanks_have_the_coefficient_and_the_oil_temperature(case):
    outputs = interpreted()[case]["moving"]
    loads = [value(outputs, f"flank[{i}].load") for i in FLANKS]
    assert sum(loads) == pytest.approx(abs(value(outputs, "mesh.force")), rel=1e-9)
    for i, load in zip(FLANKS, loads, strict=True):
        mu = COEFFICIENTS[case] if load > 0.0 else 0.0
        assert value(outputs, f"flank[{i}].friction_coefficient") == mu
        assert value(outputs, f"flank[{i}].temperature") == OIL


@pytest.mark.slow
def test_lost_power_goes_with_the_coefficient_in_one_state():
    """P = sum mu F |dU|: the state at rest is found without friction."""
    one, two = (case["at rest"] for case in interpreted())
    ratio = value(two, "friction.power_loss") / value(one, "friction.power_loss")
    assert ratio == pytest.approx(COEFFICIENTS[1] / COEFFICIENTS[0], rel=1e-12)
    assert value(one, "friction.power_loss") > 0.0
    assert value(one, "friction.power_loss_boundary") == 0.0


def test_film_follows_the_formula_from_outside():
    """Martin: h = 4.9 eta u R/w, at the angle 0 of the start."""
    outputs = interpreted()[0]["at rest"]
    parameters = mohammadpour_2015_axle()
    modulus = contact_modulus(parameters.solid, parameters.solid)
    mesh = pack_mesh(parameters.mesh, modulus, parameters.radii, parameters.mesh_stiffness)
    table = MeshLevels(mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
    window, channels = np.zeros(mesh.window_size), np.zeros(N_CHANNELS)
    at_load = MeshAtLoad(np.zeros(mesh.series_size), mesh.orders, window, mesh.nodes)
    blend_mesh(TORQUE, 1.0, table, at_load)
    eta0 = lubricant_state(parameters.oil.parameters(), OIL).eta0
    teeth = float(parameters.mesh.pinion_teeth)
    loads = np.array([value(outputs, f"flank[{i}].load") for i in FLANKS])
    assert np.count_nonzero(loads) >= 2
    for pair in np.flatnonzero(loads):
        pair_channels(window, mesh.nodes, teeth, 0.0, int(pair), N_CHANNELS, channels)
        speed = abs(channels[ENTRAIN]) * SPEED
        film = 4.9 * eta0 * speed * channels[R_E] * LINE_LENGTH / loads[pair]
        # powers against products: rounding
        assert value(outputs, f"flank[{pair + 1}].film_thickness") == pytest.approx(film, rel=1e-12)


@pytest.mark.slow
def test_compiled_axle_equals_the_interpreted_one(tmp_path):
    compiled = report_of("constant_friction", NUMBA_CACHE_DIR=str(tmp_path))
    for one, two in zip(compiled, interpreted(), strict=True):
        for name, a, b in zip(OUTPUT_NAMES, one["moving"], two["moving"], strict=True):
            # rounding of some 1e2 operations; forces and speeds are differences of larger terms
            assert a == pytest.approx(b, rel=1e-9, abs=1e-9), name


@pytest.mark.slow
def test_one_file_makes_the_law_known_to_axle_file_error_bars_and_fmu():
    found = report_of("constant_friction", "report_names", **INTERPRETED)
    assert "got 'coulomb'" in found["before"]  # neither imported nor installed
    assert "consistent or as_printed or off" in found["before"]
    assert "The numbers of the friction law coulomb are mu; got 'nu'" in found["wrong name"]
    assert "mu must be within 0 to 0.5, got 0.8" in found["wrong value"]
    assert found["note"] == ["model.friction_numbers.mu", 0.04, "1", "assumed", "a guess"]
    assert found["upper"] == pytest.approx(1.3 * 0.08)  # two standard deviations are the factor
    assert found["range"] == [1e-9, 1e-3]
    assert found["literals"] == ["coulomb"]
    assert found["by number"] == 1  # as many as there are literals
    assert found["read again"]  # the new class counts
    assert found["code"]  # the GUID changes with the file of the law
    assert found["mu"] == [0.08, 0.0, 0.5, "1", "Coefficient of the flank friction"]
    assert found["references"] == -1  # behind all variables of other FMUs


@pytest.mark.slow
def test_a_native_fmu_has_the_law_of_its_axle_file(tmp_path):
    found = report_of("constant_friction", "report_native", NUMBA_CACHE_DIR=str(tmp_path))
    coefficients = []
    for native, python in found:
        # other instructions in object code: rounding of some 1e2 operations, as above
        np.testing.assert_allclose(native, python, rtol=1e-9, atol=1e-9)
        coefficients.append(max(value(native, f"flank[{i}].friction_coefficient") for i in FLANKS))
    assert coefficients == [0.08, 0.05]
