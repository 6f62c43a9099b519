"""The small native model built once for all processes of a test run."""

from __future__ import annotations

from pathlib import Path

from fmu_src.native.build import libraries, library_kind, native_guid
from fmu_src.native.model import NativeModel
from fmu_src.native.model_file import MODEL_FILE, model_file
from fmu_src.native.platforms import PLATFORMS, Platform
from tests.helpers.native_library import NativeLibrary
from tests.helpers.session_folder import alone, shared_folder
from tests.helpers.small_native_model import small_native_model

MODEL = small_native_model()
# for co-simulation only
LAZY_MODEL = small_native_model(motion=frozenset({"pinion.speed"}), exchange=None)
LINUX = PLATFORMS[0]


def unpacked(model: NativeModel, folder: Path, library: bytes, platform: Platform = LINUX) -> Path:
    """Write a library and its model as in an FMU; return the library's path."""
    (folder / "resources").mkdir(parents=True, exist_ok=True)
    content = model_file(model, library_kind(model), native_guid(model))
    (folder / "resources" / MODEL_FILE).write_bytes(content)
    path = folder / "binaries" / platform.name / f"{model.definition.name}{platform.suffix}"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(library)
    return path


def linux_library(model: NativeModel = MODEL) -> Path:
    """Return the path of a model's library for the machines that run the tests."""
    folder = shared_folder("lazy_native_model" if model.motion else "small_native_model")
    path = folder / "binaries" / LINUX.name / "RotatingMass.so"
    with alone(folder / "lock"):
        if not path.is_file():
            unpacked(model, folder, libraries(model, [LINUX])[LINUX.name])
    return path


def loaded(version: int, path: Path | None = None, model: NativeModel = MODEL) -> NativeLibrary:
    """Return the library for calls by a version of FMI."""
    return NativeLibrary(path or linux_library(model), model, str(native_guid(model)), version)
