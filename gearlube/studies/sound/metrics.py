"""Psychoacoustic metrics by a package: which one computes what, and what is missing.

Loudness is that of [iso_532_1], the others are those of [ecma_418_2].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from gearlube.studies.sound.pressure import RATE
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError


@dataclass(frozen=True, slots=True)
class Metric:
    """A metric of sound: unit, standard, description.

    Parameters
    ----------
    unit, standard, words : str
    """

    unit: str
    standard: str
    words: str


@dataclass(frozen=True, slots=True)
class Curve:
    """A metric over time.

    Parameters
    ----------
    time : array
        [s], shape (n,).
    value : array
        In the unit of the metric, shape (n,).
    single : float
        The single value that the standard gives for the whole sound: N5 for loudness, the 90th
        percentile for roughness and fluctuation strength, the mean above 0.02 for tonality.
    standard : str
        What computed it, in words.
    """

    time: Array
    value: Array
    single: float
    standard: str


METRICS = {
    "loudness": Metric("sone", "ISO 532-1, time-varying", "loudness"),
    "tonality": Metric("tu", "ECMA-418-2", "tonality"),
    "roughness": Metric("asper", "ECMA-418-2", "roughness"),
    "fluctuation_strength": Metric("vacil", "ECMA-418-2", "fluctuation strength"),
}
ENGINES = ("phonometry", "mosqito")
INSTALL = "pip install 'gearlube[sound]'"
NEITHER = (
    "Loudness and the other metrics need the package phonometry (Python 3.13 or newer) or mosqito, "
    f"but neither is installed. Install one: {INSTALL}"
)


def installed() -> str | None:
    """Return the package that computes loudness: phonometry, else mosqito, None without both."""
    return next((name for name in ENGINES if find_spec(name) is not None), None)


def engine() -> str:
    """Return the package that computes loudness.

    Raises
    ------
    ParameterError
        Neither is installed.
    """
    if (name := installed()) is not None:
        return name
    raise ParameterError(f"{NEITHER}. Or leave the metrics out: --metrics none.")


def missing(name: str) -> str:
    """Return why a metric cannot be computed here, "" if it can."""
    if name in _FUNCTIONS[engine()]:
        return ""
    return (
        f"{METRICS[name].words} ({METRICS[name].standard}) needs the package phonometry, which "
        "runs on Python 3.13 and newer"
    )


def metric_curve(name: str, pressure: Array, field: str = "free") -> Curve:
    """Return a metric of a pressure at 48 kHz.

    Parameters
    ----------
    name : str
        One of `METRICS`.
    pressure : array
        [Pa], shape (n,).
    field : {"free", "diffuse"}

    Raises
    ------
    ParameterError
        No package here computes it.
    """
    if why := missing(name):
        raise ParameterError(f"{why}. Use it with {INSTALL}, or leave the metric out.")
    return _FUNCTIONS[engine()][name](np.ascontiguousarray(pressure), field)


def steady_loudness(pressure: Array, field: str = "free") -> float:
    """Return the loudness of a short piece of sound at 48 kHz [sone], ISO 532-1, stationary."""
    if engine() == "phonometry":
        found = import_module("phonometry").loudness_zwicker(
            pressure, RATE, field=field, stationary=True
        )
        return float(found.loudness)
    loudness, _, _ = import_module("mosqito").loudness_zwst(pressure, RATE, field_type=field)
    return float(loudness)


def _mosqito_loudness(pressure: Array, field: str) -> Curve:
    """Return the time-varying loudness of ISO 532-1 [sone]; the single value is N5."""
    from mosqito import loudness_zwtv

    value, _, _, time = loudness_zwtv(pressure, RATE, field_type=field)
    return Curve(time, value, float(np.percentile(value, 95.0)), "ISO 532-1, MoSQITo")


def _mosqito_roughness(pressure: Array, field: str) -> Curve:
    """Return the roughness of ECMA-418-2 [asper]; this package knows the free field alone."""
    from mosqito import roughness_ecma

    with np.errstate(divide="ignore"):  # it divides by modulation rates of zero
        single, value, _, _, time = roughness_ecma(pressure, RATE)
    return Curve(
        np.asarray(time), np.asarray(value), float(single), "ECMA-418-2, free field, MoSQITo"
    )


def _phonometry_loudness(pressure: Array, field: str) -> Curve:
    """Return the time-varying loudness of ISO 532-1 [sone]; the single value is N5."""
    import phonometry

    found = phonometry.loudness_zwicker(pressure, RATE, field=field)
    return Curve(
        np.asarray(found.time),
        np.asarray(found.loudness_vs_time),
        float(found.n5),
        "ISO 532-1, phonometry",
    )


def _phonometry_tonality(pressure: Array, field: str) -> Curve:
    """Return the tonality of ECMA-418-2 [tu]."""
    import phonometry

    found = phonometry.tonality_ecma(pressure, RATE, field=field)
    return _curve(found, "tonality", "ECMA-418-2")


def _phonometry_roughness(pressure: Array, field: str) -> Curve:
    """Return the roughness of ECMA-418-2 [asper]."""
    import phonometry

    return _curve(phonometry.roughness_ecma(pressure, RATE, field=field), "roughness", "ECMA-418-2")


def _phonometry_fluctuation_strength(pressure: Array, field: str) -> Curve:
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
    return Curve(time, value, float(older.fluctuation_strength), "Osses et al. 2016, phonometry")


def _curve(found: Any, name: str, standard: str) -> Curve:
    return Curve(
        np.asarray(found.time),
        np.asarray(getattr(found, f"{name}_vs_time")),
        float(getattr(found, name)),
        f"{standard}, phonometry",
    )


_FUNCTIONS: dict[str, dict[str, Callable[[Array, str], Curve]]] = {
    "phonometry": {
        "loudness": _phonometry_loudness,
        "tonality": _phonometry_tonality,
        "roughness": _phonometry_roughness,
        "fluctuation_strength": _phonometry_fluctuation_strength,
    },
    "mosqito": {"loudness": _mosqito_loudness, "roughness": _mosqito_roughness},
}
