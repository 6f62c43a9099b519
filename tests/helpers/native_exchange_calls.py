"""Random calls of model exchange; the other calls of a run stand in `native_calls`."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable

from fmu_src.variable import Variable
from tests.helpers.native_call_arguments import (
    CONTINUOUS,
    EVENTS,
    INITIALISING,
    INSTANTIATED,
    RATES,
    STATES,
    STEPPING,
    Arguments,
)
from tests.helpers.native_library import DISCARD, ERROR, OK, WARNING, NativeInstance, NativeLibrary
from tests.helpers.small_native_model import FASTEST, HIDDEN_OIL, SINGULAR_OIL


class ExchangeCalls:
    """Calls of model exchange on one instance, and what is expected of them."""

    library: NativeLibrary
    exchange: bool
    instance: NativeInstance
    phase: int
    time: float
    values: dict[int, float]
    variables: dict[int, Variable]
    counts: dict[int, int]
    references: dict[str, list[int]]
    library_names: dict[int, str]
    _starts: Callable[[], bool]
    _value: Callable[[str], float]
    _illegal: Callable[[int], bool]
    _inputs_are_refused: Callable[[], bool]

    def refused(self, rates: bool) -> set[int]:
        """Return the status of what is computed in model exchange, if it must be refused."""
        oil = self._value("oil.temperature")
        refused = self._inputs_are_refused() or oil == HIDDEN_OIL
        refused = refused or (oil == SINGULAR_OIL and not rates)
        _, state = self.instance.get_array("GetContinuousStates", 2)
        return {DISCARD} if refused or abs(state[1]) > FASTEST else set()

    def state_references(self) -> list[int]:
        return [self.library.references[name] for name in ("pinion.angle", "pinion.speed")]

    def after_setting_states(
        self, status: int, references: list[int], values: list[float]
    ) -> tuple[int, set[int]]:
        """Take inputs among them and look at the states."""
        states = self.state_references()
        given = list(zip(references, values, strict=True))
        if any(r in states and not math.isfinite(value) for r, value in given):
            return status, {DISCARD}
        self.values |= {r: float(value) for r, value in given if r not in states}
        _, present = self.instance.get_array("GetContinuousStates", 2)
        wanted = {r: float(value) for r, value in given if r in states}
        assert {r: present[states.index(r)] for r in wanted} == wanted
        inputs = [r for r in references if r not in states]
        refused = [
            r
            for r, value in given
            if r in inputs and not self.variables[r].range[0] <= value <= self.variables[r].range[1]
        ]
        return status, {WARNING if refused else OK}

    def enter_events(self, arguments: Arguments) -> tuple[int, set[int]]:
        status = self.instance.call("EnterEventMode")
        if self.phase not in (EVENTS, CONTINUOUS):
            return status, {ERROR}
        self.phase = EVENTS
        return status, {OK}

    def enter_continuous_time(self, arguments: Arguments) -> tuple[int, set[int]]:
        status = self.instance.call("EnterContinuousTimeMode")
        if self.phase != EVENTS:
            return status, {ERROR}
        self.phase = CONTINUOUS
        return status, {OK}

    def update(self, arguments: Arguments) -> tuple[int, set[int]]:
        if self.phase != EVENTS:
            return self.instance.update()[0], {ERROR}
        _, (angle, speed) = self.instance.get_array("GetContinuousStates", 2)
        status, changed = self.instance.update()
        if self._inputs_are_refused():
            return status, {DISCARD}
        assert changed == (angle >= 20.0 and speed > 0.0)
        _, after = self.instance.get_array("GetContinuousStates", 2)
        assert after == [angle, -speed if changed else speed]
        return status, {OK}

    def complete(self, arguments: Arguments) -> tuple[int, set[int]]:
        status, event = self.instance.complete()
        if self.phase != CONTINUOUS:
            return status, {ERROR}
        if self._inputs_are_refused():
            return status, {DISCARD}
        _, (angle, speed) = self.instance.get_array("GetContinuousStates", 2)
        assert event == (angle >= 20.0 and speed > 0.0)
        return status, {OK}

    def set_time(self, arguments: Arguments) -> tuple[int, set[int]]:
        time = arguments.one_of((0.5, 1e9, -1.0, math.nan, math.inf))
        status = self.instance.call("SetTime", ctypes.c_double(time))
        if self.phase not in (EVENTS, CONTINUOUS) or not math.isfinite(time):
            return status, {ERROR}
        self.time = self.instance.time = time
        return status, {OK}

    def set_states(self, arguments: Arguments) -> tuple[int, set[int]]:
        count = arguments.one_of((2, 2, 2, 2, 1, 0))
        values = [arguments.one_of(STATES) for _ in range(count)]
        status = self.instance.set_states(values)
        if self.phase != CONTINUOUS or count != 2:
            return status, {ERROR}
        if not all(map(math.isfinite, values)):
            return status, {DISCARD}
        assert self.instance.get_array("GetContinuousStates", 2) == (OK, values)
        return status, {OK}

    def get_array(self, arguments: Arguments) -> tuple[int, set[int]]:
        name, expected = arguments.one_of(
            (
                ("GetContinuousStates", 2),
                ("GetNominalsOfContinuousStates", 2),
                ("GetDerivatives", 2),
                ("GetEventIndicators", 1),
            )
        )
        count = arguments.one_of((expected, expected, expected, expected + 1, 0))
        status, values = self.instance.get_array(name, count)
        if not self.exchange or self.phase == INSTANTIATED or count != expected:
            return status, {ERROR}
        if self.phase == INITIALISING and "Nominals" not in name and not self._starts():
            return status, {ERROR}
        if self.phase >= STEPPING and name in ("GetDerivatives", "GetEventIndicators"):
            refused = self.refused(rates=True)
            if refused:
                return status, refused
        assert all(map(math.isfinite, values))
        return status, {OK}

    def differentiate(self, arguments: Arguments) -> tuple[int, set[int]]:
        reals = self.references["Real"]
        computed = [r for r in reals if self.variables[r].is_computed]
        names = {name: r for r, name in self.library_names.items()}
        known = [names[n] for n in ("pinion.angle", "pinion.speed", "pinion.torque")]
        unknowns = [arguments.one_of([*computed, *computed, 0, 4, 10_000]) for _ in range(2)]
        knowns = [arguments.one_of([*known, *known, known[0] + 2, 3, 10_000]) for _ in range(2)]
        seed = [arguments.one_of((1.0, -2.0, 0.0, math.nan)) for _ in range(2)]
        count = sum(self.counts.get(r, 1) for r in unknowns)
        status, values = self.instance.differentiate_raw(unknowns, knowns, seed, count)
        legal = set(unknowns) <= set(computed) and set(knowns) <= set(known)
        if self.phase not in (EVENTS, CONTINUOUS) or not legal or not all(map(math.isfinite, seed)):
            return status, {ERROR}
        rates = all(self.library_names[r] in RATES for r in unknowns)
        _, state = self.instance.get_array("GetContinuousStates", 2)
        if rates and abs(abs(state[1]) - FASTEST) < 1.0:
            return status, {OK, DISCARD}
        refused = self.refused(rates=True)
        if refused and (rates or self._inputs_are_refused()):
            return status, refused
        assert status != OK or all(map(math.isfinite, values))
        return status, {OK} if rates else {OK, DISCARD}
