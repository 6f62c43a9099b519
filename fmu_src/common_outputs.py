"""Outputs of both FMUs. A change here changes both tables, whose references are released."""

from __future__ import annotations

from fmu_src.variable import Variable
from fmu_src.variable_kinds import output

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


def energies(words: dict[str, str]) -> tuple[Variable, ...]:
    """Return energies by name and description."""
    return tuple(output(f"energy.{name}", "J", text, 100.0) for name, text in words.items())
