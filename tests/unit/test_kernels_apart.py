"""A kernel apart is called by the kernels around it, and gives what it gives as any kernel."""

from __future__ import annotations

import math

import pytest
from numba import types

from fmu_src.object_code import LINUX, intermediate_code, optimised
from gearlube_core.kernels.apart import apart
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel


@apart
def seldom(x: float) -> float:
    return math.log(x) + 1.0


@kernel
def often(x: float) -> float:
    return math.log(x) + 1.0


@inside
def _through_seldom(x: float) -> float:
    return seldom(x)


@inside
def _through_often(x: float) -> float:
    return often(x)


def _defined(through):
    def entry(x: float) -> float:
        return through(x)

    code = intermediate_code(entry, types.float64(types.float64), "entry")
    module, _ = optimised(code, LINUX)
    return [one.name for one in module.functions if not one.is_declaration]


def test_callers_contain_a_kernel_but_not_one_apart():
    assert not any("often" in name for name in _defined(_through_often))
    assert any("seldom" in name for name in _defined(_through_seldom))


def test_a_kernel_apart_computes_as_any_other():
    assert seldom(5.0) == often(5.0) == pytest.approx(math.log(5.0) + 1.0, rel=1e-15)
