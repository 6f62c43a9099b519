"""Random calls of a whole native FMU, judged by what holds for any of them.

`native_calls` knows what the small model must answer to each call. Of the axle, the pair and the
driveline less is known beforehand: which torques leave their range, which states have no rates.
What must hold whatever they answer is checked here: no crash, no call longer than LONGEST, no
number with OK that is not finite, nothing changed by a refused call, saved states restored to the
last bit, freed states refused, a reset instance like a new one. States of the model may hold any
finite number, by model exchange or by forged bytes.

    python -m tests.helpers.native_walk --help
"""

from __future__ import annotations

import argparse
import ctypes
import math
import os
import pickle
import random
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from fmu_src.native.build import libraries, native_guid
from fmu_src.native.driveline import driveline_model
from fmu_src.native.model import NativeModel
from fmu_src.native.models import native_model
from fmu_src.native.platforms import PLATFORMS, platform_of_this_machine
from fmu_src.native.train import train_model
from tests.helpers.fmu_cases import CASES
from tests.helpers.native_exchange_walk import FINITE, REALS, ExchangeWalk
from tests.helpers.native_library import DISCARD, ERROR, OK, NativeInstance, NativeLibrary
from tests.helpers.small_native_builds import unpacked
from tests.helpers.small_trains import GEARS_ON_ROLLERS
from tests.helpers.watching_library import (
    COMPILER,
    NO_COMPILER,
    watching_environment,
    watching_library,
)

ROOT = Path(__file__).parents[2]


def _gears_on_rollers() -> NativeModel:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "train.toml"
        path.write_text(GEARS_ON_ROLLERS)
        return train_model(path)


MODELS: dict[str, Callable[[], NativeModel]] = {
    **{case.name: lambda case=case: native_model(case.definition) for case in CASES},  # type: ignore[misc]
    "Driveline": driveline_model,
    "Train": _gears_on_rollers,
}
LONGEST = 1.0  # s of one call
_KINDS = ("Real", "Integer", "Enumeration", "Boolean")
_STEPS = (1e-4, 1e-3, 1e-3, 2.0**-10, 3e-3, 1e-2, 0.1, 1e-9, 1e-15, 1e-300, 5e-324, 0.0, -1e-3,
          0.2, 1e300, math.nan, math.inf)  # fmt: skip
_HEADER = 56  # bytes of a state before its numbers, with the phase at 48 and the checksum at 52
_WHOLE = (0, 1, 2, 3, 4, 5, -1, 16, 4096, 2**31 - 1, -(2**31))


