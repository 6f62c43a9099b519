"""Calls a native FMU library by FMI 2 and FMI 3 alike: every status and message kept."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_int64, c_size_t, c_uint32
from ctypes import c_void_p as pointer
from pathlib import Path
from typing import Any

from fmu_src.native.model import NativeModel
from fmu_src.native.sources import array_variables

OK, WARNING, DISCARD, ERROR, FATAL = range(5)

_LOGGER_2 = ctypes.CFUNCTYPE(None, pointer, c_char_p, c_int, c_char_p, c_char_p)
_LOGGER_3 = ctypes.CFUNCTYPE(None, pointer, c_int, c_char_p, c_char_p)
# kind of a variable -> (name in the calls, type) by version
_CALLS = {
    2: {
        "Real": ("Real", c_double),
        "Integer": ("Integer", c_int),
        "Enumeration": ("Integer", c_int),
        "Boolean": ("Boolean", c_int),
    },
    3: {
        "Real": ("Float64", c_double),
        "Integer": ("Int32", c_int),
        "Enumeration": ("Int64", c_int64),
        "Boolean": ("Boolean", c_bool),
    },
}
_STATES = {
    2: ("GetFMUstate", "SetFMUstate", "FreeFMUstate", "SerializedFMUstateSize",
        "SerializeFMUstate", "DeSerializeFMUstate"),
    3: ("GetFMUState", "SetFMUState", "FreeFMUState", "SerializedFMUStateSize",
        "SerializeFMUState", "DeserializeFMUState"),
}  # fmt: skip


class Callbacks(ctypes.Structure):
    """fmi2CallbackFunctions, with a logger that reads no further arguments."""

    _fields_ = (
        ("logger", _LOGGER_2),
        ("allocate", pointer),
        ("free", pointer),
        ("step_finished", pointer),
        ("environment", pointer),
    )


class EventInfo(ctypes.Structure):
    """fmi2EventInfo."""

    _fields_ = (
        ("needed", c_int),
        ("terminate", c_int),
        ("nominals", c_int),
        ("values", c_int),
        ("next", c_int),
        ("next_time", c_double),
    )


class NativeLibrary:
    """A loaded library; `call` takes a function's name without fmi2 or fmi3."""

    def __init__(self, path: Path, model: NativeModel, guid: str, version: int) -> None:
        self.version, self.guid = version, guid
        self.variables = {v.name: v for v in model.definition.variables}
        self.references = dict(model.definition.references)
        self.counts = dict.fromkeys(self.references, 1)
        if version == 3:
            arrays = array_variables(model.definition.variables)
            self.variables = {one.variable.name: one.variable for one in arrays}
            self.references = {one.variable.name: one.references[0] for one in arrays}
            self.counts = {one.variable.name: len(one.references) for one in arrays}
        self._functions = ctypes.CDLL(str(path))

    def function(self, name: str) -> Any:
        return getattr(self._functions, f"fmi{self.version}{name}")

    def names(self, *causalities: str) -> list[str]:
        return [name for name, v in self.variables.items() if v.causality in causalities]


