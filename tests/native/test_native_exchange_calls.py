"""Model exchange of the small native model: modes, states, events and derivatives."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable

import pytest

from tests.helpers.native_library import DISCARD, ERROR, OK, WARNING, NativeInstance, NativeLibrary
from tests.helpers.small_native_builds import LAZY_MODEL, MODEL, linux_library, loaded
from tests.helpers.small_native_model import FASTEST, HIDDEN_OIL, WALL, exact_motion

New = Callable[..., NativeInstance]
INERTIA, DRAG, TORQUE = 0.5, 0.25, 2.0  # start values; the torques' difference


@pytest.fixture
def free(new: New) -> NativeInstance:
    """An instance in continuous-time mode."""
    instance = new(exchange=True)
    assert instance.start() == OK
    assert instance.update() == (OK, False)
    assert instance.call("EnterContinuousTimeMode") == OK
    return instance


def rates(instance: NativeInstance) -> list[float]:
    status, values = instance.get_array("GetDerivatives", 2)
    assert status == OK
    return values


def test_a_solver_finds_the_exact_motion(free: NativeInstance) -> None:
    h, steps = 0.01, 100
    _, state = free.get_array("GetContinuousStates", 2)
    assert state == [0.0, 2.0]
    for k in range(steps):
        sums = [0.0, 0.0]
        stage = [0.0, 0.0]
        for factor, weight in ((0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)):
            trial = [x + factor * h * dx for x, dx in zip(state, stage, strict=True)]
            assert free.set_states(trial) == OK
            stage = rates(free)
            sums = [total + weight * dx for total, dx in zip(sums, stage, strict=True)]
        state = [x + h / 6.0 * total for x, total in zip(state, sums, strict=True)]
        assert free.call("SetTime", ctypes.c_double((k + 1) * h)) == OK
        assert free.set_states(state) == OK
        assert free.complete() == (OK, False)
    # the error of RK4: (0.01 DRAG / INERTIA)^4 / 120
    assert state == pytest.approx(exact_motion(1.0, 2.0, TORQUE, INERTIA, DRAG), rel=1e-9)
    assert free.get("wheel.angle") == -0.5 * state[0]
    assert free.get("pinion.speed") == state[1]


def test_an_event_changes_what_it_has_to(free: NativeInstance) -> None:
    free.set_states([WALL - 0.5, 3.0])
    assert free.get_array("GetEventIndicators", 1) == (OK, [-0.5])
    assert free.complete() == (OK, False)
    free.set_states([WALL + 0.5, 3.0])
    assert free.get_array("GetEventIndicators", 1) == (OK, [0.5])
    assert free.complete() == (OK, True)
    assert free.get("pinion.speed") == 3.0
    assert free.call("EnterEventMode") == OK
    assert free.get("pinion.speed") == 3.0
    assert free.update() == (OK, True)
    assert free.get("pinion.speed") == -3.0
    assert rates(free)[0] == -3.0
    assert free.update() == (OK, False)


def test_an_input_counts_at_once(free: NativeInstance) -> None:
    before = rates(free)[1]
    assert free.set(pinion__torque=4.0) == OK
    assert rates(free)[1] == pytest.approx(before + 1.0 / INERTIA, rel=1e-14)
    assert free.set(pinion__torque=math.nan) == WARNING
    for call, count in (("GetDerivatives", 2), ("GetEventIndicators", 1)):
        assert free.get_array(call, count)[0] == DISCARD
    assert free.complete()[0] == DISCARD
    assert free.set(pinion__torque=45.0) == OK  # beyond the limits of the model
    assert free.get_array("GetDerivatives", 2)[0] == DISCARD
    assert "pinion.torque must be within -40 to 40" in free.messages("logStatusDiscard")
    assert free.set(pinion__torque=4.0) == OK
    assert rates(free)[1] == pytest.approx(before + 1.0 / INERTIA, rel=1e-14)


def test_a_state_without_rates_is_discarded(free: NativeInstance) -> None:
    _, before = free.get_array("GetContinuousStates", 2)
    for bad in (math.nan, math.inf):
        assert free.set_states([bad, 1.0]) == DISCARD
        assert free.set(pinion__speed=bad) == DISCARD
    assert free.get_array("GetContinuousStates", 2) == (OK, before)
    assert free.set_states([0.0, 1.5 * FASTEST]) == OK
    speed = [free.library.references["wheel.speed"]]
    for _ in range(2):  # whatever has been asked before
        assert free.get_array("GetDerivatives", 2)[0] == DISCARD
        assert free.get_raw("Real", speed, 1)[0] == DISCARD
    assert "the speed would leave the range" in free.messages("logStatusDiscard")
    assert free.set_states([0.0, 1.0]) == OK
    assert free.set(oil__temperature=HIDDEN_OIL) == OK
    assert free.get_array("GetDerivatives", 2)[0] == DISCARD
    assert "der(pinion.speed) is not finite" in free.messages("logStatusDiscard")


def test_states_can_be_set_as_variables(free: NativeInstance) -> None:
    assert free.set(pinion__speed=7.0, pinion__angle=1.0) == OK
    assert free.get_array("GetContinuousStates", 2) == (OK, [1.0, 7.0])
    assert rates(free)[0] == 7.0
    assert free.set(wheel__speed=1.0) == ERROR


def test_directional_derivatives(free: NativeInstance) -> None:
    free.set_states([1.0, 4.0])
    unknowns = ["der(pinion.speed)", "der(pinion.angle)", "wheel.angle", "event.wall"]
    along_speed = free.differentiate(unknowns, ["pinion.speed"], [2.0])
    assert along_speed == (OK, pytest.approx([-2.0 * DRAG / INERTIA, 2.0, 0.0, 0.0], rel=1e-15))
    both = free.differentiate(unknowns, ["pinion.angle", "wheel.torque"], [3.0, 1.0])
    assert both == (OK, pytest.approx([-1.0 / INERTIA, 0.0, -1.5, 3.0], rel=1e-15))
    assert free.differentiate(unknowns, ["pinion.angle"], [0.0]) == (OK, [0.0] * 4)
    assert free.get_array("GetContinuousStates", 2) == (OK, [1.0, 4.0])
    power = "disc.power" if free.library.version == 3 else "disc[2].power"
    status, values = free.differentiate([power], ["pinion.speed"], [1.0])
    # (i DRAG w^2 / 6)' = i DRAG w / 3
    expected = [i * DRAG * 4.0 / 3.0 for i in ((1, 2, 3) if len(values) == 3 else (2,))]
    assert (status, values) == (OK, pytest.approx(expected, rel=1e-15))


def test_adjoint_derivatives_are_the_columns_times_the_seed(free: NativeInstance) -> None:
    if free.library.version == 2:
        pytest.skip("FMI 2 has none")
    free.set_states([1.0, 4.0])
    unknowns, knowns = ["der(pinion.speed)", "disc.power"], ["pinion.speed", "wheel.torque"]
    seed = [2.0, 1.0, -3.0, 0.5]  # the power has three elements
    status, found = free.differentiate_back(unknowns, knowns, seed)
    assert status == OK
    for value, known in zip(found, knowns, strict=True):
        _, column = free.differentiate(unknowns, [known], [1.0])
        assert value == pytest.approx(sum(a * b for a, b in zip(seed, column, strict=True)))
        assert value != 0.0
    assert free.differentiate_back(unknowns, knowns, [*seed[:-1], math.nan])[0] == ERROR
    assert free.differentiate_back(unknowns, ["mass.inertia"], seed)[0] == ERROR
    assert free.differentiate_back(unknowns, knowns, seed[:-1])[0] == ERROR


def test_what_is_no_derivative_is_refused(free: NativeInstance) -> None:
    angle = free.library.references["pinion.angle"]
    rate = free.library.references["der(pinion.angle)"]
    mass = free.library.references["mass.inertia"]
    turns = free.library.references["mass.turns"]
    before = free.content()
    for unknown, known, seed in (
        (rate, mass, 1.0),
        (rate, rate, 1.0),
        (turns, angle, 1.0),
        (mass, angle, 1.0),
        (10_000, angle, 1.0),
        (rate, 10_000, 1.0),
        (rate, angle, math.nan),
    ):
        assert free.differentiate_raw([unknown], [known], [seed], 1)[0] == ERROR
    if free.library.version == 3:
        assert free.differentiate_raw([rate], [angle], [1.0], 2)[0] == ERROR
        assert free.differentiate_raw([rate], [angle], [1.0, 1.0], 1)[0] == ERROR
    assert free.content() == before


def test_calls_in_another_mode_are_refused(new: New) -> None:
    instance = new(exchange=True)
    wrong = [
        lambda: instance.call("EnterContinuousTimeMode"),
        lambda: instance.call("EnterEventMode"),
        lambda: instance.call("SetTime", ctypes.c_double(1.0)),
        lambda: instance.set_states([0.0, 0.0]),
        lambda: instance.update()[0],
        lambda: instance.complete()[0],
        lambda: instance.differentiate(["der(pinion.angle)"], ["pinion.angle"], [1.0])[0],
        instance.step,
    ]
    assert [call() for call in wrong] == [ERROR] * len(wrong)
    assert instance.get_array("GetDerivatives", 2)[0] == ERROR
    assert instance.enter() == OK
    assert [call() for call in wrong] == [ERROR] * len(wrong)
    assert rates(instance) == [2.0, (TORQUE - DRAG * 2.0) / INERTIA]  # the start is computed
    assert instance.leave() == OK
    assert [call() for call in (wrong[3], wrong[5], wrong[7])] == [ERROR] * 3
    assert instance.call("EnterContinuousTimeMode") == OK
    assert [call() for call in (wrong[0], wrong[4], wrong[7])] == [ERROR] * 3
    assert instance.call("Terminate") == OK
    assert [call() for call in wrong] == [ERROR] * len(wrong)
    assert rates(instance)[0] == 2.0


def test_co_simulation_knows_none_of_these_modes(mass: NativeInstance) -> None:
    mass.start()
    for call in ("EnterEventMode", "EnterContinuousTimeMode"):
        assert mass.call(call) == ERROR
    assert mass.get_array("GetDerivatives", 2)[0] == ERROR
    assert mass.get_array("GetContinuousStates", 2)[0] == ERROR
    assert mass.differentiate(["der(pinion.angle)"], ["pinion.angle"], [1.0])[0] == ERROR
    assert mass.set(pinion__speed=1.0) == ERROR
    mass.step()
    assert mass.get("der(pinion.angle)") == mass.get("pinion.speed")


def test_arrays_of_another_length_and_null_pointers_are_refused(free: NativeInstance) -> None:
    for call, count in (("GetContinuousStates", 2), ("GetEventIndicators", 1)):
        assert free.get_array(call, count + 1)[0] == ERROR
        assert free.call(call, None, ctypes.c_size_t(count)) == ERROR
    assert free.set_states([1.0]) == ERROR
    nothing = [ctypes.c_void_p()] * 6
    update = "NewDiscreteStates" if free.library.version == 2 else "UpdateDiscreteStates"
    assert free.call("CompletedIntegratorStep", 1, *nothing[:2]) == ERROR
    assert free.call("EnterEventMode") == OK
    assert free.call(update, *nothing) == ERROR


def test_the_time_must_be_finite_and_may_be_beyond_the_end(new: New) -> None:
    instance = new(exchange=True)
    instance.start(stop=1.0)
    assert instance.call("SetTime", ctypes.c_double(math.nan)) == ERROR
    assert instance.call("SetTime", ctypes.c_double(1.01)) == OK  # solvers look ahead
    if instance.library.version == 3:
        time = len(MODEL.definition.variables)
        assert instance.get_raw("Real", [time], 1) == (OK, [1.01])


def test_the_numbers_of_states_and_indicators(free: NativeInstance) -> None:
    if free.library.version == 2:
        return  # they stand in the model description
    for call, expected in (("NumberOfContinuousStates", 2), ("NumberOfEventIndicators", 1)):
        number = ctypes.c_size_t()
        assert free.call(f"Get{call}", ctypes.byref(number)) == OK
        assert number.value == expected
        assert free.call(f"Get{call}", None) == ERROR


def test_a_saved_state_continues_in_another_instance(free: NativeInstance, new: New) -> None:
    free.set(pinion__torque=5.0)
    free.set_states([3.0, 6.0])
    before = free.content()
    expected = rates(free)
    assert free.content() == before  # reading leaves no trace
    other = new(exchange=True)
    status, state = other.deserialise(before)
    assert status == OK
    assert other.restore(state) == OK
    assert rates(other) == expected
    assert other.set_states([0.0, 0.0]) == OK  # in the same mode
    in_steps = new()
    in_steps.start()
    assert in_steps.restore(state) == ERROR
    assert "must be one of co-simulation" in in_steps.messages("logStatusError")
    assert other.restore(in_steps.save()) == ERROR
    assert other.free_state(state) == OK


def test_ranges_are_looked_at_while_a_solver_goes_on(free: NativeInstance) -> None:
    free.set(pinion__torque=35.0)
    free.call("SetTime", ctypes.c_double(0.5))
    assert "range.torque" not in free.messages("logStatusWarning")
    assert free.complete() == (OK, False)
    assert free.messages("logStatusWarning").count("range.torque") == 1


@pytest.mark.parametrize("version", [2, 3])
def test_a_model_without_states_is_for_co_simulation_only(
    version: int, capfd: pytest.CaptureFixture[str]
) -> None:
    library = loaded(version, linux_library(LAZY_MODEL), LAZY_MODEL)
    refused = NativeInstance(library, exchange=True)
    assert refused.address is None
    assert "co-simulation only" in refused.messages("logStatusError")
    assert "co-simulation only" in capfd.readouterr().err


def test_a_wrong_token_is_refused(library: NativeLibrary) -> None:
    assert NativeInstance(library, exchange=True, guid="another").address is None


@pytest.mark.parametrize("seed", [1e305, -1e308, 1.7e308])
def test_a_seed_beyond_numbers_is_refused_and_nothing_written(
    free: NativeInstance, seed: float
) -> None:
    status, values = free.differentiate(["der(pinion.angle)"], ["pinion.speed"], [1e-300])
    assert (status, values) == (OK, [pytest.approx(1e-300)])
    before = free.content()
    drag = ["der(pinion.speed)", "pinion.angle"]  # the first grows by 1/INERTIA
    status, values = free.differentiate(drag, ["pinion.torque"], [seed])
    assert (status, values) in ((DISCARD, [0.0, 0.0]), (OK, [pytest.approx(seed / INERTIA), 0.0]))
    assert free.content() == before
