"""Object code of native entries: what it needs from outside, and how to run it from Python."""

from __future__ import annotations

import ctypes
import io
import pickle
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import llvmlite.binding as llvm
import numpy as np
from elftools.elf.elffile import ELFFile

from fmu_src.native.build import ENTRY, kernel_code, library_kind
from fmu_src.native.model import NativeModel, Operation
from fmu_src.native.tangent import TANGENT
from fmu_src.object_code import LINUX, object_code
from tests.helpers.session_folder import alone, shared_folder

LIBM = {"exp", "expm1", "log", "pow", "sin", "cos", "tan", "sqrt", "asinh", "tanh", "erfc", "ceil"}
LIBM |= {"floor", "hypot", "log1p", "acos", "cosh", "sinh", "fmod", "exp2", "sincos"}
# plain memory primitives that any C library and any compiler run-time provides
FREESTANDING = {"memcpy", "memset", "memmove"}


def symbols(code: bytes) -> list[Any]:
    """Return the symbols of an object file."""
    return list(ELFFile(io.BytesIO(code)).get_section_by_name(".symtab").iter_symbols())


def undefined_in_object(code: bytes) -> set[str]:
    """Return the names that object code expects from outside."""
    names = {one.name for one in symbols(code) if one["st_shndx"] == "SHN_UNDEF" and one.name}
    return names - {"_GLOBAL_OFFSET_TABLE_"}


@dataclass(frozen=True)
class NativeRun:
    """One instance of a native model: its arrays, and its entry in object code."""

    model: NativeModel
    entry: Callable[..., int]
    parameters: np.ndarray
    inputs: np.ndarray
    state: np.ndarray
    work: np.ndarray
    outputs: np.ndarray
    tangent: Callable[..., int]
    of_work: np.ndarray  # its changes along the last direction

    def __call__(self, operation: Operation, step: float = 0.0) -> int:
        arrays = (self.model.data, self.parameters, self.inputs, self.state, self.work)
        pointers = [array.ctypes.data for array in (*arrays, self.outputs)]
        return self.entry(int(operation), step, *pointers)

    def step(self, h: float) -> int:
        """Take a step of `h` [s] and write the outputs."""
        return self(Operation.STEP, h) or self(Operation.OUTPUTS)

    def changes(self, operation: Operation, of_state: np.ndarray) -> np.ndarray:
        """Return the changes of the outputs along a direction of the state."""
        given, changes = self.state.copy(), np.zeros_like(self.outputs)
        arrays = (self.model.data, self.parameters, self.inputs, given, self.work, self.outputs)
        more = (of_state.copy(), self.of_work, changes)
        pointers = [array.ctypes.data for array in (*arrays, *more)]
        assert self.tangent(int(operation), 0.0, *pointers) == 0
        return changes

    def motion(self) -> dict[str, float]:
        """Write the outputs of the motion alone and return them."""
        self.outputs[:] = np.nan
        assert self(Operation.MOTION) == 0
        names = self.model.definition.output_names
        written = dict(zip(names, self.outputs.tolist(), strict=True))
        assert {name for name, value in written.items() if value == value} == self.model.motion
        return {name: written[name] for name in self.model.motion}


def object_code_once(model: NativeModel) -> tuple[bytes, set[str]]:
    """Return an entry as object code with its undefined symbols, made once a run for each kind."""
    if not model.kind:
        return object_code(kernel_code(model), LINUX)
    path = shared_folder("entries") / library_kind(model)
    with alone(path.with_suffix(".lock")):
        if not path.is_file():
            made = object_code(kernel_code(model), LINUX)
            path.write_bytes(pickle.dumps(made))
    return pickle.loads(path.read_bytes())  # type: ignore[no-any-return]


class LoadedCode:
    """The entry of object code in this process, and in model exchange its tangent."""

    def __init__(self, code: bytes) -> None:
        target = llvm.Target.from_default_triple().create_target_machine()
        self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), target)
        self._engine.add_object_file(llvm.ObjectFileRef.from_data(code))
        self._engine.finalize_object()
        self.entry, self.tangent = (
            ctypes.CFUNCTYPE(
                ctypes.c_int64, ctypes.c_int64, ctypes.c_double, *n * [ctypes.c_void_p]
            )(self._engine.get_function_address(name))
            for name, n in ((ENTRY, 6), (TANGENT, 9))
        )


class LoadedModel:
    """The object code of a model in this process."""

    def __init__(self, model: NativeModel) -> None:
        self.model = model
        self.code, self.declared = object_code_once(model)
        self._loaded = LoadedCode(self.code)
        self._entry = self._loaded.entry

    def takes(self, data: np.ndarray, work_size: int) -> bool:
        """Whether the entry takes constants and a work array of these lengths."""
        lengths = np.array([float(data.size), float(work_size)])
        variables = [v for v in self.model.definition.variables if v.is_model_parameter]
        options = np.array([float(len(v.literals)) for v in variables])
        pointers = [one.ctypes.data for one in (data, lengths, options, *3 * [np.zeros(1)])]
        return self._entry(int(Operation.CHECK), 0.0, *pointers) == 0

    def instance(self, values: dict[str, Any], inputs: Any) -> NativeRun:
        """Return an instance with parameters by argument, the others at their start values.

        Inputs that are left out at the end have theirs too.
        """
        given = [v.start for v in self.model.definition.variables if v.causality == "input"]
        inputs = [*inputs, *given[len(inputs) :]]
        found = []
        for variable in self.model.definition.variables:
            if variable.is_model_parameter:
                value = values.get(variable.argument, variable.decoded(variable.start or 0.0))
                found.append(variable.literals.index(value) + 1 if variable.literals else value)
        return NativeRun(
            self.model,
            self._entry,
            np.array(found, dtype=float),
            np.array(inputs, dtype=float),
            np.zeros(self.model.state_size),
            np.zeros(self.model.work_size),
            np.zeros(len(self.model.definition.output_names)),
            self._loaded.tangent,
            np.zeros(self.model.work_size),
        )
