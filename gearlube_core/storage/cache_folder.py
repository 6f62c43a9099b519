"""The folder of what is computed once and may be deleted at any time."""

from __future__ import annotations

import os
from pathlib import Path

FOLDER_VARIABLE = "GEARLUBE_CACHE"


def cache_folder(part: str, folder: Path | str | None = None) -> Path:
    """Return `part` of `folder`, else of the variable GEARLUBE_CACHE, else of the user's cache.

    >>> cache_folder("contact", "/data/cache").as_posix()
    '/data/cache/contact'
    """
    chosen = folder if folder is not None else os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen) / part
    from platformdirs import user_cache_path

    return user_cache_path("gearlube") / part
