"""Bodies and elements as a user lists them, before they are assembled."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.dynamics.ranges import Range
from gearlube_core.dynamics.train.element import COORDINATES, Listed
from gearlube_core.helical_geometry.gear_body import INERTIA, MASS
from gearlube_core.number import Checked, Output, check_fields
from gearlube_core.part import Kind

NO_NUMBERS: Array = np.empty(0)
GROUND = "ground"  # a body of every train whose elements name it: it stays where it is
ELEMENTS: Kind[Any] = Kind(
    what="element",
    group="gearlube.elements",
    package="gearlube_core.dynamics.train.elements",
    files="*",
)

_INERTIA = INERTIA._replace(high=1e9)  # rotors of wind turbines have 1e7 to 1e9 kg m2
# elements that carry the nodes of a body, which a user lists as that body
CARRIERS: Kind[Any] = replace(ELEMENTS, what="carrier of nodes", parts={})


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """A rigid body of a train that turns about one axis: z, or its own where an element says so.

    Parameters
    ----------
    name : str
        Name in files and results.
    mass : float
        [kg]
    inertia, polar_inertia : float
        About a diameter and about the axis [kg m2].
    held : tuple of str
        Coordinates that do not move, among x, y, z, rx, ry, rz.

    Notes
    -----
    Products of rotation and tilt (gyroscopic moments) are left out, as in [he_2007].

    Examples
    --------
    >>> rotor = Body.spinning("rotor", 0.02)
    >>> round(float(rotor.mobility[5]), 3)  # 1/(kg m2)
    50.0
    """

    name: str
    mass: Annotated[float, MASS]
    inertia: Annotated[float, _INERTIA._replace(text="Moment of inertia about a diameter")]
    polar_inertia: Annotated[float, _INERTIA._replace(text="Moment of inertia about the axis")]
    held: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        check_fields(self)
        for one in self.held:
            check_option(f"held of {self.name}", one, COORDINATES)

    @classmethod
    def spinning(cls, name: str, polar_inertia: float) -> Body:
        """Return a body that can only turn, such as a rotor or a hub."""
        held = tuple(one for one in COORDINATES if one != "rz")
        return cls(name=name, mass=1.0, inertia=1.0, polar_inertia=polar_inertia, held=held)

    def members(self) -> tuple[list[Body], list[Element]]:
        """Return its body in the train: itself."""
        return [self], []

    @property
    def mobility(self) -> Array:
        """Acceleration per force or moment of each coordinate, 0 where held, shape (6,)."""
        resisting = (*3 * (self.mass,), *2 * (self.inertia,), self.polar_inertia)
        pairs = zip(COORDINATES, resisting, strict=True)
        return np.array([0.0 if name in self.held else 1.0 / one for name, one in pairs])


class Node(Body):
    """A place on a body, on which elements act as on a body: its motion follows from the body's.

    Examples
    --------
    >>> Node.of("rotor", "gear").name
    'rotor.gear'
    """

    __slots__ = ()

    @classmethod
    def of(cls, body: str, place: str) -> Node:
        """Return a node of a body."""
        held: Any = COORDINATES
        return cls(name=f"{body}.{place}", mass=1.0, inertia=1.0, polar_inertia=1.0, held=held)


class Hidden(Body):
    """A body without outputs: the ground, or the modal coordinates of a flexible body.

    Examples
    --------
    >>> Hidden.ground().name
    'ground'
    """

    __slots__ = ()

    @classmethod
    def ground(cls) -> Hidden:
        """Return the ground."""
        held: Any = COORDINATES
        return cls(name=GROUND, mass=1.0, inertia=1.0, polar_inertia=1.0, held=held)

    @classmethod
    def modes(cls, name: str, mass: float, held: tuple[str, ...]) -> Hidden:
        """Return modal coordinates of one modal mass [kg], in metres; `held` ones are left out.

        The last coordinate, which turns on, can be none.
        """
        return cls(name=name, mass=mass, inertia=mass, polar_inertia=1.0, held=held)


class AxisPlace(NamedTuple):
    """Two bodies or nodes, and where the axis of the second one stands from that of the first."""

    first: str
    second: str
    step: complex  # x + i y [m]
    along: float = 0.0  # z of the second one, where a housing says it [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Element(Checked, ABC):
    """A part that acts on bodies: derive a frozen dataclass, and give it a NamedTuple of kernels.

    One with a `kind`, its name in files, registers itself. Its fields are then the fields of the
    file: a `Number` with its unit, a text, a part such as a bearing.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.elements.drag import Seal
    >>> issubclass(Seal, Element), Seal.on, Seal.losses
    (True, ('body',), ('seals',))
    """

    name: str
    kind: ClassVar[str] = ""
    on: ClassVar[tuple[str, ...]]  # fields that name the bodies
    beside: ClassVar[tuple[str, ...]] = ()  # fields that name ports, or None
    states: ClassVar[tuple[Output, ...]] = ()  # own integrated states, steady in steady turning
    angles: ClassVar[tuple[str, ...]] = ()  # own integrated states that turn on
    torque_at: ClassVar[int] = 0  # of a port, where among what it keeps its torque stands
    lags: ClassVar[tuple[Output, ...]] = ()  # those that `at_rest` writes, such as of a control
    works: ClassVar[tuple[str, ...]] = ()  # energies put into the train
    losses: ClassVar[tuple[str, ...]] = ()  # energies lost, shared by all elements that name them
    bounds: ClassVar[tuple[str, ...]] = ()  # bounds of losses by solved films, likewise
    outputs: ClassVar[tuple[Output, ...]] = ()  # named without the element
    levels: ClassVar[tuple[str, ...]] = ()  # outputs that are kept first, see `exchange`
    events: ClassVar[tuple[Output, ...]] = ()  # what changes its sign where `event` has to do
    linear: ClassVar[bool] = False  # see `linear_among`
    carries: ClassVar[bool] = False  # whether it moves nodes: one of CARRIERS
    interpreted: ClassVar[tuple[Listed, ...]] = ()  # what of it ships, see `shipped_kinds`

    def __init_subclass__(cls) -> None:
        if kind := cls.__dict__.get("kind"):
            (CARRIERS if cls.carries else ELEMENTS).add(cls, kind)

    @abstractmethod
    def numbers(self) -> tuple[Any, ...]:
        """Return a NamedTuple of floats whose methods are the kernels of `element`."""

    def numbers_among(self, bodies: Sequence[Body]) -> tuple[Any, ...]:
        """Return `numbers` where they depend on the bodies of the train."""
        return self.numbers()

    def variants(self) -> tuple[type, ...]:
        """Return the classes of parts among `numbers` that are of any class."""
        return ()

    def sizes(self) -> tuple[int, ...]:
        """Return whole numbers that the kernels find at the end of `at`."""
        return ()

    def memory(self) -> Array:
        """Return a new array for `memory` of the kernels."""
        return NO_NUMBERS

    def memory_among(self, bodies: Sequence[Body]) -> Array:
        """Return `memory` where it depends on the bodies of the train."""
        return self.memory()

    def fits(self, bodies: Sequence[Body], elements: Sequence[Element]) -> None:
        """Raise ParameterError where the element does not fit the others of its train."""

    def between_axes(self) -> Sequence[AxisPlace]:
        """Return between which bodies the element fixes where their axes stand, none by default."""
        return ()

    def linear_among(self, bodies: Sequence[Body]) -> bool:
        """Return whether forces are linear in the motion of its bodies, and losses in its square.

        Beside it there may be torques of ports, and gyroscopic moments of carriers.
        """
        return self.linear

    def ranges(self) -> tuple[Range, ...]:
        """Return ranges of outputs, which are named without the element."""
        return ()

    def kept_size(self) -> int:
        """Return how many numbers are kept between steps behind the integrated states."""
        return 0


@cache
def shipped_elements() -> tuple[tuple[type[Element], Listed], ...]:
    """Return the elements of the package, and what they are compiled for.

    There is one for each class of their parts. A list of these alone needs no compiled code of its
    own, see `drivers.interpreted`.
    """
    # by name: the order of registration is that of imports
    known = {**ELEMENTS.known(), **CARRIERS.known()}
    ours = [one for _, one in sorted(known.items()) if ELEMENTS.is_ours(one)]
    return tuple((one, kind) for one in ours for kind in one.interpreted)


def shipped_kinds() -> tuple[Listed, ...]:
    """Return what the elements of the package are compiled for, see `shipped_elements`."""
    return tuple(kind for _, kind in shipped_elements())
