"""Traps, rounding and denormals as a host sets them change no result, and no call changes them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tests.helpers.host_floats import SETTINGS, Environment, HostLibrary, under
from tests.helpers.native_calls import Calls
from tests.helpers.native_library import DISCARD, OK, NativeInstance, NativeLibrary


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
