"""The report of a sound: what one hears, players, figures, limits."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

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
from gearlube.studies.sound.audible import METHOD
from gearlube.studies.sound.charts import level_chart, metric_chart
from gearlube.studies.sound.dataset import order_name, weighted_order
from gearlube.studies.sound.heard import Sound
from gearlube.studies.sound.metrics import METRICS

_DPI = 130
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


def write_sound_report(
    sound: Sound, drawn: dict[str, Any], folder: Path, command_line: str = ""
) -> Path:
    """Write report.html into a folder and return its path; `drawn` has the figures."""
    return write_report(sound_report(sound, drawn, command_line), folder)


def sound_report(sound: Sound, drawn: dict[str, Any], command_line: str = "") -> Report:
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
        figures=_figures(datasets, drawn),
        inputs=_inputs(sound),
        limits=(*sound.limits, METHOD),
        facts=(
            ("command", command_line or "(run from Python)"),
            ("metrics", str(datasets[0].attrs["standards"])),
        ),
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


def _figures(datasets: Sequence[xr.Dataset], drawn: dict[str, Any]) -> list[Figure]:
    charts = {"levels": level_chart(datasets), "metrics": metric_chart(datasets)}
    found = []
    for name, (title, caption) in _TITLES.items():
        if name not in drawn:
            continue
        chart = charts.get(name)
        found.append(
            Figure(
                name=name,
                title=title,
                caption=caption,
                chart=chart,
                picture=None if chart is not None else _png(drawn[name]),
            )
        )
    return found


def _png(figure: Any) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=_DPI)
    return buffer.getvalue()


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
