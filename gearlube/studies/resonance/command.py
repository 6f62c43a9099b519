"""The command `gearlube resonance`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from gearlube.cli.exit_codes import INTERRUPTED
from gearlube.cli.oil_option import oil_kelvin
from gearlube.cli.options import OilTemperatureOption, OverwriteOption, RoughnessOption
from gearlube.cli.ranges import two_numbers
from gearlube.cli.study_run import empty_table, study_run
from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube.studies.resonance.summary import ModelSummary
    from gearlube_core.mesh_table.table import MeshTable

logger = logging.getLogger("gearlube")

_RADII = ("consistent", "paper", "mean")
_FRICTION = ("thermal_eyring", "off")


def resonance(
    mesh: Annotated[
        str,
        typer.Option(
            help="shipped, synthetic, or a mesh table that `gearlube contact` wrote.",
            metavar="shipped|synthetic|FILE.nc",
        ),
    ] = "shipped",
    mismatch: Annotated[
        float,
        typer.Option(
            help="Variation of the pinion's contact radius alone, with --mesh synthetic and "
            "--radii paper.",
            metavar="PERCENT",
        ),
    ] = 0.0,
    radii: Annotated[
        str,
        typer.Option(
            help="consistent: all ratio error is transmission error; paper: contact radii as in "
            "the mesh table; mean: constant.",
            metavar="|".join(_RADII),
        ),
    ] = "consistent",
    torque: Annotated[float, typer.Option(help="Pinion torque [N.m].", metavar="TORQUE")] = 50.0,
    oil_temperature: OilTemperatureOption = 40.0,
    roughness_um: RoughnessOption = 0.5,
    friction: Annotated[
        str,
        typer.Option(
            help="Flank friction of the lubricated model; off leaves that model out.",
            metavar="|".join(_FRICTION),
        ),
    ] = "thermal_eyring",
    frequency_range: Annotated[
        str,
        typer.Option(
            "--range", help="Mesh over natural frequency, first:last.", metavar="FIRST:LAST"
        ),
    ] = "0.2:1.6",
    frequencies: Annotated[
        int, typer.Option(help="Frequencies of each response curve.", metavar="N")
    ] = 200,
    load_at: Annotated[
        float | None,
        typer.Option(
            help="Also follow the response over the pinion torque, at this mesh over natural "
            "frequency: load.nc and its figure.",
            metavar="RELATIVE",
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_resonance"),
    quick: Annotated[
        bool,
        typer.Option("--quick", help="Few frequencies and coarse steps, for a first look."),
    ] = False,
    overwrite: OverwriteOption = False,
) -> None:
    """Follow the resonance of the torsional hypoid pair; write data, figures and report.html.

    Stable and unstable periodic motions of the dry 2-DOF and 1-DOF models and of the lubricated
    2-DOF model, with time sweeps as a check. Stopped with Ctrl-C, it writes what was found.
    """
    from gearlube.studies.resonance import run
    from gearlube.studies.resonance.report import resonance_report
    from gearlube.studies.resonance.settings import ResonanceSettings, quick_settings
    from gearlube.studies.resonance.summary import summaries
    from gearlube_core.dynamics.hypoid_torsional.parameters import KARAGIANNIS_OIL

    stopped = f"Stopped while results were written; {out} may be incomplete."
    with study_run("resonance", out, overwrite=overwrite, stopped=stopped) as frame:
        first, last = two_numbers("--range", frequency_range, "0.2:1.6")
        check_option("--radii", radii, _RADII)
        check_option("--friction", friction, _FRICTION)
        settings = ResonanceSettings(
            mesh=_mesh(mesh, mismatch, radii, torque),
            radii=radii,  # type: ignore[arg-type]
            pinion_torque=torque,
            oil_temperature=oil_kelvin(oil_temperature, KARAGIANNIS_OIL),
            roughness_rms=1e-6 * roughness_um,
            friction=friction,
            first=first,
            last=last,
            frequencies=frequencies,
            load_at=load_at,
        )
        for sentence in settings.warnings:
            logger.warning("%s", sentence)
        with frame.results() as progress:
            results = run.run_resonance(
                quick_settings(settings) if quick else settings, folder=out, progress=progress
            )
        found = summaries(results.response)
        if found:
            frame.show(_table(found))
        frame.written("resonance.nc", "cycle.nc", "figures")
        frame.finish(resonance_report(results.response, out / "figures", results.load))
    if results.interrupted:
        logger.warning("Stopped. The results found so far are in %s.", out)
        raise typer.Exit(INTERRUPTED)


def _mesh(name: str, mismatch: float, radii: str, torque: float) -> MeshTable:
    from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
    from gearlube_core.mesh_table.netcdf import read_mesh_table, shipped_mesh_table

    check_within("--mismatch", mismatch, -5.0, 5.0, "percent", "0.3 is usual.")
    if mismatch != 0.0 and (name != "synthetic" or radii != "paper"):
        raise ParameterError(
            f"--mismatch must be 0 with --mesh {name} and --radii {radii}, got {mismatch:g}. It "
            "works only with --mesh synthetic and --radii paper."
        )
    if name == "shipped":
        return shipped_mesh_table("mohammadpour_2015")
    if name == "synthetic":
        return synthetic_mesh(radius_mismatch=0.01 * mismatch, torque=torque)
    return read_mesh_table(name)


def _table(found: list[ModelSummary]) -> Table:
    from gearlube.studies.resonance.settings import MODELS

    table = empty_table(
        "Resonance; mesh frequencies over the natural frequency",
        *("model", ">folds, bifurcations", ">p-p [µm]", ">at", ">apart, rising", ">apart, falling"),
    )
    for summary in found:
        table.add_row(
            MODELS[summary.model],
            "\n".join(f"{kind} {at:.4f}" for kind, at in summary.special) or "none",
            f"{1e6 * summary.peak:.2f}",
            f"{summary.peak_at:.3f}",
            _ranges(summary.separated_up),
            _ranges(summary.separated_down),
        )
    return table


def _ranges(ranges: list[tuple[float, float]]) -> str:
    return "\n".join(f"{first:.3f} to {last:.3f}" for first, last in ranges) or "none"
