"""Energy of a point contact's film, carried in any direction at every height: kernels.

Finite volumes across the film, half cells at the surfaces, of temperatures (n, m): n nodes of a
grid (ny, nx) in rows, m heights from body 1 to body 2. Heat is carried along the film by the oil
at its height and conducted across it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.ehl.line.energy import FilmFields, fill_shear, mean_temperature
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import cooling_factor
from gearlube_core.oil.film_oil import (
    FilmOil,
    heat_under,
    limiting_stress,
    stress_ratio,
    thermal_viscosity,
    viscosity_cooling,
)
from gearlube_core.oil.sheared_film import stress_share


class PointFilm(NamedTuple):
    """Film data for the energy balance, on n nodes in rows of nx."""

    along: FilmFields  # slope of pressure along sliding; no mean speed
    across: np.ndarray  # slope of pressure across sliding [Pa/m]
    slope_x: np.ndarray  # [Pa/m]
    slope_y: np.ndarray
    pumped_x: np.ndarray  # mean speed of the flow by pressure [m/s]
    pumped_y: np.ndarray


class PointMotion(NamedTuple):
    """Velocities of the surfaces, spacing and the oil's temperature at the inlet; floats, SI."""

    u_1: float
    v_1: float
    u_2: float
    v_2: float
    dx: float
    dy: float
    temperature: float


class PointHeat(NamedTuple):
    """Heat of shear and what goes with it; arrays of n nodes."""

    source: np.ndarray  # (n, m) [W/m3]
    decline: np.ndarray  # (n,) share of it that a warmer film loses [1/K]
    stress: np.ndarray  # (n,) at mid-film, along sliding [Pa]
    viscosity: np.ndarray  # (n,) to flow by pressure [Pa s]


@kernel
def _flow_viscosity(oil: FilmOil, p: float, T: np.ndarray) -> float:
    # that of `fill_shear` without shear: a node that breaks keeps its viscosity
    m = T.size
    dz, pumped = 1.0 / (m - 1), 0.0
    for k in range(m):
        w = dz if 0 < k < m - 1 else 0.5 * dz
        z = k * dz - 0.5
        pumped += 12.0 * z * z * w / thermal_viscosity(oil, p, T[k])
    return (1.0 + 2.0 * dz * dz) / pumped


@kernel
def fill_heat(
    film: PointFilm, T: np.ndarray, sliding: float, everywhere: bool, oil: FilmOil,
    heat: PointHeat
) -> None:  # fmt: skip
    """Fill the heat of shear at temperatures (n, m) [K].

    Parameters
    ----------
    film, T
        Film thickness and temperatures.
    sliding
        Amount of the sliding velocity [m/s].
    everywhere
        Stress also where the film is broken, for the friction; else zero.
    oil
        Constants of the oil's laws.
    heat
        Heat of shear and compression, filled.

    Notes
    -----
    Shear along sliding is that of a line's film; across it, flow by pressure adds
    (z dp/dr)^2/eta. A warmer film makes less heat by d ln(tau)/dT, d ln(eta)/dT times
    `stress_share`, which is tanh(tau/tau0)/(tau/tau0) in an Eyring film; nothing where it slips
    at the limiting stress.
    """
    f = film.along
    n, m = T.shape
    middle = m // 2
    for i in range(n):
        heat.decline[i] = 0.0
        if f.wet[i] == 0.0 and not everywhere:
            heat.source[i, :] = 0.0
            heat.stress[i] = 0.0
            heat.viscosity[i] = _flow_viscosity(oil, f.p[i], T[i])
            continue
        tau, eta = fill_shear(T, i, f, sliding, oil, heat.source[i])
        heat.stress[i], heat.viscosity[i] = tau, eta
        drop = film.across[i] * f.h[i]
        if f.wet[i] > 0.0 and drop != 0.0:
            for k in range(m):
                z = k / (m - 1.0) - 0.5
                heat.source[i, k] += (drop * z) ** 2 / eta
        size = abs(tau)
        if size < limiting_stress(oil, f.p[i]):
            cooling = cooling_factor(oil.viscosity, mean_temperature(T, i), oil.temperature)
            size /= stress_ratio(oil, f.p[i], cooling)[0]
            share = stress_share(oil.shear, size) if oil.shear.tau0 > 0.0 else 1.0
            heat.decline[i] = share * viscosity_cooling(oil, f.p[i], T[i, middle])


