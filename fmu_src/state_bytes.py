"""The state of a slave as bytes; another process can continue from them, bit for bit."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from uuid import UUID

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

_MAGIC = b"gearlube"
_FORMAT = 1
# magic, format, GUID, phase, time [s], number of values, length of the model state, CRC-32 of both
_HEADER = struct.Struct("<8sI16sIdIII")


@dataclass(frozen=True, slots=True, kw_only=True)
class Snapshot:
    """Saved state of a slave.

    Parameters
    ----------
    phase : int
        Place in the FMI state machine.
    time : float
        Communication point [s].
    values : ndarray, shape (variables,)
        Every variable, in its FMI unit.
    model : ndarray, shape (n,)
        State of the model; empty before initialisation.
    """

    phase: int
    time: float
    values: Array
    model: Array

    def to_bytes(self, guid: UUID) -> bytes:
        """Return the snapshot, marked with the GUID of the FMU it belongs to."""
        values = np.ascontiguousarray(self.values, dtype="<f8").tobytes()
        model = np.ascontiguousarray(self.model, dtype="<f8").tobytes()
        checksum = zlib.crc32(model, zlib.crc32(values))
        header = _HEADER.pack(
            _MAGIC, _FORMAT, guid.bytes, self.phase, self.time,
            len(self.values), len(self.model), checksum,
        )  # fmt: skip
        return header + values + model

    @classmethod
    def from_bytes(cls, content: bytes, guid: UUID) -> Snapshot:
        """Return the snapshot in `content`; raise ParameterError if damaged or of another FMU."""
        if len(content) < _HEADER.size or content[: len(_MAGIC)] != _MAGIC:
            raise ParameterError("The FMU state was not written by a gearlube FMU.")
        _, form, owner, phase, time, n_values, n_model, checksum = _HEADER.unpack_from(content)
        if form != _FORMAT:
            raise ParameterError(
                f"The FMU state must have format {_FORMAT}, got {form}. "
                "Save it again with this version of gearlube."
            )
        if owner != guid.bytes:
            raise ParameterError(
                f"The FMU state must come from the FMU with GUID {guid}, "
                f"got {UUID(bytes=owner)}. Restore it in the FMU that wrote it."
            )
        numbers = content[_HEADER.size :]
        if len(numbers) != 8 * (n_values + n_model) or zlib.crc32(numbers) != checksum:
            raise ParameterError("The FMU state is damaged: length or checksum do not agree.")
        data = np.frombuffer(numbers, dtype="<f8").astype(np.float64)
        return cls(phase=phase, time=time, values=data[:n_values], model=data[n_values:])
