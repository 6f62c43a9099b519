"""A shaft as a body of a train: rigid, or an elastic beam, with nodes where elements act."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated

import numpy as np

from gearlube_core.dynamics.train.elements.shaft_motion import CarriedNodes, mode_bodies
from gearlube_core.dynamics.train.part import GROUND, AxisPlace, Body, Element, Hidden, Node
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_body import DAMPING_RATIO, POSITION
from gearlube_core.number import Number, check_fields
from gearlube_core.shafts.beam import Beam, shaft_beam
from gearlube_core.shafts.free_modes import ShaftMotion, shaft_motion
from gearlube_core.shafts.section import ShaftDisc, ShaftMaterial, ShaftSection

_AT_PLACE = 1e-6  # m
_MOST_ELEMENTS = 600  # of a beam: the time for its modes grows with their third power
_LIMIT = Number("Hz", 0.0, 1e6, text="Modes up to this frequency move; 0: the shaft is rigid")
_LONGEST = Number("m", 0.0, 10.0, text="Longest element of the beam; 0: a quarter of the least "
                  "outer diameter", shown="mm")  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Shaft:
    """A shaft along z: its rigid motion about its centre of mass, and its modes.

    Elements act on it by its name, at the centre of mass, or on a node of it: `rotor.gear` is the
    node `gear` of the shaft `rotor`.

    Parameters
    ----------
    name : str
    sections : sequence of ShaftSection
        Cylinders along z. They must meet; where they overlap they add up, as a hub on its shaft.
        None with a `rotor`.
    nodes : mapping
        Places of bearings and gears along z [m], by name.
    discs : sequence of ShaftDisc
        Rigid masses on it.
    material : ShaftMaterial
    highest_frequency : float
        Modes of the free shaft up to this one move [Hz]; all others give their static flexibility.
        0: the shaft is rigid.
    damping_ratio : float
        Of its modes [-].
    gyroscopic : bool
        Whether gyroscopic moments act.
    longest_element : float
        Of the beam [m]; 0: a quarter of the least outer diameter.
    rotor : Beam, optional
        Instead of sections and discs, as from `rotor_beam`: matrices of another program.

    Raises
    ------
    ParameterError
        A number is out of range, sections leave a gap, or a node lies off the shaft.

    Notes
    -----
    Beams are those of Timoshenko [nelson_1980]. Both bending planes are alike. Nodes take part in
    tilts and twists; the flexibility that modes above the limit give is that against forces and
    torques, not against tilting moments.

    Examples
    --------
    >>> tube = ShaftSection(start=0.0, end=0.3, outer_diameter=0.04, inner_diameter=0.01)
    >>> rotor = Shaft(name="rotor", sections=[tube], nodes={"left": 0.02, "gear": 0.25})
    >>> [one.name for one in rotor.members()[0]][:3]
    ['rotor', 'rotor.left', 'rotor.gear']
    """

    name: str
    sections: tuple[ShaftSection, ...] = ()
    nodes: Mapping[str, Annotated[float, POSITION._replace(shown="mm")]]
    discs: tuple[ShaftDisc, ...] = ()
    material: ShaftMaterial = field(default_factory=ShaftMaterial)
    highest_frequency: Annotated[float, _LIMIT] = 1e4
    damping_ratio: Annotated[float, DAMPING_RATIO._replace(text="Damping ratio of its modes")] = (
        0.01
    )
    gyroscopic: bool = True
    longest_element: Annotated[float, _LONGEST] = 0.0
    rotor: Beam | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        check_fields(self)
        if (self.rotor is None) != bool(self.sections) or (self.rotor and self.discs):
            raise ParameterError(
                f"sections of {self.name} must have at least one, or none and no discs beside a "
                f"rotor of matrices, got {len(self.sections)} and {len(self.discs)} discs."
            )
        if not self.nodes:
            raise ParameterError(
                f"nodes of {self.name} must name at least one place of a bearing or gear, got none."
            )
        for node in self.nodes:
            if "." in node:
                raise ParameterError(
                    f"nodes of {self.name} must have names without a point, got {node!r}."
                )
        if self.rotor is None:
            self._check_sections()
            return
        for node, place in self.nodes.items():
            nearest = self.rotor.places[np.argmin(abs(self.rotor.places - place))]
            if abs(nearest - place) > _AT_PLACE:
                raise ParameterError(
                    f"node {node} of {self.name} must be at a place of its matrices, got "
                    f"{1e3 * place:g} mm. The nearest one is {1e3 * nearest:g} mm."
                )

    def _check_sections(self) -> None:
        ordered = sorted(self.sections, key=lambda one: one.start)
        end = ordered[0].start
        for one in ordered:
            if one.start > end + 1e-9:
                raise ParameterError(
                    f"sections of {self.name} must meet, got a gap from {1e3 * end:g} to "
                    f"{1e3 * one.start:g} mm."
                )
            end = max(end, one.end)
        places = {f"node {name}": place for name, place in self.nodes.items()}
        places |= {f"disc {i + 1}": one.position for i, one in enumerate(self.discs)}
        for what, place in places.items():
            if not ordered[0].start - 1e-9 <= place <= end + 1e-9:
                raise ParameterError(
                    f"{what} of {self.name} must lie on the shaft, {1e3 * ordered[0].start:g} to "
                    f"{1e3 * end:g} mm, got {1e3 * place:g} mm."
                )

        longest = self._longest()
        n = len(self.sections) + len(self.discs) + (end - ordered[0].start) / longest
        if n > _MOST_ELEMENTS:
            raise ParameterError(
                f"elements of {self.name} must be at most {_MOST_ELEMENTS}, got {n:.3g} of at most "
                f"{1e3 * longest:.3g} mm. Give a larger longest_element, or leave out what is thin."
            )

    def _longest(self) -> float:
        return self.longest_element or 0.25 * min(one.outer_diameter for one in self.sections)

    def motion(self) -> ShaftMotion:
        """Return its mass and inertia, and its modes at the nodes."""
        places = list(self.nodes.values())
        beam = self.rotor or shaft_beam(
            self.sections, self.discs, places, self.material, self._longest()
        )
        return shaft_motion(beam, np.array(places), self.highest_frequency)

    def members(self) -> tuple[list[Body], list[Element]]:
        """Return its rigid body, nodes and modes, and the element that carries them."""
        own = self.motion()
        nodes = [Node.of(self.name, place) for place in self.nodes]
        modes = [
            Hidden.modes(f"{self.name}.modes_{i + 1}", own.mass, held)
            for i, held in enumerate(mode_bodies(own))
        ]
        body = Body(
            name=self.name, mass=own.mass, inertia=own.inertia, polar_inertia=own.polar_inertia
        )
        carrier = CarriedNodes(
            name=f"{self.name}.nodes",
            body=self.name,
            nodes=nodes[0].name,
            modes=modes[0].name if modes else GROUND,
            places=tuple(AxisPlace(self.name, one.name, 0.0j) for one in nodes),
            motion=own,
            highest_frequency=self.highest_frequency,
            damping_ratio=self.damping_ratio,
            gyroscopic=self.gyroscopic,
            sections=tuple(self.sections),
        )
        return [body, *nodes, *modes], [carrier]
