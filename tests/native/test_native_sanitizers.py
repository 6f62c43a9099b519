"""The tests of this folder once more, on a library that watches its own memory and arithmetic."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.native.build import ENTRY, native_guid
from fmu_src.native.model import ENTRY_SIGNATURE
from fmu_src.native.platforms import fmi_headers
from fmu_src.native.sources import c_sources
from fmu_src.object_code import LINUX, intermediate_code, object_code
from tests.helpers.small_native_builds import MODEL

COMPILER = shutil.which("gcc")
FLAGS = ["-std=c99", "-g", "-O1", "-shared", "-fPIC", "-ffp-contract=off", "-I.",
         "-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all",
         "-fno-omit-frame-pointer"]  # fmt: skip
ROOT = Path(__file__).parents[2]


def _watching_library(folder: Path) -> None:
    sources = c_sources(MODEL, str(native_guid(MODEL))) | fmi_headers()
    for name, text in sources.items():
        (folder / name).write_text(text)
    code = intermediate_code(MODEL.entry, ENTRY_SIGNATURE, ENTRY)
    (folder / "kernels.o").write_bytes(object_code(code, LINUX)[0])
    files = sorted(name for name in sources if name.endswith(".c"))
    command = [str(COMPILER), *FLAGS, *files, "kernels.o", "-o", "RotatingMass.so", "-lm"]
    subprocess.run(command, cwd=folder, check=True)


@pytest.mark.slow
@pytest.mark.skipif(COMPILER is None, reason="no gcc, whose run-time library does the watching")
def test_no_call_leaves_its_memory_or_overflows(tmp_path: Path) -> None:
    folder = tmp_path / "small_native_model"
    folder.mkdir()
    _watching_library(folder)
    found = subprocess.run(
        [str(COMPILER), "-print-file-name=libasan.so"], check=True, capture_output=True, text=True
    )
    environment = os.environ | {
        "LD_PRELOAD": found.stdout.strip(),
        "ASAN_OPTIONS": "detect_leaks=0",  # Python's own
        "PYTHONMALLOC": "malloc",  # so that places given by the tests are watched too
        "GEARLUBE_TEST_RUN": str(tmp_path),  # the library is taken from there
    }
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
