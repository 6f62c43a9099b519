"""Kernels of a physical law: chosen by the law's class when a caller is compiled."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

from numba.extending import overload

_Function = TypeVar("_Function", bound=Callable[..., Any])


def by_law(otherwise: Callable[..., Any] | None = None) -> Callable[[_Function], _Function]:
    """Return a decorator that sends calls to the law's own kernel of the same name.

    Parameters
    ----------
    otherwise
        Kernel for a law that has none of that name; None: the law must have it.

    Notes
    -----
    The law is the first argument, a NamedTuple whose kernels are methods under `kernel`. numba
    knows a NamedTuple by its class, so the choice costs nothing when the caller runs. Called from
    Python the decorated function does the same. Its own body is never run: it is there for its
    signature and its docstring.
    """

    def decorate(declared: _Function) -> _Function:
        name = declared.__name__

        @wraps(declared)
        def call(law: Any, *arguments: Any) -> Any:
            own: Any = getattr(type(law), name, otherwise)
            return own(law, *arguments)

        @overload(call, strict=False)
        def choose(law: Any, *arguments: Any) -> Any:
            own = getattr(getattr(law, "instance_class", None), name, otherwise)
            if own is None:
                return None

            def chosen(law: Any, *arguments: Any) -> Any:
                return own(law, *arguments)

            return chosen

        return call  # type: ignore[return-value]

    return decorate
