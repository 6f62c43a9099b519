"""Shear thinning: the activated flow of Eyring, at any shear rate without overflow."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel

# sinh and cosh grow as e^100 here; a film's half drop of stress over tau0 stays below 20
_LARGEST_SIGMA = 100.0
# below these the closed forms lose digits and the series are exact to double precision
_SMALL_POISEUILLE = 0.3
_SMALL_COUETTE = 1.0e-2
# 3 * 2k/(2k + 1)!, k = 1 to 6
_F1, _F2, _F3 = 1.0, 0.1, 1.0 / 280.0
_F4, _F5, _F6 = 1.0 / 15120.0, 1.0 / 1330560.0, 1.0 / 172972800.0
# asinh(x) = ln 2x to double precision above x = 1e8
_LOG_LARGE_RATIO = math.log(1.0e8)
_LN2 = math.log(2.0)
# sinh and cosh of a film's half drop of stress are kept finite
_LARGEST_STRESS = 600.0
_SMALL_SQUARE = 0.25
_SMALL_STRESS = 1e-3
# up to this q the series of sinh(t)/t with 1/(2n + 1)!, n to 7, is exact to double precision
_SERIES_SQUARE = 0.5
_DOUBLINGS = 20
_S1, _S2, _S3, _S4, _S5, _S6, _S7 = (1.0 / math.factorial(2 * n + 1) for n in range(1, 8))


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


class Eyring(NamedTuple):
    """Shear law du/dz = (tau0/eta) sinh(tau/tau0), with closed forms for a film.

    Source: [eyring_1936]
    """

    tau0: float  # Eyring stress [Pa]; 0: Newtonian

    @kernel
    def rate_ratio(self, q: float) -> tuple[float, float]:
        """Return G = sinh(t)/t and dG/dq, q = t^2."""
        if q < _SMALL_SQUARE:
            G = 1.0 + q / 6.0 * (
                1.0
                + q
                / 20.0
                * (1.0 + q / 42.0 * (1.0 + q / 72.0 * (1.0 + q / 110.0 * (1.0 + q / 156.0))))
            )
            slope = (
                1.0
                + q
                / 10.0
                * (1.0 + q / 28.0 * (1.0 + q / 54.0 * (1.0 + q / 88.0 * (1.0 + q / 130.0))))
            ) / 6.0
            return G, slope
        t = math.sqrt(q)
        grown, inverse = math.exp(t), 1.0 / t
        shrunk = 1.0 / grown
        G = 0.5 * (grown - shrunk) * inverse
        return G, 0.5 * (0.5 * (grown + shrunk) - G) * inverse * inverse

    @kernel
    def rate_ratios(self, q: np.ndarray, G: np.ndarray, slope: np.ndarray) -> None:
        """Fill the same of many points at once, shapes (n,), for the widest instructions.

        Notes
        -----
        Series at t/2^n, then n times the rules of the double argument, whose terms are all
        positive: S = sinh(t)/t, D = dS/dq give S(4q) = S (S + 2qD), D(4q) = (S^2 + 2SD + 4qD^2)/8.
        """
        most = 0.0
        for i in range(q.size):
            if q[i] > most:
                most = q[i]
        share, doublings = 1.0, 0
        while share * most > _SERIES_SQUARE and doublings < _DOUBLINGS:
            share *= 0.25
            doublings += 1
        for i in range(q.size):
            x = share * q[i]
            G[i] = 1.0 + x * (
                _S1 + x * (_S2 + x * (_S3 + x * (_S4 + x * (_S5 + x * (_S6 + x * _S7)))))
            )
        for i in range(q.size):
            x = share * q[i]
            slope[i] = _S1 + x * (
                2.0 * _S2
                + x
                * (3.0 * _S3 + x * (4.0 * _S4 + x * (5.0 * _S5 + x * (6.0 * _S6 + x * 7.0 * _S7))))
            )
        for _ in range(doublings):
            for i in range(q.size):
                x, S, D = share * q[i], G[i], slope[i]
                G[i] = S * (S + 2.0 * x * D)
                slope[i] = 0.125 * (S * (S + 2.0 * D) + 4.0 * x * D * D)
            share *= 4.0

    @kernel
    def flow_factor(self, sigma: float, a: float) -> tuple[float, float, float]:
        """Return `eyring_flow_factor`."""
        return eyring_flow_factor(sigma, a)

    @kernel
    def mid_stress(self, sigma: float, a: float) -> float:
        """Return the stress at mid-film over tau0 [-], `eyring_mean_stress`."""
        return eyring_mean_stress(sigma, a, 1.0)

    @kernel
    def shear_rate(self, stress: float, eta: float) -> float:
        """Return the shear rate [1/s] of a stress [Pa], finite for any stress."""
        if self.tau0 > 0.0:
            ratio = min(max(stress / self.tau0, -_LARGEST_STRESS), _LARGEST_STRESS)
            return self.tau0 / eta * math.sinh(ratio)
        return stress / eta

    @kernel
    def stress_share(self, stress: float) -> float:
        """Return d ln(tau)/d ln(eta) at one shear rate, tanh(t)/t [-]; stress not negative."""
        if self.tau0 > 0.0 and stress > _SMALL_STRESS * self.tau0:
            return math.tanh(stress / self.tau0) * self.tau0 / stress
        return 1.0

    @kernel
    def layered_stress(self, eta: np.ndarray, h: float, slope: float, sliding: float) -> float:
        """Return the stress at mid-film of layers of uneven viscosity [Pa].

        Notes
        -----
        Closed form: integral of [sinh(a) cosh(bz) + cosh(a) sinh(bz)]/eta.
        """
        m = eta.size
        dz = 1.0 / (m - 1)
        even, odd, b = 0.0, 0.0, 0.0
        if self.tau0 > 0.0:
            b = slope * h / self.tau0
            b = math.copysign(min(abs(b), 2.0 * _LARGEST_SIGMA), b)
        for k in range(m):
            z = k * dz - 0.5
            fluidity = (dz if 0 < k < m - 1 else 0.5 * dz) / eta[k]
            if self.tau0 > 0.0:
                even += fluidity * math.cosh(b * z)
                odd += fluidity * math.sinh(b * z)
            else:
                even += fluidity
                odd += fluidity * z
        if self.tau0 > 0.0:
            asymmetry = odd / even
            root = even * math.sqrt(max(1.0 - asymmetry * asymmetry, 1e-300))
            shift = math.atanh(min(max(asymmetry, -1.0 + 1e-15), 1.0 - 1e-15))
            return self.tau0 * (math.asinh(sliding / (h * self.tau0 * root)) - shift)
        return (sliding / h - slope * h * odd) / even


NEWTONIAN = Eyring(0.0)
