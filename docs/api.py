"""Write docs/api.md, the page of public names: `python -m docs.api`.

The names and their groups are those of the stubs gearlube/*.pyi. What is said of a name, and its
example, are the first sentence and the examples of its docstring.
"""

from __future__ import annotations

import doctest
import inspect
import re
from pathlib import Path
from typing import Any, NamedTuple

import gearlube

PAGE = Path(__file__).with_suffix(".md")
_FACE = Path(gearlube.__file__)
STUBS = {
    "gl": _FACE.with_suffix(".pyi"),
    **{f"gl.{one.stem}": one for one in sorted(_FACE.parent.glob("[a-z]*.pyi"))},
    "gl.studies": _FACE.with_name("studies") / "__init__.pyi",
}
_HEAD = """# Public names

```python
import gearlube as gl
```

The most used names are attributes of `gl`, the others of its modules `gl.oil`, `gl.film` and so
on. A module is imported when one of its names is first used.
Settings and models are in SI units; other units stand in names (`speed_kmh`). A variable of a
result has its unit in `attrs["units"]`: maps and cycles are in rpm, degC and km/h, as their files
and figures are. `result.si()` has all of it in SI. Names that are not on this page may change
without notice. Whole scripts stand in `examples/`:
[an axle under a torque ramp](../examples/axle_torque_ramp.py),
[a film with your own oil](../examples/film_with_own_oil.py),
[from a helical gear to its transmission error](../examples/helical_transmission_error.py),
[a film under a measured profile](../examples/rough_own_profile.py),
[a sliding point contact](../examples/sliding_point_contact.py),
[the gradient of an axle's whine](../examples/whine_gradient.py) and
[a speed sweep](../examples/speed_sweep.py).

This page is written by `python -m docs.api` from docstrings; the tests run its examples.
"""


_FACE_WORDS = "What most users need."


class Group(NamedTuple):
    """Names under one heading; `module` is gl or one of its modules."""

    module: str
    title: str
    names: list[str]


def groups() -> list[Group]:
    """Return the public names in the groups of the stubs."""
    found: list[Group] = []
    for module, stub in STUBS.items():
        for line in stub.read_text(encoding="utf-8").splitlines():
            if heading := re.fullmatch(r"# -- (.+)", line):
                found.append(Group(module, heading[1], []))
            elif found and found[-1].module == module:
                found[-1].names.extend(name for _, name in re.findall(r"(\w+) as (\w+)", line))
    return found


# module and public name by the name inside
ORIGINS = {
    inner: (module, name)
    for module, stub in STUBS.items()
    for inner, name in re.findall(r"(\w+) as (\w+)", stub.read_text(encoding="utf-8"))
}


def public(module: str, name: str) -> Any:
    """Return what a public name stands for."""
    of = gearlube if module == "gl" else getattr(gearlube, module.removeprefix("gl."))
    return getattr(of, name)


def publicly(line: str) -> str:
    """Return an import of inner modules as one of public names, where all its names are."""
    found = re.fullmatch(
        r"(>>> )from (?:gearlube_core|drivetrain|fmu_src|gearlube)\.\S+ import (.+)", line
    )
    names = found[2].split(", ") if found else []
    if found is None or not set(names) <= ORIGINS.keys():
        return line
    parts: dict[str, list[str]] = {}
    for inner in names:
        module, name = ORIGINS[inner]
        shown = name if name == inner else f"{name} as {inner}"
        parts.setdefault(module.replace("gl", "gearlube", 1), []).append(shown)
    return "\n".join(f"{found[1]}from {one} import {', '.join(of)}" for one, of in parts.items())


def example(module: str, name: str) -> str:
    """Return the example of a name's docstring as it would be typed, empty if it has none."""
    text = inspect.getdoc(public(module, name)) or ""
    lines = []
    for part in doctest.DocTestParser().get_examples(text):
        source = part.source.removesuffix("\n").splitlines()
        typed = [f"{'>>>' if k == 0 else '...'} {line}" for k, line in enumerate(source)]
        lines += map(publicly, typed)
        lines += part.want.splitlines()
    return "\n".join(lines)


def page() -> str:
    """Return the text of the page."""
    parts = [_HEAD]
    last = ""
    for module, title, names in groups():
        if module != last:
            words = inspect.getdoc(public("gl", module[3:])) if module != "gl" else _FACE_WORDS
            parts.append(f"## `{module}`\n\n{words}\n")
            last = module
        parts.append(f"### {title}\n")
        for name in names:
            value = public(module, name)
            first = " ".join((inspect.getdoc(value) or "").split("\n\n")[0].split())
            parts.append(f"#### `{module}.{name}`\n\n{first}\n")
            if shown := example(module, name):
                parts.append(f"```python\n{shown}\n```\n")
    return "\n".join(parts)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
