"""Case of the shipped e-axle: an aluminium box of solid elements, reduced to its bearing seats.

`python examples/e_axle_case.py case.npz` writes the reduced model; it needs half a minute. A second
file, such as `case.png`, gets a picture of the finite elements.
"""

from __future__ import annotations

import itertools
import sys
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sp
import skfem
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh, splu

import gearlube as gl

LAME, SHEAR, DENSITY = 51.08e9, 26.32e9, 2700.0  # Pa, kg/m3: E 70 GPa, Poisson's ratio 0.33
LOW, HIGH = np.array([-0.11, -0.16, -0.008]), np.array([0.375, 0.16, 0.348])  # m, of the box
WALLS = np.array([0.012, 0.012, 0.016])
INNER_LOW, INNER_HIGH = LOW + WALLS, HIGH - WALLS
MIDDLE = 0.198, 0.214  # the wall between motor and gears
# m: x and y of the axis, z of the bearing; half width of bore and boss, both ends of the boss
SEATS = {
    "input_fixed": (0.0, 0.0, 0.0, 0.024, 0.033, -0.008, 0.008),
    "input_middle": (0.0, 0.0, 0.2, 0.024, 0.033, *MIDDLE),
    "input_end": (0.0, 0.0, 0.29, 0.024, 0.033, 0.282, 0.348),
    "counter_fixed": (0.062467128, -0.052416144, 0.215, 0.0194, 0.0284, *MIDDLE),
    "counter_end": (0.062467128, -0.052416144, 0.32, 0.0194, 0.0284, 0.312, 0.348),
    "output_fixed": (0.221594894, 0.005501627, 0.26, 0.0385, 0.0495, 0.198, 0.268),
    "output_end": (0.221594894, 0.005501627, 0.34, 0.0385, 0.0495, 0.332, 0.348),
}
MORE_LINES = ((0.134, 0.315), (0.1,), (0.07, 0.135, *MIDDLE))  # of the mesh
MOUNTS = {"mount_1": (0, 0, 0), "mount_2": (1, 0, 0), "mount_3": (0, 1, 0), "mount_4": (1, 0, 1)}
MOUNT_SIZE = 0.04  # m
PANELS = {"top": (0.134, 0.16, 0.07), "side": (0.375, 0.1, 0.07), "cover": (0.134, 0.1, 0.348)}


class WholeCase(NamedTuple):
    """A finite element model: coordinates of its own, behind them those of the nodes."""

    stiffness: sp.csc_matrix
    mass: sp.csc_matrix
    nodes: tuple[gl.train.InterfaceNode, ...]
    owner: np.ndarray  # of the last coordinates: node, and direction from 0 to 5
    direction: np.ndarray


def box() -> skfem.Basis:
    """Return quadratic elements of walls and bosses; bores are square."""
    seats = np.array(list(SEATS.values()))[:, :, None]
    grid = []
    for i in range(3):
        lines = [LOW[i], HIGH[i], INNER_LOW[i], INNER_HIGH[i], *MORE_LINES[i]]
        widths = [seats[:, i] + sign * seats[:, k] for sign in (-1, 1) for k in (3, 4)]
        grid.append(np.unique(np.append(lines, widths if i < 2 else seats[:, 5:]).round(6)))
    mesh = skfem.MeshHex.init_tensor(*grid)
    x, y, z = mesh.p[:, mesh.t].mean(axis=1)
    away = np.maximum(abs(x - seats[:, 0]), abs(y - seats[:, 1]))  # (seats, elements)
    beside = (z > seats[:, 5]) & (z < seats[:, 6])
    solid = (z > MIDDLE[0]) & (z < MIDDLE[1])
    for one, low, high in zip((x, y, z), INNER_LOW, INNER_HIGH, strict=True):
        solid |= (one < low) | (one > high)
    solid |= (beside & (away < seats[:, 4])).any(axis=0)
    solid &= ~(beside & (away < seats[:, 3])).any(axis=0)
    return skfem.Basis(mesh.restrict(solid), skfem.ElementHexS2())


