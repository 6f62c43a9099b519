"""The native models by name."""

from __future__ import annotations

from collections.abc import Callable

from fmu_src.definition import Definition
from fmu_src.native import helical_pair, hypoid_axle
from fmu_src.native.model import NativeModel

_MODELS: dict[str, Callable[[Definition], NativeModel]] = {
    "HypoidAxle": hypoid_axle.native_model,
    "HelicalPair": helical_pair.native_model,
}


def native_model(definition: Definition) -> NativeModel:
    """Return the parts of a native FMU of a definition."""
    return _MODELS[definition.name](definition)
