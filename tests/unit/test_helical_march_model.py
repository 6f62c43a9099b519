from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.outputs import OUTPUT_INDEX, OUTPUT_NAMES
from gearlube_core.dynamics.helical_pair.gear_file_pair import iso_mesh
from gearlube_core.dynamics.helical_pair.march.flanks import LINES_MAX
from gearlube_core.dynamics.helical_pair.march.gear_file_march import (
    ReplacedBearings,
    helical_march_parameters,
)
from gearlube_core.errors import ParameterError, StepError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.each import each
from tests.helpers.helical_march_cases import (
    OIL,
    PERIOD,
    RATIO,
    SPEED,
    TORQUE,
    energies,
    he_march,
    history,
    output,
    started,
    unaccounted,
    wavy_mesh,
)

NAN = float("nan")
LINES = [f"line[{i}].load" for i in range(1, LINES_MAX + 1)]


@each("friction", ["film", "constant", "off", "arana_2019"])
@each("name", ["he_2007", "jamali_2015_a", "jamali_2015_b"])
def test_every_shipped_pair_runs_steadily_in_contact(name: str, friction: str) -> None:
    gear = HelicalGearFile.named(name)
    parameters = replace(helical_march_parameters(gear), friction=friction)
    operation = gear.operation
    torque = operation.pinion_torque_n_m
    model = HelicalPairModel(parameters)
    model.initialise(
        pinion_speed=operation.pinion_speed_rpm * math.pi / 30.0,
        pinion_torque=torque,
        wheel_torque=torque * parameters.pair.ratio,
        oil_temperature=OIL,
    )
    rows = history(
        model, ["mesh.load", "mesh.separated", "mesh.coast_contact", *LINES], 60, 1e-4,
        torque=torque, wheel_torque=torque * parameters.pair.ratio,
    )  # fmt: skip
    pair = parameters.pair
    normal = torque / pair.pinion_base_radius / math.cos(pair.base_helix_angle)
    # the mean load carries the torque; friction's share of it stays below mu = 0.05 times 1/10
    assert rows[:, 0].mean() == pytest.approx(normal, rel=5e-3)
    assert (rows[:, 1:3] == 0.0).all()
    # the lines together carry the load, two or three of them
    np.testing.assert_allclose(rows[:, 3:].sum(axis=1), rows[:, 0], rtol=1e-6)
    count = (rows[:, 3:] > 0.0).sum(axis=1)
    assert set(count) <= {2, 3}


def test_a_tooth_pair_keeps_its_place_from_entry_to_exit() -> None:
    rows = history(started(he_march()), LINES[:4], 400, PERIOD / 50)
    assert (rows[:, 3] == 0.0).all()  # three places serve a contact ratio of 2.74
    for column in range(3):
        jumps = np.abs(np.diff(rows[:, column]))
        # trapezoids: no jump, where a numbering by age would fall by thousands of newtons
        assert jumps.max() < 0.05 * rows[:, column].max()


def test_restored_states_continue_bit_for_bit() -> None:
    model = started(he_march(friction="film"))
    history(model, LINES, 7, 1.3e-4)
    state = model.get_state()
    expected = history(model, list(OUTPUT_NAMES), 5, 1.7e-4, torque=100.0)
    twin = HelicalPairModel(he_march(friction="film"))
    for other in (model, twin):
        other.set_state(state)
        found = history(other, list(OUTPUT_NAMES), 5, 1.7e-4, torque=100.0)
        np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize(
    "spoil",
    [
        lambda state: state[:-1],
        lambda state: np.full_like(state, NAN),
        lambda state: np.zeros_like(state),
    ],
)
def test_a_state_that_is_none_is_refused_and_nothing_changes(spoil: object) -> None:
    model = started(he_march())
    before = model.get_state()
    with pytest.raises(StepError):
        model.set_state(spoil(before))
    np.testing.assert_array_equal(model.get_state(), before)


@each(
    ("arguments", "error", "message"),
    [
        ((0.0, 1.0, 1.0, OIL), StepError, "above 0 and at most 0.1 s"),
        ((0.2, 1.0, 1.0, OIL), StepError, "got 0.2 s"),
        ((NAN, 1.0, 1.0, OIL), ParameterError, "step size must be finite"),
        ((1e-4, NAN, 1.0, OIL), ParameterError, "pinion.torque must be finite"),
        ((1e-4, 1.0, 2e5, OIL), ParameterError, "wheel.torque must be within"),
        ((1e-4, 1.0, 1.0, 60.0), ParameterError, "oil.temperature"),
    ],
)
def test_impossible_steps_are_refused_and_nothing_moves(
    arguments: tuple[float, ...], error: type[Exception], message: str
) -> None:
    model = started(he_march())
    before = model.get_state()
    with pytest.raises(error, match=message):
        model.step(*arguments)
    np.testing.assert_array_equal(model.get_state(), before)


