"""Mass balance of a line contact at every node, with its local derivatives: kernels.

Everything is dimensionless as in `line_scaling`. A node's row is what flows out of its cell less
what flows in, plus what gathers there; zero where the film is full, not below zero where it broke.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import density_ratio, log_viscosity
from gearlube_core.oil.film_oil import FilmOil, stress_ratio
from gearlube_core.oil.sheared_film import flow_factor

# codes of the wedge term's stencil
CENTRAL, UPWIND_1, UPWIND_2, GALERKIN = 0, 1, 2, 3
STENCILS = {"central": CENTRAL, "upwind-1": UPWIND_1, "upwind-2": UPWIND_2, "galerkin": GALERKIN}
WIDTH = 5  # nodes i - 2 to i + 2 of a row


class RowCoefficients(NamedTuple):
    """Numbers of the balance; all dimensionless."""

    step: float  # node spacing
    speed: float  # mean surface speed over the reference speed, with its sign
    mobility: float  # 1/lambda: flow by pressure at H = 1 and ambient viscosity
    pressure: float  # Hertz pressure [Pa], to evaluate the oil
    sigma: float  # shear law: sigma = this * H dP/dX; 0 Newtonian
    shear: float  # shear law: a = this * (eta/eta0)/H
    weight: float  # of the flows at the new time: 1, or 1/2 with Crank and Nicolson
    storage: float  # of what gathers: 0 steady, beta/dT
    stencil: int
    blend: float  # pressure at which a full cell has half its own stencil; 0: all of it


class LocalRows(NamedTuple):
    """Work arrays of one grid of n nodes."""

    residual: np.ndarray  # (n,)
    by_pressure: np.ndarray  # (n, 5): nodes i - 2 to i + 2
    by_film: np.ndarray  # (n, 5)
    by_void: np.ndarray  # (n, 3): nodes i - 1 to i + 1
    flux: np.ndarray  # (n - 1,) between nodes
    eta: np.ndarray  # (n,) eta/eta0
    eta_slope: np.ndarray  # (n,) d ln eta/dP
    rho: np.ndarray  # (n,) rho/rho0
    rho_slope: np.ndarray  # (n,)
    rho_bend: np.ndarray  # (n,) second derivative
    unit: np.ndarray  # (n,) local Eyring stress over tau0
    unit_slope: np.ndarray  # (n,) of its logarithm


def local_rows(n: int) -> LocalRows:
    """Return work arrays for n nodes."""
    wide = (np.zeros((n, WIDTH)), np.zeros((n, WIDTH)), np.zeros((n, 3)))
    return LocalRows(np.zeros(n), *wide, np.zeros(n - 1), *(np.zeros(n) for _ in range(7)))


@kernel
def _fill_oil(
    P: np.ndarray,
    cooling: np.ndarray,
    dilation: np.ndarray,
    c: RowCoefficients,
    oil: FilmOil,
    rows: LocalRows,
) -> None:
    for i in range(P.size):
        p = P[i] * c.pressure
        log_eta, slope = log_viscosity(oil.viscosity, p, cooling[i])
        rows.eta[i] = math.exp(min(log_eta, 300.0))
        rows.eta_slope[i] = slope * c.pressure
        ratio, slope, bend = density_ratio(oil.density, p)
        rows.rho[i] = dilation[i] * ratio
        rows.rho_slope[i] = dilation[i] * slope * c.pressure
        rows.rho_bend[i] = dilation[i] * bend * c.pressure * c.pressure
        rows.unit[i], slope = stress_ratio(oil, p, cooling[i])
        rows.unit_slope[i] = slope * c.pressure


@kernel
def _wedge_weights(stencil: int, speed: float, face: int, faces: int) -> tuple[float, ...]:
    # of the nodes face - 1 to face + 2; central where an upwind node would lie outside
    if stencil == UPWIND_1:
        if speed >= 0.0:
            return 0.0, 1.0, 0.0, 0.0
        return 0.0, 0.0, 1.0, 0.0
    if stencil == UPWIND_2:
        if speed >= 0.0 and face > 0:
            return -0.5, 1.5, 0.0, 0.0
        if speed < 0.0 and face < faces - 1:
            return 0.0, 0.0, 1.5, -0.5
    return 0.0, 0.5, 0.5, 0.0


@kernel
def _add_poiseuille(
    f: int, P: np.ndarray, H: np.ndarray, c: RowCoefficients, shear_law: Any, rows: LocalRows
) -> None:
    # flow by pressure between nodes f and f + 1, mean as in [jamali_2015 (3.9)]: viscosity
    # and flow factor together, which cancel where the oil is thick; apart a coarse grid thins films
    g = f + 1
    by_step = c.mobility * c.weight / c.step
    left = rows.rho[f] * H[f] ** 3 / rows.eta[f]
    right = rows.rho[g] * H[g] ** 3 / rows.eta[g]
    drop = P[g] - P[f]
    film, sigma, sigma_f, sigma_g, react_f, react_g = 1.0, 0.0, 0.0, 0.0, 0.0, 0.0
    unit_f, unit_g = rows.unit[f], rows.unit[g]
    if c.sigma > 0.0:
        film = 0.5 * (H[f] + H[g])
        sigma = c.sigma * film * drop / c.step
        a = c.shear * rows.eta[f] / H[f] / unit_f
        factor, slope, by_a = flow_factor(shear_law, sigma / unit_f, a)
        left *= factor
        sigma_f, react_f = slope / factor / unit_f, a * by_a / factor
        a = c.shear * rows.eta[g] / H[g] / unit_g
        factor, slope, by_a = flow_factor(shear_law, sigma / unit_g, a)
        right *= factor
        sigma_g, react_g = slope / factor / unit_g, a * by_a / factor
    mean = 0.5 * (left + right)
    flow = -by_step * mean * drop
    half = -0.5 * by_step * drop
    by_sigma = half * (left * sigma_f + right * sigma_g)
    slope_sigma = by_sigma * c.sigma * film / c.step
    p_f = by_step * mean - slope_sigma
    p_g = -by_step * mean + slope_sigma
    p_f += half * left * (rows.rho_slope[f] / rows.rho[f] - (1.0 - react_f) * rows.eta_slope[f])
    p_g += half * right * (rows.rho_slope[g] / rows.rho[g] - (1.0 - react_g) * rows.eta_slope[g])
    p_f -= half * left * rows.unit_slope[f] * (sigma * sigma_f + react_f)
    p_g -= half * right * rows.unit_slope[g] * (sigma * sigma_g + react_g)
    both = 0.5 * by_sigma * sigma / film
    h_f = half * left * (3.0 - react_f) / H[f] + both
    h_g = half * right * (3.0 - react_g) / H[g] + both
    rows.flux[f] += flow
    rows.by_pressure[f, 2] += p_f
    rows.by_pressure[f, 3] += p_g
    rows.by_pressure[g, 1] -= p_f
    rows.by_pressure[g, 2] -= p_g
    rows.by_film[f, 2] += h_f
    rows.by_film[f, 3] += h_g
    rows.by_film[g, 1] -= h_f
    rows.by_film[g, 2] -= h_g


@kernel
def _add_wedge(
    f: int, P: np.ndarray, H: np.ndarray, void: np.ndarray, c: RowCoefficients, rows: LocalRows
) -> None:
    # carried mass. What leaves a broken cell is that cell's own, so that no void falls below
    # zero, and a full cell passes to its own stencil as its pressure rises: no jump at rupture
    n = H.size
    speed = c.speed * c.weight
    m = f if speed >= 0.0 else f + 1
    weights = _wedge_weights(c.stencil, c.speed, f, n - 1)
    lowest, share, share_slope = m, 1.0, 0.0
    if c.blend > 0.0:
        for k in range(4):
            i = f - 1 + k
            if weights[k] != 0.0 and 0 <= i < n and P[i] < P[lowest]:
                lowest = i
        share = P[lowest] / (P[lowest] + c.blend)
        share_slope = c.blend / (P[lowest] + c.blend) ** 2
    turn = 0.0
    for k in range(4):
        i = f - 1 + k
        if i < 0 or i >= n:
            continue
        own = 1.0 if i == m else 0.0
        turn += (weights[k] - own) * rows.rho[i] * H[i]
        w = speed * (own * (1.0 - void[i]) + share * (weights[k] - own))
        rows.flux[f] += w * rows.rho[i] * H[i]
        rows.by_pressure[f, k + 1] += w * rows.rho_slope[i] * H[i]
        rows.by_pressure[f + 1, k] -= w * rows.rho_slope[i] * H[i]
        rows.by_film[f, k + 1] += w * rows.rho[i]
        rows.by_film[f + 1, k] -= w * rows.rho[i]
    turn *= speed * share_slope
    rows.by_pressure[f, lowest - f + 2] += turn
    rows.by_pressure[f + 1, lowest - f + 1] -= turn
    whole = speed * rows.rho[m] * H[m]
    rows.by_void[f, m - f + 1] -= whole
    rows.by_void[f + 1, m - f] += whole


@kernel
def _add_galerkin(
    f: int, P: np.ndarray, H: np.ndarray, c: RowCoefficients, rows: LocalRows
) -> None:
    # element f of [jamali_2015 (3.14)]: rho h' + h rho_p p' against both hats, integrated exactly
    speed = c.speed * c.weight
    for side in range(2):
        i, o = f + side, f + 1 - side
        sign = -1.0 if side == 1 else 1.0  # (right - left) = sign (o - i)
        rise, drop = sign * (H[o] - H[i]), sign * (P[o] - P[i])
        ri, ro = rows.rho[i], rows.rho[o]
        si, so = rows.rho_slope[i], rows.rho_slope[o]
        bi, bo = rows.rho_bend[i], rows.rho_bend[o]
        mean = (2.0 * ri + ro) / 6.0
        moment = (3.0 * H[i] * si + H[i] * so + H[o] * si + H[o] * so) / 12.0
        rows.residual[i] += speed * (rise * mean + drop * moment)
        at_o = 3 if side == 0 else 1
        rows.by_pressure[i, 2] += speed * (
            rise * si / 3.0 - sign * moment + drop * bi * (3.0 * H[i] + H[o]) / 12.0
        )
        rows.by_pressure[i, at_o] += speed * (
            rise * so / 6.0 + sign * moment + drop * bo * (H[i] + H[o]) / 12.0
        )
        rows.by_film[i, 2] += speed * (-sign * mean + drop * (3.0 * si + so) / 12.0)
        rows.by_film[i, at_o] += speed * (sign * mean + drop * (si + so) / 12.0)


@kernel
def fill_rows(
    P: np.ndarray,
    H: np.ndarray,
    void: np.ndarray,
    cooling: np.ndarray,
    dilation: np.ndarray,
    source: np.ndarray,
    c: RowCoefficients,
    oil: FilmOil,
    rows: LocalRows,
) -> None:
    """Fill the balance of every node and its derivatives with its neighbours.

    r_i = w (Q_{i+1/2} - Q_{i-1/2}) + dX beta m_i + s_i,
    Q = V m - (S rho H^3/eta)/lambda dP/dX,  m = rho H (1 - void)

    Parameters
    ----------
    P, H
        Pressure and film, (n,) [-].
    void
        Share of the gap without oil, (n,) [-]; zero where the film is full.
    cooling, dilation
        Cooling factor and the density's factor by heat, (n,) [-]; ones for an isothermal film.
    source
        s: older times, manufactured sources, (n,) [-].
    c, oil
        Numbers of the balance and of the oil.
    rows
        Filled; entries of the two end nodes carry no meaning but `flux` is complete, less the
        wedge with the Galerkin stencil, which has no flux between nodes.

    Notes
    -----
    Written for mass carried, not split by the product rule.
    Source: [jamali_2015 (3.1)] [jamali_2015 (3.1a)] [jamali_2015 (3.8)] [jamali_2015 (3.9)]
    [jamali_2015 (3.10)] [jamali_2015 (3.11)] [jamali_2015 (3.12)] [jamali_2015 (3.23)]
    """
    n = P.size
    rows.by_pressure[:] = 0.0
    rows.by_film[:] = 0.0
    rows.by_void[:] = 0.0
    rows.flux[:] = 0.0
    _fill_oil(P, cooling, dilation, c, oil, rows)
    for i in range(n):
        full = rows.rho[i] * (1.0 - void[i])
        gather = c.step * c.storage
        rows.residual[i] = source[i] + gather * full * H[i]
        rows.by_film[i, 2] += gather * full
        rows.by_pressure[i, 2] += gather * rows.rho_slope[i] * H[i] * (1.0 - void[i])
        rows.by_void[i, 1] -= gather * rows.rho[i] * H[i]
    for f in range(n - 1):
        _add_poiseuille(f, P, H, c, oil.shear, rows)
        if c.stencil == GALERKIN:
            _add_galerkin(f, P, H, c, rows)
        else:
            _add_wedge(f, P, H, void, c, rows)
    for f in range(n - 1):
        rows.residual[f] += rows.flux[f]
        rows.residual[f + 1] -= rows.flux[f]


@kernel
def fill_jacobian(
    rows: LocalRows, influence: np.ndarray, nodes: np.ndarray, voids: np.ndarray, J: np.ndarray
) -> None:
    """Fill the bordered Jacobian of the rows of `nodes`, and the size of each row.

    Parameters
    ----------
    rows
        From `fill_rows`.
    influence
        dH_i/dP_j as a function of abs(i - j), (n,) [-].
    nodes
        Interior nodes whose balance is solved, ascending, (m,).
    voids
        True where the unknown of a node is its void share and not its pressure, (m,).
    J
        Column-major (m + 1, m + 1): filled, last column by the approach H0, last row the load,
        both less their scaling.
    """
    m = nodes.size
    n = rows.residual.size
    for b in range(m):
        j = nodes[b]
        if voids[b]:
            for a in range(m):
                d = j - nodes[a] + 1
                J[a, b] = rows.by_void[nodes[a], d] if 0 <= d <= 2 else 0.0
            continue
        for a in range(m):
            i = nodes[a]
            value = 0.0
            for k in range(WIDTH):
                w = rows.by_film[i, k]
                if w != 0.0:
                    value += w * influence[abs(i - 2 + k - j)]
            d = j - i + 2
            if 0 <= d < WIDTH:
                value += rows.by_pressure[i, d]
            J[a, b] = value
    for a in range(m):
        total = 0.0
        for k in range(WIDTH):
            if 0 <= nodes[a] - 2 + k < n:
                total += rows.by_film[nodes[a], k]
        J[a, m] = total
