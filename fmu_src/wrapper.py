"""How the compiled wrapper of pythonfmu 0.7 treats Python objects, and what keeps it from crashing.

pythonfmu's `PySlaveInstance.cpp` has four habits that its Python side must balance:

* `findClass` releases the dictionary of the slave module, which it has only borrowed. After a few
  instantiations the dictionary is freed while in use.
* When a method raises, the wrapper releases instance, class and log queue and reports fmi2Fatal,
  but keeps the pointers. The next call, even fmi2FreeInstance, then works on freed memory.
* fmi2FreeInstance destroys the logger before the slave, which then sends it the messages still in
  the queue. The queue is emptied after each call, but not after instantiation.
* On Linux the library stays loaded after fmi2FreeInstance, dlclose or not: it exports unique
  symbols. When the process exits, the destructor of its static `pyState` runs before its unload
  hook, which then releases that object a second time: it counts down a word of a freed block. Where
  that word is a link of glibc's free list, the process aborts with "corrupted double-linked list".

The first two are balanced by one more reference, given just before the wrapper takes it; the third
by queueing what the constructor has to say in the first call that follows; the fourth by running
the unload hook while Python ends. It leaves no pointer behind for a second release.
"""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache, wraps
from pathlib import Path
from typing import Any, Concatenate, ParamSpec, TypeVar

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


def give_reference(*objects: Any) -> None:
    """Add one reference to each of `objects`, for the wrapper to release."""
    for each in objects:
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(each))


def forget_search_path(resources: str) -> None:
    """Undo the `sys.path` entry that the wrapper adds at every instantiation."""
    while resources in sys.path:
        sys.path.remove(resources)


@cache
def unload_with_python(resources: str) -> None:
    """Run the unload hook of the library beside `resources` when Python ends, not after that.

    Windows runs the hook before the static destructors, and there a handle on the library would
    keep the host from removing the file.
    """
    if not sys.platform.startswith("linux"):
        return
    for path in Path(resources).parent.glob("binaries/linux64/*.so"):
        # A library that is not loaded has no hook to run: the host has it somewhere else.
        with suppress(OSError, AttributeError):
            hook = ctypes.CDLL(str(path), mode=os.RTLD_NOLOAD).finalizePythonInterpreter
            hook.restype = None
            atexit.register(hook)


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
