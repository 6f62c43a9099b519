"""Code that different processes have kept on disk is not mixed up by one that loads it all."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from pathlib import Path

import pytest

# too long to be put into its caller, which calls it twice
LONG = "\n".join("        x = x + k * math.sqrt(x)" for _ in range(50))
MODULE = f"""
import math
import sys
from gearlube_core.kernels.jit import kernel

def made(k):
    @kernel
    def inner(x):
{LONG}
        return x

    @kernel
    def outer(x):
        return inner(x) + inner(x + 1.0)

    return outer

for k in map(float, sys.argv[1:]):
    print(made(k)(1.0))
"""


def by_hand(k: float) -> float:
    """Return the same in Python."""
    total = 0.0
    for x in (1.0, 2.0):
        for _ in range(50):
            x = x + k * math.sqrt(x)
        total += x
    return total


def test_functions_made_in_different_processes_stay_apart(tmp_path: Path) -> None:
    script = tmp_path / "factory.py"
    script.write_text(MODULE, encoding="utf-8")
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}

    def run(*numbers: str) -> list[float]:
        command = [sys.executable, str(script), *numbers]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        return [float(one) for one in done.stdout.split()]

    # each compiles its own, the last one loads both
    wanted = [pytest.approx(by_hand(k), rel=1e-12) for k in (2.0, 3.0)]
    assert [run("2"), run("3")] == [[one] for one in wanted]
    assert run("2", "3") == wanted
