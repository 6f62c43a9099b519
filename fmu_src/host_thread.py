"""Python's state of a thread of the host, kept from one FMI call to the next.

Every call of pythonfmu's wrapper asks for that state and gives it back (PyGILState_Ensure and
PyGILState_Release). In a thread that Python has not started this destroys it: each call makes a new
one, with a stack of its own, which takes several times as long as to set or read some values.
"""

from __future__ import annotations

import ctypes
import threading

_LOCKED = 0  # PyGILState_STATE of a thread that goes on holding the interpreter's lock
_PRESENT = threading.local()


def _this_thread() -> object:
    """Return an object that stands for the calling thread; its number may come again."""
    if not hasattr(_PRESENT, "thread"):
        _PRESENT.thread = object()
    thread: object = _PRESENT.thread
    return thread


class HostThread:
    """What one slave holds.

    Notes
    -----
    Not to be held in the first call into Python: `threading` takes the thread that imports it for
    the main one, and at its end Python waits for the state that this thread has then.
    """

    def __init__(self) -> None:
        self._held: object | None = None

    def hold(self) -> None:
        """Keep the state of the calling thread until `release`."""
        if self._held is None:
            self._held = _this_thread()
            ctypes.pythonapi.PyGILState_Ensure()

    def release(self) -> None:
        """Give the state back; in another thread leave it to the end of Python."""
        if self._held is not None and self._held is _this_thread():
            ctypes.pythonapi.PyGILState_Release(_LOCKED)
        self._held = None
