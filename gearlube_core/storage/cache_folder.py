"""The folder of what is computed once and may be deleted at any time."""

from __future__ import annotations

import atexit
import logging
import multiprocessing
import os
import shutil
import tempfile
from functools import cache
from pathlib import Path

logger = logging.getLogger(__name__)

FOLDER_VARIABLE = "GEARLUBE_CACHE"


def cache_folder(part: str, folder: Path | str | None = None) -> Path:
    """Return `part` of `folder`, else of the variable GEARLUBE_CACHE, else of the user's cache.

    >>> cache_folder("contact", "/data/cache").as_posix()
    '/data/cache/contact'
    """
    chosen = folder if folder is not None else os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen) / part
    return user_folder() / part


def user_folder() -> Path:
    """Return the user's cache; where it cannot be written, a temporary folder of this process."""
    from platformdirs import user_cache_path

    folder: Path = user_cache_path("gearlube")
    there = next(one for one in (folder, *folder.parents) if one.exists())
    # without a home the path begins with "~"
    return folder if folder.is_absolute() and os.access(there, os.W_OK) else _temporary(folder)


@cache
def _temporary(folder: Path) -> Path:
    found = Path(tempfile.mkdtemp(prefix="gearlube-cache-"))
    atexit.register(shutil.rmtree, found, ignore_errors=True)
    if multiprocessing.parent_process() is None:  # workers are silent
        logger.warning(
            "%s cannot be written: what a run prepares (mesh tables, FMUs) is not kept for the "
            "next. Set %s to a folder that can be written to keep mesh tables.",
            folder,
            FOLDER_VARIABLE,
        )
    return found
