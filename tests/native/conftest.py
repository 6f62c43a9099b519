from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests.helpers.native_library import NativeInstance, NativeLibrary
from tests.helpers.small_native_builds import loaded


@pytest.fixture(scope="session", params=[2, 3], ids=["FMI 2", "FMI 3"])
def library(request: pytest.FixtureRequest) -> NativeLibrary:
    """The small model by each version of the standard."""
    return loaded(request.param)


@pytest.fixture
def new(library: NativeLibrary) -> Iterator[Callable[..., NativeInstance]]:
    made: list[NativeInstance] = []

    def make(**options: Any) -> NativeInstance:
        made.append(NativeInstance(library, **options))
        return made[-1]

    yield make
    for instance in made:
        instance.close()


@pytest.fixture
def mass(new: Callable[..., NativeInstance]) -> NativeInstance:
    return new()
