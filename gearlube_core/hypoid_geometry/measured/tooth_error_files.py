"""Pitch deviations and waves of a member's flanks, from CSV."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Literal

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.flank import Role, Side
from gearlube_core.hypoid_geometry.measured.member_rows import role_of, side_of
from gearlube_core.hypoid_geometry.measured.tooth_errors import Wave
from gearlube_core.input_file.table import read_table
from gearlube_core.units import DEGREE

PITCH_COLUMNS = ("member", "flank", "tooth", "deviation_um")
WAVE_COLUMNS = ("member", "flank", "waves", "amplitude_um", "phase_deg")
PitchKind = Literal["cumulative", "single"]
_MOST = 500.0  # um
_LEAST = 0.1  # um, largest deviation of a flank that can be meant
_CLOSED = 2.0  # um, sum of single deviations over a turn
_NAMED = 5  # missing teeth in an error


def read_pitch(
    path: str | Path, teeth: Mapping[Role, int], kind: PitchKind
) -> dict[tuple[Role, Side], Array]:
    """Return the cumulative pitch deviations of each flank in the file [m], (z,).

    Parameters
    ----------
    path
        CSV file with the columns of `PITCH_COLUMNS`; one line for each tooth of a flank.
    teeth : mapping of role to int
    kind
        "cumulative": how far the flank of a tooth lies further on in the sense of counting than it
        should, along the pitch circle. "single": the change of that from the tooth before, tooth 1
        from the last.

    Raises
    ------
    ParameterError
        A tooth is missing or given twice, a number is out of range or in another unit, or single
        deviations do not sum to zero.
    """
    values: dict[tuple[Role, Side], Array] = {}
    for row in read_table(path, PITCH_COLUMNS):
        role = role_of(row)
        side = side_of(row, role)
        tooth = row.whole("tooth", 1, teeth[role]) - 1
        found = values.setdefault((role, side), np.full(teeth[role], np.nan))
        if np.isfinite(found[tooth]):
            raise ParameterError(
                f"{row.where}: tooth {tooth + 1} of the {role}, {side} flank, occurs twice. Keep "
                "one, or check the flank."
            )
        found[tooth] = row.number("deviation_um", -_MOST, _MOST, "um")
    result = {}
    for (role, side), found in sorted(values.items()):
        where = f"{path}: {role}, {side} flank"
        missing = (np.flatnonzero(np.isnan(found)) + 1).tolist()
        if missing:
            more = f" and {len(missing) - _NAMED} more" if len(missing) > _NAMED else ""
            raise ParameterError(
                f"{where}: all {teeth[role]} teeth must be in the file, but these are missing: "
                f"{', '.join(map(str, missing[:_NAMED]))}{more}."
            )
        largest = float(np.max(np.abs(found)))
        if 0.0 < largest < _LEAST:
            raise ParameterError(
                f"{where}: the largest deviation must be 0 or at least {_LEAST:g} um, got "
                f"{largest:g} um. Is it in mm? {largest:g} mm is {1e3 * largest:g} um."
            )
        if kind == "single":
            rest = float(found.sum())
            if abs(rest) > _CLOSED:
                raise ParameterError(
                    f"{where}: single pitch deviations must sum to 0 within {_CLOSED:g} um over "
                    f"the turn, got {rest:.3g} um. Are they cumulative? Set pitch_kind = "
                    '"cumulative".'
                )
            found = np.cumsum(found - rest / found.size)
        result[role, side] = 1e-6 * (found - found.mean())
    return result


def read_waves(path: str | Path) -> dict[tuple[Role, Side], tuple[Wave, ...]]:
    """Return the waves of each flank in a CSV file with the columns of `WAVE_COLUMNS`.

    Raises
    ------
    ParameterError
        A number is out of range, or a number of waves is given twice.
    """
    values: dict[tuple[Role, Side], dict[int, Wave]] = {}
    for row in read_table(path, WAVE_COLUMNS):
        role = role_of(row)
        side = side_of(row, role)
        count = row.whole("waves", 1, 10_000)
        wave = Wave(
            count,
            1e-6 * row.number("amplitude_um", 0.0, 50.0, "um", "Half of peak to peak."),
            DEGREE * row.number("phase_deg", -360.0, 360.0, "deg"),
        )
        found = values.setdefault((role, side), {})
        if count in found:
            raise ParameterError(
                f"{row.where}: {count} waves of the {role}'s {side} flank occur twice. Add them up."
            )
        found[count] = wave
    return {key: tuple(waves.values()) for key, waves in sorted(values.items())}
