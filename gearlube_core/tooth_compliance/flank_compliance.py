"""Condensed compliance of both flanks of a tooth for loaded contact.

    u = H p + W B W^T f,  B = M^-1 (C_fe - C_hs) M^-T,  M_ij = integral hat_i hat_j dA / A_i

H p is the half-space displacement of the fine pressure, f the forces of the fine cells, W their
bilinear weights on a coarse grid of hats. C_fe - C_hs contains what a half-space lacks
(bending, shear, base, free faces), averaged over hats. M undoes the averaging: B is the projection
on the hats of the influence function itself (least squares in the area), so that what W
interpolates is not smoothed twice.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_array
from scipy.spatial.distance import cdist

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.solid import Solid
from gearlube_core.errors import ParameterError
from gearlube_core.tooth_compliance.hat_grid import hat_values, lengthwise_nodes, profile_nodes
from gearlube_core.tooth_compliance.tooth_geometry import Flank, ToothGeometry
from gearlube_core.tooth_compliance.tooth_mesh import (
    MeshDensity,
    normal_hat_loads,
    tooth_mesh,
    tooth_model,
)

# cells between the centres of two hats along each parameter; the error falls with the square of
# the cells' size, so two sizes extrapolate: 0.1 % is left inside, 0.5 % in the corners
_COARSE_CELLS, _FINE_CELLS = 3, 6

# cells within which the integral of 1/r is exact; beyond, 1/r of the centres is right to 1 % of
# one cell's share even for cells three times as long as wide
_NEAR = 5

SIDES = ("left", "right")


@dataclass(frozen=True, slots=True, kw_only=True)
class CondensationSettings:
    """Resolution of a tooth.

    Parameters
    ----------
    profile_hats, lengthwise_hats
        Numbers of hats from root to tip and from toe to heel.
    density
        Numbers of elements; multiples of one less than the hats' numbers, so that the hats' kinks
        lie on the elements' edges. With two elements between hats a hat's own half-space
        displacement comes out 2 % low, with three 1 %; loads spread over hats are resolved better.
    """

    profile_hats: int = 7
    lengthwise_hats: int = 13
    density: MeshDensity = field(default_factory=MeshDensity)

    def __post_init__(self) -> None:
        check_within("profile_hats", self.profile_hats, 2, 100)
        check_within("lengthwise_hats", self.lengthwise_hats, 2, 200)
        for name in ("profile", "lengthwise"):
            hats, elements = getattr(self, f"{name}_hats"), getattr(self.density, name)
            if elements % (hats - 1):
                raise ParameterError(
                    f"density.{name} must be a multiple of {name}_hats - 1 = {hats - 1}, "
                    f"got {elements}. Choose {2 * (hats - 1)} or {3 * (hats - 1)}."
                )


@dataclass(frozen=True, slots=True, kw_only=True)
class FlankCompliance:
    """Compliance of one flank between hats, along the inward normals.

    Hat (i, j) is number i nh + j. Both matrices are symmetric.

    Parameters
    ----------
    s, t
        Flank parameters of the hats' centres [-], (mh,) root to tip and (nh,) toe to heel.
    image
        B = M^-1 (C_fe - C_hs) M^-T, influence function between the hats' centres [m/N],
        (mh nh, mh nh).
    elastic
        C_fe, averages of the whole displacement under unit hats [m/N], (mh nh, mh nh).
    """

    s: Array
    t: Array
    image: Array
    elastic: Array


def projected(averages: Array, gram: Array) -> Array:
    """Return M^-1 averages M^-T, M = gram over its row sums: inverts the averaging over hats."""
    averaging = gram / gram.sum(axis=1)[:, None]
    once = np.linalg.solve(averaging, averages)
    both = np.linalg.solve(averaging, once.T)
    return 0.5 * (both + both.T)


def tooth_compliance(
    geometry: ToothGeometry, solid: Solid, settings: CondensationSettings
) -> tuple[FlankCompliance, FlankCompliance]:
    """Return the compliance of the left and the right flank.

    Parameters
    ----------
    geometry
        Geometry of tooth and rim.
    solid
        Linear elastic and isotropic.
    settings
        Numbers of hat functions and elements.

    Raises
    ------
    ParameterError
        When the geometry cannot be meshed.

    Notes
    -----
    Small strains. The base block is held at its bottom and at the two cuts through the rim; toe
    and heel are free, and so are the slots. Teeth beside this one are left out.
    """
    mesh = tooth_mesh(geometry, settings.density)
    model = tooth_model(mesh, solid)
    s = profile_nodes(settings.profile_hats)
    t = lengthwise_nodes(settings.lengthwise_hats)
    loaded = [normal_hat_loads(mesh, side, s, t) for side in SIDES]
    whole = model.compliance(np.hstack([forces for forces, _ in loaded]))
    flanks = []
    for k, (side, (_, gram)) in enumerate(zip(SIDES, loaded, strict=True)):
        part = slice(k * s.size * t.size, (k + 1) * s.size * t.size)
        elastic = whole[part, part].copy()
        half_space = half_space_compliance(Flank(getattr(geometry, side)), s, t, solid)
        image = projected(elastic - half_space, gram)
        flanks.append(FlankCompliance(s=s, t=t, image=image, elastic=elastic))
    return flanks[0], flanks[1]


def interpolation_weights(s: Array, t: Array, compliance: FlankCompliance) -> csr_array:
    """Return W, the weights of points on the hats, sparse (points, mh nh) [-].

    W^T f spreads point forces over hats, W u interpolates the hats' displacements. Points
    outside the grid are moved to its edge.

    Parameters
    ----------
    s, t
        Flank parameters of the points [-], any shape that broadcasts; counted in C order.
    compliance
        Its grid of hats.
    """
    return hat_values(s, t, compliance.s, compliance.t)


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


def half_space_compliance(flank: Flank, s_nodes: Array, t_nodes: Array, solid: Solid) -> Array:
    """Return the hats' compliance on the half-space, symmetric (mh nh, mh nh) [m/N].

    c[i, j] = (1 - nu^2)/(pi E) double integral of (hat_i/A_i)(x) (hat_j/A_j)(x') / |x - x'|

    Parameters
    ----------
    flank
        Surface; |x - x'| is the chord between its points.
    s_nodes, t_nodes
        Parameters of the hats' centres [-].
    solid
        Elastic constants of the tooth.

    References
    ----------
    [johnson_1985 (3.22a)]: u_z = (1 - nu^2)/(pi E) P/r of a point force P.
    """
    coarse, fine = (
        _integrated(flank, s_nodes, t_nodes, parts) for parts in (_COARSE_CELLS, _FINE_CELLS)
    )
    average = (4.0 * fine - coarse) / 3.0
    factor = (1.0 - solid.poisson_ratio**2) / (math.pi * solid.youngs_modulus)
    return factor * 0.5 * (average + average.T)
