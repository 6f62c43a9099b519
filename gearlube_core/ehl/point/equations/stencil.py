"""Stencil of the Reynolds equation of a point contact: neighbours, faces and means, kernels.

Arrays have shape (ny, nx): x, the direction of the larger entrainment, runs along memory. All
quantities are those of `PointScales`; entrainment points to larger x and y. Spacing may vary
smoothly along x.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel

# coefficients of a node and its neighbours, in this order
CENTRE, WEST, EAST, FAR_WEST, SOUTH, NORTH, FAR_SOUTH = range(7)
NEIGHBOURS = 7
# and of those whose pressure decides how a film shears at the nodes beside
SOUTH_WEST, SOUTH_EAST, NORTH_WEST, NORTH_EAST, FAR_EAST, FAR_NORTH = range(7, 13)
SHEARED_NEIGHBOURS = 13
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
        [0, 2],
        [2, 0],
    ]
)
# for each of the first seven but the far ones: its own neighbours east, west, north and south
BESIDE = np.array(
    [
        [EAST, WEST, NORTH, SOUTH],
        [CENTRE, FAR_WEST, NORTH_WEST, SOUTH_WEST],
        [FAR_EAST, CENTRE, NORTH_EAST, SOUTH_EAST],
        [-1, -1, -1, -1],
        [SOUTH_EAST, SOUTH_WEST, CENTRE, FAR_SOUTH],
        [NORTH_EAST, NORTH_WEST, FAR_NORTH, CENTRE],
    ]
)
_LARGEST_RATIO = 20.0
_TABLE = 4001  # entries of the position over the index


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
    """Conductance of pressure-driven flow at every node; arrays of shape (ny, nx) [-]."""

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
    """Oil that the surfaces carry at every node; arrays of shape (ny, nx) [-]."""

    density: np.ndarray  # rho
    density_slope: np.ndarray  # d rho/dp
    film: np.ndarray  # h


class NodeSlopes(NamedTuple):
    """Derivatives of a quantity of a node, arrays of shape (ny, nx) [-]."""

    by_pressure: np.ndarray  # by its own pressure
    by_film: np.ndarray  # by ln(h)
    by_rise_x: np.ndarray  # by the pressure of the node to the east less that to the west
    by_rise_y: np.ndarray  # by the pressure of the node to the north less that to the south


class FlowSlopes(NamedTuple):
    """Derivatives of what pressure drives oil with at every node [-]."""

    dense: np.ndarray  # d ln(rho)/dp, shape (ny, nx)
    x: NodeSlopes  # of ln(fluidity along x)
    y: NodeSlopes  # of ln(fluidity along y)
    cross_x: NodeSlopes  # of the flow across over that along x
    cross_y: NodeSlopes  # of the flow across over that along y


class TensorSlopes(NamedTuple):
    """Derivatives of the components of the flow factor tensor at every node [-]."""

    xx: NodeSlopes
    xy: NodeSlopes
    yy: NodeSlopes


@kernel
def add_rises(
    slopes: NodeSlopes,
    weight: float,
    j: int,
    i: int,
    beside: np.ndarray,
    row: int,
    column: int,
    by_pressure: np.ndarray,
) -> None:
    """Add to a row what a quantity of a node changes as pressure rises across that node.

    Parameters
    ----------
    slopes
        Derivatives of the quantity.
    weight
        Derivative of the residual of the row by the quantity [-].
    j, i
        Node of the quantity.
    beside : ndarray of int, shape (4,)
        Numbers of its neighbours east, west, north and south among those of the row's node.
    row, column
        Node of the row.
    by_pressure : ndarray, shape (n, ny, nx)
        Derivatives by pressure, changed in place.
    """
    x, y = weight * slopes.by_rise_x[j, i], weight * slopes.by_rise_y[j, i]
    by_pressure[beside[0], row, column] += x
    by_pressure[beside[1], row, column] -= x
    by_pressure[beside[2], row, column] += y
    by_pressure[beside[3], row, column] -= y


@dataclass(frozen=True, slots=True)
class Grading:
    """Spacing along x, in proportion, at some places; smooth between and constant beyond them.

    Parameters
    ----------
    at
        Places [m], rising, two or more.
    spacing
        At each of them, in any unit, above zero; the largest is at most 20 of the smallest.

    Raises
    ------
    ParameterError
        Places or spacings are out of range.

    Notes
    -----
    The logarithm of the spacing is a monotone cubic spline of x with a continuous slope, so that
    differences between nodes stay of second order. Spacing should double over some five nodes
    or more.
    """

    at: tuple[float, ...]
    spacing: tuple[float, ...]

    def __post_init__(self) -> None:
        rising = all(a < b for a, b in pairwise(self.at))
        if len(self.at) < 2 or len(self.spacing) != len(self.at) or not rising:
            raise ParameterError(
                "A graded grid needs at least two rising positions, each with a spacing, got "
                f"{self.at} m and {self.spacing}. Sort the positions."
            )
        for spacing in self.spacing:
            check_positive("spacing", spacing, "")
        ratio = max(self.spacing) / min(self.spacing)
        check_within("largest over smallest spacing", ratio, 1.0, _LARGEST_RATIO)

    def nodes(self, limits: tuple[float, float], count: int) -> Array:
        """Return the nodes [m], shape (count,), from limit to limit [m].

        Grids of fewer nodes keep the same proportions: every second node of an odd number is a
        node of half as many.
        """
        x = np.linspace(*limits, _TABLE)
        logarithm = PchipInterpolator(self.at, np.log(self.spacing))
        density = np.exp(-logarithm(np.clip(x, self.at[0], self.at[-1])))
        index = np.append(0.0, np.cumsum(0.5 * (density[1:] + density[:-1])))
        nodes = np.interp(np.linspace(0.0, index[-1], count), index, x)
        nodes[[0, -1]] = limits
        return np.asarray(nodes)


def cell_faces(nodes: Array) -> Array:
    """Return the faces of the cells around nodes, shape (n + 1,), half an index from them.

    Cubic in the index; the first and the last cell are symmetric about their node.
    """
    middle = 0.5 * (nodes[1:] + nodes[:-1])
    middle[1:-1] += (nodes[1:-2] + nodes[2:-1] - nodes[:-3] - nodes[3:]) / 16.0
    first, last = 2.0 * nodes[0] - middle[0], 2.0 * nodes[-1] - middle[-1]
    return np.concatenate(([first], middle, [last]))


def mesh_metric(nodes: Array, dx: float) -> MeshMetric:
    """Return the metric of nodes against a spacing in the same unit."""
    gaps = np.diff(nodes)
    return MeshMetric(dx / np.append(gaps[0], gaps), dx / np.diff(cell_faces(nodes)))


def central_metric(nodes: Array, dx: float) -> Array:
    """Return dx over half the distance between the neighbours of each node, shape (n,)."""
    ratio = np.ones(nodes.size)
    ratio[1:-1] = 2.0 * dx / (nodes[2:] - nodes[:-2])
    return ratio


def x_nodes(limits: tuple[float, float], count: int, grading: Grading | None) -> Array:
    """Return the nodes along x [m], shape (count,), uniform without a grading."""
    return np.linspace(*limits, count) if grading is None else grading.nodes(limits, count)
