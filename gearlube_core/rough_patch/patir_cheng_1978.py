"""Published fits of flow factors, Patir and Cheng 1978 and 1979."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError

# Peklenik number to C, r, smallest h/sigma; [patir_cheng_1978 Table 1]
_PRESSURE = {
    1.0 / 9.0: (1.48, 0.42, 1.0),
    1.0 / 6.0: (1.38, 0.42, 1.0),
    1.0 / 3.0: (1.18, 0.42, 0.75),
    1.0: (0.90, 0.56, 0.5),
    3.0: (0.225, 1.5, 0.5),
    6.0: (0.520, 1.5, 0.5),
    9.0: (0.870, 1.5, 0.5),
}
# Peklenik number to A1, alpha1, alpha2, alpha3, A2; [patir_cheng_1979 Table 1]
_SHEAR = {
    1.0 / 9.0: (2.046, 1.12, 0.78, 0.03, 1.856),
    1.0 / 6.0: (1.962, 1.08, 0.77, 0.03, 1.754),
    1.0 / 3.0: (1.858, 1.01, 0.76, 0.03, 1.561),
    1.0: (1.899, 0.98, 0.92, 0.05, 1.126),
    3.0: (1.560, 0.85, 1.13, 0.08, 0.556),
    6.0: (1.290, 0.62, 1.09, 0.08, 0.388),
    9.0: (1.011, 0.54, 1.07, 0.08, 0.295),
}
PEKLENIK = tuple(_PRESSURE)
_SHEAR_JOINT = 5.0  # h/sigma where the two forms of the shear factor meet
_SHEAR_LEAST = 0.5


def pressure_flow_factor(film_ratio: Array, peklenik: float) -> Array:
    """Return the pressure flow factor along the motion.

    phi_x = 1 - C exp(-r h/sigma) for gamma <= 1,  1 + C (h/sigma)^(-r) for gamma > 1

    Parameters
    ----------
    film_ratio
        h/sigma [-]: distance of the mean planes over the rms height of both surfaces together.
    peklenik
        gamma, correlation length along the motion over that across it: one of 1/9, 1/6, 1/3, 1, 3,
        6, 9. That across the motion is phi_x of 1/gamma.

    Raises
    ------
    ParameterError
        Another Peklenik number, or a film ratio below 0.5 (0.75 for 1/3; 1 for 1/6 and 1/9).

    Notes
    -----
    Gaussian heights with a linear autocorrelation. Source: [patir_cheng_1978].
    """
    C, r, least = _row(_PRESSURE, peklenik)
    _check_ratio(film_ratio, least)
    if peklenik > 1.0:
        return np.asarray(1.0 + C * film_ratio**-r)
    return np.asarray(1.0 - C * np.exp(-r * film_ratio))


def shear_flow_factor(film_ratio: Array, peklenik: float) -> Array:
    """Return the shear flow factor of one rough surface that moves against a smooth one.

    Phi_s = A1 H^alpha1 exp(-alpha2 H + alpha3 H^2) for H = h/sigma <= 5,  A2 exp(-H/4) beyond

    Of two: phi_s = (sigma_1/sigma)^2 Phi_s(gamma_1) - (sigma_2/sigma)^2 Phi_s(gamma_2).

    Parameters, errors as of `pressure_flow_factor`; h/sigma is at least 0.5.

    Notes
    -----
    Source: [patir_cheng_1979].
    """
    A1, alpha1, alpha2, alpha3, A2 = _row(_SHEAR, peklenik)
    _check_ratio(film_ratio, _SHEAR_LEAST)
    near = A1 * film_ratio**alpha1 * np.exp(-alpha2 * film_ratio + alpha3 * film_ratio**2)
    return np.asarray(np.where(film_ratio <= _SHEAR_JOINT, near, A2 * np.exp(-0.25 * film_ratio)))


def _row(table: Mapping[float, tuple[float, ...]], peklenik: float) -> tuple[float, ...]:
    nearest = min(table, key=lambda one: abs(one / peklenik - 1.0))
    if abs(nearest / peklenik - 1.0) > 1e-9:
        check_option("peklenik", f"{peklenik:g}", [f"{one:.6g}" for one in table])
    return table[nearest]


def _check_ratio(film_ratio: Array, least: float) -> None:
    if not float(np.min(film_ratio)) >= least:
        raise ParameterError(
            f"film_ratio h/sigma must be at least {least:g} for this Peklenik number, got "
            f"{float(np.min(film_ratio)):.3g}. The published fit does not cover smaller values."
        )
