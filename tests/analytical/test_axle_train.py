"""The hypoid axle as a train against `HypoidAxle`: all outputs, and every option."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.output_names import OUTPUT_NAMES
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.dynamics.train.hypoid_axle import axle_train, axle_values
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.model import FilmModel
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


@pytest.mark.slow
@pytest.mark.parametrize("changes", [{}, LOSSES, SOLVED], ids=["default", "losses", "solved"])
def test_all_outputs_of_the_axle_are_those_of_its_train(changes):
    """In the same state, after each step; then on their own way, through a reversal."""
    given = replace(AXLE, **changes)
    axle, train = HypoidAxle(given), axle_train(given)
    wheel = TORQUE * given.mesh.ratio
    axle.initialise(pinion_speed=SPEED, pinion_torque=TORQUE, wheel_torque=wheel,
                    oil_temperature=KELVIN)  # fmt: skip
    train.initialise({"pinion": SPEED}, {"input": TORQUE, "output": wheel}, KELVIN)
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
