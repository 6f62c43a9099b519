"""Friction of a point contact's film along its sliding."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.line.traction import fill_mean_stress
from gearlube_core.oil.film_oil import FilmOil, film_properties


class PointTraction(NamedTuple):
    """Shear of a point contact's film; arrays (nx, ny)."""

    viscosity: Array  # [Pa s]
    density: Array  # [kg/m3]
    mean_stress: Array  # at mid-film, along the sliding velocity [Pa]
    force: float  # of the mid-film stress along the sliding velocity [N]


def point_traction(
    x: Array,
    y: Array,
    pressure: Array,
    film: Array,
    sliding: tuple[float, float],
    oil: FilmOil,
    fill: Array | None = None,
    *,
    closed: bool = False,
) -> PointTraction:
    """Return the shear stress at mid-film, along the velocity of body 2 against body 1.

    tau_m = eta |du|/h, or tau0 asinh(a s/sinh s) with s = h (dp/ds)/(2 tau0), at most the limit

    Parameters
    ----------
    x, y : ndarray, shapes (nx,) and (ny,)
        Nodes [m].
    pressure, film : ndarray, shape (nx, ny)
        p [Pa] and h [m].
    sliding
        u_2 - u_1 along x and y [m/s].
    oil
        Newtonian where its Eyring stress is zero.
    fill : ndarray, shape (nx, ny)
        Share of the gap that holds oil [-], which sheared streaks fill; None: 1.
    closed
        The rows are cells between closed sides, see `Sides`.

    Notes
    -----
    Stress across the sliding, from the pressure's slope there, is left out of Eyring's law. Where
    the film is broken and no fill is given the gap counts as full of oil at ambient pressure.
    Source: [jamali_2015 (3.29a)] [jamali_2015 (3.31)] along the sliding.
    """
    shape, p = pressure.shape, np.ascontiguousarray(pressure).ravel()
    eta, _, rho, _ = film_properties(oil, p)
    tau = np.empty(p.size)
    speed = math.hypot(*sliding)
    along = (sliding[0] / speed, sliding[1] / speed) if speed > 0.0 else (1.0, 0.0)
    slopes = np.gradient(pressure, x, y)
    slope = np.ascontiguousarray(along[0] * slopes[0] + along[1] * slopes[1]).ravel()
    h = np.ascontiguousarray(film).ravel()
    void = np.zeros(p.size) if fill is None else np.ascontiguousarray(1.0 - fill).ravel()
    fill_mean_stress(p, slope, h, void, eta, speed, oil, tau)
    stress = tau.reshape(shape)
    across = stress.sum(axis=1) * (y[1] - y[0]) if closed else np.trapezoid(stress, y, axis=1)
    force = float(np.trapezoid(across, x))
    return PointTraction(eta.reshape(shape), rho.reshape(shape), stress, force)
