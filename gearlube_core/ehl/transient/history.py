"""Film at earlier times: the stored oil, and the starting film of a time step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.start.nested import zero_border
from gearlube_core.ehl.point.terms.state import FilmState


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
        pressure = np.where(
            state.pressure > 0.0,
            np.maximum(state.pressure + self.rise[0], 0.5 * state.pressure),
            0.0,
        )
        return zero_border(pressure), state.approach + self.rise[1]
