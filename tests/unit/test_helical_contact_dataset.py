"""The dataset of a helical loaded contact against a made-up mesh cycle, by hand."""

import math

import numpy as np
import pytest

from gearlube.studies.helical.stages import _constant_density_stiffness
from gearlube_core.helical_contact.contact_dataset import contact_dataset
from gearlube_core.helical_contact.mesh_cycle import CycleSettings
from tests.helpers.helical_contact_cases import HE_2007, relieved
from tests.helpers.known_answers import assert_variables, named, units_of

EXTENT = 0.5e-3  # m of radius, relieved at both tips
MODIFIED = relieved(HE_2007, 1e-5, EXTENT)
TORQUES = np.array([50.0, 200.0])
SETTINGS = CycleSettings(torques=tuple(TORQUES), positions=5, stations=3)
LINES = np.arange(-1, 4)  # three lines at once, and one before and after them
R_BP, HALF = HE_2007.pinion_base_radius, 0.5 * HE_2007.face_width
TAN_B, COS_B = math.tan(HE_2007.base_helix_angle), math.cos(HE_2007.base_helix_angle)


def roll_length(gear, tip_radius, base_radius):
    """Distance along the line of action from the tangent point to a radius below the tip."""
    return math.sqrt((tip_radius - gear * EXTENT) ** 2 - base_radius**2)


def z_range(phase, line, relief):
    """Ends of a line between the reliefs (relief = 1) or the tips (0); equal outside."""
    X = HE_2007.contact_start + (phase + line) * HE_2007.base_pitch
    start = HE_2007.tangent_length - roll_length(
        relief, HE_2007.gear_tip_radius, HE_2007.gear_base_radius
    )
    end = roll_length(relief, HE_2007.pinion_tip_radius, R_BP)
    low = max(-HALF, HALF - (X - start) / TAN_B)
    high = min(HALF, HALF - (X - end) / TAN_B)
    return (low, high) if high > low else (low, low)


def made_up_cycle():
    rng = np.random.default_rng(2)
    states = (5, TORQUES.size)
    line = (*states, LINES.size)
    line_torque = rng.random(line)
    line_torque *= TORQUES[:, None] / line_torque.sum(axis=-1, keepdims=True)
    z_low = rng.uniform(-1.1 * HALF, 0.0, line)  # also beyond the plane of contact
    z_high = z_low + rng.uniform(0.0, HALF, line)
    z_low[2, 0, 1] = z_high[2, 0, 1] = np.nan  # a line without load
    return {
        "rotation": rng.uniform(1e-4, 2e-4, states),
        "unloaded_rotation": np.repeat(rng.uniform(0.0, 1e-5, (5, 1)), 2, axis=1),
        "gear_torque": rng.uniform(80.0, 90.0, states),
        "strain_energy": rng.random(states),
        "tangent": rng.uniform(1e5, 2e5, states),
        "line_torque": line_torque,
        "corner_torque": rng.uniform(0.0, 1.0, line),
        "pressure_max": rng.uniform(1e8, 1e9, line),
        "z_low": z_low,
        "z_high": z_high,
        "line_load": rng.random((*line, 3)),
    }


@pytest.fixture(scope="module")
def cycle():
    return made_up_cycle()


@pytest.fixture(scope="module")
def data(cycle):
    return contact_dataset(MODIFIED, SETTINGS, cycle)


def test_error_and_stiffness_lie_along_the_line_of_action(data, cycle):
    error = R_BP * cycle["rotation"]
    force = TORQUES / R_BP
    np.testing.assert_allclose(data["transmission_error"], error, rtol=1e-14)
    swing = error.max(axis=0) - error.min(axis=0)
    np.testing.assert_allclose(data["transmission_error_ptp"], swing, rtol=1e-12)
    unloaded = R_BP * cycle["unloaded_rotation"][:, 1]
    np.testing.assert_allclose(data["unloaded_error"], unloaded, rtol=1e-14)
    np.testing.assert_allclose(data["K"], force / error, rtol=1e-13)
    np.testing.assert_allclose(data["K_tangent"], cycle["tangent"] / R_BP / R_BP, rtol=1e-13)


