"""Psychoacoustic metrics by a package: which one computes what, and what is missing.

Loudness is that of [iso_532_1], the others are those of [ecma_418_2].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec

import numpy as np

from gearlube.studies.sound.pressure import RATE
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError


@dataclass(frozen=True, slots=True)
class Metric:
    """What a metric is.

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
    if name in _functions():
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
    return _functions()[name](np.ascontiguousarray(pressure), field)


def steady_loudness(pressure: Array, field: str = "free") -> float:
    """Return the loudness of a short piece of sound at 48 kHz [sone], ISO 532-1, stationary."""
    if engine() == "phonometry":
        found = import_module("phonometry").loudness_zwicker(
            pressure, RATE, field=field, stationary=True
        )
        return float(found.loudness)
    loudness, _, _ = import_module("mosqito").loudness_zwst(pressure, RATE, field_type=field)
    return float(loudness)


def _functions() -> dict[str, Callable[[Array, str], Curve]]:
    if engine() == "phonometry":
        from gearlube.studies.sound.phonometry_metrics import FUNCTIONS

        return FUNCTIONS
    from gearlube.studies.sound.mosqito_metrics import FUNCTIONS

    return FUNCTIONS