def whole_case() -> WholeCase:
    """Return the case; rigid bores and mounts move with the six coordinates of their nodes."""
    basis = box()
    places, n = basis.doflocs, basis.N
    slopes = {
        (a, b): skfem.BilinearForm(lambda u, v, _: u.grad[a] * v.grad[b]).assemble(basis)  # noqa: B023
        for a, b in itertools.product(range(3), repeat=2)
    }
    same = SHEAR * sum(slopes[a, a] for a in range(3))
    stiffness = sp.bmat([
        [LAME * slopes[d, c] + SHEAR * slopes[c, d] + (same if c == d else 0.0 * same)
         for d in range(3)] for c in range(3)
    ])  # fmt: skip
    mass = sp.kron(sp.eye(3), skfem.BilinearForm(lambda u, v, _: DENSITY * u * v).assemble(basis))

    nodes, ties = [], []  # ties: rows, columns, factors
    for name, (x, y, z, bore, _, start, end) in SEATS.items():
        away = np.maximum(abs(places[0] - x), abs(places[1] - y))
        inside = (away < bore + 1e-6) & (places[2] > start - 1e-6) & (places[2] < end + 1e-6)
        nodes.append((gl.train.InterfaceNode(name, x, y, z), inside))
    for name, corner in MOUNTS.items():
        at = LOW + corner * (HIGH - LOW)
        inside = abs(places - at[:, None]).max(axis=0) < MOUNT_SIZE
        nodes.append((gl.train.InterfaceNode(name, *at.tolist()), inside))
    tied = np.zeros(3 * n, bool)
    for k, (node, inside) in enumerate(nodes):
        moved = np.flatnonzero(inside)
        arms = places[:, moved] - np.array(node[1:])[:, None]
        for c in range(3):
            a, b = (c + 1) % 3, (c + 2) % 3
            tied[c * n + moved] = True
            ties.append((c * n + moved, 6 * k + c, np.ones(moved.size)))
            ties.append((c * n + moved, 6 * k + 3 + a, arms[b]))
            ties.append((c * n + moved, 6 * k + 3 + b, -arms[a]))
    owner, direction = (one.ravel().tolist() for one in np.divmod(np.arange(6 * len(nodes)), 6))
    for name, at in PANELS.items():
        i = int(np.linalg.norm(places - np.array(at)[:, None], axis=0).argmin())
        way = int(abs(places[:, i] - HIGH).argmin())  # the normal of its wall
        tied[way * n + i] = True
        ties.append((np.array([way * n + i]), len(owner), np.ones(1)))
        owner, direction = [*owner, len(nodes)], [*direction, way]
        nodes.append((gl.train.InterfaceNode(name, *places[:, i].tolist()), None))
    free = np.flatnonzero(~tied)
    rows = np.concatenate([free, *(one[0] for one in ties)])
    columns = [np.arange(free.size), *(np.full(r.size, free.size + c) for r, c, _ in ties)]
    factors = np.concatenate([np.ones(free.size), *(one[2] for one in ties)])
    moves = sp.csc_matrix((factors, (rows, np.concatenate(columns))))
    return WholeCase(
        (moves.T @ stiffness @ moves).tocsc(),
        (moves.T @ mass @ moves).tocsc(),
        tuple(node for node, _ in nodes),
        np.array(owner),
        np.array(direction),
    )


def factors(matrix: sp.csc_matrix) -> Any:
    """Return the factors of a symmetric matrix."""
    return splu(matrix, "MMD_AT_PLUS_A", 0.0, options={"SymmetricMode": True})


