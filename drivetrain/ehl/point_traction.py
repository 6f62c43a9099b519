"""Friction of a point contact's film along its sliding."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlube_core.ehl.line_traction import fill_mean_stress
from gearlube_core.ehl.lubricant import fill_properties
from gearlube_core.ehl.solution import PointSolution

Array = NDArray[np.float64]


class PointTraction(NamedTuple):
    """Shear of a point contact's film; arrays (nx, ny)."""

    viscosity: Array  # [Pa s]
    density: Array  # [kg/m3]
    mean_stress: Array  # at mid-film, along the sliding velocity [Pa]
    force: float  # of the mid-film stress along the sliding velocity [N]


def point_traction(solution: PointSolution, sliding: tuple[float, float]) -> PointTraction:
    """Return the shear stress at mid-film, along the velocity of body 2 against body 1.

    tau_m = eta |du|/h, or tau0 asinh(a s/sinh s) with s = h (dp/ds)/(2 tau0), at most the limit

    Parameters
    ----------
    solution
        Film of the contact.
    sliding
        u_2 - u_1 along x and y [m/s].

    Notes
    -----
    Stress across the sliding, from the pressure's slope there, is left out of Eyring's law. Where
    the film is broken the gap counts as full of oil at ambient pressure.
    Source: Jamali 2015 eq. (3.29a), (3.31), along the sliding.
    """
    problem = solution.problem
    p, oil = solution.pressure.ravel(), problem.lubricant
    eta, eta_slope, rho, rho_slope = (np.empty(p.size) for _ in range(4))
    fill_properties(oil, p, eta, eta_slope, rho, rho_slope)
    speed = math.hypot(*sliding)
    along = (sliding[0] / speed, sliding[1] / speed) if speed > 0.0 else (1.0, 0.0)
    slopes = np.gradient(solution.pressure, problem.x, problem.y)
    slope = along[0] * slopes[0] + along[1] * slopes[1]
    tau = np.empty(p.size)
    film = np.ascontiguousarray(solution.film).ravel()
    fill_mean_stress(p, slope.ravel(), film, np.zeros(p.size), eta, speed, oil, tau)
    shape = solution.pressure.shape
    mean_stress = tau.reshape(shape)
    force = np.trapezoid(np.trapezoid(mean_stress, problem.y, axis=1), problem.x)
    return PointTraction(eta.reshape(shape), rho.reshape(shape), mean_stress, float(force))
