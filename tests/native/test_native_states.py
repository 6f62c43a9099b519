"""States of a native FMU: saved, restored, as bytes, damaged and foreign."""

from __future__ import annotations

import ctypes
import math
import struct
import zlib
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from tests.helpers.native_library import DISCARD, ERROR, OK, WARNING, NativeInstance
from tests.helpers.small_native_builds import MODEL
from tests.helpers.small_native_model import LIMIT, SPEED

New = Callable[..., NativeInstance]
# layout of the bytes: mark 8, GUID 40, phase 4, checksum 4, then time, values and state as doubles
PHASE_AT, SUM_AT, NUMBERS_AT = 48, 52, 56
N_VALUES = len(MODEL.definition.variables)


def continued(instance: NativeInstance, count: int = 15) -> list[bytes]:
    seen = []
    for k in range(count):
        instance.set(pinion__torque=3.0 + k)
        instance.step()
        seen.append(instance.content())
    return seen


def test_a_restored_state_continues_bit_for_bit(mass: NativeInstance) -> None:
    mass.start(drag__law=2)
    continued(mass, 5)
    state, time = mass.save(), mass.time
    first = continued(mass)
    assert mass.restore(state, time) == OK
    assert continued(mass) == first


def test_a_state_as_bytes_continues_in_another_instance(new: New) -> None:
    one, other = new(), new()
    one.start(mass__inertia=2.5, solver__substeps=3, drag__law__number=2)
    continued(one, 5)
    content = one.content()
    status, state = other.deserialise(content)
    assert status == OK
    assert other.restore(state, one.time) == OK
    assert other.content() == content
    assert continued(other) == continued(one)
    assert other.call("Terminate") == OK


@pytest.mark.parametrize("phase", range(4))
def test_every_phase_can_be_restored(new: New, phase: int) -> None:
    def advance(instance: NativeInstance, to: int) -> None:
        for act in [instance.enter, instance.leave, lambda: instance.call("Terminate")][:to]:
            assert act() == OK

    one = new()
    one.set(pinion__torque=8.0, mass__inertia=3.0)
    advance(one, phase)
    content = one.content()
    for other_phase in range(4):
        other = new()
        advance(other, other_phase)
        _, state = other.deserialise(content)
        assert other.restore(state) == OK
        assert other.content() == content
        assert other.set(pinion__torque=1.0) == (ERROR if phase == 3 else OK)
        assert other.step(time=0.0) == (OK if phase == 2 else ERROR)


def test_a_refused_value_stays_refused_in_a_restored_state(mass: NativeInstance) -> None:
    mass.start()
    mass.set(pinion__torque=math.nan)
    bad = mass.save()
    mass.set(pinion__torque=1.0)
    assert mass.step() == OK
    assert mass.restore(bad, time=0.0) == OK
    assert mass.step() == DISCARD
    assert mass.set(pinion__torque=1.0) == OK
    assert mass.step() == OK


def test_a_place_that_holds_a_state_is_written_over(mass: NativeInstance) -> None:
    mass.start()
    state = mass.save()
    address = state.value
    mass.step()
    assert mass.save(state).value == address
    content = mass.content()
    mass.step()
    assert mass.restore(state) == OK
    assert mass.content() == content


def test_a_freed_state_is_null_and_may_be_freed_again(mass: NativeInstance) -> None:
    state = mass.save()
    assert mass.free_state(state) == OK
    assert state.value is None
    assert mass.free_state(state) == OK
    assert mass.restore(state) == ERROR


def test_freed_states_are_refused_however_many_there_were(new: New) -> None:
    one, other = new(), new()
    for instance in (one, other):
        instance.start()
    kept, content = one.save(), one.content()
    gone = []
    for instance in (one, other):
        for _ in range(1000):
            state = instance.save()
            gone.append(ctypes.c_void_p(state.value))
            assert instance.free_state(state) == OK
    alive = [one.save() for _ in range(10)]  # where memory of freed ones may lie
    for state in gone[::50]:
        for instance in (one, other):
            before = instance.content()
            assert instance.restore(state) == ERROR
            assert instance.size_of_state(state) == ERROR
            assert instance.try_save(state)[0] == ERROR
            assert instance.free_state(ctypes.c_void_p(state.value)) == ERROR
            assert "has been freed" in instance.log[-1][2]
            assert instance.content() == before
    assert one.restore(kept) == OK
    assert [one.serialise(state) for state in alive] == 10 * [content]


def test_a_state_outlives_its_instance_and_is_freed_by_another(new: New) -> None:
    one, other = new(), new()
    one.start(mass__inertia=2.5)
    state, content = one.save(), one.content()
    one.close()
    assert other.restore(state) == OK
    assert other.content() == content
    stale = ctypes.c_void_p(state.value)
    assert other.free_state(state) == OK
    assert new().restore(stale) == ERROR


def test_instances_save_and_free_states_at_the_same_time(new: New) -> None:
    def work(instance: NativeInstance) -> None:
        for _ in range(300):
            states = [instance.save() for _ in range(5)]
            assert {instance.free_state(state) for state in states} == {OK}

    with ThreadPoolExecutor(4) as pool:  # ctypes lets other threads run during a call
        list(pool.map(work, [new() for _ in range(4)]))


