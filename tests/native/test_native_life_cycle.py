"""Phases, times, messages and instances of a native FMU, by FMI 2 and FMI 3."""

from __future__ import annotations

import ctypes
import gc
import math
import resource
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.helpers.native_library import DISCARD, ERROR, OK, NativeInstance, NativeLibrary

NAN, INF = math.nan, math.inf
New = Callable[..., NativeInstance]


def test_version_and_types_are_those_of_the_standard(library: NativeLibrary) -> None:
    version = library.function("GetVersion")
    version.restype = ctypes.c_char_p
    assert version() == {2: b"2.0", 3: b"3.0"}[library.version]
    if library.version == 2:
        platform = library.function("GetTypesPlatform")
        platform.restype = ctypes.c_char_p
        assert platform() == b"default"


@pytest.mark.parametrize("guid", ["", "wrong", "{00000000-0000-0000-0000-000000000000}"])
def test_a_wrong_guid_gives_no_instance(
    new: New, library: NativeLibrary, capfd: pytest.CaptureFixture[str], guid: str
) -> None:
    refused = new(guid=guid, logging=False)
    assert refused.address is None
    what = "GUID" if library.version == 2 else "token"
    why = f"The {what} must be {library.guid}, that of the model description."
    assert refused.log == [(ERROR, "logStatusError", why)]
    assert capfd.readouterr().err == f"mass: {why}\n"


@pytest.mark.parametrize(
    "uri",
    [
        None,
        b"",
        b"file:/a/b",
        b"file:///missing/folder",
        b"file://localhost/a",
        b"file:///with%20space",
        "file:///ä/ö".encode(),
        b"\xff\xfe",
        b"C:\\here",
        100_000 * b"x",
    ],
)
def test_any_place_of_resources_serves(new: New, uri: bytes | None) -> None:
    instance = new(resources=uri)
    assert instance.start() == OK
    assert instance.step() == OK


@pytest.mark.parametrize("name", [None, b"", b"%s%n#r1#", 5000 * b"n"])
def test_any_name_serves(new: New, name: bytes | None) -> None:
    instance = new(name=name)
    instance.set(pinion__torque=NAN)
    assert "got nan" in instance.messages()


def test_a_null_instance_is_refused_by_every_function(library: NativeLibrary) -> None:
    nobody = NativeInstance(library, guid="wrong")
    memory = ctypes.create_string_buffer(4096)
    for address in (None, ctypes.addressof(memory)):
        nobody.address = address
        assert nobody.call("Terminate") == ERROR
        assert nobody.call("Reset") == ERROR
        assert nobody.enter() == ERROR
        assert nobody.leave() == ERROR
        assert nobody.step() == ERROR
        for kind in ("Real", "Integer", "Boolean", "Enumeration"):
            assert nobody.get_raw(kind, [0], 1)[0] == ERROR
            assert nobody.set_raw(kind, [0], [0]) == ERROR
        assert nobody.restore(None) == ERROR
        assert nobody.deserialise(b"")[0] == ERROR
        nobody.close()


@pytest.mark.parametrize(
    ("kind", "refs", "count"),
    [
        ("Real", [10_000], 1),
        ("Real", [2**32 - 1], 1),
        ("Real", [0, 10_000], 2),
        ("Integer", [0], 1),
        ("Boolean", [0], 1),
        ("Enumeration", [0], 1),
        ("Real", [6], 1),  # an enumeration
        ("Real", [8], 1),  # a Boolean
        ("Integer", [8], 1),
        ("Boolean", [7], 1),  # an Integer
    ],
)
def test_unknown_references_and_wrong_types_are_errors(
    mass: NativeInstance, kind: str, refs: list[int], count: int
) -> None:
    for prepare in (lambda: OK, mass.enter, mass.leave):
        assert prepare() == OK
        before = mass.content()
        assert mass.get_raw(kind, refs, count)[0] == ERROR
        assert mass.set_raw(kind, refs, count * [1]) == ERROR
        assert mass.content() == before


