"""Compliance of hat loads on the elastic half-space, on a flank's true points.

This is the compliance of the flank as the surface of a half-space. Subtracting it from the finite
elements leaves the part that a contact solver with its own half-space solution still needs.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse import csr_array
from scipy.spatial.distance import cdist

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import Solid
from gearlube_core.tooth_compliance.hat_grid import hat_values
from gearlube_core.tooth_compliance.tooth_section import Flank

# cells between the centres of two hats along each parameter; the error falls with the square of
# the cells' size, so two sizes extrapolate: 0.1 % is left inside, 0.5 % in the corners
_COARSE_CELLS, _FINE_CELLS = 3, 6
# cells within which the integral of 1/r is exact; beyond, 1/r of the centres is right to 1 % of
# one cell's share even for cells three times as long as wide
_NEAR = 5


def _potential_of_cells(corners: Array, normals: Array, points: Array) -> Array:
    """Return the integral of 1/r over flat quadrilaterals at points in their planes [m].

    sum over the edges of d [asinh(l_b/|d|) - asinh(l_a/|d|)], d the point's distance from the
    edge's line, l_a and l_b the positions of the edge's ends along it from the foot of d.

    Parameters
    ----------
    corners
        In order around the cell, (4, n, 3) [m].
    normals
        Unit normals, right-handed with that order, (n, 3).
    points
        (n, 3) [m]; their heights over the cells' planes are ignored.
    """
    relative = corners - points
    relative = relative - np.einsum("knj,nj->kn", relative, normals)[..., None] * normals
    total = np.zeros(len(points))
    for a, b in zip(relative, np.roll(relative, -1, axis=0), strict=True):
        edge = b - a
        edge /= np.linalg.norm(edge, axis=1)[:, None]
        distance = np.einsum("nj,nj->n", normals, np.cross(a, edge))
        span = np.maximum(np.abs(distance), 1e-30)
        low, high = (np.einsum("nj,nj->n", x, edge) / span for x in (a, b))
        total += distance * (np.arcsinh(high) - np.arcsinh(low))
    return total


def _cell_grid(flank: Flank, s_edges: Array, t_edges: Array) -> tuple[Array, Array, Array, Array]:
    """Return centres (ns, nt, 3), corners (4, ns, nt, 3), unit normals and areas of cells."""
    nodes = flank.at(s_edges, t_edges)
    corners = np.array([nodes[:-1, :-1], nodes[1:, :-1], nodes[1:, 1:], nodes[:-1, 1:]])
    doubled = np.cross(corners[2] - corners[0], corners[3] - corners[1])
    size = np.linalg.norm(doubled, axis=-1)
    return corners.mean(axis=0), corners, doubled / size[..., None], 0.5 * size


def _inverse_distances(centres: Array, corners: Array, normals: Array, areas: Array) -> Array:
    """Return mean values of 1/r over source cells (columns) at the centres (rows) [1/m]."""
    ns, nt = areas.shape
    flat = centres.reshape(-1, 3)
    distance = cdist(flat, flat)
    np.fill_diagonal(distance, np.inf)  # replaced below
    inverse = 1.0 / distance
    index = np.arange(ns * nt).reshape(ns, nt)
    for i in range(-_NEAR, _NEAR + 1):
        for j in range(-_NEAR, _NEAR + 1):
            source = (slice(max(0, -i), ns - max(0, i)), slice(max(0, -j), nt - max(0, j)))
            target = (slice(max(0, i), ns - max(0, -i)), slice(max(0, j), nt - max(0, -j)))
            mean = (
                _potential_of_cells(
                    corners[(slice(None), *source)].reshape(4, -1, 3),
                    normals[source].reshape(-1, 3),
                    centres[target].reshape(-1, 3),
                )
                / areas[source].ravel()
            )
            inverse[index[target].ravel(), index[source].ravel()] = mean
    return 0.5 * (inverse + inverse.T)


def _integrated(flank: Flank, s_nodes: Array, t_nodes: Array, parts: int) -> Array:
    """Return the hats' averages of 1/r with `parts` cells between hats [1/m]."""

    def subdivided(nodes: Array) -> Array:
        steps = np.linspace(0.0, len(nodes) - 1.0, parts * (len(nodes) - 1) + 1)
        return np.interp(steps, np.arange(len(nodes)), nodes)

    s_edges, t_edges = subdivided(s_nodes), subdivided(t_nodes)
    centres, corners, normals, areas = _cell_grid(flank, s_edges, t_edges)
    s, t = 0.5 * (s_edges[1:] + s_edges[:-1]), 0.5 * (t_edges[1:] + t_edges[:-1])
    shares = hat_values(s[:, None], t[None, :], s_nodes, t_nodes).multiply(areas.reshape(-1, 1))
    shares = csr_array(shares / shares.sum(axis=0))
    inverse = _inverse_distances(centres, corners, normals, areas)
    return shares.T @ (shares.T @ inverse).T


def half_space_compliance(
    flank: Flank, s_nodes: Array, t_nodes: Array, solid: Solid, refinement: int = 1
) -> Array:
    """Return the hats' compliance on the half-space, symmetric (mh nh, mh nh) [m/N].

    c[i, j] = (1 - nu^2)/(pi E) double integral of (hat_i/A_i)(x) (hat_j/A_j)(x') / |x - x'|

    Parameters
    ----------
    flank
        Surface; |x - x'| is the chord between its points.
    s_nodes, t_nodes
        Parameters of the hats' centres [-].
    solid
        Elastic constants.
    refinement
        Multiplies the number of integration cells along both directions.

    References
    ----------
    [johnson_1985 (3.22a)]: u_z = (1 - nu^2)/(pi E) P/r of a point force P.
    """
    coarse, fine = (
        _integrated(flank, s_nodes, t_nodes, refinement * parts)
        for parts in (_COARSE_CELLS, _FINE_CELLS)
    )
    average = (4.0 * fine - coarse) / 3.0
    factor = (1.0 - solid.poisson_ratio**2) / (math.pi * solid.youngs_modulus)
    return factor * 0.5 * (average + average.T)
