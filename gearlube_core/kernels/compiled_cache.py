"""Cache of compiled code on disk, valid while all its source files are unchanged.

numba's own cache looks at the file of a kernel alone. Here the files that it imports count too
(`source_files`), and so do the files of the NamedTuple classes and functions that a kernel is
compiled for: a kernel of the package may be given a law that its user wrote.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from types import FunctionType
from typing import Any

from numba import types
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile
from numba.core.dispatcher import Dispatcher
from numba.core.typing import Signature

from gearlube_core.kernels.linked_code import rebuild_linked_code
from gearlube_core.kernels.source_files import source_stamp

_NOT_SOURCES = sys.stdlib_module_names | {"numpy", "scipy", "numba"}


class _Files(CompileResultCacheImpl):  # type: ignore[misc]
    def get_filename_base(self, fullname: str, abiflags: str) -> str:
        """Return a name other than that of numba's own cache, whose index may not be readable."""
        return f"{super().get_filename_base(fullname, abiflags)}.sources"


class _LinkedFiles(_Files):
    def get_filename_base(self, fullname: str, abiflags: str) -> str:
        return f"{super().get_filename_base(fullname, abiflags)}.linked"

    def rebuild(self, target_context: Any, payload: tuple[Any, ...]) -> Any:
        return rebuild_linked_code(target_context, payload)


class SourceCache(FunctionCache):  # type: ignore[misc]
    """The compiled code of one function on disk, valid while none of its sources has changed."""

    _impl_class = _Files

    def __init__(self, function: Any) -> None:
        super().__init__(function)
        path = function.__code__.co_filename
        stamp = source_stamp(path) if os.path.isfile(path) else self._stamp_without_file()
        self._cache_file = IndexDataCacheFile(
            cache_path=self._cache_path,
            filename_base=self._impl.filename_base,
            source_stamp=stamp,
        )

    def _stamp_without_file(self) -> Any:
        """Return the stamp of a function that was typed in a notebook."""
        read = (self._py_func.__globals__.get(name) for name in self._py_func.__code__.co_names)
        stamps = sorted({source_stamp(path) for path in _paths(_found(read))})
        return self._impl.locator.get_source_stamp(), stamps

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        cells = [cell.cell_contents for cell in self._py_func.__closure__ or ()]
        found = list(_found((sig, *cells)))
        stamps = sorted({source_stamp(path) for path in _paths(found)})
        key = super()._index_key(sig, codegen)
        if all(map(_is_importable, found)):
            # as text, because an index of classes is unreadable where one of them is missing
            names = sorted(f"{one.__module__}.{one.__qualname__}" for one in found)
            key = (str(sig), tuple(names), *key[1:])
        return (*key, tuple(stamps))


class LinkedCache(SourceCache):
    """The linked code of one function on disk, see `linked_code`."""

    _impl_class = _LinkedFiles


def _found(parts: Iterable[Any]) -> Iterator[Any]:
    """Yield the classes and Python functions in numba types and in values."""
    for part in {id(part): part for part in parts}.values():
        if isinstance(part, Dispatcher):
            yield part.py_func
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