def test_a_refused_read_does_not_start_the_model(mass: NativeInstance) -> None:
    assert mass.enter() == OK
    before = mass.content()
    speed = mass.library.references["pinion.speed"]
    assert mass.get_raw("Real", [speed, 10_000], 2)[0] == ERROR
    assert mass.content() == before


def test_the_number_of_values_must_agree_in_fmi_3(mass: NativeInstance) -> None:
    if mass.library.version == 3:
        power = mass.library.references["disc.power"]
        mass.start()
        for count in (0, 1, 2, 4, 2**62):
            values = (ctypes.c_double * 8)()
            assert mass.access("Get", "Real", [power], values, count) == ERROR
        assert "room for 3 values, got 2." in mass.messages()
        inside = power + 1  # an element has no reference of its own
        assert mass.get_raw("Real", [inside], 1)[0] == ERROR


def test_null_pointers_are_errors(mass: NativeInstance) -> None:
    mass.start()
    before = mass.content()
    for kind in ("Real", "Integer", "Boolean", "Enumeration"):
        assert mass.access("Get", kind, [0], None, 1) == ERROR
        assert mass.access("Set", kind, [0], None, 1) == ERROR
    name = {2: "SetReal", 3: "SetFloat64"}[mass.library.version]
    values, count = (ctypes.c_double * 1)(), ctypes.c_size_t(1)
    assert mass.call(name, None, count, values, count) == ERROR
    assert mass.call(name, None, ctypes.c_size_t(0), None, ctypes.c_size_t(0)) == OK
    ending = "FMUstate" if mass.library.version == 2 else "FMUState"
    assert mass.call(f"Get{ending}", None) == ERROR
    assert mass.call(f"Set{ending}", None) == ERROR
    assert mass.call(f"Free{ending}", None) == OK
    assert mass.call(f"Serialized{ending}Size", None, None) == ERROR
    assert mass.call(f"Serialize{ending}", None, None, ctypes.c_size_t(0)) == ERROR
    assert mass.call("SetDebugLogging", 1, ctypes.c_size_t(1), None) == ERROR
    assert mass.content() == before


def test_calls_in_a_wrong_phase_are_errors_and_change_nothing(mass: NativeInstance) -> None:
    def refused(*calls: Callable[[], int]) -> None:
        before = mass.content()
        assert [call() for call in calls] == len(calls) * [ERROR]
        assert mass.content() == before

    def terminate() -> int:
        return mass.call("Terminate")

    refused(mass.leave, mass.step, terminate)
    assert mass.enter() == OK
    refused(mass.enter, mass.step, terminate)
    assert mass.leave() == OK
    refused(mass.enter, mass.leave, lambda: mass.set(mass__inertia=1.0))
    assert mass.step() == OK
    assert terminate() == OK
    refused(mass.enter, mass.leave, mass.step, terminate, lambda: mass.set(pinion__torque=1.0))
    assert mass.get("pinion.speed") > 0.0
    assert mass.call("Reset") == OK
    assert mass.start() == OK


def test_outputs_are_never_set(mass: NativeInstance) -> None:
    for prepare in (lambda: OK, mass.enter, mass.leave):
        assert prepare() == OK
        assert mass.set(pinion__speed=1.0) == ERROR
        assert mass.set(mass__turns=1) == ERROR
        assert mass.set(mass__forward=True) == ERROR


@pytest.mark.parametrize("h", [0.0, -0.0, -1e-3, 0.100001, 1e300, NAN, INF, -INF])
def test_an_impossible_step_is_discarded_and_nothing_moves(mass: NativeInstance, h: float) -> None:
    mass.start()
    before = mass.content()
    assert mass.step(h) == DISCARD
    said = mass.messages("logStatusDiscard")
    assert "The communication step must be above 0 and at most 0.1 s" in said
    assert mass.content() == before
    assert mass.step() == OK


