"""The helical pair of the paper as a train, against its own model."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair.march import state as pair_state
from gearlube_core.dynamics.helical_pair.march.continuous import EVENT_INDICATORS, STATE_NAMES
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.helical_pair.march.given_pair import BEARING_FIELDS, N_BEARINGS
from gearlube_core.dynamics.helical_pair.march.model import HelicalPairModel
from gearlube_core.dynamics.helical_pair.march.outputs import OUTPUT_NAMES
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.train.helical_pair import helical_pair
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.plan import AT, FIRST_ROW, N_PLACES, NUMBER
from gearlube_core.errors import ParameterError, StepError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.kernels.flat_tuples import flatten

PAIR = helical_march_parameters(HelicalGearFile.named("he_2007"))
RATIO, KELVIN = PAIR.pair.ratio, 333.15
LOAD = {"input": 226.0, "output": 280.0}


def of_pair(train: Train, s: np.ndarray) -> np.ndarray:
    """Return the train's state of a state of `HelicalPairModel`."""
    made = train.get_state()[:-2]
    members = (
        ("U_P", "TH_P", "PHI_P", "V_P", "OM_P", "W_P", -1.0),
        ("U_G", "TH_G", "PHI_G", "V_G", "OM_G", "W_G", 1.0),
    )
    for i, (u, th, phi, v, om, w, sense) in enumerate(members):
        at = {name: getattr(pair_state, name) for name in (u, th, phi, v, om, w)}
        made[12 * i : 12 * i + 3] = s[at[u] : at[u] + 3]
        made[12 * i + 3 : 12 * i + 5] = s[at[th] : at[th] + 2]
        made[12 * i + 5] = sense * s[at[phi]]
        made[12 * i + 6 : 12 * i + 9] = s[at[v] : at[v] + 3]
        made[12 * i + 9 : 12 * i + 11] = s[at[om] : at[om] + 2]
        made[12 * i + 11] = sense * s[at[w]]
    made[24] = s[pair_state.PSI]
    made[25], made[26] = s[pair_state.PINION_WORK], -s[pair_state.WHEEL_WORK]
    made[27:30] = s[pair_state.FRICTION : pair_state.FRICTION + 3]
    made[30:32] = tuple(LOAD.values())
    made[32] = s[pair_state.LOAD_TORQUE]
    friction = s[pair_state.REFRESHED :]
    made[33 : 33 + friction.size] = friction
    return made


def test_the_pair_in_a_train_is_the_pair_alone_to_the_last_bit():
    alone = HelicalPairModel(PAIR)
    speed = 104.7
    alone.initialise(
        pinion_speed=speed, pinion_torque=226.0, wheel_torque=280.0, oil_temperature=KELVIN
    )
    train = Train(*helical_pair(PAIR), PAIR.oil)
    train.initialise({"wheel": speed / RATIO}, LOAD, KELVIN)
    # both search an equilibrium, to 1e-6 of the forces
    assert train.outputs()["mesh.dte"] == pytest.approx(alone.output("mesh.dte"), rel=1e-5)
    free = train.modes()[0]
    assert free[0] < 1e-3 * free[1]
    assert free[1:] == pytest.approx(alone.natural_frequencies(), rel=1e-5)
    control = alone.step_control
    rate = control.highest_frequency * control.steps_per_highest_period
    train.set_state(np.array([*of_pair(train, alone.state_view), KELVIN, rate]))
    rng, met, ranges = np.random.default_rng(38), set(), set()
    for k in range(120):
        # torques that part the teeth and turn them over
        load = {"input": 226.0 * math.cos(0.05 * k), "output": 280.0 * rng.uniform(-1.0, 1.0)}
        train.step(1e-4, load, KELVIN)
        alone.step(1e-4, *load.values(), KELVIN)
        wanted = of_pair(train, alone.state_view)
        wanted[30:32] = tuple(load.values())
        assert np.array_equal(train.get_state()[:-2], wanted), k
        check_outputs(train, alone)
        left = {f"mesh.{name}": f"mesh.{one}" for name, one in alone.exceeded().items()}
        assert train.exceeded() == left
        ranges |= set(left)
        met |= {name for name in ("mesh.separated", "mesh.coast_contact") if alone.output(name)}
    assert met == {"mesh.separated", "mesh.coast_contact"}  # both were among the states
    assert ranges


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
    shares = pair.bearing_shares().reshape(N_BEARINGS, BEARING_FIELDS)
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
    """All outputs in the same state; forces and energies are summed in other orders."""
    found = alone_from(train, alone.parameters)
    for name in OUTPUT_NAMES:
        assert found[name] == pytest.approx(alone.output(name), rel=1e-9, abs=1e-8), name
    assert train.outputs()["wheel.acceleration"] == found["der(wheel.speed)"]


def test_solved_films_of_a_pair_in_a_train_have_the_bounds_of_the_pair_alone():
    solved = replace(PAIR, film="solved")
    alone, train = HelicalPairModel(solved), Train(*helical_pair(solved), PAIR.oil)
    alone.initialise(
        pinion_speed=104.7, pinion_torque=226.0, wheel_torque=280.0, oil_temperature=KELVIN
    )
    train.initialise({"wheel": 104.7 / RATIO}, LOAD, KELVIN)
    alone.step(1e-3, *LOAD.values(), KELVIN)
    control = train.get_state()[-2:]
    train.set_state(np.array([*of_pair(train, alone.state_view), *control]))
    found = alone_from(train, solved)
    for name in OUTPUT_NAMES:
        if not name.endswith(("power_loss", "efficiency", "_bound")) or name.startswith("line["):
            assert found[name] == pytest.approx(alone.output(name), rel=1e-9, abs=1e-8), name
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
