"""Random calls of a whole native FMU, judged by what holds for any of them.

`native_calls` knows what the small model must answer to each call. Of the axle and the pair less is
known beforehand: which torques leave their range, which parameters have no equilibrium. What must
hold whatever they answer is checked here: no crash, no call longer than LONGEST, no NaN with OK,
nothing changed by a refused call, saved states restored to the last bit, a reset instance
like a new one.
"""

from __future__ import annotations

import math
import random
import sys
import time
from pathlib import Path
from typing import Any

import fmpy

from fmu_src.native.build import native_guid
from fmu_src.native.models import native_model
from fmu_src.native.platforms import PLATFORMS, platform_of_this_machine
from tests.helpers.fmu_cases import CASES, Case
from tests.helpers.native_fmus import native_fmus
from tests.helpers.native_library import (
    DISCARD,
    ERROR,
    OK,
    NativeInstance,
    NativeLibrary,
)

LONGEST = 1.0  # s of one call
_KINDS = ("Real", "Integer", "Enumeration", "Boolean")
_STEPS = (1e-4, 1e-3, 1e-3, 2.0**-10, 3e-3, 1e-2, 0.1, 1e-9, 1e-300, 0.0, -1e-3, 0.2, 1e300,
          math.nan, math.inf)  # fmt: skip
_REALS = (0.0, -0.0, 1.0, -1.0, 1e-300, -1e300, 1e300, 5e-324, math.nan, math.inf, -math.inf)
_WHOLE = (0, 1, 2, 3, 4, 5, -1, 16, 4096, 2**31 - 1, -(2**31))


def unpacked_library(fmu: Path, version: int, folder: Path) -> Path:
    """Return the path of this machine's library in an FMU, unpacked into `folder`."""
    platform = platform_of_this_machine()
    (suffix,) = (one.suffix for one in PLATFORMS if one.name == platform)
    name = fmu.stem.removesuffix("_FMI3")
    there = "linux64" if version == 2 else platform
    return Path(fmpy.extract(str(fmu), str(folder))) / "binaries" / there / f"{name}{suffix}"


def native_library(case: Case, version: int, folder: Path) -> NativeLibrary:
    """Return the library of a case's FMU, unpacked into `folder`."""
    fmus = native_fmus(case)
    path = unpacked_library(fmus.fmi2 if version == 2 else fmus.fmi3, version, folder)
    model = native_model(case.definition)
    return NativeLibrary(path, model, str(native_guid(model)), version)


