"""What a march of a rough film will take on the disk, checked before it starts."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import NamedTuple

from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.errors import ParameterError

_FIELDS_KEPT = 2  # film and pressure, in single precision
_FIELDS_RECORDED = 9  # pressure, rh h at three times, its error, inflow, rise and copies
_RECORDS = 2  # an older one stays until the new one is whole
_FIGURES = 4_000_000  # B, figures and statistics
_PICTURE = 300_000  # B, of a kept film
_STEP = 400  # B, of the statistics of a step
_MEGABYTE = 1e6


class DiskNeed(NamedTuple):
    """Bytes of the files of a march."""

    frames: int
    records: int
    others: int
    free: int

    @property
    def total(self) -> int:
        """All files [B]."""
        return self.frames + self.records + self.others

    @property
    def sentence(self) -> str:
        """Return the need in words."""
        parts = (
            (self.frames, "of kept films"),
            (self.records, "of records to go on from"),
            (self.others, "of statistics and figures"),
        )
        told = ", ".join(f"{one / _MEGABYTE:.1f} MB {words}" for one, words in parts)
        return f"It will take {self.total / _MEGABYTE:.0f} MB on the disk: {told}."


def disk_need(case: RoughCase, folder: Path) -> DiskNeed:
    """Return what the files of a march take.

    Raises
    ------
    ParameterError
        The disk has less.
    """
    nodes, kept = case.solver.nodes_x * (case.solver.rows + 2), len(case.kept_steps())
    steps = case.schedule().steps + 1
    near = next(one for one in (folder, *folder.absolute().parents) if one.exists())
    need = DiskNeed(
        frames=kept * (4 * _FIELDS_KEPT * nodes + _PICTURE),
        records=_RECORDS * (8 * _FIELDS_RECORDED * nodes + _STEP * steps),
        others=_FIGURES + 3 * _STEP * steps,
        free=shutil.disk_usage(near).free,
    )
    if need.total > need.free:
        raise ParameterError(
            f"{folder} must have {need.total / _MEGABYTE:.0f} MB free space, got "
            f"{need.free / _MEGABYTE:.0f} MB. Keep fewer films ([frames]), or give --out on "
            "another disk."
        )
    return need
