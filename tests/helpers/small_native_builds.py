"""The small native model built once for all processes of a test run."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Iterator
from pathlib import Path

from fmu_src.native.build import libraries, native_guid
from fmu_src.native.model import NativeModel
from fmu_src.native.platforms import PLATFORMS
from tests.helpers.native_library import NativeLibrary
from tests.helpers.session_folder import shared_folder
from tests.helpers.small_native_model import small_native_model

MODEL = small_native_model()
LAZY_MODEL = small_native_model(motion=frozenset({"pinion.speed"}))
LINUX = PLATFORMS[0]


@contextlib.contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Let one process at a time in."""
    lock = folder / "lock"
    while True:
        try:
            os.close(os.open(lock, os.O_CREAT | os.O_EXCL))
            break
        except FileExistsError:
            time.sleep(0.05)
    try:
        yield
    finally:
        lock.unlink()


def linux_library(model: NativeModel = MODEL) -> Path:
    """Return the path of a model's library for the machines that run the tests."""
    folder = shared_folder("lazy_native_model" if model.motion else "small_native_model")
    path = folder / "RotatingMass.so"
    with _alone(folder):
        if not path.is_file():
            path.write_bytes(libraries(model, [LINUX])[LINUX.name])
    return path


def loaded(version: int, path: Path | None = None, model: NativeModel = MODEL) -> NativeLibrary:
    """Return the library for calls by a version of FMI."""
    return NativeLibrary(path or linux_library(model), model, str(native_guid(model)), version)
