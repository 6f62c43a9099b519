"""Variables of FMI 3: arrays where FMI 2 has one variable for each element."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from fmu_src.variable import Variable

_INDEX = re.compile(r"\[(\d+)\]")


@dataclass(frozen=True, slots=True)
class ArrayVariable:
    """A variable of FMI 3; its value reference is that of its first element.

    Parameters
    ----------
    variable : Variable
        Under its name in FMI 3.
    references : tuple of int
        Places of its elements in the table of variables; one for a scalar.
    """

    variable: Variable
    references: tuple[int, ...]


def array_variables(variables: Sequence[Variable]) -> list[ArrayVariable]:
    """Return the variables of FMI 3, ordered by reference.

    `flank[1].load`, `flank[2].load` and `flank[3].load` become the array `flank.load`. A variable
    with two indices, or without a [1] to [n] of its kind, stays as it is.
    """
    families: dict[str, dict[int, int]] = {}
    for reference, variable in enumerate(variables):
        indices = _INDEX.findall(variable.name)
        if len(indices) == 1:
            family = families.setdefault(_INDEX.sub("", variable.name), {})
            family[int(indices[0])] = reference
    found = {}
    for name, family in families.items():
        if len(family) > 1 and sorted(family) == list(range(1, len(family) + 1)):
            members = tuple(family[i] for i in sorted(family))
            first = variables[members[0]]
            described = re.sub(r"(,| of) [a-z]+( [a-z]+)? 1$", "", first.description)
            variable = replace(first, name=name, description=described + _each(first.name))
            found[members[0]] = ArrayVariable(variable, members)
    inside = {reference for one in found.values() for reference in one.references}
    for reference, variable in enumerate(variables):
        if reference not in inside:
            found[reference] = ArrayVariable(variable, (reference,))
    return [found[reference] for reference in sorted(found)]


def _each(name: str) -> str:
    """Return what the elements belong to: `flank[1].load` -> ", of each flank"."""
    return f", of each {name.partition('[')[0]}"
