"""The command `gearlube sound`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.example import prints_example
from gearlube.cli.options import OverwriteOption
from gearlube.cli.ranges import two_numbers
from gearlube.cli.study_run import study_run

logger = logging.getLogger("gearlube")


def _example() -> str:
    from gearlube.studies.sound.transfer_path import example_text

    return example_text()


def sound(
    run: Annotated[
        Path,
        typer.Argument(
            help="Bearing forces over time: NetCDF file or folder of `gearlube runup`.",
            metavar="RUN",
        ),
    ],
    other: Annotated[
        Path | None, typer.Argument(help="A second run to compare with.", metavar="[OTHER]")
    ] = None,
    against: Annotated[Path | None, typer.Option(help="The same as OTHER.", metavar="RUN")] = None,
    transfer: Annotated[
        Path | None,
        typer.Option(
            help="Measured frequency responses [Pa/N], CSV or UFF58. Default: a generic path.",
            metavar="FILE",
        ),
    ] = None,
    band: Annotated[
        str | None,
        typer.Option(help="Frequency band to keep [Hz], for instance 50:4000.", metavar="LOW:HIGH"),
    ] = None,
    order: Annotated[
        list[float] | None,
        typer.Option(
            help="Order of the pinion to track; repeat it. Default: mesh orders 1 to 4.",
            metavar="ORDER",
        ),
    ] = None,
    full_scale: Annotated[
        float | None,
        typer.Option(help="Sound pressure at full scale of the WAV [Pa].", metavar="PA"),
    ] = None,
    wav_rate: Annotated[
        int, typer.Option(help="Sampling rate of the WAV [Hz].", metavar="HZ")
    ] = 48000,
    metrics: Annotated[
        str,
        typer.Option(
            help="all, none, or some of loudness, tonality, roughness, fluctuation_strength, with "
            "commas. all: those that this Python can compute; tonality and fluctuation_strength "
            "need Python 3.13 or newer, and all need the extra gearlube[sound].",
            metavar="LIST",
        ),
    ] = "all",
    field: Annotated[str, typer.Option(help="Sound field: free or diffuse.")] = "free",
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_sound"),
    overwrite: OverwriteOption = False,
    example: Annotated[
        bool, prints_example(_example, "a transfer path of the hypoid axle (CSV; not measured)")
    ] = False,
) -> None:
    """Make a run audible: sound pressure, WAV, loudness and which order one hears.

    Two runs are compared. Writes sound.nc, WAV files, summary.csv, figures, report.html.
    """
    from gearlube.studies.sound.run import run_sound
    from gearlube.studies.sound.settings import METRICS, SoundSettings
    from gearlube_core.errors import ParameterError

    with study_run("sound", out, overwrite=overwrite) as frame:
        if other is not None and against is not None:
            raise ParameterError(
                f"The second run must be given once, got {other} and --against {against}. Leave "
                "one of them out."
            )
        chosen = {"all": METRICS, "none": ()}.get(
            metrics, tuple(one.strip() for one in metrics.split(","))
        )
        settings = SoundSettings(
            band=None if band is None else two_numbers("--band", band, "50:4000", "frequencies"),
            orders=tuple(order or ()),
            full_scale=full_scale,
            wav_rate=wav_rate,
            field=field,
            metrics=chosen,
        )
        with frame.results() as progress:
            found = run_sound(
                run,
                settings,
                against=other or against,
                transfer=transfer,
                folder=out,
                progress=progress,
            )
        for sentence in found.findings:
            logger.info("%s", sentence)
        if found.runs[0].path.generic:
            logger.warning("%s", found.limits[0])
        for reason in found.missing:
            logger.warning("Missing: %s.", reason)
        frame.written(*(one.wav for one in found.runs))
        logger.info("Report: %s", out / "report.html")
