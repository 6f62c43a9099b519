"""Make the sound of a run, judge it, compare it with another: a library call."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.sound.dataset import sound_dataset
from gearlube.studies.sound.force_record import ForceRecord, read_forces
from gearlube.studies.sound.metrics import NEITHER, Curve, engine, installed, metric_curve, missing
from gearlube.studies.sound.order_tracks import HeardRun, Sound, contributions, track_orders
from gearlube.studies.sound.pressure import sound_pressure
from gearlube.studies.sound.report import write_sound
from gearlube.studies.sound.settings import METRICS, SoundSettings
from gearlube.studies.sound.transfer_path import Complex, TransferPath, generic_path, read_csv_path
from gearlube.studies.sound.wav import full_scale_for, played, wav_names
from gearlube.studies.sound.words import (
    common_speeds,
    difference_sentences,
    limit_sentences,
    sound_sentences,
)
from gearlube_core.arrays import Array
from gearlube_core.errors import FileError, ParameterError, unread
from gearlube_core.extras import extra_package
from gearlube_core.input_file.table import TABLES
from gearlube_core.progress import Progress, no_progress, part_of

_RESPONSE_FUNCTION = 4  # function type of a frequency response
_PRESSURE, _FORCE = (15,), (9, 13)  # specific data types: pressure; reaction and excitation force

_CURE = (
    "In every record of type 58 the reference is the force: its entity name is the bearing, or its "
    "node is the number of the bearing in the run; direction 1, 2, 3 is the direction in the run."
)

_UFF = (".uff", ".unv", ".uf", ".58")


def run_sound(
    run: Path | str | xr.Dataset,
    settings: SoundSettings | None = None,
    *,
    against: Path | str | xr.Dataset | None = None,
    transfer: Path | str | None = None,
    names: tuple[str, ...] = (),
    folder: Path | str | None = None,
    progress: Progress = no_progress,
) -> Sound:
    """Return the sound of a run: its bearing forces, sent through a transfer path to the ear.

    Parameters
    ----------
    run : path or dataset
        Bearing forces over time, see `read_forces`: a run-up or a steady recording.
    settings : SoundSettings, optional
    against : path or dataset, optional
        A second run; the findings then begin with the difference.
    transfer : path, optional
        Measured frequency responses, CSV or UFF58. None: the generic path.
    names : tuple of str
        Names of the runs; default: their folders.
    folder : path, optional
        Folder for sound.nc, WAV files, summary.csv, figures/ and report.html.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Returns
    -------
    Sound

    Raises
    ------
    ParameterError, FileError
        The input cannot be used; nothing has been written then.

    Examples
    --------
    >>> import numpy as np, xarray as xr
    >>> t = np.arange(20000) / 10000.0  # 2 s at 10 kHz; a force of 2 N at 400 Hz
    >>> force = 2.0 * np.cos(2.0 * np.pi * 400.0 * t)[:, None, None]
    >>> run = xr.Dataset(
    ...     {
    ...         "bearing_force": (("time", "bearing", "direction"), force, {"units": "N"}),
    ...         "pinion_speed": ("time", np.full(t.size, 200.0), {"units": "rad/s"}),
    ...     },
    ...     {"time": ("time", t, {"units": "s"})},
    ... )
    >>> sound = run_sound(run, SoundSettings(metrics=()))
    >>> round(float(sound.dataset["level"].mean()), 1)  # 1e-4 Pa/N on the plateau: 17 dB
    16.9
    """
    settings = settings or SoundSettings()
    sources = [run] if against is None else [run, against]
    records = [
        read_forces(source, name)
        for source, name in zip(sources, (*names, *[""] * len(sources)), strict=False)
    ]
    records = _told_apart(records)
    wanted, left_out = _metrics(settings)
    heard = []
    for i, record in enumerate(records):
        part = part_of(progress, i / len(records), (i + 1) / len(records))
        heard.append(_heard(record, transfer, settings, wanted, part))
    if len(heard) == 2:
        common_speeds(heard[0].dataset, heard[1].dataset)
    full_scale = _full_scale(heard, settings)
    files = wav_names([str(one.dataset.attrs["name"]) for one in heard], full_scale)
    sound = Sound(
        runs=tuple(replace(one, wav=name) for one, name in zip(heard, files, strict=True)),
        full_scale=full_scale,
        findings=tuple(_findings(heard)),
        limits=tuple(limit_sentences(heard[0].dataset)),
        missing=tuple(left_out),
    )
    if folder is None:
        return sound
    return write_sound(sound, settings, Path(folder))


def _told_apart(records: list[ForceRecord]) -> list[ForceRecord]:
    if len(records) == 2 and records[0].name == records[1].name:
        return [
            replace(one, name=f"{one.name} {letter}")
            for one, letter in zip(records, "AB", strict=True)
        ]
    return records


def _metrics(settings: SoundSettings) -> tuple[list[str], list[str]]:
    """Return the metrics that are computed, and why others are not."""
    if not settings.metrics:
        return [], []
    if settings.metrics == METRICS and installed() is None:
        return [], [NEITHER]  # who asks for all takes what there is; a metric by its name is due
    engine()
    reasons = {name: missing(name) for name in settings.metrics}
    return [name for name, why in reasons.items() if not why], [w for w in reasons.values() if w]


def _heard(
    record: ForceRecord,
    transfer: Path | str | None,
    settings: SoundSettings,
    wanted: list[str],
    progress: Progress,
) -> HeardRun:
    progress(0.0, f"{record.name}: pressure")
    path = read_transfer(transfer, record)
    pressure = sound_pressure(record, path, settings.band)
    tracks = track_orders(record, pressure, settings.orders, settings.revolutions)
    curves: dict[str, Curve] = {}
    for i, name in enumerate(wanted):
        progress(0.1 + 0.5 * i / len(wanted), f"{record.name}: {name.replace('_', ' ')}")
        curves[name] = metric_curve(name, pressure.signal, settings.field)
    audible = None
    if "loudness" in wanted:
        part = part_of(progress, 0.6, 1.0)
        audible = contributions(record, pressure, tracks, settings.field, part)
    progress(1.0, record.name)
    dataset = sound_dataset(record, path, pressure, tracks, curves, audible, settings)
    return HeardRun(dataset=dataset, pressure=pressure, path=path)


def _full_scale(heard: list[HeardRun], settings: SoundSettings) -> float:
    peak = max(
        float(np.max(np.abs(played(one.pressure.signal, settings.wav_rate)))) for one in heard
    )
    if settings.full_scale is None:
        return full_scale_for(peak)
    if peak > settings.full_scale:
        raise ParameterError(
            f"full_scale must be at least the peak of the sound, {peak:.4g} Pa, got "
            f"{settings.full_scale:g} Pa: the WAV would clip. Take {full_scale_for(peak):g} Pa, or "
            "leave it out."
        )
    return settings.full_scale


def _findings(heard: list[HeardRun]) -> list[str]:
    found = []
    if len(heard) == 2:
        found = difference_sentences(heard[0].dataset, heard[1].dataset)
    for one in heard:
        before = f"{one.dataset.attrs['name']}: " if len(heard) == 2 else ""
        found += [f"{before}{text}" for text in sound_sentences(one.dataset)]
    return found


def read_transfer(file: Path | str | None, record: ForceRecord) -> TransferPath:
    """Return the transfer path of a file for the forces of a run; None: the generic one.

    Raises
    ------
    FileError, ParameterError
        The file cannot be read, is of another kind, or lacks a response.
    """
    if file is None:
        return generic_path(record.paths)
    path = Path(file)
    if path.suffix.lower() in _UFF:
        named = [one.partition(".") for one in record.paths]
        bearings = list(dict.fromkeys(bearing for bearing, _, _ in named))
        directions = list(dict.fromkeys(direction for _, _, direction in named))
        found = _read_uff_path(path, bearings, directions)
    elif path.suffix.lower() in TABLES:
        found = read_csv_path(path)
    else:
        raise ParameterError(
            f"A transfer path must be a table ({', '.join(TABLES)}) or a universal file "
            f"({', '.join(_UFF)}), got {path}."
        )
    found.check_paths(record.paths)
    return found


def _read_uff_path(file: Path, bearings: Sequence[str], directions: Sequence[str]) -> TransferPath:
    """Return the transfer path in a UFF58 file.

    Parameters
    ----------
    file : Path
    bearings, directions : sequence of str
        Names in the run: the reference of a record is found by name, or by number from 1.

    Raises
    ------
    FileError
        The file cannot be read, or the package pyuff is missing.
    ParameterError
        No frequency response of pressure over force, or one whose reference is no force of the
        run.
    """
    responses: dict[str, Complex] = {}
    frequency: Array | None = None
    for record in _records(file):
        if record.get("type") != 58 or record.get("func_type") != _RESPONSE_FUNCTION:
            continue
        _check_units(record, file)
        path, sign = _path_of(record, bearings, directions, file)
        x = np.asarray(record["x"], dtype=np.float64)
        if frequency is not None and (x.shape != frequency.shape or not np.allclose(x, frequency)):
            raise ParameterError(
                f"All responses in {file} must have the same frequencies, got others for {path}. "
                "Export them with one resolution."
            )
        if path in responses:
            raise ParameterError(
                f"{file} must hold one response for each force, got two for {path}. Keep the one "
                "at the listener's ear."
            )
        frequency = x
        responses[path] = sign * np.asarray(record["data"], dtype=np.complex128)
    if frequency is None:
        raise ParameterError(
            f"{file} must hold frequency responses (dataset 58, function type 4), got none. {_CURE}"
        )
    return TransferPath(source=file.name, frequency=frequency, responses=responses)


def _records(file: Path) -> list[dict[str, Any]]:
    pyuff = extra_package("pyuff", "sound", f"{file} is read", "Or give the responses as CSV.")
    try:
        with file.open("rb"):
            pass
        found = pyuff.UFF(str(file)).read_sets()
    except OSError as reason:
        raise FileError(f"{unread('transfer path', file, reason)}.") from None
    except Exception as reason:  # pyuff raises plain Exception, ValueError and others
        raise FileError(f"{file} must be a universal file, it is not: {reason}.") from None
    return [found] if isinstance(found, dict) else list(found)


def _check_units(record: dict[str, Any], file: Path) -> None:
    above, below = (
        int(record.get(name, 0)) for name in ("ordinate_spec_data_type", "orddenom_spec_data_type")
    )
    labels = [
        str(record.get(name, "")).strip()
        for name in ("ordinate_axis_units_lab", "orddenom_axis_units_lab")
    ]
    typed = above in _PRESSURE and below in _FORCE
    labelled = labels[0] == "Pa/N" or labels == ["Pa", "N"]
    if labels[0] not in ("", "NONE", "Pa", "Pa/N") or labels[1] not in ("", "NONE", "N"):
        typed = labelled = False
    if not (typed or labelled):
        raise ParameterError(
            f"The responses in {file} must be pressure over force in Pa/N, got data types "
            f"{above} over {below} with the labels {labels[0] or 'none'!r} and "
            f"{labels[1] or 'none'!r}. Set the types to 15 (pressure) and 13 (force), or the label "
            "to Pa/N."
        )


def _path_of(
    record: dict[str, Any], bearings: Sequence[str], directions: Sequence[str], file: Path
) -> tuple[str, float]:
    name, node = str(record.get("ref_ent_name", "")).strip(), int(record.get("ref_node", 0))
    way = int(record.get("ref_dir", 0))
    bearing = name if name in bearings else ""
    if not bearing and 1 <= node <= len(bearings):
        bearing = bearings[node - 1]
    if not bearing or not 1 <= abs(way) <= len(directions):
        raise ParameterError(
            f"The reference of a response in {file} must be a force of the run, got entity "
            f"{name or 'none'!r}, node {node}, direction {way}; the run has the bearings "
            f"{', '.join(bearings)} and {len(directions)} directions. {_CURE}"
        )
    return f"{bearing}.{directions[abs(way) - 1]}", 1.0 if way > 0 else -1.0
