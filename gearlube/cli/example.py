"""The option --example: a shipped input file as a start, without loading what computes."""

from __future__ import annotations

from importlib import import_module

import typer

from gearlube.cli.exit_codes import exit_on_error


def print_example(target: str, name: str) -> None:
    """Print the shipped file `name` of an input file's class, given as "module:class"."""
    module, _, found = target.partition(":")
    with exit_on_error():
        typer.echo(getattr(import_module(module), found).shipped_text(name), nl=False)
