"""Energy of a line film and the two moving surfaces, marched along entrainment: kernels.

Reduced form: heat is carried along x and conducted across the film; oil that flows back in the
inlet carries none; both bodies are half-spaces that move fast against diffusion.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import cooling_at, cooling_factor
from gearlube_core.oil.film_oil import (
    FilmOil,
    heat_under,
    limiting_stress,
    stress_ratio,
    thermal_viscosity,
)
from gearlube_core.oil.sheared_film import layered_stress, shear_rate


class FilmFields(NamedTuple):
    """Film data for the energy balance on n nodes, in the direction of entrainment."""

    p: np.ndarray  # [Pa]
    p_slope: np.ndarray  # [Pa/m]
    h: np.ndarray  # [m]
    rho: np.ndarray  # [kg/m3]
    mean_speed: np.ndarray  # flow over rho h [m/s]
    wet: np.ndarray  # 1 where the film is full, 0 where it is broken


class SurfaceHeating(NamedTuple):
    """Constants of the surfaces' rise of temperature; floats, SI."""

    speed_1: float  # [m/s], above zero
    speed_2: float  # [m/s], above zero
    factor_1: float  # (pi rho c k u)^(-1/2) of body 1 [K m^1.5/W]
    factor_2: float  # of body 2
    temperature: float  # of oil and bodies at the inlet [K]


@kernel
def fill_surface_weights(step: float, now: np.ndarray, before: np.ndarray) -> None:
    """Fill weights of the integral of q(s) (x - s)^(-1/2) ds, q linear between nodes.

    Parameters
    ----------
    step
        Node spacing [m].
    now, before
        (n,): weights [m^0.5] of the downstream and the upstream end of the interval that ends m
        nodes upstream of x.
    """
    for m in range(now.size):
        a, b = (m + 1.0) * step, m * step
        root = math.sqrt(a) - math.sqrt(b)
        now[m] = (2.0 * a * root - 2.0 / 3.0 * (a * math.sqrt(a) - b * math.sqrt(b))) / step
        before[m] = 2.0 * root - now[m]


@kernel
def mean_temperature(T: np.ndarray, i: int) -> float:
    """Return the mean across the film at node i of temperatures (n, m) at even heights [K]."""
    m = T.shape[1]
    mean = 0.0
    for k in range(m):
        mean += T[i, k] * (1.0 if 0 < k < m - 1 else 0.5) / (m - 1)
    return mean


@kernel
def fill_shear(
    T: np.ndarray, i: int, f: FilmFields, sliding: float, oil: FilmOil, heat: np.ndarray
) -> tuple[float, float]:
    """Fill the heat of shear across the film at node i.

    tau(z) = tau_m + z dp/dx,  integral of du/dz over the film = u2 - u1

    Parameters
    ----------
    T
        Temperatures (n, m) at m heights from body 1 to body 2 [K].
    i
        Number of the node.
    f
        Film state along the line.
    sliding
        u2 - u1 [m/s].
    oil
        Constants of the oil's laws.
    heat
        Filled, (m,) [W/m3].

    Returns
    -------
    tuple of float
        tau_m [Pa] and the viscosity [Pa s] that lets pressure drive the same flow.

    Notes
    -----
    With a limiting stress the film slips at it and the rest of the sliding heats evenly. A local
    Eyring stress is that at the mean temperature across the film.
    """
    m = heat.size
    h, slope = f.h[i], f.p_slope[i]
    dz = 1.0 / (m - 1)
    pumped = 0.0
    cooling = cooling_factor(oil.viscosity, mean_temperature(T, i), oil.temperature)
    unit = stress_ratio(oil, f.p[i], cooling)[0]
    for k in range(m):
        w = dz if 0 < k < m - 1 else 0.5 * dz
        z = k * dz - 0.5
        heat[k] = thermal_viscosity(oil, f.p[i], T[i, k])
        pumped += 12.0 * z * z * (w / heat[k])
    # the trapezoidal rule for 12 z^2 alone gives 1 + 2 dz^2
    pumped /= 1.0 + 2.0 * dz * dz
    tau = unit * layered_stress(oil.shear, heat, h, slope / unit, sliding / unit)
    limit = limiting_stress(oil, f.p[i])
    slips = abs(tau) > limit
    if slips:
        tau = math.copysign(limit, tau)
    total = 0.0
    for k in range(m):
        w = dz if 0 < k < m - 1 else 0.5 * dz
        z = k * dz - 0.5
        stress = tau + slope * h * z
        rate = unit * shear_rate(oil.shear, stress / unit, heat[k])
        heat[k] = f.wet[i] * stress * rate
        total += w * rate
    if slips:
        for k in range(m):
            heat[k] += f.wet[i] * tau * (sliding / h - total)
    return tau, 1.0 / pumped


