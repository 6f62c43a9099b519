"""Files of a sound: datasets, WAV, table, figures."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.plotting.figure_folder import save_figure_folder
from gearlube.studies.sound.dataset import is_ramp, order_name, speed_axis
from gearlube.studies.sound.figures import draw_all
from gearlube.studies.sound.heard import Sound
from gearlube.studies.sound.metrics import METRICS
from gearlube.studies.sound.report import write_sound_report
from gearlube.studies.sound.settings import SoundSettings
from gearlube.studies.sound.wav import OWN_WAV, write_wav
from gearlube_core.storage.atomic_file import write_dataset, write_text

_MOST_ROWS = 60


def write_sound(
    sound: Sound, settings: SoundSettings, folder: Path, command_line: str = ""
) -> Sound:
    """Write everything into a folder and return the sound with its files.

    sound.nc (and sound_b.nc), NAME_full_scale_X_Pa.wav, summary.csv, figures/, report.html.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob(OWN_WAV):
        old.unlink()
    files: dict[str, Path] = {}
    rows: list[list[str]] = []
    for run, end in zip(sound.runs, ("", "_b"), strict=False):
        scaled = run.dataset.assign_attrs(wav_full_scale_pa=sound.full_scale)
        file = folder / f"sound{end}.nc"
        write_dataset(scaled, file)
        wav = folder / run.wav
        write_wav(run.pressure.signal, wav, full_scale=sound.full_scale, rate=settings.wav_rate)
        files |= {file.name: file, wav.name: wav}
        rows += _rows(run.dataset)
    table = folder / "summary.csv"
    write_text(csv_text(_head(sound.runs[0].dataset), rows), table)
    drawn = draw_all(sound.runs)
    for path in save_figure_folder(drawn, folder / "figures"):
        files[f"figures/{path.name}"] = path
    written = replace(sound, files={**files, table.name: table})
    report = write_sound_report(written, drawn, folder, command_line)
    return replace(written, files={**written.files, report.name: report})


def _names(dataset: xr.Dataset) -> list[str]:
    return [name for name in ("level", "level_a", *METRICS) if name in dataset]


def _head(dataset: xr.Dataset) -> list[str]:
    unit = speed_axis(dataset)[1].replace("/", "_per_").replace("km_per_h", "kmh")
    speed = "vehicle_speed" if unit == "kmh" else "pinion_speed"
    units = {"level": "db", "level_a": "dba"}
    metrics = [f"{name}_{units.get(name) or METRICS[name].unit}" for name in _names(dataset)]
    teeth = int(dataset.attrs["pinion_teeth"])
    orders = [
        f"{order_name(float(q), teeth).replace(' ', '_')}_db" for q in dataset["order"].values
    ]
    return ["run", "time_s", f"{speed}_{unit}", *metrics, *orders]


def _rows(dataset: xr.Dataset) -> list[list[str]]:
    speed = speed_axis(dataset)[0]
    count = dataset.sizes["time"]
    chosen = np.unique(np.linspace(0, count - 1, min(count, _MOST_ROWS)).round().astype(int))
    if is_ramp(dataset) and speed[0] > speed[-1]:
        chosen = chosen[::-1]
    rows = []
    for i in chosen:
        values = [
            f"{float(dataset[name].values[i]):.1f}"
            if name.startswith("level")
            else f"{float(dataset[name].values[i]):.3g}"
            for name in _names(dataset)
        ]
        orders = [
            "" if np.isnan(level) else f"{level:.1f}"
            for level in dataset["order_level"].values[:, i]
        ]
        rows.append(
            [
                str(dataset.attrs["name"]),
                f"{float(dataset['time'][i]):.3f}",
                f"{speed[i]:.1f}",
                *values,
                *orders,
            ]
        )
    return rows
