"""A checksum at the end of a stored file: a single wrong bit is found when the file is read.

The readers of NetCDF and of npz (ZIP) files pass over what stands behind their data, so the files
stay what they are for every other program.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import BinaryIO

from gearlube_core.errors import FileError

_MARK = b"\ngearlube SHA-256 "
_LENGTH = len(_MARK) + 64 + 1  # of the last line: mark, hexadecimal digits, end of line
_TOGETHER = 1 << 20  # bytes


def seal(path: Path, *, flush: bool = False) -> None:
    """Write the checksum of a whole file at its end, and flush it to the disk if asked."""
    with path.open("r+b") as stream:
        stream.write(_last_line(stream, stream.seek(0, os.SEEK_END)))
        if flush:
            stream.flush()
            os.fsync(stream.fileno())


def check_seal(stream: BinaryIO, where: str) -> bool:
    """Return whether a file has a checksum; raise FileError, naming it `where`, for a wrong one."""
    end = max(stream.seek(0, os.SEEK_END) - _LENGTH, 0)
    stream.seek(end)
    given = stream.read()
    if not given.startswith(_MARK):
        return False
    if given != _last_line(stream, end):
        raise FileError(
            f"{where} is damaged: its content does not belong to the checksum at its end. Write "
            "it again, or take a copy of it."
        )
    return True


def file_hash(path: Path) -> str:
    """Return the SHA-256 of a file as hexadecimal digits; "" for none that can be read."""
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""


def _last_line(stream: BinaryIO, size: int) -> bytes:
    """Return the last line of a file whose first `size` bytes are its content."""
    digest = hashlib.sha256()
    stream.seek(0)
    while size > 0 and (part := stream.read(min(size, _TOGETHER))):
        digest.update(part)
        size -= len(part)
    return _MARK + digest.hexdigest().encode() + b"\n"
