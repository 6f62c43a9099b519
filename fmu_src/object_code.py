"""Kernels as relocatable object code that needs no Python: the basis of the native FMU.

numba compiles a `@cfunc` over the kernels; its LLVM module is made self-contained (everything but
the entry becomes internal), optimised again, so that numba's error paths fall away where nothing
can raise, and emitted for a fixed target.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import llvmlite.binding as llvm
from numba import cfunc, types
from numba.core import cgutils
from numba.core.types import Type
from numba.extending import intrinsic
from numba.np import arrayobj

LINUX_TRIPLE = "x86_64-unknown-linux-gnu"
CPU = "x86-64-v2"


_DOUBLE = 8  # bytes


def _array_of(lengths: int) -> Any:
    """Return the code that makes an array with so many lengths of a pointer and the lengths."""
    array_type = types.Array(types.float64, lengths, "C")

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        address, *shape = arguments
        array = arrayobj.make_array(array_type)(context, builder)
        size = context.get_constant(types.intp, _DOUBLE)
        strides = [size]
        for length in shape[:0:-1]:
            strides.insert(0, builder.mul(strides[0], length))
        arrayobj.populate_array(
            array,
            data=builder.bitcast(address, array.data.type),
            shape=cgutils.pack_array(builder, shape),
            strides=cgutils.pack_array(builder, strides),
            itemsize=size,
            meminfo=None,
        )
        return array._getvalue()

    return array_type, generate


def _array_at(typingctx: Any, pointer: Type, length: Type) -> Any:
    """Return the float64 array of `length` elements at a C pointer, without a run-time call."""
    array_type, generate = _array_of(1)
    return array_type(pointer, types.intp), generate


def _matrix_at(typingctx: Any, pointer: Type, rows: Type, columns: Type) -> Any:
    """Return the float64 array of shape (rows, columns) at a C pointer, row by row."""
    array_type, generate = _array_of(2)
    return array_type(pointer, types.intp, types.intp), generate


def _pointer_at(typingctx: Any, pointer: Type, place: Type) -> Any:
    """Return the pointer to the double at `place` behind a C pointer to doubles."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.gep(arguments[0], [arguments[1]])

    return pointer(pointer, types.intp), generate


array_at: Any = intrinsic(_array_at)
matrix_at: Any = intrinsic(_matrix_at)
pointer_at: Any = intrinsic(_pointer_at)


def lower_to_object(entry: Callable[..., Any], signature: Any, name: str) -> tuple[bytes, set[str]]:
    """Return the object code of `entry` and the symbols it expects from outside.

    Parameters
    ----------
    entry : function
        Plain Python function over kernels, pointers made arrays by `array_at`.
    signature : numba signature
        Of C types.
    name : str
        Symbol of the entry in the object file.

    Returns
    -------
    tuple of (bytes, set of str)
        ELF object for x86-64 Linux; undefined symbols, libm's included.
    """
    compiled: Any = cfunc(signature, error_model="numpy")(entry)
    module = llvm.parse_assembly(str(compiled._library._final_module))
    for function in module.functions:
        if function.is_declaration:
            continue
        if function.name == compiled.native_name or function.name.startswith("cfunc."):
            if function.name.startswith("cfunc."):
                function.name = name
            continue
        function.linkage = "internal"
    for variable in module.global_variables:
        if not variable.is_declaration:
            variable.linkage = "internal"
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    target = llvm.Target.from_triple(LINUX_TRIPLE).create_target_machine(
        cpu=CPU, reloc="pic", opt=3
    )
    for function in module.functions:
        if not function.is_declaration and function.name != name:
            function.linkage = "internal"
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    passes = llvm.create_pass_builder(target, tuning)
    passes.getModulePassManager().run(module, passes)
    undefined = {
        f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")
    }
    undefined |= {v.name for v in module.global_variables if v.is_declaration}
    return target.emit_object(module), undefined