def test_the_smallest_steps_are_steps(mass: NativeInstance) -> None:
    mass.start()
    for h in (1e-300, 5e-324, 0.1):
        assert mass.step(h) == OK
        assert all(math.isfinite(value) for value in mass.get_raw("Real", [0, 1, 2], 3)[1])


@pytest.mark.parametrize("time", [0.5, -1.0, NAN, INF, -INF, 1e300])
def test_a_step_from_another_time_is_discarded(mass: NativeInstance, time: float) -> None:
    mass.start()
    mass.step()
    before = mass.content()
    assert mass.step(time=time) == DISCARD
    assert "The last step ended at 0.0009765625 s" in mass.messages("logStatusDiscard")
    assert mass.content() == before
    assert mass.step() == OK


@pytest.mark.parametrize("late", [1e5, 2e5, 1e7])
def test_a_late_step_begins_where_the_last_ended_to_rounding(
    mass: NativeInstance, late: float
) -> None:
    mass.start(late)
    assert mass.step(1e-3, time=late) == OK
    end = late + 1e-3
    for wrong in (end - 1e-4, end + 1e-4):
        assert mass.step(1e-3, time=wrong) == DISCARD
    assert mass.step(1e-3, time=math.nextafter(end, INF)) == OK
    assert mass.step(0.10000000000000003, time=end + 1e-3) == OK


@pytest.mark.parametrize("start", [NAN, INF, -INF])
def test_a_start_time_must_be_finite(mass: NativeInstance, start: float) -> None:
    before = mass.content()
    assert mass.enter(start) == ERROR
    assert "The start time must be finite" in mass.messages("logStatusError")
    assert mass.content() == before
    assert mass.enter(1.0) == OK


def test_no_step_goes_beyond_the_stop_time(mass: NativeInstance) -> None:
    """FMI 2.0.4, 4.2.2 and FMI 3.0, 2.3.3: the FMU must return Error there."""
    assert mass.enter(1.0, stop=0.5) == ERROR
    assert mass.enter(1.0, stop=NAN) == ERROR
    mass.call("Reset")
    assert mass.start(stop=0.3) == OK
    h = 0.1  # three of it are more than 0.3 by the last bit
    for _ in range(3):
        assert mass.step(h) == OK
    before = mass.content()
    assert mass.step(h) == ERROR
    assert "beyond the stop time, 0.3 s" in mass.messages("logStatusError")
    assert mass.content() == before
    mass.call("Reset")
    assert mass.start(1.0) == OK
    assert [mass.step(h) for _ in range(9)] == 9 * [OK]


def test_a_reset_instance_equals_a_fresh_one(new: New) -> None:
    def ride(instance: NativeInstance) -> list[bytes]:
        seen = [instance.content()]
        instance.start(start=0.25, pinion__torque=9.0, drag__law=2)
        for _ in range(20):
            instance.step()
            seen.append(instance.content())
        return seen

    fresh = ride(new())
    used = new()
    used.start(drag__braked=True, solver__substeps=3)
    used.set(pinion__torque=NAN)
    used.step()
    assert used.call("Reset") == OK
    assert ride(used) == fresh
    used.call("Terminate")
    assert used.call("Reset") == OK
    assert ride(used) == fresh


def test_instances_do_not_touch_each_other(new: New) -> None:
    torques = [1.0, -3.0, 9.0, 20.0]
    alone = []
    for torque in torques:
        instance = new()
        instance.start(pinion__torque=torque)
        alone.append([(instance.step(), instance.outputs()) for _ in range(10)])
    together = [new() for _ in torques]
    for instance, torque in zip(together, torques, strict=True):
        instance.start(pinion__torque=torque)
    found: list[list] = [[] for _ in torques]
    for k in range(10):
        for i in (range(4), reversed(range(4)))[k % 2]:
            found[i].append((together[i].step(), together[i].outputs()))
    assert found == alone


