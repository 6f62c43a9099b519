"""A folder that all processes of one test run share, for what takes long to compute."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

_VARIABLE = "GEARLUBE_TEST_RUN"


def open_session_folder() -> tempfile.TemporaryDirectory[str] | None:
    """Make the folder in the process that starts the workers; return None in a worker."""
    if _VARIABLE in os.environ:
        return None
    folder = tempfile.TemporaryDirectory(prefix="gearlube-tests-")
    os.environ[_VARIABLE] = folder.name
    _share_bytecode(folder.name)
    return folder


def _share_bytecode(folder: str) -> None:
    """Keep the bytecode of imports for all processes of the run, where none is kept otherwise.

    With `pip install --no-compile` and PYTHONDONTWRITEBYTECODE every process would compile numpy,
    scipy and numba again: 3 s each.
    """
    numpy = find_spec("numpy")
    if sys.dont_write_bytecode and numpy and not os.path.exists(numpy.cached or ""):
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ["PYTHONPYCACHEPREFIX"] = os.path.join(folder, "bytecode")


def shared_folder(name: str) -> Path:
    """Return a folder in that of the test run."""
    path = Path(os.environ[_VARIABLE]) / name
    path.mkdir(exist_ok=True)
    return path


@contextlib.contextmanager
def alone(lock: Path) -> Iterator[None]:
    """Let one process of the test run in at a time; `lock` is a file that does not exist."""
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
