"""Families of small cases as one test, which lists all that fail."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from typing import Any

import pytest


def each(names: str | tuple[str, ...], cases: Iterable[Any]) -> Callable[[Any], Any]:
    """Run a test with every case, as `pytest.mark.parametrize` does, but as one test.

    A hundred cases of a millisecond take a second as tests of their own. All cases share the
    fixtures: `caplog` and `monkeypatch` keep what the cases before have left.

    >>> @each("value", [1, -2, -3])
    ... def test_positive(value):
    ...     assert value > 0, "too low"
    >>> test_positive()
    Traceback (most recent call last):
    AssertionError: 2 of 3 cases fail:
    -2: too low
    -3: too low
    """
    own = [one.strip() for one in (names.split(",") if isinstance(names, str) else names)]
    cases = list(cases)

    def decorate(test: Callable[..., None]) -> Callable[..., None]:
        def test_with_each(**fixtures: Any) -> None:
            failed = []
            for case in cases:
                values = case if len(own) > 1 else (case,)
                try:
                    test(**dict(zip(own, values, strict=True)), **fixtures)
                except (Exception, pytest.fail.Exception) as error:
                    failed.append(f"{case}: {error or repr(error)}")
            assert not failed, "\n".join([f"{len(failed)} of {len(cases)} cases fail:", *failed])

        left = inspect.signature(test).parameters.items()
        test_with_each.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
            [one for name, one in left if name not in own]
        )
        test_with_each.__name__, test_with_each.__doc__ = test.__name__, test.__doc__
        test_with_each.__module__ = test.__module__
        return test_with_each

    return decorate
