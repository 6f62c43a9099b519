"""Python's thread state for a thread of the host, held from one FMI call to the next.

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
    """Return an object that identifies the calling thread; thread numbers may be reused."""
    if not hasattr(_PRESENT, "thread"):
        _PRESENT.thread = object()
    thread: object = _PRESENT.thread
    return thread


class HostThread:
    """The thread state that one slave holds.

    Notes
    -----
    Not to be held in the first call into Python: `threading` takes the thread that imports it for
    the main one, and at its end Python waits for the state that this thread has then.
    """

    def __init__(self) -> None:
        self._held: object | None = None

    def hold(self) -> None:
        """Hold the state of the calling thread until `release`."""
        if self._held is None:
            self._held = _this_thread()
            ctypes.pythonapi.PyGILState_Ensure()

    def release(self) -> None:
        """Release the state; if called from another thread, leave it until Python ends."""
        if self._held is not None and self._held is _this_thread():
            ctypes.pythonapi.PyGILState_Release(_LOCKED)
        self._held = None
