"""Error of a film's time step, estimated as the film is marched."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.grid_error import LARGE_ERROR

# of the third difference of what a node stores, that a step adds to its error
_SHARES = {"bdf2": 1.0 / 3.0, "crank_nicolson": -1.0 / 12.0}
_FIRST_SHARE = 0.5  # of the first difference, where a march starts from rest by backward Euler
_STIFF = 0.1  # of the largest pressure: above, flow by pressure is negligible
_THIN = 1.1  # times the smallest film: where an error may move it
SAFETY_IN_TIME = 2.5


class TimeError:
    """Error of rho h that time steps leave, carried on with the oil.

    de/dt + u de/dx = c dt^2 d3(rho h)/dt3

    Parameters
    ----------
    scheme
        "bdf2" (c = 1/3; its first step is of backward Euler) or "crank_nicolson" (c = -1/12).
    x : ndarray, shape (nx,)
        Places along the motion, rising, any unit.
    masses : ndarray, shape (n, ny, nx)
        rho h at the last times, newest first, any unit; n from 1 at the start to 3.
    error : ndarray, shape (ny, nx), or None
        That of rho h now; None: none yet.

    Notes
    -----
    Embedded: it needs no further film, only what the last steps stored. Each step adds its
    local error, of the third difference in time ([hairer_norsett_wanner_1993]), to what the oil
    brings along from upstream. Upstream of the largest pressure of a row, where the pressure is
    below a tenth of the largest, the film follows the gap and remembers nothing. Kinks that move
    with a gap cost more than a smooth film does, for which a factor of 2.5 stands.
    """

    def __init__(self, scheme: str, x: Array, masses: Array, error: Array | None = None) -> None:
        self._scheme = scheme
        self._x = np.asarray(x, dtype=np.float64)
        self.masses = np.array(masses)
        self.error = np.zeros(self.masses.shape[1:]) if error is None else np.array(error)

    def step(self, mass: Array, pressure: Array, way: Array) -> None:
        """Take up a time step.

        Parameters
        ----------
        mass, pressure : ndarray, shape (ny, nx)
            rho h in the unit of the start, and pressure in any, at the new time.
        way : ndarray, shape (ny,)
            That the oil of a row went in the step, in the unit of x.
        """
        m = [mass, *self.masses]
        share = _SHARES[self._scheme]
        if len(m) == 2:
            added = (_FIRST_SHARE if self._scheme == "bdf2" else share) * (m[0] - m[1])
        elif len(m) == 3:
            added = share * (m[0] - 2.0 * m[1] + m[2])
        else:
            added = share * (m[0] - 3.0 * m[1] + 3.0 * m[2] - m[3])
        nodes, peak = np.arange(self._x.size), pressure.argmax(axis=1)[:, None]
        behind = np.where(way[:, None] < 0.0, nodes < peak, nodes > peak)
        stiff = (pressure > _STIFF * pressure.max()) | (behind & (pressure > 0.0))
        carried = _cubic(self._x, self.error, self._x - way[:, None])
        self.error = np.where(stiff, carried + added, 0.0)
        self.masses = np.array(m[:3])

    def of_smallest_film(self, film: Array) -> float:
        """Return the estimated relative error of the smallest film [-].

        Parameters
        ----------
        film : ndarray, shape (ny, nx)
            h at the time of the last step, in any unit.

        Notes
        -----
        The largest over the nodes whose film is within a tenth of the smallest.
        """
        least = float(film.min())
        if not least > 0.0:
            return math.nan
        thin = film <= _THIN * least
        return SAFETY_IN_TIME * float((np.abs(self.error[thin]) / self.masses[0][thin]).max())


def time_error_sentence(time_error: float) -> str:
    """Return a warning where the estimated error of the time step is large, or nothing."""
    if not time_error > LARGE_ERROR:
        return ""
    return (
        f" The time steps cost the smallest film an estimated {100.0 * time_error:.2g} %: take "
        "shorter ones."
    )


def _cubic(x: Array, values: Array, at: Array) -> Array:
    """Return rows of `values` (ny, nx) at places (ny, nx), by cubics through four nodes.

    A linear interpolation in every one of many short steps would smear the error away. Outside x:
    the value on the border.
    """
    at = np.clip(at, x[0], x[-1])
    first = np.clip(np.searchsorted(x, at) - 2, 0, x.size - 4)
    rows = np.arange(values.shape[0])[:, None]
    found = np.zeros(at.shape)
    for k in range(4):
        weight = np.ones(at.shape)
        for other in range(4):
            if other != k:
                weight *= (at - x[first + other]) / (x[first + k] - x[first + other])
        found += weight * values[rows, first + k]
    return found