class Walk(ExchangeWalk):
    """One instance under random calls."""

    def __init__(self, library: NativeLibrary, rng: random.Random, exchange: bool) -> None:
        self.library, self.rng, self.exchange = library, rng, exchange
        self.instance = NativeInstance(library, exchange=exchange)
        assert self.instance.address, "no instance"
        self.saved: list[tuple[Any, bytes, float]] = []
        self.freed: list[int] = []
        self.references: dict[str, list[str]] = {kind: [] for kind in _KINDS}
        for name, variable in library.variables.items():
            self.references[variable.type].append(name)

    def close(self) -> None:
        for state, _, _ in self.saved:
            self._free(state)
        self.instance.close()

    def _free(self, state: Any) -> None:
        self.freed.append(state.value)
        assert self.instance.free_state(state) == OK

    def _content(self) -> bytes:
        """Return all that can be saved of the instance; nothing if its outputs are not finite."""
        status, state = self.instance.try_save()
        if status != OK:
            return b""
        content = self.instance.serialise(state)
        self._free(state)
        return content

    def do(self, name: str) -> int:
        """Do one call and judge it; return its status."""
        if name in ("start", "steps", "set", "set_states"):  # several calls, judged one by one
            return int(getattr(self, name)())
        return self.judged(name, getattr(self, name))

    def judged(self, name: str, call: Callable[[], int]) -> int:
        """Do a call and judge it; return its status."""
        before = self._content()
        begun = time.process_time()
        status = call()
        took = time.process_time() - begun
        assert took < LONGEST, (name, took)
        if status in (DISCARD, ERROR):
            last = self.instance.log[-1:]
            assert self._content() == before, (name, last)
            assert last, name
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
        wild = self.rng.choice((low, high, 1.01 * high, *REALS, self.rng.uniform(low, high)))
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
            reference = [self.library.references[name]]
            call = partial(self.instance.set_raw, kind, reference, values)
            worst = max(worst, self.judged(name, call))
        return worst

    def torques(self) -> int:
        """Set legal inputs, so that steps go on."""
        scale = self.rng.uniform(-1.0, 2.0)
        inputs = self.library.names("input")
        start = {n: float(self.library.variables[n].start or 0.0) for n in inputs}
        return self.instance.set(
            **{n.replace(".", "__"): v * (1.0 if "oil" in n else scale) for n, v in start.items()}
        )

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
                if self.library.variables[name].is_computed:
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
        short = partial(self.instance.step, self.rng.choice((1e-3, 2e-4)))
        return max(self.judged("short step", short) for _ in range(3))

    def terminate(self) -> int:
        return self.instance.call("Terminate")

    def reset(self) -> int:
        status = self.instance.call("Reset")
        self.instance.time = 0.0
        fresh = NativeInstance(self.library, exchange=self.exchange)
        assert fresh.content() == self._content()
        fresh.close()
        return status

    def save(self) -> int:
        if len(self.saved) > 2:
            self._free(self.saved.pop(0)[0])
        status, state = self.instance.try_save()
        if status == OK:
            self.saved.append((state, self._content(), self.instance.time))
        return status

    def restore(self) -> int:
        if not self.saved:
            return OK
        state, content, at = self.rng.choice(self.saved)
        if self.rng.random() < 0.5:
            status, copy = self.instance.deserialise(content)
            assert status == OK
            assert self.instance.restore(copy, at) == OK
            self._free(copy)
        else:
            assert self.instance.restore(state, at) == OK
        assert self._content() == content
        return OK

    def damaged(self) -> int:
        """Offer a state with a byte changed, or cut short: never taken."""
        content = bytearray(self._content() or bytes(_HEADER))
        at = self.rng.randrange(len(content))
        content[at] ^= 1 << self.rng.randrange(8)
        cut = bytes(content[: self.rng.randrange(len(content))])
        status, state = self.instance.deserialise(self.rng.choice((bytes(content), cut)))
        assert status == ERROR, at
        assert not state.value
        return status

    def freed_again(self) -> int:
        """Use a state that has been freed, or what never was one."""
        never = ctypes.addressof(self.instance.logger)
        gone = ctypes.c_void_p(self.rng.choice((*self.freed, 8, never)))
        use: Callable[[Any], int] = self.rng.choice(
            (
                self.instance.restore,
                self.instance.free_state,
                self.instance.size_of_state,
                lambda state: self.instance.try_save(state)[0],
            )
        )
        status = use(gone)
        assert status == ERROR, gone
        return status

    def forged(self) -> int:
        """Restore a state with extreme numbers and the checksum that belongs to them."""
        content = self._content()
        if not content:
            return OK
        numbers = list(struct.unpack(f"<{(len(content) - _HEADER) // 8}d", content[_HEADER:]))
        for _ in range(self.rng.choice((1, 1, 2, 5))):
            numbers[self.rng.randrange(len(numbers))] = self.rng.choice(FINITE)
        raw = struct.pack(f"<{len(numbers)}d", *numbers)
        checked = zlib.crc32(raw, struct.unpack("<I", content[48:52])[0])
        status, state = self.instance.deserialise(content[:52] + struct.pack("<I", checked) + raw)
        if status == OK:
            status = self.instance.restore(state, numbers[0])
            self._free(state)
        return status


_EITHER = ("set", "torques", "get", "get", "enter", "start", "terminate", "reset", "save",
           "restore", "damaged", "freed_again", "forged", "step")  # fmt: skip
CALLS = (*_EITHER, "set", "leave", "start", "step", "steps")
OF_EXCHANGE = (*_EITHER, *6 * ("set_states",), *3 * ("array", "differentiate", "continuous"),
               "set_time", "update", "complete", "complete", "events", "update")  # fmt: skip