class Walk:
    """One instance under random calls."""

    def __init__(self, library: NativeLibrary, rng: random.Random) -> None:
        self.library, self.rng = library, rng
        self.instance = NativeInstance(library)
        self.saved: list[tuple[Any, bytes, float]] = []
        self.references: dict[str, list[str]] = {kind: [] for kind in _KINDS}
        for name, variable in library.variables.items():
            self.references[variable.type].append(name)

    def close(self) -> None:
        for state, _, _ in self.saved:
            assert self.instance.free_state(state) == OK
        self.instance.close()

    def do(self, name: str) -> int:
        """Do one call and judge it; return its status."""
        if name in ("start", "steps", "set"):  # several calls, judged one by one
            several: int = getattr(self, name)()
            return several
        before = self.instance.content()
        begun = time.process_time()
        status: int = getattr(self, name)()
        took = time.process_time() - begun
        assert took < LONGEST, (name, took)
        if status in (DISCARD, ERROR):
            assert self.instance.content() == before, (name, self.instance.log[-1:])
            assert self.instance.log, name
        return status

    def _value(self, name: str) -> float:
        variable = self.library.variables[name]
        low, high = variable.range
        if variable.type != "Real":
            legal = int(max(low, -9.0)), int(min(high, 4096.0))
            return self.rng.choice((self.rng.randint(*legal), self.rng.choice(_WHOLE)))
        start = float(variable.start or 0.0)
        if not (math.isfinite(low) and math.isfinite(high)):
            low, high = -1e5, 1e5
        near = start * self.rng.uniform(0.5, 1.5)
        wild = self.rng.choice((low, high, 1.01 * high, *_REALS, self.rng.uniform(low, high)))
        return self.rng.choice((start, near, near, near, wild))

    def set(self) -> int:
        """Set some variables; more often those that may be set."""
        worst = OK
        for _ in range(self.rng.choice((1, 1, 2, 3))):
            kind = self.rng.choice(_KINDS)
            known = self.references[kind]
            free = [n for n in known if self.library.variables[n].causality != "output"]
            names = free if free and self.rng.random() < 0.9 else known
            if not names:
                continue
            name = self.rng.choice(names)
            count = self.library.counts[name]
            values = [self._value(name) for _ in range(count)]
            if self.library.version == 2:
                values = [v if kind == "Real" else max(-(2**31), v) for v in values]
            before = self.instance.content()
            status = self.instance.set_raw(kind, [self.library.references[name]], values)
            assert status < DISCARD or self.instance.content() == before, name
            worst = max(worst, status)
        return worst

    def torques(self) -> int:
        """Set legal inputs, so that steps go on."""
        scale = self.rng.uniform(-1.0, 2.0)
        start = {n: float(self.library.variables[n].start or 0.0) for n in self._inputs}
        return self.instance.set(
            **{n.replace(".", "__"): v * (1.0 if "oil" in n else scale) for n, v in start.items()}
        )

    @property
    def _inputs(self) -> list[str]:
        return self.library.names("input")

    def get(self) -> int:
        kind = self.rng.choice(_KINDS)
        if not self.references[kind]:
            return OK
        names = self.rng.choices(self.references[kind], k=self.rng.choice((1, 2, 5)))
        count = sum(self.library.counts[n] for n in names)
        references = [self.library.references[n] for n in names]
        status, values = self.instance.get_raw(kind, references, count)
        if status == OK:
            at = 0
            for name in names:
                part = values[at : at + self.library.counts[name]]
                at += self.library.counts[name]
                if self.library.variables[name].causality == "output":
                    assert all(map(math.isfinite, part)), (name, part)
        return status

    def enter(self) -> int:
        at = self.instance.time
        status = self.instance.enter(self.rng.choice((0.0, 0.0, 2.5)))
        if status >= DISCARD:
            self.instance.time = at
        return status

    def leave(self) -> int:
        return self.instance.leave()

    def start(self) -> int:
        """Go on to the steps as a host does."""
        entered = self.do("enter")
        return entered if entered >= DISCARD else self.do("leave")

    def step(self) -> int:
        return self.instance.step(self.rng.choice(_STEPS))

    def steps(self) -> int:
        return max(self.do("short_step") for _ in range(3))

    def short_step(self) -> int:
        return self.instance.step(1e-3)

    def terminate(self) -> int:
        return self.instance.call("Terminate")

    def reset(self) -> int:
        status = self.instance.call("Reset")
        self.instance.time = 0.0
        fresh = NativeInstance(self.library)
        assert fresh.content() == self.instance.content()
        fresh.close()
        return status

    def save(self) -> int:
        if len(self.saved) > 2:
            state, _, _ = self.saved.pop(0)
            assert self.instance.free_state(state) == OK
        self.saved.append((self.instance.save(), self.instance.content(), self.instance.time))
        return OK

    def restore(self) -> int:
        if not self.saved:
            return OK
        state, content, at = self.rng.choice(self.saved)
        if self.rng.random() < 0.5:
            status, copy = self.instance.deserialise(content)
            assert status == OK
            assert self.instance.restore(copy, at) == OK
            assert self.instance.free_state(copy) == OK
        else:
            assert self.instance.restore(state, at) == OK
        assert self.instance.content() == content
        return OK

    def damaged(self) -> int:
        """Offer a state with a byte changed, or cut short: never taken."""
        content = bytearray(self.instance.content())
        at = self.rng.randrange(len(content))
        content[at] ^= 1 << self.rng.randrange(8)
        cut = bytes(content[: self.rng.randrange(len(content))])
        status, state = self.instance.deserialise(self.rng.choice((bytes(content), cut)))
        assert status == ERROR, at
        assert not state.value
        return status


CALLS = ("set", "set", "torques", "get", "get", "enter", "leave", "start", "step", "step", "steps",
         "terminate", "reset", "save", "restore", "damaged")  # fmt: skip


def walk(library: NativeLibrary, *, sequences: int, seed: int, longest: int = 25) -> dict[str, int]:
    """Run random sequences of calls; return how often each status came, by call."""
    rng = random.Random(seed)
    counts: dict[str, int] = {}
    for _ in range(sequences):
        one = Walk(library, rng)
        names = rng.choices(CALLS, k=rng.randint(1, longest))
        # most sequences start early, so that steps are taken at all
        head = ("set", "start") if rng.random() < 0.7 else ()
        for name in (*head, *names):
            status = one.do(name)
            key = f"{name} {status}"
            counts[key] = counts.get(key, 0) + 1
        one.close()
    return counts


def main() -> None:
    """Walk a library: path, place of its case in CASES, FMI version, number of sequences."""
    path, case, version, sequences = sys.argv[1], *map(int, sys.argv[2:])
    model = native_model(CASES[case].definition)
    library = NativeLibrary(Path(path), model, str(native_guid(model)), version)
    sys.stdout.write(f"{walk(library, sequences=sequences, seed=3)}\n")


if __name__ == "__main__":
    main()
