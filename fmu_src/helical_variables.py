"""The variables of HelicalPair.fmu: the one list that everything else is made from.

The value reference of a variable is its place in `HELICAL_PAIR`. Released references never change:
append new variables at the end, never insert, reorder or remove. What the model's files declare
stands behind, as in `variables`.
"""

from __future__ import annotations

from functools import partial
from typing import get_args

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
    tilt_speeds,
    velocities,
)
from gearlube_core.dynamics.helical_model.outputs import OWN_OUTPUTS, STATE_NAMES
from gearlube_core.dynamics.helical_pair.march.gear_file_march import (
    STIFFNESS_DENSITY,
    ReplacedBearings,
)
from gearlube_core.dynamics.helical_pair.march.parameters import Friction, HelicalMarchParameters
from gearlube_core.friction.flank_laws import FILM_MODELS

_number = partial(declared, HelicalMarchParameters)
_support = partial(declared, ReplacedBearings)
CUSTOM, LINE_MESH = "custom", "line_mesh"  # literals with a meaning to the model's start

_INPUTS = (
    input_("pinion.torque", "N.m", "Torque on the pinion shaft, positive when it drives",
           start=225.97, minimum=-1e5, maximum=1e5, nominal=100.0),
    input_("wheel.torque", "N.m", "Load torque on the gear shaft, positive against forward motion",
           start=280.2028, minimum=-1e5, maximum=1e5, nominal=100.0),
    input_("oil.temperature", "K", "Bulk oil temperature", display_unit="degC",
           start=333.15, minimum=273.15, maximum=423.15, nominal=300.0),
)  # fmt: skip

_PARAMETERS = (
    option("gear.name", "Gear pair; custom takes the gear file inside the FMU",
           "he_2007", "jamali_2015_a", "jamali_2015_b", CUSTOM, start="he_2007",
           argument="gear_name"),
    parameter("pinion.speed_start", "rad/s", "Initial speed of the pinion",
              display_unit="rpm", start=104.71975511965977, minimum=-5e3, maximum=5e3,
              nominal=100.0, argument="pinion_speed"),
    option("friction.model", "Flank friction: mixed film at every contact point, or Coulomb",
           *get_args(Friction), start="film", argument="friction"),
    _number("friction_coefficient", "friction.coefficient",
            "Coefficient of friction when friction.model = constant", nominal=0.1),
    oil_name(),
    _number("roughness_rms", "flank.roughness_rms",
            "Composite root-mean-square roughness of the flanks", display_unit="um", nominal=1e-6),
    _number("backlash", "mesh.backlash", "Normal backlash along the line of action",
            display_unit="um", start=100e-6, nominal=1e-4),
    option("mesh.stiffness_model",
           "Tooth stiffness: uniform along all contact lines, or from a loaded contact analysis "
           "(shipped for he_2007, or a file inside the FMU)",
           "uniform", LINE_MESH, start="uniform", argument="stiffness_model"),
    parameter("mesh.stiffness_density", "N/m2",
              "Stiffness per length of contact line, if uniform; 0 takes ISO 6336-1",
              display_unit="N/(mm.um)", start=0.0, minimum=STIFFNESS_DENSITY.low,
              maximum=STIFFNESS_DENSITY.high, nominal=1e10, argument="stiffness_density"),
    _number("mesh_damping_ratio", "mesh.damping_ratio", "Damping ratio of the relative rotation",
            nominal=0.1),
    _number("support_damping_ratio", "support.damping_ratio",
            "Damping ratio of all motions on the bearings", nominal=0.1),
    *(_support(f"{along}_stiffness", f"support.{along}_stiffness", f"{along.capitalize()} "
               "stiffness of both bearings of a shaft together; 0 takes the gear data",
               nominal=1e9)
      for along in ("radial", "axial")),
    _support("bearing_distance", "support.bearing_distance",
             "Distance of each bearing from mid-face; 0 takes the gear data", display_unit="mm",
             nominal=0.1),
    option("model.form", "Degrees of freedom; six_dof has no axial motion and no tilt",
           "twelve_dof", "six_dof", start="twelve_dof", argument="form"),
    option("model.equations",
           "Equations of motion: with the work of moving contact lines, or as in the paper",
           "consistent", "he_2007", start="consistent", argument="equations"),
    _number("steps_per_mesh_period", "solver.steps_per_mesh_period",
            "Integration steps in one mesh period"),
    _number("steps_per_highest_period", "solver.steps_per_highest_period",
            "Integration steps in one period of the highest natural frequency"),
    _number("friction_updates_per_mesh_period", "friction.updates_per_mesh_period",
            "Updates of the film friction in one mesh period"),
)  # fmt: skip


_MESH = (
    output("mesh.dte", "m",
           "Dynamic transmission error along the line of action, with shaft deflection; "
           "positive when the drive flanks are in contact", 1e-5, "um"),
    output("mesh.load", "N", "Load normal to the flanks: drive flanks minus coast flanks",
           1e3, "kN"),
    *(output(f"mesh.force.{axis}", "N", f"Force of the flanks on the pinion along {axis}",
             1e3, "kN") for axis in "xyz"),
    Variable(name="mesh.separated", type="Boolean", causality="output",
             description="True while the teeth are separated: no flank in contact"),
    Variable(name="mesh.coast_contact", type="Boolean", causality="output",
             description="True while coast flanks are in contact"),
    output("mesh.stiffness", "N/m", "Mesh stiffness along the line of action, flanks in contact",
           1e8),
    output("mesh.frequency", "Hz", "Mesh frequency: pinion teeth times turns per second", 100.0),
    output("mesh.film_thickness_min", "m", "Thinnest central film of all contact lines",
           1e-6, "um"),
)  # fmt: skip


