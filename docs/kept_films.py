"""Films of docs' scripts, each solved once and kept in a folder."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.storage.atomic_file import write_arrays

logger = logging.getLogger("docs.kept_films")


class MissingFilmError(Exception):
    """A film is not in the folder and may not be computed."""


class KeptFilms:
    """Arrays by their names in a folder.

    Parameters
    ----------
    folder
        Made if it is not there.
    compute
        Whether what is missing is computed; else it raises `MissingFilmError`.
    """

    def __init__(self, folder: Path, compute: bool = True) -> None:
        self.folder, self.compute = folder, compute
        folder.mkdir(parents=True, exist_ok=True)

    def kept(self, name: str, compute: Callable[[], Mapping[str, Any]]) -> dict[str, Any]:
        """Return the arrays of a name, computed if they are not in the folder."""
        path = self.folder / f"{name}.npz"
        if not path.exists():
            if not self.compute:
                raise MissingFilmError(name)
            logger.info("computing %s", name)
            write_arrays(path, compute(), compress=True)
        with np.load(path) as data:
            return {key: data[key] for key in data.files}
