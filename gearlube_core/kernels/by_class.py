"""Kernels that a physical law or a machine part brings along: picked by its class.

A law of the oil, a law of friction or a bearing type is a NamedTuple of floats whose kernels are
methods under `kernel`. Callers compile with any class that has them.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

from numba.extending import overload

_Function = TypeVar("_Function", bound=Callable[..., Any])


def by_class(otherwise: Callable[..., Any] | None = None) -> Callable[[_Function], _Function]:
    """Return a decorator: calls go to the kernel of the same name in the first argument's class.

    Parameters
    ----------
    otherwise
        Kernel for a class that has none of that name; None: the class must have it.

    Notes
    -----
    numba knows a NamedTuple by its class, so the choice costs nothing when the caller runs. Called
    from Python the decorated function does the same. Its own body is never run: it is there for
    its signature and its docstring, so a method of a Protocol will do.

    Examples
    --------
    In the file of the callers::

        @by_class()
        def spring_force(spring: Any, length: float) -> float:
            '''Return the force [N].'''

    and in any file::

        class LinearSpring(NamedTuple):
            stiffness: float  # [N/m]

            @kernel
            def spring_force(self, length: float) -> float:
                return self.stiffness * length
    """

    def decorate(declared: _Function) -> _Function:
        name = declared.__name__

        @wraps(declared)
        def call(first: Any, *arguments: Any) -> Any:
            own: Any = getattr(type(first), name, otherwise)
            return own(first, *arguments)

        @overload(call, strict=False)
        def choose(first: Any, *arguments: Any) -> Any:
            own = getattr(getattr(first, "instance_class", None), name, otherwise)
            if own is None:
                return None

            def chosen(first: Any, *arguments: Any) -> Any:
                return own(first, *arguments)

            return chosen

        return call  # type: ignore[return-value]

    return decorate
