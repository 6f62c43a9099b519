"""Methods of NamedTuples that kernels can call.

A NamedTuple of floats may have methods. Numba sees its class when it compiles a kernel, so it can
compile the method of that class: kernels work with any class that has the methods of an
interface, and the choice between classes costs nothing when they run.
"""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature
from typing import Any

from numba import types
from numba.extending import overload_method


def compile_methods(interface: type, *names: str) -> None:
    """Let kernels call these methods of every NamedTuple class that has them.

    Parameters
    ----------
    interface : type
        Protocol that declares the methods; all classes take its arguments in its order.
    names : str
        Of methods that take and return floats, NamedTuples and float64 arrays, do not allocate
        and do not raise.
    """
    for name in names:
        _compile_method(interface, name)


def _compile_method(interface: type, name: str) -> None:
    def method(self: Any, *args: Any) -> Callable[..., Any] | None:
        return getattr(self.instance_class, name, None)

    # numba binds the arguments of a call by this signature
    method.__signature__ = signature(getattr(interface, name))  # type: ignore[attr-defined]
    compiled: Any = overload_method  # its stub lacks jit_options
    options = {"error_model": "numpy"}
    # not strict: a class need not repeat the annotations of the interface
    compiled(types.BaseNamedTuple, name, jit_options=options, strict=False)(method)
