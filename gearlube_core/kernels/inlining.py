"""Decorators for the kernels inside the roller loop.

A kernel that stays a call inside the loop keeps the compiler from working on several rollers at
once. `inlined` forces the body into the caller, `summing` lets the sums be taken lane by lane.
Both let a product and a sum be rounded once instead of twice. No other arithmetic is relaxed:
NaN and infinity keep their meaning, and a test bounds the change to a few roundings.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from gearlube_core.kernels.dispatcher import compiled

_Function = TypeVar("_Function", bound=Callable[..., Any])


def inlined(function: _Function) -> _Function:
    """Compile `function` so that its callers contain its body."""
    return compiled(function, error_model="numpy", forceinline=True, fastmath={"contract"})


def inside(function: _Function) -> _Function:
    """Compile `function` so that its callers contain its body; arithmetic as in any kernel."""
    return compiled(function, error_model="numpy", forceinline=True)


def summing(function: _Function) -> _Function:
    """Compile `function`, whose sums may be taken in any order."""
    return compiled(function, error_model="numpy", fastmath={"reassoc", "contract"})
