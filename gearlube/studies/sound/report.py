"""The report of a sound: what one hears, players, figures, limits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.plotting.figure_files import save_figure_folder
from gearlube.report.inputs import origin_of
from gearlube.report.page import write_report
from gearlube.report.parts import (
    ASSUMED,
    GIVEN,
    INFERRED,
    NOTE,
    WARNING,
    Figure,
    Finding,
    Input,
    Number,
    Recording,
    Report,
)
from gearlube.report.pictures import shown
from gearlube.studies.sound.dataset import (
    is_ramp,
    order_name,
    speed_axis,
    weighted_order,
)
from gearlube.studies.sound.figures import draw_all
from gearlube.studies.sound.metrics import METRICS
from gearlube.studies.sound.order_tracks import METHOD, Sound
from gearlube.studies.sound.settings import SoundSettings
from gearlube.studies.sound.wav import OWN_WAV, write_wav
from gearlube_core.storage.atomic_file import write_dataset, write_text

_TITLES = {
    "spectrogram": (
        "Spectrogram",
        "A-weighted level over time and frequency. Lines that rise with speed are orders; what "
        "stays at one frequency is a resonance.",
    ),
    "levels": (
        "Levels over speed",
        "The whole sound and each order alone, A-weighted as the ear does for quiet sounds. Two "
        "runs: solid the first, dashed the second.",
    ),
    "metrics": (
        "Loudness and more over speed",
        "Twice the sone is twice as loud. Two runs: solid the first, dashed the second. The first "
        "tenths of a second of a run build up.",
    ),
    "heard_orders": (
        "Which order one hears",
        f"{METHOD} Lines above the grey area are heard; the highest is heard most.",
    ),
    "transfer_path": (
        "Transfer path",
        "Sound pressure at the ear for a force of 1 N on a bearing.",
    ),
}
_MOST_ROWS = 60


def write_sound_report(sound: Sound, drawn: dict[str, Any], folder: Path) -> Path:
    """Write report.html into a folder and return its path; `drawn` has the figures."""
    return write_report(sound_report(sound, drawn), folder)


def sound_report(sound: Sound, drawn: dict[str, Any]) -> Report:
    """Return the report of one sound or of two side by side."""
    datasets = [run.dataset for run in sound.runs]
    names = [str(one.attrs["name"]) for one in datasets]
    return Report(
        study="sound",
        title=f"Sound of {' and '.join(names)}",
        subtitle="Bearing forces through a transfer path to one ear: "
        f"{datasets[0].attrs['transfer_path']}.",
        findings=_findings(sound),
        recordings=_recordings(sound),
        numbers=[number for one in datasets for number in _numbers(one, several=len(datasets) > 1)],
        figures=_figures(drawn),
        inputs=_inputs(sound),
        limits=(*sound.limits, METHOD),
        facts=(("metrics", str(datasets[0].attrs["standards"])),),
        files=(*(name for name in sound.files if "/" not in name), "figures/"),
    )


def _findings(sound: Sound) -> list[Finding]:
    found = [Finding(NOTE, text) for text in sound.findings]
    if sound.runs[0].path.generic:
        found.append(Finding(WARNING, sound.limits[0], "Give measured ones with --transfer."))
    found += [Finding(NOTE, f"Missing: {text}.") for text in sound.missing]
    return found


def _recordings(sound: Sound) -> list[Recording]:
    found = []
    for run in sound.runs:
        name = str(run.dataset.attrs["name"])
        wav = next(path for path in sound.files.values() if path.name == run.wav)
        found.append(
            Recording(
                name,
                f"Full scale {sound.full_scale:g} Pa, peak {run.dataset.attrs['peak_pa']:.3g} Pa. "
                "Do not change the volume between two sounds.",
                wav.read_bytes(),
            )
        )
    return found


def _numbers(dataset: xr.Dataset, *, several: bool) -> list[Number]:
    before = f"{dataset.attrs['name']}: " if several else ""
    found = [
        Number(f"{before}largest level", float(dataset["level_a"].max()), "dB(A)"),
        Number(f"{before}mean level", float(dataset.attrs["level_a_mean_db"]), "dB(A)"),
    ]
    for name, metric in METRICS.items():
        if name in dataset:
            end = " (N5)" if name == "loudness" else ""
            value = float(dataset[f"{name}_single"])
            found.append(Number(f"{before}{metric.words}{end}", value, metric.unit, 2))
    for i, order in enumerate(dataset["order"].values):
        level = float(np.nanmax(weighted_order(dataset, i)))
        words = order_name(float(order), int(dataset.attrs["pinion_teeth"]))
        found.append(Number(f"{before}largest level of {words}", level, "dB(A)"))
    return found


def _figures(drawn: dict[str, Any]) -> list[Figure]:
    return [
        shown(name, title, caption, drawn[name])
        for name, (title, caption) in _TITLES.items()
        if name in drawn
    ]


def _inputs(sound: Sound) -> list[Input]:
    first = sound.runs[0]
    low, high = first.dataset.attrs["band_hz"]
    generic = first.path.generic
    origin = (ASSUMED, "generic") if generic else origin_of("transfer")
    reached, field = (INFERRED, "where run and path reach"), str(first.dataset.attrs["field"])
    return [
        *(Input("run", str(run.dataset.attrs["name"]), "", GIVEN, "") for run in sound.runs),
        Input("transfer path", first.path.source, "", *origin),
        Input("band", f"{low:.0f} to {high:.0f}", "Hz", *origin_of("band", otherwise=reached)),
        Input("sound field, for the loudness", field, "", *origin_of("field")),
    ]


def write_sound(sound: Sound, settings: SoundSettings, folder: Path) -> Sound:
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
    report = write_sound_report(written, drawn, folder)
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
