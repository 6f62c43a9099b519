"""How the compiled wrapper of pythonfmu 0.7 treats Python objects, and what keeps it from crashing.

pythonfmu's `PySlaveInstance.cpp` has three habits that its Python side must balance:

* `findClass` releases the dictionary of the slave module, which it has only borrowed. After a few
  instantiations the dictionary is freed while in use.
* When a method raises, the wrapper releases instance, class and log queue and reports fmi2Fatal,
  but keeps the pointers. The next call, even fmi2FreeInstance, then works on freed memory.
* fmi2FreeInstance destroys the logger before the slave, which then sends it the messages still in
  the queue. The queue is emptied after each call, but not after instantiation.

The first two are balanced by one more reference, given just before the wrapper takes it; the third
by queueing what the constructor has to say in the first call that follows.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from functools import wraps
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
