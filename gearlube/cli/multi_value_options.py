"""Options that take several values after one flag."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import Any

from typer.core import TyperCommand

# a number, or a range that begins with one; not the path of a file
_VALUE = re.compile(r"^[+\-]?\.?\d[^/\\]*$(?<!\.toml)")
_NAMED = re.compile(r"^[^=\s/\\-][^=\s/\\]*=")  # NAME=VALUE


def repeat_flags(
    arguments: Sequence[str], flags: Collection[str], value: re.Pattern[str] = _VALUE
) -> list[str]:
    """Return the arguments with a flag repeated before each of its values, by default numbers.

    >>> repeat_flags(["--preload", "2500", "6000", "--out", "x"], {"--preload"})
    ['--preload', '2500', '--preload', '6000', '--out', 'x']
    """
    result: list[str] = []
    flag, values = "", 0
    for argument in arguments:
        if argument in flags:
            flag, values = argument, 0
        elif not value.match(argument):
            flag = ""
        elif flag:
            if values:
                result.append(flag)
            values += 1
        result.append(argument)
    return result


class MultiValueCommand(TyperCommand):
    """A command whose options take several values where their metavar ends in three dots.

    Such a value is a number or a range, or a text NAME=VALUE where the metavar has a `=`.
    """

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse `args` after repeating the flags."""
        several = [one for one in self.params if (one.metavar or "").endswith("...")]
        for value, sign in ((_VALUE, False), (_NAMED, True)):
            flags = {
                flag for one in several if ("=" in (one.metavar or "")) == sign for flag in one.opts
            }
            args = repeat_flags(args, flags, value)
        return super().parse_args(ctx, args)
