"""Which FMU this is: a GUID made from its interface and the sources behind it."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path
from uuid import UUID

import fmu_src
import gearlube_core
from fmu_src.definition import Definition
from fmu_src.model_description import model_description
from fmu_src.wrapper import forget_search_path
from gearlube_core.errors import ParameterError

IDENTITY_FILE = "gearlube_identity.txt"
# Modules that run inside every FMU, beside `Definition.modules`; the others build FMUs.
RUNTIME = (
    "compile_ahead", "definition", "host_thread", "identity", "model_description", "phase",
    "registration", "shared_variables", "slave_base", "state_bytes", "units", "values", "variable",
    "variable_kinds", "wrapper",
)  # fmt: skip
_TEXT = {".py", ".toml"}
_DATA = {".nc"}


@cache
def source_digest(modules: tuple[str, ...]) -> bytes:
    """Return SHA-256 over all sources and data that decide the results of an FMU.

    Parameters
    ----------
    modules : tuple of str
        `Definition.modules`.
    """
    core = Path(str(gearlube_core.__file__)).parent
    slave = Path(str(fmu_src.__file__)).parent
    files = {
        path.relative_to(core.parent).as_posix(): path
        for path in core.rglob("*")
        if path.suffix in _TEXT | _DATA
    } | {f"{slave.name}/{module}.py": slave / f"{module}.py" for module in (*RUNTIME, *modules)}
    digest = hashlib.sha256()
    for name in sorted(files):
        content = files[name].read_bytes()
        if files[name].suffix in _TEXT:
            content = content.replace(b"\r\n", b"\n")
        digest.update(f"{name}\0".encode() + hashlib.sha256(content).digest())
    return digest.digest()


@cache
def interface_digest(definition: Definition) -> bytes:
    """Return SHA-256 of the model description without its GUID."""
    return hashlib.sha256(model_description(definition, "")).digest()


@cache
def guid_of(definition: Definition) -> UUID:
    """Return the GUID: equal content has an equal GUID, on every machine."""
    digest = hashlib.sha256(interface_digest(definition) + source_digest(definition.modules))
    for name in sorted(definition.resources):
        content = hashlib.sha256(definition.resources[name]).digest()
        digest.update(f"{name}\0".encode() + content)
    return UUID(bytes=digest.digest()[:16])


def identity_text(definition: Definition) -> str:
    """Return what an FMU carries in its resources to recognise the package it was built from."""
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
            f"{definition.name}.fmu must have the variables of the installed gearlube, "
            f"it was built from another version. {cure}"
        )
    if built != installed:
        return (
            f"{definition.name}.fmu was built from other sources than the installed gearlube, "
            f"which computes the results, or its resources were changed. {cure}"
        )
    return ""
