"""C text of a model's tables, for the FMI functions in `plumbing`."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from fmu_src.native.model import NativeModel, Operation
from fmu_src.variable import Variable
from gearlube_core.arrays import Array
from gearlube_core.dynamics.ranges import RANGE_EXCEEDED
from gearlube_core.dynamics.stepped_model import MAX_STEP

_INDEX = re.compile(r"\[(\d+)\]")
PLUMBING = Path(__file__).with_name("plumbing")
_KINDS = {"Real": "GL_REAL", "Integer": "GL_INTEGER", "Enumeration": "GL_INTEGER",
          "Boolean": "GL_BOOLEAN"}  # fmt: skip
_CAUSALITIES = {"parameter": "GL_PARAMETER", "input": "GL_INPUT", "output": "GL_OUTPUT",
                "local": "GL_OUTPUT"}  # fmt: skip
_NUMBERS_A_LINE = 8


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


def text_literal(text: str) -> str:
    """Return a C string: ASCII, without what a compiler reads as a sign of its own."""
    return f'"{"".join(map(_character, text.encode("ascii", "replace").decode()))}"'


def _character(sign: str) -> str:
    if sign in '\\"?':  # two question marks begin a trigraph
        return "\\" + sign
    return sign if sign.isprintable() else f"\\{ord(sign):03o}"


def number_literal(value: float) -> str:
    """Return a C number that is exactly `value`."""
    if math.isnan(value):
        return "NAN"
    if math.isinf(value):
        return "INFINITY" if value > 0.0 else "-INFINITY"
    return float(value).hex()


def _array(declaration: str, items: Iterable[str]) -> str:
    rows = ",\n    ".join(items)
    return f"{declaration} = {{\n    {rows},\n}};\n"


def _numbers(values: Array) -> list[str]:
    texts = [number_literal(value) for value in values.tolist()]
    steps = range(0, len(texts), _NUMBERS_A_LINE)
    return [", ".join(texts[i : i + _NUMBERS_A_LINE]) for i in steps]


def _places(variables: Sequence[Variable], output_names: Sequence[str]) -> list[int]:
    """Return the place of each variable among parameters, inputs or outputs of the model."""
    counts = {"parameter": 0, "input": 0}
    places = []
    for variable in variables:
        if variable.is_computed:
            places.append(output_names.index(variable.name))
        elif variable.option_of:
            places.append(-1)
        else:
            places.append(counts[variable.causality])
            counts[variable.causality] += 1
    return places


_BITS = {
    Operation.DERIVATIVES: "GL_OF_RATES",
    Operation.FLANKS: "GL_OF_FLANKS",
    Operation.BEARINGS: "GL_OF_BEARINGS",
    Operation.RACEWAYS: "GL_OF_RACEWAYS",
}


def _needs(variable: Variable, model: NativeModel) -> str:
    """Return what has to be computed before a variable is read."""
    if not variable.is_computed:
        return "GL_NOTHING"
    if variable.name in model.motion:
        return "GL_OF_MOTION"
    for operation, names in model.groups.items():
        if variable.name in names:
            return _BITS[operation]
    is_rate = model.exchange and (variable.rate_of or variable.name in model.exchange.indicators)
    return "GL_OF_RATES" if is_rate else "GL_OF_OUTPUTS"


def _exchange_tables(model: NativeModel) -> list[str]:
    """Return the tables of model exchange; C knows none without elements."""
    exchange, references = model.exchange, model.definition.references
    states, indicators = ["{0, 0, 1.0}"], ["0"]
    if exchange:
        rates = exchange.rates(model.definition)
        states = [
            f"{{{references[name]}, {references[rate]}, {number_literal(unit)}}}"
            for name, rate, unit in zip(exchange.states, rates, exchange.units, strict=True)
        ]
        indicators = [str(references[name]) for name in exchange.indicators]
    return [
        _array("const gl_continuous_state gl_states[]", states),
        _array("const int gl_indicators[]", indicators),
    ]


def model_sizes(model: NativeModel, guid: str) -> str:
    """Return `model_sizes.h`."""
    definition = model.definition
    sizes = {
        "VARIABLES": len(definition.variables),
        "PARAMETERS": sum(v.is_model_parameter for v in definition.variables),
        "INPUTS": sum(v.causality == "input" for v in definition.variables),
        "OUTPUTS": len(definition.output_names),
        "STATE": model.state_size,
        "CONTROL_AT": model.control_at,
        "WORK": model.work_size,
        "LIMITS_AT": model.limits_at,
        "RANGES_AT": model.ranges_at,
        "RANGES": len(model.ranges),
        "REFUSALS": len(model.refusals),
        "LAZY": int(bool(model.motion)),
        "CONTINUOUS": len(model.exchange.states) if model.exchange else 0,
        "INDICATORS": len(model.exchange.indicators) if model.exchange else 0,
        "INPUTS_AT": model.exchange.inputs_at if model.exchange else 0,
        "EXCEEDED": definition.references[RANGE_EXCEEDED],
    }
    lines = [f"#define GL_{name} {size}" for name, size in sizes.items()]
    return "\n".join(
        [
            "/* Generated from the list of FMI variables. */",
            "#ifndef GEARLUBE_MODEL_SIZES_H",
            "#define GEARLUBE_MODEL_SIZES_H",
            f"#define GL_MODEL_NAME {text_literal(definition.name)}",
            f"#define GL_GUID {text_literal(guid)}",
            *lines,
            f"#define GL_LONGEST_STEP {MAX_STEP!r} /* s */",
            "#endif\n",
        ]
    )


def model_tables(model: NativeModel) -> str:
    """Return `model_tables.c`."""
    definition = model.definition
    variables, references = definition.variables, definition.references
    literals, rows = [], []
    for i, (variable, place) in enumerate(
        zip(variables, _places(variables, definition.output_names), strict=True)
    ):
        names = "0"
        if variable.literals:
            names = f"literals_{i}"
            items = map(text_literal, variable.literals)
            literals.append(_array(f"static const char *const {names}[]", items))
        low, high = variable.range
        unit = "" if variable.unit == "1" else variable.unit
        option = references[variable.option_of] if variable.option_of else -1
        rows.append(
            f"{{{text_literal(variable.name)}, {text_literal(unit)}, {names}, "
            f"{number_literal(variable.start or 0.0)}, {number_literal(low)}, "
            f"{number_literal(high)}, {number_literal(variable.nominal or 1.0)}, "
            f"{_KINDS[variable.type]}, {_CAUSALITIES[variable.causality]}, {place}, {option}, "
            f"{_needs(variable, model)}}}"
        )
    arrays = {one.references[0]: one.references for one in array_variables(variables)}
    members = [
        _array(f"static const unsigned members_{first}[]", map(str, references))
        for first, references in arrays.items()
    ]
    of_arrays = [
        f"{{{len(arrays[i])}, members_{i}}}" if i in arrays else "{0, 0}"
        for i in range(len(variables))
    ]
    refusals = [f"{{{status}, {text_literal(text)}}}" for status, text in model.refusals.items()]
    ranges = [
        f"{{{text_literal(one.output)}, {text_literal(one.what)}, "
        f"{text_literal('' if one.unit == '1' else one.unit)}, {text_literal(one.beyond)}, "
        f"{references[one.output]}}}"
        for one in model.ranges
    ]
    inputs = map(str, definition.references_of("input"))
    outputs = (str(references[name]) for name in definition.output_names)
    return "\n".join(
        [
            "/* Generated from the list of FMI variables. */",
            '#include "model.h"\n',
            "#include <math.h>\n",
            *literals,
            *members,
            _array("const gl_variable gl_variables[GL_VARIABLES]", rows),
            _array("const gl_array gl_arrays[GL_VARIABLES]", of_arrays),
            _array("const int gl_inputs[GL_INPUTS]", inputs),
            _array("const int gl_outputs[GL_OUTPUTS]", outputs),
            *_exchange_tables(model),
            _array("const gl_refusal gl_refusals[GL_REFUSALS]", refusals),
            _array("const gl_range gl_ranges[GL_RANGES]", ranges),
            _array("const double gl_data[]", _numbers(model.data)),
        ]
    )


def c_sources(model: NativeModel, guid: str) -> dict[str, str]:
    """Return all C files of a native FMU by name, the headers of FMI left out."""
    files = {path.name: path.read_text("utf-8") for path in sorted(PLUMBING.glob("*.[ch]"))}
    files["model_sizes.h"] = model_sizes(model, guid)
    files["model_tables.c"] = model_tables(model)
    return files
