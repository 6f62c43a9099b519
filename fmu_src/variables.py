"""The variables of HypoidAxle.fmu: the one list that everything else is made from.

The value reference of a variable is its place in `HYPOID_AXLE`. Released references never change:
append new variables at the end, never insert, reorder or remove.
"""

from __future__ import annotations

from fmu_src.variable import Variable


def _input(name: str, unit: str, description: str, **limits: float | str) -> Variable:
    return Variable(
        name=name, type="Real", causality="input", unit=unit, description=description,
        **limits,  # type: ignore[arg-type]
    )  # fmt: skip


def _parameter(name: str, unit: str, description: str, **limits: float | str) -> Variable:
    return Variable(
        name=name, type="Real", causality="parameter", unit=unit, description=description,
        **limits,  # type: ignore[arg-type]
    )  # fmt: skip


def _option(name: str, description: str, *literals: str, start: str) -> Variable:
    return Variable(
        name=name, type="Enumeration", causality="parameter", description=description,
        start=1 + literals.index(start), literals=literals,
    )  # fmt: skip


def _count(name: str, description: str, start: int, minimum: int, maximum: int) -> Variable:
    return Variable(
        name=name, type="Integer", causality="parameter", description=description,
        start=start, minimum=minimum, maximum=maximum,
    )  # fmt: skip


def _output(
    name: str, unit: str, description: str, nominal: float = 1.0, display_unit: str = ""
) -> Variable:
    return Variable(
        name=name, type="Real", causality="output", unit=unit, description=description,
        nominal=nominal, display_unit=display_unit,
    )  # fmt: skip


_INPUTS = (
    _input("pinion.torque", "N.m", "Torque on the pinion shaft; positive drives",
           start=60.0, minimum=-1e4, maximum=1e4, nominal=100.0),
    _input("wheel.torque", "N.m", "Load torque on the gear shaft; positive resists forward motion",
           start=160.0, minimum=-3e4, maximum=3e4, nominal=300.0),
    _input("oil.temperature", "K", "Bulk oil temperature", display_unit="degC",
           start=313.15, minimum=273.15, maximum=423.15, nominal=300.0),
)  # fmt: skip

_PARAMETERS = (
    _parameter("bearing.preload", "N", "Axial preload of each bearing pair", display_unit="kN",
               start=2500.0, minimum=0.0, maximum=1e5, nominal=1e3),
    _parameter("flank.roughness_rms", "m", "Composite root-mean-square roughness of the flanks",
               display_unit="um", start=0.5e-6, minimum=1e-9, maximum=2e-5, nominal=1e-6),
    _parameter("mesh.backlash", "m", "Total backlash along the line of action, 2 b",
               display_unit="um", start=150e-6, minimum=0.0, maximum=2e-3, nominal=1e-4),
    _parameter("pinion.speed_start", "rad/s", "Speed of the pinion at the start",
               display_unit="rpm", start=200.0, minimum=-5e3, maximum=5e3, nominal=100.0),
    _parameter("mesh.modal_loss_factor", "1", "Loss factor of the mesh when mesh.damping = modal",
               start=0.06, minimum=0.0, maximum=1.0, nominal=0.1),
    _option("model.equations", "Equations of motion: with corrected misprints, or as printed",
            "consistent", "as_printed", start="consistent"),
    _option("model.radii", "Radii on which the mesh force acts",
            "consistent", "paper", "mean", start="consistent"),
    _option("mesh.damping", "Law of the mesh damping", "hysteretic", "modal", start="hysteretic"),
    _option("friction.model", "Flank friction",
            "consistent", "as_printed", "off", start="consistent"),
    _option("bearing.approach", "Roller approach under shaft displacement",
            "full", "as_printed", start="full"),
    _option("bearing.torque_loss", "Drag torque of the bearings",
            "none", "palmgren", start="palmgren"),
    _option("oil.name", "Lubricant",
            "mohammadpour_2015", "karagiannis_2012", start="mohammadpour_2015"),
    _count("solver.steps_per_mesh_period", "Integration steps in one mesh period", 64, 16, 4096),
    _count("solver.steps_per_highest_period",
           "Integration steps in one period of the highest natural frequency", 22, 8, 4096),
)  # fmt: skip


def _motion() -> tuple[Variable, ...]:
    members = (("pinion", "pinion"), ("wheel", "gear"))
    angle = [_output(f"{m}.angle", "rad", f"Rotation of the {w}", display_unit="deg")
             for m, w in members]  # fmt: skip
    speed = [_output(f"{m}.speed", "rad/s", f"Speed of the {w}", 100.0, "rpm") for m, w in members]
    acceleration = [_output(f"{m}.acceleration", "rad/s2", f"Angular acceleration of the {w}", 1e3)
                    for m, w in members]  # fmt: skip
    return (*angle, *speed, *acceleration)


