"""The tests of this folder once more, on a library that watches its own memory and arithmetic."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.helpers.small_native_builds import MODEL
from tests.helpers.watching_library import (
    COMPILER,
    NO_COMPILER,
    watching_environment,
    watching_library,
)

ROOT = Path(__file__).parents[2]


@pytest.mark.slow
@pytest.mark.skipif(COMPILER is None, reason=NO_COMPILER)
def test_no_call_leaves_its_memory_or_overflows(tmp_path: Path) -> None:
    folder = tmp_path / "small_native_model"
    folder.mkdir()
    watching_library(MODEL, folder)
    environment = watching_environment()
    environment["GEARLUBE_TEST_RUN"] = str(tmp_path)  # the library is taken from there
    command = [sys.executable, "-m", "pytest", "-n", "0", "-q", "-p", "no:cacheprovider",
               "tests/native", "-k", "not memory"]  # fmt: skip
    # freed memory is kept to be watched, so it grows; the archive's tests look at the real library
    for name in ("archive", "sanitizers"):
        command.append(f"--ignore=tests/native/test_native_{name}.py")
    done = subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, (done.stdout + done.stderr)[-5000:]
    assert "passed" in done.stdout
