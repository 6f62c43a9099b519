"""A command that runs another command when it is done."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import typer


def run_next(context: typer.Context, name: str, arguments: Sequence[str]) -> None:
    """Run `gearlube NAME ARGUMENTS` from within another command; stop where that stops.

    Parameters
    ----------
    context : typer.Context
        Of the command that runs.
    name : str
    arguments : sequence of str

    Raises
    ------
    typer.Exit
        The other command ended with a code other than zero.
    """
    root: Any = context.find_root()
    command = root.command.get_command(root, name)
    code = command.main(list(arguments), prog_name=f"gearlube {name}", standalone_mode=False)
    if code:
        raise typer.Exit(code)
