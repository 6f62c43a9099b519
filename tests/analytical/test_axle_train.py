"""The hypoid axle as a train against `HypoidAxle`: all outputs, and every option."""

from __future__ import annotations

import math
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.as_train import axle_train, axle_values
from gearlube_core.dynamics.hypoid_axle.output_names import OUTPUT_NAMES
from gearlube_core.dynamics.hypoid_axle.state import N_ODE, X
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.train.model import Train
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.mesh_table.table import PAIRS
from tests.helpers.axle_train import train_state

AXLE = mohammadpour_2015_axle()
KELVIN, SPEED, TORQUE = 363.15, 300.0, 50.0
LOSSES = {
    "bearing_torque_loss": "zhou_hoeprich_1991",
    "churning": "boness_1989",
    "pinion_seal_torque": 0.15,
    "wheel_seal_torque": 0.3,
    "rolling": "biboulet_houpert_2010",
}
SOLVED = {"film": "solved", "bearing_torque_loss": "solved_films"}


def worst(found: list[Array], wanted: list[Array]) -> Array:
    """Largest difference of each output over its largest value."""
    difference = np.max(np.abs(np.array(found) - np.array(wanted)), axis=0)
    size = np.max(np.abs(np.array(wanted)), axis=0)
    return difference / np.where(size > 0.0, size, 1.0)


def both(**changes: Any) -> tuple[HypoidAxle, Train, float]:
    """An axle and its train in one state at rest, and the torque of the wheel."""
    given = replace(AXLE, **changes)
    axle, train = HypoidAxle(given), axle_train(given)
    wheel = TORQUE * given.mesh.ratio
    axle.initialise(pinion_speed=SPEED, pinion_torque=TORQUE, wheel_torque=wheel,
                    oil_temperature=KELVIN)  # fmt: skip
    train.initialise({"pinion": SPEED}, {"input": TORQUE, "output": wheel}, KELVIN)
    train.set_state(train_state(train, axle))
    return axle, train, wheel


@pytest.mark.slow
def test_outputs_in_states_by_chance_are_those_of_the_train():
    """Some 10 % about a motion, teeth parted in some; drag then lies beyond what is kept."""
    axle, train, wheel = both(**LOSSES)
    for _ in range(5):
        axle.step(1e-4, TORQUE, wheel, KELVIN)
    chance, before = np.random.default_rng(5), axle.get_state()
    found, wanted = [], []
    for k in range(60):
        s = before.copy()
        s[:N_ODE] *= 1.0 + 0.1 * chance.normal(size=N_ODE)
        if k % 6 == 0:
            s[X] = chance.uniform(-120.0, -20.0)
        axle.set_state(s)
        train.set_state(train_state(train, axle))
        found.append(np.array([*axle_values(train).values()]))
        wanted.append(axle.outputs.copy())
    left = worst(found, wanted)
    assert np.max(left) < 1e-12, OUTPUT_NAMES[int(np.argmax(left))]
    separated = np.array(wanted)[:, OUTPUT_NAMES.index("mesh.separated")]
    assert 0.0 < np.mean(separated) < 0.5


@pytest.mark.slow
def test_the_train_moves_as_the_axle_and_loses_what_it_is_given():
    changes = {"pinion_seal_torque": 0.15, "churning": "boness_1989"}
    axle, train, wheel = both(**changes)
    start, errors = train.energy, []

    def step(h: float, share: float, share_of_wheel: float) -> None:
        pinion, load = TORQUE * share, wheel * share_of_wheel
        axle.step(h, pinion, load, KELVIN)
        train.step(h, {"input": pinion, "output": load}, KELVIN)
        errors.append((axle.output("mesh.dte"), train.outputs()["mesh.dte"]))

    for k in range(200):
        step(1e-4, 1.0 + 0.5 * math.sin(0.1 * k), 1.0)
    alone, listed = np.array(errors).T
    # the same steps by the same kernels: round-off of micrometres and sums, 4e-14 was found
    assert np.max(abs(listed - alone)) < 1e-11 * np.ptp(alone)
    found = train.outputs()
    thinnest = min(
        film for i in range(1, PAIRS + 1) if (film := axle.output(f"flank[{i}].film_thickness"))
    )
    assert found["mesh.film_thickness_min"] == pytest.approx(thinnest, rel=1e-9)
    assert found["mesh.coast_contact"] == 0.0
    assert found["efficiency"] == pytest.approx(axle.output("axle.efficiency"), rel=1e-9)
    missing = train.work - sum(train.lost.values()) - (train.energy - start)
    assert abs(missing) < 1e-5 * TORQUE * SPEED * 0.02
    # torques change sign: teeth part, meet on the coast flanks and bounce, shafts leap
    # and grow, so that the stiffer mesh asks for more steps
    errors.clear()
    for h, share, times in ((1e-4, -0.7, 100), (1e-3, 4.0, 10)):
        for _ in range(times):
            step(h, share, share)
    alone, listed = np.array(errors).T
    assert np.min(alone) < -1e-4
    # bouncing teeth enlarge what the same kernels leave some hundred times; 2e-15 was found
    assert np.max(abs(listed - alone)) < 1e-11 * np.ptp(alone)


