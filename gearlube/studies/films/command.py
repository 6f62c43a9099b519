"""The commands `gearlube ehl line`, `point`, `helical`, `hypoid`, `rough` and `compare`."""

from __future__ import annotations

import typer

from gearlube.studies.films.commands.compare import compare
from gearlube.studies.films.commands.contacts import line, point
from gearlube.studies.films.commands.helical import helical
from gearlube.studies.films.commands.hypoid import hypoid
from gearlube.studies.films.commands.rough import rough

ehl = typer.Typer(
    name="ehl",
    help="Lubricated contacts: film, pressure and friction of lines, points and helical teeth.",
    no_args_is_help=True,
)
for _command in (line, point, helical, hypoid, rough, compare):
    ehl.command(_command.__name__)(_command)
