"""The complete axle step is native code that needs nothing but libm."""

import io

from elftools.elf.elffile import ELFFile
from numba import types

from fmu_src.object_code import array_at, lower_to_object
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.dynamics.hypoid_axle.communication import axle_kernels
from gearlube_core.dynamics.hypoid_axle.integrate import StepControl, work_size
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.outputs import N_OUTPUTS
from gearlube_core.dynamics.hypoid_axle.state import N_STATE
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.kernels.flat_tuples import count_floats
from gearlube_core.mesh_table.kernels import N_SERIES

KINDS = (TaperedRollerParameters, MixedFlankFriction)
COMMUNICATION_STEP = axle_kernels(*KINDS).communication_step
N_PARAMETERS = count_floats(AxleParameters, *KINDS)
N_CONTROL = count_floats(StepControl)
ORDERS, NODES, LEVELS = 5, 192, 7
SERIES = LEVELS * N_SERIES * (2 * ORDERS + 1)
WINDOWS = LEVELS * (NODES + 1) * N_CHANNELS
WORK = work_size(ORDERS, NODES)

LIBM = {
    "exp",
    "expm1",
    "log",
    "pow",
    "sin",
    "cos",
    "sqrt",
    "asinh",
    "tanh",
    "erfc",
    "ceil",
    "floor",
}
LIBM |= {"floor", "hypot", "log1p", "cosh", "sinh", "fmod", "exp2", "sincos"}
# plain memory primitives that any C library and any compiler run-time provides
FREESTANDING = {"memcpy", "memset", "memmove"}
POINTER = types.CPointer(types.float64)


def axle_step(s, trial, h, inputs, levels, series, windows, parameters, control, work, out):
    return COMMUNICATION_STEP(
        array_at(s, N_STATE),
        array_at(trial, N_STATE),
        h,
        array_at(inputs, 3),
        (
            array_at(levels, LEVELS),
            array_at(series, SERIES),
            ORDERS,
            array_at(windows, WINDOWS),
            NODES,
        ),
        array_at(parameters, N_PARAMETERS),
        array_at(control, N_CONTROL),
        array_at(work, WORK),
        array_at(out, ROLLERS_MAX),
        array_at(out, N_OUTPUTS),
    )


def allocating_step(s):
    state = array_at(s, N_STATE)
    return state.copy()[0]


def undefined_in_object(code: bytes) -> set[str]:
    table = ELFFile(io.BytesIO(code)).get_section_by_name(".symtab")
    return {
        symbol.name
        for symbol in table.iter_symbols()
        if symbol["st_shndx"] == "SHN_UNDEF" and symbol.name
    } - {"_GLOBAL_OFFSET_TABLE_"}


def test_axle_step_needs_nothing_but_libm():
    signature = types.int64(*2 * [POINTER], types.float64, *8 * [POINTER])
    code, declared = lower_to_object(axle_step, signature, "gearlube_axle_step")
    wanted = undefined_in_object(code)
    assert wanted <= LIBM | FREESTANDING
    assert declared >= wanted - FREESTANDING - LIBM
    symbols = ELFFile(io.BytesIO(code)).get_section_by_name(".symtab").iter_symbols()
    assert "gearlube_axle_step" in {symbol.name for symbol in symbols}


def test_an_allocation_would_be_seen():
    code, _ = lower_to_object(allocating_step, types.float64(POINTER), "allocates")
    assert undefined_in_object(code) - LIBM - FREESTANDING
