"""Loudness and roughness by the package mosqito, for Python 3.11 and 3.12."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gearlube.studies.sound.metrics import Curve
from gearlube.studies.sound.pressure import RATE
from gearlube_core.arrays import Array


def loudness(pressure: Array, field: str) -> Curve:
    """Return the time-varying loudness of ISO 532-1 [sone]; the single value is N5."""
    from mosqito import loudness_zwtv

    value, _, _, time = loudness_zwtv(pressure, RATE, field_type=field)
    return Curve(time, value, float(np.percentile(value, 95.0)), "ISO 532-1, MoSQITo")


def roughness(pressure: Array, field: str) -> Curve:
    """Return the roughness of ECMA-418-2 [asper]; this package knows the free field alone."""
    from mosqito import roughness_ecma

    with np.errstate(divide="ignore"):  # it divides by modulation rates of zero
        single, value, _, _, time = roughness_ecma(pressure, RATE)
    return Curve(
        np.asarray(time), np.asarray(value), float(single), "ECMA-418-2, free field, MoSQITo"
    )


FUNCTIONS: dict[str, Callable[[Array, str], Curve]] = {"loudness": loudness, "roughness": roughness}
