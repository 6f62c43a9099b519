"""Orbit of a body that another one carries around its axis, such as a planet gear."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.gear_pair import AZIMUTH, worded
from gearlube_core.dynamics.train.part import Body, Element, Node
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_body import MASS
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, constants_of
from gearlube_core.oil.lubricant_state import LubricantState

_NEAR = 1e-4  # of a radius, of places that are to be the same


class OrbitKernels(NamedTuple):
    """Constants of an orbit, and its kernels: see `element.Kernels`."""

    mass: float  # [kg]
    radius: float  # [m]
    azimuth: float  # [rad]

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.at_rest`; the deflection turns with the carrier."""
        u, w = at[0], s[at[1] + W]
        s[u + RATE], s[u + RATE + 1] = -w * s[u + 1], w * s[u]

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        u, w = at[0] + RATE, s[at[1] + W]
        angle = self.azimuth + s[at[1] + RZ]
        force = self.mass * self.radius * w * w
        ds[u] += force * math.cos(angle)
        ds[u + 1] += force * math.sin(angle)

    @inside
    def after_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.after_forces`."""
        u, along = at[0] + RATE, self.radius * ds[at[1] + RATE + RZ]
        angle = self.azimuth + s[at[1] + RZ]
        ds[u] += along * math.sin(angle)
        ds[u + 1] -= along * math.cos(angle)

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stored_energy`; kinetic energy beyond that of the body's own motion."""
        u, speed = at[0] + RATE, self.radius * s[at[1] + W]
        angle = self.azimuth + s[at[1] + RZ]
        along = s[u + 1] * math.cos(angle) - s[u] * math.sin(angle)
        return self.mass * speed * (along + 0.5 * speed)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        w = s[at[1] + W]
        out[first] = self.mass * self.radius * w * w


@dataclass(frozen=True, slots=True, kw_only=True)
class Orbit(Element):
    """A body goes around with its carrier: its displacements count from its place on a circle.

    m (v' + w_c' x r_0 - w_c^2 r_0) = F

    r_0 turns with the carrier, v is the rate of the displacements. F are all other forces on the
    body; those of its joints with the carrier act on the carrier too, at r_0.

    Parameters
    ----------
    name, body, carrier : str
    mass : float
        Of the body [kg].
    radius : float
        Of the circle [m].
    azimuth : float
        Of the body at the start, from x towards y [rad].

    Notes
    -----
    In axes that turn with the carrier this gives the gyroscopic and centripetal terms of
    [lin_parker_1999] and [cooley_parker_2012], whose frequencies the tests have.

    Examples
    --------
    >>> orbit = Orbit(name="orbit", body="planet", carrier="carrier", mass=0.7, radius=0.1)
    >>> orbit.on
    ('body', 'carrier')
    """

    name: str
    body: str
    carrier: str
    mass: Annotated[float, MASS._replace(text="Mass of the body")]
    radius: Annotated[float, Number("m", 1e-3, 10.0, text="Radius of the circle", shown="mm")]
    azimuth: Annotated[float, worded(AZIMUTH, "Of the body at the start, from x towards y")] = 0.0
    kind: ClassVar = "orbit"
    interpreted: ClassVar = (Listed(OrbitKernels, (), 2),)
    on: ClassVar = ("body", "carrier")
    outputs: ClassVar = (Output("centrifugal", "N", "centrifugal force on the body", 1e3),)

    def fits(self, bodies: Sequence[Body], elements: Sequence[Element]) -> None:
        """Raise ParameterError where the body cannot move, or has another mass."""
        body, carrier = (
            next(one for one in bodies if one.name == name) for name in (self.body, self.carrier)
        )
        if isinstance(body, Node) or isinstance(carrier, Node):
            raise ParameterError(
                f"{self.name} must have rigid bodies, got a node of a shaft among {self.body} and "
                f"{self.carrier}. Fix a rigid body to the node by a stiff Joint and HalfShaft."
            )
        if not math.isclose(body.mass, self.mass, rel_tol=1e-9):
            raise ParameterError(
                f"mass of {self.name} must be that of {self.body}, {body.mass:g} kg, got "
                f"{self.mass:g} kg."
            )
        held = [one for one in ("x", "y") if one in body.held]
        if held:
            raise ParameterError(
                f"{self.body} must be free along x and y, since {self.carrier} carries it, but "
                f"holds {held[0]}. Fix it to the carrier by a stiff Joint."
            )

    def numbers(self) -> OrbitKernels:
        """Return the constants of the kernels."""
        return constants_of(OrbitKernels, self)


def centre_of(elements: Sequence[Element], body: str, carrier: str) -> complex:
    """Return where a body's axis stands on its carrier, x + i y [m]; 0 without an orbit."""
    for one in elements:
        if isinstance(one, Orbit) and (one.body, one.carrier) == (body, carrier):
            return cmath.rect(one.radius, one.azimuth)
    return 0.0j


def check_place(
    elements: Sequence[Element], name: str, body: str, carrier: str, wanted: complex
) -> None:
    """Raise ParameterError unless a body's axis stands at this place on its carrier."""
    check_distance(elements, name, carrier, body, carrier, wanted)


def check_distance(
    elements: Sequence[Element], name: str, first: str, second: str, carrier: str, wanted: complex
) -> None:
    """Raise ParameterError unless two bodies' axes on a carrier are so far apart, x + i y [m]."""
    there = centre_of(elements, second, carrier) - centre_of(elements, first, carrier)
    if abs(there - wanted) > _NEAR * max(abs(wanted), abs(there)):
        here, stands = (f"{1e3 * z.real:.6g}, {1e3 * z.imag:.6g} mm" for z in (wanted, there))
        raise ParameterError(
            f"{name} needs the axis of {second} at x, y = {here} from that of {first}, got "
            f"{stands} by the orbits on {carrier}; a body without an orbit is on the axis of "
            f"{carrier}. Correct radius, azimuth or teeth."
        )
