"""Object code of a kernel that allocates would need more than libm, and is seen."""

from numba import types

from fmu_src.object_code import LINUX, array_at, intermediate_code, object_code
from tests.helpers.object_code import FREESTANDING, LIBM, undefined_in_object

POINTER = types.CPointer(types.float64)


def allocating_step(s):
    state = array_at(s, 36)
    return state.copy()[0]


def test_an_allocation_would_be_seen():
    text = intermediate_code(allocating_step, types.float64(POINTER), "allocates")
    code, _ = object_code(text, LINUX)
    assert undefined_in_object(code) - LIBM - FREESTANDING
