"""Random calls of a native FMU, compared with a small model of what the standard asks for."""

from __future__ import annotations

import ctypes
import math
import random
import sys
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from fmu_src.variable import Variable
from tests.helpers.native_call_arguments import (
    CONTINUOUS,
    EVENTS,
    INITIALISING,
    INSTANTIATED,
    LARGEST,
    LOGS,
    NOT_THERE,
    RATES,
    STARTS,
    STEPPING,
    STEPS,
    STOPS,
    TERMINATED,
    TIMES,
    VALUES,
    Arguments,
)
from tests.helpers.native_exchange_calls import ExchangeCalls
from tests.helpers.native_library import DISCARD, ERROR, OK, WARNING, NativeInstance, NativeLibrary
from tests.helpers.small_native_model import HIDDEN_OIL, SINGULAR_OIL


class Saved(NamedTuple):
    """A state of the FMU, and what it must hold."""

    state: Any
    content: bytes
    phase: int
    time: float
    values: dict[int, float]


class Calls(ExchangeCalls):
    """One instance under random calls, and what is expected of it."""

    def __init__(self, library: NativeLibrary, exchange: bool) -> None:
        self.library, self.exchange = library, exchange
        self.saved: list[Saved] = []
        names = {reference: name for name, reference in library.references.items()}
        self.library_names = names
        self.variables: dict[int, Variable] = {
            reference: library.variables[name] for reference, name in names.items()
        }
        self.counts = {reference: library.counts[name] for reference, name in names.items()}
        self.references = {
            kind: [r for r, v in self.variables.items() if self._kind(v) == kind] for kind in VALUES
        }
        if library.version == 2:
            self.references["Enumeration"] = self.references["Integer"]
        self._make()

    def _kind(self, variable: Variable) -> str:
        is_old = self.library.version == 2 and variable.type == "Enumeration"
        return "Integer" if is_old else variable.type

    def _make(self) -> None:
        self.instance = NativeInstance(self.library, exchange=self.exchange)
        self._set_to_start()

    def _set_to_start(self) -> None:
        self.phase, self.time, self.stop, self.stale = INSTANTIATED, 0.0, math.inf, True
        self.instance.time = 0.0
        self.values = {
            r: float(v.start or 0.0) for r, v in self.variables.items() if not v.is_computed
        }

    def close(self) -> None:
        for one in self.saved:
            assert self.instance.free_state(one.state) == OK
        self.instance.close()

    def _value(self, name: str) -> float:
        return self.values[self.library.references[name]]

    def _illegal(self, reference: int) -> bool:
        low, high = self.variables[reference].range
        return not low <= self.values[reference] <= high

    def _is_beyond(self) -> bool:
        torques = self._value("pinion.torque"), self._value("wheel.torque")
        return max(map(abs, torques)) > 40.0 or not 280.0 <= self._value("oil.temperature") <= 420.0

    def _start_is_refused(self) -> bool:
        law = self._value("drag.law.number") or self._value("drag.law")
        return (
            any(map(self._illegal, self.values))
            or self._is_beyond()
            or (law == 2.0 and self._value("drag.coefficient") == 0.0)
            or abs(self._value("pinion.torque") - self._value("wheel.torque")) > 60.0
            or self._value("oil.temperature") == SINGULAR_OIL
        )

    def _inputs_are_refused(self) -> bool:
        """Whether an input is outside its range, or the limits of the model."""
        illegal = [r for r, v in self.variables.items() if v.causality == "input"]
        return any(map(self._illegal, illegal)) or self._is_beyond()

    def _starts(self) -> bool:
        if self.stale and self._start_is_refused():
            return False
        self.stale = False
        return True

    def check(self, name: str, number: int) -> None:
        """Do one call and compare its status and effect with what is expected.

        `start` goes on to the steps as a host does, whatever the values are.
        """
        if name == "start":
            if self.phase == INSTANTIATED:
                self.check("enter", 0)
            name = "leave"
        before = self.instance.content()
        action: Callable[[Arguments], tuple[int, set[int]]] = getattr(self, name)
        status, expected = action(Arguments(number))
        assert status in expected, (name, number, status, expected, self.instance.log[-3:])
        if status in (DISCARD, ERROR):
            assert self.instance.content() == before, (name, number)

    def _references(self, arguments: Arguments, kind: str) -> list[int]:
        fitting = self.references[kind]
        some = [*fitting, *fitting, *fitting, 0, 6, 7, 13, 10_000, 2**32 - 1]
        return [arguments.one_of(some) for _ in range(arguments.one_of((1, 2, 0, 3)))]

    def _fit(self, kind: str, references: list[int]) -> bool:
        return all(reference in self.references[kind] for reference in references)

    def get(self, arguments: Arguments) -> tuple[int, set[int]]:
        kind = arguments.one_of(tuple(VALUES))
        references = self._references(arguments, kind)
        if not self._fit(kind, references):
            return self.instance.get_raw(kind, references, 8)[0], {ERROR}
        count = sum(self.counts[reference] for reference in references)
        error = arguments.one_of((0, 0, 0, 1)) if self.library.version == 3 else 0
        status, values = self.instance.get_raw(kind, references, count + error)
        if error:
            return status, {ERROR}
        outputs = [r for r in references if self.variables[r].is_computed]
        if outputs and self.phase < STEPPING and not self._starts():
            return status, {ERROR}
        if outputs and self.exchange and self.phase >= STEPPING:
            rates = all(self.library_names[r] in RATES for r in outputs)
            refused = self.refused(rates)
            if refused:
                return status, refused
        k = 0
        for reference in references:
            for value in values[k : k + self.counts[reference]]:
                if reference in outputs:
                    assert math.isfinite(value)
                else:
                    expected = self.values[reference]
                    assert float(value) == expected or (math.isnan(value) and math.isnan(expected))
            k += self.counts[reference]
        return status, {OK}

    def set(self, arguments: Arguments) -> tuple[int, set[int]]:
        kind = arguments.one_of(tuple(VALUES))
        references = self._references(arguments, kind)
        allowed = {INSTANTIATED: ("input", "parameter"), INITIALISING: ("input", "parameter"),
                   TERMINATED: ()}.get(self.phase, ("input",))  # fmt: skip
        fits = self._fit(kind, references)
        count = sum(self.counts[r] for r in references) if fits else len(references)
        choices = VALUES[kind]
        if kind == "Enumeration" and self.library.version == 3:
            choices = (*choices, 2**63 - 1, -(2**63))
        values = [arguments.one_of(choices) for _ in range(count)]
        status = self.instance.set_raw(kind, references, values)
        states = self.state_references() if self.phase in (EVENTS, CONTINUOUS) else []
        if not (
            fits and all(self.variables[r].causality in allowed or r in states for r in references)
        ):
            not_finite = fits and any(
                r in states and not math.isfinite(value)
                for r, value in zip(references, values, strict=False)
            )
            return status, {ERROR, DISCARD} if not_finite else {ERROR}
        if any(reference in states for reference in references):
            return self.after_setting_states(status, references, values)
        for reference, value in zip(references, values, strict=True):
            self.values[reference] = float(value)
        worst = OK
        for reference, value in zip(references, values, strict=True):
            low, high = self.variables[reference].range
            worst = worst if low <= value <= high else WARNING
        self.stale = self.stale or bool(references)
        return status, {worst}

    def null(self, arguments: Arguments) -> tuple[int, set[int]]:
        kind = arguments.one_of(tuple(VALUES))
        action = arguments.one_of(("Get", "Set"))
        return self.instance.access(action, kind, [0], None, 1), {ERROR}

    def setup(self, arguments: Arguments) -> tuple[int, set[int]]:
        """Set the times; in FMI 3 that is one call with the entry into initialisation."""
        start, stop = arguments.one_of(STARTS), arguments.one_of(STOPS)
        last = math.inf if stop is None else stop
        legal = self.phase == INSTANTIATED and math.isfinite(start) and start <= last
        numbers = ctypes.c_double(0.0), ctypes.c_double(start), ctypes.c_double(stop or 0.0)
        tolerance, first, end = numbers
        if self.library.version == 2:
            status = self.instance.call(
                "SetupExperiment", 0, tolerance, first, int(stop is not None), end
            )
        else:
            status = self.instance.call(
                "EnterInitializationMode", ctypes.c_bool(False), tolerance, first,
                ctypes.c_bool(stop is not None), end,
            )  # fmt: skip
        if not legal:
            return status, {ERROR}
        self.time = self.instance.time = start
        self.stop = last
        self.phase = INSTANTIATED if self.library.version == 2 else INITIALISING
        return status, {OK}

    def enter(self, arguments: Arguments) -> tuple[int, set[int]]:
        if self.library.version == 3:
            return self.setup(arguments)
        status = self.instance.call("EnterInitializationMode")
        if self.phase != INSTANTIATED:
            return status, {ERROR}
        self.phase = INITIALISING
        return status, {OK}

    def leave(self, arguments: Arguments) -> tuple[int, set[int]]:
        status = self.instance.leave()
        if self.phase != INITIALISING or not self._starts():
            return status, {ERROR}
        self.phase = EVENTS if self.exchange else STEPPING
        return status, {OK}

    def terminate(self, arguments: Arguments) -> tuple[int, set[int]]:
        status = self.instance.call("Terminate")
        if self.phase not in (STEPPING, EVENTS, CONTINUOUS):
            return status, {ERROR}
        self.phase = TERMINATED
        return status, {OK}

    def reset(self, arguments: Arguments) -> tuple[int, set[int]]:
        status = self.instance.call("Reset")
        self._set_to_start()
        fresh = NativeInstance(self.library, exchange=self.exchange)
        assert fresh.content() == self.instance.content()
        fresh.close()
        return status, {OK}

    def step(self, arguments: Arguments) -> tuple[int, set[int]]:
        h, offset = arguments.one_of(STEPS), arguments.one_of(TIMES)
        status = self.instance.step(h, self.time + offset)
        rounding = min(2.0 * sys.float_info.epsilon * (abs(self.time) + 0.1), 1e-4)
        allowed = 1e-3 * h + rounding
        if self.phase != STEPPING:
            return status, {ERROR}
        if not 0.0 < h <= 0.1 + rounding or not abs(self.time + offset - self.time) <= allowed:
            return status, {DISCARD}
        if self.time + offset + h > self.stop + allowed:
            return status, {ERROR}
        oil = self._value("oil.temperature")
        if self._inputs_are_refused() or oil in (SINGULAR_OIL, HIDDEN_OIL):
            return status, {DISCARD}
        if status == DISCARD:
            assert "the speed would leave the range" in self.instance.log[-1][2]
            return status, {DISCARD}
        self.time = self.instance.time
        return status, {OK}

    def save(self, arguments: Arguments) -> tuple[int, set[int]]:
        old = self.saved.pop() if len(self.saved) > 2 else None
        state = self.instance.save(old.state if old else None)
        content = self.instance.content()
        assert self.instance.serialise(state) == content
        self.saved.append(Saved(state, content, self.phase, self.time, dict(self.values)))
        return OK, {OK}

    def restore(self, arguments: Arguments) -> tuple[int, set[int]]:
        if not self.saved:
            return self.instance.restore(None), {ERROR}
        one = arguments.one_of(self.saved)
        state = one.state
        if arguments.one_of((False, True)):
            status, state = self.instance.deserialise(one.content)
            assert status == OK
        status = self.instance.restore(state, one.time)
        assert self.instance.content() == one.content
        if state is not one.state:
            assert self.instance.free_state(state) == OK
        self.phase, self.time, self.values = one.phase, one.time, dict(one.values)
        self.stale = self.phase < STEPPING
        return status, {OK}

    def restore_damaged(self, arguments: Arguments) -> tuple[int, set[int]]:
        content = bytearray(self.instance.content())
        place = arguments.one_of(range(len(content)))
        if arguments.one_of((True, False)):
            content[place] ^= 1 << arguments.one_of(range(8))
        else:
            del content[place:]
        status, state = self.instance.deserialise(bytes(content))
        assert state.value is None
        return status, {ERROR}

    def forget(self, arguments: Arguments) -> tuple[int, set[int]]:
        state = self.saved.pop().state if self.saved else ctypes.c_void_p()
        return self.instance.free_state(state), {OK}

    def choose_logs(self, arguments: Arguments) -> tuple[int, set[int]]:
        names = [arguments.one_of(LOGS) for _ in range(arguments.one_of((0, 1, 2)))]
        array = (ctypes.c_char_p * max(1, len(names)))(*names)
        status = self.instance.call("SetDebugLogging", ctypes.c_bool(True), len(names), array)
        legal = all(name and name.startswith(b"log") for name in names)
        if legal:  # whatever was chosen, the tests read all messages
            assert self.instance.call("SetDebugLogging", ctypes.c_bool(True), 0, None) == OK
        return status, {OK if legal else ERROR}

    def not_there(self, arguments: Arguments) -> tuple[int, set[int]]:
        name = arguments.one_of(NOT_THERE[self.library.version].split())
        references = (ctypes.c_uint32 * 1)(0)
        pointers = [ctypes.byref(references), ctypes.c_size_t(1)] + 8 * [ctypes.c_void_p()]
        return self.instance.call(name, *pointers), {DISCARD, ERROR}

    def make_anew(self, arguments: Arguments) -> tuple[int, set[int]]:
        """Free the instance in any phase; its states serve the next one."""
        self.instance.close()
        self._make()
        return OK, {OK}


