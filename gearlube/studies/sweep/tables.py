"""The tables of a sweep's report: points in three parts, natural frequencies, what went wrong."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr

from gearlube.plotting.range_words import range_text
from gearlube.plotting.style import preload_label
from gearlube.report.parts import Cell, Column, Table
from gearlube.studies.sweep.crossings import ORDERS, crossings
from gearlube.studies.sweep.figures.order_cuts import harmonic_amplitude
from gearlube.studies.sweep.point import FINISHED
from gearlube.studies.sweep.quantities import SEPARATION_MEANINGS
from gearlube_core.units import kelvin_to_celsius

_FEW = 24  # rows of a table that is shown at once
_Value = Callable[[xr.Dataset], Cell]
_WHERE: tuple[tuple[Column, _Value], ...] = (
    (Column("preload", "N", 4), lambda p: float(p["preload"])),
    (Column("speed", "km/h"), lambda p: float(p["speed_kmh"])),
)


def _of(name: str, factor: float = 1.0) -> _Value:
    return lambda p: factor * float(p[name]) if name in p else None


def _oil(point: xr.Dataset) -> Cell:
    if "oil_temperature" not in point:
        return None
    return float(kelvin_to_celsius(float(point["oil_temperature"])))


_VIBRATION: tuple[tuple[Column, _Value], ...] = (
    *_WHERE,
    (Column("mesh frequency", "Hz"), _of("mesh_frequency")),
    (Column("DTE least", "µm"), _of("dte_min", 1e6)),
    (Column("DTE largest", "µm"), _of("dte_max", 1e6)),
    (Column("DTE peak to peak", "µm"), _of("dte_pp", 1e6)),
    *((Column(f"order {n}", "µm"), _of(f"order_{n}", 1e6)) for n in ORDERS),
    (Column("separation"), lambda p: SEPARATION_MEANINGS[int(p["separation"])]),
    (Column("radial, peak to peak", "µm"), _of("radial_pp", 1e6)),
)
_LOADS: tuple[tuple[Column, _Value], ...] = (
    *_WHERE,
    (Column("pinion torque", "N·m"), _of("pinion_torque")),
    (Column("wheel torque", "N·m"), _of("wheel_torque")),
    (Column("mean mesh force", "N"), _of("mesh_force_mean")),
    (Column("dynamic factor"), _of("dynamic_factor")),
    (Column("roller 1 least", "N"), _of("roller_load_min")),
    (Column("roller 1 largest", "N"), _of("roller_load_max")),
)
_LOSSES: tuple[tuple[Column, _Value], ...] = (
    *_WHERE,
    (Column("oil", "°C"), _oil),
    (Column("film least", "µm"), _of("film_thickness_min", 1e6)),
    (Column("film ratio λ least"), _of("film_ratio_min")),
    (Column("flank film warmest", "°C"), lambda p: _celsius(p, "flank_temperature_max")),
    (Column("efficiency mesh", "%", 4), _of("efficiency_mesh", 100.0)),
    (Column("efficiency axle", "%", 4), _of("efficiency_axle", 100.0)),
    (Column("losses", "W"), lambda p: float(p["loss"].sum())),
    (Column("ranges left"), lambda p: int(p["range_exceeded"]) if "range_exceeded" in p else None),
    (Column("energy balance", "ppm of input", 2), _of("energy_closure_error", 1e6)),
)


def _celsius(point: xr.Dataset, name: str) -> Cell:
    return float(kelvin_to_celsius(float(point[name])))


def tables(dataset: xr.Dataset) -> list[Table]:
    """Return the tables of a report, what went wrong first."""
    points = _points(dataset)
    finished = [p for p in points if int(p["status"]) == FINISHED]
    return [
        *_failures([p for p in points if int(p["status"]) != FINISHED]),
        *_ranges(finished),
        *_modes(dataset),
        *(
            _of_points(finished, title, columns, caption)
            for title, columns, caption in (
                ("Vibration", _VIBRATION, "Transmission error, its mesh orders as amplitudes, and "
                 "the radial motion of the pinion. Extremes are over the whole record."),
                ("Loads", _LOADS, "Mean torques from the road; roller 1 of pinion bearing 1."),
                ("Films and losses", _LOSSES, "The energy balance is the part of the input that "
                 "outputs, losses and stored energy leave unexplained."),
            )
            if finished
        ),
    ]  # fmt: skip


def _points(dataset: xr.Dataset) -> list[xr.Dataset]:
    """Return every point as a dataset of its own, with the amplitudes of its mesh orders."""
    if "dte_spectrum" in dataset:
        dataset = dataset.assign(
            {
                f"order_{n}": (
                    ("preload", "speed"),
                    np.array(
                        [
                            harmonic_amplitude(dataset.isel(preload=row), n)
                            for row in range(dataset.sizes["preload"])
                        ]
                    ),
                )
                for n in ORDERS
            }
        )
    return [
        dataset.isel(preload=row, speed=column)
        for row in range(dataset.sizes["preload"])
        for column in range(dataset.sizes["speed"])
    ]


def _of_points(
    points: Sequence[xr.Dataset],
    title: str,
    columns: Sequence[tuple[Column, _Value]],
    caption: str,
) -> Table:
    return Table(
        title=f"Points: {title.lower()}",
        columns=[column for column, _ in columns],
        rows=[[value(point) for _, value in columns] for point in points],
        caption=caption,
        folded=len(points) > _FEW,
    )


def _failures(points: Sequence[xr.Dataset]) -> list[Table]:
    if not points:
        return []
    return [
        Table(
            title="Failed points",
            columns=[*(column for column, _ in _WHERE), Column("why")],
            rows=[[*(value(p) for _, value in _WHERE), str(p["message"].values)] for p in points],
        )
    ]


def _ranges(points: Sequence[xr.Dataset]) -> list[Table]:
    left = [p for p in points if "range_exceeded" in p and float(p["range_exceeded"]) > 0.0]
    if not left:
        return []
    return [
        Table(
            title="Points that left a range",
            columns=[*(column for column, _ in _WHERE), Column("what left its range")],
            rows=[
                [*(value(p) for _, value in _WHERE), range_text(str(p["range_message"].values))]
                for p in left
            ],
            caption="They left the range of a formula or of the mesh table. What is computed there "
            "is extrapolated.",
        )
    ]


def _modes(dataset: xr.Dataset) -> list[Table]:
    found = crossings(dataset)
    if not found:
        return []
    preloads = [float(p) for p in dataset["preload"].values]
    first = {(c.mode, c.order): c.speed_kmh for c in found if c.preload == preloads[0]}
    return [
        Table(
            title="Natural frequencies, and the speeds at which mesh orders meet them",
            columns=[
                Column("mode"),
                *(Column(preload_label(p), "Hz", 4) for p in preloads),
                *(Column(f"order {n} meets it at", "km/h") for n in ORDERS),
            ],
            rows=[
                [
                    str(mode),
                    *(float(f) for f in frequencies),
                    *(first.get((str(mode), n)) for n in ORDERS),
                ]
                for mode, frequencies in zip(
                    dataset["mode"].values, dataset["mode_frequency"].values.T, strict=True
                )
            ],
            caption=f"Speeds at preload {preloads[0]:g} N. Swept: "
            f"{float(dataset['speed_kmh'][0]):g} to {float(dataset['speed_kmh'][-1]):g} km/h.",
        )
    ]
