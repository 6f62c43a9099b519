"""An Eyring film in time that slides at an angle to its axes: its mass balance, and its rest."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.oil.film_oil import density, viscosity
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.oil.shear_flow import shear_flow

R, W, MODULUS, TAU0 = 0.0125, 15.0, 55e9, 5e5
OIL = film_oil(eta0=0.05, alpha=15e-9, eyring_stress=TAU0)
SHAPE = EllipticParaboloid(R, R)
A = (0.75 * W * R / MODULUS) ** (1.0 / 3.0)  # Hertz radius [m]
ENTRAINED, SLIDING = (0.5, 0.3), (-0.2, 0.4)  # m/s
SLIP = math.hypot(*SLIDING)
C, S = SLIDING[0] / SLIP, SLIDING[1] / SLIP
STEP = A / (10.0 * ENTRAINED[0])
LIMITS = (-2.5 * A, 2.0 * A)
NODES = (49, 49)
STRICT = PointSolverSettings(wedge="central", tolerance=1e-9)


def marched(gap=lambda x, y, time: 0.0 * x * y):
    def conditions(x, y, time):
        (u, v), (slip, side) = ENTRAINED, SLIDING
        h = SHAPE(x[:, None], y[None, :]) + gap(x[:, None], y[None, :], time)
        speeds = np.full(y.size, u - 0.5 * slip), np.full(y.size, u + 0.5 * slip)
        return FilmConditions(h, W, *speeds, slope=v / u, side_sliding=side)

    film = MovingFilm(
        conditions=conditions, lubricant=OIL, contact_modulus=MODULUS, x_limits=LIMITS,
        y_limits=LIMITS, nodes=NODES, hertz=SHAPE, load=W, speed=ENTRAINED[0],
    )  # fmt: skip
    return FilmMarch(film, STEP, settings=STRICT)


def bump(x, y, time):
    centre = -1.3 * A + ENTRAINED[0] * time
    return -3e-8 * np.exp(-(((x - centre) / (0.3 * A)) ** 2) - (y / A) ** 2)


def test_a_march_under_lasting_conditions_is_the_steady_solvers_film():
    problem = PointContactProblem(
        gap=SHAPE, entrainment=ENTRAINED, sliding=SLIDING, load=W, contact_modulus=MODULUS,
        lubricant=OIL, x_limits=LIMITS, y_limits=LIMITS, nodes=NODES, hertz=SHAPE,
    )  # fmt: skip
    steady = solve_point_contact(problem, STRICT)
    march = marched()
    for _ in range(4):
        later = march.step()
    # both leave 1e-9 of the flow unbalanced, which a step gathers
    loaded = steady.pressure > 0.0
    assert later.film[loaded] == pytest.approx(steady.film[loaded], rel=1e-6)
    assert later.pressure == pytest.approx(steady.pressure, abs=1e-6 * steady.pressure.max())


def test_oil_in_a_box_grows_by_what_flows_in():
    """Balance of a box from pressure and film alone, first step (backward Euler)."""
    march = marched(bump)
    before, after = march.solution, march.step()
    x, y, p, h = after.x, after.y, after.pressure, after.film
    dx, dy = x[1] - x[0], y[1] - y[0]
    eta = np.vectorize(lambda q: viscosity(OIL, q))(p)
    m = np.vectorize(lambda q: density(OIL, q))(p) * h
    m_before = np.vectorize(lambda q: density(OIL, q))(before.pressure) * before.film
    i0, i1, j0, j1 = 12, 28, 18, 29  # from the inlet into the contact
    inside = np.s_[i0 : i1 + 1, j0 : j1 + 1]
    assert (p[i0 - 2 : i1 + 3, j0 - 2 : j1 + 3] > 0.0).all()
    gained = (m - m_before)[inside].sum() * dx * dy / STEP

    slope_x, slope_y = np.zeros_like(p), np.zeros_like(p)
    slope_x[1:-1] = (p[2:] - p[:-2]) / (2.0 * dx)
    slope_y[:, 1:-1] = (p[:, 2:] - p[:, :-2]) / (2.0 * dy)
    xx, xy, yy = (np.zeros_like(p) for _ in range(3))
    for i, j in np.ndindex(p.shape):
        s, r = C * slope_x[i, j] + S * slope_y[i, j], C * slope_y[i, j] - S * slope_x[i, j]
        half = 0.5 * h[i, j] / TAU0
        flow = shear_flow(
            OIL.shear, half * s, half * r, eta[i, j] * SLIP / (h[i, j] * TAU0), math.inf
        )
        xx[i, j] = C * C * flow.along + S * S * flow.across
        yy[i, j] = S * S * flow.along + C * C * flow.across
        xy[i, j] = C * S * (flow.along - flow.across)
    cubic = m * h**2 / 12.0

    def through(face, other, speed, step, factor, slope):
        """Mass flow per width through the faces between two rows of nodes."""
        f, g = factor[face] / eta[face], factor[other] / eta[other]
        log_mean = np.where(np.isclose(f, g, rtol=1e-9), f, (f - g) / np.log(f / g))
        mean = np.where(p[other] > p[face], log_mean, 0.5 * (f + g))
        straight = np.sqrt(cubic[face] * cubic[other]) * mean
        ratio = xy / np.where(factor == 0.0, 1.0, factor)
        askew = straight * 0.25 * (ratio[face] + ratio[other]) * (slope[face] + slope[other])
        carried = speed * 0.5 * (m[face] + m[other])
        pumped = straight * (p[other] - p[face]) / step
        return float((carried - pumped - askew).sum()), float(np.abs(askew).sum() / carried.sum())

    def along_x(i):
        j = slice(j0, j1 + 1)
        return through((i, j), (i + 1, j), ENTRAINED[0], dx, xx, slope_y)

    def along_y(j):
        i = slice(i0, i1 + 1)
        return through((i, j), (i, j + 1), ENTRAINED[1], dy, yy, slope_x)

    (west, share), (east, _) = along_x(i0 - 1), along_x(i1)
    (south, _), (north, _) = along_y(j0 - 1), along_y(j1)
    inflow = (west - east) * dy + (south - north) * dx
    # what flows askew to the slope of pressure is hundreds of times what may be missing
    assert share > 3e-5
    # residual of the step over the flow through the contact
    assert gained == pytest.approx(inflow, abs=1e-7 * west * dy)
