"""The report of a helical pair: findings, figures, table, inputs, limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import Axis, Line, line_chart, mark_level
from gearlube.report.inputs import file_inputs, origin_of, remark_findings
from gearlube.report.page import write_report
from gearlube.report.parts import ASSUMED, GIVEN, Cell, Column, Figure, Input, Number, Report, Table
from gearlube.report.pictures import pictured
from gearlube.studies.helical.figures.catalogue import HELICAL_CATALOGUE
from gearlube.studies.helical.figures.layout import distinct
from gearlube.studies.helical.findings import (
    ORDERS,
    Datasets,
    findings,
    largest_error,
    least_unstable,
    operating_error,
    order_amplitudes,
)
from gearlube.studies.helical.settings import RPM
from gearlube.studies.helical.stages import HelicalResults
from gearlube.studies.helical.summary import loss_model, losses_rows
from gearlube_core.dynamics.helical_pair.gear_file_pair import USUAL_OIL, gear_file_oil
from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE

_ORDERS = 5
_SPEED = Axis("pinion speed", "rpm")
_DEFAULT = ASSUMED, "default"
_LIMITS = (
    "Response and sweep are linear with a stiffness that varies over the mesh: they are valid "
    "while the teeth stay in contact. For separating teeth see tooth separation.",
    "Supports are springs at the bearings; shafts and housing are rigid.",
    "Loads of film and losses are static. The losses do not include bearings, seals, churning and "
    "windage.",
    "Pressures are those of an elastic half-space on cells; at sharp edges they have no finite "
    "value.",
)


def _harris_chart(contact: xr.Dataset) -> Any:
    """Return range and mesh orders of the loaded transmission error over torque."""
    torque = contact["torque"].values
    error = 1e6 * contact["transmission_error"].transpose("phase", "torque").values
    orders = 2.0 * np.abs(np.fft.rfft(error, axis=0)) / error.shape[0]
    lines = [Line(name="peak to peak", x=torque, y=np.ptp(error, axis=0))]
    lines += [
        Line(name=f"order {order}", x=torque, y=orders[order])
        for order in range(1, min(4, orders.shape[0] - 1))
    ]
    chart = line_chart(lines, Axis("pinion torque", "N·m"), Axis("loaded transmission error", "µm"))
    mark_level(chart, float(contact.attrs["pinion_torque"]), "operating point", across=False)
    return chart


def _separation_chart(separation: xr.Dataset) -> Any:
    """Return the transmission error over speed with teeth that can separate, and without."""
    lines = []
    for group, ratio in enumerate(separation["damping"].values):
        part = separation.sel(damping=ratio)
        for number in range(2):
            rows = np.flatnonzero(part["segment"].values == number)
            if rows.size:
                lines.append(
                    Line(
                        name=f"can separate, damping {ratio:g}",
                        x=part["speed"].values[rows] / RPM,
                        y=1e6 * part["peak_to_peak"].values[rows],
                        group=group,
                    )
                )
        lines.append(
            Line(
                name=f"always in contact, damping {ratio:g}",
                x=separation["linear_speed"].values / RPM,
                y=1e6 * part["linear_peak_to_peak"].values,
                group=group,
                dash=2,
            )
        )
    chart = line_chart(lines, _SPEED, Axis("transmission error, peak to peak", "µm", log=True))
    chart.update_xaxes(exponentformat="none")
    return chart


_CHARTS = {
    "harris_map": ("contact", _harris_chart),
    "separation": ("separation", _separation_chart),
}


def write_helical_report(results: HelicalResults, folder: Path) -> Path:
    """Write report.html beside the figures that lie in FOLDER/figures; return its path."""
    return write_report(helical_report(results, folder / "figures"), folder)


def helical_report(results: HelicalResults, figures: Path) -> Report:
    """Return the report of a study; `figures` is the folder of its pictures."""
    found, settings = results.datasets, results.settings
    charts: dict[str, Any] = {
        name: draw(found[needed]) for name, (needed, draw) in _CHARTS.items() if needed in found
    }
    first = [_error_orders(results)] if "sweep" in found else []
    attributes = next(iter(found.values())).attrs if found else {}
    return Report(
        study="helical",
        title=f"Helical pair {settings.file.name}",
        subtitle=f"{settings.file.pinion.teeth} and {settings.file.gear.teeth} teeth, "
        f"{settings.pinion_torque:.4g} N·m and {settings.pinion_speed / RPM:.5g} rpm on the "
        "pinion.",
        findings=[*remark_findings(attributes), *findings(found)],
        numbers=numbers(found),
        figures=[*first, *pictured(HELICAL_CATALOGUE, figures, charts)],
        tables=[
            *([_critical_speeds(results)] if "sweep" in found else []),
            *([_losses(found["losses"])] if "losses" in found else []),
        ],
        inputs=_inputs(results),
        limits=[*_LIMITS, *(f"{name} failed: {why}" for name, why in results.failures.items())],
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
    bars = "loss_torque_low" in losses
    names = ["loss_torque", *(f"loss_torque_{end}" for end in ("low", "high") if bars)]
    return Table(
        title="Losses of the pair",
        columns=[
            Column("oil", "°C"),
            Column("torque", "N·m", 4),
            Column("speed", "rpm", 4),
            *(Column(name.replace("_", " "), "N·m") for name in names),
            Column("sliding", "W"),
            Column("rolling", "W"),
            Column("sliding by"),
        ],
        rows=[
            [
                *(float(one[name]) for name in ("temperature", "torque", "speed", *names)),
                *(float(power) for power in one["loss"].values),
                loss_model(one),
            ]
            for one in losses_rows(losses)
        ],
        caption="Some points; losses.csv has all. Low and high: between them lie 95 % of the draws "
        "of the uncertain data, by the model of the point.",
    )


def _inputs(results: HelicalResults) -> list[Input]:
    """Return what was used; a section [oil] of the gear file only where its oil was taken."""
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
    found = [
        Number("dynamic transmission error in operation", own[0] if own else nan, "µm"),
        Number("its mesh order", own.order if own else nan, digits=1),
        Number("largest dynamic transmission error in the sweep", peak[0] if peak else nan, "µm"),
        Number("its mesh order there", peak.order if peak else nan, digits=1),
        Number("its speed", peak.speed if peak else nan, "rpm", 4),
    ]
    contact, film = datasets.get("contact"), datasets.get("film")
    at = None
    if contact is not None:
        at = contact.sel(torque=contact.attrs["pinion_torque"], method="nearest")
    found += [
        Number("mean mesh stiffness", nan if at is None else 1e-6 * float(at["K"].mean()), "N/µm"),
        Number(
            "loaded transmission error, peak to peak",
            nan if at is None else 1e6 * float(at["transmission_error_ptp"]),
            "µm",
        ),
        Number(
            "highest pressure", nan if at is None else 1e-9 * float(at["pressure_max"].max()), "GPa"
        ),
    ]
    separation, stability = datasets.get("separation"), datasets.get("stability")
    return [
        *found,
        Number(
            "longest time without contact",
            nan if separation is None else 100.0 * float(separation["separation_share"].max()),
            "%",
        ),
        Number(
            "least unstable factor on the swing of the stiffness",
            nan if stability is None else least_unstable(stability),
        ),
        Number(
            "mean coefficient of friction",
            nan if film is None else float(film.attrs["operating_mean_coefficient"]),
        ),
        Number(
            "power lost in the mesh",
            nan if film is None else float(film.attrs["operating_power_loss"]),
            "W",
        ),
    ]
