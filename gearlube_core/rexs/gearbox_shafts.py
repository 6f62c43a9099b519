"""Shafts of a gearbox in REXS: cylinders, masses and places in the units of train files."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

import numpy as np

from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.rexs.model import Component, RexsModel
from gearlube_core.rexs.stage import ExchangeNote, Kind

_PARALLEL = 1e-6
_CONE_PARTS = 4  # cylinders that stand for a cone
_LONGEST_NAME = 40
MIDDLE = "u_coordinate_on_shaft"  # of the middle of a part; of a section its start


@dataclass(slots=True)
class Reading:
    """A file while it is read: what was made of it, and what it lacks."""

    model: RexsModel
    notes: list[ExchangeNote] = field(default_factory=list)
    absent: list[str] = field(default_factory=list)
    names: dict[int, str] = field(default_factory=dict)

    def note(self, kind: Kind, what: str, why: str) -> None:
        """Add a note."""
        self.notes.append(ExchangeNote(kind, what, why))

    def named(self, one: Component) -> str:
        """Return a name of letters, digits and _ that nothing else has."""
        if one.number not in self.names:
            plain = re.sub(r"[^A-Za-z0-9]+", "_", one.name)[:_LONGEST_NAME].strip("_").lower()
            if not plain[:1].isalpha():
                plain = f"{one.kind.split('_with_')[0]}_{plain or one.number}"
            if plain in self.names.values():
                plain = f"{plain}_{one.number}"
            self.names[one.number] = plain
        return self.names[one.number]

    def needed(self, one: Component, attribute: str, unit: str) -> float:
        """Return a number; where it is absent, it counts as absent."""
        value = one.value(attribute, unit)
        if value is None:
            self.absent.append(f"{attribute} of {one}")
        return math.nan if value is None else value

    def incomplete(self) -> ParameterError:
        """Return the error that names all that is absent."""
        return ParameterError(
            f"{self.model.path} lacks {len(self.absent)} thing(s) that a train needs: "
            f"{'; '.join(self.absent)}. Export the whole gear unit, or add them to the file."
        )


@dataclass(slots=True)
class GearboxShaft:
    """A shaft; lengths in mm along z of the train."""

    name: str
    place: list[float]  # of its start along u, v, w [mm]
    sections: list[dict[str, float]] = field(default_factory=list)
    discs: list[dict[str, float]] = field(default_factory=list)
    nodes: dict[str, float] = field(default_factory=dict)
    material: dict[str, float] = field(default_factory=dict)
    speed: float = 0.0  # [rpm]

    def node(self, name: str, u: float) -> str:
        """Add a node at u on the shaft [mm] and return its full name."""
        self.nodes[name] = self.place[0] + u
        return f"{self.name}.{name}"

    def diameter(self, z: float) -> float | None:
        """Return the outer diameter at z [mm], None beside the shaft."""
        below = [one for one in self.sections if one["start_mm"] <= z <= one["end_mm"]]
        return max((one["outer_diameter_mm"] for one in below), default=None)


def read_shafts(reading: Reading) -> dict[int, GearboxShaft]:
    """Return the shafts by the numbers of their components.

    Raises
    ------
    ParameterError
        There are none, or they are not parallel.
    """
    model = reading.model
    components = model.of_kind("shaft")
    if not components:
        raise ParameterError(
            f"{model.path} must have shafts, got none. `gearlube convert` without --train reads a "
            "pair of gears alone."
        )
    axes = [_direction(one, "u_axis_vector", (1.0, 0.0, 0.0)) for one in components]
    for one, axis in zip(components, axes, strict=True):
        if math.dist(axis, axes[0]) > _PARALLEL:
            raise ParameterError(
                f"Shafts must lie along one u axis, got {axes[0]} of {components[0]} and {axis} of "
                f"{one}. Turn the shaft round in your program, or write its train by hand."
            )
    placed = [one.vector("support_vector") for one in components]
    if None in placed:
        reading.note(
            "lacking", "places of shafts", "support_vector of a shaft is absent: directions are "
            "those of the stages, all shafts begin at z = 0",
        )  # fmt: skip
    w = _direction(components[0], "w_axis_vector", (0.0, 0.0, 1.0))
    frame = np.array([axes[0], np.cross(w, axes[0]), w])
    if abs(np.linalg.det(frame) - 1.0) > _PARALLEL:
        raise ParameterError(
            f"w_axis_vector of {components[0]} must be at right angles to its u_axis_vector "
            f"{axes[0]}, got {w}. Correct the file."
        )
    found = {}
    for one, given in zip(components, placed, strict=True):
        place = (0.0, 0.0, 0.0) if None in placed or given is None else given
        shaft = GearboxShaft(reading.named(one), (frame @ place).tolist())
        _read_parts(reading, one, shaft)
        found[one.number] = shaft
    return found


def _direction(
    one: Component, attribute: str, absent: tuple[float, float, float]
) -> tuple[float, ...]:
    """Return a vector of length 1."""
    given = one.vector(attribute) or absent
    length = math.hypot(*given)
    if length == 0.0:
        raise ParameterError(
            f"{attribute} of {one} must have a length, got three zeros. Correct the file."
        )
    return tuple(part / length for part in given)


def _read_parts(reading: Reading, component: Component, shaft: GearboxShaft) -> None:
    """Add sections, masses and material."""
    model = reading.model
    related = model.related("assembly", "assembly", component.number)
    parts = [
        model.components[n] for one in related if (n := one.get("part", -1)) in model.components
    ]
    for part in parts:
        if part.kind == "shaft_section":
            shaft.sections += _cylinders(reading, part, shaft)
        elif part.kind == "additional_mass":
            inertias = (reading.needed(part, f"moment_of_inertia_{c}_axis", "kg m^2") for c in "vu")
            place = shaft.place[0] + reading.needed(part, MIDDLE, "mm")
            mass = reading.needed(part, "mass_of_component", "kg")
            shaft.discs.append(disc(place, mass, *inertias))
    if not shaft.sections:
        reading.absent.append(f"a shaft_section of {component}")
    for one in model.related("reference", "origin", component.number):
        material = model.components.get(one.get("referenced", -1))
        if material is not None and material.kind == "material":
            modulus = material.value("elastic_modulus", "N / mm^2")
            poisson, density = (
                material.value("poisson_ratio"),
                material.value("density", "kg / dm^3"),
            )
            if modulus is not None and poisson is not None and density is not None:
                check_within(f"poisson_ratio of {material}", poisson, 0.0, 0.5)
                shaft.material = {
                    "E_gpa": 1e-3 * modulus,
                    "G_gpa": 1e-3 * modulus / (2.0 + 2.0 * poisson),
                    "density_kg_m3": 1e3 * density,
                }
    if not shaft.material:
        reading.note("lacking", f"bodies.{shaft.name}.material", "steel")


def disc(position: float, mass: float, inertia: float, polar: float) -> dict[str, float]:
    """Return a disc of a train file: place [mm], mass [kg], inertias [kg m2]."""
    return {
        "position_mm": position,
        "mass_kg": mass,
        "inertia_kg_m2": inertia,
        "polar_inertia_kg_m2": polar,
    }


def _cylinders(reading: Reading, section: Component, shaft: GearboxShaft) -> list[dict[str, float]]:
    """Return the cylinders of a section, of a cone several."""
    start = shaft.place[0] + reading.needed(section, MIDDLE, "mm")
    length = reading.needed(section, "length", "mm")
    ends = ("begin", "end")
    outer = [reading.needed(section, f"outer_diameter_{end}", "mm") for end in ends]
    inner = [section.value(f"inner_diameter_{end}", "mm") or 0.0 for end in ends]
    parts = 1 if outer[0] == outer[1] and inner[0] == inner[1] else _CONE_PARTS
    if parts > 1:
        reading.note("inferred", f"{section} of {shaft.name}", f"a cone, as {parts} cylinders")
    middles = [(i + 0.5) / parts for i in range(parts)]
    return [
        {
            "start_mm": start + i * length / parts,
            "end_mm": start + (i + 1) * length / parts,
            "outer_diameter_mm": outer[0] + share * (outer[1] - outer[0]),
            "inner_diameter_mm": inner[0] + share * (inner[1] - inner[0]),
        }
        for i, share in enumerate(middles)
    ]
