"""Random calls of model exchange on a whole native FMU, for `native_walk`."""

from __future__ import annotations

import ctypes
import math
import random
import sys
from collections.abc import Callable

from tests.helpers.native_library import OK, NativeInstance, NativeLibrary

FINITE = (0.0, -0.0, 1.0, -1.0, 1e-300, 5e-324, -1e9, 1e9, 1e16, -2.9e16, 1e19, 1.4e19, -1e19,
           2.0**53, 2.0**63, -(2.0**63), 1e100, -1e300, 1e305, 1e308, -1e308,
           sys.float_info.max)  # fmt: skip
REALS = (*FINITE, math.nan, math.inf, -math.inf)
_TIMES = (0.5, -1.0, 1e16, 1e308, math.nan, math.inf)


class ExchangeWalk:
    """The part of a `Walk` that only an instance for model exchange answers with OK."""

    library: NativeLibrary
    instance: NativeInstance
    rng: random.Random

    def judged(self, name: str, call: Callable[[], int]) -> int:
        """Do a call and judge it; return its status."""
        raise NotImplementedError

    @property
    def states(self) -> list[str]:
        """Names of the continuous states."""
        return [v.rate_of for v in self.library.variables.values() if v.rate_of]

    def set_time(self) -> int:
        wanted = self.rng.choice((*_TIMES, self.instance.time + 1e-3))
        status = self.instance.call("SetTime", ctypes.c_double(wanted))
        self.instance.time = wanted if status == OK else self.instance.time
        return status

    def set_states(self) -> int:
        """Set all continuous states: near where they are, or with extremes among them."""
        n = len(self.states)
        values = self.instance.get_array("GetContinuousStates", n)[1]
        if self.rng.random() < 0.5:
            values = [v * (1.0 + self.rng.choice((0.0, 1e-9, 1e-6, 1e-3))) for v in values]
        for _ in range(self.rng.choice((0, 0, 1, 1, 3))):
            angles = [i for i, name in enumerate(self.states) if name.endswith("angle")]
            place = self.rng.choice((self.rng.randrange(n), self.rng.choice(angles)))
            values[place] = self.rng.choice(REALS)
        values = values[: self.rng.choice((n, n, n, n, n - 1, 0))]
        return self.judged("set_states", lambda: self.instance.set_states(values))

    def array(self) -> int:
        n = len(self.states)
        call, count = self.rng.choice(
            (
                ("GetContinuousStates", n),
                ("GetNominalsOfContinuousStates", n),
                ("GetDerivatives", n),
                ("GetDerivatives", n),
                ("GetEventIndicators", 3),
                ("GetEventIndicators", 2),
            )
        )
        status, values = self.instance.get_array(call, count)
        assert all(map(math.isfinite, values)), (call, values)
        return status

    def differentiate(self) -> int:
        computed = [n for n, v in self.library.variables.items() if v.is_computed]
        unknowns = self.rng.choices(computed, k=self.rng.choice((1, 2, 40)))
        free = [*self.states, *self.library.names("input")]
        knowns = self.rng.choices(free, k=self.rng.choice((1, 2, 5)))
        count = sum(self.library.counts[name] for name in knowns)
        seed = [self.rng.choice((1.0, -1e-3, self.rng.choice(REALS))) for _ in range(count)]
        status, values = self.instance.differentiate(unknowns, knowns, seed)
        assert all(map(math.isfinite, values)), (unknowns, knowns, seed)
        assert status == OK or not any(values), "a refused call has written"
        return status

    def update(self) -> int:
        return self.instance.update()[0]

    def complete(self) -> int:
        return self.instance.complete()[0]

    def events(self) -> int:
        return self.instance.call("EnterEventMode")

    def continuous(self) -> int:
        return self.instance.call("EnterContinuousTimeMode")
