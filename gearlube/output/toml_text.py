"""Input files as TOML text."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any


def toml_text(data: Mapping[str, Any], prefix: str = "") -> str:
    """Return nested tables of numbers, texts and lists as TOML; empty tables are left out.

    Examples
    --------
    >>> print(toml_text({"name": "a", "oil": {"file": "oil.toml"}}), end="")
    name = "a"
    [oil]
    file = "oil.toml"
    >>> print(toml_text({"why": {"pair.offset_mm": "printed"}}), end="")
    [why]
    "pair.offset_mm" = "printed"
    """
    plain = {key: value for key, value in data.items() if not isinstance(value, Mapping)}
    lines = "".join(f"{_key(key)} = {_value(value)}\n" for key, value in plain.items())
    for key, value in data.items():
        if isinstance(value, Mapping) and value:
            section = f"{prefix}{_key(key)}"
            lines += f"[{section}]\n{toml_text(value, f'{section}.')}"
    return lines


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _value(key)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list | tuple) and any(isinstance(one, Mapping) for one in value):
        return f"[\n{''.join(f'    {_value(one)},{chr(10)}' for one in value)}]"
    if isinstance(value, list | tuple):
        return f"[{', '.join(_value(one) for one in value)}]"
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{_key(key)} = {_value(one)}' for key, one in value.items())} }}"
    if not isinstance(value, str):
        return repr(value)
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in escaped) + '"'
