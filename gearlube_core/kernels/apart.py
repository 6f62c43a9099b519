"""Decorator of a kernel that is seldom needed: its code stays out of its callers.

A compiler takes what does not change in a loop out of it, logarithms and divisions too, though a
test in the loop may pass them by nearly always. It cannot where they stand in a call.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from numba.core import config
from numba.core.compiler import Compiler

from gearlube_core.kernels.dispatcher import KernelDispatcher
from gearlube_core.kernels.linked_code import LinkedCodeCompiler

_Function = TypeVar("_Function", bound=Callable[..., Any])


class _Marking(Compiler):  # type: ignore[misc]
    """numba's compiler, with a library that marks the functions that are put into it."""

    def compile_extra(self, func: Any) -> Any:
        """Compile `func`; numba's name of this method."""
        library = self.state.library
        put = library.add_ir_module

        def marked(module: Any) -> None:
            for function in module.functions:
                if not function.is_declaration:
                    function.attributes.add("noinline")
            put(module)

        library.add_ir_module = marked
        return super().compile_extra(func)


class _ApartCompiler(LinkedCodeCompiler, _Marking):
    """The compiler of linked code, which makes the library, and then `_Marking`."""


class _ApartDispatcher(KernelDispatcher):
    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._linked._compiler.pipeline_class = _ApartCompiler


def apart(function: _Function) -> _Function:
    """Compile `function` as a kernel that its callers call, and never contain."""
    if config.DISABLE_JIT:  # type: ignore[attr-defined]
        return function
    # numba hands on to what a kernel calls that it is to be contained, unless it says not
    options = {"error_model": "numpy", "forceinline": False}
    return _ApartDispatcher(function, targetoptions=options)  # type: ignore[return-value]
