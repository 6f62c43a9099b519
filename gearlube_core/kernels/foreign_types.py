"""Disk cache of kernels that leaves out specialisations for classes from outside the package.

numba keeps the argument types of all specialisations of a kernel in one file. With a class that
another process cannot import that file could not be read any more, whatever was asked for. It
also would not notice that the file of such a class was edited.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba.core import types
from numba.core.caching import FunctionCache

_PACKAGES = ("gearlube_core", "drivetrain", "fmu_src", "gearlube")


class OwnTypesCache(FunctionCache):  # type: ignore[misc, no-any-unimported]
    """Keeps what was compiled for numbers, arrays and the package's own tuples."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the machine code of a signature; None where there is none."""
        return super().load_overload(sig, target_context) if _own(sig) else None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep the machine code of a signature, unless it holds a class from outside."""
        if _own(sig):
            super().save_overload(sig, data)


def keep_own_types(dispatcher: Any, function: Callable[..., Any]) -> Any:
    """Let a dispatcher keep on disk what it compiles for the package's own types; return it."""
    dispatcher._cache = OwnTypesCache(function)
    return dispatcher


def _own(signature: Any) -> bool:
    return all(_is_own(one) for one in getattr(signature, "args", signature))


def _is_own(one: Any) -> bool:
    if isinstance(one, (types.NamedTuple, types.NamedUniTuple)):
        package = one.instance_class.__module__.partition(".")[0]
        return package in _PACKAGES and all(_is_own(part) for part in one.types)
    return True
