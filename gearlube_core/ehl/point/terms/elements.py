"""Reynolds equation on one grid in finite elements.

Reynolds equation of a point contact by bilinear finite elements: residual and derivatives.

The same arrays, scales and signs as the finite differences of `point_stencil`, on the same nodes.
"""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.stencil import (
    CarriedMass,
    FlowTensor,
    StencilParameters,
    TensorSlopes,
)
from gearlube_core.ehl.point.terms.differences import NoStorage, Storage
from gearlube_core.ehl.point.terms.linearisation import Derivatives
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.kernels.jit import kernel

# a node and its eight neighbours: row by row from south-west to north-east
ELEMENT_NEIGHBOURS = 9
ELEMENT_CENTRE = 4
# and those whose pressure decides how a film shears at these
SHEARED_ELEMENT_NEIGHBOURS = 21
_FAR = [(down, right) for down in (-2, 2) for right in (-1, 0, 1)]
# steps to them along y and along x
ELEMENT_OFFSETS = np.array(
    [[n // 3 - 1, n % 3 - 1] for n in range(ELEMENT_NEIGHBOURS)]
    + [[down, right] for down, right in _FAR]
    + [[right, down] for down, right in _FAR]
)
# number of a neighbour by its steps, two more than they are
_NUMBER = np.full((5, 5), -1)
_NUMBER[ELEMENT_OFFSETS[:, 0] + 2, ELEMENT_OFFSETS[:, 1] + 2] = np.arange(
    SHEARED_ELEMENT_NEIGHBOURS
)

# values and slopes of the four shape functions at the four Gauss points of the unit square;
# node k lies k // 2 above and k % 2 to the right of the element's first one
_POINTS = 0.5 + np.array([-0.5, 0.5]) / math.sqrt(3.0)
_SIDE = np.array([1.0 - _POINTS, _POINTS])  # (node, point) along one side
_N = np.einsum("jb,ia->abji", _SIDE, _SIDE).reshape(4, 4)
_NX = np.einsum("jb,i,a->abji", _SIDE, [-1.0, 1.0], [1.0, 1.0]).reshape(4, 4)
_NY = np.einsum("j,ia,b->abji", [-1.0, 1.0], _SIDE, [1.0, 1.0]).reshape(4, 4)
_WEIGHT = 0.25


@kernel
def upwind_shares(
    parameters: StencilParameters, compliance: float, flow_x: float, flow_y: float, density: float
) -> tuple[float, float]:
    """Return the shares of upwinding along x and y in an element, 0 to 1.

    coth(Pe) - 1/Pe,  Pe = u rho K/(2 dx) / (Lambda s/dx^2)

    Parameters
    ----------
    parameters
        Equation parameters of the grid.
    compliance
        K: film per pressure that alternates from node to node [-]; zero for no upwinding beside
        that of the weights.
    flow_x, flow_y
        Lambda s/dx^2 and the like along y [-].
    density
        rho [-].

    Notes
    -----
    Where pressure changes the flow more by the film it opens than by its slope, Pe is large and
    Galerkin's method leaves pressure that alternates from node to node. There rho h hardly
    changes along the flow, so upwinding costs no accuracy; elsewhere, with Pe of the order of
    dx^2, it is of third order.
    """
    least = 0.5 * (parameters.here - parameters.downstream)
    if compliance == 0.0:
        return least, least
    share_x = share_y = 0.0
    if parameters.wedge_x > 0.0:
        Pe = 0.5 * parameters.wedge_x * density * compliance / max(flow_x, 1e-300)
        share_x = Pe / 3.0 if Pe < 1e-3 else 1.0 / math.tanh(min(Pe, 100.0)) - 1.0 / Pe
    if parameters.wedge_y > 0.0:
        Pe = 0.5 * parameters.wedge_y * density * compliance / max(flow_y, 1e-300)
        share_y = Pe / 3.0 if Pe < 1e-3 else 1.0 / math.tanh(min(Pe, 100.0)) - 1.0 / Pe
    return max(least, 0.5 * share_x), max(least, 0.5 * share_y)


@kernel
def _centre_shares(
    parameters: StencilParameters,
    compliance: float,
    flow: FlowTensor,
    density: np.ndarray,
    j: int,
    i: int,
) -> tuple[float, float]:
    # with the means over the nodes of the element that begins at (j, i)
    sx = sy = rho = 0.0
    for k in range(4):
        jj, ii = j + k // 2, i + k % 2
        sx += 0.25 * flow.cubic_x[jj, ii] * flow.fluidity[jj, ii]
        sy += 0.25 * flow.cubic_y[jj, ii] * flow.fluidity[jj, ii]
        rho += 0.25 * density[jj, ii]
    flow_x, flow_y = parameters.poiseuille_x * sx, parameters.poiseuille_y * sy
    return upwind_shares(parameters, compliance, flow_x, flow_y, rho)


@kernel
def element_residual(
    parameters: StencilParameters,
    pressure: np.ndarray,
    mass: np.ndarray,
    flow: FlowTensor,
    source: np.ndarray,
    compliance: float,
    density: np.ndarray,
    residual: np.ndarray,
) -> None:
    """Write the residual of all inner nodes, per cell as finite differences have it.

    R_i = -int grad N_i . [Lambda s grad p - u (rho h) + b G] - int N_i S
    S = squeeze rho h - source,  G_x = u d(rho h)/dx + S,  G_y = v d(rho h)/dy

    Parameters
    ----------
    parameters
        Of the grid. `here - downstream` is the share of first-order upwinding, 0 for the central
        weights that Galerkin's method stands for and 1 for the first-order ones; of the weights
        nothing else counts.
    pressure, mass : ndarray, shape (ny, nx)
        p and rho h [-].
    flow
        What pressure drives oil with.
    source : ndarray, shape (ny, nx)
        What nodes held before, less what they store beside the squeeze term [-].
    compliance, density
        For `upwind_shares`: K, and rho [-], shape (ny, nx).
    residual : ndarray, shape (ny, nx)
        Result; zero on the border [-].

    Notes
    -----
    Flow factors s = rho h^3/eta and rho h are linear along the sides of an element, integrals by
    2 x 2 Gauss points are exact. The wedge is in the form that conserves mass: its product rule
    as printed would not. Shape functions sum to one, so the sum of the residuals of any set of
    nodes is the flow over its border. Source: [jamali_2015 (3.13)] [jamali_2015 (3.14)]

    Upwinding with the shares b acts on what is carried and stored together: where surfaces merely
    carry a film along it is zero, so that waves in motion are not damped. [brooks_hughes_1982]
    """
    ny, nx = pressure.shape
    residual[:] = 0.0
    cubic_x, cubic_xy, cubic_y, fluidity = flow
    px, py = parameters.poiseuille_x, parameters.poiseuille_y
    pxy = math.sqrt(px * py)
    ux, uy = parameters.wedge_x, parameters.wedge_y
    for j in range(ny - 1):
        for i in range(nx - 1):
            back_x, back_y = _centre_shares(parameters, compliance, flow, density, j, i)
            for g in range(4):
                slope_x = slope_y = sx = sxy = sy = m = m_x = m_y = gather = 0.0
                for k in range(4):
                    jj, ii = j + k // 2, i + k % 2
                    N, NX, NY, f = _N[g, k], _NX[g, k], _NY[g, k], fluidity[jj, ii]
                    slope_x += NX * pressure[jj, ii]
                    slope_y += NY * pressure[jj, ii]
                    sx += N * cubic_x[jj, ii] * f
                    sxy += N * cubic_xy[jj, ii] * f
                    sy += N * cubic_y[jj, ii] * f
                    m += N * mass[jj, ii]
                    m_x += NX * mass[jj, ii]
                    m_y += NY * mass[jj, ii]
                    gather += N * (parameters.squeeze * mass[jj, ii] - source[jj, ii])
                lag_x = back_x * (ux * m_x + gather)
                flow_x = px * sx * slope_x + pxy * sxy * slope_y - ux * m + lag_x
                flow_y = py * sy * slope_y + pxy * sxy * slope_x - uy * (m - back_y * m_y)
                for k in range(4):
                    residual[j + k // 2, i + k % 2] -= _WEIGHT * (
                        _NX[g, k] * flow_x + _NY[g, k] * flow_y + _N[g, k] * gather
                    )
    residual[0] = 0.0
    residual[ny - 1] = 0.0
    residual[:, 0] = 0.0
    residual[:, nx - 1] = 0.0


@kernel
def element_derivatives(
    parameters: StencilParameters,
    pressure: np.ndarray,
    flow: FlowTensor,
    carried: CarriedMass,
    slopes: TensorSlopes,
    compliance: float,
    rate: np.ndarray,
    free: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Write the derivatives of the residual with respect to pressure and film of all neighbours.

    Parameters
    ----------
    parameters, pressure, flow
        As in `element_residual`.
    carried
        Carried oil: density times film.
    slopes
        Of rho h^3/eta times the components of the flow factor tensor.
    compliance
        As in `element_residual`; the shares of upwinding are held.
    rate : ndarray, shape (ny, nx)
        At which nodes store oil beside the squeeze term, over their entrainment [-].
    free : ndarray of bool, shape (ny, nx)
        Nodes whose equation is solved; rows of the others become zero, as on the border.
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Result [-], n = 9, neighbour 3 (j' - j + 1) + i' - i + 1, or 21 where the flow factors
        depend on the rise of pressure across their node: that is taken then, too.
    """
    ny, nx = pressure.shape
    by_pressure[:] = 0.0
    by_film[:] = 0.0
    sheared = by_pressure.shape[0] > ELEMENT_NEIGHBOURS
    xx, xy, yy = slopes
    cubic_x, cubic_xy, cubic_y, fluidity = flow
    density, density_slope, film = carried
    px, py = parameters.poiseuille_x, parameters.poiseuille_y
    pxy = math.sqrt(px * py)
    ux, uy = parameters.wedge_x, parameters.wedge_y
    for j in range(ny - 1):
        for i in range(nx - 1):
            back_x, back_y = _centre_shares(parameters, compliance, flow, density, j, i)
            for g in range(4):
                slope_x = slope_y = sx = sxy = sy = 0.0
                for k in range(4):
                    jj, ii = j + k // 2, i + k % 2
                    slope_x += _NX[g, k] * pressure[jj, ii]
                    slope_y += _NY[g, k] * pressure[jj, ii]
                    share = _N[g, k] * fluidity[jj, ii]
                    sx += share * cubic_x[jj, ii]
                    sxy += share * cubic_xy[jj, ii]
                    sy += share * cubic_y[jj, ii]
                for n in range(4):
                    jj, ii = j + n // 2, i + n % 2
                    N, NX, NY, h = _N[g, n], _NX[g, n], _NY[g, n], film[jj, ii]
                    rho, rho_p, thin = density[jj, ii], density_slope[jj, ii], max(h, 1e-30)
                    # of the flow by xx, xy and yy of the node
                    by_xx, by_xy_x = N * px * slope_x, N * pxy * slope_y
                    by_yy, by_xy_y = N * py * slope_y, N * pxy * slope_x
                    gathered = N * (parameters.squeeze + rate[jj, ii])
                    carried_x = ux * N - back_x * (ux * NX + gathered)
                    carried_y = uy * (N - back_y * NY)
                    x_p = px * sx * NX + pxy * sxy * NY - carried_x * rho_p * h
                    x_p += by_xx * xx.by_pressure[jj, ii] + by_xy_x * xy.by_pressure[jj, ii]
                    y_p = py * sy * NY + pxy * sxy * NX - carried_y * rho_p * h
                    y_p += by_yy * yy.by_pressure[jj, ii] + by_xy_y * xy.by_pressure[jj, ii]
                    x_h = by_xx * xx.by_film[jj, ii] + by_xy_x * xy.by_film[jj, ii]
                    x_h = x_h / thin - carried_x * rho
                    y_h = by_yy * yy.by_film[jj, ii] + by_xy_y * xy.by_film[jj, ii]
                    y_h = y_h / thin - carried_y * rho
                    for k in range(4):
                        row, column = j + k // 2, i + k % 2
                        if not free[row, column]:
                            continue
                        a, b, c = _WEIGHT * _NX[g, k], _WEIGHT * _NY[g, k], _WEIGHT * _N[g, k]
                        down, right = n // 2 - k // 2, n % 2 - k % 2
                        neighbour = 3 * (down + 1) + right + 1
                        by_pressure[neighbour, row, column] -= (
                            a * x_p + b * y_p + c * gathered * rho_p * h
                        )
                        by_film[neighbour, row, column] -= a * x_h + b * y_h + c * gathered * rho
                        if not sheared:
                            continue
                        by_xy = a * by_xy_x + b * by_xy_y
                        rise_x = a * by_xx * xx.by_rise_x[jj, ii] + by_xy * xy.by_rise_x[jj, ii]
                        rise_x += b * by_yy * yy.by_rise_x[jj, ii]
                        rise_y = a * by_xx * xx.by_rise_y[jj, ii] + by_xy * xy.by_rise_y[jj, ii]
                        rise_y += b * by_yy * yy.by_rise_y[jj, ii]
                        by_pressure[_NUMBER[down + 2, right + 3], row, column] -= rise_x
                        by_pressure[_NUMBER[down + 2, right + 1], row, column] += rise_x
                        by_pressure[_NUMBER[down + 3, right + 2], row, column] -= rise_y
                        by_pressure[_NUMBER[down + 1, right + 2], row, column] += rise_y
    for neighbour in range(by_pressure.shape[0]):
        for values in (by_pressure, by_film):
            values[neighbour, 0] = 0.0
            values[neighbour, ny - 1] = 0.0
            values[neighbour, :, 0] = 0.0
            values[neighbour, :, nx - 1] = 0.0


class Elements:
    """Galerkin equations of bilinear elements; takes the place of `Differences`.

    Parameters
    ----------
    grid
        Grid with uniform spacing.
    compliance
        Deflection per pressure that sets the upwinding [-]; None: of waves of the length 2 d on a
        half-space, 2/(E* k), k = pi/d.
    """

    centre = ELEMENT_CENTRE  # number of the node itself among its neighbours
    upwinds_along_x = True  # alone what is stored
    face_limits = -math.inf, math.inf

    def __init__(self, grid: PointGrid, compliance: float | None = None) -> None:
        waves = 2.0 * min(grid.dx, grid.dy) / (math.pi * grid.modulus)
        self._compliance = waves if compliance is None else compliance

    @staticmethod
    def wedge(name: str) -> str:
        """Return the wedge stencil: `upwind-1` for upwinding of first order everywhere."""
        return name if name == "upwind-1" else "central"

    def residual(
        self, stencil: StencilParameters, state: FilmState, carried: Array, source: Array
    ) -> None:
        """Write the residual of a state, as `Differences.residual`."""
        element_residual(
            stencil,
            state.oil,
            carried,
            _flow(state),
            source,
            self._compliance,
            state.density,
            state.residual,
        )

    def derivatives(
        self,
        stencil: StencilParameters,
        state: FilmState,
        density: tuple[Array, Array],
        rows: Flags,
        entrainment: Array,
        storage: NoStorage | Storage,
    ) -> Derivatives:
        """Return neighbours and derivatives, as `Differences.derivatives`."""
        count = SHEARED_ELEMENT_NEIGHBOURS if state.shear.sheared else ELEMENT_NEIGHBOURS
        by_pressure, by_film = np.empty((2, count, *state.film.shape))
        element_derivatives(
            stencil,
            state.oil,
            _flow(state),
            CarriedMass(*density, state.film),
            state.shear.tensor_slopes(
                state.cubic * state.fluidity, state.dense, state.viscosity_slope
            ),
            self._compliance,
            np.ascontiguousarray(storage.rate / entrainment[:, None]),
            rows,
            by_pressure,
            by_film,
        )
        return ELEMENT_OFFSETS, by_pressure, by_film


def _flow(state: FilmState) -> FlowTensor:
    cubic_xy = state.shear.cubic_xy(state.cubic)
    return FlowTensor(state.cubic_x, cubic_xy, state.cubic_y, state.fluidity)
