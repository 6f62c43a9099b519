"""All metrics by the package phonometry."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from gearlube.studies.sound.metrics import Curve
from gearlube.studies.sound.pressure import RATE
from gearlube_core.arrays import Array

_NAME = "phonometry"


def loudness(pressure: Array, field: str) -> Curve:
    """Return the time-varying loudness of ISO 532-1 [sone]; the single value is N5."""
    import phonometry

    found = phonometry.loudness_zwicker(pressure, RATE, field=field)
    return Curve(
        np.asarray(found.time),
        np.asarray(found.loudness_vs_time),
        float(found.n5),
        f"ISO 532-1, {_NAME}",
    )


def tonality(pressure: Array, field: str) -> Curve:
    """Return the tonality of ECMA-418-2 [tu]."""
    import phonometry

    found = phonometry.tonality_ecma(pressure, RATE, field=field)
    return _curve(found, "tonality", "ECMA-418-2")


def roughness(pressure: Array, field: str) -> Curve:
    """Return the roughness of ECMA-418-2 [asper]."""
    import phonometry

    return _curve(phonometry.roughness_ecma(pressure, RATE, field=field), "roughness", "ECMA-418-2")


def fluctuation_strength(pressure: Array, field: str) -> Curve:
    """Return the fluctuation strength of ECMA-418-2 [vacil].

    Before version 3.3 the package has that of [osses_2016] alone, one value a second.
    """
    import phonometry

    if hasattr(phonometry, "fluctuation_strength_ecma"):
        found = phonometry.fluctuation_strength_ecma(pressure, RATE, field=field)
        return _curve(found, "fluctuation_strength", "ECMA-418-2")
    older = phonometry.fluctuation_strength(pressure, RATE)
    value = np.atleast_1d(np.asarray(older.time_dependent, dtype=np.float64))
    time = np.asarray((np.arange(value.size) + 0.5) * (pressure.size / RATE / value.size))
    return Curve(time, value, float(older.fluctuation_strength), f"Osses et al. 2016, {_NAME}")


def _curve(found: Any, name: str, standard: str) -> Curve:
    return Curve(
        np.asarray(found.time),
        np.asarray(getattr(found, f"{name}_vs_time")),
        float(getattr(found, name)),
        f"{standard}, {_NAME}",
    )


FUNCTIONS: dict[str, Callable[[Array, str], Curve]] = {
    "loudness": loudness,
    "tonality": tonality,
    "roughness": roughness,
    "fluctuation_strength": fluctuation_strength,
}
