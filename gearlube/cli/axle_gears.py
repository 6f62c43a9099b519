"""The mesh table of an axle file's gear file, brought up to date with a bar on the terminal."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from pathlib import Path

from gearlube.cli.study_run import progress_on

_LOGGER = logging.getLogger("gearlube")


def bring_gears_up_to_date(
    axle: str | Path | None, others: Iterable[str] = (), *, jobs: int | None = None
) -> None:
    """Analyse the gear file of an axle file where its mesh table is missing or out of date.

    All that reads the axle file afterwards finds the table.

    Parameters
    ----------
    axle : path, optional
        Axle file, or the name of a shipped one; None: nothing is done.
    others : iterable of str
        Gear files that stand in its place one after another.
    jobs : int, optional
        Processes; default: all processors.

    Raises
    ------
    GearLubeError
        A file is missing or wrong, or the analysis fails.
    """
    if axle is None:
        return
    from drivetrain.axle_file.axle_file import AxleFile
    from drivetrain.axle_file.read_axle import kept_table, table_file

    file = AxleFile.given(str(axle))
    folder = Path(axle).parent
    for one in [file, *(file.varied({"gear_set.gear_file": other}) for other in others)]:
        if one.gear_set.gear_file is None or kept_table(one, folder).current() is not None:
            continue
        _LOGGER.info("The contact of %s is analysed, once, and kept.", one.gear_set.named)
        with progress_on("contact") as progress:
            table_file(one, folder, jobs=jobs, progress=progress)