@kernel
def march_energy(
    f: FilmFields,
    step: float,
    s: SurfaceHeating,
    oil: FilmOil,
    now: np.ndarray,
    before: np.ndarray,
    old: np.ndarray,
    T: np.ndarray,
    flux: np.ndarray,
    tau: np.ndarray,
    eta: np.ndarray,
    heating: np.ndarray,
) -> None:
    """March the temperature along entrainment, with heat of shear at the temperatures `old`.

    rho c u dT/dx = k d2T/dz2 + tau du/dz + beta T u dp/dx
    T_s = T0 + (pi rho_s c_s k_s u_s)^(-1/2) integral of q(s) (x - s)^(-1/2) ds

    Parameters
    ----------
    f, step, s, oil
        Film, node spacing [m], surfaces, lubricant.
    now, before
        From `fill_surface_weights`, (n,).
    old
        Temperatures of the iteration before (n, m) [K].
    T
        Filled (n, m) [K].
    flux
        Filled (n, 2): heat into body 1 and body 2 [W/m2].
    tau, eta
        Filled (n,): mid-film stress [Pa], viscosity to pressure flow [Pa s].
    heating
        Filled (n,): heat of shear over the film [W/m2].

    Notes
    -----
    Finite volumes across the film, half cells at the walls, second-order backward along x.
    Source: [carslaw_jaeger_1959] for the surfaces; reduced form of [cheng_1965].
    """
    n, m = T.shape
    heat = np.empty(m)
    lower, diagonal, upper, right = np.empty(m), np.empty(m), np.empty(m), np.empty(m)
    for i in range(n):
        tau[i], eta[i] = fill_shear(old, i, f, s.speed_2 - s.speed_1, oil, heat)
        dz = f.h[i] / (m - 1)
        k_oil, capacity = heat_under(oil, f.p[i], f.rho[i])
        total = 0.0
        for k in range(m):
            total += heat[k] * (dz if 0 < k < m - 1 else 0.5 * dz)
        heating[i] = total
        if i == 0:
            T[0, :] = s.temperature
            flux[0, :] = 0.0
            continue
        couette = 0.5 * (s.speed_1 + s.speed_2)
        for k in range(m):
            zeta = k / (m - 1.0)
            u = s.speed_1 + (s.speed_2 - s.speed_1) * zeta
            u += (f.mean_speed[i] - couette) * 6.0 * zeta * (1.0 - zeta)
            thickness = dz if 0 < k < m - 1 else 0.5 * dz
            carried = capacity * max(u, 0.0) * thickness / step
            source = heat[k] * thickness
            source += oil.expansion * old[i, k] * u * f.p_slope[i] * f.wet[i] * thickness
            if i == 1:
                diagonal[k] = carried
                right[k] = carried * T[0, k] + source
            else:
                diagonal[k] = 1.5 * carried
                right[k] = carried * (2.0 * T[i - 1, k] - 0.5 * T[i - 2, k]) + source
            lower[k] = -k_oil / dz if k > 0 else 0.0
            upper[k] = -k_oil / dz if k < m - 1 else 0.0
            diagonal[k] -= lower[k] + upper[k]
        # a wall cell gives q to its body: T_s = history + factor now[0] q
        walls = (right[0], diagonal[0], right[m - 1], diagonal[m - 1])
        past_1, past_2 = 0.0, 0.0
        for j in range(i):
            d = i - 1 - j
            past_1 += before[d] * flux[j, 0]
            past_2 += before[d] * flux[j, 1]
            if j + 1 < i:
                past_1 += now[d] * flux[j + 1, 0]
                past_2 += now[d] * flux[j + 1, 1]
        give_1, give_2 = s.factor_1 * now[0], s.factor_2 * now[0]
        start_1 = s.temperature + s.factor_1 * past_1
        start_2 = s.temperature + s.factor_2 * past_2
        diagonal[0] = 1.0 + give_1 * walls[1]
        upper[0] *= give_1
        right[0] = start_1 + give_1 * walls[0]
        diagonal[m - 1] = 1.0 + give_2 * walls[3]
        lower[m - 1] *= give_2
        right[m - 1] = start_2 + give_2 * walls[2]
        for k in range(1, m):
            w = lower[k] / diagonal[k - 1]
            diagonal[k] -= w * upper[k - 1]
            right[k] -= w * right[k - 1]
        T[i, m - 1] = right[m - 1] / diagonal[m - 1]
        for back in range(m - 1):
            k = m - 2 - back
            T[i, k] = (right[k] - upper[k] * T[i, k + 1]) / diagonal[k]
        flux[i, 0] = walls[0] - walls[1] * T[i, 0] + k_oil / dz * T[i, 1]
        flux[i, 1] = walls[2] - walls[3] * T[i, m - 1] + k_oil / dz * T[i, m - 2]


@kernel
def fill_thermal_oil(
    p: np.ndarray,
    T: np.ndarray,
    eta: np.ndarray,
    oil: FilmOil,
    cooling: np.ndarray,
    dilation: np.ndarray,
) -> None:
    """Fill the cooling factor that gives the viscosity `eta` and the density's factor by heat.

    Parameters
    ----------
    p, T, eta
        Pressure (n,) [Pa], temperatures (n, m) [K], viscosity to pressure flow (n,) [Pa s].
    oil
        Constants of the oil's laws.
    cooling, dilation
        Filled (n,) [-].
    """
    for i in range(p.size):
        cooling[i] = cooling_at(oil.viscosity, p[i], math.log(eta[i] / oil.eta0))
        mean = mean_temperature(T, i)
        dilation[i] = max(1.0 - oil.expansion * (mean - oil.temperature), 0.1)
