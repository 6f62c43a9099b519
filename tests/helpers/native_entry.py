"""The object code of a native model's entry, loaded into this process without a C compiler."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from functools import cache

import llvmlite.binding as llvm
import numpy as np

from fmu_src.native.model import ENTRY_SIGNATURE, NativeModel, Operation
from fmu_src.object_code import CPU, LINUX_TRIPLE, lower_to_object

_POINTER = ctypes.POINTER(ctypes.c_double)
_ENTRY = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64, ctypes.c_double, *6 * [_POINTER])


@cache
def object_of(entry: object) -> tuple[bytes, set[str]]:
    """Object code of an entry and the symbols it expects from outside."""
    return lower_to_object(entry, ENTRY_SIGNATURE, "entry")  # type: ignore[arg-type]


@cache
def _loaded(entry: object) -> tuple[llvm.ExecutionEngine, int]:
    code, _ = object_of(entry)
    target = llvm.Target.from_triple(LINUX_TRIPLE).create_target_machine(cpu=CPU, reloc="pic")
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), target)
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    return engine, engine.get_function_address("entry")


class NativeEntry:
    """One instance of a native model: what the C of an FMU holds of it."""

    def __init__(self, model: NativeModel) -> None:
        self.model = model
        _, address = _loaded(model.entry)
        self._call = _ENTRY(address)
        self.state = np.zeros(model.state_size)
        self.work = np.zeros(model.work_size)
        self.outputs = np.zeros(len(model.definition.output_names))
        self._parameters = np.zeros(0)

    def start(self, parameters: Sequence[float], inputs: Sequence[float]) -> int:
        """Initialise; return the status."""
        self._parameters = np.array(parameters, dtype=float)
        return self.do(Operation.START, inputs)

    def do(self, operation: Operation, inputs: Sequence[float] = (), step: float = 0.0) -> int:
        """Call the entry; return its status."""
        given = np.array(inputs, dtype=float)
        arrays = (
            self.model.data, self._parameters, given, self.state, self.work, self.outputs,
        )  # fmt: skip
        pointers = [array.ctypes.data_as(_POINTER) for array in arrays]
        return int(self._call(int(operation), step, *pointers))

    def ready(self, parameters: Sequence[float], state: np.ndarray) -> int:
        """Take a state of elsewhere; return the status."""
        self._parameters = np.array(parameters, dtype=float)
        self.state[:] = state
        return self.do(Operation.RESUME)