@kernel
def _carried(
    film: PointFilm,
    motion: PointMotion,
    oil: FilmOil,
    T: np.ndarray,
    nx: int,
    node: int,
    diagonal: np.ndarray,
    right: np.ndarray,
) -> None:
    # what the oil carries out of the cells of a node per kelvin, and into them with what
    # compression adds; of second order upstream, of first beside the border
    f = film.along
    n, m = T.shape
    j, i = node // nx, node % nx
    ny = n // nx
    dz = f.h[node] / (m - 1)
    capacity = heat_under(oil, f.p[node], f.rho[node])[1]
    for k in range(m):
        zeta = k / (m - 1.0)
        bulge = 6.0 * zeta * (1.0 - zeta)
        u = motion.u_1 + (motion.u_2 - motion.u_1) * zeta + film.pumped_x[node] * bulge
        v = motion.v_1 + (motion.v_2 - motion.v_1) * zeta + film.pumped_y[node] * bulge
        thickness = dz if 0 < k < m - 1 else 0.5 * dz
        squeezed = u * film.slope_x[node] + v * film.slope_y[node]
        right[k] = f.wet[node] * oil.expansion * T[node, k] * squeezed * thickness
        diagonal[k] = 0.0
        for axis in range(2):
            speed, place, count, stride, step = u, i, nx, 1, motion.dx
            if axis == 1:
                speed, place, count, stride, step = v, j, ny, nx, motion.dy
            if speed == 0.0:
                continue
            flow = capacity * abs(speed) * thickness / step
            back = -stride if speed > 0.0 else stride
            room = place if speed > 0.0 else count - 1 - place
            if room == 0:
                diagonal[k] += flow
                right[k] += flow * motion.temperature
            elif room == 1 or speed < 0.0:
                diagonal[k] += flow
                right[k] += flow * T[node + back, k]
            else:
                diagonal[k] += 1.5 * flow
                right[k] += flow * (2.0 * T[node + back, k] - 0.5 * T[node + 2 * back, k])


@kernel
def heat_balance(
    film: PointFilm,
    motion: PointMotion,
    oil: FilmOil,
    heat: PointHeat,
    T: np.ndarray,
    nx: int,
    flux: np.ndarray,
) -> tuple[float, float]:
    """Fill the fluxes into the bodies; return what inner cells lack and the heat made [W/m2].

    Parameters
    ----------
    film, motion, oil, heat
        With the heat at these temperatures.
    T
        Temperatures (n, m) [K].
    nx
        Nodes of a row.
    flux
        Filled (2, n): heat into body 1 and body 2 that balances the half cells there [W/m2].

    Returns
    -------
    tuple of float
        Sums over the nodes: amounts of heat made less conducted less carried of every inner
        cell, and the heat of shear.
    """
    n, m = T.shape
    diagonal, right = np.empty(m), np.empty(m)
    lacking, made = 0.0, 0.0
    for node in range(n):
        _carried(film, motion, oil, T, nx, node, diagonal, right)
        dz = film.along.h[node] / (m - 1)
        across = heat_under(oil, film.along.p[node], 0.0)[0] / dz
        for k in range(m):
            shear = heat.source[node, k] * (dz if 0 < k < m - 1 else 0.5 * dz)
            made += shear
            rest = right[k] + shear - diagonal[k] * T[node, k]
            if k > 0:
                rest += across * (T[node, k - 1] - T[node, k])
            if k < m - 1:
                rest += across * (T[node, k + 1] - T[node, k])
            if k == 0:
                flux[0, node] = rest
            elif k == m - 1:
                flux[1, node] = rest
            else:
                lacking += abs(rest)
    return lacking, made


