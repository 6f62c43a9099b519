"""Outputs that are computed when a host reads them, against a library that computes them always."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.helpers.native_library import ERROR, OK, NativeInstance, NativeLibrary
from tests.helpers.small_native_builds import LAZY_MODEL, loaded
from tests.helpers.small_native_model import SINGULAR_OIL

H = 1e-3  # s
UNWATCHED = 10  # steps in the 10 ms after which ranges are looked at, read or not


@pytest.fixture(scope="module", params=[2, 3], ids=["FMI 2", "FMI 3"])
def libraries(request: pytest.FixtureRequest) -> tuple[NativeLibrary, NativeLibrary]:
    return loaded(request.param, model=LAZY_MODEL), loaded(request.param)


@pytest.fixture
def pair(libraries: tuple[NativeLibrary, NativeLibrary]) -> Iterator[list[NativeInstance]]:
    """The same model, lazy and eager."""
    made = [NativeInstance(library) for library in libraries]
    yield made
    for instance in made:
        instance.close()


def stepped(instance: NativeInstance, count: int, **values: float) -> None:
    for k in range(count):
        instance.set(pinion__torque=3.0 + k, **values)
        assert instance.step(H) == OK


@pytest.mark.parametrize("first", ["pinion.speed", "oil.ratio", "mass.turns"])
def test_what_is_read_late_is_what_would_have_been_read(
    pair: list[NativeInstance], first: str
) -> None:
    for instance in pair:
        instance.start()
        stepped(instance, 7)
    assert pair[0].get(first) == pair[1].get(first)
    assert pair[0].outputs() == pair[1].outputs()
    for instance in pair:
        stepped(instance, 1)
    assert pair[0].outputs() == pair[1].outputs()


def test_a_state_saved_unread_holds_all_outputs(pair: list[NativeInstance]) -> None:
    lazy, eager = pair
    lazy.start()
    stepped(lazy, 5)
    state, time = lazy.save(), lazy.time
    stepped(lazy, 3)
    lazy.outputs()
    assert lazy.restore(state, time) == OK
    eager.start()
    stepped(eager, 5)
    assert lazy.outputs() == eager.outputs()


def test_terminated_outputs_are_those_of_the_end(pair: list[NativeInstance]) -> None:
    for instance in pair:
        instance.start()
        stepped(instance, 4)
        assert instance.call("Terminate") == OK
    assert pair[0].outputs() == pair[1].outputs()


def test_a_range_left_unread_is_named_within_ten_milliseconds(pair: list[NativeInstance]) -> None:
    lazy, _ = pair
    lazy.start()
    for _ in range(UNWATCHED + 1):
        lazy.set(pinion__torque=35.0)
        assert lazy.step(H) == OK
    assert lazy.messages("logStatusWarning").count("said once a run") == 1


def test_an_output_that_is_not_finite_is_refused_alone(pair: list[NativeInstance]) -> None:
    lazy, _ = pair
    lazy.start()
    lazy.set(oil__temperature=SINGULAR_OIL)
    assert lazy.step(H) == OK
    reference = [lazy.library.references["oil.ratio"]]
    assert lazy.get_raw("Real", reference, 1)[0] == ERROR
    assert "oil.ratio is not finite" in lazy.messages("logStatusError")
    assert lazy.get("pinion.speed") > 0.0
    lazy.set(oil__temperature=300.0)
    assert lazy.step(H) == OK
    assert lazy.get_raw("Real", reference, 1)[0] == OK