def _sequence(
    library: NativeLibrary, rng: random.Random, longest: int, counts: dict[str, int]
) -> None:
    """Run one sequence of calls on a new instance and count the answers."""
    has_exchange = any(v.rate_of for v in library.variables.values())
    exchange = has_exchange and rng.random() < 0.5
    one = Walk(library, rng, exchange)
    names = rng.choices(OF_EXCHANGE if exchange else CALLS, k=rng.randint(1, longest))
    # most sequences start early, so that steps are taken at all
    head = ("set", "start", *(("update", "continuous") if exchange else ())) * (rng.random() < 0.7)
    done = []
    for name in (*head, *names):
        done.append(name)
        try:
            status = one.do(name)
        except AssertionError as error:
            error.add_note(f"after the calls {done}")
            raise
        key = f"{name} {status}"
        counts[key] = counts.get(key, 0) + 1
    one.close()


def walk(
    library: NativeLibrary, *, sequences: int, seed: int, first: int = 0, longest: int = 25
) -> dict[str, int]:
    """Run random sequences of calls; return how often each status came, by call.

    Sequence number n is the same whichever is the `first`.
    """
    counts: dict[str, int] = {}
    for number in range(first, first + sequences):
        if number % 1000 == 0 and number > first:
            sys.stdout.write(f"{number} sequences\n")
            sys.stdout.flush()
        try:
            _sequence(library, random.Random(f"{seed} {number}"), longest, counts)
        except AssertionError as error:
            error.add_note(f"in sequence {number} of seed {seed}")
            raise
    return counts


def _built(name: str, folder: Path, sanitize: bool) -> Path:
    """Build the library of a model for this machine into `folder`, and what `_walk_built` needs."""
    model = MODELS[name]()
    known = replace(model, entry=None), str(native_guid(model))
    (folder / "model").write_bytes(pickle.dumps(known))
    if sanitize:
        return watching_library(model, folder)
    (platform,) = (one for one in PLATFORMS if one.name == platform_of_this_machine())
    return unpacked(model, folder, libraries(model, [platform])[platform.name], platform)


def _walk_built(given: argparse.Namespace) -> None:
    """Walk one library; casadi, which makes the driveline, cannot be loaded beside a sanitizer."""
    model, guid = pickle.loads((given.library.parents[2] / "model").read_bytes())
    (version,) = given.fmi
    library = NativeLibrary(given.library, model, guid, version)
    counts = walk(library, sequences=given.sequences, seed=given.seed, first=given.first)
    name, calls = model.definition.name, sum(counts.values())
    sys.stdout.write(f"{name}, FMI {version}: {given.sequences} sequences, {calls} calls\n")
    sys.stdout.write(f"  answers by call and status: {dict(sorted(counts.items()))}\n")


def main() -> None:
    """Walk the libraries of models, each version in a process of its own."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--model", nargs="+", choices=list(MODELS), default=list(MODELS))
    parser.add_argument("--fmi", nargs="+", type=int, choices=(2, 3), default=(2, 3))
    parser.add_argument("--sequences", type=int, default=1000, help="for each model and version")
    parser.add_argument("--first", type=int, default=0, help="number of the first sequence")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sanitize", action="store_true", help="watch memory and arithmetic")
    parser.add_argument("--library", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.library:
        _walk_built(given)
        return
    if given.sanitize and COMPILER is None:
        parser.error(NO_COMPILER)
    environment = watching_environment() if given.sanitize else dict(os.environ)
    numbers = [f"--{n}={getattr(given, n)}" for n in ("sequences", "first", "seed")]
    failed = False
    for name in given.model:
        with tempfile.TemporaryDirectory() as folder:
            path = _built(name, Path(folder), given.sanitize)
            for version in given.fmi:
                one = [f"--library={path}", f"--fmi={version}", *numbers]
                command = [sys.executable, "-m", "tests.helpers.native_walk", *one]
                done = subprocess.run(command, cwd=ROOT, env=environment, check=False)
                failed = failed or done.returncode != 0
    sys.exit(failed)


if __name__ == "__main__":
    main()
