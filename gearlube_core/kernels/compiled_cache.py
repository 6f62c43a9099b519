"""Cache of compiled code on disk, valid while all its source files are unchanged.

numba's own cache looks at the file of a kernel alone. Here the files that it imports count too
(`source_files`), and so do the files of the NamedTuple classes and functions that a kernel is
compiled for: a kernel of the package may be given a law that its user wrote.

A file that is damaged would end the process without a word, so each carries a checksum, and one
that does not match is compiled again. Without a folder that can be written nothing is kept.
"""

from __future__ import annotations

import hashlib
import logging
import multiprocessing
import os
import pickle
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from types import FunctionType
from typing import Any

from numba import types
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile, NullCache
from numba.core.dispatcher import Dispatcher
from numba.core.serialize import dumps
from numba.core.typing import Signature

from gearlube_core.kernels.linked_code import rebuild_linked_code
from gearlube_core.kernels.machine_code import rebuild_machine_code
from gearlube_core.kernels.source_files import source_stamp

logger = logging.getLogger(__name__)

_NOT_SOURCES = sys.stdlib_module_names | {"numpy", "scipy", "numba"}


class _Files(CompileResultCacheImpl):  # type: ignore[misc]
    def get_filename_base(self, fullname: str, abiflags: str) -> str:
        """Return a name other than that of numba's own cache, whose index may not be readable."""
        return f"{super().get_filename_base(fullname, abiflags)}.checked"

    def rebuild(self, target_context: Any, payload: tuple[Any, ...]) -> Any:
        return rebuild_machine_code(target_context, payload)


class _LinkedFiles(_Files):
    def get_filename_base(self, fullname: str, abiflags: str) -> str:
        return f"{super().get_filename_base(fullname, abiflags)}.linked"

    def rebuild(self, target_context: Any, payload: tuple[Any, ...]) -> Any:
        return rebuild_linked_code(target_context, payload)


class _CheckedFiles(IndexDataCacheFile):  # type: ignore[misc]
    """Index and code on disk behind numba's version and a checksum; code with its key."""

    def save(self, key: Any, data: Any) -> None:
        super().save(key, (key, data))

    def load(self, key: Any) -> Any:
        # two processes that compile at once may give the same name to different code
        stored, data = super().load(key) or (None, None)
        return data if stored == key else None

    def _load_index(self) -> dict[Any, str]:
        try:
            stamp, overloads = self._content(self._index_path)
        except OSError:
            return {}
        return overloads if stamp == self._source_stamp else {}

    def _save_index(self, overloads: dict[Any, str]) -> None:
        with self._open_for_write(self._index_path) as stream:
            stream.write(self._dump((self._source_stamp, overloads)))

    def _load_data(self, name: str) -> Any:
        return self._content(self._data_path(name))

    def _dump(self, obj: Any) -> bytes:
        data: bytes = super()._dump(obj)
        return self._head + hashlib.sha256(data).digest() + data

    @property
    def _head(self) -> bytes:
        return f"numba {self._version}\n".encode()

    def _content(self, path: str) -> Any:
        """Return what is in a file; raise OSError where it is missing, old, damaged or foreign."""
        with open(path, "rb") as stream:
            head, digest = stream.read(len(self._head)), stream.read(32)
            data = stream.read()
        if head != self._head or hashlib.sha256(data).digest() != digest:
            raise OSError(f"{path} is damaged or of another version of numba")
        try:
            return pickle.loads(data)
        except (ImportError, AttributeError) as reason:  # a class that is not here
            raise OSError(f"{path} needs another program: {reason}") from reason


