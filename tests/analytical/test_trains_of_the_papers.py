"""The helical pair of the paper as a train, and its own model over it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.outputs import (
    EVENT_INDICATORS,
    LOAD_TORQUE,
    MARKS,
    N_STATE,
    OUTPUT_NAMES,
    STATE_NAMES,
    STATE_PLACES,
    TORQUES,
    WHEEL_TORQUE,
)
from gearlube_core.dynamics.helical_model.pair import (
    BEARING_FIELDS,
    N_BEARINGS,
    bearing_shares,
    helical_pair,
)
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.train.assemble import assemble
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.plan import AT, FIRST_ROW, N_PLACES, NUMBER
from gearlube_core.errors import ParameterError, StepError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.kernels.flat_tuples import flatten

PAIR = helical_march_parameters(HelicalGearFile.named("he_2007"))
RATIO, KELVIN = PAIR.pair.ratio, 333.15
LOAD = {"input": 226.0, "output": 280.0}


def test_the_model_of_the_pair_is_its_train_to_the_last_bit():
    """One list in code generated for it, and in the code for all lists."""
    alone = HelicalPairModel(PAIR)
    speed = 104.7
    alone.initialise(
        pinion_speed=speed, pinion_torque=226.0, wheel_torque=280.0, oil_temperature=KELVIN
    )
    steps = PAIR.steps_per_highest_period
    train = Train(*helical_pair(PAIR), PAIR.oil, steps_per_highest_period=steps)
    train.initialise({"wheel": speed / RATIO}, LOAD, KELVIN)
    # the speed of one member is rounded in one, of the other in the other
    assert train.outputs()["mesh.dte"] == pytest.approx(alone.output("mesh.dte"), rel=1e-11)
    free = train.modes()[0]
    assert free[0] < 1e-3 * free[1]
    assert free[1:] == pytest.approx(alone.natural_frequencies(), rel=1e-8)
    control = alone.step_control
    rate = control.highest_frequency * control.steps_per_highest_period
    assert train.get_state()[-1] == pytest.approx(rate, rel=1e-8)
    train.set_state(np.array([*alone.state_view, KELVIN, rate]))
    rng, met, ranges = np.random.default_rng(38), set(), set()
    for k in range(120):
        # torques that part the teeth and turn them over
        load = {"input": 226.0 * math.cos(0.05 * k), "output": 280.0 * rng.uniform(-1.0, 1.0)}
        train.step(1e-4, load, KELVIN)
        alone.step(1e-4, *load.values(), KELVIN)
        assert np.array_equal(train.get_state()[:-2], alone.state_view), k
        check_outputs(train, alone)
        left = {f"mesh.{name}": f"mesh.{one}" for name, one in alone.exceeded().items()}
        assert train.exceeded() == left
        ranges |= set(left)
        met |= {name for name in ("mesh.separated", "mesh.coast_contact") if alone.output(name)}
    assert met == {"mesh.separated", "mesh.coast_contact"}  # both were among the states
    assert ranges


def test_places_of_the_pair_are_those_of_its_list():
    made = assemble(*helical_pair(PAIR), PAIR.oil)
    assert made.sizes.states == N_STATE
    assert made.kept == {
        "input": TORQUES, "output": WHEEL_TORQUE, "mesh": LOAD_TORQUE, "pinion bearings": MARKS,
        "wheel bearings": MARKS,
    }  # fmt: skip
    assert made.sizes.kept == MARKS
    train = Train(*helical_pair(PAIR), PAIR.oil)
    shown = {one.record.name: one.place for one in train.assembly.continuous}
    named = {"energy.pinion_work": "energy.input.work", "energy.wheel_work": "energy.output.work"}
    for name, place in zip(STATE_NAMES, STATE_PLACES, strict=True):
        assert shown[named.get(name, name)] == place, name


def alone_from(train: Train, pair: HelicalMarchParameters) -> dict[str, float]:
    """Return all outputs of `HelicalPairModel` from those of the train of its list."""
    now = train.outputs()
    found = {name.removeprefix("mesh."): value for name, value in now.items()} | now
    # the pinion turns about -z of the train, and the wheel's torque is a load
    given = {name: found[name] for name in OUTPUT_NAMES if name in found}
    given["pinion.acceleration"] = -found["pinion.acceleration"]
    x = train.continuous
    states = dict(zip(train.continuous_names, x, strict=True))
    rates = dict(zip(train.continuous_names, train.derivative(x), strict=True))
    named = {"energy.pinion_work": "energy.input.work", "energy.wheel_work": "energy.output.work"}
    turned = "pinion.speed", "pinion.angle", "energy.wheel_work"
    for name in STATE_NAMES:
        of, sign = named.get(name, name), -1.0 if name in turned else 1.0
        given |= {name: sign * states[of], f"der({name})": sign * rates[of]}
    given |= dict(zip(EVENT_INDICATORS, train.indicators(x), strict=True))
    given["speed.hold_torque"] = found["input.hold_torque"]
    losses = {"damping": "mesh_damping", "bearing": "bearing_damping"}
    given |= {f"{one}.power_loss": found[f"{other}.power_loss"] for one, other in losses.items()}
    pinion, wheel = found["input.power"], -found["output.power"]
    put_in, friction = pinion if pinion > 0.0 else -wheel, given["friction.power_loss"]
    lost = friction + sum(given[f"{one}.power_loss"] for one in losses)
    given["efficiency"] = 1.0 - friction / put_in if put_in > 0.0 else 0.0
    given["pair.efficiency"] = 1.0 - lost / put_in if put_in > 0.0 else 0.0
    bound = found["mesh.friction_bound_relative"]
    given["friction.power_loss_bound"] = bound * abs(friction)
    given["efficiency_bound"] = bound * friction / put_in if given["efficiency"] > 0.0 else 0.0
    shares = bearing_shares(pair).reshape(N_BEARINGS, BEARING_FIELDS)
    for j, b in enumerate(shares):
        member = "pinion" if j < 2 else "wheel"
        x, y, z = (states[f"{member}.displacement.{c}"] for c in "xyz")
        v_x, v_y, v_z = (states[f"{member}.velocity.{c}"] for c in "xyz")
        r_x, r_y = (states[f"{member}.tilt.{c}"] for c in "xy")
        given |= {
            f"bearing[{j + 1}].force.x": -(b[0] * x + b[1] * r_y + b[5] * v_x),
            f"bearing[{j + 1}].force.y": -(b[2] * y + b[3] * r_x + b[6] * v_y),
            f"bearing[{j + 1}].force.z": -(b[4] * z + b[7] * v_z),
        }
    return given


def check_outputs(train: Train, alone: HelicalPairModel) -> None:
    """All outputs in the same state; losses are summed in another order."""
    found = alone_from(train, alone.parameters)
    for name in OUTPUT_NAMES:
        assert found[name] == pytest.approx(alone.output(name), rel=1e-13, abs=1e-13), name
    assert train.outputs()["wheel.acceleration"] == found["der(wheel.speed)"]


def test_solved_films_of_a_pair_in_a_train_have_the_bounds_of_the_pair_alone():
    solved = replace(PAIR, film="solved")
    alone, train = HelicalPairModel(solved), Train(*helical_pair(solved), PAIR.oil)
    alone.initialise(
        pinion_speed=104.7, pinion_torque=226.0, wheel_torque=280.0, oil_temperature=KELVIN
    )
    train.initialise({"wheel": 104.7 / RATIO}, LOAD, KELVIN)
    alone.step(1e-3, *LOAD.values(), KELVIN)
    train.set_state(np.array([*alone.state_view, *train.get_state()[-2:]]))
    found = alone_from(train, solved)
    for name in OUTPUT_NAMES:
        assert found[name] == pytest.approx(alone.output(name), rel=1e-13, abs=1e-13), name
    bound = alone.output("friction.power_loss_bound") / alone.output("friction.power_loss")
    assert 0.0 < bound == pytest.approx(train.outputs()["mesh.friction_bound_relative"], rel=1e-9)
    assert found["line[1].film_bound"] > 0.0


def test_a_mesh_in_the_axes_of_its_train_needs_no_turning():
    """The shorter way, for a pair by itself, gives the bits of the general one."""
    train = Train(*helical_pair(PAIR), PAIR.oil)
    train.initialise({"wheel": 84.4}, LOAD, KELVIN)
    train.step(1e-3, LOAD, KELVIN)
    rates, made = train.rates(), train.assembly
    numbers = train.elements[2].numbers()
    marked = flatten(numbers._replace(aligned=-7.0)).tolist().index(-7.0)
    row = FIRST_ROW
    for _ in range(2):
        row += AT + made.plan[row + N_PLACES]
    place = made.plan[row + NUMBER] + marked
    assert made.numbers[place] == 1.0
    made.numbers[place] = 0.0
    assert np.array_equal(train.rates(), rates)


def test_an_integrator_of_ones_own_renews_friction_at_events():
    """The event does what the next step begins with; without one friction stays as it is."""
    train, load = Train(*helical_pair(PAIR), PAIR.oil), LOAD
    train.initialise({"wheel": 84.4}, load, KELVIN)
    before = train.continuous
    moved = before.copy()
    moved[train.continuous_names.index("pinion.angle")] -= 0.03
    kept = train.get_state()
    rates = train.derivative(moved)
    assert np.array_equal(train.get_state(), kept)
    assert np.array_equal(train.event(moved), moved)
    assert not np.array_equal(train.get_state()[33:], kept[33:])
    assert not np.array_equal(train.derivative(moved), rates)
    assert np.array_equal(train.event(moved), moved)  # nothing is due twice
    with pytest.raises(StepError, match=r"0\.1 m"):
        train.derivative(np.full(moved.size, 1.0))
    with pytest.raises(ParameterError, match=r"must have the shape \(31,\), got \(2,\)"):
        train.derivative(np.zeros(2))
