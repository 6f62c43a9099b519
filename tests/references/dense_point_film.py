"""A second solver of the film in a point contact, small and slow: dense matrices, plain Newton.

It shares no code with `gearlube_core.ehl`: the elastic matrix, the flow through the faces with
arithmetic means of rho h^3/(12 eta), the laws of the oil and the nodes that carry no pressure are
written down again. The contact is symmetrical in y, so half of it is solved.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.interpolate import RectBivariateSpline
from scipy.linalg import solve as dense_solve


class Ball(NamedTuple):
    """A ball on a plane entrained along x; SI units."""

    radius: float
    load: float
    speed: float
    reduced_modulus: float  # E'
    eta0: float
    alpha: float


def _love(X: np.ndarray, Y: np.ndarray) -> np.ndarray:
    # corner function of the deflection under a uniformly loaded rectangle
    r = np.hypot(X, Y)
    return np.asarray(X * np.log(Y + r) + Y * np.log(X + r))


def _elastic_matrix(x: np.ndarray, y: np.ndarray, dx: float, dy: float, E: float) -> np.ndarray:
    """Return deflections at (x, y) under unit pressures around the same nodes and their mirrors."""
    points = np.stack([g.ravel() for g in np.meshgrid(x, y, indexing="ij")])

    def under(sign: float) -> np.ndarray:
        X = points[0][:, None] - points[0][None, :]
        Y = points[1][:, None] - sign * points[1][None, :]
        a, b = X + 0.5 * dx, X - 0.5 * dx
        c, d = Y + 0.5 * dy, Y - 0.5 * dy
        return _love(a, c) + _love(b, d) - _love(a, d) - _love(b, c)

    mirrored = np.where(points[1] > 0.25 * dy, 1.0, 0.0)[None, :]
    return np.asarray((under(1.0) + mirrored * under(-1.0)) * 2.0 / (np.pi * E))


def _smallest(x: np.ndarray, y: np.ndarray, h: np.ndarray) -> float:
    """Return the smallest film, between nodes by a cubic spline."""
    i, j = np.unravel_index(int(h.argmin()), h.shape)
    near_x = np.linspace(x[i - 1], x[i + 1], 41)
    near_y = np.linspace(y[max(j - 1, 0)], y[j + 1], 41)
    return float(RectBivariateSpline(x, y, h)(near_x, near_y).min())


def film(ball: Ball, nodes: int, limits: tuple[float, float, float]) -> tuple[float, float]:
    """Return central and smallest film [m].

    Parameters
    ----------
    ball
        Contact.
    nodes
        Along x, and across the whole width; odd.
    limits
        Where the domain begins and ends along x, and where it ends along y, in radii of the dry
        contact; the pressure is that of the surroundings there.
    """
    R, W, u, E, eta0, alpha = ball
    a = (1.5 * W * R / E) ** (1.0 / 3.0)
    p_h = 1.5 * W / (np.pi * a * a)
    x = np.linspace(limits[0] * a, limits[1] * a, nodes)
    y = np.linspace(0.0, limits[2] * a, (nodes + 1) // 2)
    dx, dy = x[1] - x[0], y[1] - y[0]
    nx, ny = len(x), len(y)
    xx, yy = (g.ravel() for g in np.meshgrid(x, y, indexing="ij"))
    K = _elastic_matrix(x, y, dx, dy, E)
    # faces along x and along y; the line of symmetry has no flow through it
    weight = np.where(np.arange(ny) == 0, 0.5, 1.0)  # of a cell cut by it
    step_x = sp.kron(sp.diags([-1.0, 1.0], [0, 1], (nx - 1, nx)), sp.eye(ny)).tocsr()
    step_y = sp.kron(sp.eye(nx), sp.diags([-1.0, 1.0], [0, 1], (ny - 1, ny))).tocsr()
    mean_x, mean_y = 0.5 * abs(step_x), 0.5 * abs(step_y)
    wedge = sp.diags([1.5, -0.5], [0, -1], (nx - 1, nx)).tolil()
    wedge[0, 0] = 1.0  # the first face has one node upstream
    carry = sp.kron(wedge, sp.eye(ny)).tocsr()
    out_x = -step_x.T @ sp.diags(np.tile(weight, nx - 1) * dy)
    out_y = -step_y.T * dx
    free = ((xx > x[0]) & (xx < x[-1]) & (yy < y[-1])).nonzero()[0]
    area = dx * dy * 2.0 * np.tile(weight, nx)

    Z = alpha / (5.1e-9 * (np.log(eta0) + 9.67))
    log_ratio = np.log(eta0) + 9.67
    p = p_h * np.sqrt(np.maximum(0.0, 1.0 - (xx**2 + yy**2) / a**2))
    U = eta0 * u / (E * R)
    H = 3.0 * R * np.sqrt(2.0 * U)
    h0 = H - (K @ p + (xx**2 + yy**2) / (2.0 * R))[np.argmin(xx**2 + yy**2)]
    for _ in range(60):
        h = h0 + (xx**2 + yy**2) / (2.0 * R) + K @ p
        eta = eta0 * np.exp(log_ratio * ((1.0 + 5.1e-9 * p) ** Z - 1.0))
        rate = log_ratio * Z * 5.1e-9 * (1.0 + 5.1e-9 * p) ** (Z - 1.0)
        rho = (1.0 + 2.266e-9 * p) / (1.0 + 1.683e-9 * p)
        slope = (2.266e-9 - 1.683e-9) / (1.0 + 1.683e-9 * p) ** 2
        hollow = np.maximum(h, 1e-3 * H)
        eps = rho * hollow**3 / (12.0 * eta)
        gx, gy = step_x @ p / dx, step_y @ p / dy
        flow_x = u * (carry @ (rho * h)) - (mean_x @ eps) * gx
        flow_y = -(mean_y @ eps) * gy
        net = out_x @ flow_x + out_y @ flow_y  # what flows out of a cell
        # what of it a pressure moves: through its slope, the viscosity, the density and the gap
        own = sp.diags(slope / rho - rate) @ sp.diags(eps)
        by_gap = sp.diags(3.0 * eps / hollow * (h > 1e-3 * H))
        through = out_x @ sp.diags(gx) @ mean_x + out_y @ sp.diags(gy) @ mean_y
        local = (
            u * out_x @ carry @ sp.diags(slope * h)
            - through @ own
            - out_x @ sp.diags(mean_x @ eps) @ step_x / dx
            - out_y @ sp.diags(mean_y @ eps) @ step_y / dy
        )
        gap = u * out_x @ carry @ sp.diags(rho) - through @ by_gap
        on = free[(p[free] > 0.0) | (net[free] < 0.0)]
        J = np.empty((len(on) + 1, len(on) + 1))
        J[:-1, :-1] = local[on][:, on].toarray() + gap[on] @ K[:, on]
        J[:-1, -1] = gap[on] @ np.ones(nx * ny)
        J[-1, :-1], J[-1, -1] = area[on], 0.0
        scale = np.r_[np.full(len(on), u * H * dy), W]
        columns = np.r_[np.full(len(on), p_h), H]
        right = np.r_[net[on], area @ p - W]
        change = -columns * dense_solve(J * columns / scale[:, None], right / scale)
        off = np.setdiff1d(free, on)
        p[off] = 0.0
        p[on] = np.maximum(p[on] + change[:-1], 0.0)
        h0 += change[-1]
        if np.abs(change[:-1]).max() < 1e-9 * p_h and abs(change[-1]) < 1e-9 * H:
            h = (h0 + (xx**2 + yy**2) / (2.0 * R) + K @ p).reshape(nx, ny)
            return float(np.interp(0.0, x, h[:, 0])), _smallest(x, y, h)
    raise RuntimeError("the dense film did not converge")