def _line(i: int) -> tuple[Variable, ...]:
    line = f"of contact line {i}"
    return (
        output(f"line[{i}].load", "N", f"Normal load {line}", 1e3, "kN"),
        output(f"line[{i}].length", "m", f"Length {line}", 1e-2, "mm"),
        output(f"line[{i}].film_thickness_min", "m", f"Thinnest central film {line}", 1e-6, "um"),
        output(f"line[{i}].film_thickness_mean", "m", f"Mean central film {line}", 1e-6, "um"),
        output(f"line[{i}].film_ratio", "1", f"Film ratio (least film over roughness) {line}"),
        output(f"line[{i}].friction_coefficient", "1", f"Mean friction coefficient {line}", 0.05),
        output(f"line[{i}].sliding_speed", "m/s", f"Mean sliding speed {line}"),
        output(f"line[{i}].temperature", "K", f"Mean film temperature {line}", 300.0, "degC"),
    )


_MEAN = "mean over the communication step"
_LOSSES = (
    output("friction.power_loss", "W", "Power lost in flank friction", 100.0),
    output("damping.power_loss", "W", "Power lost in the mesh damping", 10.0),
    output("bearing.power_loss", "W", "Power lost in the damping of the bearings", 10.0),
    output("efficiency", "1", f"Efficiency of the gear mesh alone, {_MEAN}"),
    output("pair.efficiency", "1", f"Efficiency of the pair with all losses, {_MEAN}"),
)


def _moved(member: str, word: str) -> tuple[Variable, ...]:
    tilts = (output(f"{member}.tilt.{axis}", "rad", f"Tilt of the {word} about {axis}", 1e-4, "deg")
             for axis in "xy")  # fmt: skip
    return (*displacements(member, word), *tilts)


def _bearing(j: int) -> tuple[Variable, ...]:
    where = f"bearing {j}"
    return tuple(
        output(f"bearing[{j}].force.{axis}", "N", f"Force on the shaft along {axis}, {where}",
               1e3, "kN")
        for axis in "xyz"
    )  # fmt: skip


_ENERGIES = energies(
    {
        "pinion_work": "Work of the pinion torque on the pair since initialisation",
        "wheel_work": "Work of the pair against the wheel torque since initialisation",
        "friction": "Heat of flank friction since initialisation",
        "mesh_damping": "Heat of mesh damping since initialisation",
        "bearing_damping": "Heat of bearing damping since initialisation",
        "stored": "Kinetic and elastic energy in the pair",
    }
)

_FIRST: tuple[Variable, ...] = (
    *_INPUTS,
    *_PARAMETERS,
    *motion(),
    *_MESH,
    *(variable for i in (1, 2, 3, 4, 5, 6) for variable in _line(i)),
    *_LOSSES,
    *(variable for member in MEMBERS for variable in _moved(*member)),
    *(variable for j in (1, 2, 3, 4) for variable in _bearing(j)),
    *_ENERGIES,
    *ranges(),
    *options_by_number(_PARAMETERS),
)

# what model exchange needs besides
_STATES = (
    local("mesh.rotation", "m", "Base radius times rotation: pinion minus gear",
          1e-5, "um"),
    *(one for member in MEMBERS for one in (*velocities(*member), *tilt_speeds(*member))),
    load_level(),
)  # fmt: skip
_BY_NAME = {variable.name: variable for variable in _FIRST + _STATES}
_EVENTS = (
    local("event.drive_flank", "1", "Drive flanks can be in contact when this is above 0: upper "
          "bound of their deflection over 1 um"),
    local("event.coast_flank", "1", "Coast flanks can be in contact when this is above 0: upper "
          "bound of their deflection over 1 um"),
    local("event.friction_update", "1", "The film friction is updated when this changes sign: "
          "sine of pi times the number of updates since phase zero"),
)  # fmt: skip

# films by a model of solved films, youngest
_FILM = (
    option("film.model", "Film and oil friction of the flanks: by formulas, or by a model of "
           "solved films", *FILM_MODELS, start="formula", argument="film"),
    _number("film_limiting_slope", "film.limiting_slope", "Limiting shear stress of a solved film "
            "over pressure; 0: none. Near it formulas are used", nominal=0.1),
)  # fmt: skip
_FILM_OUTPUTS = (
    output("film.share_outside", "1", "Share of the load on the contact lines outside the domain "
           "of the model of solved films; 0 with formulas"),
    *(output(f"line[{i}].{name}_bound", "1", f"Bound of the {words} of contact line {i}, relative; "
             "0 with formulas", 0.05)
      for i in (1, 2, 3, 4, 5, 6)
      for name, words in (("film", "film thickness"), ("friction", "friction"))),
    output("friction.power_loss_bound", "W", "Bound of friction.power_loss by those of the lines; "
           "0 with formulas", 10.0),
    output("efficiency_bound", "1", "Bound of efficiency by friction.power_loss_bound", 0.001),
)  # fmt: skip

_LISTED: tuple[Variable, ...] = (
    *_FIRST,
    *_STATES,
    *rates([_BY_NAME[name] for name in STATE_NAMES]),
    *_EVENTS,
    *_FILM,
    *options_by_number(_FILM),
    *_FILM_OUTPUTS,
)

# parameters and outputs that the model's files declare: names of the released ones, in their order
_RELEASED = "friction.boundary_friction", "friction.share_exponent"
HELICAL_PAIR = _LISTED + in_order(
    _RELEASED,
    *declared_in(HelicalMarchParameters, {one.argument for one in _LISTED}),
    *declared_outputs(OWN_OUTPUTS),
    *speed_hold(104.71975511965977),
)
