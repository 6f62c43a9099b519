"""The option --example: input files to start from, without loading what computes."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

import typer

from gearlube.cli.exit_codes import exit_on_error


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


def print_example(target: str, name: str, prefix: str = "") -> None:
    """Print the shipped file `name` of an input file's class.

    The file is printed without its class, whose import takes seconds. The class is loaded only if
    there is no such file: its error names the files that there are.

    Parameters
    ----------
    target
        The class, as "module:class". The shipped files are in the folder data of its package.
    name
        Name of the file, without its ending.
    prefix
        The class's `prefix` of the names of shipped files.
    """
    module, _, found = target.partition(":")
    file = _shipped_file(module, f"{prefix}{name}")
    with exit_on_error():
        if file.is_file():
            text = file.read_text(encoding="utf-8")
        else:
            text = getattr(import_module(module), found).shipped_text(name)
        typer.echo(text, nl=False)


def is_shipped(target: str, name: str) -> bool:
    """Return if an input file's class ships the file `name`, without loading the class.

    >>> is_shipped("gearlube_core.helical_geometry.gear_file:HelicalGearFile", "he_2007")
    True
    """
    return _shipped_file(target.partition(":")[0], name).is_file()


def _shipped_file(module: str, name: str) -> Traversable:
    return files(module.rpartition(".")[0]) / "data" / f"{name}.toml"
