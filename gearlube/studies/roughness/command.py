"""The commands `gearlube roughness read`, `make`, `extrude`, `stand-in`, `flow-factors`."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gearlube.cli.example import prints_example
from gearlube.cli.exit_codes import console, exit_on_error
from gearlube.cli.options import OverwriteOption
from gearlube.cli.results_folder import results_folder
from gearlube.studies.roughness.flow_command import flow_factors
from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.units import DEGREE, MILLIMETRE

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube.studies.roughness.results import Row
    from gearlube_core.surface.heights import Profile, Surface

logger = logging.getLogger("gearlube")
_MICRO = 1e-6  # m
_HIGHEST_UM = 100.0

FileArgument = Annotated[
    str,
    typer.Argument(help="CSV, npz, NetCDF, SDF, X3P, SUR or AL3D file of heights.", metavar="FILE"),
]
OutOption = Annotated[Path, typer.Option(help="Folder for the results.")]
PeaksOption = Annotated[
    float | None,
    typer.Option(
        help="Run the surface in: cut peaks at this height above the mean [um]. A model.",
        metavar="UM",
    ),
]
_OUT = Path("gearlube_roughness")


def _example() -> str:
    import numpy as np

    from gearlube_core.surface.files import profile_csv
    from gearlube_core.surface.generator import generated_profile
    from gearlube_core.surface.generator_request import RoughnessRequest

    request = RoughnessRequest(arithmetic_mean=0.3e-6, correlation_length=20e-6)
    made = generated_profile(request, 1.0 * MILLIMETRE, 500, np.random.default_rng(1))
    return profile_csv(made.surface)


ExampleOption = Annotated[
    bool, prints_example(_example, "a profile (CSV; made, not measured: Ra 0.3 um, periodic)")
]

roughness = typer.Typer(
    name="roughness",
    help="Rough surfaces: read or make them, filter them, draw them out along a lay.",
    no_args_is_help=True,
)
roughness.command("flow-factors")(flow_factors)


@roughness.command("read")
def read(
    file: FileArgument,
    level: Annotated[
        int, typer.Option(help="Degree of the polynomial that is removed first.", metavar="0...8")
    ] = 1,
    cutoff_long_um: Annotated[
        float | None,
        typer.Option(help="Cut-off lambda_c [um]: longer waves are removed.", metavar="UM"),
    ] = None,
    cutoff_short_um: Annotated[
        float | None,
        typer.Option(help="Cut-off lambda_s [um]: shorter waves are removed.", metavar="UM"),
    ] = None,
    ends: Annotated[
        str, typer.Option(help="End correction of the filter.", metavar="regression|cut")
    ] = "regression",
    cut_peaks_um: PeaksOption = None,
    out: OutOption = _OUT,
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Read heights, level and filter them; write heights, statistics and a figure."""

    def surfaces() -> dict[str, Surface]:
        from gearlube_core.surface.files import read_surface
        from gearlube_core.surface.gaussian_filter import filtered, levelled
        from gearlube_core.surface.heights import check_plausible

        read_in: Any = read_surface(file)
        surface = filtered(
            levelled(read_in, level),
            cutoff_long=_metres("--cutoff-long-um", cutoff_long_um),
            cutoff_short=_metres("--cutoff-short-um", cutoff_short_um),
            ends=ends,
        ).roughness
        check_plausible(surface)
        return {"surface": _run_in(surface, cut_peaks_um)}

    _run("read", surfaces, out, overwrite=overwrite)


