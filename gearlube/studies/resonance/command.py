"""The command `gearlube resonance`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from gearlube.cli.exit_codes import INTERRUPTED, told
from gearlube.cli.options import OilTemperatureOption, RoughnessOption
from gearlube_core.checks import check_finite, check_option, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.units import celsius_to_kelvin

logger = logging.getLogger("gearlube")
console = Console(stderr=True)

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
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_resonance"),
    quick: Annotated[
        bool,
        typer.Option("--quick", help="Few frequencies and coarse steps, for a first look."),
    ] = False,
) -> None:
    """Follow the resonance of the torsional hypoid pair; write resonance.nc, cycle.nc and figures.

    Stable and unstable periodic motions of the dry 2-DOF and 1-DOF models and of the lubricated
    2-DOF model, with time sweeps as a check. Stopped with Ctrl-C, it writes what was found.
    """
    from gearlube.studies.resonance import ResonanceSettings, quick_settings
    from gearlube.studies.resonance.console import console_resonance

    with told(f"Stopped while results were written; {out} may be incomplete."):
        first, last = _range(frequency_range)
        check_option("--radii", radii, _RADII)
        check_option("--friction", friction, _FRICTION)
        check_within("--oil-temperature", oil_temperature, -20.0, 160.0, "degC")
        settings = ResonanceSettings(
            mesh=_mesh(mesh, mismatch, radii, torque),
            radii=radii,  # type: ignore[arg-type]
            pinion_torque=torque,
            oil_temperature=celsius_to_kelvin(oil_temperature),
            roughness_rms=1e-6 * roughness_um,
            friction=friction,
            first=first,
            last=last,
            frequencies=frequencies,
        )
        if load_at is not None:
            check_within("--load-at", load_at, 0.05, 3.0, "", "0.9 shows the bistable range.")
        finished = console_resonance(
            console,
            settings=quick_settings(settings) if quick else settings,
            out=out,
            load_at=load_at,
        )
    if not finished:
        logger.warning("Stopped. What was found until then is in %s.", out)
        raise typer.Exit(INTERRUPTED)


def _mesh(name: str, mismatch: float, radii: str, torque: float) -> MeshTable:
    from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
    from gearlube_core.mesh_table.netcdf import read_mesh_table
    from gearlube_core.mesh_table.shipped import shipped_mesh_table

    check_within("--mismatch", mismatch, -5.0, 5.0, "percent", "0.3 is usual.")
    if mismatch != 0.0 and (name != "synthetic" or radii != "paper"):
        raise ParameterError(
            f"--mismatch must be 0 with --mesh {name} and --radii {radii}, got {mismatch:g}. "
            "It is of use with --mesh synthetic and --radii paper."
        )
    if name == "shipped":
        return shipped_mesh_table("mohammadpour_2015")
    if name == "synthetic":
        return synthetic_mesh(radius_mismatch=0.01 * mismatch, torque=torque)
    return read_mesh_table(name)


def _range(text: str) -> tuple[float, float]:
    """Return the two numbers of "0.2:1.6"."""
    pieces = text.split(":")
    cure = "Write first:last, for instance 0.2:1.6."
    if len(pieces) != 2:
        raise ParameterError(f"--range must be two numbers, got {text!r}. {cure}")
    first, last = (check_finite("--range", piece, "", cure) for piece in pieces)  # type: ignore[arg-type]
    return first, last
