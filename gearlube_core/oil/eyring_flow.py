"""Flow and traction of an Eyring film that is sheared and pumped along one line."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

# sinh and cosh grow as e^100 here; a film's half drop of stress over tau0 stays below 20
_LARGEST_SIGMA = 100.0
# below these the closed forms lose digits and the series are exact to double precision
_SMALL_POISEUILLE = 0.3
_SMALL_COUETTE = 1.0e-2
# 3 * 2k/(2k + 1)!, k = 1 to 6
_F1, _F2, _F3 = 1.0, 0.1, 1.0 / 280.0
_F4, _F5, _F6 = 1.0 / 15120.0, 1.0 / 1330560.0, 1.0 / 172972800.0


@kernel
def _poiseuille_part(s: float) -> tuple[float, float]:
    # F = 3 (s cosh s - sinh s)/s^3 and dF/ds, s >= 0
    if s < _SMALL_POISEUILLE:
        q = s * s
        value = _F1 + q * (_F2 + q * (_F3 + q * (_F4 + q * (_F5 + q * _F6))))
        slope = _F2 + q * (2.0 * _F3 + q * (3.0 * _F4 + q * (4.0 * _F5 + q * 5.0 * _F6)))
        return value, 2.0 * s * slope
    sh, ch = math.sinh(s), math.cosh(s)
    value = 3.0 * (s * ch - sh) / (s * s * s)
    return value, 3.0 * sh / (s * s) - 3.0 * value / s


@kernel
def _couette_part(s: float) -> tuple[float, float]:
    # G = s/sinh s and dG/ds, s >= 0
    if s < _SMALL_COUETTE:
        q = s * s
        value = 1.0 - q * (1.0 / 6.0 - q * (7.0 / 360.0 - q * 31.0 / 15120.0))
        return value, -s * (1.0 / 3.0 - q * (7.0 / 90.0 - q * 31.0 / 2520.0))
    sh = math.sinh(s)
    value = s / sh
    return value, value * (1.0 / s - math.cosh(s) / sh)


@kernel
def eyring_flow_factor(sigma: float, a: float) -> tuple[float, float, float]:
    """Return the flow by pressure over its Newtonian value, and its slopes.

    S = 3 (s cosh s - sinh s)/s^3 [1 + (a s/sinh s)^2]^(1/2),  s = |sigma|

    Parameters
    ----------
    sigma
        Stress drop over half the film, h (dp/dx)/(2 tau0) [-], either sign.
    a
        Newtonian shear stress over tau0, eta (u2 - u1)/(h tau0) [-], either sign.

    Returns
    -------
    tuple of float
        S [-], dS/dsigma, dS/da.

    Notes
    -----
    Derived from du/dz = tau0/eta sinh(tau/tau0), tau = tau_m + z dp/dx: no slip gives
    sinh(tau_m/tau0) = a s/sinh s, and the flow is the integral of -z du/dz. Above |sigma| = 100
    the factor is kept at its value there.
    Source: [conry_1987]; in one dimension
    [jamali_2015 (3.25)] [jamali_2015 (3.26)] [jamali_2015 (3.29)] [jamali_2015 (3.29a)]
    [jamali_2015 (3.31)] [jamali_2015 (3.33)] [jamali_2015 (3.35)] [jamali_2015 (3.37)]
    [jamali_2015 (3.39)]
    """
    s = min(abs(sigma), _LARGEST_SIGMA)
    F, F_s = _poiseuille_part(s)
    G, G_s = _couette_part(s)
    root = math.sqrt(1.0 + (a * G) * (a * G))
    slope = F_s * root + F * a * a * G * G_s / root
    if abs(sigma) > _LARGEST_SIGMA:
        slope = 0.0
    elif sigma < 0.0:
        slope = -slope
    return F * root, slope, F * a * G * G / root


@kernel
def eyring_mean_stress(sigma: float, a: float, tau0: float) -> float:
    """Return the shear stress at mid-film, tau0 asinh(a s/sinh s) [Pa], with the sign of `a`."""
    s = min(abs(sigma), _LARGEST_SIGMA)
    return tau0 * math.asinh(a * _couette_part(s)[0])
