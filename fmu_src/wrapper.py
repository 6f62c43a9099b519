"""Protection against errors of pythonfmu 0.7's compiled wrapper in handling Python objects.

pythonfmu's `PySlaveInstance.cpp` has four habits that its Python side must balance:

* `findClass` releases the dictionary of the slave module, which it has only borrowed. After a few
  instantiations the dictionary is freed while in use.
* When a method raises, the wrapper releases instance, class and log queue and reports fmi2Fatal,
  but keeps the pointers. The next call, even fmi2FreeInstance, then works on freed memory.
* fmi2FreeInstance destroys the logger before the slave, which then sends it the messages still in
  the queue. The queue is emptied after each call, but not after instantiation.
* On Linux the library stays loaded after fmi2FreeInstance, dlclose or not: it exports unique
  symbols. When the process exits, the destructor of its static `pyState` ends Python, if it was
  the wrapper that started it, and that after the destructors of every library loaded since. Python
  then frees objects of extension modules whose C++ side is gone (SciPy's made with pybind11), and
  the process crashes. Wherever Python comes from, the unload hook then releases `pyState` a second
  time: it counts down a word of a freed block. Where that word is a link of glibc's free list, the
  process aborts with "corrupted double-linked list".

The first two are balanced by one more reference, given just before the wrapper takes it; the third
by queueing what the constructor has to say in the first call that follows; the fourth by running
the unload hook ahead of these destructors. It ends Python while all libraries live, and leaves no
pointer behind for a second release.

Python's thread state for a thread of the host, held from one FMI call to the next.

Every call of pythonfmu's wrapper asks for that state and gives it back (PyGILState_Ensure and
PyGILState_Release). In a thread that Python has not started this destroys it: each call makes a new
one, with a stack of its own, which takes several times as long as to set or read some values.
"""

from __future__ import annotations

import ctypes
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, wraps
from pathlib import Path
from typing import Any, Concatenate, ParamSpec, TypeVar

_LOCKED = 0  # PyGILState_STATE of a thread that goes on holding the interpreter's lock
_PRESENT = threading.local()
_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


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


def give_reference(*objects: Any) -> None:
    """Add one reference to each of `objects`, for the wrapper to release."""
    for each in objects:
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(each))


def forget_search_path(resources: str) -> None:
    """Undo the `sys.path` entry that the wrapper adds at every instantiation."""
    while resources in sys.path:
        sys.path.remove(resources)


def unload_before_libraries(resources: str) -> None:
    """Run the wrapper's unload hook at exit, before the destructors of libraries loaded by now.

    Parameters
    ----------
    resources : str
        Of the FMU that has been instantiated, all that it imports included.

    Notes
    -----
    Exit handlers run in the reverse order of their registration, so the hook is registered again
    when modules were imported since. It must not be registered later than in fmi2Instantiate: what
    a host registers after that may still free the instance. Nothing is done on Windows, which runs
    the hook before the static destructors and, at the end of a process, without other threads.
    """
    if sys.platform.startswith("linux"):
        _register_hooks(resources, len(sys.modules))


@cache
def _register_hooks(resources: str, modules: int) -> None:
    c_library = ctypes.CDLL(None)
    at_exit = c_library["__cxa_atexit"]
    at_exit.argtypes = 3 * [ctypes.c_void_p]
    for hook in _unload_hooks(c_library):
        at_exit(hook, None, None)


def _unload_hooks(c_library: ctypes.CDLL) -> Iterator[int]:
    """Yield the unload hook of every loaded wrapper: any of them may have started Python."""
    c_library.dlopen.argtypes = [ctypes.c_char_p, ctypes.c_int]
    c_library.dlsym.argtypes = [ctypes.c_void_p, ctypes.c_char_p]
    c_library.dlclose.argtypes = [ctypes.c_void_p]
    c_library.dlopen.restype = c_library.dlsym.restype = ctypes.c_void_p
    for path in _loaded_libraries():
        handle = c_library.dlopen(os.fsencode(path), os.RTLD_NOLOAD | os.RTLD_LAZY)
        hook = c_library.dlsym(handle, b"finalizePythonInterpreter") if handle else None
        if hook:
            yield hook  # The handle stays: the library has to be there at exit.
        elif handle:
            c_library.dlclose(handle)


def _loaded_libraries() -> list[str]:
    mapped = Path("/proc/self/maps").read_text(errors="surrogateescape").splitlines()
    paths = (line.split(maxsplit=5)[5] for line in mapped if ".so" in line and " r-xp " in line)
    return list(dict.fromkeys(paths))


@contextmanager
def told_on_stderr(instance: str) -> Iterator[None]:
    """Write the reason of a failed instantiation to standard error; the wrapper only logs it.

    A host that has not asked for logging would see no more than a null pointer.
    """
    try:
        yield
    except BaseException as error:
        if sys.stderr is not None:
            reason = f"{type(error).__name__}: {error}"
            sys.stderr.write(f"{instance} could not be instantiated. {reason}\n")
            sys.stderr.flush()
        raise


def guarded(
    method: Callable[Concatenate[Any, _Arguments], _Result],
) -> Callable[Concatenate[Any, _Arguments], _Result]:
    """Report what `method` of a slave raises, and leave the wrapper valid objects to release."""

    @wraps(method)
    def call(slave: Any, *args: _Arguments.args, **kwargs: _Arguments.kwargs) -> _Result:
        try:
            return method(slave, *args, **kwargs)
        except BaseException as error:
            slave.report_fatal(error)
            give_reference(slave, type(slave), slave.log_queue)
            raise

    return call