@pytest.mark.slow
@pytest.mark.parametrize("changes", [{}, LOSSES, SOLVED], ids=["default", "losses", "solved"])
def test_all_outputs_of_the_axle_are_those_of_its_train(changes):
    """In the same state, after each step; then on their own way, through a reversal."""
    axle, train, wheel = both(**changes)
    found, wanted = [], []
    for k in range(60):
        share = 1.0 if k < 20 else -0.7
        axle.step(1e-4, share * TORQUE, share * wheel, KELVIN)
        if k < 40:
            train.set_state(train_state(train, axle))
        else:
            train.step(1e-4, {"input": share * TORQUE, "output": share * wheel}, KELVIN)
        values = axle_values(train)
        assert tuple(values) == OUTPUT_NAMES
        found.append(np.array([*values.values()]))
        wanted.append(axle.outputs.copy())
    # micrometres and sums round; 4e-16 was found
    left = worst(found[:40], wanted[:40])
    assert np.max(left) < 1e-12, OUTPUT_NAMES[int(np.argmax(left))]
    # what rounds is enlarged by teeth that bounce and by the slopes of what is kept
    left = worst(found[40:], wanted[40:])
    assert np.max(left) < 1e-7, OUTPUT_NAMES[int(np.argmax(left))]


def changed_model(name: str) -> FilmModel:
    model = FilmModel.named(name)
    return replace(model, numbers=1.001 * model.numbers)


OTHER_BEARING = replace(AXLE.bearing, loss=0.02)
# another value of each option, and the options without which it says nothing
OPTIONS: dict[str, tuple[Any, dict[str, Any]]] = {
    "frequency_floor": (40.0, {}),
    "hysteretic_loss": (0.01, {}),
    "pinion_inertia": (0.002, {}),
    "gear_inertia": (0.06, {}),
    "pinion_mass": (13.0, {}),
    "gear_mass": (50.0, {}),
    "backlash": (1e-4, {}),
    "pinion_seal_torque": (0.1, {}),
    "wheel_seal_torque": (0.1, {}),
    "mesh": (replace(AXLE.mesh, torque=1.1 * AXLE.mesh.torque), {}),
    "bearing": (OTHER_BEARING, {}),
    "gear_bearing": (OTHER_BEARING, {}),
    "oil": (replace(AXLE.oil, density=AXLE.oil.density + 10.0), {}),
    "solid": (replace(AXLE.solid, youngs_modulus=2e11), {}),
    "roughness_rms": (6e-7, {}),
    "xi_beta_sigma": (0.05, {}),
    "sigma_over_beta": (0.002, {}),
    "equations": ("as_printed", {}),
    "radii": ("paper", {}),
    "mesh_stiffness": ("secant", {}),
    "mesh_damping": ("modal", {}),
    "modal_loss_factor": (0.05, {"mesh_damping": "modal"}),
    "friction": ("off", {}),
    "film": ("solved", {}),
    "flank_film_model": (changed_model("hypoid_flank"), SOLVED),
    "roller_film_model": (changed_model("roller_race"), SOLVED),
    "film_limiting_slope": (0.05, SOLVED),
    "flank_bulk_resistance": (0.1, {}),
    "rolling": ("biboulet_houpert_2010", {}),
    "bearing_torque_loss": ("skf_2013", {}),
    "churning": ("boness_1989", {}),
    "ring_diameter": (0.17, {"churning": "boness_1989"}),
    "ring_width": (0.031, {"churning": "boness_1989"}),
    "immersion": (0.05, {"churning": "boness_1989"}),
    "oil_volume": (1.3e-3, {"churning": "changenet_velex_2007"}),
    "steps_per_mesh_period": (60, {}),
    "steps_per_highest_period": (20, {}),
}
REFUSED = ("equations", "flank_bulk_resistance")


def everything(given: HypoidAxleParameters) -> Array:
    """All numbers that a train computes with."""
    train = axle_train(given)
    made = train.assembly
    return np.concatenate([made.numbers, made.memory, made.plan, [train.steps_per_highest_period]])


def test_every_option_of_the_axle_is_honoured_or_refused():
    assert list(OPTIONS) == [one.name for one in fields(HypoidAxleParameters)]
    for name, (value, others) in OPTIONS.items():
        before = replace(AXLE, **others)
        after = replace(before, **{name: value})
        if name in REFUSED:
            with pytest.raises(ParameterError, match=name):
                axle_train(after)
            continue
        one, other = everything(before), everything(after)
        assert one.shape != other.shape or not np.array_equal(one, other, equal_nan=True), name
