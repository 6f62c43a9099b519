"""Code of a kernel that only other kernels call: linked into its callers, never run by itself.

numba gives every compiled function machine code and a wrapper for calls from Python. Here both are
left out, and intermediate code is kept on disk alone. A caller that becomes machine code optimises
it, once, together with all that it links: a fifth of the time of compilation is saved, and the
machine code computes the same numbers at the same speed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite.binding import parse_bitcode
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, CompileResult


class _LinkedLibrary(JITCodeLibrary):  # type: ignore[misc]
    """Intermediate code without machine code."""

    def _optimize_final_module(self) -> None:
        """Do nothing: numba optimises single functions before, and callers all that they link."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """Return the null pointer that numba expects where there is no machine code."""
        self._ensure_finalized()
        return 0

    def serialize_using_object_code(self) -> tuple[str, bytes]:
        """Return name and intermediate code; numba's own libraries return machine code too."""
        self._ensure_finalized()
        return self.name, self._final_module.as_bitcode()

    @property
    def codegen(self) -> Any:
        """Take the place of numba's code generator, which would look for machine code."""
        return self

    def set_env(self, name: str, environment: Any) -> None:
        """Do nothing: callers that become machine code set the environments of what they link."""


class LinkedCodeCompiler(Compiler):  # type: ignore[misc]
    """numba's compiler, ending before machine code."""

    def compile_extra(self, func: Any) -> Any:
        """Compile `func`; numba's name of this method."""
        codegen = self.state.targetctx.codegen()
        self.state.library = _LinkedLibrary(codegen, f"{func.__qualname__}.linked")
        return super().compile_extra(func)


class _LoadingContext:
    """A target context whose libraries are made by `load`, of a code generator and what is kept."""

    def __init__(self, context: Any, load: Callable[[Any, Any], Any]) -> None:
        self._context, self._load = context, load

    def __getattr__(self, name: str) -> Any:
        return getattr(self._context, name)

    def codegen(self) -> _LoadingContext:
        return self

    def unserialize_library(self, data: Any) -> Any:
        return self._load(self._context.codegen(), data)


def rebuilt(
    target_context: Any, payload: tuple[Any, ...], load: Callable[[Any, Any], Any]
) -> CompileResult:
    """Return the numba CompileResult that was stored as `payload`, its library made by `load`."""
    result = CompileResult._rebuild(_LoadingContext(target_context, load), *payload)
    return result._replace(target_context=target_context)


def _loaded(codegen: Any, data: tuple[str, bytes]) -> _LinkedLibrary:
    name, code = data
    library = _LinkedLibrary(codegen, name)
    library._final_module = parse_bitcode(code)
    library._finalize_final_module()
    return library


def rebuild_linked_code(target_context: Any, payload: tuple[Any, ...]) -> Any:
    """Return the numba CompileResult that was stored as `payload`."""
    return rebuilt(target_context, payload, _loaded)
