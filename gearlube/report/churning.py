"""Where churning of an axle changes its formula: a variable of datasets, and the finding."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gearlube.report.numbers import quantity_text
from gearlube.report.parts import NOTE, WARNING, Finding
from gearlube_core.arrays import Array
from gearlube_core.drag import fast_regime
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters

REGIME = ("1", "churning by its slow formula at 0, by its fast one at 1")  # unit, words
_LAW = "changenet_velex_2007"  # the one with two formulas
_NEAR = 5.0  # K, between the oils of two points that are compared


def churning_regime(
    axle: HypoidAxleParameters, temperature: ArrayLike, gear_speed: ArrayLike
) -> Array | None:
    """Return `fast_regime` at oil temperatures [K] and speeds of the gear [rad/s], broadcast.

    None for axles whose churning has one formula. NaN where temperature or speed is NaN.
    """
    if axle.churning != _LAW:
        return None
    p, oil = axle.kernel_parameters().churning, axle.oil
    kelvin, speed = np.broadcast_arrays(
        np.asarray(temperature, float), np.asarray(gear_speed, float)
    )
    found = [
        fast_regime(float(w), oil.dynamic_viscosity(float(t)) / oil.density, p)
        if np.isfinite(t + w)
        else np.nan
        for t, w in zip(kelvin.flat, np.abs(speed).flat, strict=True)
    ]
    return np.reshape(found, speed.shape)


def regime_findings(
    regime: Array, speed: Array, unit: str, loss: Array, oil: ArrayLike
) -> list[Finding]:
    """Return the finding where churning changes its formula; none where it does not.

    Parameters
    ----------
    regime, speed, loss : ndarray of one shape
        Of points: `churning_regime` [-], speed [unit], power lost by churning [W].
    unit : str
        Of the speed, "rpm".
    oil : array_like
        Temperature [degC].

    Examples
    --------
    >>> at = np.array([1000.0, 1500.0])
    >>> regime_findings(np.array([0.0, 1.0]), at, "rpm", np.array([3.4, 50.0]), 100.0)[0].level
    'warning'
    """
    degc = np.broadcast_to(np.asarray(oil, float), regime.shape).ravel()
    at, lost, regime = speed.ravel(), loss.ravel(), regime.ravel()
    known = np.isfinite(lost) & (at > 0.0)
    fast = np.flatnonzero(known & (regime >= 1.0))
    if not fast.size:
        return []
    first = fast[np.argmin(at[fast])]
    below = known & (regime <= 0.0) & (at < at[first]) & (np.abs(degc - degc[first]) <= _NEAR)
    slow = np.flatnonzero(below)
    if not slow.size:
        return []
    last = slow[np.argmax(at[slow])]
    usual = 3.0 * (at[first] / at[last]) ** 1.6  # error bar, and growth of the slow formula
    return [
        Finding(
            WARNING if lost[first] > usual * lost[last] else NOTE,
            f"Churning changes its regime between {at[last]:.0f} and {at[first]:.0f} {unit} with "
            f"{degc[first]:.4g} °C oil and rises from {quantity_text(float(lost[last]), 'W')} to "
            f"{quantity_text(float(lost[first]), 'W')}.",
            "So far do Changenet and Velex' two formulas differ for this gear. The error bar does "
            "not cover where the change happens: compare with another law (housing.churning).",
        )
    ]
