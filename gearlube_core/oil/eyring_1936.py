"""Shear thinning: the activated flow of Eyring, at any shear rate without overflow."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

# asinh(x) = ln 2x to double precision above x = 1e8
_LOG_LARGE_RATIO = math.log(1.0e8)
_LN2 = math.log(2.0)


@kernel
def eyring_stress_ratio(newtonian_ratio: float, exponent: float) -> float:
    """Return tau/tau0 for a Newtonian stress given as ratio times exponential.

    tau/tau0 = asinh(x exp(y))

    Parameters
    ----------
    newtonian_ratio
        x = eta0 shear_rate / tau0 [-], not negative.
    exponent
        y = ln(eta/eta0) [-], for example alpha p.

    Returns
    -------
    float
        Shear stress over Eyring stress [-].

    Notes
    -----
    Any finite x >= 0 and y: the exponential is not formed where it would overflow.
    Source: [eyring_1936]; [johnson_tevaarwerk_1977] without the elastic term;
    [karagiannis_2012 (14)] [jamali_2015 (3.26)]
    """
    if newtonian_ratio <= 0.0:
        return 0.0
    log_ratio = math.log(newtonian_ratio) + exponent
    if log_ratio > _LOG_LARGE_RATIO:
        return log_ratio + _LN2
    return math.asinh(math.exp(log_ratio))
