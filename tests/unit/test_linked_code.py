"""Kernels called by kernels: linked into their callers, without machine code of their own."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

from gearlube_core.kernels.jit import kernel

SCRIPT = """
from gearlube_core.kernels.jit import kernel

@kernel
def half(x):
    return 0.5 * x

@kernel
def quarter(x):
    return half(half(x))

print(quarter(8.0), *half._linked.stats.cache_hits.values(), half.overloads == {})
"""


@kernel
def _cube(x: float) -> float:
    return x * x * x


@kernel
def _sum_of_cubes(x: float, y: float) -> float:
    return _cube(x) + _cube(y)


def test_a_kernel_is_called_by_python_and_by_kernels() -> None:
    assert _sum_of_cubes(2.0, 3.0) == 35.0
    assert _cube(2.0) == 8.0
    assert _sum_of_cubes(1.0, 2.0) == 9.0


def test_a_called_kernel_has_no_machine_code() -> None:
    def called(x: float) -> float:
        return x + 1.0

    inner: Any = kernel(called)
    outer: Any = kernel(lambda x: inner(x))
    assert outer(1.0) == 2.0
    assert inner.overloads == {}
    library = next(iter(inner._linked.overloads.values())).library
    assert library.get_pointer_to_function(next(library.get_defined_functions()).name) == 0


def test_linked_code_is_read_from_disk_when_its_caller_is_compiled_anew(
    tmp_path: Path, monkeypatch: Any
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)

    def output() -> list[str]:
        command = [sys.executable, str(script)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()

    assert output() == ["2.0", "True"]
    for caller in (tmp_path / "cache").rglob("*quarter*"):
        caller.unlink()
    assert output() == ["2.0", "1", "True"]
