"""The report of a helical pair: findings, figures, table, inputs, limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import COLOURS, Axis, Line, add_line, line_chart, mark_level, panels
from gearlube.report.inputs import file_inputs, origin_of, remark_findings
from gearlube.report.parts import ASSUMED, GIVEN, Cell, Column, Figure, Input, Number, Report, Table
from gearlube.report.pictures import pictured
from gearlube.studies.helical.figures.catalogue import HELICAL_CATALOGUE
from gearlube.studies.helical.figures.layout import distinct
from gearlube.studies.helical.figures.load_sharing import spread
from gearlube.studies.helical.findings import (
    ORDERS,
    Datasets,
    findings,
    largest_error,
    least_unstable,
    operating_error,
    order_amplitudes,
)
from gearlube.studies.helical.pair_losses import efficiency_band, in_operation, loss_band
from gearlube.studies.helical.settings import RPM
from gearlube.studies.helical.stages import HelicalResults
from gearlube.studies.helical.summary import loss_model, losses_rows
from gearlube_core.dynamics.helical_pair.gear_file_pair import USUAL_OIL, gear_file_oil
from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE

_ORDERS = 5
_MOST_ROWS = 100  # of the table of losses
_SPEED = Axis("pinion speed", "rpm")
_DEFAULT = ASSUMED, "default"
_MAIN = (
    "losses",
    "error_orders",
    "harris_map",
    "load_sharing",
    "separation",
    "campbell",
    "instability",
    "film_on_lines",
)
_LIMITS = (
    (
        "sweep",
        "Response and sweep are linear with a stiffness that varies over the mesh: they are valid "
        "while the teeth stay in contact. For separating teeth see tooth separation.",
    ),
    ("response", "Supports are springs at the bearings; shafts and housing are rigid."),
    (
        "losses",
        "Loads of film and losses are static. The losses do not include bearings, seals, churning "
        "and windage.",
    ),
    (
        "contact",
        "Pressures are those of an elastic half-space on cells; at sharp edges they have no finite "
        "value.",
    ),
)


def _loss_chart(losses: xr.Dataset) -> Any:
    """Return lost power and efficiency over speed, a line for each torque; one has its band."""
    y = Axis("power lost", "W"), Axis("efficiency of the teeth", "%")
    chart = panels(["Power lost in the mesh", "Efficiency of the mesh"], _SPEED, y)
    several = losses["temperature"].size > 1
    own = float(in_operation(losses)["torque"])
    for dash, temperature in enumerate(losses["temperature"].values):
        for number, torque in enumerate(spread(losses["torque"].values)):
            points = losses.sel(temperature=temperature, torque=torque)
            name = f"{torque:.4g} N·m" + (f", {temperature:.4g} °C" if several else "")
            speed = points["speed"].values
            at = [points.isel(speed=k) for k in range(speed.size)]
            for row, values, bands in (
                (1, points["loss"].sum("part").values, [loss_band(one) for one in at]),
                (2, 100.0 * points["efficiency"].values, [efficiency_band(one) for one in at]),
            ):
                look = {"legendgroup": name, "row": row, "col": 1}
                line = Line(name=name, x=speed, y=values, dash=dash)
                add_line(chart, line, number, _SPEED, y[row - 1], showlegend=row == 1, **look)
                if torque == own and bands[0] is not None:
                    low, high = np.array(bands).T
                    chart.add_scatter(
                        x=np.concatenate([speed, speed[::-1]]),
                        y=np.concatenate([low, high[::-1]]),
                        fill="toself",
                        fillcolor=COLOURS[number % len(COLOURS)],
                        opacity=0.18,
                        line={"width": 0},
                        mode="lines",
                        hoverinfo="skip",
                        name=f"95 % of the draws at {name}",
                        showlegend=row == 1,
                        **look,
                    )
    chart.update_xaxes(exponentformat="none")
    return chart


def helical_report(results: HelicalResults, figures: Path) -> Report:
    """Return the report of a study; `figures` is the folder of its pictures."""
    found, settings = results.datasets, results.settings
    charts = {"losses": _loss_chart(found["losses"])} if "losses" in found else {}
    said = findings(found)
    own = [_error_orders(results)] if "sweep" in found else []
    attributes = next(iter(found.values())).attrs if found else {}
    return Report(
        study="helical",
        title=f"Helical pair {settings.file.name}",
        subtitle=f"{settings.file.pinion.teeth} and {settings.file.gear.teeth} teeth, "
        f"{settings.pinion_torque:.4g} N·m and {settings.pinion_speed / RPM:.5g} rpm on the "
        "pinion.",
        findings=[*said[:1], *remark_findings(attributes), *said[1:]],
        numbers=numbers(found),
        figures=[*own, *pictured(HELICAL_CATALOGUE, figures, charts)],
        main_figures=_MAIN,
        tables=[
            *([_critical_speeds(results)] if "sweep" in found else []),
            *([_losses(found["losses"])] if "losses" in found else []),
        ],
        inputs=_inputs(results),
        limits=[
            *(words for name, words in _LIMITS if name in found),
            *(f"{name} failed: {why}" for name, why in results.failures.items()),
        ],
        facts=[
            (name, str(attributes[key]))
            for name, key in (("command", "command_line"), ("source", "source"))
            if attributes.get(key)
        ],
        files=(*(f"{name}.nc" for name in found), "summary.csv", "figures/"),
    )


def _error_orders(results: HelicalResults) -> Figure:
    return Figure(
        name="error_orders",
        title="Dynamic transmission error over speed",
        caption="Mesh orders of the motion along the line of action that stiffness and friction "
        "excite. Dotted: mesh order 1 meets a natural frequency, numbered as in the table.",
        chart=_error_orders_chart(results.datasets["sweep"]),
    )


def _critical_speeds(results: HelicalResults) -> Table:
    sweep = results.datasets["sweep"]
    teeth = 60.0 / float(sweep.attrs["pinion_teeth"])
    rows: list[list[Cell]] = [
        [number, 1e-3 * float(one), *(float(one) * teeth / order for order in ORDERS)]
        for number, one in enumerate(distinct(sweep["natural_frequency"].values, 0.05), 1)
    ]
    return Table(
        title="Critical speeds",
        columns=[
            Column("mode"),
            Column("natural frequency", "kHz"),
            *(Column(f"order {order} meets it at", "rpm", 4) for order in ORDERS),
        ],
        rows=rows,
        caption=f"{len(RELATIVE)} coordinates with the mean mesh stiffness, without damping. "
        "Frequencies within 5 % of the one before are left out.",
    )


def _losses(losses: xr.Dataset) -> Table:
    rows: list[list[Cell]] = []
    for one in losses_rows(losses, _MOST_ROWS):
        lost, kept = loss_band(one) or (None, None), efficiency_band(one) or (None, None)
        powers = float(one["loss"].sum()), *lost, float(one["loss"].sel(part="rolling"))
        where = (float(one[name]) for name in ("temperature", "torque", "speed"))
        rows.append([*where, *powers, 100.0 * float(one["efficiency"]), *kept, loss_model(one)])
    return Table(
        title="Losses of the pair",
        columns=[
            Column("oil", "°C"),
            Column("torque", "N·m", 4),
            Column("speed", "rpm", 4),
            Column("lost", "W"),
            Column("low", "W"),
            Column("high", "W"),
            Column("of it by rolling", "W"),
            Column("efficiency", "%", 4),
            Column("low", "%", 4),
            Column("high", "%", 4),
            Column("sliding by"),
        ],
        rows=rows,
        caption="losses.csv has all points. Low and high: between them lie 95 % of the draws "
        "of the uncertain data, by the model of the point.",
    )


def _inputs(results: HelicalResults) -> list[Input]:
    """Return the inputs that were used; [oil] of the gear file only where its oil was taken."""
    settings, file, film = results.settings, results.settings.file, results.settings.film()
    mu = np.asarray(settings.mu)
    own = GIVEN, "gear file"
    speed = origin_of("speed_rpm", otherwise=own)
    named = film.oil == gear_file_oil(file) and film.oil.name != USUAL_OIL
    model = own if "model" in file.film.model_fields_set else _DEFAULT
    kelvin, rough = settings.oil_temperature - 273.15, 1e6 * settings.roughness_rms
    return [
        Input(
            "pinion torque",
            f"{settings.pinion_torque:.5g}",
            "N·m",
            *origin_of("torque", otherwise=own),
        ),
        Input("pinion speed", f"{settings.pinion_speed / RPM:.5g}", "rpm", *speed),
        Input("coefficients of friction", f"{mu.min():g} to {mu.max():g}", "", *origin_of("mu")),
        Input("stiffness of the mesh", settings.mesh, "", *origin_of("mesh")),
        Input("oil", film.oil.name, "", *origin_of("oil", otherwise=own if named else _DEFAULT)),
        Input("film of the oil", film.film, "", *origin_of("film_model", otherwise=model)),
        *(Input("film model", one.words) for one in film.film_models.values()),
        Input("oil temperature", f"{kelvin:.4g}", "°C", *origin_of("oil_temperature")),
        Input("composite roughness", f"{rough:.3g}", "µm", *origin_of("roughness_um")),
        *(one for one in file_inputs(file) if named or not one.name.startswith("oil.")),
    ]


def _error_orders_chart(sweep: xr.Dataset) -> Any:
    """Return mesh orders of the dynamic transmission error over speed, resonances of order 1."""
    amplitude, _ = order_amplitudes(sweep)
    speed = sweep["speed"].values / RPM
    lines = [
        Line(name=f"order {order}", x=speed, y=amplitude[:, column])
        for column, order in enumerate(sweep["harmonic"].values[:_ORDERS])
    ]
    chart = line_chart(lines, _SPEED, Axis("dynamic transmission error", "µm", log=True))
    place = distinct(sweep["natural_frequency"].values, 0.05) / float(sweep["mesh_frequency"][-1])
    for number, one in enumerate(place * speed[-1], 1):
        if one <= speed[-1]:
            mark_level(chart, float(one), f"{number}", across=False)
    own = sweep.attrs["pinion_speed"] / RPM
    if own <= speed[-1]:
        mark_level(chart, float(own), "operating point", across=False)
    chart.update_xaxes(exponentformat="none")
    return chart


def numbers(datasets: Datasets) -> list[Number]:
    """Return the key numbers of a study, with the same names in every run."""
    nan = float("nan")
    peak = largest_error(datasets["sweep"]) if "sweep" in datasets else None
    own = operating_error(datasets["response"]) if "response" in datasets else None
    contact, film, losses = (datasets.get(name) for name in ("contact", "film", "losses"))
    separation, stability = datasets.get("separation"), datasets.get("stability")
    point = None if losses is None else in_operation(losses)
    at = None
    pressure = nan
    if contact is not None:
        at = contact.sel(torque=contact.attrs["pinion_torque"], method="nearest")
        pressure = float(at["pressure_max"].max())
    return [
        Number(
            "power lost in the mesh",
            nan if point is None else float(point["loss"].sum()),
            "W",
            band=None if point is None else loss_band(point),
        ),
        Number(
            "efficiency of the mesh",
            nan if point is None else 100.0 * float(point["efficiency"]),
            "%",
            4,
            band=None if point is None else efficiency_band(point),
        ),
        Number(
            "mean coefficient of friction",
            nan if film is None else float(film.attrs["operating_mean_coefficient"]),
        ),
        Number("dynamic transmission error in operation", own[0] if own else nan, "µm"),
        Number(
            "number of the largest mesh order, in operation", own.order if own else nan, digits=1
        ),
        Number("largest dynamic transmission error in the sweep", peak[0] if peak else nan, "µm"),
        Number(
            "number of the largest mesh order, in the sweep", peak.order if peak else nan, digits=1
        ),
        Number(
            "speed of the largest mesh order, in the sweep", peak.speed if peak else nan, "rpm", 4
        ),
        Number("mean mesh stiffness", nan if at is None else 1e-6 * float(at["K"].mean()), "N/µm"),
        Number(
            "loaded transmission error, peak to peak",
            nan if at is None else 1e6 * float(at["transmission_error_ptp"]),
            "µm",
        ),
        Number("highest pressure", 1e-9 * pressure if pressure < EDGE_PRESSURE else nan, "GPa"),
        Number(
            "longest time without contact",
            nan if separation is None else 100.0 * float(separation["separation_share"].max()),
            "%",
        ),
        Number(
            "least unstable factor on the swing of the stiffness",
            nan if stability is None else least_unstable(stability),
        ),
    ]
