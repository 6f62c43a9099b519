"""Stencil of the Reynolds equation of a point contact: neighbours, faces and means, kernels.

Arrays have shape (ny, nx): x, the direction of the larger entrainment, runs along memory. All
quantities are those of `PointScales`; entrainment points to larger x and y. Spacing may vary
smoothly along x.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel

# coefficients of a node and its neighbours, in this order
CENTRE, WEST, EAST, FAR_WEST, SOUTH, NORTH, FAR_SOUTH = range(7)
NEIGHBOURS = 7
# and of those that flow across the slope of pressure adds
SOUTH_WEST, SOUTH_EAST, NORTH_WEST, NORTH_EAST = range(7, 11)
CROSS_NEIGHBOURS = 11
# steps to them along y and along x
OFFSETS = np.array(
    [
        [0, 0],
        [0, -1],
        [0, 1],
        [0, -2],
        [-1, 0],
        [1, 0],
        [-2, 0],
        [-1, -1],
        [-1, 1],
        [1, -1],
        [1, 1],
    ]
)


class StencilParameters(NamedTuple):
    """Constants of the discrete equation; all floats."""

    poiseuille_x: float  # Lambda/dx^2 [-]
    poiseuille_y: float  # Lambda/dy^2 [-]
    wedge_x: float  # u/(u_s dx) [-]
    wedge_y: float  # v/(u_s dy) [-]
    here: float  # weight of rho h upstream of a face [-]
    upstream: float  # weight of rho h one node further upstream [-]
    downstream: float  # weight of rho h downstream of a face [-]
    squeeze: float  # factor of rho h at this time [-]
    least: float = -math.inf  # of rho h at a face, over that of the node upstream of it [-]
    most: float = math.inf  # likewise


class MeshMetric(NamedTuple):
    """Spacing along x against the dx of the parameters; arrays of shape (nx,) [-].

    Faces lie where the position as a smooth function of the index is at half an index, so that
    values there follow from nodes with the weights of a uniform grid, of the same order.
    """

    near: np.ndarray  # dx over the distance of a node from the one before
    narrow: np.ndarray  # dx over the width of a node's cell


class FilmFlow(NamedTuple):
    """What pressure drives oil with at every node; arrays of shape (ny, nx) [-]."""

    cubic: np.ndarray  # rho h^3
    fluidity_x: np.ndarray  # 1/eta times the flow factor along x
    fluidity_y: np.ndarray
    resistance_x: np.ndarray  # -ln of these
    resistance_y: np.ndarray


@kernel
def face_weights(
    parameters: StencilParameters, index: int, far: float, here: float, there: float
) -> tuple[float, float, float]:
    """Return weights (node, upstream, downstream) of the face after node `index`.

    Parameters
    ----------
    parameters
        Weights of the stencil and the limits of their sum.
    index
        Of the node upstream of the face along its row or column.
    far, here, there
        rho h at the second node upstream, at the node upstream and at that downstream [-].

    Returns
    -------
    tuple of float

    Notes
    -----
    Behind the first node no second node upstream exists: the mean, second order as well. Between
    `least` and `most` times the upstream rho h a face drains no more than there is as the film
    of the node vanishes: the film of a solution stays positive. Faces beyond are of first order.
    """
    w0, w1, w2 = parameters.here, parameters.upstream, parameters.downstream
    if index == 0 and w1 != 0.0:
        w0, w1, w2 = 0.5, 0.0, 0.5
    value = w0 * here + w1 * far + w2 * there
    if value < parameters.least * here:
        return parameters.least, 0.0, 0.0
    if value > parameters.most * here:
        return parameters.most, 0.0, 0.0
    return w0, w1, w2


@kernel
def mean_fluidity(
    here: float, there: float, rise: float, steep: bool
) -> tuple[float, float, float]:
    """Return the mean fluidity of two nodes and its slopes: logarithmic where steep.

    Parameters
    ----------
    here, there
        1/eta, times its flow factor in an Eyring film, at both nodes [-].
    rise
        ln(there/here) [-].
    steep
        Pressure rises along the entrainment.

    Returns
    -------
    tuple of float
        Mean and its derivatives with respect to ln(here) and ln(there) [-].

    Notes
    -----
    The logarithmic mean is that over the pressure between the nodes where eta grows
    exponentially: the flow against the rise of pressure in the inlet stays right on any grid.
    Towards the exit the plain mean ties the pressure of a spike to its surroundings. Both are
    of second order. The flow factor of a sheared film grows like eta; the product hardly changes
    from node to node, while means of both apart would be too large by orders of magnitude.
    """
    if not steep:
        return 0.5 * (here + there), 0.5 * here, 0.5 * there
    if abs(rise) < 1e-3:
        mean = math.sqrt(here * there) * (1.0 + rise * rise / 24.0)
        return mean, mean * (0.5 - rise / 12.0), mean * (0.5 + rise / 12.0)
    mean = (there - here) / rise
    return mean, (mean - here) / rise, (there - mean) / rise


class FlowTensor(NamedTuple):
    """The same in finite elements, for flow at any angle; arrays of shape (ny, nx) [-]."""

    cubic_x: np.ndarray  # rho h^3 times the components of the flow factor tensor
    cubic_xy: np.ndarray
    cubic_y: np.ndarray
    fluidity: np.ndarray  # 1/eta


class CarriedMass(NamedTuple):
    """What surfaces carry at every node; arrays of shape (ny, nx) [-]."""

    density: np.ndarray  # rho
    density_slope: np.ndarray  # d rho/dp
    film: np.ndarray  # h


class FlowSlopes(NamedTuple):
    """Derivatives of the flow by pressure at every node; arrays of shape (ny, nx) [-]."""

    slope_x: np.ndarray  # rho h^3 times the flow factor of a change of dp/dx
    slope_y: np.ndarray
    slope_xy: np.ndarray  # of dp/dy, in the flow along x
    by_pressure: np.ndarray  # d ln(rho h^3 times its flow factor)/dp
    film_power: np.ndarray  # d ln(the same)/d ln(h), 3 where the film is Newtonian
    stiffness: np.ndarray  # -d ln(flow)/d ln(eta), 1 where the film is Newtonian


@kernel
def node_slopes(
    slopes: FlowSlopes, viscosity_slope: np.ndarray, j: int, i: int
) -> tuple[float, float, float]:
    """Return -d ln(f)/dp, d ln(f)/d ln(h) and d ln(rho)/dp of a node, f its fluidity [-]."""
    stiffness, thickening = slopes.stiffness[j, i], viscosity_slope[j, i]
    dense = slopes.by_pressure[j, i] - (1.0 - stiffness) * thickening
    return stiffness * thickening, slopes.film_power[j, i] - 3.0, dense
