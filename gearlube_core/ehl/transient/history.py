"""Film at earlier times: the stored oil, and the starting film of a time step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import shift

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.ehl.point.start.nested import zero_border
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.errors import ParameterError

SCHEMES = ("bdf2", "crank_nicolson")


def check_scheme(scheme: str, discretisation: str) -> None:
    """Refuse a scheme of the storage term that is none or that a discretisation does not have.

    Raises
    ------
    ParameterError

    Notes
    -----
    "crank_nicolson" needs the flow of the step before at each node on its own; elements share
    what is stored between nodes.
    """
    check_option("scheme", scheme, SCHEMES)
    if scheme == "crank_nicolson" and discretisation == "elements":
        raise ParameterError(
            "differences are needed for scheme crank_nicolson, got elements. Take bdf2 or "
            "differences."
        )


@dataclass(slots=True)
class FilmHistory:
    """Film at the last two times, in units of the scales; arrays of shape (ny, nx) [-]."""

    state: FilmState
    mass: Array  # rho h now
    mass_before: Array
    inflow: Array  # of every node now, without storage
    rise: tuple[Array, float] | None  # of pressure and approach in the last step; None: no step yet

    def storage(self, scheme: str, step: float, first: bool) -> tuple[Array | float, Array]:
        """Return the rate at which rho h is stored and what is stored already.

        Parameters
        ----------
        scheme
            "bdf2", whose `first` step is a backward Euler step, or "crank_nicolson".
        step
            Time step over the unit of times [-].
        """
        if scheme == "crank_nicolson":
            # where there was no pressure the flow of before was not balanced
            loaded = self.state.pressure > 0.0
            rate = np.where(loaded, 2.0, 1.0) / step
            return rate, rate * self.mass + np.where(loaded, self.inflow, 0.0)
        if first:
            return 1.0 / step, self.mass / step
        return 1.5 / step, (2.0 * self.mass - 0.5 * self.mass_before) / step

    def predicted(self) -> tuple[Array, float]:
        """Return the pressure and the approach if both go on to change as in the last step."""
        state = self.state
        if self.rise is None:
            return state.pressure, state.approach
        return self._open(state.pressure + self.rise[0]), state.approach + self.rise[1]

    def carried(self, smooth: Array, nodes: float) -> Array:
        """Return the pressure if what differs from a smooth one moves along.

        Parameters
        ----------
        smooth : ndarray, shape (ny, nx)
            Pressure without roughness [-].
        nodes
            Way of the oil along x in the time step, in nodes.
        """
        pressure = self.state.pressure
        moved = shift(pressure - smooth, (0.0, nodes), order=3, mode="nearest")
        return self._open(smooth + moved)

    def _open(self, predicted: Array) -> Array:
        """Return a pressure that keeps its front: closed nodes would open one by one again."""
        pressure = self.state.pressure
        return zero_border(np.where(pressure > 0.0, np.maximum(predicted, 0.5 * pressure), 0.0))
