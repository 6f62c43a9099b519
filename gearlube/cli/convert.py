"""The command `gearlube convert`."""

from __future__ import annotations

import logging
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gearlube.cli.example import kept_example, prints_example
from gearlube.cli.exit_codes import exit_on_error

if TYPE_CHECKING:
    from collections.abc import Iterable

    from gearlube_core.rexs.gearbox import RexsTrain
    from gearlube_core.rexs.stage import ExchangeNote

logger = logging.getLogger("gearlube")
REXS_ENDINGS = (".rexs", ".rexsz", ".rexsj", ".xml")


def _example() -> str:
    return kept_example("he_2007.rexs")


def convert(
    pair: Annotated[
        str,
        typer.Argument(
            help="REXS file (.rexs, .rexsj, .rexsz), gear file or blank file (TOML), or a shipped "
            "one.",
            metavar="PAIR",
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(help="File to write. Default: PAIR with the other ending, in this folder."),
    ] = None,
    stage: Annotated[
        str | None,
        typer.Option(
            help="Number or name of the gear stage, if the REXS file has several.", metavar="STAGE"
        ),
    ] = None,
    given: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            help="Value of a field that is missing in the REXS file.",
            metavar="FIELD=VALUE...",
        ),
    ] = None,
    train: Annotated[
        bool,
        typer.Option(
            "--train", help="Write a train file of the whole gearbox: shafts, bearings, stages."
        ),
    ] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace the file if it exists.")
    ] = False,
    example: Annotated[bool, prints_example(_example, "a REXS file of a helical pair")] = False,
) -> None:
    """Convert a pair between REXS and gear files, and list what does not fit.

    A cylindrical stage becomes a gear file of a helical pair, a bevel stage a blank file; with
    --train a gearbox of cylindrical stages becomes a train file.
    Macro geometry only: no machine settings, no flank modifications.
    """
    from drivetrain.train.train_file import TrainFile
    from gearlube.output.toml_text import toml_text
    from gearlube_core.errors import ParameterError
    from gearlube_core.rexs.exchange import BlankFile, pair_file, read_rexs, write_rexs
    from gearlube_core.rexs.gearbox import read_gearbox
    from gearlube_core.storage.atomic_file import write_text

    with exit_on_error():
        reads = Path(pair).suffix.lower() in REXS_ENDINGS
        path = out or Path(Path(pair).name).with_suffix(".toml" if reads else ".rexs")
        wanted = ".toml" if reads else ".rexs"
        if path.suffix.lower() != wanted:
            raise ParameterError(f"--out must end in {wanted}, got {path}")
        if path.exists() and not overwrite:
            raise ParameterError(f"{path} exists already. Choose another --out, or add --overwrite")
        if train:
            if stage is not None or given or not reads:
                raise ParameterError(
                    "--train is for REXS files, without --stage and --set. Leave out what is more"
                )
            gearbox = read_gearbox(pair)
            TrainFile.from_data(gearbox.data, pair)
            write_text(train_text(gearbox), path)
            _show(gearbox.notes, path)
            logger.info("Next: gearlube drivetrain %s", path)
            return
        if not reads:
            if stage is not None or given:
                raise ParameterError("--stage and --set are for REXS files only. Leave them out")
            notes = write_rexs(pair_file(pair), path)
            _show(notes, path)
            return
        read = read_rexs(pair, stage=stage, given=_fields(given or []))
        write_text(toml_text(read.data), path)
        _show(read.notes, path)
        read.file.warn(path)
        blank = isinstance(read.file, BlankFile)
        load = "" if blank or "operation" in read.data else " --torque N_M --speed-rpm RPM"
        logger.info("Next: gearlube %s %s%s", "design" if blank else "helical", path, load)


def train_text(gearbox: RexsTrain) -> str:
    """Return a gearbox as a train file, which says first what was assumed."""
    from gearlube.output.toml_text import toml_text

    return f"{gearbox.comments()}\n{toml_text(gearbox.data)}"


def _fields(given: list[str]) -> dict[str, Any]:
    from gearlube_core.errors import ParameterError

    found: dict[str, Any] = {}
    for text in given:
        name, _, value = text.partition("=")
        if not _NUMBER.fullmatch(value):
            raise ParameterError(f"--set must be FIELD=NUMBER, got {text!r}")
        found[name] = int(value) if value.lstrip("+-").isdigit() else float(value)
    return found


_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_MEANING = {
    "taken": "Taken from the REXS file:",
    "given": "Given by --set:",
    "inferred": "Follows from other numbers:",
    "lacking": "Not in the REXS file; these values were assumed:",
    "left out": "LEFT OUT, the written file cannot hold these data:",
}


def _show(notes: Iterable[ExchangeNote], path: Path) -> None:
    notes = list(notes)
    for kind, heading in _MEANING.items():
        lines = [f"  {note.what}: {note.why}" for note in notes if note.kind == kind]
        if lines:
            typer.echo("\n".join([heading, *lines]))
    logger.info("Written: %s", path)
