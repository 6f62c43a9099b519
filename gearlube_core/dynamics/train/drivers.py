"""Kernels of all elements of a list, out of the kernels of each, by two drivers.

`generated` calls the kernels of the elements one after the other; classes and places are constants
of the compiled code, which serves one list with tables of any size. `interpreted` goes through the
rows of the plan and branches by the kind of each element; its compiled code serves every list of
these kinds. Both sum in the order of the list, so their bits are equal.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from gearlube_core.arrays import Offsets
from gearlube_core.dynamics.train.element import Listed
from gearlube_core.dynamics.train.plan import (
    AT,
    EXCHANGED,
    FIRST_ROW,
    KIND,
    MEMORY,
    N_KEPT,
    N_MEMORY,
    N_PLACES,
    NUMBER,
    OF_TABLES,
    OUTPUT,
    WHICH,
    Sizes,
    places,
    sizes_of,
)
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel


class AllElements(NamedTuple):
    """Kernels of these names of all elements, see `element.Kernels`, and one of the sizes.

    They take the state, the oil's, numbers and memory of the assembly and the plan, then what
    those of an element take more; that of `show` at last which elements, a bit for each, and that
    of `add_forces` elements of which forces, see `plan`. That of the sizes takes the plan alone.
    """

    spread: Callable[..., None]  # of the carriers alone, as the next one
    collect: Callable[..., None]
    at_rest: Callable[..., None]
    full_contact: Callable[..., None]
    ease: Callable[..., float]  # sum
    begin: Callable[..., None]
    expand: Callable[..., None]
    each_step: Callable[..., float]  # sum
    after_part: Callable[..., None]
    after_step: Callable[..., None]
    step_rate: Callable[..., float]  # greatest
    stiffening: Callable[..., float]  # greatest
    finish: Callable[..., None]
    time_to_jump: Callable[..., float]  # least
    stored_energy: Callable[..., float]  # sum
    add_forces: Callable[..., None]
    after_forces: Callable[..., None]
    event: Callable[..., None]
    write: Callable[..., None]
    show: Callable[..., None]
    exchange: Callable[..., None]
    check: Callable[..., float]  # least; of `interpreted` alone is it called
    sizes_of: Callable[[Offsets], Sizes]


_GIVEN = "s, oil, numbers, memory, plan"
# what kernels take more, a line for each element, what they return
_LINES = {
    "spread": ("", "{call}", "None"),
    "collect": (", ds", "{call}", "None"),
    "at_rest": ("", "{call}", "None"),
    "full_contact": ("", "{call}", "None"),
    "ease": (", share", "total += {call}", "total"),
    "begin": ("", "{call}", "None"),
    "expand": ("", "{call}", "None"),
    "each_step": (", h", "total += {call}", "total"),
    "after_part": (", h", "{call}", "None"),
    "after_step": (", h", "{call}", "None"),
    "step_rate": ("", "total = max(total, {call})", "total"),
    "stiffening": ("", "total = max(total, {call})", "total"),
    "finish": ("", "{call}", "None"),
    "time_to_jump": (", h", "total = min(total, {call})", "total"),
    "stored_energy": ("", "total += {call}", "total"),
    "add_forces": (", stage, ds, which", "{call}", "None"),
    "after_forces": (", stage, ds", "{call}", "None"),
    "event": ("", "{call}", "None"),
    "write": (", out", "{call}", "None"),
    "show": (", stage, out, only", "{call}", "None"),
    "exchange": (", out", "{call}", "None"),
    "check": ("", "total = min(total, {call})", "total"),
}
# of a row: what these take last
_LAST = {"write": OUTPUT, "show": OUTPUT, "exchange": EXCHANGED, "check": N_KEPT}
_LAST_BIT = 62  # in `only`; all elements behind share it
_OF_CARRIERS = ("spread", "collect")
_INSIDE = ("add_forces", "after_forces", *_OF_CARRIERS)  # of each stage
_BEGIN = {"time_to_jump": "math.inf", "check": "1.0"}


class _Source:
    """Source of a function that makes one kernel of every name for all elements.

    Its arguments are classes, kernels and whole numbers, which become constants of the compiled
    code: the cache on disk distinguishes them, as it does not distinguish numbers in the text.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.given: dict[str, Any] = {
            "kernel": kernel,
            "inside": inside,
            "part": part,
            "places": places,
            "tuple_from_array": tuple_from_array,
            "rows_of": sizes_of,
        }

    def constants(self, i: int, one: Listed) -> str:
        """Declare the classes of an element; return the code of its constants but their place."""
        self.given |= {f"e{i}": one.numbers, f"c{i}": count_floats(one.numbers, *one.variants)}
        self.given |= {f"v{i}_{k}": variant for k, variant in enumerate(one.variants)}
        chosen = "".join(f", v{i}_{k}" for k in range(len(one.variants)))
        return f"tuple_from_array(part(numbers, {{}}, c{i}), e{i}{chosen})"

    def begin(self, name: str) -> None:
        """Begin the kernel of a name."""
        self.lines += [
            "    @inside" if name in _INSIDE else "    @kernel",
            f"    def all_{name}({_GIVEN}{_LINES[name][0]}):",
            f"        total = {_BEGIN.get(name, '0.0')}",
        ]

    def call(self, name: str, i: int, one: Listed, given: str, first: str) -> str:
        """Return the line that calls the kernel of a name of an element."""
        self.given[f"{name}{i}"] = getattr(one.numbers, name)
        more, line, _ = _LINES[name]
        more = more.replace(", only", "").replace(", which", "")
        place = f", {first}" if name in _LAST else ""
        return line.format(call=f"{name}{i}({given}, s, oil{more}{place})")

    def end(self, name: str) -> None:
        """End the kernel of a name."""
        self.lines.append(f"        return {_LINES[name][2]}")

    def made(self) -> dict[str, Callable[..., Any]]:
        """Return the kernels by name."""
        text = "\n".join(
            [
                f"def make({', '.join(self.given)}):",
                *self.lines,
                f"    return {', '.join(f'all_{name}' for name in _LINES)}",
            ]
        )
        space: dict[str, Any] = {"__name__": __name__, "math": math}
        exec(compile(text, __file__, "exec"), space)
        return dict(zip(_LINES, space["make"](**self.given), strict=True))


