"""The variables of HypoidAxle.fmu: the one list that everything else is made from.

The value reference of a variable is its place in `HYPOID_AXLE`. Released references never change:
append new variables at the end, never insert, reorder or remove. A number of the model that
declares an FMI name (`Number.fmi`), and an output that is declared beside its kernel, need no line
here: they stand behind the listed ones. A release freezes their order in `_RELEASED`.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any, get_args

from fmu_src.variable import (
    MEMBERS,
    Variable,
    declared,
    declared_in,
    declared_outputs,
    displacements,
    energies,
    in_order,
    input_,
    load_level,
    local,
    motion,
    oil_name,
    option,
    options_by_number,
    output,
    parameter,
    ranges,
    rates,
    speed_hold,
    velocities,
)
from gearlube_core.bearings.followed_shaft import TORQUE_LOSSES
from gearlube_core.bearings.losses.laws import DEFAULT_LAW
from gearlube_core.bearings.tapered_roller_bearing import PRELOAD, Approach, TaperedRollerBearing
from gearlube_core.drag import CHURNING_LAWS
from gearlube_core.dynamics.hypoid_axle.output_names import OWN_OUTPUTS, STATE_NAMES
from gearlube_core.dynamics.hypoid_mesh.parameters import (
    Equations,
    HypoidAxleParameters,
    MeshDamping,
    MeshStiffness,
    Radii,
)
from gearlube_core.friction.flank_friction import friction_laws
from gearlube_core.friction.flank_laws import FILM_MODELS, MixedFriction
from gearlube_core.friction.flank_rolling import FLANK_ROLLING_LAWS

_number = partial(declared, HypoidAxleParameters)
# variants of one law in the package: an FMU is compiled for the law of its axle file
FRICTION_VARIANTS = tuple(
    name
    for name, law in friction_laws().items()
    if issubclass(law, MixedFriction) and law.__module__.startswith("gearlube_core.")
)


def _of_bearing(number: str, name: str, word: str, text: str, **shown: Any) -> Variable:
    """Return a number of the tapered roller bearings of a shaft."""
    return replace(
        declared(TaperedRollerBearing, number, f"{name}.bearing.{number}", text, **shown),
        argument=f"{word}_bearing_{number}",
    )


SHARED_PRELOAD = -1.0  # N, start value of the preload of the gear's shaft: that of the pinion's

_INPUTS = (
    input_("pinion.torque", "N.m", "Torque on the pinion shaft, positive when it drives; an "
           "error beyond 1.5 times the largest torque of the mesh table",
           start=60.0, minimum=-1e4, maximum=1e4, nominal=100.0),
    input_("wheel.torque", "N.m", "Load torque on the gear shaft, positive against forward motion",
           start=160.0, minimum=-3e4, maximum=3e4, nominal=300.0),
    input_("oil.temperature", "K", "Bulk oil temperature", display_unit="degC",
           start=313.15, minimum=273.15, maximum=423.15, nominal=300.0),
)  # fmt: skip

_PARAMETERS = (
    parameter("bearing.preload", "N", "Axial preload of each bearing; see wheel.bearing.preload",
              display_unit="kN", start=2500.0, minimum=PRELOAD.low, maximum=PRELOAD.high,
              nominal=1e3, argument="bearing_preload"),
    _number("roughness_rms", "flank.roughness_rms",
            "Composite root-mean-square roughness of the flanks",
            display_unit="um", start=0.5e-6, nominal=1e-6),
    _number("backlash", "mesh.backlash", "Total backlash 2 b along the line of action",
            display_unit="um", start=150e-6, nominal=1e-4),
    parameter("pinion.speed_start", "rad/s", "Initial speed of the pinion",
              display_unit="rpm", start=200.0, minimum=-5e3, maximum=5e3, nominal=100.0,
              argument="pinion_speed"),
    _number("modal_loss_factor", "mesh.modal_loss_factor",
            "Loss factor of the mesh when mesh.damping = modal", nominal=0.1),
    option("model.equations", "Equations of motion: misprints corrected, or as printed",
           *get_args(Equations), start="consistent", argument="equations"),
    option("model.radii", "Lever arms of the mesh force",
           *get_args(Radii), start="consistent", argument="radii"),
    option("mesh.damping", "Law of the mesh damping", *get_args(MeshDamping), start="hysteretic",
           argument="mesh_damping"),
    option("friction.model", "Model of the flank friction",
           *FRICTION_VARIANTS, start="consistent", argument="friction"),
    option("bearing.approach", "Formula of the roller deflection under shaft displacement",
           *get_args(Approach), start="full", argument="bearing_approach"),
    option("bearing.torque_loss", "Drag torque of the bearings",
           *TORQUE_LOSSES, start=DEFAULT_LAW, argument="bearing_torque_loss"),
    oil_name(),
    _number("steps_per_mesh_period", "solver.steps_per_mesh_period",
            "Integration steps in one mesh period"),
    _number("steps_per_highest_period", "solver.steps_per_highest_period",
            "Integration steps in one period of the highest natural frequency"),
)  # fmt: skip


_MESH = (
    output("mesh.dte", "m", "Dynamic transmission error, positive with the drive flank in contact",
           1e-5, "um"),
    output("mesh.force", "N", "Dynamic mesh force", 1e3, "kN"),
    Variable(name="mesh.separated", type="Boolean", causality="output",
             description="True while the teeth are separated: no flank in contact"),
    output("mesh.stiffness", "N/m", "Mesh stiffness at the current mesh phase", 1e8),
    output("mesh.frequency", "Hz", "Mesh frequency: pinion teeth times turns per second", 100.0),
)  # fmt: skip


def _flank(i: int) -> tuple[Variable, ...]:
    pair = f"of tooth pair {i}"
    return (
        output(f"flank[{i}].load", "N", f"Load {pair}", 1e3, "kN"),
        output(f"flank[{i}].film_thickness", "m", f"Central film thickness {pair}", 1e-6, "um"),
        output(f"flank[{i}].film_ratio", "1", f"Film ratio (film thickness over roughness) {pair}"),
        output(f"flank[{i}].friction_coefficient", "1", f"Friction coefficient {pair}", 0.05),
        output(f"flank[{i}].temperature", "K", f"Film temperature {pair}", 300.0, "degC"),
    )


_MEAN = "mean over the communication step"
_LOSSES = (
    output("friction.power_loss", "W", "Power lost in flank friction, viscous and boundary", 100.0),
    output("friction.power_loss_boundary", "W", "Power lost in boundary friction of flanks", 10.0),
    output("bearing.power_loss", "W", "Power lost in the drag of all four bearings", 100.0),
    output("damping.power_loss", "W", "Power lost in the damping of mesh and rollers", 10.0),
    output("efficiency", "1", f"Efficiency of the gear mesh alone, {_MEAN}"),
    output("axle.efficiency", "1", f"Efficiency of the axle with all losses, {_MEAN}"),
)


def _bearing(j: int) -> tuple[Variable, ...]:
    described = {f"force.{axis}": f"Force on the shaft along {axis}" for axis in "xyz"} | {
        "roller_load_max": "Largest roller load",
        "roller_load_min": "Smallest roller load",
    }
    return tuple(
        output(f"bearing[{j}].{name}", "N", f"{words}, bearing {j}", 1e3, "kN")
        for name, words in described.items()
    )


_ROLLERS = (
    output("bearing[1].roller[1].load", "N", "Load of roller 1 of bearing 1", 1e3, "kN"),
    output("bearing[1].cage.angle", "rad", "Cage rotation of the pinion bearings",
           display_unit="deg"),
    output("bearing[3].cage.angle", "rad", "Cage rotation of the gear bearings",
           display_unit="deg"),
)  # fmt: skip

_ENERGIES = energies(
    {
        "pinion_work": "Work of the pinion torque on the axle since initialisation",
        "wheel_work": "Work of the axle against the wheel torque since initialisation",
        "friction_viscous": "Heat of viscous flank friction since initialisation",
        "friction_boundary": "Heat of boundary flank friction since initialisation",
        "mesh_damping": "Heat of mesh damping since initialisation",
        "bearing_damping": "Heat of roller damping since initialisation",
        "bearing_torque": "Heat of bearing drag torque since initialisation",
        "stored": "Kinetic and elastic energy in the axle",
    }
)

# parameters younger than the first release: appended, so that value references stay
_LATER_PARAMETERS = (
    option("model.mesh_stiffness", "Mesh stiffness: tangent at the current load, or secant",
           *get_args(MeshStiffness), start="tangent", argument="mesh_stiffness"),
)  # fmt: skip

# the same; those that an axle file gives too
_AXLE_NUMBERS = (
    *(_number(f"{word}_mass", f"{name}.mass", f"Mass of the {word} with its shaft and parts",
              start=start, nominal=10.0)
      for (name, word), start in zip(MEMBERS, (12.0, 49.9), strict=True)),
    *(_number(f"{word}_inertia", f"{name}.inertia",
              f"Inertia of the {word} with its shaft and parts", start=start, nominal=0.01)
      for (name, word), start in zip(MEMBERS, (1734e-6, 5.81e-2), strict=True)),
    parameter("wheel.bearing.preload", "N", "Axial preload of each bearing of the gear shaft; "
              "a negative value takes bearing.preload", display_unit="kN",
              start=SHARED_PRELOAD, minimum=SHARED_PRELOAD, maximum=PRELOAD.high,
              nominal=1e3, argument="gear_bearing_preload"),
    *(_of_bearing("contact_angle", name, word, f"Contact angle of the bearings of the {word} "
                  "shaft, at the outer race", display_unit="deg", start=math.radians(15.0),
                  minimum=math.radians(5.0), nominal=0.1)
      for name, word in MEMBERS),
    *(_of_bearing(factor, name, word, f"{words} of the bearing drag on the {word} shaft",
                  start=start)
      for factor, words, start in (("f0", "Viscous factor", 6.0), ("f1", "Load factor", 4e-4))
      for name, word in MEMBERS),
)  # fmt: skip

_FIRST: tuple[Variable, ...] = (
    *_INPUTS,
    *_PARAMETERS,
    *motion(),
    *_MESH,
    *(variable for i in (1, 2, 3) for variable in _flank(i)),
    *_LOSSES,
    *(variable for member in MEMBERS for variable in displacements(*member)),
    *(variable for j in (1, 2, 3, 4) for variable in _bearing(j)),
    *_ROLLERS,
    *_ENERGIES,
    *_LATER_PARAMETERS,
    *ranges(),
    *options_by_number(_PARAMETERS + _LATER_PARAMETERS),
    *_AXLE_NUMBERS,
)

# what model exchange needs besides
_STATES = (*(one for member in MEMBERS for one in velocities(*member)), load_level())
_BY_NAME = {variable.name: variable for variable in _FIRST + _STATES}
_EVENTS = (
    local("event.drive_flank", "1", "Drive flanks are in contact when this is 0 or more: "
          "transmission error over 1 um"),
    local("event.coast_flank", "1", "Coast flanks are in contact when this is 0 or less: "
          "transmission error plus backlash, over 1 um"),
    local("event.side", "1", "The model takes the mesh data of the coast flanks after this falls "
          "below 0: position within the backlash over 1 um"),
)  # fmt: skip

# churning and seals, younger than the rest
_DRAG = (
    option("churning.model", "Law of the churning loss of the gear", *CHURNING_LAWS,
           start="none", argument="churning"),
    _number("ring_diameter", "churning.ring_diameter", "Outside diameter of the gear",
            display_unit="mm", nominal=0.1),
    _number("ring_width", "churning.ring_width", "Width of the teeth of the gear",
            display_unit="mm", nominal=0.01),
    _number("immersion", "churning.immersion", "Depth of the lowest gear tooth below the oil at "
            "rest", display_unit="mm", nominal=0.01),
    _number("oil_volume", "churning.oil_volume", "Volume of the oil in the axle",
            display_unit="l", nominal=1e-3),
    *(_number(f"{name}_seal_torque", f"{name}.seal.torque", f"Friction torque of {words}")
      for name, words in (("pinion", "the pinion shaft seal"),
                          ("wheel", "the seals of both wheels, at the gear"))),
)  # fmt: skip
_DRAG_ENERGIES = energies(
    {
        "churning": "Heat of the churning of the gear since initialisation",
        "seals": "Heat of the shaft seals since initialisation",
    }
)
_DRAG_LOSSES = (
    output("churning.power_loss", "W", "Power lost by churning of the gear in the oil", 100.0),
    output("seal.power_loss", "W", "Power lost in the shaft seals", 10.0),
)

# rolling of the flanks, younger still
_ROLLING = (
    option("friction.rolling", "Law of the rolling loss of the flanks", *FLANK_ROLLING_LAWS,
           start="none", argument="rolling"),
)  # fmt: skip
_ROLLING_LOSSES = (
    output("friction.power_loss_rolling", "W",
           "Power lost in rolling of the flanks, not included in friction.power_loss", 10.0),
)  # fmt: skip
_ROLLING_ENERGIES = energies(
    {"friction_rolling": "Energy lost in rolling of the flanks since initialisation"}
)
# films by a model of solved films, youngest
_FILM = (
    option("film.model", "Film and oil friction of the flanks: by formulas, or by a model of "
           "solved films", *FILM_MODELS, start="formula", argument="film"),
    _number("film_limiting_slope", "film.limiting_slope", "Limiting shear stress of a solved film "
            "over pressure; 0: none. Near it formulas are used", nominal=0.1),
)  # fmt: skip
_FILM_OUTPUTS = (
    output("film.share_outside", "1", "Share of the flanks' load outside the domain of the model "
           "of solved films; 0 with formulas"),
    *(output(f"flank[{i}].{name}_bound", "1", f"Bound of the {words} of tooth pair {i}, relative; "
             "0 with formulas", 0.05)
      for i in (1, 2, 3)
      for name, words in (("film", "film thickness"), ("friction", "friction"))),
    output("friction.power_loss_bound", "W", "Bound of friction.power_loss by those of the flanks; "
           "0 with formulas", 10.0),
    output("efficiency_bound", "1", "Bound of efficiency by friction.power_loss_bound", 0.001),
)  # fmt: skip
# rollers by a model of solved films
_ROLLER_OUTPUTS = (
    output("bearing.share_outside", "1", "Share of the rollers' load outside the domain of the "
           "model of solved films; 0 with other laws than solved_films"),
    *(variable
      for j in (1, 2, 3, 4)
      for variable in (
          output(f"bearing[{j}].film_thickness", "m", f"Thinnest central film of the rollers in "
                 f"bearing {j}; 0 with other laws than solved_films", 1e-6, "um"),
          output(f"bearing[{j}].film_bound", "1", f"Bound of the film thickness of bearing {j}, "
                 "relative", 0.05),
      )),
    output("bearing.power_loss_bound", "W", "Bound of bearing.power_loss by the rolling of the "
           "rollers; 0 with other laws than solved_films", 10.0),
    output("axle.efficiency_bound", "1", "Bound of axle.efficiency by the films of flanks and "
           "rollers", 0.001),
)  # fmt: skip
_LATER_ENERGIES = _DRAG_ENERGIES + _ROLLING_ENERGIES
_LATER_STATES = tuple(variable.name for variable in _LATER_ENERGIES)
_BY_NAME |= {variable.name: variable for variable in _LATER_ENERGIES}

_LISTED: tuple[Variable, ...] = (
    *_FIRST,
    *_STATES,
    *rates([_BY_NAME[name] for name in STATE_NAMES if name not in _LATER_STATES]),
    *_EVENTS,
    *_DRAG,
    *options_by_number(_DRAG),
    *_DRAG_LOSSES,
    *_DRAG_ENERGIES,
    *rates(_DRAG_ENERGIES),
    *_ROLLING,
    *options_by_number(_ROLLING),
    *_ROLLING_LOSSES,
    *_ROLLING_ENERGIES,
    *rates(_ROLLING_ENERGIES),
    *_FILM,
    *options_by_number(_FILM),
    *_FILM_OUTPUTS,
    *_ROLLER_OUTPUTS,
)

# parameters and outputs that the model's files declare: names of the released ones, in their order
_RELEASED = ("wheel.hub.torque",)
HYPOID_AXLE = _LISTED + in_order(
    _RELEASED,
    *declared_in(HypoidAxleParameters, {one.argument for one in _LISTED}),
    *declared_outputs(OWN_OUTPUTS),
    *speed_hold(200.0),
)
