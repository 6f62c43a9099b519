"""Outputs of both FMUs. A change here changes both tables, whose references are released."""

from __future__ import annotations

from fmu_src.variable import Variable
from fmu_src.variable_kinds import local, output

MEMBERS = (("pinion", "pinion"), ("wheel", "gear"))  # in names, in words


def motion() -> tuple[Variable, ...]:
    """Return rotation, speed and acceleration of both members."""
    angle = [output(f"{m}.angle", "rad", f"Rotation of the {w}", display_unit="deg")
             for m, w in MEMBERS]  # fmt: skip
    speed = [output(f"{m}.speed", "rad/s", f"Speed of the {w}", 100.0, "rpm") for m, w in MEMBERS]
    acceleration = [output(f"{m}.acceleration", "rad/s2", f"Angular acceleration of the {w}", 1e3)
                    for m, w in MEMBERS]  # fmt: skip
    return (*angle, *speed, *acceleration)


def displacements(member: str, word: str) -> tuple[Variable, ...]:
    """Return the displacements of a member."""
    return tuple(
        output(f"{member}.displacement.{axis}", "m", f"Displacement of the {word} along {axis}",
               1e-5, "um")
        for axis in "xyz"
    )  # fmt: skip


def velocities(member: str, word: str) -> tuple[Variable, ...]:
    """Return the velocities of a member."""
    return tuple(
        local(f"{member}.velocity.{axis}", "m/s", f"Velocity of the {word} along {axis}", 0.01)
        for axis in "xyz"
    )


def tilt_speeds(member: str, word: str) -> tuple[Variable, ...]:
    """Return the speeds at which a member tilts."""
    return tuple(
        local(f"{member}.tilt_speed.{axis}", "rad/s", f"Tilting speed of the {word} about {axis}",
              0.1)
        for axis in "xy"
    )  # fmt: skip


def load_level() -> Variable:
    """Return the state by which the load level of the mesh data follows the pinion torque."""
    return local("mesh.load_torque", "N.m", "Pinion torque at which the mesh data are read: "
                 "absolute value, low-pass filtered with 20 ms", 100.0)  # fmt: skip


def energies(words: dict[str, str]) -> tuple[Variable, ...]:
    """Return energies by name and description."""
    return tuple(output(f"energy.{name}", "J", text, 100.0) for name, text in words.items())


def ranges() -> tuple[Variable, ...]:
    """Return the quantities that decide whether tables and formulas are within their ranges."""
    at = "at the most loaded contact; 0 when not in use"
    return (
        Variable(
            name="range.exceeded", type="Integer", causality="output",
            description="0: all quantities are in range; else the sum of 1 torque, 2 film_load, "
            "4 film_material, 8 traction, 16 temperature, 32 pressure, see docs/fmu.md",
        ),
        output("range.torque", "N.m", "Pinion torque of the mesh data, or the torque of the "
               "teeth if larger; negative on the coast flanks", 100.0),
        output("range.film_load", "1", f"Load group M of Moes {at}", 1e3),
        output("range.film_material", "1", f"Material group L of Moes {at}", 10.0),
        output("range.traction", "1", f"Dimensionless group of the traction map {at}", 10.0),
        output("range.temperature", "K", f"Film temperature {at}", 300.0, "degC"),
        output("range.pressure", "Pa", f"Largest Hertz pressure {at}", 1e9, "GPa"),
    )  # fmt: skip
