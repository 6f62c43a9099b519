"""A second solver of the film in a line contact: dense matrices, plain Newton.

It shares no code with `gearlube_core.ehl`; see `dense_point_film`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Cylinder(NamedTuple):
    """A cylinder on a plane entrained along x, Roelands and Dowson and Higginson; SI units."""

    radius: float
    line_load: float
    speed: float
    reduced_modulus: float  # E'
    eta0: float
    alpha: float


def film(line: Cylinder, nodes: int, limits: tuple[float, float]) -> tuple[float, float]:
    """Return central and smallest film [m] on a domain given in half widths of the dry contact."""
    R, w, u, E, eta0, alpha = line
    b = np.sqrt(8.0 * w * R / (np.pi * E))
    p_h = 2.0 * w / (np.pi * b)
    x = np.linspace(limits[0] * b, limits[1] * b, nodes)
    dx = x[1] - x[0]

    def integral(s: np.ndarray) -> np.ndarray:  # of ln abs(s), of s over b
        return np.asarray(s * (np.log(np.abs(s) / b) - 1.0))

    away = x[:, None] - x[None, :]
    K = -4.0 / (np.pi * E) * (integral(away + 0.5 * dx) - integral(away - 0.5 * dx))
    step = np.diff(np.eye(nodes), axis=0)
    mean = 0.5 * np.abs(step)
    carry = 1.5 * np.eye(nodes)[:-1] - 0.5 * np.eye(nodes, k=-1)[:-1]
    carry[0, 0] = 1.0
    inner = slice(1, -1)
    net_of = np.zeros((nodes, nodes - 1))
    net_of[inner] = step.T[inner] * -1.0

    log_ratio = np.log(eta0) + 9.67
    Z = alpha / (5.1e-9 * log_ratio)
    p = p_h * np.sqrt(np.maximum(0.0, 1.0 - (x / b) ** 2))
    H = 3.0 * R * np.sqrt(2.0 * eta0 * u / (E * R))
    shape = x**2 / (2.0 * R)
    h0 = H - np.interp(0.0, x, shape + K @ p)
    for _ in range(80):
        h = h0 + shape + K @ p
        hollow = np.maximum(h, 1e-3 * H)
        eta = eta0 * np.exp(log_ratio * ((1.0 + 5.1e-9 * p) ** Z - 1.0))
        rate = log_ratio * Z * 5.1e-9 * (1.0 + 5.1e-9 * p) ** (Z - 1.0)
        rho = (1.0 + 2.266e-9 * p) / (1.0 + 1.683e-9 * p)
        slope = (2.266e-9 - 1.683e-9) / (1.0 + 1.683e-9 * p) ** 2
        eps = rho * hollow**3 / (12.0 * eta)
        grad = step @ p / dx
        net = net_of @ (u * (carry @ (rho * h)) - (mean @ eps) * grad)
        by_gap = u * carry * rho - grad[:, None] * mean * (3.0 * eps / hollow * (h > 1e-3 * H))
        local = (
            u * carry * (slope * h)
            - grad[:, None] * mean * (eps * (slope / rho - rate))
            - (mean @ eps)[:, None] * step / dx
        )
        on = np.flatnonzero((p > 0.0) | (net < 0.0))
        on = on[(on > 0) & (on < nodes - 1)]
        J = np.zeros((len(on) + 1, len(on) + 1))
        J[:-1, :-1] = net_of[on] @ (local[:, on] + by_gap @ K[:, on])
        J[:-1, -1] = (net_of @ by_gap.sum(axis=1))[on]
        J[-1, :-1] = dx
        scale, columns = np.r_[np.full(len(on), u * H), w], np.r_[np.full(len(on), p_h), H]
        right = np.r_[net[on], dx * p.sum() - w] / scale
        change = -columns * np.linalg.solve(J * columns / scale[:, None], right)
        kept = np.zeros(nodes)
        kept[on] = np.maximum(p[on] + change[:-1], 0.0)
        p = kept
        h0 += change[-1]
        if np.abs(change[:-1]).max() < 1e-9 * p_h and abs(change[-1]) < 1e-9 * H:
            h = h0 + shape + K @ p
            i = int(h.argmin())
            bend, lean, least = np.polyfit(x[i - 1 : i + 2] - x[i], h[i - 1 : i + 2], 2)
            return float(np.interp(0.0, x, h)), float(least - 0.25 * lean**2 / bend)
    raise RuntimeError("the dense film did not converge")
