"""The option `--example` of commands that need an input file, and print one to start from."""

from __future__ import annotations

from collections.abc import Callable
from importlib.resources import files
from typing import Any

import typer


def prints_example(text: Callable[[], str], what: str) -> Any:
    """Return the option `--example`: print a text and stop, whatever else the command needs.

    Parameters
    ----------
    text : callable
        Gives the text of the file.
    what : str
        What is printed, for the help of the option: "Print `what` to start from, and stop."
    """

    def show(wanted: bool) -> None:
        if wanted:
            typer.echo(text(), nl=False)
            raise typer.Exit

    return typer.Option(
        "--example", help=f"Print {what} to start from, and stop.", callback=show, is_eager=True
    )


def kept_example(name: str) -> str:
    """Return the text of a file in the folder data beside this module, without computing it.

    >>> kept_example("traction.csv")[:16]
    'slide_roll_ratio'
    """
    return (files("gearlube.cli") / "data" / name).read_text(encoding="utf-8")
