"""Public names that import their module when they are first used."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any


def lazy_names(
    module: str, file: str
) -> tuple[Callable[[str], Any], Callable[[], list[str]], tuple[str, ...]]:
    """Return `__getattr__`, `__dir__` and `__all__` of a module whose names are in its stub.

    Parameters
    ----------
    module : str
        Its `__name__`.
    file : str
        Its `__file__`; the stub lies beside it and ends in .pyi.
    """
    places: dict[str, tuple[str, str]] = {}
    where = ""
    for line in Path(file).with_suffix(".pyi").read_text(encoding="utf-8").splitlines():
        if found := re.match(r"from (\S+) import", line):
            where = found[1]
        for there, here in re.findall(r"(\w+) as (\w+)", line):
            places[here] = (where, there)

    def get(name: str) -> Any:
        if name not in places:
            raise AttributeError(
                f"{module} has no public name {name!r}. See docs/api.md for all names."
            )
        where, there = places[name]
        if where == "gearlube":  # a module with more names
            value = import_module(f"gearlube.{there}")
        else:
            value = getattr(import_module(where), there)
        setattr(sys.modules[module], name, value)
        return value

    def names() -> list[str]:
        return sorted(places)

    return get, names, tuple(places)
