"""A folder that all processes of one test run share, for what takes long to compute."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

_VARIABLE = "GEARLUBE_TEST_RUN"


def open_session_folder() -> tempfile.TemporaryDirectory[str] | None:
    """Make the folder in the process that starts the workers; return None in a worker."""
    if _VARIABLE in os.environ:
        return None
    folder = tempfile.TemporaryDirectory(prefix="gearlube-tests-")
    os.environ[_VARIABLE] = folder.name
    return folder


def shared_folder(name: str) -> Path:
    """Return a folder in that of the test run."""
    path = Path(os.environ[_VARIABLE]) / name
    path.mkdir(exist_ok=True)
    return path
