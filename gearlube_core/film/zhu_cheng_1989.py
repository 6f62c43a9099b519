"""Inlet heating of a rolling and sliding contact, Zhu and Cheng 1989."""

from __future__ import annotations

from gearlube_core.kernels.jit import kernel


@kernel
def zhu_cheng_heating(
    heating_number: float, pressure_ratio: float, slide_roll_ratio: float
) -> float:
    """Return the factor by which inlet heating lowers the film.

    phi = [1 - 13.2 (p_H/E') Lt^0.42]/[1 + 0.213 (1 + 2.23 S^0.83) Lt^0.64]

    Parameters
    ----------
    heating_number
        Lt = eta0 beta u^2/K, see `groups.inlet_heating_number` [-].
    pressure_ratio
        Largest Hertz pressure over E' [-].
    slide_roll_ratio
        S, sliding speed over mean speed, not negative [-].

    Returns
    -------
    float
        0 to 1 [-]; 0 where the numerator is negative.

    Notes
    -----
    Made for the film. [zhou_hoeprich_1991] puts it on the rolling force.
    Source: [zhu_cheng_1989]
    """
    top = 1.0 - 13.2 * pressure_ratio * heating_number**0.42
    slip = 1.0 + 2.23 * slide_roll_ratio**0.83
    return max(top, 0.0) / (1.0 + 0.213 * slip * heating_number**0.64)
