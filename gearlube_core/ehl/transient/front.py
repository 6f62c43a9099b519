"""Front of the pressurised oil, updated alone between two Newton steps of the whole film.

A Newton step opens the next node downstream of the nodes with pressure, no more. Where a gap
closes quickly, at the edge of a relief, oil fills many nodes of a row within one time step.
"""

from __future__ import annotations

import numpy as np

from gearlube_core.ehl.point.newton.newton import flow_residual
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.transient.level import MovingLevel
from gearlube_core.kernels.jit import kernel

_LARGEST = 3.0  # flow residual, above which the film behind the front is too rough
_SHARE = 0.3  # of the unbalanced flow at opening nodes, from which on the front is what lacks
# below this flow residual the film is found but for its front: from a smaller share on, and what
# the front's move unbalances elsewhere is left to the next linear solution
_FOUND = 0.2
_SHARE_FOUND, _GROWTH_FOUND = 0.1, 6.0
_FEW = 0.01  # of the largest unbalanced flow, below which an opening node is left alone
_BACK, _AHEAD, _BESIDE = 4, 16, 2  # nodes along and across the motion that follow an opening one
_SWEEPS = 50


@kernel
def mark_band(opening: np.ndarray, back: int, ahead: int, beside: int, band: np.ndarray) -> None:
    """Set flags around opening nodes, inside the border; shapes (ny, nx)."""
    ny, nx = opening.shape
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if opening[j, i]:
                for jj in range(max(1, j - beside), min(ny - 1, j + beside + 1)):
                    for ii in range(max(1, i - back), min(nx - 1, i + ahead + 1)):
                        band[jj, ii] = True


@kernel
def relax_band(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    slope: np.ndarray,
    places: np.ndarray,
    pressure: np.ndarray,
    right: np.ndarray,
    centre: int,
    sweeps: int,
    change: np.ndarray,
) -> None:
    """Write changes of pressure that balance a band of nodes downstream, node by node.

    Parameters
    ----------
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x.
    by_pressure : ndarray, shape (m, ny, nx), m <= n
        Derivatives of the residual at given film.
    slope : ndarray, shape (ny, nx)
        Of the node itself, with what its own pressure does to the film.
    places : ndarray of int, shape (k, 2)
        Nodes in the order of the sweep.
    pressure, right : ndarray, shape (ny, nx)
        Pressure, and what the derivatives times the changes have to be.
    centre
        Number of the node itself among its neighbours.
    sweeps
        Number of Gauss-Seidel sweeps.
    change : ndarray, shape (ny, nx)
        Result; zero on entry. Pressure does not become negative.
    """
    ny, nx = change.shape
    for _ in range(sweeps):
        for m in range(places.shape[0]):
            j, i = places[m, 0], places[m, 1]
            if slope[j, i] >= 0.0:
                continue
            rest = right[j, i] - (slope[j, i] - by_pressure[centre, j, i]) * change[j, i]
            for k in range(by_pressure.shape[0]):
                jj, ii = j + offsets[k, 0], i + offsets[k, 1]
                if 0 <= jj < ny and 0 <= ii < nx:
                    rest -= by_pressure[k, j, i] * change[jj, ii]
            change[j, i] = max(change[j, i] + rest / slope[j, i], -pressure[j, i])


def advance_front(level: MovingLevel, state: FilmState, size: float) -> tuple[FilmState, float]:
    """Return the state with its front moved, and its flow residual, where that pays.

    Parameters
    ----------
    level
        Grid.
    state
        After a Newton step.
    size
        Its flow residual [-].

    Returns
    -------
    tuple
        The state as given where flow is unbalanced elsewhere or the front's move left more, six
        times as much once little is left: by then it is the front alone that Newton steps find
        node by node, while what its move does to the film around it is linear.

    Notes
    -----
    Projected Gauss-Seidel on the linearised Reynolds equation in a band around the opening nodes,
    at the film of the state but for what a node's own pressure adds.
    """
    if not size < _LARGEST:
        return state, size
    found = size < _FOUND
    share, growth = (_SHARE_FOUND, _GROWTH_FOUND) if found else (_SHARE, 1.0)
    opening = (state.pressure <= 0.0) & state.free
    flow = np.where(opening, state.residual, 0.0)
    if level.grid.integral(flow) < share * level.grid.integral(
        np.where(state.free, np.abs(state.residual), 0.0)
    ):
        return state, size
    band = np.zeros(level.shape, dtype=np.bool_)
    mark_band(flow > _FEW * flow.max(), _BACK, _AHEAD, _BESIDE, band)
    band = state.contact.apart(state.boundary.within(band))
    linear = level.linearise(state, rows=band.copy())
    change, centre = np.zeros(level.shape), linear.centre
    relax_band(
        linear.offsets,
        linear.by_pressure,
        linear.by_pressure[centre] + level.grid.own_deflection * linear.by_film[centre],
        np.argwhere(band),
        state.pressure,
        linear.right,
        centre,
        _SWEEPS,
        change,
    )
    moved = level.state(state.pressure + change, state.approach)
    after = flow_residual(level, moved)
    return (moved, after) if after < growth * size else (state, size)
