"""Lubricated gear pairs for vehicle co-simulation.

The file `__init__.pyi` lists the public names, each with the module that defines it. A
module is imported when one of its names is first used, so `import gearlube` itself is quick.
docs/api.md describes each name and gives an example.

Examples
--------
>>> import gearlube as gl
>>> oil = gl.Lubricant.named("mohammadpour_2015")
>>> round(oil.dynamic_viscosity(gl.celsius_to_kelvin(95.0)), 4)  # Pa s
0.0171
"""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path
from typing import Any


def _public_names() -> dict[str, tuple[str, str]]:
    """Return module and name there of every public name, read from `__init__.pyi`."""
    names = {}
    module = ""
    for line in Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8").splitlines():
        if found := re.match(r"from (\S+) import", line):
            module = found[1]
        for there, here in re.findall(r"(\w+) as (\w+)", line):
            names[here] = (module, there)
    return names


_NAMES = _public_names()
__all__ = tuple(_NAMES)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return import_module("gearlube_core").__version__
    if name not in _NAMES:
        raise AttributeError(f"gearlube has no public name {name!r}. See docs/api.md.")
    module, there = _NAMES[name]
    value = getattr(import_module(module), there)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(_NAMES)
