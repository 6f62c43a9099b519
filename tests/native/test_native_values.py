"""Values, ranges and results of a native FMU, by FMI 2 and FMI 3."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable

import pytest

from tests.helpers.native_library import DISCARD, ERROR, OK, WARNING, NativeInstance
from tests.helpers.small_native_model import HIDDEN_OIL, SINGULAR_OIL, exact_motion

NAN, INF = math.nan, math.inf
H = 2.0**-10  # s
# Runge-Kutta of order 4 at h/16: (rate * h / 16)**4 a unit of time is below 1e-17 for rates below 1
# 1/s, so only rounding of 1e4 additions is left.
TOLERANCE = 1e-12

New = Callable[..., NativeInstance]


@pytest.mark.parametrize(
    ("settings", "drag"),
    [({}, 0.25), ({"drag__coefficient": 0.75}, 0.75), ({"drag__braked": True}, 0.5)],
)
def test_the_motion_is_the_exact_one(
    mass: NativeInstance, settings: dict[str, float], drag: float
) -> None:
    assert mass.start(start=5.0, pinion__torque=7.0, wheel__torque=4.0, **settings) == OK
    angle, speed = 0.0, 2.0
    for torque in (7.0, -2.0):
        assert mass.set(pinion__torque=torque) == OK
        assert [mass.step(H) for _ in range(200)] == 200 * [OK]
        turned, speed = exact_motion(200 * H, speed, torque - 4.0, 0.5, drag)
        angle += turned
        assert mass.get("pinion.angle") == pytest.approx(angle, rel=TOLERANCE)
        assert mass.get("pinion.speed") == pytest.approx(speed, rel=TOLERANCE)
    assert mass.time == 5.0 + 400 * H


def test_outputs_have_the_type_of_their_variable(mass: NativeInstance) -> None:
    assert mass.start(pinion__torque=30.0, solver__substeps=1) == OK
    for _ in range(2000):
        mass.step(H)
    assert mass.get("mass.turns") == math.floor(mass.get("pinion.angle") / (2.0 * math.pi)) > 0
    assert bool(mass.get("mass.forward")) is True
    mass.call("Reset")
    assert mass.start(pinion__speed_start=-1.0) == OK
    assert bool(mass.get("mass.forward")) is False


def test_indexed_outputs_are_one_array_in_fmi_3(mass: NativeInstance) -> None:
    assert mass.start(drag__coefficient=3.0, pinion__speed_start=4.0) == OK
    powers = [8.0, 16.0, 24.0]  # i d v^2 / 6
    if mass.library.version == 3:
        assert mass.get("disc.power") == powers
    else:
        assert [mass.get(f"disc[{i}].power") for i in (1, 2, 3)] == powers


@pytest.mark.parametrize("number", [0, 1, 2])
def test_an_option_by_number_stands_above_the_enumeration(new: New, number: int) -> None:
    squared = {"pinion__torque": 1.0, "wheel__torque": 1.0, "drag__coefficient": 1.0}
    by_number, by_literal = new(), new()
    assert by_number.start(drag__law=2, drag__law__number=number, **squared) == OK
    assert by_literal.start(drag__law=number or 2, **squared) == OK
    for instance in (by_number, by_literal):
        assert instance.step(H) == OK
    assert by_number.outputs() == by_literal.outputs()
    told = ["drag.law = 1 linear", "drag.law = 2 squared"][(number or 2) - 1]
    assert told in by_number.messages("logEvents")
    assert "drag.law.number" not in by_number.messages("logEvents")


@pytest.mark.parametrize(
    ("name", "value", "limits"),
    [
        ("pinion.torque", NAN, "pinion.torque must be within -50 to 50 N.m, got nan"),
        ("pinion.torque", INF, "got inf"),
        ("wheel.torque", -51.0, "wheel.torque must be within -50 to 50 N.m, got -51"),
        ("oil.temperature", 20.0, "oil.temperature must be within 273.15 to 423.15 K, got 20"),
        ("oil.temperature", 1e300, "got 1e+300"),
    ],
)
def test_no_step_is_taken_until_a_legal_input_replaces_a_bad_one(
    mass: NativeInstance, name: str, value: float, limits: str
) -> None:
    mass.start()
    assert mass.step() == OK
    good, before = mass.get(name), mass.outputs()
    key = name.replace(".", "__")
    assert mass.set(**{key: value}) == WARNING
    assert limits in mass.messages("logStatusError")
    for _ in range(2):
        assert mass.step() == DISCARD
    assert limits in mass.messages("logStatusDiscard")
    assert mass.outputs() == before
    assert mass.set(**{key: good}) == OK
    assert mass.step() == OK


def test_an_input_beyond_the_limits_of_the_model_is_refused(mass: NativeInstance) -> None:
    mass.start()
    assert mass.set(pinion__torque=45.0) == OK
    assert mass.step() == DISCARD
    said = mass.messages("logStatusDiscard")
    assert "pinion.torque must be within -40 to 40 N.m, got 45" in said
    assert mass.set(pinion__torque=-40.0) == OK
    assert mass.step() == OK


@pytest.mark.parametrize(
    ("settings", "why"),
    [
        ({"mass__inertia": 0.0}, "mass.inertia must be within 0.01 to 100, got 0."),
        ({"mass__inertia": NAN}, "got nan"),
        ({"drag__law": 3}, "drag.law must be one of 1 (linear), 2 (squared), got 3."),
        ({"drag__law__number": 3}, "drag.law.number must be within 0 to 2, got 3."),
        ({"solver__substeps": -7}, "solver.substeps must be within 1 to 1000, got -7."),
        ({"drag__law": 2, "drag__coefficient": 0.0}, 'law "squared" \\ got 0??/'),
        ({"pinion__torque": 39.0, "wheel__torque": -39.0}, "the torques have no equilibrium"),
        ({"pinion__torque": 41.0}, "pinion.torque must be within -40 to 40 N.m, got 41"),
        ({"oil__temperature": SINGULAR_OIL}, "an output is not finite"),
    ],
)
def test_a_refused_start_can_be_corrected(
    mass: NativeInstance, settings: dict[str, float], why: str
) -> None:
    legal = {key: mass.get(key.replace("__", ".")) for key in settings}
    assert mass.set(**settings) in (OK, WARNING)
    assert mass.enter() == OK
    before = mass.content()
    assert mass.leave() == ERROR
    assert mass.leave() == ERROR
    assert why in mass.messages("logStatusError")
    assert mass.content() == before
    assert mass.step() == ERROR
    assert mass.set(**legal) == OK
    assert mass.leave() == OK
    assert mass.step() == OK


@pytest.mark.parametrize(
    ("values", "why"),
    [
        ({"oil__temperature": SINGULAR_OIL}, "an output is not finite"),
        ({"oil__temperature": HIDDEN_OIL}, "a state is not finite"),
        ({}, "the speed would leave the range of the model"),
    ],
)
def test_a_step_that_the_model_refuses_changes_nothing(
    mass: NativeInstance, values: dict[str, float], why: str
) -> None:
    # 40 N.m on 0.01 kg.m2 raise the speed by 400 rad/s in a step of 0.1 s
    fast = {"mass__inertia": 0.01, "drag__coefficient": 0.0, "wheel__torque": 0.0}
    mass.start(pinion__torque=40.0, pinion__speed_start=450.0, **fast)
    assert mass.step(0.1) == OK
    mass.set(**values)
    before = mass.content()
    assert mass.step(0.1 if not values else H) == DISCARD
    assert why in mass.messages("logStatusDiscard")
    assert mass.content() == before
    mass.set(oil__temperature=300.0, pinion__torque=0.0)
    assert mass.step() == OK


def test_a_range_is_said_once_and_counted(mass: NativeInstance) -> None:
    mass.start()
    for torque in (10.0, 31.0, 32.0, 33.0, 10.0):
        mass.set(pinion__torque=torque)
        assert mass.step() == OK
        assert mass.get("range.exceeded") == (torque > 30.0)
    said = mass.messages("logStatusWarning").splitlines()
    assert len(said) == 1
    assert "range.torque: the torque should be within -30 to 30 N.m, got 31." in said[0]
    assert "Use less torque." in said[0]
    assert mass.call("Terminate") == OK
    counted = "range.torque was outside its range at 3 of 6 communication points"
    assert counted in mass.messages("logEvents")
    mass.call("Reset")
    mass.log.clear()
    mass.start(pinion__torque=31.0)
    mass.call("Terminate")
    assert len(mass.messages("logStatusWarning").splitlines()) == 1
    assert "at 1 of 1 communication points" in mass.messages("logEvents")


def test_time_can_be_read_in_fmi_3(mass: NativeInstance) -> None:
    if mass.library.version == 3:
        time = len(mass.library.references) + 2  # two of the three elements have no own variable
        mass.start(start=0.5)
        mass.step(H)
        assert mass.get_raw("Real", [time], 1) == (OK, [0.5 + H])
        assert mass.set_raw("Real", [time], [1.0]) == ERROR


@pytest.mark.slow
@pytest.mark.parametrize("value", [2**63 - 1, -(2**63), 2**31, 0])
def test_an_enumeration_of_any_64_bits_is_refused_at_the_start(
    mass: NativeInstance, value: int
) -> None:
    if mass.library.version == 2:
        value = ctypes.c_int32(value).value
    assert mass.set(drag__law=value) == WARNING
    assert mass.get("drag.law") == value
    assert mass.start() == ERROR
