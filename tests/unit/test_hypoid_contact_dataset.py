"""The dataset of a hypoid tooth contact analysis against a made-up mesh cycle, by hand."""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact import contact_dataset as module
from gearlube_core.hypoid_contact.mesh_cycle import MAP_SHAPE, PAIRS_BESIDE, SIDES, CycleSettings
from tests.helpers.contact_cases import shipped_file
from tests.helpers.known_answers import units_of

TORQUES = np.array([20.0, 60.0])
SETTINGS = CycleSettings(torques=tuple(TORQUES), positions=4)
PHASES = np.arange(4) / 4
PAIRS = np.arange(-PAIRS_BESIDE, PAIRS_BESIDE + 1)
SIGN = {"drive": 1.0, "coast": -1.0}  # of the rotation by which a flank touches
GEAR_PITCH, PINION_PITCH = 0.17, 0.48  # rad
CLOSEST = 0.3  # phase at which a pair touches with least error
BEND = 4e-4  # rad per mesh period squared, of the error of one pair
CLOSING = np.array([[2e-4, 5e-4], [3e-4, 7e-4], [2.5e-4, 6e-4], [2.2e-4, 5.5e-4]])  # rad


def error_of(side, phase):
    """A pair's parabola of error repeats after one mesh period: the nearest pair touches."""
    away = (np.asarray(phase) - CLOSEST + 0.5) % 1.0 - 0.5
    return SIGN[side] * BEND * away**2


def made_up_cycle(side):
    rng = np.random.default_rng(3 if side == "drive" else 4)
    count, states = PAIRS.size, (PHASES.size, TORQUES.size)
    share = rng.random((*states, count))
    share[..., [0, 4]] = 0.0
    position = rng.random((*states, count, 2))
    position[1, 1, 2, 0] = np.nan  # a pair whose centre of force is not known
    touching = SIGN[side] * error_of(side, PHASES)
    return {
        "rotation": touching[:, None] + CLOSING,
        "force": rng.uniform(500.0, 900.0, (*states, 3)),
        "gear_torque": rng.uniform(100.0, 200.0, states),
        "strain_energy": rng.random(states),
        "tangent": rng.uniform(1e5, 2e5, states),
        # the pairs carry the torque up to the tolerance of the loaded contact
        "pair_torque": 0.99 * TORQUES[:, None] * share / share.sum(axis=-1, keepdims=True),
        "pressure_max": rng.random((*states, count)),
        "gear_position": position,
        "pinion_position": 2.0 + rng.random((*states, count, 2)),
        "pressure_map": rng.random((*states, *MAP_SHAPE)),
    }


def made_up_kinematics(pair, gear_angle, pinion_angle, gear, pinion):
    """Numbers that tell what they were made of."""
    one = np.ones((gear_angle.size, 1))
    return SimpleNamespace(
        R_x=gear_angle, R_y=pinion_angle, R_sliding=gear[0] + 10.0 * gear[1],
        psi=pinion[0] + 10.0 * pinion[1], entrainment_arm=gear_angle + 1.0,
        friction_arm_p=gear_angle + 2.0, friction_arm_g=gear_angle + 3.0,
        sliding=one * [0.03, 0.04, 0.12], xi=one * [-0.6, 0.48, 0.64],
        minor_axis=one * [0.0, 1.0, 0.0], major_axis=one * [1.0, 0.0, 0.0],
    )  # fmt: skip


