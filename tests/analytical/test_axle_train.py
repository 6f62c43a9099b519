"""The hypoid axle against its train by the other driver, and every option of it."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.as_train import axle_train, axle_values, hypoid_axle
from gearlube_core.dynamics.hypoid_axle.output_names import OUTPUT_NAMES
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.shafts.section import ShaftDisc, ShaftSection

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


def both(**changes: Any) -> tuple[HypoidAxle, Train, float]:
    """An axle and its train in one state at rest, and the torque of the wheel."""
    given = replace(AXLE, **changes)
    axle, train = HypoidAxle(given), axle_train(given)
    wheel = TORQUE * given.mesh.ratio
    axle.initialise(pinion_speed=SPEED, pinion_torque=TORQUE, wheel_torque=wheel,
                    oil_temperature=KELVIN)  # fmt: skip
    rate = axle.step_control.least_rate
    train.set_state(np.concatenate([axle.state_view, [KELVIN, rate]]))
    return axle, train, wheel


@pytest.mark.slow
@pytest.mark.parametrize("changes", [{}, LOSSES, SOLVED], ids=["default", "losses", "solved"])
def test_the_axle_moves_as_its_train_and_loses_what_it_is_given(changes):
    """Through a reversal: teeth part, meet on the coast flanks and bounce, shafts leap."""
    axle, train, wheel = both(**changes)
    start = train.energy
    for k in range(60):
        share = 1.0 if k < 20 else -0.7
        axle.step(1e-4, share * TORQUE, share * wheel, KELVIN)
        train.step(1e-4, {"input": share * TORQUE, "output": share * wheel}, KELVIN)
        # one code for all lists against that of this list: the same bits
        np.testing.assert_array_equal([*axle_values(train).values()], axle.outputs)
    assert tuple(axle_values(train)) == OUTPUT_NAMES
    found = train.outputs()
    films = [axle.output(f"flank[{i}].film_thickness") for i in range(1, PAIRS + 1)]
    thinnest = min((one for one in films if one), default=0.0)
    assert found["mesh.film_thickness_min"] == pytest.approx(thinnest, rel=1e-9)
    assert min(axle.output("mesh.dte"), 0.0) < 0.0
    missing = train.work - sum(train.lost.values()) - (train.energy - start)
    # the stiffness follows the load level without work: 5e-6 of what is put in, at any step
    assert abs(missing) < 1e-5 * TORQUE * SPEED * 0.006


def rigid_shaft(body: Body) -> Shaft:
    """A short rod with a disc: a shaft without modes of the mass and inertia of a body."""
    rod = ShaftSection(start=-0.01, end=0.01, outer_diameter=0.02)
    mass = 7850.0 * rod.area * 0.02
    polar = body.polar_inertia - 0.5 * mass * 0.01**2
    disc = ShaftDisc(position=0.0, mass=body.mass - mass, inertia=0.6 * polar, polar_inertia=polar)
    return Shaft(name=body.name, sections=(rod,), discs=(disc,), nodes={"centre": 0.0},
                 highest_frequency=0.0)  # fmt: skip


def test_the_axle_on_nodes_of_rigid_shafts_is_the_axle():
    """Shafts may tilt where bodies of the axle do not; no force of it tilts them."""
    bodies, elements = hypoid_axle(AXLE)
    on_nodes: list[Any] = []
    for one in elements:
        places = {name: f"{getattr(one, name)}.centre" for name in one.on}
        on_nodes.append(replace(one, **places))
    # below the highest frequency of the axle, so that the steps are the same
    tilt = {"K_ax": 1e5, "K_ay": 1e5}
    for body in bodies:
        on_nodes.append(SpringSupport(name=f"{body.name} tilt", body=f"{body.name}.centre", **tilt))
    steps = AXLE.steps_per_highest_period
    shafts = [rigid_shaft(one) for one in bodies]
    on_shafts = Train(shafts, on_nodes, AXLE.oil, steps_per_highest_period=steps)
    axle = axle_train(AXLE)
    torques = {"input": TORQUE, "output": TORQUE * AXLE.mesh.ratio}
    for one in (axle, on_shafts):
        one.initialise({"pinion": SPEED}, torques, KELVIN)
        for _ in range(20):
            one.step(1e-3, torques, KELVIN)
    found, wanted = on_shafts.outputs(), axle.outputs()
    # arms and inertias of the shafts are rounded in other places
    for name in (n for n in wanted if n.split(".")[-1] != "acceleration"):
        assert found[name] == pytest.approx(wanted[name], rel=1e-11, abs=1e-18), name
    for name in ("pinion.acceleration", "gear.acceleration"):  # differences of large forces
        assert found[name] == pytest.approx(wanted[name], rel=1e-10), name


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
    "hub_torque": (0.1, {}),
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
REFUSED = ("flank_bulk_resistance",)


def everything(given: HypoidAxleParameters) -> Array:
    """All numbers that a train computes with."""
    train = axle_train(given)
    made = train.assembly
    return np.concatenate([made.numbers, made.memory, made.plan, [train.steps_per_highest_period]])


@pytest.mark.slow
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
