"""The report of a resonance study: findings, figures, table, inputs, limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY
from gearlube.report.charts import Axis, Line, add_line, line_chart, mark_level, panels
from gearlube.report.inputs import origin_of
from gearlube.report.parts import Cell, Column, Figure, Input, Report, Table
from gearlube.report.pictures import pictured
from gearlube.studies.resonance.figures.catalogue import RESONANCE_CATALOGUE
from gearlube.studies.resonance.figures.response_curves import segments
from gearlube.studies.resonance.findings import findings, leading_model, numbers, pinion_rpm
from gearlube.studies.resonance.settings import MODELS
from gearlube.studies.resonance.summary import summaries
from gearlube_core.arrays import Array
from gearlube_core.units import kelvin_to_celsius

_FREQUENCY = Axis("mesh over natural frequency")
_SHOWN = ("two_dof", "one_dof")  # of the others a click in the legend shows the lines
_ORDERS = 4  # as in the picture; higher ones may lie beyond those of the mesh table
_ERROR, _APART = Axis("peak to peak", "µm"), Axis("time without contact", "%")
_MICRO, _PERCENT = 1e6, 100.0

_LIMITS = (
    "The pair alone, two rotations about rigid shafts and bearings; in a car shafts and housing "
    "add natural frequencies.",
    "Periodic motions that repeat after one mesh period, or two where they double; motions that "
    "never repeat are seen in the sweeps in time only.",
    "While flanks are apart there is no damping by a film; impacts have the damping of the mesh.",
    "All teeth are equal.",
)
_COLUMNS = (
    Column("model"),
    Column("folds and bifurcations at"),
    Column("largest response, p-p", "µm"),
    Column("at"),
    Column("pinion speed", "rpm", 4),
    Column("teeth apart, rising"),
    Column("teeth apart, falling"),
)


def resonance_report(response: xr.Dataset, figures: Path, load: xr.Dataset | None = None) -> Report:
    """Return the report of a resonance study; `figures` is the folder of its pictures."""
    attributes = response.attrs
    charts: dict[str, Any] = {}
    if "model" in response:
        charts = {
            "response": response_chart(response),
            "harmonics": _harmonics_chart(response, leading_model(response)),
            "stability": _stability_chart(response),
        }
    drawn = pictured(RESONANCE_CATALOGUE, figures, charts)
    if load is not None:
        drawn.insert(1, _over_torque(load))
    return Report(
        study="resonance",
        title="Resonance of a torsional hypoid pair",
        subtitle=f"Stable and unstable periodic motions from {attributes['first']:g} to "
        f"{attributes['last']:g} of the natural frequency at {attributes['pinion_torque']:g} N·m "
        f"on the pinion, mesh {attributes.get('mesh', 'not reached')}.",
        findings=findings(response, load),
        numbers=numbers(response),
        figures=drawn,
        tables=[_table(response)] if "model" in response else [],
        inputs=_inputs(response),
        limits=_LIMITS,
        facts=[("source", str(attributes["source"]))] if attributes["source"] else [],
        files=("resonance.nc", "cycle.nc", *(() if load is None else ("load.nc",)), "figures/"),
    )


def _over_torque(load: xr.Dataset) -> Figure:
    return Figure(
        name="load_response",
        title="Response over load",
        caption=f"At {load.attrs['relative_frequency']:g} of the natural frequency, without "
        "friction. Dashed: unstable motions. Where two stable motions lie above each other, which "
        "one runs depends on where the torque came from.",
        chart=_load_chart(load),
    )


def _table(response: xr.Dataset) -> Table:
    rows: list[list[Cell]] = [
        [
            MODELS[one.model],
            ", ".join(f"{kind} {at:.4f}" for kind, at in one.special) or "none",
            1e6 * one.peak,
            one.peak_at,
            pinion_rpm(response, one.peak_at),
            _ranges(one.separated_up),
            _ranges(one.separated_down),
        ]
        for one in summaries(response)
    ]
    return Table(
        title="Models side by side",
        columns=_COLUMNS,
        rows=rows,
        caption="Frequencies are mesh over natural frequency. Teeth part along slow sweeps of "
        "rising and of falling speed.",
    )


def _ranges(ranges: list[tuple[float, float]]) -> str:
    return ", ".join(f"{a:.3f} to {b:.3f}" for a, b in ranges) or "never"


def _inputs(response: xr.Dataset) -> list[Input]:
    given = response.attrs
    oil, rough = kelvin_to_celsius(given["oil_temperature"]), 1e6 * given["roughness_rms"]
    found = [
        Input("pinion torque", f"{given['pinion_torque']:g}", "N·m", *origin_of("torque")),
        Input(
            "range, mesh over natural frequency",
            f"{given['first']:g} to {given['last']:g}",
            "",
            *origin_of("frequency_range"),
        ),
        Input("contact radii", str(given["radii"]), "", *origin_of("radii")),
        Input("flank friction", str(given["friction"]), "", *origin_of("friction")),
        Input("oil temperature", f"{oil:.4g}", "°C", *origin_of("oil_temperature")),
        Input("roughness of both flanks, rms", f"{rough:.4g}", "µm", *origin_of("roughness_um")),
    ]
    for name, words, scale, unit in (
        ("damping_ratio", "damping ratio", 100.0, "%"),
        ("static_deflection", "static deflection", 1e6, "µm"),
        ("mesh_stiffness", "mean mesh stiffness", 1e-6, "N/µm"),
        ("equivalent_mass", "equivalent mass", 1.0, "kg"),
        ("backlash", "backlash", 1e6, "µm"),
        ("mesh_orders", "mesh orders of the table", 1.0, ""),
    ):
        if name in given:
            origin = "inferred" if name in ("static_deflection", "equivalent_mass") else "assumed"
            why = "of the pair and its mesh" if origin == "inferred" else "of the shipped pair"
            if name in ("mesh_stiffness", "mesh_orders"):
                origin, why = "inferred", "mesh table"
            found.append(Input(words, f"{scale * float(given[name]):.4g}", unit, origin, why))
    return found


def response_chart(response: xr.Dataset) -> Any:
    """Return transmission error and time without contact over frequency; dashed: unstable."""
    figure = panels(("Transmission error", "Teeth apart"), _FREQUENCY, (_ERROR, _APART), height=330)
    for number, model in enumerate(response["model"].values):
        label = MODELS[str(model)]
        branches = segments(response, str(model))
        for row, (name, scale) in enumerate(
            (("peak_to_peak", _MICRO), ("separation_share", _PERCENT)), 1
        ):
            axis = (_ERROR, _APART)[row - 1]
            for line in _by_stability(branches, "relative_frequency", name, scale, label):
                add_line(figure, line, number, _FREQUENCY, axis, row=row, col=1)
                figure.data[-1].update(
                    mode="lines",
                    legendgroup=line.name,
                    showlegend=row == 1,
                    visible=True if str(model) in _SHOWN else "legendonly",
                )
    _add_sweeps(figure, response)
    figure.update_layout(showlegend=True)
    return figure


def _add_sweeps(figure: Any, response: xr.Dataset) -> None:
    """Add slow sweeps in time of the first model that has them, as triangles."""
    if "sweep_peak_to_peak" not in response:
        return
    part = response.isel(swept_model=0)
    for direction, symbol in (("up", "triangle-up-open"), ("down", "triangle-down-open")):
        one = part.sel(direction=direction)
        figure.add_scatter(
            x=one["sweep_relative_frequency"].values,
            y=_MICRO * one["sweep_peak_to_peak"].values,
            mode="markers",
            marker={"symbol": symbol, "size": 9, "color": GREY},
            name=f"sweep {direction} in time, {MODELS[str(part['swept_model'].values)]}",
            row=1,
            col=1,
        )


def _harmonics_chart(response: xr.Dataset, model: str) -> Any:
    """Return the mesh orders of the stable motions of a model over frequency."""
    part = segments(response, model)
    lines = []
    for order in response["harmonic"].values[:_ORDERS]:
        x, y = _joined(part, "relative_frequency", None)
        values = [
            np.append(_MICRO * one["harmonics"].sel(harmonic=order).values, np.nan) for one in part
        ]
        held = np.concatenate([np.append(one["stable"].values, np.nan) for one in part]) > 0.5
        y = np.where(held, np.concatenate(values), np.nan)
        lines.append(Line(name=f"mesh order {order}", x=x, y=y))
    return line_chart(lines, _FREQUENCY, Axis("amplitude", "µm", log=True))


def _stability_chart(response: xr.Dataset) -> Any:
    """Return the growth of a small disturbance in one mesh period, of each model."""
    lines = []
    for model in response["model"].values:
        x, y = _joined(segments(response, str(model)), "relative_frequency", "multiplier")
        lines.append(Line(name=MODELS[str(model)], x=x, y=y))
    figure = line_chart(lines, _FREQUENCY, Axis("factor in a mesh period"))
    mark_level(figure, 1.0, "above: unstable")
    return figure


def _load_chart(load: xr.Dataset) -> Any:
    """Return transmission error and time without contact over the torque; dashed: unstable."""
    torque = Axis("pinion torque", "N·m")
    figure = panels(("Transmission error", "Teeth apart"), torque, (_ERROR, _APART), height=300)
    for number, form in enumerate(load["form"].values):
        part = load.sel(form=form)
        branches = [part.sel(branch=one) for one in part["branch"].values]
        for row, (name, scale) in enumerate(
            (("peak_to_peak", _MICRO), ("separation_share", _PERCENT)), 1
        ):
            axis = (_ERROR, _APART)[row - 1]
            for line in _by_stability(branches, "torque", name, scale, MODELS[str(form)]):
                add_line(figure, line, number, torque, axis, row=row, col=1)
                figure.data[-1].update(mode="lines", legendgroup=line.name, showlegend=row == 1)
    figure.update_layout(showlegend=True)
    return figure


def _joined(branches: list[xr.Dataset], x: str, y: str | None) -> tuple[Array, Array]:
    """Return branches one after the other, with gaps between them."""
    places = [np.append(one[x].values, np.nan) for one in branches]
    values = places if y is None else [np.append(one[y].values, np.nan) for one in branches]
    return np.concatenate(places), np.concatenate(values)


def _by_stability(
    branches: list[xr.Dataset], x: str, y: str, scale: float, label: str
) -> list[Line]:
    """Return a solid line of stable motions and a dashed one of unstable motions.

    A stretch ends on the first row of the next, so that both meet.
    """
    places, values = _joined(branches, x, y)
    stable = np.concatenate([np.append(one["stable"].values, np.nan) for one in branches])
    loose = stable < 0.5
    reached = loose.copy()
    reached[1:] |= loose[:-1]
    reached[:-1] |= loose[1:]
    found = [Line(name=label, x=places, y=np.where(stable > 0.5, scale * values, np.nan))]
    if loose.any():
        dashed = np.where(reached, scale * values, np.nan)
        found.append(Line(name=f"{label}, unstable", x=places, y=dashed, dash=1))
    return found
