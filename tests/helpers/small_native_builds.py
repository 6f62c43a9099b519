"""The small native model built once for all processes of a test run."""

from __future__ import annotations

from pathlib import Path

from fmu_src.native.build import libraries, native_guid
from fmu_src.native.model import NativeModel
from fmu_src.native.platforms import PLATFORMS
from tests.helpers.native_library import NativeLibrary
from tests.helpers.session_folder import alone, shared_folder
from tests.helpers.small_native_model import small_native_model

MODEL = small_native_model()
# for co-simulation only
LAZY_MODEL = small_native_model(motion=frozenset({"pinion.speed"}), exchange=None)
LINUX = PLATFORMS[0]


def linux_library(model: NativeModel = MODEL) -> Path:
    """Return the path of a model's library for the machines that run the tests."""
    folder = shared_folder("lazy_native_model" if model.motion else "small_native_model")
    path = folder / "RotatingMass.so"
    with alone(folder / "lock"):
        if not path.is_file():
            path.write_bytes(libraries(model, [LINUX])[LINUX.name])
    return path


def loaded(version: int, path: Path | None = None, model: NativeModel = MODEL) -> NativeLibrary:
    """Return the library for calls by a version of FMI."""
    return NativeLibrary(path or linux_library(model), model, str(native_guid(model)), version)
