"""Kernels as relocatable object code that needs no Python: the basis of the native FMU.

numba compiles a `@cfunc` over the kernels; its LLVM module is made self-contained (everything but
the entry becomes internal), optimised again, so that numba's error paths fall away where nothing
can raise, and emitted for a fixed target. All that is private to numba stands in this file.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import llvmlite.binding as llvm
from numba import cfunc, types
from numba.core import cgutils, config
from numba.core.types import Type
from numba.extending import intrinsic
from numba.np import arrayobj


class Target(NamedTuple):
    """Target of object code.

    Parameters
    ----------
    triple, cpu : str
        Target triple and processor, as LLVM names them.
    """

    triple: str
    cpu: str


LINUX = Target("x86_64-unknown-linux-gnu", "x86-64-v2")
_DOUBLE = 8  # bytes
# what LLVM writes at the places where jumps may end, by the kind of Linux machine; a library is
# guarded only if all its parts are
_GUARDS = {
    "x86_64-unknown-linux-gnu": ("cf-protection-branch", "cf-protection-return"),
    "aarch64-unknown-linux-gnu": ("branch-target-enforcement", "sign-return-address"),
}


def _array_of(lengths: int, kind: Type = types.float64) -> Any:
    """Return the code that makes an array with so many lengths of a pointer and the lengths."""
    array_type = types.Array(kind, lengths, "C")

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


def _whole_at(typingctx: Any, pointer: Type, length: Type) -> Any:
    """Return the int64 array of `length` elements at a C pointer."""
    array_type, generate = _array_of(1, types.int64)
    return array_type(pointer, types.intp), generate


def _pointer_at(typingctx: Any, pointer: Type, place: Type) -> Any:
    """Return the pointer to the double at `place` behind a C pointer to doubles."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.gep(arguments[0], [arguments[1]])

    return pointer(pointer, types.intp), generate


array_at: Any = intrinsic(_array_at)
matrix_at: Any = intrinsic(_matrix_at)
pointer_at: Any = intrinsic(_pointer_at)
whole_at: Any = intrinsic(_whole_at)


def cpu_of_kernels() -> str:
    """Return the processor that intermediate code is made for: it depends on that one's vectors."""
    settings: Any = config
    if settings.CPU_NAME:
        return f"{settings.CPU_NAME} {settings.CPU_FEATURES}"
    return f"{llvm.get_host_cpu_name()} {llvm.get_host_cpu_features().flatten()}"


def intermediate_code(entry: Callable[..., Any], signature: Any, name: str) -> str:
    """Return `entry` and all kernels that it calls as one LLVM module, its only symbol `name`.

    Parameters
    ----------
    entry : function
        Plain Python function over kernels, pointers made arrays by `array_at`.
    signature : numba signature
        Argument types of the C function.
    name : str
        Symbol of the entry in the object file.
    """
    compiled: Any = cfunc(signature, error_model="numpy")(entry)
    module = llvm.parse_assembly(str(compiled._library._final_module))
    for function in module.functions:
        if function.name.startswith("cfunc."):
            function.name = name
            function.visibility = "hidden"  # for what it is linked with, not for a host
    _hide_all_but(module, name)
    return str(module)


def _hide_all_but(module: Any, name: str) -> None:
    for one in (*module.functions, *module.global_variables):
        if not one.is_declaration and one.name != name:
            one.linkage = "internal"


def optimised(code: str, target: Target) -> tuple[Any, Any]:
    """Return intermediate code as an LLVM module optimised for a target, and the target machine."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    module = llvm.parse_assembly(code + _module_flags(_GUARDS.get(target.triple, ())))
    machine = llvm.Target.from_triple(target.triple).create_target_machine(
        cpu=target.cpu, reloc="pic", opt=3
    )
    module.triple = target.triple
    module.data_layout = str(machine.target_data)
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    _run_passes(module, llvm.create_pass_builder(machine, tuning))
    return module, machine


def specialised(code: str, name: str) -> str:
    """Return the code of one function alone, plain: inlined, without vectors and error paths."""
    module = llvm.parse_assembly(code.replace("{ noinline }", "{ alwaysinline }"))
    _hide_all_but(module, name)
    llvm.initialize_all_targets()
    machine = llvm.Target.from_triple(LINUX.triple).create_target_machine(
        cpu=LINUX.cpu, reloc="pic", opt=2
    )
    tuning = llvm.create_pipeline_tuning_options(speed_level=2)
    tuning.loop_vectorization = tuning.slp_vectorization = False
    _run_passes(module, llvm.create_pass_builder(machine, tuning))
    return str(module)


def linked(code: str, other: str) -> str:
    """Return the code of two modules as one."""
    module = llvm.parse_assembly(code)
    module.link_in(llvm.parse_assembly(other))
    return str(module)


def _run_passes(module: Any, passes: Any) -> None:
    passes.getModulePassManager().run(module, passes)
    # what a kernel returns may be known only now: then its error paths, which need Python, go too
    last = llvm.create_new_module_pass_manager()
    last.add_ipsccp_pass()
    last.add_simplify_cfg_pass()
    last.add_global_dead_code_eliminate_pass()
    last.run(module, passes)


def _module_flags(names: Sequence[str]) -> str:
    """Return the text that sets flags of a module that has none."""
    if not names:
        return ""
    flags = [f'!{90000 + i} = !{{i32 8, !"{name}", i32 1}}' for i, name in enumerate(names)]
    listed = ", ".join(flag.split(" ")[0] for flag in flags)
    return "\n".join(["", f"!llvm.module.flags = !{{{listed}}}", *flags, ""])


def object_code(code: str, target: Target) -> tuple[bytes, set[str]]:
    """Return intermediate code as an object file, and the symbols it expects from outside.

    Parameters
    ----------
    code : str
        From `intermediate_code`.
    target : Target

    Returns
    -------
    tuple of (bytes, set of str)
        Object file in the format of the target; undefined symbols, libm's included.
    """
    module, machine = optimised(code, target)
    undefined = {
        f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")
    }
    undefined |= {v.name for v in module.global_variables if v.is_declaration}
    return machine.emit_object(module), undefined
