"""Packages that only some formats need."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from gearlube_core.errors import FileError


def needed(package: str, extra: str, what: str) -> Any:
    """Return a package of the optional dependencies `extra`.

    Raises
    ------
    FileError
        It is not installed.
    """
    try:
        return import_module(package)
    except ImportError:
        raise FileError(
            f"{what} is written by the package {package}, which is not installed. Install it: "
            f"pip install 'gearlube[{extra}]'."
        ) from None
