"""The gears of the papers as trains, against their own models."""

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
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle import continuous as axle_exchange
from gearlube_core.dynamics.hypoid_axle import state as axle_state
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS
from gearlube_core.dynamics.train.helical_pair import helical_pair
from gearlube_core.dynamics.train.hypoid_axle import hypoid_axle
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.plan import AT, FIRST_ROW, N_PLACES, NUMBER
from gearlube_core.errors import ParameterError, StepError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.mesh_table.table import PAIRS

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


def of_axle(train: Train, s: np.ndarray) -> np.ndarray:
    """Return the train's state of a state of `HypoidAxle`, whose lengths are in micrometres."""
    made = train.get_state()[:-2]
    members = (
        (axle_state.U_P, axle_state.V_P, axle_state.PHI_P, axle_state.W_P),
        (axle_state.U_G, axle_state.V_G, axle_state.PHI_G, axle_state.W_G),
    )
    for i, (u, v, phi, w) in enumerate(members):
        made[12 * i : 12 * i + 3] = 1e-6 * s[u : u + 3]
        made[12 * i + 6 : 12 * i + 9] = s[v : v + 3]
        made[12 * i + 5], made[12 * i + 11] = s[phi], s[w]
    made[24] = 1e-6 * s[axle_state.X]
    made[25:27] = s[axle_state.CAGE_P], s[axle_state.CAGE_G]
    kept = len(train.state_names)
    made[kept : kept + 2] = 50.0, 178.0
    made[kept + 2 : kept + 4] = s[axle_state.LOAD_TORQUE], s[axle_state.SIDE]
    return made


@pytest.mark.slow
def test_the_axle_of_a_list_is_the_axle():
    given = replace(mohammadpour_2015_axle(), pinion_seal_torque=0.15, wheel_seal_torque=0.3)
    axle, train = HypoidAxle(given), Train(*hypoid_axle(given), given.oil)
    kelvin, load = 363.15, {"input": 50.0, "output": 178.0}
    axle.initialise(pinion_speed=300.0, pinion_torque=50.0, wheel_torque=178.0,
                    oil_temperature=kelvin)  # fmt: skip
    train.initialise({"gear": 300.0 / given.mesh.ratio}, load, kelvin)
    # rates in states about it, teeth parted in some: round-off of micrometres and of sums
    rng, n = np.random.default_rng(5), axle_state.N_ODE
    for k in range(60):
        axle.step(1e-4, *load.values(), kelvin)
        s = np.array(axle.state_view)
        train.set_state(np.array([*of_axle(train, s), *train.get_state()[-2:]]))
        indicators = [axle.output(name) for name in axle_exchange.EVENT_INDICATORS]
        assert train.indicators(train.continuous) == pytest.approx(indicators, rel=1e-9), k
        s[:n] *= 1.0 + 0.1 * rng.normal(size=n)
        s[axle_state.X] = rng.uniform(-120.0, -20.0) if k % 6 == 0 else s[axle_state.X]
        wanted = of_axle(train, np.concatenate([axle.derivative(s[:n]), s[n:]]))
        control = train.get_state()[-2:]
        train.set_state(np.array([*of_axle(train, s), *control]))
        found = train.rates()
        for name in ("pinion", "gear"):
            for one in ("x.rate", "y.rate", "z.rate", "rz.rate"):
                place = train.state_names.index(f"{name}.{one}")
                size = max(abs(wanted[place]), 1.0)
                assert abs(found[place] - wanted[place]) < 1e-9 * size, (k, name, one)
        place = train.state_names.index("mesh.transmission_error")
        assert found[place] == pytest.approx(wanted[place], rel=1e-9, abs=1e-12)


@pytest.mark.slow
def test_the_axle_of_a_list_moves_as_the_axle_and_loses_what_it_is_given():
    given = replace(mohammadpour_2015_axle(), pinion_seal_torque=0.15, churning="boness_1989")
    axle = HypoidAxle(given)
    train = Train(*hypoid_axle(given), given.oil, steps_per_highest_period=17)
    kelvin, wheel = 363.15, 50.0 * given.mesh.ratio
    axle.initialise(pinion_speed=300.0, pinion_torque=50.0, wheel_torque=wheel,
                    oil_temperature=kelvin)  # fmt: skip
    train.initialise({"gear": 84.0}, {"input": 50.0, "output": wheel}, kelvin)
    rate = 17.0 * axle.step_control.highest_frequency
    state = of_axle(train, axle.state_view)
    state[len(train.state_names) + 4] = axle.step_control.reference_stiffness
    train.set_state(np.array([*state, kelvin, rate]))
    start, errors = train.energy, []
    for k in range(200):
        torque = 50.0 * (1.0 + 0.5 * math.sin(0.1 * k))
        axle.step(1e-4, torque, wheel, kelvin)
        train.step(1e-4, {"input": torque, "output": wheel}, kelvin)
        found = train.outputs()
        errors.append((axle.output("mesh.dte"), found["mesh.dte"]))
        if k % 20 == 0:
            thinnest = min(
                film for i in range(1, PAIRS + 1)
                if (film := axle.output(f"flank[{i}].film_thickness")) > 0.0
            )  # fmt: skip
            wanted = {
                "mesh.film_thickness_min": thinnest,
                "mesh.separated": 0.0,
                "mesh.coast_contact": 0.0,
                **{f"mesh.{name}": axle.output(name) for name in RANGE_OUTPUTS},
                **{f"mesh.{one}": axle.output(f"mesh.{one}")
                   for one in ("force", "stiffness", "frequency", "load_torque")},
                "friction_boundary.power_loss": axle.output("friction.power_loss_boundary"),
                "energy.seals": axle.output("energy.seals"),
                "energy.stored": axle.output("energy.stored"),
                "efficiency": axle.output("axle.efficiency"),
            }  # fmt: skip
            for name, value in wanted.items():
                assert found[name] == pytest.approx(value, rel=1e-9), name
    alone, listed = np.array(errors).T
    # the same steps by the same kernels: round-off of micrometres and sums, 4e-14 was found
    assert np.max(abs(listed - alone)) < 1e-11 * np.ptp(alone)
    missing = train.work - sum(train.lost.values()) - (train.energy - start)
    assert abs(missing) < 1e-5 * 50.0 * 300.0 * 0.02
    # torques change sign: teeth part, meet on the coast flanks and bounce, shafts leap
    # and grow, so that the stiffer mesh asks for more steps
    errors = []
    for h, share, times in ((1e-4, -0.7, 100), (1e-3, 4.0, 10)):
        for _ in range(times):
            axle.step(h, 50.0 * share, wheel * share, kelvin)
            train.step(h, {"input": 50.0 * share, "output": wheel * share}, kelvin)
            errors.append((axle.output("mesh.dte"), train.outputs()["mesh.dte"]))
    alone, listed = np.array(errors).T
    assert np.min(alone) < -1e-4
    # bouncing teeth enlarge what the same kernels leave some hundred times; 2e-15 was found
    assert np.max(abs(listed - alone)) < 1e-11 * np.ptp(alone)