def test_every_line_carries_its_share(data, cycle):
    share = cycle["line_torque"] / TORQUES[:, None]
    np.testing.assert_allclose(data["share"], share, rtol=1e-13)
    per_line = share * data["K"].values[..., None]
    np.testing.assert_allclose(data["K_line"], per_line, rtol=1e-13)
    corner = cycle["corner_torque"].sum(axis=-1) / TORQUES
    np.testing.assert_allclose(data["corner_share"], corner, rtol=1e-13)


def test_lengths_are_those_of_the_lines_in_the_plane_of_contact(data):
    ends = [[z_range(n / 5, line, 0.0) for line in LINES] for n in range(5)]
    length = np.diff(ends, axis=-1)[..., 0] / COS_B
    np.testing.assert_allclose(data["contact_length"], length, rtol=1e-9, atol=1e-12)
    whole = length.sum(axis=1, keepdims=True)
    np.testing.assert_allclose(data["length_share"], length / whole, rtol=1e-9, atol=1e-12)
    assert np.all(np.count_nonzero(length, axis=1) >= 2)


def test_relief_length_is_what_is_loaded_outside_the_unrelieved_part(data, cycle):
    assert float(np.nanmax(cycle["z_high"] - cycle["z_low"])) > 0.9 * HALF
    for n, torque, j in np.ndindex(cycle["z_low"].shape):
        low, high = cycle["z_low"][n, torque, j], cycle["z_high"][n, torque, j]
        plain = z_range(n / 5, LINES[j], 1.0)
        loaded = 0.0 if np.isnan(low) else high - low
        common = 0.0 if np.isnan(low) else max(min(high, plain[1]) - max(low, plain[0]), 0.0)
        at = {"phase": n, "torque": torque, "line": j}
        assert float(data["loaded_length"][at]) == pytest.approx(loaded / COS_B, rel=1e-12)
        expected = pytest.approx((loaded - common) / COS_B, rel=1e-6, abs=1e-9)
        assert float(data["relief_length"][at]) == expected
    part = (data["relief_length"] / data["loaded_length"]).values
    assert np.count_nonzero((part > 0.01) & (part < 0.99)) > 5  # or the test would say little


def test_the_rest_is_handed_on_with_its_places(data, cycle):
    for name in ("pressure_max", "line_load", "gear_torque", "strain_energy"):
        np.testing.assert_array_equal(data[name], cycle[name])
    np.testing.assert_array_equal(data["line"], LINES)
    np.testing.assert_allclose(data["phase"], [0.0, 0.2, 0.4, 0.6, 0.8], rtol=1e-14)
    np.testing.assert_allclose(data["station"], [1 / 6, 1 / 2, 5 / 6], rtol=1e-14)
    np.testing.assert_array_equal(data["torque"], TORQUES)
    pitch = math.tau * R_BP / HE_2007.pinion_teeth
    assert data.attrs["base_pitch"] == pytest.approx(pitch, rel=1e-12)


def test_every_variable_has_its_unit(data):
    per_length = dict.fromkeys(("K", "K_tangent", "K_line", "line_load"), "N/m")
    lengths = ("transmission_error", "transmission_error_ptp", "unloaded_error", "contact_length",
               "relief_length", "loaded_length")  # fmt: skip
    shares = ("share", "length_share", "corner_share", "phase", "line", "station")
    others = {"pressure_max": "Pa", "gear_torque": "N.m", "strain_energy": "J", "torque": "N.m"}
    expected = per_length | dict.fromkeys(lengths, "m") | dict.fromkeys(shares, "1") | others
    assert units_of(data) == expected


def test_stiffness_of_one_density_is_that_of_the_length_along_the_line_of_action():
    settings = named(file=named(helical_pair=lambda: HE_2007))
    made = _constant_density_stiffness(settings, 3e9)
    phase, lines = made["zone_phase"].values, np.arange(3)
    ends = np.array([[z_range(min(p, 1.0 - 1e-12), j, 0.0) for j in lines] for p in phase])
    expected = {
        "K_line_constant": ("N/m", 3e9 * COS_B**2 * np.diff(ends, axis=-1)[..., 0] / COS_B),
        "zone_phase": ("1", np.linspace(0.0, 1.0, phase.size)),
        "constant_line": ("1", lines),
    }
    assert_variables(made, expected, tolerance=1e-8)