@roughness.command("make")
def make(
    ra_um: Annotated[
        float | None, typer.Option(help="Ra or Sa [um]; or give --rq-um.", metavar="UM")
    ] = None,
    rq_um: Annotated[float | None, typer.Option(help="Rq or Sq [um].", metavar="UM")] = None,
    correlation_um: Annotated[
        float, typer.Option(help="Autocorrelation length to 0.2, across the lay [um].")
    ] = 8.0,
    along_um: Annotated[
        float | None, typer.Option(help="The same along the lay of a map [um].", metavar="UM")
    ] = None,
    lay_deg: Annotated[
        float, typer.Option(help="Direction of the crests of a map, from y towards x [deg].")
    ] = 0.0,
    skewness: Annotated[float, typer.Option(help="Skewness Rsk or Ssk [-].")] = 0.0,
    kurtosis: Annotated[float, typer.Option(help="Rku or Sku; 3: normal.")] = 3.0,
    shortest_um: Annotated[
        float | None,
        typer.Option(help="Shortest wave [um]. Default: eight spacings.", metavar="UM"),
    ] = None,
    longest_um: Annotated[
        float | None, typer.Option(help="Longest wave [um]. Default: the period.", metavar="UM")
    ] = None,
    autocorrelation: Annotated[
        str,
        typer.Option(
            help="Shape before the band is cut; gaussian has less short waves.",
            metavar="exponential|gaussian",
        ),
    ] = "exponential",
    period_mm: Annotated[float, typer.Option(help="Period along x [mm].")] = 1.0,
    width_mm: Annotated[
        float | None,
        typer.Option(help="Period along y [mm], for a map. Default: a profile.", metavar="MM"),
    ] = None,
    points: Annotated[int, typer.Option(help="Points in one period along x.")] = 1024,
    rows: Annotated[int, typer.Option(help="Rows in one period along y, for a map.")] = 256,
    seed: Annotated[
        int, typer.Option(help="Random seed; the same seed gives the same surface.")
    ] = 1,
    cut_peaks_um: PeaksOption = None,
    out: OutOption = _OUT,
    overwrite: OverwriteOption = False,
) -> None:
    """Make a periodic profile or map with given statistics; say what it reached."""

    def surfaces() -> dict[str, Surface]:
        import numpy as np

        from gearlube.studies.roughness.results import reached_rows
        from gearlube_core.surface.generator import generated_map, generated_profile
        from gearlube_core.surface.generator_request import RoughnessRequest

        if ra_um is None and rq_um is None:
            raise ParameterError("Give --ra-um or --rq-um, the height of the roughness in um.")
        if width_mm is None and (along_um is not None or lay_deg != 0.0):
            raise ParameterError(
                "--along-um and --lay-deg are only for a map, but --width-mm is missing. Give the "
                "width of the map, or leave them out for a profile."
            )
        check_within("--seed", seed, 0, 2**63)
        check_within("--points", points, 16, 1_000_000)
        check_within("--rows", rows, 16, 100_000)
        if width_mm is not None:
            _check_size(points, rows)
        request = RoughnessRequest(
            arithmetic_mean=_height("--ra-um", ra_um),
            root_mean_square=_height("--rq-um", rq_um),
            correlation_length=check_positive("--correlation-um", correlation_um, "um") * _MICRO,
            correlation_length_along=_metres("--along-um", along_um),
            lay=check_within("--lay-deg", lay_deg, -90.0, 90.0, "deg") * DEGREE,
            skewness=check_finite("--skewness", skewness),
            kurtosis=check_finite("--kurtosis", kurtosis),
            shortest_wave=_metres("--shortest-um", shortest_um),
            longest_wave=_metres("--longest-um", longest_um),
            autocorrelation=autocorrelation,
        )
        period = check_positive("--period-mm", period_mm, "mm") * MILLIMETRE
        random = np.random.default_rng(seed)
        made: Any
        if width_mm is None:
            made = generated_profile(request, period, points, random)
        else:
            width = check_positive("--width-mm", width_mm, "mm") * MILLIMETRE
            made = generated_map(request, (period, width), (points, rows), random)
        _show("asked and reached", reached_rows(made))
        for note in made.notes:
            logger.warning("%s", note)
        return {"surface": _run_in(made.surface, cut_peaks_um)}

    _run("make", surfaces, out, overwrite=overwrite)


