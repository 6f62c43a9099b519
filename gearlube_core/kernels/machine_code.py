"""Machine code of a kernel on disk, without the intermediate code that numba keeps beside it.

numba keeps that to link a function into others, and holds it as long as the function. Kernels are
linked from code of their own (`linked_code`), so here the names that the machine code defines are
kept in its place. A process with all gear models takes a fifth less memory.
"""

from __future__ import annotations

from typing import Any

from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler

from gearlube_core.kernels.linked_code import rebuilt


class _MachineLibrary(JITCodeLibrary):  # type: ignore[misc]
    """Machine code that nothing is linked with."""

    def serialize_using_object_code(self) -> tuple[str, bytes, list[str]]:
        """Return name, machine code and the names that it defines."""
        self._ensure_finalized()
        module = self._final_module
        defined = (*module.functions, *module.global_variables)
        names = [one.name for one in defined if not one.is_declaration]
        return self.name, self._get_compiled_object(), names


class MachineCodeCompiler(Compiler):  # type: ignore[misc]
    """numba's compiler, whose result is kept without intermediate code."""

    def compile_extra(self, func: Any) -> Any:
        """Compile `func`; numba's name of this method."""
        library = _MachineLibrary(self.state.targetctx.codegen(), func.__qualname__)
        library.enable_object_caching()
        self.state.library = library
        return super().compile_extra(func)


def _loaded(codegen: Any, data: tuple[str, bytes, list[str]]) -> _MachineLibrary:
    name, code, names = data
    library = _MachineLibrary(codegen, name)
    library.enable_object_caching()
    library._set_compiled_object(code)
    library._finalize_final_module()
    codegen._engine._defined_symbols.update(names)
    return library


def rebuild_machine_code(target_context: Any, payload: tuple[Any, ...]) -> Any:
    """Return the numba CompileResult that was stored as `payload`."""
    return rebuilt(target_context, payload, _loaded)
