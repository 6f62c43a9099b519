"""The source files of a Python file: itself and the project files that it imports.

A file's imports are found by reading its import lines; nothing is imported for it. Imports for
type checkers do not count, nor does the `__init__` of a package where a name comes from one of its
modules. Installed packages and the standard library are left out, except the packages of this
project and the package of the file itself.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
import sysconfig
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

_OURS = frozenset(("gearlube", "gearlube_core", "drivetrain", "fmu_src"))
_INSTALLED = {"site-packages", "dist-packages"}
_STANDARD = os.path.normcase(sysconfig.get_paths()["stdlib"])
_TYPES_ONLY = re.compile(r"^if TYPE_CHECKING:.*\n(?:[ \t]+.*\n|\n)*", re.MULTILINE)
_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+(\.*[\w.]*)[ \t]+import[ \t]+(\([^)]*\)|[^\n]*)|import[ \t]+([^\n]*))",
    re.MULTILINE,
)
_COMMENT = re.compile(r"#[^\n]*")


class _File(NamedTuple):
    version: tuple[int, int]  # mtime [ns] and size [byte]
    digest: bytes
    imports: frozenset[str]  # paths


_files: dict[str, _File] = {}
_stamps: dict[str, str] = {}


def source_files(path: str) -> frozenset[str]:
    """Return the paths of `path` and of all project files that it imports, directly or not.

    Each file is read once in a process, when it is first asked for, because that is the state
    from which its code was loaded.
    """
    found = {path}
    waiting = [path]
    while waiting:
        new = _file(waiting.pop()).imports - found
        found |= new
        waiting += new
    return frozenset(found)


def source_stamp(path: str) -> str:
    """Return a hash of the contents of `source_files(path)`.

    It is found again if the file itself has changed since it was last asked for, as after
    `importlib.reload`.
    """
    if _version(path) != _file(path).version:
        del _files[path]
        _stamps.clear()
    if path not in _stamps:
        digest = hashlib.sha256()
        for one in sorted(_file(file).digest for file in source_files(path)):
            digest.update(one)
        _stamps[path] = digest.hexdigest()
    return _stamps[path]


def _version(path: str) -> tuple[int, int]:
    status = os.stat(path)
    return status.st_mtime_ns, status.st_size


def _file(path: str) -> _File:
    if path not in _files:
        version = _version(path)
        content = Path(path).read_bytes()
        imports = _imported_files(path, content.decode("utf-8", "replace"))
        _files[path] = _File(version, hashlib.sha256(content).digest(), imports)
    return _files[path]


def _imported_files(path: str, text: str) -> frozenset[str]:
    text = _COMMENT.sub("", text.replace("\r\n", "\n"))
    if "TYPE_CHECKING" in text:
        text = _TYPES_ONLY.sub("", text)
    package = _package(path)
    own = package[0] if package else ""
    found: set[str] = set()
    for module, names, modules in _IMPORT.findall(text):
        for name in _names(modules):
            found.add(_module_file(name, own))
        if module:
            dots = len(module) - len(module.lstrip("."))
            parent = (*package[: len(package) - dots + 1], module[dots:]) if dots else (module,)
            for name in _names(names):  # it may be that of a module
                found.add(_module_file(".".join(filter(None, (*parent, name))), own))
    return frozenset(found - {path, ""})


def _names(listed: str) -> list[str]:
    """Return the names in 'a, b as c', with or without brackets."""
    return [name.split()[0] for name in listed.strip("() \t\n").split(",") if name.strip()]


def _package(path: str) -> tuple[str, ...]:
    """Return the names of the packages around a file, the outermost first."""
    names: list[str] = []
    folder = Path(path).parent
    while (folder / "__init__.py").is_file():
        names.insert(0, folder.name)
        folder = folder.parent
    return tuple(names)


@cache
def _module_file(name: str, own: str) -> str:
    """Return the file of a module, or of the module that defines `name`; '' if it is foreign."""
    top, *rest = name.split(".")
    if not top.isidentifier() or top in sys.stdlib_module_names:
        return ""
    for place in _places(top):
        if top not in _OURS and top != own and _is_installed(place):
            continue
        if place.endswith(".py"):
            return place
        folder = place
        for part in rest:
            if os.path.isfile(module := os.path.join(folder, f"{part}.py")):
                return module
            if not os.path.isdir(inner := os.path.join(folder, part)):
                break
            folder = inner
        if os.path.isfile(module := os.path.join(folder, "__init__.py")):
            return module
    return ""


@cache
def _places(top: str) -> tuple[str, ...]:
    """Return the folders of a package or namespace, or the file of a module."""
    loaded = sys.modules.get(top)
    try:
        spec = find_spec(top) if loaded is None else None
    except (ImportError, ValueError):
        return ()
    source = loaded or spec
    if source is None:
        return ()
    folders = getattr(source, "__path__", None) or getattr(
        source, "submodule_search_locations", None
    )
    if folders:
        return tuple(folders)
    file = getattr(source, "__file__", None) or getattr(source, "origin", None) or ""
    return (file,) if file.endswith(".py") else ()


def _is_installed(place: str) -> bool:
    return not _INSTALLED.isdisjoint(Path(place).parts) or os.path.normcase(place).startswith(
        _STANDARD
    )
