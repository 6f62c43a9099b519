"""Record of a march in one file: all data that the next step needs."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path

from gearlube_core.arrays import Array
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.storage.atomic_file import read_arrays, write_arrays


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