@kernel
def sweep_film(
    film: PointFilm,
    motion: PointMotion,
    oil: FilmOil,
    heat: PointHeat,
    nx: int,
    upwards: bool,
    forwards: bool,
    T: np.ndarray,
    flux: np.ndarray,
    conductance: np.ndarray,
    shape: np.ndarray,
) -> None:
    """Solve every column between its surfaces in turn, from row to row.

    Parameters
    ----------
    film, motion, oil, heat, nx
        As in `heat_balance`; heat at the temperatures that come in.
    upwards, forwards
        Rows from the first to the last, nodes of a row likewise; or the other way round.
    T
        Temperatures (n, m) [K]; those inside change.
    flux
        Filled (2, n): heat into body 1 and body 2 [W/m2].
    conductance
        Filled (3, n) [W/(m2 K)], all above zero: by how much the flux into body 1 falls per kelvin
        of its own surface, either flux rises per kelvin of the other surface, and the flux into
        body 2 falls per kelvin of its own.
    shape
        Filled (2, n, m): temperature by that of body 1 and of body 2 [-].

    Notes
    -----
    The heat of shear falls with the column's temperature as `decline` says, which changes the
    way to the solution and not the solution.
    """
    n, m = T.shape
    ny = n // nx
    diagonal, right = np.empty(m), np.empty(m)
    lower, by_1, by_2 = np.empty(m), np.empty(m), np.empty(m)
    for row in range(ny):
        j = row if upwards else ny - 1 - row
        for column in range(nx):
            i = column if forwards else nx - 1 - column
            node = j * nx + i
            _carried(film, motion, oil, T, nx, node, diagonal, right)
            dz = film.along.h[node] / (m - 1)
            across = heat_under(oil, film.along.p[node], 0.0)[0] / dz
            for k in range(m):
                shear = heat.source[node, k] * (dz if 0 < k < m - 1 else 0.5 * dz)
                falls = heat.decline[node] * shear
                diagonal[k] += falls
                right[k] += shear + falls * T[node, k]
            walls = (diagonal[0], right[0], diagonal[m - 1], right[m - 1])
            by_1[:] = 0.0
            by_2[:] = 0.0
            by_1[1] = across
            by_2[m - 2] = across
            right[1] += across * T[node, 0]
            right[m - 2] += across * T[node, m - 1]
            for k in range(1, m - 1):
                diagonal[k] += 2.0 * across
                if k > 1:
                    w = across / lower[k - 1]
                    diagonal[k] -= w * across
                    right[k] += w * right[k - 1]
                    by_1[k] += w * by_1[k - 1]
                    by_2[k] += w * by_2[k - 1]
                lower[k] = diagonal[k]
            shape[0, node, 0], shape[1, node, 0] = 1.0, 0.0
            shape[0, node, m - 1], shape[1, node, m - 1] = 0.0, 1.0
            up, up_1, up_2 = 0.0, 0.0, 0.0
            for back in range(m - 2):
                k = m - 2 - back
                up = (right[k] + across * up) / diagonal[k]
                up_1 = (by_1[k] + across * up_1) / diagonal[k]
                up_2 = (by_2[k] + across * up_2) / diagonal[k]
                T[node, k], shape[0, node, k], shape[1, node, k] = up, up_1, up_2
            flux[0, node] = walls[1] - (walls[0] + across) * T[node, 0] + across * T[node, 1]
            flux[1, node] = (
                walls[3] - (walls[2] + across) * T[node, m - 1] + across * T[node, m - 2]
            )
            conductance[0, node] = walls[0] + across * (1.0 - shape[0, node, 1])
            conductance[1, node] = across * shape[1, node, 1]
            conductance[2, node] = walls[2] + across * (1.0 - shape[1, node, m - 2])


@kernel
def add_surface_change(change: np.ndarray, shape: np.ndarray, T: np.ndarray) -> None:
    """Change the surfaces' temperatures by (2, n) [K] and those between by their `shape`."""
    n, m = T.shape
    for node in range(n):
        for k in range(m):
            T[node, k] += change[0, node] * shape[0, node, k] + change[1, node] * shape[1, node, k]
