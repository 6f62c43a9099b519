"""Kernels of native FMUs are optimised for one kind of processor, whatever machine builds."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.native.build_target import compile_for_any_machine

ROOT = Path(__file__).parents[2]
CODE = """
from fmu_src.native.build_target import compile_for_any_machine
assert compile_for_any_machine() is True
from numba import cfunc, types
from fmu_src.object_code import intermediate_code, array_at
def entry(data, out):
    a, b = array_at(data, 64), array_at(out, 64)
    for i in range(64):
        b[i] = a[i] * 2.0 + 1.0
    return 0
pointer = types.CPointer(types.float64)
print(intermediate_code(entry, types.int64(pointer, pointer), "entry"))
"""


@pytest.mark.slow
def test_vectors_are_those_of_the_level_not_of_this_machine() -> None:
    done = subprocess.run(
        [sys.executable, "-c", CODE], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert "<2 x double>" in done.stdout  # 128 bits
    assert "<4 x double>" not in done.stdout  # AVX, which this level lacks
    assert "<8 x double>" not in done.stdout


def test_it_says_where_it_comes_too_late() -> None:
    pytest.importorskip("numba")
    assert compile_for_any_machine() is False
