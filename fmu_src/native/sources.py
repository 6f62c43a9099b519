"""C files of a native FMU: the FMI functions in `plumbing`, and the sizes of a model."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple
from zlib import crc32

import numpy as np

from fmu_src.native.model import NativeModel
from fmu_src.variable import Variable
from gearlube_core.dynamics.ranges import RANGE_EXCEEDED
from gearlube_core.dynamics.train.stepped_model import MAX_STEP

_INDEX = re.compile(r"\[(\d+)\]")
PLUMBING = Path(__file__).with_name("plumbing")
_ANY = -1  # length that the file of the model gives
_A_LINE = 24


class Most(NamedTuple):
    """Sizes that a library for models of any sizes has room for; instances have room for all."""

    variables: int
    parameters: int
    inputs: int
    outputs: int
    state: int
    ranges: int


MOST = Most(variables=4096, parameters=64, inputs=64, outputs=4096, state=8192, ranges=31)


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


def _macro(name: str, numbers: Sequence[int]) -> list[str]:
    """Return the lines that define the initialiser of an array."""
    rows = (numbers[i : i + _A_LINE] for i in range(0, len(numbers), _A_LINE))
    return [f"#define {name} {{ \\", *(f"    {', '.join(map(str, row))}, \\" for row in rows), "}"]


def model_sizes(model: NativeModel, kind: str) -> str:
    """Return `model_sizes.h`: all that a library knows of its model.

    Parameters
    ----------
    model : NativeModel
    kind : str
        Token that the file of the model must have.
    """
    variables = model.definition.variables
    any_length = bool(model.kind)
    own = sizes_of(model)
    most = MOST._asdict() if model.any_sizes else own
    sizes = {
        **{f"MOST_{name.upper()}": most[name] for name in MOST._fields},
        "SIZES": f"{{ {', '.join(map(str, own.values()))} }}",
        "ANY_SIZES": int(model.any_sizes),
        "EXCHANGE": int(model.exchange is not None),
        "LAZY": int(bool(model.motion)),
        "DATA": _ANY if any_length else len(model.data),
        "WORK": _ANY if any_length else model.work_size,
        "DATA_SUM": f"{_data_sum(model)}u",
    }
    options = [len(variable.literals) for variable in variables if variable.is_model_parameter]
    if any_length:
        options = [_ANY if count else 0 for count in options]
    if model.any_sizes:
        options = [0] * MOST.parameters
        del sizes["SIZES"]
    lines = [f"#define GL_{name} {size}" for name, size in sizes.items()]
    return "\n".join(
        [
            "/* Generated from the list of FMI variables. */",
            "#ifndef GEARLUBE_MODEL_SIZES_H",
            "#define GEARLUBE_MODEL_SIZES_H",
            f'#define GL_MODEL_NAME "{library_name(model)}"',
            f'#define GL_KIND "{kind}" /* of which the file of the model must be */',
            *lines,
            "/* How many options each parameter of the model has. */",
            *_macro("GL_OPTIONS", options),
            f"#define GL_LONGEST_STEP {MAX_STEP!r} /* s */",
            "#endif\n",
        ]
    )


def sizes_of(model: NativeModel) -> dict[str, int]:
    """Return the sizes of a model, as `gl_sizes` of `model.h` has them."""
    definition, exchange = model.definition, model.exchange
    variables = definition.variables
    return {
        "variables": len(variables),
        "parameters": sum(v.is_model_parameter for v in variables),
        "inputs": sum(v.causality == "input" for v in variables),
        "outputs": len(definition.output_names),
        "state": model.state_size,
        "control_at": model.control_at,
        "limits_at": model.limits_at,
        "ranges_at": model.ranges_at,
        "ranges": len(model.ranges),
        "continuous": len(exchange.states) if exchange else 0,
        "indicators": len(exchange.indicators) if exchange else 0,
        "inputs_at": exchange.inputs_at if exchange else 0,
        "exceeded": definition.references.get(RANGE_EXCEEDED, 0),
    }


def fits_any_sizes(model: NativeModel) -> bool:
    """Whether a library for models of any sizes has room for this one."""
    sizes = sizes_of(model)
    return all(sizes[name] <= most for name, most in MOST._asdict().items())


def library_name(model: NativeModel) -> str:
    """Return the name of a library in messages."""
    return "Train" if model.any_sizes else model.definition.name


def _data_sum(model: NativeModel) -> int:
    """Return the checksum of the data that a library for one model alone takes; else 0."""
    if model.kind or model.entry is None:
        return 0
    return crc32(np.asarray(model.data, dtype="<f8").tobytes())


def c_sources(model: NativeModel, kind: str = "") -> dict[str, str]:
    """Return all C files of a native FMU by name, the headers of FMI left out."""
    files = {path.name: path.read_text("utf-8") for path in sorted(PLUMBING.glob("*.[ch]"))}
    files["model_sizes.h"] = model_sizes(model, kind)
    return files