def test_a_pair_driven_to_pieces_is_refused_and_stays() -> None:
    model = started(he_march(stiffness_density=1e6))  # teeth of rubber: 0.14 m of deflection
    before = model.get_state()
    with pytest.raises(StepError, match="no longer finite or the teeth have parted"):
        model.step(0.1, TORQUE, TORQUE * RATIO, OIL)
    np.testing.assert_array_equal(model.get_state(), before)


def test_a_step_too_long_for_its_resolution_is_refused() -> None:
    model = started(he_march(steps_per_mesh_period=4096), speed=5000.0)
    with pytest.raises(StepError, match="Shorten the communication step"):
        model.step(0.1, TORQUE, TORQUE * RATIO, OIL)


@each(
    ("settings", "message"),
    [
        ({"friction": "wet"}, "friction must be one of film, constant, off, arana_2019"),
        ({"form": "three"}, "form must be one of"),
        ({"equations": "printed"}, "equations must be one of"),
        ({"backlash": -1e-6}, "backlash must be within 0"),
        ({"roughness_rms": 0.5}, "roughness_rms must be within"),
        ({"mesh_damping_ratio": 2.0}, "mesh_damping_ratio must be within"),
        ({"steps_per_highest_period": 2}, "steps_per_highest_period must be within 6"),
        ({"stiffness_density": -1.0}, "stiffness_density must be within 0"),
        ({"oil": "water"}, "lubricant name must be one of"),
    ],
)
def test_wrong_parameters_are_named(settings: dict[str, object], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        he_march(**settings)


def test_a_mesh_of_another_pair_is_refused() -> None:
    other = iso_mesh(HelicalGearFile.named("jamali_2015_a").helical_pair())
    with pytest.raises(ParameterError, match="mesh must belong to the pair of 25 and 31 teeth"):
        helical_march_parameters(HelicalGearFile.named("he_2007"), line_mesh=other)


def test_a_line_mesh_and_a_density_exclude_each_other() -> None:
    gear = HelicalGearFile.named("he_2007")
    mesh = named_line_mesh("he_2007")
    with pytest.raises(ParameterError, match="must be 0 with a line mesh"):
        helical_march_parameters(gear, line_mesh=mesh, stiffness_density=1e10)


def test_the_loaded_contact_analysis_carries_the_torque_at_its_own_error() -> None:
    """Load and mean deflection of the shipped mesh at one of its levels, the energy closed."""
    mesh = named_line_mesh("he_2007")
    model = started(he_march(line_mesh=mesh, friction="off"))
    before = energies(model)
    rows = history(model, ["mesh.load", "mesh.separated"], 200, PERIOD / 10)
    pair = model.parameters.pair
    normal = TORQUE / pair.pinion_base_radius / math.cos(pair.base_helix_angle)
    assert rows[:, 0].mean() == pytest.approx(normal, rel=2e-3)  # ringing of the start
    assert not rows[:, 1].any()
    assert abs(unaccounted(before, energies(model))) < 2e-6 * energies(model)[0]


def test_a_gear_without_bearings_needs_them_from_elsewhere() -> None:
    bare = HelicalGearFile.named("he_2007").varied(
        {"pinion.bearing_1": None, "pinion.bearing_2": None, "completed": {}}
    )
    with pytest.raises(ParameterError, match=r"pinion\.bearing_1 is missing"):
        helical_march_parameters(bare)
    given = ReplacedBearings(radial_stiffness=2e9, axial_stiffness=1e9, bearing_distance=0.06)
    support = helical_march_parameters(bare, bearings=given).pinion.support
    assert (support.first.K_xx, support.second.K_zz) == (1e9, 5e8)
    assert (support.first.position, support.second.position) == (0.06, -0.06)


def test_bearings_carry_the_load_of_the_flanks() -> None:
    model = started(he_march(friction="off"))
    history(model, LINES, 40, PERIOD)  # the start rings down
    names = [f"bearing[{j}].force.{c}" for j in (1, 2, 3, 4) for c in "xyz"]
    names += [f"mesh.force.{c}" for c in "xyz"]
    mean = history(model, names, 640, PERIOD / 64).mean(axis=0)
    pinion, wheel = mean[0:3] + mean[3:6], mean[6:9] + mean[9:12]
    # what accelerates the body vanishes in the mean over ten periods
    np.testing.assert_allclose(pinion, -mean[12:15], atol=2e-4 * abs(mean[12]))
    np.testing.assert_allclose(wheel, mean[12:15], atol=2e-4 * abs(mean[12]))


def test_light_load_lets_the_flanks_part_and_heavy_load_does_not() -> None:
    """Offset swings by 4 um near the mesh mode: 5 N.m press by 0.3 um, 226 N.m by 12 um."""
    parameters = wavy_mesh(he_march(friction_coefficient=0.02))
    mesh = parameters.mesh
    swing = 2e-6 * (1.0 + np.sin(2.0 * np.pi * mesh.phase))[None, :, None, None]
    mesh = replace(mesh, offset=np.broadcast_to(swing, mesh.offset.shape))
    for torque, parts in ((5.0, True), (TORQUE, False)):
        model = started(replace(parameters, mesh=mesh), torque=torque, speed=700.0)
        before = energies(model)
        rows = history(
            model, ["mesh.separated", "mesh.load", "mesh.stiffness"], 1500, 2e-5, torque=torque
        )
        assert bool(rows[:, 0].any()) == parts
        apart = rows[:, 0] == 1.0
        assert (rows[apart, 1:] == 0.0).all()
        # impacts and lines that touch in part: RK4 steps over their kinks
        assert abs(unaccounted(before, energies(model))) < 1e-4 * energies(model)[0]


def test_a_pair_without_load_starts_between_the_flanks_and_coasts() -> None:
    model = started(he_march(friction="film"), torque=0.0)
    assert output(model, "mesh.load") == 0.0
    rows = history(model, ["pinion.speed", "mesh.separated", "efficiency"], 20, 1e-3, torque=0.0)
    assert rows[-1, 0] == pytest.approx(SPEED, rel=1e-6)
    assert (rows[:, 2] == 0.0).all()  # no work, no efficiency
    # the step is tied to the mode of pressed flanks all the same
    loaded = started(he_march(friction="film"))
    assert model.step_control.highest_frequency == pytest.approx(
        loaded.step_control.highest_frequency, rel=0.02
    )


def test_reversing_the_torque_crosses_the_backlash_to_the_coast_flanks() -> None:
    backlash = 80e-6
    parameters = he_march(backlash=backlash, mesh_damping_ratio=0.1, support_damping_ratio=0.2)
    model = started(parameters)
    before = energies(model)
    drive = output(model, "mesh.dte")
    names = ["mesh.dte", "mesh.separated", "mesh.coast_contact", "mesh.load"]
    rows = history(model, names, 4000, 2e-5, torque=-TORQUE)
    assert rows[:, 1].any()
    assert rows[-1, 2] == 1.0
    assert rows[-100:, 3].max() < 0.0
    gap = backlash / math.cos(parameters.pair.base_helix_angle)
    # psi goes from pressed to pressed on the other side, deflections of some 10 um
    assert rows[-1, 0] < -gap
    assert abs(rows[-1, 0] + drive + gap) < 20e-6
    # impacts at RK4 with 8 steps in the highest period
    assert abs(unaccounted(before, energies(model))) < 1e-3 * np.abs(energies(model)[:2]).max()


def test_load_level_follows_the_torque_within_hundredths_of_a_second() -> None:
    model = started(he_march())
    history(model, [], 20, 1e-3, torque=1.5 * TORQUE)
    # a first-order lag of 20 ms after 20 ms, for a torque that does not change meanwhile
    expected = TORQUE * (1.5 - 0.5 * math.exp(-1.0))
    assert output(model, "mesh.load_torque") == pytest.approx(expected, rel=1e-12)


def test_film_friction_is_frozen_between_updates_and_converges_with_them() -> None:
    heat = []
    for updates in (8, 16, 64, 256):
        model = started(he_march(friction="film", friction_updates_per_mesh_period=updates))
        history(model, ["mesh.dte"], 40, PERIOD / 2)
        heat.append(output(model, "energy.friction"))
    errors = np.abs(np.array(heat[:-1]) / heat[-1] - 1.0)
    assert errors[0] > errors[1] > errors[2]
    assert errors[1] < 5e-3  # the default


def test_film_outputs_follow_speed_and_oil() -> None:
    """Dowson and Toyoda 1979: film as the 0.69th power of speed, thinner with hot oil."""
    thick = {}
    for speed, oil in ((SPEED, OIL), (2.0 * SPEED, OIL), (SPEED, 363.15)):
        model = HelicalPairModel(he_march())
        model.initialise(
            pinion_speed=speed, pinion_torque=TORQUE, wheel_torque=RATIO * TORQUE,
            oil_temperature=oil,
        )  # fmt: skip
        thick[speed, oil] = output(model, "mesh.film_thickness_min")
    base = thick[SPEED, OIL]
    assert thick[2.0 * SPEED, OIL] / base == pytest.approx(2.0**0.69, rel=1e-9)
    assert thick[SPEED, 363.15] < 0.7 * base
    assert 0.05e-6 < base < 1e-6


def test_outputs_have_their_places() -> None:
    assert len(set(OUTPUT_NAMES)) == len(OUTPUT_NAMES)
    model = started(he_march(friction_coefficient=0.07))
    pair = model.parameters.pair
    assert output(model, "mesh.frequency") == pytest.approx(pair.mesh_frequency(SPEED), rel=1e-12)
    loaded = [i for i in range(1, 4) if output(model, f"line[{i}].load") > 0.0]
    for i in loaded:
        found = output(model, f"line[{i}].friction_coefficient")
        assert found == pytest.approx(0.07, rel=1e-12)  # a mean of equals
    length = sum(output(model, f"line[{i}].length") for i in range(1, 4))
    # H3: within the trapezoid about eps_alpha W/cos(b)
    assert length == pytest.approx(pair.mean_contact_length, rel=0.1)
    assert model.outputs[OUTPUT_INDEX["pinion.speed"]] == SPEED
