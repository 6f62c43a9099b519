"""Force between two flanks with backlash: elastic part and damping, for all models."""

from __future__ import annotations

from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number

BACKLASH = Number("m", 0.0, 2e-3, "150 um is 1.5e-4 m.")  # of hypoid gears
DAMPING_BUILD_UP = 0.5e-6  # m, small against the 2 to 8 um of a loaded mesh


@kernel
def backlash_deflection(x: float, backlash: float) -> float:
    """Return f(x) [m]: x for x >= 0, 0 within the backlash, x + backlash beyond.

    References
    ----------
    [mohammadpour_2015 (3)] with backlash = 2b. [karagiannis_2012 (4)] is the same law; its x counts
    from the middle of the gap, b further on.
    """
    if x >= 0.0:
        return x
    if x <= -backlash:
        return x + backlash
    return 0.0


@kernel
def gated_force(elastic: float, c: float, x_rate: float, f: float) -> float:
    """Return the force [N] of flanks that neither adhere nor feel each other across the gap.

    Parameters
    ----------
    elastic : float
        k f [N].
    c, x_rate : float
        Damping [N s/m] and rate of approach [m/s]. Damping builds up over the first
        DAMPING_BUILD_UP of deflection, so that the force is continuous.
    f : float
        Deflection of `backlash_deflection` [m].
    """
    force = elastic + min(1.0, abs(f) / DAMPING_BUILD_UP) * c * x_rate
    return max(force, 0.0) if f >= 0.0 else min(force, 0.0)
