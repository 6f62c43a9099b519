"""Random sequences of calls: no crash, no NaN with OK, no change after an Error or a Discard."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.helpers.native_call_arguments import LARGEST
from tests.helpers.native_calls import NAMES, OF_EXCHANGE, run_calls, run_random
from tests.helpers.native_library import NativeLibrary

CALLS = st.lists(st.tuples(st.sampled_from(NAMES), st.integers(0, LARGEST)), max_size=40)


@settings(max_examples=150, suppress_health_check=[HealthCheck.too_slow])
@given(calls=CALLS)
def test_any_sequence_of_calls_is_answered_as_the_standard_asks(
    library: NativeLibrary, calls: list[tuple[str, int]]
) -> None:
    run_calls(library, calls)


CALLS_OF_EXCHANGE = st.lists(
    st.tuples(st.sampled_from(OF_EXCHANGE), st.integers(0, LARGEST)), max_size=40
)
KINDS = pytest.mark.parametrize("exchange", [False, True], ids=["co-simulation", "exchange"])


@settings(max_examples=150, suppress_health_check=[HealthCheck.too_slow])
@given(calls=CALLS_OF_EXCHANGE)
def test_any_sequence_of_calls_of_model_exchange_is_answered_as_the_standard_asks(
    library: NativeLibrary, calls: list[tuple[str, int]]
) -> None:
    run_calls(library, calls, exchange=True)


@KINDS
@pytest.mark.parametrize("seed", range(2))
def test_long_sequences_are_answered_as_the_standard_asks(
    library: NativeLibrary, seed: int, exchange: bool
) -> None:
    run_random(library, sequences=10, seed=seed, longest=200, exchange=exchange)


@KINDS
@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 110))
def test_ten_thousand_sequences_are_answered_as_the_standard_asks(
    library: NativeLibrary, seed: int, exchange: bool
) -> None:
    run_random(library, sequences=1000, seed=seed, exchange=exchange)
