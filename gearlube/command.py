"""The command `gearlube`.

This module lists the commands and defines the options that they share.
"""

from __future__ import annotations

import itertools
import logging
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Annotated, Any, Literal

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_group

from gearlube.cli.option_groups import MultiValueCommand, group_options
from gearlube.input_files import read_files_first

_MARKUP: Literal["markdown"] = "markdown"  # of help texts; the other kind would swallow [units]


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
    context_settings : mapping
        Settings of click's context, passed on.
    """

    name: str
    target: str
    summary: str
    panel: str = "More"
    context_settings: Mapping[str, Any] = field(default_factory=dict)

    def load(self) -> Any:  # a click command; newer typers have a click of their own
        """Import the module and return the command."""
        module_name, attribute = self.target.split(":")
        module = import_module(module_name)
        found = getattr(module, attribute)
        app = typer.Typer(add_completion=False, rich_markup_mode=_MARKUP)
        app.callback()(_nothing)
        if isinstance(found, typer.Typer):
            app.add_typer(found, name=self.name)
        else:
            settings = dict(self.context_settings)
            app.command(self.name, cls=MultiValueCommand, context_settings=settings)(found)
        command = get_group(app).commands[self.name]
        group_options(command)
        read_files_first(command)
        return command


# headings in the list of commands
_AXLE = "Axle and car"
_GEARS = "Gear pairs"
_PARTS = "Oil, films and bearings"
_STUDIES = "All studies"
_TOOLS = "Other tools"

# A new study needs a folder in gearlube/studies and its line here.
COMMANDS = (
    LazyCommand(
        name="sweep",
        target="gearlube.studies.sweep.command:sweep",
        summary="Sweep vehicle speed and bearing preload of the hypoid axle.",
        panel=_AXLE,
    ),
    LazyCommand(
        name="runup",
        target="gearlube.studies.runup.command:runup",
        summary="Run the axle up or down in a speed ramp: waterfall, order tracks.",
        panel=_AXLE,
    ),
    LazyCommand(
        name="sound",
        target="gearlube.studies.sound.command:sound",
        summary="Make a run-up audible: WAV, loudness, which order one hears.",
        panel=_AXLE,
    ),
    LazyCommand(
        name="axle",
        target="gearlube.cli.axle:axle",
        summary="Check an axle file and show its inputs.",
        panel=_AXLE,
    ),
    LazyCommand(
        name="drivetrain",
        target="gearlube.studies.drivetrain.command:drivetrain",
        summary="Run a drivetrain from a list of bodies, meshes, bearings and shafts.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="design",
        target="gearlube.studies.design.command:design",
        summary="Design a hypoid or bevel pair: from a blank to machine settings.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="contact",
        target="gearlube.studies.contact.command:contact",
        summary="Analyse the tooth contact of a hypoid pair; write its mesh table.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="optimise",
        target="gearlube.studies.optimise.command:optimise",
        summary="Make a gear pair quieter: reliefs and settings under limits.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="measured",
        target="gearlube.studies.measured.command:measured",
        summary="Lay measured flanks on a hypoid pair: from CSV to a gear file.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="whine",
        target="gearlube.studies.whine.command:whine",
        summary="Whine orders of a gear pair against its settings and reliefs.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="convert",
        target="gearlube.cli.convert:convert",
        summary="Convert a gear pair between REXS and gear files.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="helical",
        target="gearlube.studies.helical.command:helical",
        summary="Study a helical or spur pair: contact, vibration, stability.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="resonance",
        target="gearlube.studies.resonance.command:resonance",
        summary="Follow the resonance of the torsional hypoid pair.",
        panel=_GEARS,
    ),
    LazyCommand(
        name="oil",
        target="gearlube.cli.oil:oil",
        summary="Show an oil file; fit its stresses to measured traction.",
        panel=_PARTS,
    ),
    LazyCommand(
        name="map",
        target="gearlube.studies.loss_map.command:loss_map",
        summary="Map the losses of an axle over torque, speed and oil temperature.",
        panel=_AXLE,
    ),
    LazyCommand(
        name="cycle",
        target="gearlube.studies.drive_cycle.command:drive_cycle",
        summary="Drive a cycle: energy lost in the axle, and the oil temperature.",
        panel=_AXLE,
    ),
    LazyCommand(
        name="damage",
        target="gearlube.damage.command:damage",
        summary="Will it last? Damage of an axle's gears and bearings over a duty cycle.",
        panel=_AXLE,
    ),
    LazyCommand(
        name="vary",
        target="gearlube.variation.command:vary",
        summary="Vary any parameter in a study: grids, samples, scatter.",
        panel=_STUDIES,
    ),
    LazyCommand(
        name="compare",
        target="gearlube.cli.compare:compare",
        summary="Compare two runs of one study, or a run with measurements.",
        panel=_STUDIES,
    ),
    LazyCommand(
        name="calibrate",
        target="gearlube.studies.calibrate.command:calibrate",
        summary="Fit uncertain inputs of an axle to measured losses.",
        panel=_AXLE,
    ),
    LazyCommand(
        name="export",
        target="gearlube.cli.export:export",
        summary="Write results of any study for other tools: CSV, MATLAB, UFF58, MDF4, VTK, FMU.",
        panel=_STUDIES,
    ),
    LazyCommand(
        name="build-fmu",
        target="gearlube.cli.build_fmu:build_fmu",
        summary="Build the FMUs of axle, helical pair and car, for any platform.",
        panel=_TOOLS,
    ),
    LazyCommand(
        name="native",
        target="gearlube.cli.native:native",
        summary="Run a program that is not Python so that it can load the FMUs.",
        panel=_TOOLS,
        context_settings={"allow_interspersed_args": False},
    ),
    LazyCommand(
        name="ehl",
        target="gearlube.studies.films.command:ehl",
        summary="Solve lubricated contacts: film, pressure and friction.",
        panel=_PARTS,
    ),
    LazyCommand(
        name="film-model",
        target="gearlube.studies.film_model.command:film_model",
        summary="Train, fit, show and audit a surrogate of solved films.",
        panel=_PARTS,
    ),
    LazyCommand(
        name="bearing",
        target="gearlube.studies.bearing.command:bearing",
        summary="Friction of a tapered roller bearing: torque and power loss.",
        panel=_PARTS,
    ),
    LazyCommand(
        name="roughness",
        target="gearlube.studies.roughness.command:roughness",
        summary="Read or make rough surfaces: statistics, filters, lay.",
        panel=_PARTS,
    ),
)


def command_line(commands: Sequence[LazyCommand]) -> typer.Typer:
    """Return the command `gearlube` with these subcommands."""
    application = typer.Typer(
        cls=_lazy_group(commands),
        name="gearlube",
        help="Lubricated gears: tooth contact, vibration, FMUs, speed sweeps and their report.",
        no_args_is_help=True,
        pretty_exceptions_show_locals=False,
        rich_markup_mode=_MARKUP,
    )
    application.callback()(_common)
    return application


def _show_version(wanted: bool) -> None:
    if wanted:
        from gearlube_core import __version__

        typer.echo(f"gearlube {__version__}")
        raise typer.Exit


def _common(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_show_version, is_eager=True, help="Show the version and exit."
        ),
    ] = False,
    verbose: Annotated[
        bool, typer.Option("--verbose", "-v", help="Log details of the run.")
    ] = False,
) -> None:
    logging.getLogger("gearlube").setLevel(logging.INFO)
    logging.getLogger("drivetrain").setLevel(logging.INFO)
    if verbose:
        for name in ("gearlube", "drivetrain", "fmu_src", "gearlube_core"):
            logging.getLogger(name).setLevel(logging.DEBUG)


def _lazy_group(commands: Sequence[LazyCommand]) -> type[TyperGroup]:
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

        def resolve_command(self, ctx: Any, args: list[str]) -> Any:
            # an empty path would stand for the folder where one is
            if "--out=" in args or ("--out", "") in itertools.pairwise(args):
                raise typer.BadParameter(
                    "must be a path, got an empty text. Write . for this folder, or leave it out.",
                    param_hint="--out",
                )
            return super().resolve_command(ctx, args)

        def get_command(self, ctx: Any, cmd_name: str) -> Any:
            if self.listing or cmd_name not in table:
                return super().get_command(ctx, cmd_name)
            return table[cmd_name].load()

        def format_help(self, ctx: Any, formatter: Any) -> None:
            self.listing = True
            try:
                super().format_help(ctx, formatter)
            finally:
                self.listing = False

    return LazyGroup


app = command_line(COMMANDS)


def main() -> None:
    """Entry point of the command `gearlube`."""
    # the matrices of most studies are small: threads would wait for each other
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from rich.logging import RichHandler

    from gearlube.cli.exit_codes import WarningsOnce, console

    handler = RichHandler(console=console, show_path=False, show_time=False, markup=False)
    handler.addFilter(WarningsOnce())
    logging.basicConfig(level=logging.WARNING, format="%(message)s", handlers=[handler])
    app()


def _nothing() -> None:
    """Make typer treat an app with a single command as a group."""