class SourceCache(FunctionCache):  # type: ignore[misc]
    """The compiled code of one function on disk, valid while none of its sources has changed."""

    _impl_class = _Files

    def __init__(self, function: Any) -> None:
        super().__init__(function)
        path = function.__code__.co_filename
        stamp = source_stamp(path) if os.path.isfile(path) else self._stamp_without_file()
        self._cache_file = _CheckedFiles(
            cache_path=self._cache_path,
            filename_base=self._impl.filename_base,
            source_stamp=stamp,
        )

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep compiled code; where that is not possible, say so once."""
        try:
            super().save_overload(sig, data)
        except OSError as reason:
            _say_not_kept((reason.strerror or str(reason)).lower())

    def _stamp_without_file(self) -> Any:
        """Return the stamp of a function that was typed in a notebook."""
        read = (self._py_func.__globals__.get(name) for name in self._py_func.__code__.co_names)
        stamps = sorted({source_stamp(path) for path in _paths(_found(read))})
        return self._impl.locator.get_source_stamp(), stamps

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        found = list(_found((sig, *_cells(self._py_func))))
        stamps = sorted({source_stamp(path) for path in _paths(found)})
        signature, machine, (code, _) = super()._index_key(sig, codegen)
        closure = hashlib.sha256(dumps(_cell_keys(self._py_func))).hexdigest()
        key: tuple[Any, ...] = (signature, machine, (code, closure))
        if all(map(_is_importable, found)):
            # as text, because an index of classes is unreadable where one of them is missing
            names = sorted(f"{one.__module__}.{one.__qualname__}" for one in found)
            key = (str(sig), tuple(names), *key[1:])
        return (*key, tuple(stamps))


class LinkedCache(SourceCache):
    """The linked code of one function on disk, see `linked_code`."""

    _impl_class = _LinkedFiles


def cache_of(kind: type[SourceCache], function: Any) -> Any:
    """Return the cache of a function; one that keeps nothing where no folder can be written."""
    try:
        return kind(function)
    except RuntimeError:  # numba has found no folder
        if os.path.isfile(function.__code__.co_filename):  # not typed in
            _say_not_kept("no folder can be written")
        return NullCache()


@cache
def _say_not_kept(why: str) -> None:
    if multiprocessing.parent_process() is None:  # workers are silent
        logger.warning(
            "Compiled kernels are not kept: %s. Every run compiles them again, which takes "
            "minutes. Set NUMBA_CACHE_DIR to a folder that can be written.",
            why,
        )


def _cell_keys(function: FunctionType) -> list[Any]:
    """Return a key of the values in the closure of a function, the same in any process.

    numba names a kernel among them by a number drawn in each process, so that no code was found.
    """
    keys: list[Any] = []
    for cell in _cells(function):
        inner = getattr(cell, "py_func", None)
        if inner is None or not os.path.isfile(inner.__code__.co_filename):
            keys.append(cell)
        else:  # the rest of its file is in the stamps
            code = inner.__code__
            place = inner.__module__, inner.__qualname__, code.co_firstlineno, code.co_code
            keys.append((*place, _cell_keys(inner)))
    return keys


def _cells(function: FunctionType) -> list[Any]:
    return [cell.cell_contents for cell in function.__closure__ or ()]


def _found(parts: Iterable[Any]) -> Iterator[Any]:
    """Yield the classes and Python functions in numba types, in values and in closures."""
    for part in {id(part): part for part in parts}.values():
        if isinstance(part, Dispatcher):
            yield part.py_func
            yield from _found(_cells(part.py_func))
        elif isinstance(part, types.Dispatcher):
            yield part.dispatcher.py_func
        elif hasattr(part, "instance_class"):
            yield part.instance_class
            yield from _found(getattr(part, "types", ()))
        elif isinstance(part, (tuple, types.BaseTuple, Signature)):
            inner: Any = getattr(part, "args", None) or getattr(part, "types", part)
            yield from _found(inner)
        elif isinstance(part, types.Type):
            parts_of = (getattr(part, "dtype", None), getattr(part, "type", None))
            yield from _found(one for one in parts_of if isinstance(one, types.Type))
        elif isinstance(part, (type, FunctionType)):
            yield part


def _paths(found: Iterable[Any]) -> Iterator[str]:
    """Yield the files that define functions, classes and the classes these derive from."""
    for one in found:
        for part in getattr(one, "__mro__", (one,)):
            path = getattr(sys.modules.get(part.__module__), "__file__", None) or ""
            top = part.__module__.partition(".")[0]
            if top not in _NOT_SOURCES and path.endswith(".py") and os.path.isfile(path):
                yield path


def _is_importable(one: Any) -> bool:
    return (
        isinstance(one, type)
        and one.__module__ != "__main__"
        and "<locals>" not in one.__qualname__
    )
