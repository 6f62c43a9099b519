"""The native FMUs built once for all processes of a test run."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import fmpy
import pytest

from fmu_src.native import build
from fmu_src.native.build import NativeOptions, build_native, native_guid
from fmu_src.native.models import native_model
from fmu_src.native.platforms import PLATFORMS, platform_of_this_machine
from fmu_src.object_code import LINUX
from tests.helpers.fmu_cases import Case
from tests.helpers.native_library import NativeLibrary
from tests.helpers.object_code import object_code_once
from tests.helpers.session_folder import alone, shared_folder

_TARGETS = {one.name: one.target for one in PLATFORMS}


class NativeFmus(NamedTuple):
    """Paths of the FMU of each version of FMI."""

    fmi2: Path
    fmi3: Path


def native_fmus(case: Case, platform: str = "") -> NativeFmus:
    """Return the FMUs of a case for a platform, by default this machine's; half a minute."""
    platform = platform or platform_of_this_machine()
    folder = shared_folder(f"native_fmus_{platform}")
    fmus = NativeFmus(*(folder / f"{case.name}{ending}.fmu" for ending in ("", "_FMI3")))
    with alone(folder / f"{case.name}.lock"), pytest.MonkeyPatch.context() as patch:
        if not fmus.fmi3.is_file():
            model, options = native_model(case.definition), NativeOptions(platforms=[platform])
            if _TARGETS[platform] == LINUX:  # tests of the entry take the same code
                patch.setattr(build, "kernel_code", lambda *_: "made once")
                patch.setattr(build, "object_code", lambda *_: object_code_once(model))
            build_native(model, folder, options)
    return fmus


def unpacked_library(fmu: Path, version: int, folder: Path) -> Path:
    """Return the path of this machine's library in an FMU, unpacked into `folder`."""
    platform = platform_of_this_machine()
    (suffix,) = (one.suffix for one in PLATFORMS if one.name == platform)
    name = fmu.stem.removesuffix("_FMI3")
    there = "linux64" if version == 2 else platform
    return Path(fmpy.extract(str(fmu), str(folder))) / "binaries" / there / f"{name}{suffix}"


def native_library(case: Case, version: int, folder: Path) -> NativeLibrary:
    """Return the library of a case's FMU, unpacked into `folder`."""
    fmus = native_fmus(case)
    path = unpacked_library(fmus.fmi2 if version == 2 else fmus.fmi3, version, folder)
    model = native_model(case.definition)
    return NativeLibrary(path, model, str(native_guid(model)), version)
