"""Write docs/api.md, the page of public names: `python -m docs.api`.

The names and their groups are those of gearlube/__init__.pyi. What is said of a name, and its
example, are the first sentence and the examples of its docstring.
"""

from __future__ import annotations

import doctest
import inspect
import re
from pathlib import Path
from typing import NamedTuple

import gearlube

PAGE = Path(__file__).with_suffix(".md")
STUB = Path(gearlube.__file__).with_suffix(".pyi")
_HEAD = """# Public names

```python
import gearlube as gl
```

Every name below is an attribute of `gl`. A module is imported when one of its names is first used.
All quantities are in SI units; other units stand in names (`speed_kmh`). Names that are not on this
page may change without notice. Whole scripts stand in `examples/`:
[an axle under a torque ramp](../examples/axle_torque_ramp.py),
[a film with your own oil](../examples/film_with_own_oil.py),
[from a helical gear to its transmission error](../examples/helical_transmission_error.py),
[a film under a measured profile](../examples/rough_own_profile.py),
[a sliding point contact](../examples/sliding_point_contact.py),
[the gradient of an axle's whine](../examples/whine_gradient.py) and
[a speed sweep](../examples/speed_sweep.py).

This page is written by `python -m docs.api` from docstrings; the tests run its examples.
"""


class Group(NamedTuple):
    """Names under one heading."""

    title: str
    names: list[str]


def groups() -> list[Group]:
    """Return the public names in the groups of the stub."""
    found: list[Group] = []
    for line in STUB.read_text(encoding="utf-8").splitlines():
        if heading := re.fullmatch(r"# -- (.+)", line):
            found.append(Group(heading[1], []))
        if found:
            found[-1].names.extend(name for _, name in re.findall(r"(\w+) as (\w+)", line))
    return found


def example(name: str) -> str:
    """Return the example of a name's docstring as it would be typed, empty if it has none."""
    text = inspect.getdoc(getattr(gearlube, name)) or ""
    lines = []
    for part in doctest.DocTestParser().get_examples(text):
        source = part.source.removesuffix("\n").splitlines()
        lines += [f"{'>>>' if k == 0 else '...'} {line}" for k, line in enumerate(source)]
        lines += part.want.splitlines()
    return "\n".join(lines)


def page() -> str:
    """Return the text of the page."""
    parts = [_HEAD]
    for title, names in groups():
        parts.append(f"## {title}\n")
        for name in names:
            value = getattr(gearlube, name)
            first = " ".join((inspect.getdoc(value) or "").split("\n\n")[0].split())
            parts.append(f"### `{name}`\n\n{first}\n")
            if shown := example(name):
                parts.append(f"```python\n{shown}\n```\n")
    return "\n".join(parts)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
