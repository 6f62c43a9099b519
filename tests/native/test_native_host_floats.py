"""Traps, rounding and denormals as a host sets them change no result, and no call changes them."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import pytest

from tests.helpers.native_calls import Calls
from tests.helpers.native_library import DISCARD, OK, NativeInstance, NativeLibrary

NEAREST, UP, DOWN, TO_ZERO = 0x0000, 0x4000, 0x2000, 0x6000
MASKS, FLAGS, FLUSH, DENORMALS_ARE_ZERO = 0x1F80, 0x003F, 0x8000, 0x0040
# MXCSR and the control word of the older unit (Intel 64 manual, volume 1, 10.2.3 and 8.1.5)
SETTINGS = {
    "every exception traps": (NEAREST, 0x0340),
    "division by zero traps": (MASKS & ~0x0200, 0x037B),
    "upwards": (MASKS | UP, 0x0B7F),
    "downwards": (MASKS | DOWN, 0x077F),
    "to zero, flags set": (MASKS | TO_ZERO | FLAGS, 0x0F7F),
    "no denormals": (MASKS | FLUSH | DENORMALS_ARE_ZERO, 0x037F),
    "single precision": (MASKS, 0x007F),
}
_LIBM = ctypes.CDLL("libm.so.6")


class Environment(ctypes.Structure):
    """fenv_t of glibc on x86-64."""

    _fields_ = (("x87", ctypes.c_uint32 * 7), ("sse", ctypes.c_uint32))

    @classmethod
    def now(cls) -> Environment:
        found = cls()
        _LIBM.fegetenv(ctypes.byref(found))
        return found

    def set(self) -> None:
        _LIBM.fesetenv(ctypes.byref(self))

    def settings(self) -> tuple[int, int, int]:
        """MXCSR, control word and the flags of the older unit."""
        return self.sse, self.x87[0] & 0xFFFF, self.x87[1] & FLAGS


class _Function:
    """A function that is called under a host's settings; Python itself computes with its own."""

    def __init__(self, function: Any, environment: Environment) -> None:
        self.__dict__ |= {"function": function, "environment": environment}

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(self.function, name, value)

    def __call__(self, *arguments: Any) -> Any:
        own = Environment.now()
        self.environment.set()
        before = Environment.now()
        try:
            result = self.function(*arguments)
            after = Environment.now()
        finally:
            own.set()
        assert before.settings()[:2] == (self.environment.sse, self.environment.x87[0])
        assert after.settings() == before.settings()
        return result


class HostLibrary(NativeLibrary):
    """A library whose calls are made under a host's settings of floating point."""

    environment: Environment

    def function(self, name: str) -> Any:
        return _Function(super().function(name), self.environment)


def under(library: NativeLibrary, settings: tuple[int, int]) -> HostLibrary:
    host = object.__new__(HostLibrary)
    host.__dict__ |= library.__dict__
    host.environment = Environment.now()
    host.environment.sse, host.environment.x87[0] = settings
    return host


@pytest.fixture(params=SETTINGS.values(), ids=SETTINGS)
def host(request: pytest.FixtureRequest, library: NativeLibrary) -> HostLibrary:
    return under(library, request.param)


def ride(library: NativeLibrary) -> list[bytes]:
    """Contents of an instance and its outputs: start, steps, and numbers that raise exceptions."""
    one = NativeInstance(library)
    seen = [one.content()]
    assert one.start(drag__law=2, mass__inertia=0.3) == OK
    for torque in (3.0, 1e-310, float("nan"), float("inf"), 39.9):
        one.set(pinion__torque=torque)
        seen += [bytes([one.step(1e-3 / 3.0)]), one.content()]
    assert one.step(float("nan")) == one.step(time=1e300) == DISCARD
    assert one.set(mass__inertia=1.0) != OK
    seen.append(repr(one.outputs()).encode())
    one.close()
    return seen


def ride_of_exchange(library: NativeLibrary) -> list[bytes]:
    one = NativeInstance(library, exchange=True)
    assert one.start(pinion__torque=1.0 / 3.0) == OK
    assert one.call("EnterContinuousTimeMode") == OK
    assert one.set_states([1.0 / 7.0, 1e-310]) == OK
    assert one.set_states([float("nan"), 0.0]) == DISCARD
    found = [
        one.get_array("GetDerivatives", 2),
        one.get_array("GetEventIndicators", 1),
        one.differentiate(["der(pinion.speed)"], ["pinion.speed"], [0.3]),
        one.complete(),
        one.outputs(),
    ]
    one.close()
    return [repr(found).encode()]


@pytest.mark.parametrize("run", [ride, ride_of_exchange])
def test_settings_of_the_host_change_no_bit(
    library: NativeLibrary, host: HostLibrary, run: Callable[[NativeLibrary], list[bytes]]
) -> None:
    assert run(host) == run(library)


CALLS = [
    "get",
    "set",
    "step",
    "null",
    "save",
    "restore",
    "get",
    "set",
    "step",
    "terminate",
    "reset",
]


def test_every_call_gives_the_settings_back(host: HostLibrary) -> None:
    for exchange in (False, True):
        calls = Calls(host, exchange)
        for number, name in enumerate(3 * ("start", *CALLS)):
            calls.check(name, 7919 * number)
        calls.close()


def test_the_logger_runs_under_the_settings_of_the_host(library: NativeLibrary) -> None:
    host, seen = under(library, SETTINGS["upwards"]), []

    class Watching(NativeInstance):
        def _on_message_2(self, *message: Any) -> None:
            seen.append(Environment.now().settings())

        _on_message_3 = _on_message_2

    one = Watching(host)
    one.step()
    one.close()
    assert [found[:2] for found in seen] == [SETTINGS["upwards"]]