@roughness.command("extrude")
def extrude(
    file: FileArgument,
    width_mm: Annotated[
        float, typer.Option(help="Width along y after which the map repeats [mm].")
    ] = 1.0,
    turns: Annotated[
        int | None,
        typer.Option(help="Periods that a crest moves over the width. Default: 1.", metavar="N"),
    ] = None,
    angle_deg: Annotated[
        float | None,
        typer.Option(help="Or the angle of the lay [deg], which must close.", metavar="DEG"),
    ] = None,
    part_um: Annotated[
        str | None,
        typer.Option(
            help="Cut this part, start:length [um], near where it closes. Default: the file is "
            "one period.",
            metavar="UM:UM",
        ),
    ] = None,
    rows: Annotated[int, typer.Option(help="Rows of the map along y.")] = 512,
    out: OutOption = _OUT,
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Draw a periodic profile out along a lay so that it repeats over a width."""

    def surfaces() -> dict[str, Surface]:
        from gearlube_core.surface.extrusion import ExtrudedProfile, Lay

        check_within("--rows", rows, 4, 100_000)
        width = check_positive("--width-mm", width_mm, "mm") * MILLIMETRE
        profile = _period(file, part_um)
        if turns is not None and angle_deg is not None:
            raise ParameterError("Give --turns or --angle-deg, not both.")
        if angle_deg is None:
            lay = Lay(period=profile.length, width=width, turns=1 if turns is None else turns)
        else:
            angle = check_within("--angle-deg", angle_deg, -80.0, 80.0, "deg") * DEGREE
            lay = Lay.closing(profile.length, width, angle)
        logger.info("Lay: %.4f deg from y towards x.", lay.angle / DEGREE)
        _check_size(profile.height.size, rows)
        drawn = ExtrudedProfile(profile=profile, lay=lay)
        return {
            "profile": profile,
            "surface": drawn.over(profile.length, (profile.height.size, rows)),
        }

    _run("extrude", surfaces, out, overwrite=overwrite)


@roughness.command("stand-in")
def stand_in(
    case: Annotated[
        str, typer.Argument(help="Profile of Jamali 2015, chapter 7.", metavar="A|B|C")
    ],
    seed: Annotated[int, typer.Option(help="1 to 5 are the five of the results.")] = 1,
    same_ra: Annotated[
        bool, typer.Option("--same-ra", help="Scale both parts to Ra 0.31 um too.")
    ] = False,
    out: OutOption = _OUT,
    overwrite: OverwriteOption = False,
) -> None:
    """Make stand-ins for profiles of Jamali 2015, which are not published."""

    def surfaces() -> dict[str, Surface]:
        from gearlube_core.surface import stand_ins

        made = stand_ins.stand_in(case, seed, same_mean=same_ra)
        fast, slow = (lay.angle / DEGREE for lay in made.lays)
        logger.info(
            "Made-up profiles. Lay: faster surface %.3f deg, slower surface %.3f deg.", fast, slow
        )
        return {"full": made.full.surface, "fast": made.fast, "slow": made.slow}

    _run("stand-in", surfaces, out, overwrite=overwrite)


def _metres(name: str, value_um: float | None) -> float | None:
    return None if value_um is None else check_positive(name, value_um, "um") * _MICRO


def _height(name: str, value_um: float | None) -> float | None:
    if value_um is not None:
        check_within(name, value_um, 0.0, _HIGHEST_UM, "um", "A ground flank has 0.2 to 1 um.")
    return _metres(name, value_um)


def _run_in(surface: Any, height_um: float | None) -> Any:
    if height_um is None:
        return surface
    from gearlube_core.surface.gaussian_filter import peaks_cut

    height = check_within("--cut-peaks-um", height_um, -_HIGHEST_UM, _HIGHEST_UM, "um") * _MICRO
    cut = peaks_cut(surface, height)
    logger.info("Model of running-in: %.2f %% of the points were cut.", 100.0 * cut.share)
    return cut.surface


def _period(file: str, part_um: str | None) -> Profile:
    """Return one period of the profile in a file, or a part of it that closes."""
    from dataclasses import replace

    from gearlube_core.surface.extrusion import periodic_section
    from gearlube_core.surface.files import read_surface
    from gearlube_core.surface.gaussian_filter import levelled
    from gearlube_core.surface.heights import Profile

    profile = read_surface(file)
    if not isinstance(profile, Profile):
        raise ParameterError(f"{file} must hold a profile, got a map. Give one section of it.")
    if part_um is None:
        return replace(profile, periodic=True)
    try:
        start, length = (float(one) * _MICRO for one in part_um.split(":"))
    except ValueError:
        start = length = math.nan
    if not (math.isfinite(start) and math.isfinite(length)):
        raise ParameterError(
            f"--part-um must be start:length in um, got {part_um!r}. Write, for instance, 500:149."
        )
    return periodic_section(levelled(profile), start, length)


_MOST_HEIGHTS = 4096**2  # of a map: some 500 MB while it is made


def _check_size(points: int, rows: int) -> None:
    check_within(
        "--points times --rows", points * rows, 0, _MOST_HEIGHTS, "", "Take fewer of one of them."
    )


def _run(
    name: str, surfaces: Callable[[], dict[str, Surface]], out: Path, *, overwrite: bool
) -> None:
    with exit_on_error(f"Stopped; {out} may be incomplete. Run the same command again."):
        found = surfaces()
        from gearlube.studies.roughness.results import statistics_rows, write_results

        with results_folder(out, f"roughness {name}", overwrite=overwrite):
            written = write_results(found, out)
        for what, surface in found.items():
            _show(f"{what}: {surface.name}", statistics_rows(surface))
        logger.info("Results: %s", ", ".join(str(one) for one in written))


def _show(title: str, rows: list[Row]) -> None:
    from rich.table import Table

    table = Table(title=title)
    asked = any(row.asked is not None for row in rows)
    for heading in ("name", "value", "unit", *(("asked",) if asked else ())):
        table.add_column(heading, justify="left" if heading in ("name", "unit") else "right")
    for row in rows:
        more = (f"{row.asked:.5g}",) if row.asked is not None else ()
        table.add_row(row.name, f"{row.value:.5g}", row.unit, *more)
    console.print(table)
