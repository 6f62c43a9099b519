"""The option --example: a shipped input file as a start, without loading what computes."""

from __future__ import annotations

from importlib import import_module
from importlib.resources import files

import typer

from gearlube.cli.exit_codes import exit_on_error


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
    file = files(module.rpartition(".")[0]) / "data" / f"{prefix}{name}.toml"
    with exit_on_error():
        if file.is_file():
            text = file.read_text(encoding="utf-8")
        else:
            text = getattr(import_module(module), found).shipped_text(name)
        typer.echo(text, nl=False)
