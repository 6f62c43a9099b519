"""`resources/model.bin` of a native FMU: what its library reads, see `model_file.c`."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence
from uuid import UUID

import numpy as np

from fmu_src.native.model import Group, NativeModel
from fmu_src.native.sources import array_variables, sizes_of
from fmu_src.variable import Variable

MODEL_FILE = "model.bin"
MARK, KIND_SIZE, GUID_SIZE = b"gearmod2", 40, 40
COUNTS_AT = len(MARK) + KIND_SIZE + GUID_SIZE
N_COUNTS = 19  # data, work, text, members, refusals, literals, `sizes_of`
CHECKSUM_AT = COUNTS_AT + 4 * N_COUNTS
HEAD_SIZE = CHECKSUM_AT + 4
# as the enumerations of `model.h` count
_KINDS = {"Real": 0, "Integer": 1, "Enumeration": 1, "Boolean": 2}
_CAUSALITIES = {"parameter": 0, "input": 1, "output": 2, "local": 2}
_NOTHING, _OF_MOTION, _OF_OUTPUTS = 0, 1, 16


class _Words:
    """All words of a file, each once, with a zero behind."""

    def __init__(self) -> None:
        self.text = b"\0"
        self._places = {"": 0}

    def place(self, word: str) -> int:
        if word not in self._places:
            self._places[word] = len(self.text)
            self.text += word.encode("ascii", "replace").replace(b"\0", b"?") + b"\0"
        return self._places[word]


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


def _needs(variable: Variable, model: NativeModel) -> int:
    """Return the computation that a variable needs before it is read."""
    if not variable.is_computed:
        return _NOTHING
    if variable.name in model.motion:
        return _OF_MOTION
    for group, names in model.groups.items():
        if variable.name in names:
            return int(group)
    is_rate = model.exchange and (variable.rate_of or variable.name in model.exchange.indicators)
    return int(Group.RATES) if is_rate else _OF_OUTPUTS


def model_body(model: NativeModel) -> tuple[bytes, list[int]]:
    """Return what follows the head, and the counts of the head."""
    definition, exchange = model.definition, model.exchange
    variables, references = definition.variables, definition.references
    words, rows, numbers = _Words(), list[int](), list[float]()
    members = {one.references[0]: one.references for one in array_variables(variables)}
    places = _places(variables, definition.output_names)
    for i, (variable, place) in enumerate(zip(variables, places, strict=True)):
        numbers += [variable.start or 0.0, *variable.range, variable.nominal or 1.0]
        rows += [
            words.place(variable.name),
            words.place(_unit(variable.unit)),
            _KINDS[variable.type],
            _CAUSALITIES[variable.causality],
            place,
            references[variable.option_of] if variable.option_of else -1,
            _needs(variable, model),
            len(members.get(i, ())),
            len(variable.literals),
        ]
    rows += [words.place(literal) for variable in variables for literal in variable.literals]
    in_order = [reference for first in sorted(members) for reference in members[first]]
    rows += [*in_order, *definition.references_of("input")]
    rows += [references[name] for name in definition.output_names]
    if exchange:
        rates = exchange.rates(definition)
        for name, rate, place in zip(exchange.states, rates, exchange.places, strict=True):
            rows += [references[name], references[rate], place]
        rows += [references[name] for name in exchange.indicators]
        numbers += exchange.units
    for status, text in model.refusals.items():
        rows += [status, words.place(text)]
    for one in model.ranges:
        texts = (one.output, one.what, _unit(one.unit), one.beyond)
        rows += [*map(words.place, texts), references[one.output]]
    body = b"".join(
        [
            np.asarray(model.data, dtype="<f8").tobytes(),
            np.array(numbers, dtype="<f8").tobytes(),
            np.array(rows, dtype="<i4").tobytes(),
            words.text,
        ]
    )
    n_literals = sum(len(variable.literals) for variable in variables)
    of_model = [len(model.data), model.work_size, len(words.text)]
    counts = [*of_model, len(in_order), len(model.refusals), n_literals, *sizes_of(model).values()]
    return body, counts


def _unit(unit: str) -> str:
    return "" if unit == "1" else unit


def model_file(model: NativeModel, kind: str, guid: str | UUID) -> bytes:
    """Return the file of a model for libraries of a kind, with the GUID of the description."""
    body, counts = model_body(model)
    head = MARK + kind.encode().ljust(KIND_SIZE, b"\0") + str(guid).encode().ljust(GUID_SIZE, b"\0")
    return with_checksum(head + struct.pack(f"<{N_COUNTS}i", *counts) + bytes(4) + body)


def with_checksum(content: bytes) -> bytes:
    """Return a file with the checksum that fits its other bytes."""
    head, body = content[:CHECKSUM_AT], content[HEAD_SIZE:]
    return head + struct.pack("<I", zlib.crc32(body, zlib.crc32(head))) + body
