"""A list of bodies and elements put together: places in the state, numbers and memory.

State of a train: twelve states of each body, own states and angles of the elements, the energies,
and behind these integrated states what elements keep between steps, then marks of the energies at
the start of the last step and its length. Order of the list is order of the sums, hence of the last
digits.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from gearlube_core.arrays import Array, Offsets
from gearlube_core.checks import is_it
from gearlube_core.dynamics.train.axes import check_axes
from gearlube_core.dynamics.train.element import BODY_STATES, COORDINATES, Listed
from gearlube_core.dynamics.train.exchange import (
    Continuous,
    Indicator,
    continuous_states,
    event_indicators,
)
from gearlube_core.dynamics.train.exponential_room import LINE, room_size
from gearlube_core.dynamics.train.outputs import train_outputs
from gearlube_core.dynamics.train.part import (
    GROUND,
    Body,
    Element,
    Hidden,
    Node,
    shipped_kinds,
)
from gearlube_core.dynamics.train.plan import (
    AT,
    CURVED,
    LINEAR,
    N_MEMORY,
    NUMBER,
    OF_TABLES,
    UNKNOWN,
    Sizes,
    pack_plan,
)
from gearlube_core.dynamics.train.supports import check_supports
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.number import Output
from gearlube_core.oil.formula_laws import FORMULA_LAWS, OilLaws
from gearlube_core.oil.lubricant import Lubricant

_BETWEEN_PARTS = (("body", "housing"), ("body", "stator"))  # fields of bearings and motors
_MOTIONS = (*COORDINATES, *(f"{one}.rate" for one in COORDINATES))


class Assembly(NamedTuple):
    """A train put together."""

    bodies: tuple[Body, ...]  # those of the list, nodes, then those without outputs
    elements: tuple[Element, ...]
    listed: tuple[Listed, ...]
    laws: OilLaws  # of an oil with laws of its own
    sizes: Sizes
    plan: Offsets
    shape: tuple[int, ...]  # the plan, OF_TABLES where the size of a table decides
    numbers: Array
    memory: Array
    names: tuple[str, ...]  # of the integrated states
    works: dict[str, int]  # places of the energies put in
    losses: dict[str, int]  # of those lost
    bounds: dict[str, int]  # of bounds of those lost
    outputs: tuple[Output, ...]
    kept: dict[str, int]  # first place of what each element keeps
    continuous: tuple[Continuous, ...]
    events: tuple[Indicator, ...]


class Bodies(Protocol):
    """A body of a list: a rigid one, or one that stands for several."""

    @property
    def name(self) -> str:
        """Name of the body."""

    def members(self) -> tuple[list[Body], list[Element]]:
        """Return its body in the train."""


def _expanded(
    bodies: Sequence[Bodies], elements: Sequence[Element]
) -> tuple[tuple[Body, ...], tuple[Element, ...]]:
    """Return all bodies and elements in their order: carriers of nodes first."""
    all_bodies, carriers = list[Body](), list[Element]()
    for one in bodies:
        members, own = one.members()
        all_bodies += members
        carriers += own
    everything = [*carriers, *elements]
    named = {getattr(one, field) for one in everything for field in one.on}
    if GROUND in named - {one.name for one in all_bodies}:
        all_bodies.append(Hidden.ground())
    all_bodies.sort(key=lambda one: 2 * isinstance(one, Hidden) + isinstance(one, Node))
    everything.sort(key=lambda one: not one.carries)
    return tuple(all_bodies), tuple(everything)


def assemble(
    bodies: Sequence[Bodies],
    elements: Sequence[Element],
    oil: Lubricant,
    kinds: Sequence[Listed] | None = None,
    *,
    losses_by_element: bool = False,
    exponential: int = 0,
) -> Assembly:
    """Return a train of bodies and elements, whose order is the order of its states and sums.

    Parameters
    ----------
    bodies, elements
    oil : Lubricant
    kinds : sequence of Listed, optional
        What an element's number in the plan counts, for code that is interpreted; those of the
        package by default. Generated code needs none: () then loads no other element.
    losses_by_element : bool
        Whether each element has losses of its own, "element.loss"; else those of a kind are shared.
    exponential : int
        Exponential steps a ms, at least; 0: RK4 steps.

    Raises
    ------
    ParameterError
        Two bodies or elements have one name, or an element names one that is not there, or one
        body twice, or does not fit the others, or nothing holds a body.
    """
    bodies, elements = _expanded(bodies, elements)
    _check_names(bodies, elements)
    for one in elements:
        if exponential > 0 and hasattr(type(one.numbers()), "after_forces"):
            raise ParameterError(
                "integration must be automatic or rk4 for a train with bodies on carriers or a "
                f"held_port, got exponential, and {one.name} changes accelerations."
            )
        one.fits(bodies, elements)
    check_axes(elements)
    check_supports(bodies, elements)
    names = [f"{body.name}.{one}" for body in bodies for one in _MOTIONS]
    of_body = {body.name: BODY_STATES * i for i, body in enumerate(bodies)}
    own, works, kept = {}, {}, {}
    for one in elements:
        own[one.name] = [*range(len(names), len(names) + len(one.states))]
        names += [f"{one.name}.{state.name}" for state in one.states]
    for one in elements:
        others = [*one.angles, *(lag.name for lag in one.lags)]
        own[one.name] += range(len(names), len(names) + len(others))
        names += [f"{one.name}.{other}" for other in others]
    for one in elements:
        for label in (f"{one.name}.{work}" for work in one.works):
            works[label] = len(names)
            names.append(f"energy.{label}")
    losses, bounds = dict[str, int](), dict[str, int]()
    heads = {one.name: f"{one.name}." if losses_by_element else "" for one in elements}
    lost = [f"{heads[one.name]}{loss}" for one in elements for loss in one.losses]
    for places, labels in ((losses, lost), (bounds, [b for one in elements for b in one.bounds])):
        for label in dict.fromkeys(labels):
            places[label] = len(names)
            names.append(f"energy.{label}")
    size = len(names)
    for one in elements:
        kept[one.name] = size
        size += one.kept_size()
    numbers, memory = [flatten(oil.parameters())], []
    kinds = shipped_kinds() if kinds is None else kinds
    ports = {one.name: one for one in elements}
    listed, rows, shapes, curved = list[Listed](), [], [], list[str]()
    at_number, at_memory, at_output, at_exchanged = numbers[0].size, 0, 0, 0
    for one in elements:
        constants, room = one.numbers_among(bodies), one.memory_among(bodies)
        beside = [ports.get(getattr(one, field)) for field in one.beside]
        at = (
            *(of_body[getattr(one, field)] for field in one.on),
            *own[one.name],
            *(works[f"{one.name}.{work}"] for work in one.works),
            *(losses[f"{heads[one.name]}{loss}"] for loss in one.losses),
            *(bounds[bound] for bound in one.bounds),
            *((kept[one.name],) if one.kept_size() else ()),
            *(0 if other is None else kept[other.name] + other.torque_at for other in beside),
            *one.sizes(),
        )
        numbers.append(flatten(constants))
        memory.append(room)
        listed.append(Listed(type(constants), one.variants(), len(at)))
        number = kinds.index(listed[-1]) if listed[-1] in kinds else UNKNOWN
        first = number, at_number, at_memory, room.size, at_output, at_exchanged
        which = LINEAR if one.linear_among(bodies) else CURVED
        rows.append((*first, one.kept_size(), len(at), which, *at))
        curved += [getattr(one, field) for field in one.on] if which == CURVED else []
        shapes.append(_shape(rows[-1], len(one.sizes())))
        at_output += len(one.outputs)
        at_exchanged += len(one.levels) + len(one.events)
        at_number += numbers[-1].size
        at_memory += room.size
    laws = (*oil.own_laws(), FORMULA_LAWS)[0]
    own_states = sum(len(one.states) for one in elements)
    energies = len(works) + len(losses) + len(bounds)
    outputs = train_outputs(bodies, elements, works, losses, bounds)
    touched = [
        of_body[body.name] + i
        for body in bodies
        if exponential > 0 and body.name in curved
        for i, c in enumerate(COORDINATES)
        if isinstance(body, Node) or c not in body.held
    ]
    sizes = Sizes(
        elements=len(elements),
        carriers=sum(one.carries for one in elements),
        bodies=len(bodies),
        shown=sum(not isinstance(one, Node | Hidden) for one in bodies),
        nodes=sum(isinstance(one, Node) for one in bodies),
        own=own_states,
        first_mobility=at_number,
        integrated=len(names),
        states=size + energies + 1,
        kept=size,
        outputs=at_output,
        works=len(works),
        losses=len(losses),
        energies=energies,
        exchanged=at_exchanged,
        written=len(outputs),
        free=sum(c not in body.held for body in bodies for c in COORDINATES),
        touched=len(touched),
        exponential=exponential,
    )
    return Assembly(
        bodies,
        elements,
        tuple(listed),
        laws,
        sizes,
        pack_plan(sizes, rows, touched),
        tuple(pack_plan(sizes, shapes).tolist()),
        np.concatenate([*numbers, *(body.mobility for body in bodies)]),
        _with_room(np.concatenate([*memory, np.zeros(1)]), int(room_size(sizes))),
        tuple(names),
        works,
        losses,
        bounds,
        outputs,
        kept,
        continuous_states(bodies, elements, names, kept, outputs),
        event_indicators(elements, len(names)),
    )


def _with_room(memory: Array, size: int) -> Array:
    """Return a memory with room behind it, which begins where a line of the processor's does."""
    whole = np.zeros(memory.size + size + LINE)
    place = whole.ctypes.data // whole.itemsize + memory.size
    found = whole[-place % LINE :][: memory.size + size]
    found[: memory.size] = memory
    return found