@cache
def found():
    """The dataset; geometry that other tests cover is replaced by made-up functions."""
    with pytest.MonkeyPatch.context() as patch:
        flank = SimpleNamespace(parameters=lambda s, t: (s, t))

        def from_file(file, side, misalignment):
            return SimpleNamespace(
                side=side, touching_sign=SIGN[side], gear_pitch=GEAR_PITCH,
                pinion_pitch=PINION_PITCH, gear=flank, pinion=flank,
            )  # fmt: skip

        def contact_path(pair, angles):
            return SimpleNamespace(
                inside=np.abs(angles) < 1.25 * GEAR_PITCH, gear_s=angles, gear_t=2.0 * angles,
                transmission_error=3.0 * angles,
            )  # fmt: skip

        def ease_off(pair, s_count, t_count):
            return SimpleNamespace(normal_gap=lambda: np.full((s_count, t_count), 7.0))

        def searched_transmission_error(pair, angles):
            away = angles / GEAR_PITCH - CLOSEST
            error = np.where(np.abs(away) < 1.5, pair.touching_sign * BEND * away**2, np.nan)
            return SimpleNamespace(error=error)

        for name, value in {
            "FlankPair": SimpleNamespace(from_file=from_file),
            "contact_path": contact_path,
            "ease_off": ease_off,
            "closest_approach": lambda ease: ease.normal_gap() + 1.0,
            "contact_ratio": lambda pair: 1.5 + 0.1 * pair.touching_sign,
            "searched_transmission_error": searched_transmission_error,
            "contact_kinematics": made_up_kinematics,
        }.items():
            patch.setattr(module, name, value)
        cycle = {side: made_up_cycle(side) for side in SIDES}
        dataset = module.contact_dataset(shipped_file(), SETTINGS, cycle)
        cycle["drive"]["rotation"][2, 0] = error_of("drive", PHASES[2]) - 5e-5
        with pytest.raises(ParameterError, match="drive flanks close by -5e-05 rad"):
            module.contact_dataset(shipped_file(), SETTINGS, cycle)
        return dataset


@pytest.mark.parametrize("side", SIDES)
def test_arms_stiffness_and_direction_are_those_of_the_mesh_force(side):
    data, cycle = found().sel(side=side), made_up_cycle(side)
    force = np.sqrt((cycle["force"] ** 2).sum(axis=-1))
    R_p = TORQUES / force
    np.testing.assert_allclose(data["R_p"], R_p, rtol=1e-13)
    np.testing.assert_allclose(data["R_g"], cycle["gear_torque"] / force, rtol=1e-13)
    # force over the way that the pinion moves its line of action
    np.testing.assert_allclose(data["k_m"], force / (CLOSING * R_p), rtol=1e-11)
    np.testing.assert_allclose(data["k_t"], cycle["tangent"] / (R_p * R_p), rtol=1e-13)
    direction = SIGN[side] * cycle["force"] / force[..., None]
    np.testing.assert_allclose(data["n"], direction, rtol=1e-13)
    for name in ("rotation", "gear_torque", "strain_energy", "pressure_max"):
        np.testing.assert_array_equal(data[name], cycle[name])
    np.testing.assert_array_equal(data["gear_s"], cycle["gear_position"][..., 0])
    np.testing.assert_array_equal(data["gear_t"], cycle["gear_position"][..., 1])
    np.testing.assert_array_equal(data["pressure_map"], cycle["pressure_map"].max(axis=0))
    # kept with 32 bits: seven digits
    np.testing.assert_allclose(data["pressure_cells"], cycle["pressure_map"], rtol=1e-7)


@pytest.mark.parametrize("side", SIDES)
def test_shares_add_up_to_one(side):
    data, cycle = found().sel(side=side), made_up_cycle(side)
    # 0.99 of the torque is carried
    expected = cycle["pair_torque"] / (0.99 * TORQUES[:, None])
    np.testing.assert_allclose(data["share"], expected, rtol=1e-13)


@pytest.mark.parametrize("side", SIDES)
def test_unloaded_error_is_that_of_the_pair_that_touches_first(side):
    data = found().sel(side=side)
    assert data.sizes["fine_phase"] == 64
    expected = error_of(side, np.arange(64) / 64)
    np.testing.assert_allclose(data["error"], expected, rtol=1e-12, atol=1e-18)
    at_least_torque = data["R_p"].values[:, 0].mean()
    np.testing.assert_allclose(data["e"], at_least_torque * expected, rtol=1e-12, atol=1e-18)


