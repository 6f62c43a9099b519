"""Ctrl-C that takes effect only between tasks."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType


@dataclass(slots=True)
class Interrupt:
    """Whether someone has pressed Ctrl-C."""

    requested: bool = False


@contextmanager
def deferred_interrupts() -> Iterator[Interrupt]:
    """Turn the first Ctrl-C into a flag; a second one raises KeyboardInterrupt.

    An exception at an arbitrary place could leave a lock of the NetCDF library held, and the next
    write would wait for ever. Outside the main thread, where signals do not arrive, the flag
    stays down.
    """
    interrupt = Interrupt()
    if threading.current_thread() is not threading.main_thread():
        yield interrupt
        return
    previous = signal.getsignal(signal.SIGINT) or signal.default_int_handler

    def request(_number: int, _frame: FrameType | None) -> None:
        if interrupt.requested:
            raise KeyboardInterrupt
        interrupt.requested = True

    signal.signal(signal.SIGINT, request)
    try:
        yield interrupt
    finally:
        signal.signal(signal.SIGINT, previous)
