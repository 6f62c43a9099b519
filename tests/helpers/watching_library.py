"""A native library that watches its own memory and arithmetic: sanitizers in C code and kernels.

gcc instruments the C code. The kernels are instrumented by the clang of ziglang, whose LLVM reads
the intermediate code of numba's; gcc's run-time library serves both.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from fmu_src.native.build import ENTRY, library_kind
from fmu_src.native.model import ENTRY_SIGNATURE, NativeModel
from fmu_src.native.platforms import fmi_headers
from fmu_src.native.sources import c_sources
from fmu_src.object_code import LINUX, intermediate_code, optimised
from tests.helpers.small_native_builds import unpacked

COMPILER = shutil.which("gcc")
NO_COMPILER = (
    "Watching a library needs gcc, whose run-time library does the watching, not found. "
    "Install gcc 12 or newer, for instance by `apt install gcc`."
)
_WATCHES = ["-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all"]
_FLAGS = ["-std=c99", "-g", "-O1", "-shared", "-fPIC", "-ffp-contract=off", "-I.", *_WATCHES,
          "-fno-omit-frame-pointer"]  # fmt: skip
_KERNELS = ["-target", "x86_64-linux-gnu.2.17", "-c", "-O1", "-fPIC", "-fsanitize=address"]


def _watching_kernels(model: NativeModel, folder: Path) -> None:
    """Write `kernels.o`, in which every access to memory is checked, into `folder`."""
    module, _ = optimised(intermediate_code(model.entry, ENTRY_SIGNATURE, ENTRY), LINUX)  # type: ignore[arg-type]
    for function in module.functions:
        if not function.is_declaration:
            function.add_function_attribute("sanitize_address")
    (folder / "kernels.ll").write_text(str(module))
    command = [sys.executable, "-m", "ziglang", "cc", *_KERNELS, "kernels.ll", "-o", "kernels.o"]
    subprocess.run(command, cwd=folder, check=True)


def watching_library(model: NativeModel, folder: Path) -> Path:
    """Build the library of a model in `folder`, with its sources; return its path, as in an FMU."""
    sources = c_sources(model, library_kind(model)) | fmi_headers()
    for name, text in {**sources, **model.c_code}.items():
        (folder / name).write_text(text)
    files = sorted(name for name in sources if name.endswith(".c"))
    if model.entry:
        _watching_kernels(model, folder)
        files.append("kernels.o")
    else:
        files.append(next(iter(model.c_code)))  # which includes the others
    path = folder / f"{model.definition.name}.so"
    command = [str(COMPILER), *_FLAGS, *files, "-o", str(path), "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    return unpacked(model, folder, path.read_bytes())


def watching_environment() -> dict[str, str]:
    """Return the environment in which Python can load such a library."""
    found = subprocess.run(
        [str(COMPILER), "-print-file-name=libasan.so"], check=True, capture_output=True, text=True
    )
    return os.environ | {
        # and what throws the exceptions of C++ code, such as matplotlib's
        "LD_PRELOAD": f"{found.stdout.strip()} libstdc++.so.6",
        "ASAN_OPTIONS": "detect_leaks=0",  # Python's own
        "PYTHONMALLOC": "malloc",  # so that places given by the tests are watched too
    }
