"""Folders of results: one run at a time in each, and the one of what may be deleted at any time."""

from __future__ import annotations

import atexit
import errno
import json
import logging
import multiprocessing
import os
import platform
import shutil
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from functools import cache
from pathlib import Path

from gearlube_core.errors import ParameterError

logger = logging.getLogger(__name__)

FOLDER_VARIABLE = "GEARLUBE_CACHE"
LOCK = ".gearlube_lock"
_BEHIND = 1 << 30  # [byte]; Windows lets nobody read bytes that are locked
_held: dict[Path, int] = {}  # folders that this process writes to, with the thread


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


@contextmanager
def locked_folder(folder: Path) -> Iterator[None]:
    """Keep other runs out of a folder that is there.

    The operating system lets go of the lock when a process ends, however it ends. A thread may
    lock a folder that it has locked already.

    Raises
    ------
    ParameterError
        Another run has locked the folder; the message says which.
    """
    place = folder.resolve()
    if _held.get(place) == threading.get_ident():
        yield
        return
    descriptor = _locked(place)
    _held[place] = threading.get_ident()
    try:
        yield
    finally:
        del _held[place]
        _unlock(descriptor, place / LOCK)


def _locked(folder: Path) -> int:
    """Return the descriptor of the folder's lock, with this process named in it."""
    path = folder / LOCK
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o644)
        try:
            _lock(descriptor)
        except OSError as reason:
            if reason.errno in (errno.EAGAIN, errno.EACCES, errno.EDEADLK):
                holder = _holder(descriptor)
                os.close(descriptor)
                raise ParameterError(
                    f"The folder of results must be one that no other run writes to, got {folder}, "
                    f"where {holder} writes. Wait until it has ended, or give another folder."
                ) from None
            logger.warning(
                "%s cannot be locked: %s. Start no second run there before this one has ended.",
                folder,
                (reason.strerror or str(reason)).lower(),
            )
        # another run may have removed the file between the two calls
        if sys.platform == "win32" or _is_at(descriptor, path):
            break
        os.close(descriptor)
    started = datetime.now().astimezone().isoformat(" ", "seconds")
    os.truncate(descriptor, 0)
    own = {"process": os.getpid(), "host": platform.node(), "started": started}
    os.write(descriptor, json.dumps(own).encode())
    return descriptor


def _holder(descriptor: int) -> str:
    try:
        found = json.loads(os.read(descriptor, 1000))
        return f"process {found['process']} on {found['host']}, started {found['started']},"
    except (ValueError, KeyError, TypeError):  # it has not written its name yet
        return "another process"


def _is_at(descriptor: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(descriptor), path.stat())
    except FileNotFoundError:
        return False


if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> None:
        os.lseek(descriptor, _BEHIND, os.SEEK_SET)
        try:
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        finally:
            os.lseek(descriptor, 0, os.SEEK_SET)

    def _unlock(descriptor: int, path: Path) -> None:
        os.close(descriptor)
        with suppress(OSError):  # a run that waits has it open
            path.unlink()
else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def _unlock(descriptor: int, path: Path) -> None:
        path.unlink(missing_ok=True)
        os.close(descriptor)
