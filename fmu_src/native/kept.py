"""Shared libraries that are kept: those that ship with the package, and those built here before.

A library is kept by all that makes it, so one that is found is what a build would give. Each file
begins with a digest of what follows; one that does not fit it is built once more.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from gearlube_core.errors import ParameterError
from gearlube_core.storage.folders import cache_folder, locked_folder

PREBUILT = Path(__file__).with_name("prebuilt")
_DIGEST_SIZE = hashlib.sha256().digest_size
_PAUSE = 0.1  # s, between looks at a folder that another process writes to
_UNUSED = 90 * 86400.0  # s, after which libraries that nobody took are removed


def kept_file(folder: Path, platform: str) -> Path:
    """Return the path of the library for a platform."""
    return folder / f"{platform}.kept"


def kept_library(folder: Path, platform: str) -> bytes | None:
    """Return the library that is kept in a folder; None without one, or if it is damaged."""
    try:
        content = kept_file(folder, platform).read_bytes()
    except OSError:
        return None
    library = content[_DIGEST_SIZE:]
    return library if hashlib.sha256(library).digest() == content[:_DIGEST_SIZE] else None


def keep_library(folder: Path, platform: str, library: bytes) -> None:
    """Keep a library, in one atomic move; where nothing can be written it is not kept."""
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=folder, prefix=".")
        with os.fdopen(handle, "wb") as stream:
            stream.write(hashlib.sha256(library).digest() + library)
        os.chmod(temporary, 0o644)
        os.replace(temporary, kept_file(folder, platform))


@contextmanager
def one_builds(key: str, platforms: Sequence[str], report: Callable[[str], None]) -> Iterator[Path]:
    """Give the folder of a key; other processes that want the same wait until this one is done.

    They wait no longer than until the libraries for all their platforms are kept. Where nothing can
    be written each process builds for itself. Folders that nobody has locked for _UNUSED are
    removed.
    """
    folder = cache_folder("libraries") / key
    with ExitStack() as held:
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            _remove_unused(folder)
            waits = False
            while True:
                try:
                    held.enter_context(locked_folder(folder))
                except ParameterError:
                    if all(kept_file(folder, one).is_file() for one in platforms):
                        break
                    if not waits:
                        report(f"waiting for another process that builds the same ({folder})")
                    waits = True
                    time.sleep(_PAUSE)
                    continue
                break
        yield folder


def _remove_unused(mine: Path) -> None:
    """Remove the folders beside mine whose files are all older than _UNUSED."""
    oldest = time.time() - _UNUSED
    for other in mine.parent.iterdir():
        newest = max((one.stat().st_mtime for one in (other, *other.glob("*"))), default=0.0)
        if other != mine and other.is_dir() and newest < oldest:
            shutil.rmtree(other, ignore_errors=True)