def generated(elements: Sequence[Listed], plan: Sequence[int]) -> AllElements:
    """Return the kernels of a list, whose classes and plan are constants of the compiled code.

    A number of the plan that is OF_TABLES is read when the code runs.
    """
    source, calls, first = _Source(), [], []
    at = FIRST_ROW
    for i, one in enumerate(elements):
        row = plan[at : at + AT + one.places]
        known = tuple(number for number in row[AT:] if number != OF_TABLES)
        n_sizes = len(row) - AT - len(known)
        source.given |= {f"k{i}": row[NUMBER], f"at{i}": known}
        source.given |= {f"m{i}": at + MEMORY, f"t{i}": at + len(row) - n_sizes, f"n{i}": n_sizes}
        source.given |= {f"{name}_at{i}": row[place] for name, place in _LAST.items()}
        source.given[f"w{i}"] = row[WHICH]
        at += len(row)
        constants = source.constants(i, one).format(f"k{i}")
        own = f"at{i} + places(plan, t{i}, n{i})" if n_sizes else f"at{i}"
        memory = "part(memory, 0, 0)"
        if row[N_MEMORY] == OF_TABLES:
            memory = f"part(memory, *places(plan, m{i}, 2))"
        calls.append(f"{constants}, {own}, {memory}")
        first.append(f"{{}}_at{i}")
    for name in _LINES:
        source.begin(name)
        for i, one in enumerate(elements):
            if hasattr(one.numbers, name):
                line = source.call(name, i, one, calls[i], first[i].format(name))
                source.given |= {f"p{i}": 1 << min(i, _LAST_BIT)}
                test = f"if only & p{i}: " if name == "show" else ""
                test = f"if which & w{i}: " if name == "add_forces" else test
                source.lines.append(f"        {test}{line}")
        source.end(name)
    sizes = Sizes(*plan[:FIRST_ROW])

    @inside
    def fixed_sizes(plan: Offsets) -> Sizes:
        return sizes

    return AllElements(sizes_of=fixed_sizes, **source.made())


def interpreted(kinds: Sequence[Listed]) -> AllElements:
    """Return the kernels of every list of elements of these kinds, whose plan they read.

    The place of a kind among them is its number in the plan.
    """
    source = _Source()
    calls = []
    for i, one in enumerate(kinds):
        source.given |= {f"q{i}": i, f"n{i}": one.places}
        constants = source.constants(i, one).format(f"row[{NUMBER}]")
        memory = f"part(memory, row[{MEMORY}], row[{N_MEMORY}])"
        calls.append(f"{constants}, places(plan, at + {AT}, n{i}), {memory}")
    for name in _LINES:
        source.begin(name)
        loop = "carriers" if name in _OF_CARRIERS else "elements"
        source.lines += [
            f"        at = {FIRST_ROW}",
            f"        for i in range(rows_of(plan).{loop}):",
            f"            row = places(plan, at, {AT})",
            f"            kind = row[{KIND}]",
        ]
        having = [i for i, one in enumerate(kinds) if hasattr(one.numbers, name)]
        for i in having:
            first = f"row[{_LAST.get(name, 0)}]"
            line = source.call(name, i, kinds[i], calls[i], first)
            test = "if" if i == having[0] else "elif"
            if name == "show":
                line = f"if only & (1 << min(i, {_LAST_BIT})): {line}"
            if name == "add_forces":
                line = f"if which & row[{WHICH}]: {line}"
            source.lines += [f"            {test} kind == q{i}:", f"                {line}"]
        source.lines.append(f"            at += {AT} + row[{N_PLACES}]")
        source.end(name)
    return AllElements(sizes_of=sizes_of, **source.made())
