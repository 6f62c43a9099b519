"""The loss map as files for other tools."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text, number_text
from gearlube.output.mat_file import write_mat
from gearlube.studies.loss_map.datasets import GRID
from gearlube.studies.loss_map.regulation import OIL_DEGC, RegulationMap, regulation_map
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_text

_GEM_HEAD = ("wheel_speed_rpm", "output_torque_n_m", "power_loss_kw")
_COLUMNS = {
    "loss_torque": "loss_torque_n_m",
    "loss_torque_low": "loss_torque_low_n_m",
    "loss_torque_high": "loss_torque_high_n_m",
    "efficiency": "efficiency",
    "wheel_torque": "wheel_torque_n_m",
    "film_ratio": "film_ratio",
    "flank_temperature": "flank_temperature_degc",
    "share_outside": "share_outside",
    "rollers_outside": "rollers_outside",
    "range_exceeded": "range_exceeded",
}

_STEADY = {
    "steady_temperature": "steady_oil_temperature_degc",
    "steady_loss_torque": "steady_loss_torque_n_m",
}  # of speed and torque alone

_ORDER = ("speed", "torque", "temperature")

HEAD = "Input Speed [rpm],Input Torque [Nm],Torque Loss [Nm]"

_LEAST_ROWS = 4

logger = logging.getLogger("gearlube")


def gem_text(dataset: xr.Dataset) -> str:
    """Return speed of the wheels, torque of both wheels and power loss, as GEM rounds them.

    Points that failed are left out.

    Raises
    ------
    ParameterError
        No point is left.

    References
    ----------
    [epa_2016], rows of an axle test.
    """
    ratio = float(dataset.attrs["ratio"])
    rows = []
    for speed in dataset["speed"].values:
        for torque in dataset["torque"].values:
            point = dataset.sel(speed=speed, torque=torque)
            if np.isfinite(float(point["loss_torque"])):
                lost = float(point["loss"].sum())
                rows.append(
                    (
                        f"{speed / ratio:.1f}",
                        f"{float(point['wheel_torque']):.2f}",
                        f"{1e-3 * lost:.4f}",
                    )
                )
    if not rows:
        raise ParameterError(
            "A table for GEM needs at least one computed point, got none. map.csv gives the "
            "reasons."
        )
    return csv_text(_GEM_HEAD, rows)


@dataclass(frozen=True, slots=True, kw_only=True)
class LossyGearTable:
    """Rows of `lossTable` and what a loss that is linear in torque leaves.

    Parameters
    ----------
    rows : ndarray of shape (speeds, 5)
        abs(speed) [rad/s], mesh efficiency with the pinion driving and with the gear driving,
        bearing friction torque at the pinion in both cases [N.m].
    misfit : float
        Largest difference of the loss torque from that of the map [N.m].
    """

    rows: Array
    misfit: float


def lossy_gear_table(dataset: xr.Dataset) -> LossyGearTable:
    """Return the table that is nearest to the map, by least squares at each speed.

    The gear loses the torque (1 - eta1) T + tau1 with the pinion driving and (1 - 1/eta2) T + tau2
    with the gear driving, T being the torque on the pinion. A side with fewer than two points
    takes the line of the other; a speed without either has no row.
    """
    torque = dataset["torque"].values
    loss = dataset["loss_torque"].transpose("speed", "torque").values
    rows, misfit = [], 0.0
    for speed, lost in zip(dataset["speed"].values, loss, strict=True):
        lines: list[tuple[float, float] | None] = [None, None]
        for side, chosen in enumerate((torque >= 0.0, torque <= 0.0)):
            here = chosen & np.isfinite(lost)
            if here.sum() < 2:
                continue
            slope, base = lines[side] = _line(torque[here], lost[here], rising=side == 0)
            misfit = max(misfit, float(np.abs(slope * torque[here] + base - lost[here]).max()))
        drive, coast = lines[0] or _mirrored(lines[1]), lines[1] or _mirrored(lines[0])
        if drive is not None and coast is not None:
            driven = 1.0 / (1.0 - coast[0])
            rows.append([speed * np.pi / 30.0, 1.0 - drive[0], driven, drive[1], coast[1]])
    return LossyGearTable(rows=np.array(rows).reshape(-1, 5), misfit=misfit)


def _mirrored(line: tuple[float, float] | None) -> tuple[float, float] | None:
    return None if line is None else (-line[0], line[1])


def _line(x: Array, y: Array, *, rising: bool) -> tuple[float, float]:
    """Return slope and base; a slope of the wrong sign, an efficiency above 1, becomes 0."""
    slope, base = (float(one) for one in np.polyfit(x, y, 1))
    if slope < 0.0 if rising else slope > 0.0:
        slope, base = 0.0, float(y.mean())
    return slope, max(base, 0.0)


def lossy_gear_text(dataset: xr.Dataset) -> str:
    """Return a Modelica record with the table; its comment has the misfit.

    Raises
    ------
    ParameterError
        No speed has two points on one side: the table would have no row.
    """
    table = lossy_gear_table(dataset)
    if not len(table.rows):
        raise ParameterError(
            "A lossTable needs at least two computed torques on one side at one speed, got none. "
            "Take more torques, or see the reasons in map.csv."
        )
    name = f"AxleLosses{float(dataset['temperature']):.0f}degC".replace("-", "minus")
    lines = ",\n    ".join(", ".join(f"{value:.7g}" for value in row) for row in table.rows)
    lines = lines.replace(",\n", ";\n")
    return (
        f"record {name}\n"
        f'  "Losses of an axle; flange_a is the pinion. Linear in torque: up to '
        f'{table.misfit:.3g} N.m off"\n'
        "  extends Modelica.Icons.Record;\n"
        f"  parameter Real ratio = {float(dataset.attrs['ratio']):.9g};\n"
        "  parameter Real lossTable[:, 5] = [\n"
        f"    {lines}];\n"
        f"end {name};\n"
    )


def _vtlm_text(dataset: xr.Dataset) -> str:
    """Return the lines of a .vtlm file: input is the pinion, coast torque negative, loss positive.

    The torque of the wheels is (torque - loss) times the ratio. Points that failed are left out.
    Rows at 0 rpm repeat the lowest speed, as in VECTO's generic axles: VECTO starts from rest, and
    friction from rest is not computed.

    Raises
    ------
    ParameterError
        Fewer than four points are left; VECTO refuses such a map.
    """
    loss = dataset["loss_torque"].transpose("speed", "torque").values
    rows = [
        (float(speed), float(torque), float(loss[j, k]))
        for j, speed in enumerate(dataset["speed"].values)
        for k, torque in enumerate(dataset["torque"].values)
        if np.isfinite(loss[j, k])
    ]
    if len(rows) >= _LEAST_ROWS and rows[0][0] > 0.0:
        lowest = rows[0][0]
        rows = [(0.0, torque, lost) for speed, torque, lost in rows if speed == lowest] + rows
    return _text(rows)


def _text(rows: Iterable[tuple[float, float, float]]) -> str:
    lines = [HEAD]
    lines += [f"{speed:.4f},{torque:.4f},{loss:.4f}" for speed, torque, loss in rows]
    if len(lines) <= _LEAST_ROWS:
        raise ParameterError(
            f"A .vtlm map must have at least {_LEAST_ROWS} points, got {len(lines) - 1}. Take more "
            "torques or speeds."
        )
    return "\n".join(lines) + "\n"


_OF_A_TEMPERATURE = {
    "vecto_{}.vtlm": _vtlm_text,
    "gem_{}.csv": gem_text,
    "lossy_gear_{}.mo": lossy_gear_text,
}


def write_exports(dataset: xr.Dataset, folder: Path) -> None:
    """Write map.csv, map.mat, and for each temperature the files of VECTO, GEM and Modelica.

    A file that has too few points is left out with a warning; those of an earlier map are removed.
    """
    for pattern in _OF_A_TEMPERATURE:
        for old in folder.glob(pattern.format("*degC")):
            old.unlink()
    head, rows = table_rows(dataset)
    write_text(csv_text(head, rows), folder / "map.csv")
    _write_map_mat(dataset, folder / "map.mat")
    for temperature in dataset["temperature"].values:
        one = dataset.sel(temperature=temperature)
        name = f"{temperature:g}degC"
        for pattern, text_of in _OF_A_TEMPERATURE.items():
            try:
                write_text(text_of(one), folder / pattern.format(name))
            except ParameterError as reason:
                logger.warning("No %s: %s", pattern.format(name), reason)


def write_regulation_map(
    settings: LossMapSettings,
    folder: Path,
    *,
    raised: bool = False,
    progress: Progress = no_progress,
) -> Path:
    """Write the map on the grid of heavy-duty axle tests for VECTO; return its path."""
    kind = "raised_" if raised else ""
    path = folder / f"vecto_regulation_{kind}{OIL_DEGC:g}degC.vtlm"
    write_text(_regulation_text(regulation_map(settings, raised=raised, progress=progress)), path)
    return path


def _regulation_text(found: RegulationMap) -> str:
    """Return the lines of a .vtlm file of a map over speeds and torques of the wheels."""
    return _text(zip(found.speed, found.torque, found.loss, strict=True))


def _write_map_mat(dataset: xr.Dataset, path: Path) -> None:
    """Write breakpoints and tables over (speed, torque, temperature).

    `torque_loss_Nm` for a look-up of the loss; `efficiency` is NaN near zero torque, where a table
    of efficiency cannot hold a drag.
    """
    content = {
        "speed_rpm": dataset["speed"].values,
        "torque_Nm": dataset["torque"].values,
        "temperature_degC": dataset["temperature"].values,
        "torque_loss_Nm": dataset["loss_torque"].transpose(*_ORDER).values,
        "efficiency": dataset["efficiency"].transpose(*_ORDER).values,
        "ratio": float(dataset.attrs["ratio"]),
    }
    write_mat(content, path)


def table_rows(dataset: xr.Dataset) -> tuple[tuple[str, ...], Iterator[tuple[str, ...]]]:
    """Return the names of the columns and the rows; a point that failed says why."""
    kept = {name: column for name, column in _COLUMNS.items() if name in dataset}
    steady = {name: column for name, column in _STEADY.items() if name in dataset}
    sources = [str(one) for one in dataset["source"].values]
    head = (
        "oil_temperature_degc",
        "pinion_speed_rpm",
        "pinion_torque_n_m",
        *kept.values(),
        *(f"loss_{one}_w" for one in sources),
        *steady.values(),
        "reason",
    )
    return head, _rows(dataset, tuple(kept), tuple(steady))


def _rows(
    dataset: xr.Dataset, names: tuple[str, ...], steady: tuple[str, ...]
) -> Iterator[tuple[str, ...]]:
    reasons = dict(part.split(": ", 1) for part in dataset.attrs["reasons"].split("; "))
    values = [dataset[name].values for name in names]
    at_rest = [dataset[name].transpose(*GRID[1:]).values for name in steady]
    losses, statuses = dataset["loss"].values, dataset["status"].values
    temperatures, speeds, torques = (dataset[name].values for name in GRID)
    for i, temperature in enumerate(temperatures):
        for j, speed in enumerate(speeds):
            for k, torque in enumerate(torques):
                yield (
                    f"{temperature:.10g}",
                    f"{speed:.10g}",
                    f"{torque:.10g}",
                    *(number_text(one[i, j, k]) for one in values),
                    *(number_text(one) for one in losses[i, j, k]),
                    *(number_text(one[j, k]) for one in at_rest),
                    reasons.get(str(int(statuses[i, j, k])), ""),
                )
