"""Platforms of the native FMUs, and how a shared library is linked for each on any machine."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from platform import machine as machine_name
from platform import system as system_name
from typing import NamedTuple

from fmu_src.object_code import LINUX, Target
from gearlube_core.errors import GearLubeError


class Platform(NamedTuple):
    """One kind of machine.

    Parameters
    ----------
    name : str
        Folder of its library in an FMU of FMI 3.
    target : Target
        Of the kernels.
    zig : str
        Target of the linker, with the oldest C library that the binary runs with.
    suffix : str
        Of a shared library.
    guards : tuple of str
        Options of the compiler against jumps and returns to places that an attacker chose.
    """

    name: str
    target: Target
    zig: str
    suffix: str
    guards: tuple[str, ...] = ()


_INTEL_GUARDS = ("-fcf-protection=full",)
_ARM_GUARDS = ("-mbranch-protection=standard",)
PLATFORMS = (
    Platform("x86_64-linux", LINUX, "x86_64-linux-gnu.2.17", ".so", _INTEL_GUARDS),
    Platform(
        "x86_64-windows", Target("x86_64-w64-windows-gnu", LINUX.cpu), "x86_64-windows-gnu", ".dll"
    ),
    Platform(
        "x86_64-darwin", Target("x86_64-apple-macosx11.0", LINUX.cpu), "x86_64-macos.11.0", ".dylib"
    ),
    Platform(
        "aarch64-darwin",
        Target("aarch64-apple-macosx11.0", "apple-m1"),
        "aarch64-macos.11.0",
        ".dylib",
    ),
    Platform(
        "aarch64-linux",
        Target("aarch64-unknown-linux-gnu", "generic"),
        "aarch64-linux-gnu.2.17",
        ".so",
        _ARM_GUARDS,
    ),
)
PLATFORM_NAMES = tuple(platform.name for platform in PLATFORMS)
# folder in an FMU of FMI 2 -> platforms whose libraries go there as one file
FMI2_FOLDERS = {
    "linux64": ("x86_64-linux",),
    "win64": ("x86_64-windows",),
    "darwin64": ("x86_64-darwin", "aarch64-darwin"),
    "aarch64-linux": ("aarch64-linux",),
}
BUILD_OPTIONS = ("-std=c99", "-O2", "-fPIC", "-fvisibility=hidden", "-fstack-protector-strong",
            "-ffp-contract=off")  # fmt: skip
_FAT_MAGIC, _DYLIB_ALIGNMENT = 0xCAFEBABE, 14
_MACHINES = {"x86_64-darwin": (0x01000007, 3), "aarch64-darwin": (0x0100000C, 0)}


def fmi_headers() -> dict[str, str]:
    """Return the C headers of FMI 2 and FMI 3 by name."""
    spec = find_spec("fmpy")
    if spec is None or spec.origin is None:
        raise GearLubeError(
            "Building a native FMU needs the FMI headers of fmpy, not found. "
            "Install it with `pip install fmpy`."
        )
    folder = Path(spec.origin).parent / "c-code"
    return {path.name: path.read_text("utf-8") for path in sorted(folder.glob("fmi[23]*.h"))}


def check_linker() -> None:
    """Raise a GearLubeError where the linker is missing."""
    if find_spec("ziglang") is None:
        raise GearLubeError(
            "Building a native FMU needs the compiler package ziglang, not found. Install it with "
            "`pip install ziglang`, or build an axle or a pair that runs in Python with --python."
        )


def c_object(platform: Platform, code: Mapping[str, str], headers: Mapping[str, str]) -> bytes:
    """Return the object file of C code for a platform.

    Parameters
    ----------
    platform : Platform
    code : mapping of str to str
        Files by name; the first is compiled and includes the others.
    headers : mapping of str to str
        Files that they include too.

    Raises
    ------
    GearLubeError
        The compiler is missing or fails; the message ends with its last words.
    """
    check_linker()
    main = next(iter(code))
    options = ["-w", "-DCASADI_SYMBOL_EXPORT=", "-c", main]  # casadi's functions stay inside
    return _compiled(platform, {**headers, **code}, options, "entry.o", main)


def shared_library(
    platform: Platform, sources: Mapping[str, str], kernels: bytes, name: str
) -> bytes:
    """Return the shared library of C sources and object code for a platform.

    Parameters
    ----------
    platform : Platform
    sources : mapping of str to str
        C files and headers by name.
    kernels : bytes
        Object file for the platform's target.
    name : str
        Of the library, without suffix.

    Raises
    ------
    GearLubeError
        The linker is missing or fails; the message ends with its last words.
    """
    check_linker()
    files = sorted(file for file in sources if file.endswith(".c"))
    library = f"{name}{platform.suffix}"
    warnings = ["-Wall", "-Wextra", "-Wno-unused-parameter"]  # FMI gives more than an FMU needs
    options = ["-s", "-shared", *warnings, "-I.", *files, "kernels.o", "-lm"]
    if "linux" in platform.name:
        options.append("-ldl")
    return _compiled(platform, {**sources, "kernels.o": kernels}, options, library, name)


def _compiled(
    platform: Platform,
    files: Mapping[str, str | bytes],
    options: Sequence[str],
    wanted: str,
    name: str,
) -> bytes:
    """Return the file `wanted` that the compiler makes of others with these options."""
    with tempfile.TemporaryDirectory() as folder:
        for file, content in files.items():
            data = content.encode() if isinstance(content, str) else content
            Path(folder, file).write_bytes(data)
        command = [
            sys.executable, "-m", "ziglang", "cc", "-target", platform.zig, *BUILD_OPTIONS,
            *platform.guards, *options, "-o", wanted,
        ]  # fmt: skip
        run = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=_settings())
        if run.returncode != 0 or not Path(folder, wanted).is_file():
            last = "\n".join(run.stderr.strip().splitlines()[-20:])
            raise GearLubeError(f"{name} cannot be linked for {platform.name}:\n{last}")
        return Path(folder, wanted).read_bytes()


def _settings() -> dict[str, str]:
    """Return the environment without what would change a build."""
    return {name: value for name, value in os.environ.items() if name not in ("CFLAGS", "LDFLAGS")}


def universal_library(libraries: Mapping[str, bytes]) -> bytes:
    """Return one macOS library for both processors, by name of the platform.

    The format is Apple's fat binary: a big-endian table of machine, place and size, then the
    libraries at multiples of 2**14 bytes.
    """
    align = 1 << _DYLIB_ALIGNMENT
    content, table, place = b"", b"", align
    for platform in sorted(libraries):
        library = libraries[platform]
        table += struct.pack(">5I", *_MACHINES[platform], place, len(library), _DYLIB_ALIGNMENT)
        padding = -len(library) % align
        content += library + bytes(padding)
        place += len(library) + padding
    head = struct.pack(">2I", _FAT_MAGIC, len(libraries)) + table
    return head + bytes(align - len(head)) + content


def platform_of_this_machine() -> str:
    """Return the name of the platform that Python runs on here.

    Raises
    ------
    GearLubeError
        No native FMU is built for it.
    """
    machines = {"amd64": "x86_64", "x86_64": "x86_64", "arm64": "aarch64", "aarch64": "aarch64"}
    machine = machines.get(machine_name().lower(), machine_name())
    name = f"{machine}-{system_name().lower()}"
    if name not in PLATFORM_NAMES:
        raise GearLubeError(
            f"Native FMUs are built for {', '.join(PLATFORM_NAMES)}, this machine is {name}. "
            "Build an FMU that computes in Python with --python."
        )
    return name
