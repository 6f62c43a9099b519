"""Kernels of the elements of a train, and the places of bodies in its state.

A body owns twelve states: displacements x, y, z [m] and angles rx, ry, rz [rad] about axes fixed in
space, then their rates. An element is a NamedTuple of floats whose kernels are methods, as of a
bearing or a friction law; it acts on one or two bodies by adding to the places of their rates:
there forces [N] and moments [N.m] are summed before each body turns its sums into accelerations.

The kernels of an element take where it stands, `at`: the first place of each of its bodies, then of
its own integrated states, of its energies, of what it keeps between steps, and of what the ports
beside it keep, 0 for none; then its sizes. They do not allocate and do not raise.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, Protocol

from gearlube_core.arrays import Array
from gearlube_core.kernels.inlining import inside
from gearlube_core.oil.lubricant_state import LubricantState

COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
N_COORDINATES = 6
RATE = 6  # from a coordinate of a body to its rate
BODY_STATES = 12
AFTER_STEP = 5  # a stage, see `Kernels.add_forces`
RZ, W = 5, 11  # angle [rad] and speed [rad/s] about the shaft's axis z


class Listed(NamedTuple):
    """Part of one element for which the kernels of a list are compiled."""

    numbers: type  # NamedTuple class of its constants
    variants: tuple[type, ...]  # classes of its parts, see `tuple_from_array`
    places: int  # how many `at` has


class Kernels(Protocol):
    """Kernels of the NamedTuple of an element: methods of these names under `kernel`.

    `add_forces` must be there, `at_rest` where there are own states; the others may be left out.
    """

    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """Add forces and moments to the bodies' rates; write the rates of own states and energies.

        Energies of one name are shared, so an element adds its power.

        Parameters
        ----------
        memory : ndarray
            What the element has for itself: tables, and what it keeps that follows from the state.
        s, ds : ndarray
            State of the train, and its rates.
        stage : int
            1 to 4 within an integrator step, 0 for a state by itself, where all is exact,
            AFTER_STEP for one that a step has left, as the next one begins.
        """

    def after_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """Change accelerations that follow from others, which stand in the rates of the bodies."""

    def spread(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """Write the motion of nodes, which follow from other states, before forces are added.

        Elements with this kernel stand first in the list, see `Element.carries`.
        """

    def collect(self, at: Any, memory: Array, s: Array, oil: LubricantState, ds: Array) -> None:
        """Pass on what all elements have added to nodes."""

    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """Write about what own states are at rest, and what is kept between steps.

        The places of own states hold the loads on them [N, N.m]. What is written there sets the
        scale of the search too, so that it must not be zero.
        """

    def full_contact(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """Move own states of a state at rest to where all contacts touch, if they do not.

        The modes there decide the length of steps. Without it those at rest do.
        """

    def ease(self, at: Any, memory: Array, s: Array, oil: LubricantState, share: float) -> float:
        """Add a share of a usual stiffness to forces that have gaps; return 1, or 0 for none.

        The search of the rest begins with such forces and ends with a share of 0, and the modes
        that decide the length of steps are those with a share of 1.
        """

    def begin(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """Make ready for a communication step."""

    def expand(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """Make forces that are linear about a state exact about this one."""

    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """Renew what is kept over a step of `h` [s], or a part of one; return its cost in steps."""

    def after_part(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """Do as `after_step` after a part of a step of `h` [s], or a step without parts."""

    def after_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """Change what a step of `h` [s] has left, such as filtered loads; return any number."""

    def finish(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """Put what is kept in `memory` into the state at the end of a communication step."""

    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """Return the elastic energy of the element [J]."""

    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """Return the least number of integrator steps a second that the element asks for now."""

    def stiffening(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """Return by what factor natural frequencies may have risen since the start."""

    def time_to_jump(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float
    ) -> float:
        """Return after what time [s] a part of a step of `h` [s] must end; infinite for no parts.

        Forces jump there, or bend so sharply that a whole step is too long.
        """

    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """Write the element's outputs into `out` from place `first` on.

        Rates and `stored_energy` of this state have been computed before.
        """

    def show(
        self,
        at: Any,
        memory: Array,
        s: Array,
        oil: LubricantState,
        stage: int,
        out: Array,
        first: int,
    ) -> None:
        """Write those outputs that take no rates, without `expand` and `add_forces` before.

        `stage` is what `add_forces` would take. A host that reads these alone waits for no others.
        """

    def exchange(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """Write the rates of the element's levels and then its event indicators into `out`.

        They go from place `first` on. Rates of this state have been computed before.
        """

    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """Return 1 if these sizes, constants, memory and numbers kept fit each other, else 0.

        They come from a file. All that other kernels count with or index by has to be looked at.
        An element of the package needs it if it has sizes or memory, or keeps numbers.
        """

    def event(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """Change what an event changes, as between two steps: own states, what is kept."""


class Axes(NamedTuple):
    """Axes of an element against those of its train: turned about z, then turned over, mirrored.

    A vector of the train becomes one of the element by a turn about z, half a turn about the new x
    where `over` is -1, and a mirror z -> -z where `hand` is -1.
    """

    cos: float
    sin: float
    over: float  # +1 or -1
    hand: float  # +1 or -1

    @classmethod
    def turned(cls, angle: float, *, over: bool = False, mirrored: bool = False) -> Axes:
        """Return axes whose x stands at an angle [rad] about z of the train."""
        # + 0.0: no negative zeros
        c, s = math.cos(angle) + 0.0, math.sin(angle) + 0.0
        return cls(c, s, -1.0 if over else 1.0, -1.0 if mirrored else 1.0)


@inside
def seen(a: Axes, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return a displacement or force of the train in the axes of an element."""
    return a.cos * x + a.sin * y, a.over * (a.cos * y - a.sin * x), a.over * a.hand * z


@inside
def seen_turn(a: Axes, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return a rotation or moment of the train in the axes of an element."""
    return (
        a.hand * (a.cos * x + a.sin * y),
        a.hand * (a.over * (a.cos * y - a.sin * x)),
        a.over * z,
    )


@inside
def unseen(a: Axes, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return a force of the element in the axes of the train."""
    y = a.over * y
    return a.cos * x - a.sin * y, a.sin * x + a.cos * y, a.over * a.hand * z


@inside
def unseen_turn(a: Axes, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return a moment of the element in the axes of the train."""
    x = a.hand * x
    y = a.hand * (a.over * y)
    return a.cos * x - a.sin * y, a.sin * x + a.cos * y, a.over * z


@inside
def add_wrench(
    ds: Array,
    body: int,
    arm: float,
    force: tuple[float, float, float],
    moment: tuple[float, float, float],
) -> None:
    """Add a force at `arm` [m] along z from the centre of a body and a moment, in the train's axes.

    `body` is its first place.
    """
    f_x, f_y, f_z = force
    m_x, m_y, m_z = moment
    ds[body + RATE] += f_x
    ds[body + RATE + 1] += f_y
    ds[body + RATE + 2] += f_z
    ds[body + RATE + 3] += m_x - arm * f_y
    ds[body + RATE + 4] += m_y + arm * f_x
    ds[body + RATE + 5] += m_z
