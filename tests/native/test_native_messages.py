"""Messages of a native FMU: categories, texts and callbacks, by FMI 2 and FMI 3."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable

import pytest

from tests.helpers.native_library import ERROR, OK, WARNING, NativeInstance

NAN = math.nan
New = Callable[..., NativeInstance]


def _noise(instance: NativeInstance) -> set[str]:
    """Do what causes a message of every category but events; return those that came."""
    instance.log.clear()
    instance.set(pinion__torque=NAN)
    instance.step()
    instance.set(pinion__torque=31.0 if instance.get("range.exceeded") == 0 else 1.0)
    instance.step()
    return {category for _, category, _ in instance.log}


def _choose(instance: NativeInstance, on: bool, *names: bytes) -> int:
    array = (ctypes.c_char_p * max(1, len(names)))(*names)
    flag = ctypes.c_bool(on) if instance.library.version == 3 else int(on)
    return instance.call("SetDebugLogging", flag, ctypes.c_size_t(len(names)), array)


@pytest.mark.parametrize(
    ("choices", "expected"),
    [
        ([], {"logStatusError", "logStatusDiscard", "logStatusWarning"}),
        ([(False,)], set()),
        ([(False,), (True,)], {"logStatusError", "logStatusDiscard", "logStatusWarning"}),
        ([(True, b"logStatusDiscard")], {"logStatusDiscard"}),
        ([(True, b"logAll")], {"logStatusError", "logStatusDiscard", "logStatusWarning"}),
        ([(False, b"logStatusError")], {"logStatusDiscard", "logStatusWarning"}),
        ([(False,), (True, b"logStatusFatal")], {"logStatusError"}),
    ],
)
def test_only_the_chosen_messages_come(new: New, choices: list, expected: set[str]) -> None:
    instance = new()
    for choice in choices:
        assert _choose(instance, *choice) == OK
    instance.start()
    assert _noise(instance) == expected


def test_an_unknown_category_is_an_error_and_changes_nothing(new: New) -> None:
    instance = new(logging=False)
    instance.start()
    assert _choose(instance, True, b"logStatusDiscard", b"everything") == ERROR
    assert _noise(instance) == set()


def test_logging_is_off_unless_asked_for(new: New) -> None:
    instance = new(logging=False)
    instance.start()
    assert _noise(instance) == set()


def test_a_logger_that_reads_no_arguments_gets_the_text(mass: NativeInstance) -> None:
    _choose(mass, True, b"logAll")
    assert _choose(mass, True, b"a 5 % #r1# category") == ERROR
    # FMI 2 sends a text like that of printf, in which % and # stand doubled
    sign = {2: "a 5 %% ##r1## category", 3: "a 5 % #r1# category"}[mass.library.version]
    assert f"{sign} is no log category" in mass.messages("logStatusError")


def test_the_callbacks_are_needed_at_the_start_only(mass: NativeInstance) -> None:
    if mass.library.version == 2:
        ctypes.memset(ctypes.addressof(mass.callbacks), 0, ctypes.sizeof(mass.callbacks))
    assert mass.set(pinion__torque=NAN) == WARNING
    assert "got nan" in mass.messages()
