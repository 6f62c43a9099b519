"""Commands whose module is imported only when the command is used."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Literal

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_group

from gearlube.cli.option_groups import group_options

MARKUP: Literal["markdown"] = "markdown"  # of help texts; the other kind would swallow [units]


@dataclass(frozen=True, slots=True, kw_only=True)
class LazyCommand:
    """A command by the module and name of its function.

    Parameters
    ----------
    name : str
        As typed after `gearlube`.
    target : str
        "module:name" of a function with typer options, or of a `typer.Typer` with commands of
        its own.
    summary : str
        One sentence for the list of commands, which is shown without importing them.
    panel : str
        Heading over it in the list of commands.
    command_class : str
        Name of a class of commands in the same module; typer's own if empty.
    context_settings : mapping
        Passed to click.
    """

    name: str
    target: str
    summary: str
    panel: str = "More"
    command_class: str = ""
    context_settings: Mapping[str, Any] = field(default_factory=dict)

    def load(self) -> Any:  # a click command; newer typers have a click of their own
        """Import the module and return the command."""
        module_name, attribute = self.target.split(":")
        module = import_module(module_name)
        found = getattr(module, attribute)
        app = typer.Typer(add_completion=False, rich_markup_mode=MARKUP)
        app.callback()(_nothing)
        if isinstance(found, typer.Typer):
            app.add_typer(found, name=self.name)
        else:
            chosen = getattr(module, self.command_class) if self.command_class else None
            app.command(self.name, cls=chosen, context_settings=dict(self.context_settings))(found)
        command = get_group(app).commands[self.name]
        group_options(command)
        return command


def lazy_group(commands: Sequence[LazyCommand]) -> type[TyperGroup]:
    """Return a group class with these commands, listed in this order."""
    table = {command.name: command for command in commands}

    class LazyGroup(TyperGroup):
        listing = False  # whether the help is being written

        def __init__(self, **given: Any) -> None:
            super().__init__(**given)
            # typer compares a mistyped name with these
            self.commands = {
                one.name: TyperCommand(one.name, help=one.summary, rich_help_panel=one.panel)
                for one in commands
            }

        def list_commands(self, ctx: Any) -> list[str]:
            return list(table)

        def get_command(self, ctx: Any, cmd_name: str) -> Any:
            if self.listing or cmd_name not in table:
                return super().get_command(ctx, cmd_name)
            return table[cmd_name].load()

        def resolve_command(self, ctx: Any, args: list[str]) -> Any:
            # an empty path would stand for the folder where one is
            if "--out=" in args or ("--out", "") in itertools.pairwise(args):
                raise typer.BadParameter(
                    "must be a path, got an empty text. Write . for this folder, or leave it out.",
                    param_hint="--out",
                )
            return super().resolve_command(ctx, args)

        def format_help(self, ctx: Any, formatter: Any) -> None:
            self.listing = True
            try:
                super().format_help(ctx, formatter)
            finally:
                self.listing = False

    return LazyGroup


def _nothing() -> None:
    """Make typer treat an app with a single command as a group."""
