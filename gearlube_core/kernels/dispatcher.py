"""Compiled functions that are called from Python and from each other.

For callers in Python a function is compiled with all it calls to machine code. For callers that
are kernels its code is only linked into theirs (`linked_code`). So of a whole time step just the
functions that Python calls become machine code, which saves a third of its compilation.
"""

from __future__ import annotations

import itertools
import secrets
from collections.abc import Callable
from typing import Any, TypeVar

from numba import types
from numba.core import config
from numba.core.bytecode import FunctionIdentity
from numba.core.compiler import Compiler
from numba.core.registry import CPUDispatcher

from gearlube_core.kernels.compiled_cache import LinkedCache, SourceCache, cache_of
from gearlube_core.kernels.linked_code import LinkedCodeCompiler

_Function = TypeVar("_Function", bound=Callable[..., Any])

# numba names the code of functions that are made at run time by a count in each process. Code of
# two processes on disk then has equal names, and a third process that loads both runs one for the
# other. A count that begins anywhere keeps them apart.
FunctionIdentity._unique_ids = itertools.count(secrets.randbits(48))


class KernelDispatcher(CPUDispatcher):  # type: ignore[misc]
    """A function for callers in Python, which hands other kernels its linked code."""

    def __init__(
        self,
        py_func: Callable[..., Any],
        locals: dict[str, Any] | None = None,
        targetoptions: dict[str, Any] | None = None,
        pipeline_class: type = Compiler,
    ) -> None:
        options = {**(targetoptions or {}), "nopython": True, "no_cfunc_wrapper": True}
        locals = locals or {}
        super().__init__(py_func, locals, options, pipeline_class)
        self._cache: Any = cache_of(SourceCache, py_func)
        linked_options = options | {"no_cpython_wrapper": True}
        linked: Any = CPUDispatcher(py_func, locals, linked_options, LinkedCodeCompiler)
        linked._cache = cache_of(LinkedCache, py_func)
        self._linked = linked

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Return numba's template of a call from another kernel.

        A literal in the call counts as its type: one compilation serves every number.
        """
        args = [types.unliteral(argument) for argument in args]
        kws = {name: types.unliteral(argument) for name, argument in dict(kws).items()}
        return self._linked.get_call_template(args, kws)

    def get_overload(self, sig: Any) -> Any:
        """Return the code that another kernel calls."""
        return self._linked.get_overload(sig)


def compiled(function: _Function, **options: Any) -> _Function:
    """Compile `function` with numba on first call and keep the code on disk.

    `options` are those of `numba.njit`.
    """
    if config.DISABLE_JIT:  # type: ignore[attr-defined]
        return function
    return KernelDispatcher(function, targetoptions=options)  # type: ignore[return-value]
