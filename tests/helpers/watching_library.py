"""A native library that watches its own memory and arithmetic: gcc's sanitizers."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

from fmu_src.native.build import ENTRY, native_guid
from fmu_src.native.model import ENTRY_SIGNATURE, NativeModel
from fmu_src.native.platforms import fmi_headers
from fmu_src.native.sources import c_sources
from fmu_src.object_code import LINUX, intermediate_code, object_code

COMPILER = shutil.which("gcc")
_FLAGS = ["-std=c99", "-g", "-O1", "-shared", "-fPIC", "-ffp-contract=off", "-I.",
          "-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all",
          "-fno-omit-frame-pointer"]  # fmt: skip


def watching_library(model: NativeModel, folder: Path) -> Path:
    """Build the library of a model with its sources into `folder`; return its path."""
    sources = c_sources(model, str(native_guid(model))) | fmi_headers()
    for name, text in sources.items():
        (folder / name).write_text(text)
    code = intermediate_code(model.entry, ENTRY_SIGNATURE, ENTRY)
    (folder / "kernels.o").write_bytes(object_code(code, LINUX)[0])
    files = sorted(name for name in sources if name.endswith(".c"))
    path = folder / f"{model.definition.name}.so"
    command = [str(COMPILER), *_FLAGS, *files, "kernels.o", "-o", str(path), "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    return path


def watching_environment() -> dict[str, str]:
    """Return the environment in which Python can load such a library."""
    found = subprocess.run(
        [str(COMPILER), "-print-file-name=libasan.so"], check=True, capture_output=True, text=True
    )
    return os.environ | {
        "LD_PRELOAD": found.stdout.strip(),
        "ASAN_OPTIONS": "detect_leaks=0",  # Python's own
        "PYTHONMALLOC": "malloc",  # so that places given by the tests are watched too
    }