@pytest.mark.parametrize("side", SIDES)
def test_path_and_ease_off_lie_on_their_grids(side):
    data = found().sel(side=side)
    np.testing.assert_allclose(data["path_phase"], np.arange(-80, 81) / 40.0, atol=1e-14)
    angle = data["path_phase"].values * GEAR_PITCH
    on_teeth = np.abs(data["path_phase"].values) < 1.25
    for name, factor in (("path_s", 1.0), ("path_t", 2.0), ("path_error", 3.0)):
        expected = np.where(on_teeth, factor * angle, np.nan)
        np.testing.assert_allclose(data[name], expected, rtol=1e-13, atol=1e-15)
    assert data["ease_off"].shape == (21, 41)
    assert np.all(data["ease_off"] == 7.0)
    assert np.all(data["closest"] == 8.0)
    assert float(data["path_contact_ratio"]) == 1.5 + 0.1 * SIGN[side]
    np.testing.assert_allclose(data["ease_s"], np.arange(21) / 20.0, atol=1e-15)
    np.testing.assert_allclose(data["ease_t"], np.arange(41) / 40.0, atol=1e-15)


@pytest.mark.parametrize("side", SIDES)
def test_kinematics_are_at_the_centre_of_force_of_every_loaded_pair(side):
    data, cycle = found().sel(side=side), made_up_cycle(side)
    known = (cycle["pair_torque"] > 0.0) & np.isfinite(cycle["gear_position"][..., 0])
    assert known.sum() == 23  # three pairs of eight states, of which one has no centre

    def check(name, expected):
        expected = np.where(known, np.broadcast_to(expected, known.shape), np.nan)
        np.testing.assert_allclose(data[name], expected, rtol=1e-12)

    phase = PHASES[:, None, None] + PAIRS
    gear_angle = phase * GEAR_PITCH
    check("R_x", gear_angle)
    check("R_y", phase * PINION_PITCH + SIGN[side] * cycle["rotation"][..., None])
    for name, position in (("R_sliding", "gear_position"), ("psi", "pinion_position")):
        check(name, cycle[position][..., 0] + 10.0 * cycle[position][..., 1])
    check("entrainment_arm", gear_angle + 1.0)
    check("friction_arm_p", gear_angle + 2.0)
    check("friction_arm_g", gear_angle + 3.0)
    check("sliding_arm", 0.13)  # of 3, 4 and 12
    check("chi", np.arctan(0.6 / 0.48))  # parts of xi across and along the minor axis
    for axis, expected in zip("xyz", (-0.6, 0.48, 0.64), strict=True):
        values = data["xi"].sel(axis=axis)
        np.testing.assert_array_equal(values, np.where(known, expected, np.nan))
    for axis, expected in zip("xyz", (0.0, 1.0, 0.0), strict=True):
        values = data["minor_axis"].sel(axis=axis)
        np.testing.assert_array_equal(values, np.where(known, expected, np.nan))


def test_coordinates_and_attributes_are_those_of_the_settings_and_the_file():
    data, file = found(), shipped_file()
    np.testing.assert_array_equal(data["phase"], PHASES)
    np.testing.assert_array_equal(data["torque"], TORQUES)
    np.testing.assert_array_equal(data["pair"], PAIRS)
    np.testing.assert_allclose(data["fine_phase"], np.arange(64) / 64)
    for name, cells in (("map_s", 24), ("map_t", 48)):  # middles of the cells
        np.testing.assert_allclose(data[name], np.linspace(0.5, cells - 0.5, cells) / cells)
    assert (data.attrs["pinion_teeth"], data.attrs["gear_teeth"]) == (13, 36)
    assert data.attrs["face_width"] == pytest.approx(1e-3 * file.gear.face_width_mm, rel=1e-14)
    assert type(file).model_validate_json(data.attrs["gear_file"]) == file
    assert "null" not in data.attrs["gear_file"]


def test_every_variable_has_its_unit():
    units = {
        "rad": "rotation psi chi error path_error",
        "N.m": "gear_torque torque",
        "J": "strain_energy",
        "N/m": "k_m k_t",
        "Pa": "pressure_max pressure_map pressure_cells",
        "m": "R_p R_g R_x R_y R_sliding entrainment_arm sliding_arm friction_arm_p friction_arm_g "
        "e ease_off closest",
        "1": "n share gear_s gear_t xi minor_axis path_s path_t path_contact_ratio phase pair "
        "map_s map_t fine_phase path_phase ease_s ease_t",
        "": "side axis",
    }
    expected = {name: unit for unit, names in units.items() for name in names.split()}
    assert units_of(found()) == expected
