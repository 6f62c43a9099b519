"""Reading an axle file with all that it names; a gear file is analysed where that is due.

It stands apart from the axle file because an FMU reads that one with its mesh table beside it, and
needs no contact analysis.
"""

from __future__ import annotations

from pathlib import Path

from drivetrain.axle_file.axle_file import AxleFile, CarAxle
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.kept_table import KeptTable
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.progress import Progress, no_progress


def kept_table(file: AxleFile, folder: Path = Path()) -> KeptTable:
    """Return where the mesh table of the gear file is kept; `folder` is that of the axle file."""
    return KeptTable(folder / file.gear_set.named, file.gear_set.contact_torques_n_m)


def table_file(
    file: AxleFile,
    folder: Path = Path(),
    *,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> Path | None:
    """Return the path of the mesh table; None where the file names a shipped one.

    Parameters
    ----------
    file : AxleFile
    folder : Path
        Of the file.
    jobs : int, optional
        Processes of the analysis of a gear file; default: all processors.
    progress : callable, optional
        Called with the share of that analysis that is done [-] and a sentence.

    Raises
    ------
    GearLubeError
        The analysis of the gear file fails, see `KeptTable`.
    """
    if file.gear_set.gear_file is not None:
        return kept_table(file, folder).up_to_date(jobs=jobs, progress=progress)
    return folder / file.gear_set.named if file.has_own_table else None


def mesh_of(
    file: AxleFile,
    folder: Path = Path(),
    *,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> MeshTable:
    """Return the mesh table of an axle file; parameters and errors as in `table_file`."""
    path = table_file(file, folder, jobs=jobs, progress=progress)
    return file.mesh() if path is None else read_mesh_table(path)


def gear_file_of(axle: str, gears: str = "") -> HypoidGearFile:
    """Return the gear file of an axle's gears; both are paths or shipped names.

    Raises
    ------
    ParameterError
        Nothing names a gear file.
    """
    named = AxleFile.given(axle).gear_set
    if not gears and named.gear_file is not None:
        gears = str(Path(axle).parent / named.gear_file)
    gears = gears or str(named.mesh_table)
    if not gears.endswith(".toml") and gears not in HypoidGearFile.shipped():
        raise ParameterError(
            "The standard, steps of wear and whine must have the gear file of the axle's hypoid "
            f"gears, got {gears!r}, which is none. Name a gear file (TOML) in [gear_set] of the "
            "axle file, or with --gears where the command has it."
        )
    return HypoidGearFile.given(gears)


def read_axle(
    path: str | Path, *, jobs: int | None = None, progress: Progress = no_progress
) -> CarAxle:
    """Return axle and car from an axle file, or from a shipped one by its name.

    Parameters
    ----------
    path : path
        The axle file (.toml), or the name of a shipped one.
    jobs : int, optional
        Number of processes of the contact analysis. It runs if the file names a gear file whose
        mesh table is missing or out of date. Default: all processors.
    progress : callable, optional
        Called with the share of that analysis that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        The file, or a file that it names, is missing, or fields of it or of its gear file or oil
        file are wrong; the message names all wrong fields.
    TableError
        Its mesh table or its asperity table is wrong.
    FileError
        A film model is damaged.
    ConvergenceError
        The analysis of its gear file finds no equilibrium.

    Examples
    --------
    >>> paper = read_axle("mohammadpour_2015")
    >>> paper.driveline.road_load.vehicle.mass  # kg
    1300.0
    >>> paper.assumed[-1].field
    'driveline.speed_control_frequency_hz'
    """
    file = AxleFile.given(str(path))
    folder = Path(path).parent
    mesh = mesh_of(file, folder, jobs=jobs, progress=progress)
    films = file.film.own_models(folder)
    return file.car_axle(mesh, file.asperities(folder), file.described_oil(folder), films)
