"""States of an FMI 2.0 co-simulation slave."""

from __future__ import annotations

from enum import IntEnum


class SlaveState(IntEnum):
    """State of a slave in the FMI state machine."""

    INSTANTIATED = 0
    INITIALISING = 1
    STEPPING = 2
    TERMINATED = 3

    @property
    def settable(self) -> tuple[str, ...]:
        """Causalities that can be set: parameters until initialised, nothing once terminated."""
        if self == SlaveState.TERMINATED:
            return ()
        return ("input",) if self == SlaveState.STEPPING else ("input", "parameter")