def test_instances_run_in_threads_of_their_own(new: New) -> None:
    instances = [new() for _ in range(4)]
    ends: dict[int, bytes] = {}

    def run(i: int) -> None:
        instances[i].start(pinion__torque=5.0)
        for _ in range(300):
            instances[i].step()
        ends[i] = instances[i].content()

    threads = [threading.Thread(target=run, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(ends) == 4
    assert len(set(ends.values())) == 1


def _many(library: NativeLibrary, count: int) -> None:
    for _ in range(count):
        instance = NativeInstance(library, logging=False)
        instance.start()
        instance.step()
        state = instance.save()
        status, copy = instance.deserialise(instance.serialise(state))
        assert status == OK
        for one in (state, copy):
            assert instance.restore(one) == OK
            assert instance.free_state(one) == OK
        instance.close()


def _memory() -> int:
    """Return the memory of this process now [byte]."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


@pytest.mark.slow
def test_a_thousand_instances_leave_no_memory_behind(library: NativeLibrary) -> None:
    _many(library, 200)
    gc.collect()
    before = _memory()
    _many(library, 1000)
    gc.collect()
    # an instance has 1.6 kB and a state 0.6 kB, so a leak of states leaves 0.6 MB at least
    assert _memory() - before < 0.4e6


@pytest.mark.parametrize("kind", ["string", "derivatives", "cancel", "status"])
def test_what_the_fmu_has_not_is_refused_by_fmi_2(mass: NativeInstance, kind: str) -> None:
    if mass.library.version == 3:
        return
    mass.start()
    before = mass.content()
    refs, size = (ctypes.c_uint32 * 1)(0), ctypes.c_size_t(1)
    order, value = (ctypes.c_int * 1)(1), (ctypes.c_double * 1)(0.0)
    number, text = ctypes.c_int(), ctypes.c_char_p()
    if kind == "string":
        for call in ("GetString", "SetString"):
            for _ in range(3):
                assert mass.call(call, refs, size, None) == ERROR
            assert mass.call(call, refs, ctypes.c_size_t(0), None) == OK
    elif kind == "derivatives":
        assert mass.call("SetRealInputDerivatives", refs, size, order, value) == ERROR
        assert mass.call("GetRealOutputDerivatives", refs, size, order, value) == ERROR
        arguments = (refs, size, refs, size, value, value)
        assert mass.call("GetDirectionalDerivative", *arguments) == ERROR
    elif kind == "cancel":
        assert mass.call("CancelStep") == ERROR
    else:  # Discard: the information is not there (FMI 2.0.4, 2.1.3)
        assert mass.call("GetStatus", 0, ctypes.byref(number)) == DISCARD
        assert mass.call("GetIntegerStatus", 0, ctypes.byref(number)) == DISCARD
        assert mass.call("GetStringStatus", 1, ctypes.byref(text)) == DISCARD
        assert mass.call("GetRealStatus", 0, value) == DISCARD
        assert mass.call("GetBooleanStatus", 2, ctypes.byref(number)) == DISCARD
        mass.step(0.05)
        before = mass.content()
        assert mass.call("GetRealStatus", 2, value) == OK
        assert value[0] == 0.05
        assert mass.call("GetBooleanStatus", 3, ctypes.byref(number)) == OK
        assert number.value == 0
        assert mass.step(1.0) == DISCARD
        assert mass.call("GetBooleanStatus", 3, ctypes.byref(number)) == OK
        assert number.value == 1  # else some hosts repeat the step for ever
    assert mass.content() == before


def test_fmi_2_needs_a_logger(library: NativeLibrary, capfd: pytest.CaptureFixture[str]) -> None:
    if library.version == 3:
        return
    make = library.function("Instantiate")
    guid = library.guid.encode()
    assert make(b"m", 1, guid, None, None, 0, 0) is None
    instance = NativeInstance(library)
    assert "must give a logger" in capfd.readouterr().err
    instance.close()
