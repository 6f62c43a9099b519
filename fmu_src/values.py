"""The values of all variables of one instance, and the rules for reading and setting them."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from uuid import UUID

import numpy as np
from numpy.typing import NDArray

from fmu_src.definition import Definition, Value
from fmu_src.variable import Variable
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

_MAGIC = b"gearlube"
_FORMAT = 1
# magic, format, GUID, phase, time [s], number of values, length of the model state, CRC-32 of both
_HEADER = struct.Struct("<8sI16sIdIII")
_CACHED_INDICES = 64  # lists of references whose index is cached; hosts repeat a few


@dataclass(frozen=True, slots=True, kw_only=True)
class Snapshot:
    """Saved state of a slave.

    Parameters
    ----------
    phase : int
        Place in the FMI state machine.
    time : float
        Communication point [s].
    values : ndarray, shape (variables,)
        Every variable, in its FMI unit.
    model : ndarray, shape (n,)
        State of the model; empty before initialisation.
    """

    phase: int
    time: float
    values: Array
    model: Array

    def to_bytes(self, guid: UUID) -> bytes:
        """Return the snapshot, marked with the GUID of the FMU it belongs to."""
        values = np.ascontiguousarray(self.values, dtype="<f8").tobytes()
        model = np.ascontiguousarray(self.model, dtype="<f8").tobytes()
        checksum = zlib.crc32(model, zlib.crc32(values))
        header = _HEADER.pack(
            _MAGIC, _FORMAT, guid.bytes, self.phase, self.time,
            len(self.values), len(self.model), checksum,
        )  # fmt: skip
        return header + values + model

    @classmethod
    def from_bytes(cls, content: bytes, guid: UUID) -> Snapshot:
        """Return the snapshot in `content`; raise ParameterError if damaged or of another FMU."""
        if len(content) < _HEADER.size or content[: len(_MAGIC)] != _MAGIC:
            raise ParameterError("The FMU state was not written by a gearlube FMU.")
        _, form, owner, phase, time, n_values, n_model, checksum = _HEADER.unpack_from(content)
        if form != _FORMAT:
            raise ParameterError(
                f"The FMU state must have format {_FORMAT}, got {form}. "
                "Save it again with this version of gearlube."
            )
        if owner != guid.bytes:
            raise ParameterError(
                f"The FMU state must come from the FMU with GUID {guid}, "
                f"got {UUID(bytes=owner)}. Restore it in the FMU that wrote it."
            )
        numbers = content[_HEADER.size :]
        if len(numbers) != 8 * (n_values + n_model) or zlib.crc32(numbers) != checksum:
            raise ParameterError("The FMU state is damaged: length or checksum do not agree.")
        data = np.frombuffer(numbers, dtype="<f8").astype(np.float64)
        return cls(phase=phase, time=time, values=data[:n_values], model=data[n_values:])


def _access(variable: Variable) -> str:
    """Return the kind of FMI call for `variable`: FMI 2 reads an Enumeration as Integer."""
    return "Integer" if variable.type == "Enumeration" else variable.type


def _limits(variable: Variable) -> str:
    if variable.literals:
        return "one of " + ", ".join(
            f"{value} ({literal})" for value, literal in enumerate(variable.literals, start=1)
        )
    low, high = variable.range
    unit = "" if variable.unit in ("", "1") else f" {variable.unit}"
    return f"within {low:g} to {high:g}{unit}"


class Values:
    """One float64 array, indexed by value reference.

    Parameters
    ----------
    definition : Definition
        The FMU; it gives types, ranges and start values.
    on_refusal : callable
        Called with an error text at once when a bad value is set.

    Notes
    -----
    Integers, enumerations and Booleans are exact in a float64. A value outside its range is stored
    and named in `refused` until a legal one replaces it.
    """

    def __init__(self, definition: Definition, on_refusal: Callable[[str], None]) -> None:
        self._table = definition.variables
        self._on_refusal = on_refusal
        self._indices: dict[tuple[str, tuple[int, ...]], NDArray[np.intp]] = {}
        self._settable: dict[str, dict[int, tuple[float, float]]] = {}
        references = definition.references
        self._inputs = np.array(definition.references_of("input"), dtype=np.intp)
        self._outputs = np.array([references[n] for n in definition.output_names], dtype=np.intp)
        self.array: Array = np.array([v.start or 0.0 for v in self._table])
        self.refused: dict[int, str] = {}
        self.allow_setting("input", "parameter")

    def allow_setting(self, *causalities: str) -> None:
        """From now on only variables of these causalities can be set."""
        self._settable = {}
        for reference, variable in enumerate(self._table):
            if variable.causality in causalities:
                self._settable.setdefault(_access(variable), {})[reference] = variable.range

    def inputs(self) -> list[float]:
        """Return the inputs in the order of the table."""
        return self.array[self._inputs].tolist()

    def start_inputs(self) -> list[float]:
        """Return the start values of the inputs."""
        return [v.start or 0.0 for v in self._table if v.causality == "input"]

    def parameters(self) -> dict[str, Value]:
        """Return the parameters by name, enumerations as literals, also those set by number."""
        given = zip(self._table, self.array.tolist(), strict=True)
        values = {v.name: (v, value) for v, value in given if v.causality == "parameter"}
        numbers = [one for one in values.values() if one[0].option_of]
        for variable, number in numbers:
            del values[variable.name]
            if number != 0.0:
                option, _ = values[variable.option_of]
                values[option.name] = option, number
        return {name: variable.decoded(value) for name, (variable, value) in values.items()}

    def store_outputs(self, outputs: Array) -> None:
        """Copy the outputs of the model."""
        self.array[self._outputs] = outputs

    def index(self, kind: str, vrs: Sequence[int]) -> NDArray[np.intp]:
        """Return `vrs` as an index into `array`, checked once and cached."""
        key = (kind, tuple(vrs))
        index = self._indices.get(key)
        if index is None:
            for vr in vrs:
                self._check_kind(kind, vr)
            if len(self._indices) >= _CACHED_INDICES:
                self._indices.clear()
            index = self._indices[key] = np.array(vrs, dtype=np.intp)
        return index

    def _check_kind(self, kind: str, vr: int) -> None:
        last = len(self._table) - 1
        if not 0 <= vr <= last:
            raise ParameterError(f"The value reference must be within 0 to {last}, got {vr}.")
        variable = self._table[vr]
        if _access(variable) != kind:
            raise ParameterError(
                f"{variable.name} must be accessed as {_access(variable)}, got {kind}. "
                f"Its type is {variable.type}."
            )

    def assign(self, kind: str, vrs: Sequence[int], values: Sequence[float]) -> None:
        """Set variables; note values out of range in `refused`; raise if the call is illegal."""
        settable = self._settable.get(kind, {})
        for vr, value in zip(vrs, values, strict=True):
            limits = settable.get(vr)
            if limits is None:
                self._check_kind(kind, vr)
                variable = self._table[vr]
                raise ParameterError(
                    f"{variable.name} must not be set in this phase of the simulation, "
                    f"it is a {variable.variability} {variable.causality}. "
                    "Set parameters before the end of initialisation."
                )
            self.array[vr] = value
            if not limits[0] <= value <= limits[1]:
                self._refuse(vr, value)
            elif self.refused:
                self.refused.pop(vr, None)

    def _refuse(self, vr: int, value: float) -> None:
        variable = self._table[vr]
        self.refused[vr] = f"{variable.name} must be {_limits(variable)}, got {value}."
        self._on_refusal(f"{self.refused[vr]} No step is taken until a legal value replaces it.")

    def restore(self, array: Array) -> None:
        """Take over saved values, legal or not."""
        self.array[:] = array
        self.refused.clear()
        for by_reference in self._settable.values():
            for vr, (low, high) in by_reference.items():
                if not low <= self.array[vr] <= high:
                    self._refuse(vr, float(self.array[vr]))