class NativeInstance:
    """An instance, or None in `address` if it was refused."""

    def __init__(
        self,
        library: NativeLibrary,
        *,
        guid: str | None = None,
        logging: bool = True,
        resources: bytes | None = None,
        name: bytes | None = b"mass",
        exchange: bool = False,
    ) -> None:
        self.library = library
        self.log: list[tuple[int, str, str]] = []
        self.time = 0.0
        token = library.guid.encode() if guid is None else guid.encode()
        kind = "ModelExchange" if exchange else "CoSimulation"
        make = library.function(f"Instantiate{kind if library.version == 3 else ''}")
        make.restype = pointer
        if library.version == 2:
            self.callbacks = Callbacks(logger=_LOGGER_2(self._on_message_2))
            self.logger = self.callbacks.logger
            self.address = make(
                name, int(not exchange), token, resources, byref(self.callbacks), 0, int(logging)
            )
        elif exchange:
            self.logger = _LOGGER_3(self._on_message_3)
            self.address = make(
                name, token, resources, c_bool(False), c_bool(logging), None, self.logger
            )
        else:
            self.logger = _LOGGER_3(self._on_message_3)
            self.address = make(
                name, token, resources, c_bool(False), c_bool(logging), c_bool(False),
                c_bool(False), None, c_size_t(0), None, self.logger, None,
            )  # fmt: skip

    def _on_message_2(self, _host: Any, _name: Any, status: int, category: Any, text: Any) -> None:
        self.log.append((status, category.decode(), text.decode()))

    def _on_message_3(self, _host: Any, status: int, category: Any, text: Any) -> None:
        self.log.append((status, category.decode(), text.decode()))

    def call(self, name: str, *arguments: Any) -> int:
        status = self.library.function(name)(pointer(self.address), *arguments)
        assert status in range(FATAL), (name, status)
        return int(status)

    def messages(self, category: str = "") -> str:
        return "\n".join(text for _, found, text in self.log if category in ("", found))

    def access(self, action: str, kind: str, refs: Sequence[int], values: Any, count: int) -> int:
        """Call Get or Set of a kind with raw references and an array of `count` values."""
        name, _ = _CALLS[self.library.version][kind]
        raw = (c_uint32 * max(1, len(refs)))(*refs)
        counts = [c_size_t(count)] if self.library.version == 3 else []
        return self.call(action + name, raw, c_size_t(len(refs)), values, *counts)

    def get_raw(self, kind: str, refs: Sequence[int], count: int) -> tuple[int, list[Any]]:
        _, type_ = _CALLS[self.library.version][kind]
        values = (type_ * max(1, count))()
        return self.access("Get", kind, refs, values, count), list(values)[:count]

    def set_raw(self, kind: str, refs: Sequence[int], values: Sequence[Any]) -> int:
        _, type_ = _CALLS[self.library.version][kind]
        array = (type_ * max(1, len(values)))(
            *(value if type_ is c_double else int(value) for value in values)
        )
        return self.access("Set", kind, refs, array, len(values))

    def get(self, name: str) -> Any:
        """Return the value of a variable, a list if it is an array."""
        count = self.library.counts[name]
        kind = self.library.variables[name].type
        status, values = self.get_raw(kind, [self.library.references[name]], count)
        assert status == OK, self.log[-1:]
        return values if count > 1 else values[0]

    def outputs(self) -> dict[str, Any]:
        return {name: self.get(name) for name in self.library.names("output")}

    def set(self, **values: float) -> int:
        """Set variables, with __ for the dot of their names; return the worst status."""
        worst = OK
        for key, value in values.items():
            name = key.replace("__", ".")
            kind = self.library.variables[name].type
            worst = max(worst, self.set_raw(kind, [self.library.references[name]], [value]))
        return worst

    def enter(self, start: float = 0.0, stop: float | None = None) -> int:
        """Set the times and enter initialisation mode."""
        self.time = start
        times = (c_double(0.0), c_double(start), int(stop is not None), c_double(stop or 0.0))
        if self.library.version == 3:
            return self.call("EnterInitializationMode", c_bool(False), times[0], times[1],
                             c_bool(stop is not None), times[3])  # fmt: skip
        return self.call("SetupExperiment", 0, *times) or self.call("EnterInitializationMode")

    def leave(self) -> int:
        return self.call("ExitInitializationMode")

    def start(self, start: float = 0.0, stop: float | None = None, **values: float) -> int:
        return max(self.set(**values), self.enter(start, stop) or self.leave())

    def step(self, h: float = 2.0**-10, time: float | None = None) -> int:
        """Take a step; the last argument of FMI 3 must agree with our time."""
        at = self.time if time is None else time
        if self.library.version == 2:
            status = self.call("DoStep", c_double(at), c_double(h), 1)
        else:
            flags, last = (c_bool * 3)(True, True, True), c_double()
            ends = [byref(flags, i) for i in range(3)]
            status = self.call(
                "DoStep", c_double(at), c_double(h), c_bool(True), *ends, byref(last)
            )
            if status <= DISCARD:
                assert list(flags) == [False] * 3
                assert last.value == (at + h if status <= WARNING else self.time)
        if status <= WARNING:
            self.time = at + h
        return status

    def get_array(self, call: str, count: int) -> tuple[int, list[float]]:
        """Call a function of model exchange that writes so many numbers."""
        values = (c_double * max(1, count))()
        if self.library.version == 3:
            call = call.replace("GetDerivatives", "GetContinuousStateDerivatives")
        status = self.call(call, values, c_size_t(count))
        return status, list(values)[:count]

    def set_states(self, values: Sequence[float]) -> int:
        array = (c_double * max(1, len(values)))(*values)
        return self.call("SetContinuousStates", array, c_size_t(len(values)))

    def update(self) -> tuple[int, bool]:
        """Call what updates the discrete states; return whether continuous states changed."""
        if self.library.version == 2:
            info = EventInfo(1, 1, 1, 1, 1, 7.0)
            status = self.call("NewDiscreteStates", byref(info))
            if status == OK:
                assert [info.needed, info.terminate, info.nominals, info.next] == [0] * 4
            return status, bool(info.values)
        flags, time = (c_bool * 5)(*5 * [True]), c_double()
        places = [byref(flags, i) for i in range(5)]
        status = self.call("UpdateDiscreteStates", *places, byref(time))
        if status == OK:
            assert [flags[i] for i in (0, 1, 2, 4)] == [False] * 4
        return status, flags[3]

    def complete(self) -> tuple[int, bool]:
        """Complete an integrator step; return whether there is an event."""
        flag = c_int if self.library.version == 2 else c_bool
        event, terminate = flag(1), flag(1)
        ahead = flag(1)
        status = self.call("CompletedIntegratorStep", ahead, byref(event), byref(terminate))
        assert status != OK or not terminate.value
        return status, bool(event.value)

    def differentiate(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> tuple[int, list[float]]:
        """Return the derivatives of unknowns along a direction of knowns."""
        references = self.library.references
        return self.differentiate_raw(
            [references[name] for name in unknowns],
            [references[name] for name in knowns],
            seed,
            sum(self.library.counts[name] for name in unknowns),
        )

    def differentiate_back(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> tuple[int, list[float]]:
        """Return the derivatives by knowns of the sum of unknowns times their seeds; FMI 3."""
        references = self.library.references
        lists = [
            item
            for names in (unknowns, knowns)
            for item in (
                (c_uint32 * len(names))(*(references[n] for n in names)),
                c_size_t(len(names)),
            )
        ]
        found = (c_double * len(knowns))()
        status = self.call(
            "GetAdjointDerivative", *lists, (c_double * len(seed))(*seed), c_size_t(len(seed)),
            found, c_size_t(len(knowns)),
        )  # fmt: skip
        return status, list(found)

    def differentiate_raw(
        self, unknowns: Sequence[int], knowns: Sequence[int], seed: Sequence[float], count: int
    ) -> tuple[int, list[float]]:
        found = (c_double * max(1, count))()
        of_seed = (c_double * max(1, len(seed)))(*seed)
        lists = [
            item
            for refs in (unknowns, knowns)
            for item in ((c_uint32 * max(1, len(refs)))(*refs), c_size_t(len(refs)))
        ]
        if self.library.version == 2:
            status = self.call("GetDirectionalDerivative", *lists, of_seed, found)
        else:
            status = self.call(
                "GetDirectionalDerivative", *lists, of_seed, c_size_t(len(seed)), found,
                c_size_t(count),
            )  # fmt: skip
        return status, list(found)[:count]

    def save(self, place: Any = None) -> Any:
        status, state = self.try_save(place)
        assert status == OK
        return state

    def try_save(self, place: Any = None) -> tuple[int, Any]:
        state = pointer() if place is None else place
        return self.call(_STATES[self.library.version][0], byref(state)), state

    def restore(self, state: Any, time: float | None = None) -> int:
        """Restore a state, saved at `time` if that is not ours."""
        self.time = self.time if time is None else time
        return self.call(_STATES[self.library.version][1], state)

    def free_state(self, state: Any) -> int:
        return self.call(_STATES[self.library.version][2], byref(state))

    def size_of_state(self, state: Any) -> int:
        """Ask for the length of a state as bytes; return the status."""
        size = c_size_t()
        return self.call(_STATES[self.library.version][3], state, byref(size))

    def serialise(self, state: Any) -> bytes:
        _, _, _, size_call, call, _ = _STATES[self.library.version]
        size = c_size_t()
        assert self.call(size_call, state, byref(size)) == OK
        content = (ctypes.c_ubyte * size.value)()
        assert self.call(call, state, content, size) == OK
        return bytes(content)

    def deserialise(self, content: bytes) -> tuple[int, Any]:
        state = pointer()
        call = _STATES[self.library.version][5]
        status = self.call(call, content, c_size_t(len(content)), byref(state))
        return status, state

    def content(self) -> bytes:
        """Return all that can be saved of the instance now, as bytes."""
        state = self.save()
        content = self.serialise(state)
        assert self.free_state(state) == OK
        return content

    def close(self) -> None:
        if self.address:
            free = self.library.function("FreeInstance")
            free.restype = None
            free(pointer(self.address))
            self.address = None