_MESH = (
    _output("mesh.dte", "m", "Dynamic transmission error, positive with the drive flank in contact",
            1e-5, "um"),
    _output("mesh.force", "N", "Dynamic mesh force", 1e3, "kN"),
    Variable(name="mesh.separated", type="Boolean", causality="output",
             description="True while neither flank is in contact"),
    _output("mesh.stiffness", "N/m", "Mesh stiffness at the present mesh phase", 1e8),
    _output("mesh.frequency", "Hz", "Mesh frequency: pinion teeth times revolutions", 100.0),
)  # fmt: skip


def _flank(i: int) -> tuple[Variable, ...]:
    pair = f"of tooth pair {i}"
    return (
        _output(f"flank[{i}].load", "N", f"Load {pair}", 1e3, "kN"),
        _output(f"flank[{i}].film_thickness", "m", f"Central film thickness {pair}", 1e-6, "um"),
        _output(f"flank[{i}].film_ratio", "1", f"Film thickness over composite roughness {pair}"),
        _output(f"flank[{i}].friction_coefficient", "1", f"Friction coefficient {pair}", 0.05),
        _output(f"flank[{i}].temperature", "K", f"Film temperature {pair}", 300.0, "degC"),
    )


_LOSSES = (
    _output("friction.power_loss", "W", "Flank friction loss, viscous and boundary", 100.0),
    _output("friction.power_loss_boundary", "W", "Flank friction loss, boundary share", 10.0),
    _output("bearing.power_loss", "W", "Drag torque loss of all four bearings", 100.0),
    _output("damping.power_loss", "W", "Loss in mesh and roller damping", 10.0),
    _output("efficiency", "1", "Efficiency of the gear mesh, mean over the communication step"),
    _output("axle.efficiency", "1", "Efficiency with all losses, mean over the communication step"),
)


def _displacements() -> tuple[Variable, ...]:
    return tuple(
        _output(f"{member}.displacement.{axis}", "m", f"Displacement of the {word} along {axis}",
                1e-5, "um")
        for member, word in (("pinion", "pinion"), ("wheel", "gear"))
        for axis in "xyz"
    )  # fmt: skip


def _bearing(j: int) -> tuple[Variable, ...]:
    described = {f"force.{axis}": f"Force on the shaft along {axis}" for axis in "xyz"} | {
        "roller_load_max": "Largest roller load",
        "roller_load_min": "Smallest roller load",
    }
    return tuple(
        _output(f"bearing[{j}].{name}", "N", f"{words}, bearing {j}", 1e3, "kN")
        for name, words in described.items()
    )


_ROLLERS = (
    _output("bearing[1].roller[1].load", "N", "Load of roller 1 of bearing 1", 1e3, "kN"),
    _output("bearing[1].cage.angle", "rad", "Cage rotation of the pinion bearings",
            display_unit="deg"),
    _output("bearing[3].cage.angle", "rad", "Cage rotation of the gear bearings",
            display_unit="deg"),
)  # fmt: skip

_ENERGIES = tuple(
    _output(f"energy.{name}", "J", words, 100.0)
    for name, words in (
        ("pinion_work", "Work of the pinion torque on the axle since initialisation"),
        ("wheel_work", "Work of the axle against the wheel torque since initialisation"),
        ("friction_viscous", "Heat of viscous flank friction since initialisation"),
        ("friction_boundary", "Heat of boundary flank friction since initialisation"),
        ("mesh_damping", "Heat of mesh damping since initialisation"),
        ("bearing_damping", "Heat of roller damping since initialisation"),
        ("bearing_torque", "Heat of bearing drag torque since initialisation"),
        ("stored", "Kinetic and elastic energy in the axle"),
    )
)

# parameters younger than the first release: appended, so that value references stay
_LATER_PARAMETERS = (
    _option("model.mesh_stiffness", "Spring of the mesh: tangent at its load, or secant",
            "tangent", "secant", start="tangent"),
)  # fmt: skip

HYPOID_AXLE: tuple[Variable, ...] = (
    *_INPUTS,
    *_PARAMETERS,
    *_motion(),
    *_MESH,
    *(variable for i in (1, 2, 3) for variable in _flank(i)),
    *_LOSSES,
    *_displacements(),
    *(variable for j in (1, 2, 3, 4) for variable in _bearing(j)),
    *_ROLLERS,
    *_ENERGIES,
    *_LATER_PARAMETERS,
)