def _shape(row: Sequence[int], sizes: int) -> list[int]:
    """Return a row of the plan without its kind and what the size of a table decides."""
    by_table = [OF_TABLES if row[N_MEMORY] else 0] * 2
    head = [UNKNOWN, row[NUMBER], *by_table, *row[N_MEMORY + 1 : AT]]
    return [*head, *row[AT : len(row) - sizes], *sizes * [OF_TABLES]]


def _check_names(bodies: Sequence[Body], elements: Sequence[Element]) -> None:
    """Raise ParameterError unless all names are unique and those that are referred to exist."""
    there = {"bodies": [one.name for one in bodies], "elements": [one.name for one in elements]}
    ports = [one.name for one in elements if one.works and one.kept_size()]
    nodes = {one.name: one.name.partition(".")[0] for one in bodies if isinstance(one, Node)}
    for what, names in there.items():
        for name in names:
            if names.count(name) > 1:
                raise ParameterError(f"{what} must have names of their own, got {name!r} twice.")
    for one in elements:
        if one.states and not hasattr(type(one.numbers()), "at_rest"):
            raise ParameterError(
                f"{one.name} has own states, so its kernels must include at_rest, which writes "
                "about what they are at rest."
            )
        asked = [("bodies", there["bodies"], getattr(one, field)) for field in one.on]
        on = [name for _, _, name in asked]
        if len(set(on)) < len(on):
            raise ParameterError(
                f"{one.name} must act on {len(on)} different bodies, got {', '.join(on)}. "
                "Name another one."
            )
        if one.on in _BETWEEN_PARTS and len({nodes.get(name, name) for name in on}) == 1:
            raise ParameterError(
                f"{one.name} must act between two bodies, got {' and '.join(on)} of one. Name a "
                f"node of another body, or the ground, as its {one.on[1]}."
            )
        asked += [("ports", ports, getattr(one, field)) for field in one.beside]
        for what, names, name in asked:
            if name is not None and name not in names:
                known = ", ".join(one for one in names if ".modes_" not in one) or "none"
                raise ParameterError(
                    f"{one.name} names {name!r}, which is not among the {what} of the train. "
                    f"There are: {known}.{is_it(name, names)}"
                )