# what moves a run on stands here more often
NAMES = (
    *4 * ("start", "step", "step", "set", "step", "step", "get"), "enter", "leave", "save",
    "restore", "setup", "null", "terminate", "reset", "restore_damaged", "forget", "choose_logs",
    "not_there", "make_anew",
    *2 * ("enter_events", "enter_continuous_time", "update", "complete", "set_states", "get_array",
          "set_time", "differentiate"),
)  # fmt: skip
# a run of model exchange is moved on by other calls
OF_EXCHANGE = (
    *4 * ("start", "enter_continuous_time", "set_states", "complete", "get_array", "set", "get"),
    *NAMES,
)


def run_calls(
    library: NativeLibrary, calls: Iterable[tuple[str, int]], exchange: bool = False
) -> None:
    """Do the calls, each a name with the number of its arguments, on a new instance."""
    machine = Calls(library, exchange)
    try:
        for name, number in calls:
            machine.check(name, number)
    finally:
        machine.close()


def run_random(
    library: NativeLibrary, sequences: int, seed: int, longest: int = 40, exchange: bool = False
) -> None:
    """Run sequences that a seed decides."""
    names = OF_EXCHANGE if exchange else NAMES
    rng = random.Random(seed)
    for _ in range(sequences):
        count = rng.randrange(longest)
        calls = [(rng.choice(names), rng.randrange(LARGEST)) for _ in range(count)]
        run_calls(library, calls, exchange)
