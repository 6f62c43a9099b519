"""Stress and flow of a film that is sheared and pumped along one line, for any shear law: kernels.

A law may bring a closed form of its own under each of these names; those here serve any law.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import rate_ratio
from gearlube_core.oil.shear_flow import shear_flow

# slopes by a small Sigma are taken there: they change with its square
_SMALL_SIGMA = 1.0e-4
_STEPS = 80
_THERE = 1.0e-12


@kernel
def _flow_factor(law: Any, sigma: float, a: float) -> tuple[float, float, float]:
    factor = shear_flow(law, sigma, 0.0, a, math.inf).along
    at = math.copysign(max(abs(sigma), _SMALL_SIGMA), sigma)
    flow = shear_flow(law, at, 0.0, a, math.inf)
    return factor, (flow.flow_ss - flow.along) / at, flow.flow_s_a / at


@kernel
def _mid_stress(law: Any, sigma: float, a: float) -> float:
    return shear_flow(law, sigma, 0.0, a, math.inf).stress_s


@kernel
def _shear_rate(law: Any, stress: float, eta: float) -> float:
    t = stress / law.tau0
    return law.tau0 / eta * t * rate_ratio(law, t * t)[0]


@kernel
def _stress_share(law: Any, stress: float) -> float:
    t = stress / law.tau0
    G, slope = rate_ratio(law, t * t)
    return G / (G + 2.0 * t * t * slope)


@kernel
def _layered_stress(law: Any, eta: np.ndarray, h: float, slope: float, sliding: float) -> float:
    # Newton's method on asinh(rate) within a bracket: no layer is sheared less than a Newtonian's
    m = eta.size
    dz, drop, total = 1.0 / (m - 1), slope * h / law.tau0, 0.0
    for k in range(m):
        total += (dz if 0 < k < m - 1 else 0.5 * dz) / eta[k]
    goal = sliding / (h * law.tau0 * total)
    high = abs(goal) + abs(drop)
    low, T = -high, math.asinh(goal)
    for _ in range(_STEPS):
        rate, rate_slope = 0.0, 0.0
        for k in range(m):
            share = (dz if 0 < k < m - 1 else 0.5 * dz) / (eta[k] * total)
            t = T + drop * (k * dz - 0.5)
            G, G_slope = rate_ratio(law, t * t)
            rate += share * t * G
            rate_slope += share * (G + 2.0 * t * t * G_slope)
        if rate < goal:
            low = T
        else:
            high = T
        step = (math.asinh(goal) - math.asinh(rate)) * math.sqrt(1.0 + rate * rate) / rate_slope
        T += step
        if not low <= T <= high:
            T = 0.5 * (low + high)
        elif abs(step) <= _THERE * max(1.0, abs(T)):
            break
    return law.tau0 * T


@by_class(_flow_factor)
def flow_factor(law: Any, sigma: float, a: float) -> tuple[float, float, float]:
    """Return the flow by pressure over its Newtonian value, and its derivatives.

    Parameters
    ----------
    law
        Shear law of the oil.
    sigma
        Stress drop over half the film, h (dp/dx)/(2 tau0) [-], either sign.
    a
        Newtonian shear stress over tau0, eta (u2 - u1)/(h tau0) [-], either sign.

    Returns
    -------
    tuple of float
        S [-], dS/dsigma, dS/da.
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@by_class(_mid_stress)
def mid_stress(law: Any, sigma: float, a: float) -> float:
    """Return the shear stress at mid-film over tau0 [-]; `sigma` and `a` as in `flow_factor`."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@by_class(_shear_rate)
def shear_rate(law: Any, stress: float, eta: float) -> float:
    """Return the shear rate du/dz [1/s] at a stress [Pa] and a viscosity [Pa s]."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@by_class(_stress_share)
def stress_share(law: Any, stress: float) -> float:
    """Return d ln(tau)/d ln(eta) at one shear rate [-]; stress [Pa], not negative."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@by_class(_layered_stress)
def layered_stress(law: Any, eta: np.ndarray, h: float, slope: float, sliding: float) -> float:
    """Return the shear stress at mid-film where viscosity varies across it.

    Parameters
    ----------
    law
        Shear law of the oil.
    eta : ndarray, shape (m,)
        Viscosity at even heights from body 1 to body 2 [Pa s].
    h, slope
        Film [m] and slope of pressure along sliding [Pa/m].
    sliding
        u2 - u1 [m/s].

    Returns
    -------
    float
        tau_m [Pa], so that the shear rates add up to the sliding by the trapezoidal rule.
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name
