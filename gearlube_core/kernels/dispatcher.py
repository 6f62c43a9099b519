"""Compiled functions that are called from Python and from each other.

For callers in Python a function is compiled with all it calls to machine code. For callers that
are kernels its code is only linked into theirs (`linked_code`). So of a whole time step just the
functions that Python calls become machine code, which saves a third of its compilation.
"""

from __future__ import annotations

import gc
import itertools
import logging
import multiprocessing
import secrets
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

from numba import types
from numba.core import config
from numba.core.bytecode import FunctionIdentity
from numba.core.compiler import Flags
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import CPUDispatcher

from gearlube_core.kernels.compiled_cache import LinkedCache, SourceCache, cache_of
from gearlube_core.kernels.linked_code import LinkedCodeCompiler
from gearlube_core.kernels.machine_code import MachineCodeCompiler

logger = logging.getLogger(__name__)

_Function = TypeVar("_Function", bound=Callable[..., Any])

# numba names the code of functions that are made at run time by a count in each process. Code of
# two processes on disk then has equal names, and a third process that loads both runs one for the
# other. A count that begins anywhere keeps them apart.
FunctionIdentity._unique_ids = itertools.count(secrets.randbits(48))

# numba compares all options of a compilation, by name, each time that it looks up a function, and
# gives all sets of options one hash: a twentieth of the time of compilation. Most are the same.
_compare_by_name = Flags.__eq__


def _equal_flags(one: Any, other: Any) -> Any:
    same = type(one) is type(other) and one._values == other._values
    return same or _compare_by_name(one, other)


Flags.__eq__ = _equal_flags  # type: ignore[method-assign]
Flags.__hash__ = lambda flags: hash(type(flags))  # type: ignore[method-assign]

# objects between two searches for garbage: compilation makes many that stay, and with Python's
# usual number the searches take a seventh of its time
_MANY = 100_000


@contextmanager
def _little_garbage() -> Iterator[None]:
    """Look for garbage seldom, where it is looked for at all, while one thread compiles."""
    with global_compiler_lock:
        usual = gc.get_threshold()
        if 0 < usual[0] < _MANY:
            gc.set_threshold(_MANY, *usual[1:])
        try:
            yield
        finally:
            gc.set_threshold(*usual)


class KernelDispatcher(CPUDispatcher):  # type: ignore[misc]
    """A function for callers in Python, which hands other kernels its linked code."""

    def __init__(
        self,
        py_func: Callable[..., Any],
        locals: dict[str, Any] | None = None,
        targetoptions: dict[str, Any] | None = None,
        pipeline_class: type = MachineCodeCompiler,
    ) -> None:
        options = {**(targetoptions or {}), "nopython": True, "no_cfunc_wrapper": True}
        locals = locals or {}
        super().__init__(py_func, locals, options, pipeline_class)
        self._cache: Any = cache_of(SourceCache, py_func)
        linked_options = options | {"no_cpython_wrapper": True}
        linked: Any = CPUDispatcher(py_func, locals, linked_options, LinkedCodeCompiler)
        linked._cache = cache_of(LinkedCache, py_func)
        self._linked = linked

    def announce(self, words: str) -> None:
        """Log these words before it is compiled, unless its code is on disk."""
        compiler: Any = self._compiler  # type: ignore[attr-defined]
        compile_now = compiler.compile

        def compile_after_words(*signature: Any) -> Any:
            if multiprocessing.parent_process() is None:  # workers are silent
                logger.warning("%s", words)
            return compile_now(*signature)

        compiler.compile = compile_after_words

    def compile(self, sig: Any) -> Any:
        """Compile for a signature, or read what is on disk; numba's name of this method."""
        with _little_garbage():
            return super().compile(sig)

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
