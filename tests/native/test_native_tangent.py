"""The tangent of kernels: slopes of all that they can compute, against differences."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from fmu_src.native.build import ENTRY
from fmu_src.native.model import ENTRY_SIGNATURE, Operation
from fmu_src.native.tangent import with_tangent
from fmu_src.object_code import LINUX, array_at, intermediate_code, object_code
from gearlube_core.errors import GearLubeError
from tests.helpers.high_differences import difference
from tests.helpers.object_code import LoadedCode

N_OUT, N_WORK, N_ROOM = 48, 8, 10
X, Y = 0.63, 0.35


def entry(operation, step, data, parameters, inputs, state, work, outputs):  # type: ignore[no-untyped-def]
    """Write every function of two numbers, and what loops, branches and copies make of them."""
    s, out, w = array_at(state, 2), array_at(outputs, N_OUT), array_at(work, N_ROOM)
    x, y = s[0], s[1]
    out[0], out[1], out[2], out[3] = math.sqrt(x), math.exp(x), math.expm1(x), math.log(x)
    out[4], out[5], out[6], out[7] = math.log1p(x), math.log2(x), math.log10(x), math.sin(x)
    out[8], out[9], out[10], out[11] = math.cos(x), math.tan(x), math.asin(x), math.acos(x)
    out[12], out[13], out[14], out[15] = math.atan(x), math.sinh(x), math.cosh(x), math.tanh(x)
    out[16], out[17], out[18] = math.asinh(x), math.acosh(1.0 + x), math.atanh(x)
    out[19], out[20], out[21], out[22] = math.erf(x), math.erfc(x), abs(x - 2.0), np.cbrt(x)
    out[23], out[24], out[25] = np.exp2(x), math.atan2(x, y), math.hypot(x, y)
    out[26], out[27], out[28] = x**y, math.copysign(x, y - 1.0), np.fmod(x, y)
    out[29], out[30], out[31] = x % y, max(x, y), min(x, y)
    out[32], out[33], out[34] = np.fmax(x, y), np.fmin(x, y), math.floor(x) + math.ceil(y)
    out[35], out[36], out[37] = x / y, -x * y, (x - y) * (x + y)
    out[38] = math.sqrt(abs(x - x)) + abs(x * 0.0) ** 0.5  # flat where the slope is infinite
    out[39] = float(int(10.0 * x)) * y
    total = 0.0
    for i in range(N_WORK):
        w[i] = x ** (i + 1)
    for i in range(N_WORK):
        total += w[N_WORK - 1 - i] * y if i % 3 else w[i]
    out[40] = total
    for i in range(N_WORK):
        w[i] = 0.0
    out[41] = w[3] + x
    w[0], w[1] = y, x
    for i in range(2, N_WORK):
        w[i] = w[i - 1] + w[i - 2]
    out[42] = w[N_WORK - 1]
    out[43] = x if operation == 5 else y
    out[44] = abs(x - X) + y  # the mean of both sides
    if x != w[N_WORK]:  # kept for an x, and for a direction
        w[N_WORK], w[N_WORK + 1] = x, math.sin(x)
    out[45] = w[N_WORK + 1]
    out[46] = x if math.isfinite(y) else y
    for i in range(47, N_OUT):
        out[i] = 1.0
    return 0


def made(entry: Callable[..., Any]) -> LoadedCode:
    code = with_tangent(intermediate_code(entry, ENTRY_SIGNATURE, ENTRY), ENTRY)
    return LoadedCode(object_code(code, LINUX)[0])


def pointers(*arrays: np.ndarray) -> list[int]:
    return [array.ctypes.data for array in arrays]


@pytest.fixture(scope="module")
def code() -> LoadedCode:
    return made(entry)


def values_at(code: LoadedCode, operation: int, state: np.ndarray) -> np.ndarray:
    none, out = np.zeros(1), np.zeros(N_OUT)
    arrays = (none, none, none, state.copy(), np.zeros(N_ROOM), out)
    assert code.entry(operation, 0.0, *pointers(*arrays)) == 0
    return out


@pytest.mark.parametrize("operation", [Operation.OUTPUTS, Operation.DERIVATIVES])
@pytest.mark.parametrize("direction", [(1.0, 0.0), (0.0, 1.0), (-0.7, 0.4)])
def test_slopes_are_those_of_differences(
    code: LoadedCode, operation: int, direction: tuple[float, float]
) -> None:
    state, along = np.array([X, Y]), np.array(direction)
    work, of_work = np.zeros(N_ROOM), np.zeros(N_ROOM)
    wanted, error = difference(lambda h: values_at(code, operation, state + h * along))
    none, out, changes = np.zeros(1), np.zeros(N_OUT), np.zeros(N_OUT)
    for before in (-along, along, along):  # along other directions and this one again
        arrays = (none, none, none, state.copy(), work, out, before.copy(), of_work, changes)
        assert code.tangent(operation, 0.0, *pointers(*arrays)) == 0
    np.testing.assert_allclose(out, values_at(code, operation, state), rtol=1e-15)
    assert error.max() < 1e-10  # of slopes of about 1, differences of values of about 1
    assert np.all(np.abs(changes - wanted) <= error)


def test_what_has_no_known_slope_is_refused_by_its_name() -> None:
    def with_gamma(operation, step, data, parameters, inputs, state, work, outputs):  # type: ignore[no-untyped-def]
        array_at(outputs, 1)[0] = math.lgamma(array_at(state, 1)[0])
        return 0

    with pytest.raises(GearLubeError, match="lgamma"):
        made(with_gamma)
