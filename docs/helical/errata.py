"""What the printed equations of He et al. 2007 do where they run."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from docs.helical.cases import HIGH, steady
from gearlube_core.dynamics.helical_pair.he_2007 import PINION_SPEED, he_2007_pair
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    harmonics,
    periodic_response,
)


@dataclass(frozen=True, slots=True)
class Printed:
    """Consequences of printed forms.

    Parameters
    ----------
    sign_growth : float
        Growth of disturbances with the printed sign of eq. (4) [1/s].
    free_multiplier : float
        Modulus of the largest Floquet multiplier with the printed bearing moments [-].
    damped : float
        Least ratio of mesh orders 8 to 10 of u_yp, printed over consistent bearing damping [-].
    drift_torque, drift_power : float
        What friction leaves unbalanced at mu = 0.1 [N.m], [W].
    """

    sign_growth: float
    free_multiplier: float
    damped: float
    drift_torque: float
    drift_power: float


def printed() -> Printed:
    """Return what the printed forms do at 1000 rpm, mu = 0.1."""
    pair, consistent = he_2007_pair(HIGH), steady(HIGH)
    sign = periodic_response(replace(pair, mesh_sign="as_printed"), PINION_SPEED, throw=False)
    moments = periodic_response(
        replace(pair, bearing_moments="as_printed"), PINION_SPEED, throw=False
    )
    damping = periodic_response(replace(pair, support_damping="as_printed"), PINION_SPEED)
    ratio = harmonics(damping.signal("u_yp")) / harmonics(consistent.signal("u_yp"))
    return Printed(
        sign_growth=float(np.log(np.abs(sign.multipliers[0])) / sign.period),
        free_multiplier=float(np.abs(moments.multipliers[0])),
        damped=float(ratio[7:10].min()),
        drift_torque=consistent.friction_torque,
        drift_power=consistent.friction_power,
    )


def errata_text(found: Printed, template: str) -> str:
    """Return the section with its numbers."""
    return template.format(
        growth=found.sign_growth,
        multiplier=found.free_multiplier,
        damped=100.0 * (1.0 - found.damped),
        torque=found.drift_torque,
        power=found.drift_power,
    )
