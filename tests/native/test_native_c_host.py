"""A host in C runs the library, on Linux and, under wine, that of Windows."""

from __future__ import annotations

import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.native.build import libraries, native_guid
from fmu_src.native.platforms import PLATFORMS, fmi_headers
from tests.helpers.native_library import OK, NativeInstance
from tests.helpers.small_native_builds import MODEL, linux_library, loaded, unpacked

HOST = Path(__file__).with_name("small_host.c")
NAMES = ("pinion.angle", "pinion.speed", "wheel.angle", "wheel.speed")
WINE = shutil.which("wine")
PLATFORM = {platform.name: platform for platform in PLATFORMS}


def compiled_host(folder: Path, target: str) -> Path:
    for name, text in fmi_headers().items():
        (folder / name).write_text(text)
    path = folder / ("small_host.exe" if "windows" in target else "small_host")
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target, "-O2", "-I", str(folder),
               str(HOST), "-o", str(path), "-lm"]  # fmt: skip
    subprocess.run(command, check=True, cwd=folder)
    return path


def outputs_of(command: list[str], environment: dict[str, str]) -> list[list[float]]:
    """Return what the host wrote for FMI 2 and FMI 3."""
    command = [*command, str(native_guid(MODEL))]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, env=os.environ | environment
    )
    assert done.returncode == 0, done.stdout + done.stderr
    lines = done.stdout.splitlines()
    assert any("The GUID must be" in line for line in lines)
    assert "pinion.torque must be within -50 to 50 N.m, got nan" in done.stdout
    found = [line.split()[1:] for line in lines if line.startswith("outputs")]
    return [[float(text) for text in row] for row in found]


def expected_outputs() -> list[float]:
    instance = NativeInstance(loaded(2))
    assert instance.start() == OK
    for i in range(500):
        assert instance.set(pinion__torque=5.0 * math.sin(0.01 * i)) == OK
        assert instance.step(1.0 / 1024.0) == OK
    values = [instance.get(name) for name in NAMES]
    instance.close()
    return values


@pytest.mark.slow
def test_a_host_in_c_gets_the_numbers_that_python_gets(tmp_path: Path) -> None:
    host = compiled_host(tmp_path, PLATFORM["x86_64-linux"].zig)
    found = outputs_of([str(host), str(linux_library())], {})
    assert found == 2 * [expected_outputs()]


@pytest.mark.slow
@pytest.mark.skipif(WINE is None, reason="no wine to run a program of Windows")
def test_the_windows_library_gives_the_numbers_of_the_linux_library(tmp_path: Path) -> None:
    platform = PLATFORM["x86_64-windows"]
    built = libraries(MODEL, [platform])[platform.name]
    library = unpacked(MODEL, tmp_path / "fmu", built, platform)
    host = compiled_host(tmp_path, platform.zig)
    environment = {"WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all"}
    found = outputs_of([str(WINE), str(host), str(library)], environment)
    # no function of the C library's mathematics is in the step, and neither machine code has FMAs
    assert found == 2 * [expected_outputs()]
