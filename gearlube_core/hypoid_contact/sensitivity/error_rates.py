"""Derivatives of the unloaded transmission error and of the mean contact by settings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import ContactPath, contact_path
from gearlube_core.hypoid_contact.sensitivity.path_rates import PathRates, angle_rates, path_rates
from gearlube_core.hypoid_contact.sensitivity.variations import Variations
from gearlube_core.hypoid_contact.unloaded_error import UnloadedError


@dataclass(frozen=True, slots=True)
class ErrorRates:
    """Derivatives of the unloaded mesh over a period, per unit of each of P parameters.

    Parameters
    ----------
    gear_angle : ndarray of shape (N,)
        From handover to handover [rad].
    transmission_error : ndarray of shape (P, N)
        Of the pair in contact, at fixed gear angle [rad/unit].
    peak_to_peak : ndarray of shape (P,)
        Of the error between its extreme and the handover [rad/unit].
    handover_angle, extreme_angle : ndarray of shape (P,)
        Gear angles of the first handover and of the extreme [rad/unit].
    s, t : ndarray of shape (P,)
        Of the mean contact on the gear flank: where the error is extreme [1/unit].
    path : PathRates
        Of the contacts.
    """

    gear_angle: Array
    transmission_error: Array
    peak_to_peak: Array
    handover_angle: Array
    extreme_angle: Array
    s: Array
    t: Array
    path: PathRates


def error_rates(variations: Variations, error: UnloadedError) -> ErrorRates:
    """Return the derivatives of the unloaded transmission error by parameters.

    At the handover the errors e of the leaving and the entering pair are equal, and move the angle
    by -(e_p1 - e_p0) / (e'_1 - e'_0), with e_p at fixed angle and e' along the path. At the extreme
    R_g / R_p is the teeth ratio.

    Parameters
    ----------
    variations : Variations
        Of the error's pair.
    error : UnloadedError
    """
    pair = error.path.pair
    angles = np.append(error.gear_angle, error.extreme_angle)
    rates = path_rates(variations, contact_path(pair, angles))
    by_setting = rates.transmission_error
    k = error.kinematics
    slope = k.R_g / k.R_p - pair.ratio
    handover = -(by_setting[:, -2] - by_setting[:, 0]) / (slope[-1] - slope[0])
    at_handover = by_setting[:, 0] + slope[0] * handover
    extreme, (s, t) = _extreme(variations, rates)
    highest = error.angular[0] > 0.0
    return ErrorRates(
        gear_angle=error.gear_angle,
        transmission_error=by_setting[:, :-1],
        peak_to_peak=(1.0 if highest else -1.0) * (at_handover - by_setting[:, -1]),
        handover_angle=handover,
        extreme_angle=extreme,
        s=s,
        t=t,
        path=rates,
    )


def _extreme(variations: Variations, rates: PathRates) -> tuple[Array, tuple[Array, Array]]:
    """Return how the angle of the extreme moves, the last of the path, and its place (s, t)."""
    lower, upper, angle = angle_rates(rates.path)

    def along(values: tuple[Array, Array]) -> float:
        return float((values[1][-1] - values[0][-1]) / (2.0 * angle))

    bend = along((_mismatch(lower), _mismatch(upper)))
    by_setting = variations.difference(
        np.array([_mismatch(one)[-1] for one in rates.lower]),
        np.array([_mismatch(one)[-1] for one in rates.upper]),
    )
    moved = -by_setting / bend
    return moved, (
        rates.gear_s[:, -1] + along((lower.gear_s, upper.gear_s)) * moved,
        rates.gear_t[:, -1] + along((lower.gear_t, upper.gear_t)) * moved,
    )


def _mismatch(path: ContactPath) -> Array:
    k = path_kinematics(path)
    return k.R_g / k.R_p - path.pair.ratio