def test_memory_that_is_no_state_is_refused(mass: NativeInstance) -> None:
    mass.start()
    before = mass.content()
    memory = ctypes.create_string_buffer(8192)
    foreign = ctypes.c_void_p(ctypes.addressof(memory))
    assert mass.restore(foreign) == ERROR
    assert mass.free_state(foreign) == ERROR
    ending = "FMUstate" if mass.library.version == 2 else "FMUState"
    assert mass.call(f"Get{ending}", ctypes.byref(foreign)) == ERROR
    size = ctypes.c_size_t()
    assert mass.call(f"Serialized{ending}Size", foreign, ctypes.byref(size)) == ERROR
    assert mass.call(f"Serialize{ending}", foreign, memory, ctypes.c_size_t(8192)) == ERROR
    assert memory.raw == bytes(8192)
    assert mass.content() == before


@pytest.mark.parametrize("damage", ["mark", "GUID", "phase", "checksum", "time", "value", "state"])
def test_a_damaged_state_is_refused_without_effect(mass: NativeInstance, damage: str) -> None:
    mass.start()
    mass.step()
    content = bytearray(mass.content())
    at = {"mark": 3, "GUID": 10, "phase": PHASE_AT, "checksum": SUM_AT, "time": NUMBERS_AT + 2,
          "value": NUMBERS_AT + 8 + 4, "state": len(content) - 2}[damage]  # fmt: skip
    before = bytes(content)
    for bit in range(8):
        content[at] ^= 1 << bit
        status, state = mass.deserialise(bytes(content))
        assert (status, state.value) == (ERROR, None)
        content[at] ^= 1 << bit
    assert mass.content() == before
    assert mass.step() == OK


def test_a_state_of_another_length_is_refused(mass: NativeInstance) -> None:
    content = mass.content()
    for length in (0, 1, 8, 47, 55, 56, len(content) - 1):
        assert mass.deserialise(content[:length])[0] == ERROR
    assert mass.deserialise(content + b"\0")[0] == ERROR
    assert mass.deserialise(content)[0] == OK


def test_a_short_place_for_the_bytes_is_refused(mass: NativeInstance) -> None:
    state = mass.save()
    size = len(mass.serialise(state))
    ending = "FMUstate" if mass.library.version == 2 else "FMUState"
    room = ctypes.create_string_buffer(b"\xaa" * size, size)
    assert mass.call(f"Serialize{ending}", state, room, ctypes.c_size_t(size - 1)) == ERROR
    assert room.raw == b"\xaa" * size
    assert f"needs {size} bytes, got room for {size - 1}" in mass.messages()


def forged(content: bytes, *, at: int, value: float) -> bytes:
    """Return a state with another number and the checksum that belongs to it."""
    numbers = np.frombuffer(content[NUMBERS_AT:]).copy()
    numbers[at] = value
    phase = content[PHASE_AT:SUM_AT]
    # CRC-32 that begins with the phase in place of zero
    checked = zlib.crc32(numbers.tobytes(), struct.unpack("<I", phase)[0])
    return content[:SUM_AT] + struct.pack("<I", checked) + numbers.tobytes()


@pytest.mark.parametrize(
    ("at", "value"),
    [
        (0, math.nan),  # time
        (1 + MODEL.definition.references["mass.inertia"], 0.0),
        (1 + MODEL.definition.references["drag.law"], 1.5),
        (1 + MODEL.definition.references["drag.law"], 1e300),
        (1 + MODEL.definition.references["pinion.speed"], math.nan),
        (1 + MODEL.definition.references["mass.turns"], math.inf),
        (1 + N_VALUES + SPEED, math.inf),
        (1 + N_VALUES + LIMIT, 0.0),
    ],
)
def test_numbers_that_no_run_leaves_are_refused(
    mass: NativeInstance, at: int, value: float
) -> None:
    mass.start()
    before = mass.content()
    same = float(np.frombuffer(before[NUMBERS_AT:])[at])
    assert forged(before, at=at, value=same) == before
    assert mass.deserialise(forged(before, at=at, value=value))[0] == ERROR
    assert "numbers that no run of it leaves" in mass.messages("logStatusError")
    assert mass.content() == before


def test_contradicting_parameters_in_a_state_leave_the_run_as_it_was(new: New) -> None:
    mass, twin = new(), new()
    for one in (mass, twin):
        one.start(drag__law=2, mass__inertia=0.7)
        one.step()
    reference = 1 + MODEL.definition.references["drag.coefficient"]
    status, state = mass.deserialise(forged(mass.content(), at=reference, value=0.0))
    assert status == OK
    assert mass.restore(state) == ERROR
    assert "parameters that contradict each other" in mass.messages("logStatusError")
    assert continued(mass) == continued(twin)


def test_a_state_saved_before_the_start_holds_bad_values_too(mass: NativeInstance) -> None:
    assert mass.set(mass__inertia=math.nan, drag__law=9) == WARNING
    content = mass.content()
    mass.call("Reset")
    status, state = mass.deserialise(content)
    assert status == OK
    assert mass.restore(state) == OK
    assert mass.content() == content
    assert mass.start() == ERROR
    assert mass.set(mass__inertia=1.0, drag__law=1) == OK
    assert mass.leave() == OK
