"""Film at earlier times: the stored oil, and the starting film of a time step."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from scipy.ndimage import shift

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.ehl.point.start import zero_border
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.storage.atomic_file import read_arrays, write_arrays

SCHEMES = ("bdf2", "crank_nicolson")


@dataclass(frozen=True, slots=True, kw_only=True)
class MarchRecord:
    """State of a march after a step, in the units of its scales; arrays of shape (ny, nx)."""

    steps: int
    start_time: float  # [s]
    time_step: float  # [s]
    scheme: str
    positions: Array  # of the nodes along x over the unit of lengths, shape (nx,)
    pressure: Array
    approach: float
    start_pressure: Array
    masses: Array  # rho h now and at up to two times before, newest first, shape (n, ny, nx)
    mass_error: Array  # of rho h by the time steps so far
    inflow: Array
    rise: Array  # of the pressure in the last step
    approach_rise: float
    curves: Array  # what a caller has gathered so far, any shape
    kept_steps: Array  # whole solutions that a caller keeps: their numbers, shape (m,)
    kept_fields: Array  # pressure [Pa] and film [m], shape (m, 2, nx, ny)
    kept_values: Array  # the numbers of `FilmSolution`, shape (m, 9)

    def write(self, path: Path | str) -> None:
        """Write the record; an older one at `path` stays whole until the new one is complete."""
        write_arrays(Path(path), asdict(self))

    @classmethod
    def read(cls, path: Path | str) -> MarchRecord:
        """Return the record in a file.

        Raises
        ------
        ParameterError
            The file is not such a record.
        """
        try:
            stored = read_arrays(Path(path))
            values = {name: stored[name] for name in cls.__dataclass_fields__}
        except (FileError, KeyError) as error:
            lack = f"one without {error}" if isinstance(error, KeyError) else "a damaged one"
            raise ParameterError(
                f"{path} must be the record of a march, got {lack}. Remove it and run again: the "
                "march starts from the beginning. Films that were kept stay."
            ) from error
        return cls(**{k: v.item() if v.ndim == 0 else v for k, v in values.items()})


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
