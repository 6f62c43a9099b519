"""Zip files that are equal whenever their content is equal."""

from __future__ import annotations

import os
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path

_LICENCES = Path(__file__).with_name("licences")
_EARLIEST = (1980, 1, 1, 0, 0, 0)  # earliest time of the zip format
_REGULAR_FILE = 0o100644 << 16


def licence_texts(kind: str) -> dict[str, bytes]:
    """Return gearlube's licence and those of the parts of a "native" or "python" FMU, by name."""
    paths = sorted([*_LICENCES.glob("*.txt"), *(_LICENCES / kind).glob("*.txt")])
    return {f"documentation/licenses/{path.name}": path.read_bytes() for path in paths}


def write_archive(path: Path, content: Mapping[str, bytes]) -> None:
    """Write `content` (name in the archive -> bytes) to `path` in one atomic move.

    Entries are sorted, without time stamps, and stored uncompressed: the output of zlib differs
    between its implementations.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as stream, zipfile.ZipFile(stream, "w") as archive:
            for name in sorted(content):
                entry = zipfile.ZipInfo(name, _EARLIEST)
                entry.create_system = 3
                entry.external_attr = _REGULAR_FILE
                archive.writestr(entry, content[name])
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