def free_modes(whole: WholeCase, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return squares of the lowest frequencies [rad2/s2], and shapes of modal mass 1."""
    shift = -1e5  # rad2/s2: the free case has six rigid motions
    solve = factors(whole.stiffness - shift * whole.mass).solve
    inverse = LinearOperator(whole.stiffness.shape, solve)
    return eigsh(whole.stiffness, count, whole.mass, sigma=shift, OPinv=inverse)


def reduced_case(whole: WholeCase, modes: int) -> gl.train.ReducedModel:
    """Return the case reduced to its nodes: statics are exact, and so are modes of the free case.

    Shapes between fixed nodes are those that the free modes add to the static shapes, and the
    answers to the inertia of the static shapes, which matter where heavy shafts hold the nodes.
    """
    n = whole.owner.size
    k_ii, k_ib, k_bb = (
        whole.stiffness[:-n, :-n],
        whole.stiffness[:-n, -n:],
        whole.stiffness[-n:, -n:],
    )
    m_ii, m_ib = whole.mass[:-n, :-n], whole.mass[:-n, -n:]
    free = free_modes(whole, 6 + modes)[1][:, 6:]
    solve = factors(k_ii).solve
    statics = -solve(k_ib.toarray())
    answers = solve(m_ii @ statics + m_ib.toarray())
    inner = np.linalg.qr(np.hstack([free[:-n] - statics @ free[-n:], answers]))[0]
    squares, mixed = eigh(inner.T @ (k_ii @ inner), inner.T @ (m_ii @ inner))
    more = squares.size
    ways = np.vstack([np.hstack([statics, inner @ mixed]), np.eye(n, n + more)])
    stiffness = np.diag(np.append(np.zeros(n), squares))
    stiffness[:n, :n] = k_bb.toarray() + k_ib.T @ statics
    mass = ways.T @ (whole.mass @ ways)
    return gl.train.ReducedModel(
        stiffness=0.5 * (stiffness + stiffness.T),
        mass=0.5 * (mass + mass.T),
        nodes=whole.nodes,
        owner=np.append(whole.owner, np.full(more, -1)),
        direction=np.append(whole.direction, np.zeros(more, int)),
    )


def draw(path: str) -> None:
    """Draw the finite elements, whole and without the top and one side; squares: mounts."""
    import matplotlib.pyplot as plt
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    mesh = box().mesh
    faces = 1e3 * mesh.p[:, mesh.facets[:, mesh.boundary_facets()]].T  # mm: face, corner, direction
    faces = faces[:, :, [2, 0, 1]]  # y of the train points up
    _, x, y = faces.mean(axis=1).T
    seen = (y < 1e3 * INNER_HIGH[1] - 1.0) & (x > 1e3 * INNER_LOW[0] + 1.0)
    figure = plt.figure(figsize=(8.0, 4.2), layout="constrained")
    titles = {"case": np.full(x.size, True), "without top and one side": seen}
    mounts = 1e3 * np.array([LOW + corner * (HIGH - LOW) for corner in MOUNTS.values()])
    for i, (title, shown) in enumerate(titles.items()):
        ax = figure.add_subplot(1, 2, i + 1, projection="3d")
        ax.add_collection3d(
            Poly3DCollection(
                faces[shown], facecolors="#a3b3c8", edgecolors="#333333", lw=0.3, shade=True
            )
        )
        ax.scatter(*mounts[:, [2, 0, 1]].T, marker="s", s=40, depthshade=False)
        ax.set(title=title, xlabel="z [mm]", ylabel="x [mm]", zlabel="y [mm]")
        for low, high, limit in zip(LOW[[2, 0, 1]], HIGH[[2, 0, 1]], "xyz", strict=True):
            ax.set(**{f"{limit}lim": (1e3 * low, 1e3 * high)})
        ax.set_aspect("equal")
        ax.locator_params(nbins=5)
        ax.view_init(25.0, -125.0)
    figure.savefig(path, dpi=120)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        draw(sys.argv[2])
    model = reduced_case(whole_case(), 90)
    np.savez_compressed(
        sys.argv[1],
        stiffness=model.stiffness,
        mass=model.mass,
        names=[one.name for one in model.nodes],
        places=[one[1:] for one in model.nodes],
        owner=model.owner,
        direction=model.direction,
    )
