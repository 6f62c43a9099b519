"""The native FMUs built once for all processes of a test run."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from fmu_src.native.build import NativeOptions, build_native
from fmu_src.native.models import native_model
from fmu_src.native.platforms import platform_of_this_machine
from tests.helpers.fmu_cases import Case
from tests.helpers.session_folder import alone, shared_folder


class NativeFmus(NamedTuple):
    """Paths of the FMU of each version of FMI."""

    fmi2: Path
    fmi3: Path


def native_fmus(case: Case, platform: str = "") -> NativeFmus:
    """Return the FMUs of a case for a platform, by default this machine's; half a minute."""
    platform = platform or platform_of_this_machine()
    folder = shared_folder(f"native_fmus_{platform}")
    fmus = NativeFmus(*(folder / f"{case.name}{ending}.fmu" for ending in ("", "_FMI3")))
    with alone(folder / f"{case.name}.lock"):
        if not fmus.fmi3.is_file():
            options = NativeOptions(platforms=[platform])
            build_native(native_model(case.definition), folder, options)
    return fmus
