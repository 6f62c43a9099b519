"""Equal FMUs from equal sources: a GUID of interface and sources, and zips without dates."""

from __future__ import annotations

import hashlib
import os
import tempfile
import zipfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from uuid import UUID

from fmu_src.definition import Definition
from fmu_src.model_description import model_description
from fmu_src.wrapper import forget_search_path
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.source_code import code_of
from gearlube_core.kernels.source_files import source_files

_LICENCES = Path(__file__).with_name("licences")
_EARLIEST = (1980, 1, 1, 0, 0, 0)  # earliest time of the zip format
_REGULAR_FILE = 0o100644 << 16
IDENTITY_FILE = "gearlube_identity.txt"
_HERE = Path(__file__).parent  # beside it lie the packages of this project


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


def contents(definition: Definition) -> dict[str, bytes]:
    """Return all code and shipped data that an FMU uses, by path in the package.

    These are the slave's module and what it imports, the sources of the definition, without
    comments and docstrings, and the data that it names.
    """
    slave = str(_HERE / f"{definition.slave}.py")
    code = {
        _name(Path(path)): code_of(Path(path).read_text(encoding="utf-8")).encode()
        for file in (slave, *definition.sources)
        for path in source_files(file)
    }
    data = {
        _name(path): path.read_bytes()
        for pattern in definition.shipped_data
        for path in _HERE.parent.glob(pattern)
    }
    for name in data:
        if name.endswith(".toml"):
            data[name] = data[name].replace(b"\r\n", b"\n")
    return code | data


def _name(path: Path) -> str:
    own = path.is_relative_to(_HERE.parent)
    return path.relative_to(_HERE.parent).as_posix() if own else path.name


@cache
def source_digest(definition: Definition) -> bytes:
    """Return SHA-256 over `contents`."""
    digest = hashlib.sha256()
    for name, content in sorted(contents(definition).items()):
        digest.update(f"{name}\0".encode() + hashlib.sha256(content).digest())
    return digest.digest()


@cache
def interface_digest(definition: Definition) -> bytes:
    """Return SHA-256 of the model description without its GUID."""
    return hashlib.sha256(model_description(definition, "")).digest()


@cache
def guid_of(definition: Definition) -> UUID:
    """Return the GUID: equal content has an equal GUID, on every machine."""
    digest = hashlib.sha256(interface_digest(definition) + source_digest(definition))
    for name in sorted(definition.resources):
        content = hashlib.sha256(definition.resources[name]).digest()
        digest.update(f"{name}\0".encode() + content)
    return UUID(bytes=digest.digest()[:16])


def identity_text(definition: Definition) -> str:
    """Return the text in an FMU's resources that identifies the package it was built from."""
    return f"{interface_digest(definition).hex()}\n{guid_of(definition)}\n"


def check_identity(definition: Definition, resources: str) -> str:
    """Compare the FMU around `resources` with the installed package; return a warning, or ''.

    An FMU whose variables differ from those of the package is refused with a ParameterError.
    """
    identity = Path(resources) / IDENTITY_FILE
    if not identity.is_file():
        return ""
    forget_search_path(resources)
    built, installed = identity.read_text().split(), identity_text(definition).split()
    cure = "Rebuild it with `gearlube build-fmu`."
    if built[0] != installed[0]:
        raise ParameterError(
            f"{definition.name}.fmu must have the variables of the installed gearlube, but it was "
            f"built from another version. {cure}"
        )
    if built != installed:
        return (
            f"{definition.name}.fmu was built from other sources than the installed gearlube, "
            f"which computes the results, or its resources were changed. {cure}"
        )
    return ""
