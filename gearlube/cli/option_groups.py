"""Headings over the options of a long help text, and options of several values after one flag."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import Any

from typer.core import TyperCommand

# a number, or a range that begins with one; not the path of a file
_VALUE = re.compile(r"^[+\-]?\.?\d[^/\\]*$(?<!\.toml)")
_NAMED = re.compile(r"^[^=\s/\\-][^=\s/\\]*=")  # NAME=VALUE
MANY = 12  # options from which on they are grouped
_HEAT, _MODEL, _COMPUTING, _RESULTS = "Oil and heat", "Model", "Computing", "Results"

# The heading of an option, the same in all commands. What is not here, such as speeds and torques,
# says what is run and stands first, under "Options".
GROUPS = {
    "--oil": _HEAT,
    "--oil-temperature": _HEAT,
    "--oil-temperatures": _HEAT,
    "--temperatures": _HEAT,
    "--steady-temperature": _HEAT,
    "--air-temperature": _HEAT,
    "--start-temperature": _HEAT,
    "--conductance-at-rest": _HEAT,
    "--conductance-at-100": _HEAT,
    "--heat-capacity": _HEAT,
    "--roughness-um": _MODEL,
    "--equations": _MODEL,
    "--friction": _MODEL,
    "--bearing-torque-loss": _MODEL,
    "--driver": _MODEL,
    "--fmu": _MODEL,
    "--mesh": _MODEL,
    "--density": _MODEL,
    "--mismatch": _MODEL,
    "--radii": _MODEL,
    "--calibrated-bearings": _MODEL,
    "--newtonian": _MODEL,
    "--load-sharing": _MODEL,
    "--flow": _MODEL,
    "--temperature": _MODEL,
    "--cavitation": _MODEL,
    "--jobs": _COMPUTING,
    "--scheduler": _COMPUTING,
    "--block": _COMPUTING,
    "--quick": _COMPUTING,
    "--draws": _COMPUTING,
    "--seed": _COMPUTING,
    "--check-grid": _COMPUTING,
    "--positions": _COMPUTING,
    "--nodes": _COMPUTING,
    "--nodes-across": _COMPUTING,
    "--nodes-along": _COMPUTING,
    "--nodes-minor": _COMPUTING,
    "--nodes-major": _COMPUTING,
    "--spacing": _COMPUTING,
    "--stencil": _COMPUTING,
    "--film-error": _COMPUTING,
    "--time-error": _COMPUTING,
    "--order-resolution": _COMPUTING,
    "--out": _RESULTS,
    "--overwrite": _RESULTS,
    "--export": _RESULTS,
    "--animate": _RESULTS,
    "--animate-rpm": _RESULTS,
    "--snapshots": _RESULTS,
    "--regulation-grid": _RESULTS,
    "--regulation-raised": _RESULTS,
    "--keys": _RESULTS,
    "--example": _RESULTS,
}
_ORDER = (_HEAT, _MODEL, _COMPUTING, _RESULTS)


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


def group_options(command: Any) -> None:
    """Put the options of a command with many of them, and of its subcommands, under headings.

    Options keep their order within a heading; the headings have the order of this file.
    """
    for one in getattr(command, "commands", {}).values():
        group_options(one)
    options = [one for one in command.params if one.param_type_name == "option"]
    if len(options) < MANY:
        return
    for option in options:
        option.rich_help_panel = GROUPS.get(option.opts[0], option.rich_help_panel)
    command.params.sort(key=_place)


def _place(parameter: Any) -> int:
    panel = getattr(parameter, "rich_help_panel", None)
    return 1 + _ORDER.index(panel) if panel in _ORDER else 0
