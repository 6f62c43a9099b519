"""The report of a helical pair: findings, figures, table, inputs, limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from gearlube.report.file_inputs import file_inputs
from gearlube.report.page import write_report
from gearlube.report.parts import ASSUMED, Cell, Column, Figure, Input, Report, Table
from gearlube.report.pictures import pictured
from gearlube.studies.helical.figures.catalogue import HELICAL_CATALOGUE
from gearlube.studies.helical.figures.charts import (
    error_orders_chart,
    harris_chart,
    separation_chart,
)
from gearlube.studies.helical.figures.layout import distinct
from gearlube.studies.helical.findings import ORDERS, findings, numbers
from gearlube.studies.helical.results import HelicalResults
from gearlube.studies.helical.settings import RPM
from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE

_LIMITS = (
    "Response and sweep are linear with a stiffness that varies over the mesh: they are valid "
    "while the teeth stay in contact. For separating teeth see tooth separation.",
    "Supports are springs at the bearings; shafts and housing are rigid.",
    "Loads of film and losses are static. The losses do not include bearings, seals, churning and "
    "windage.",
    "Pressures are those of an elastic half-space on cells; at sharp edges they have no finite "
    "value.",
)
_CHARTS = {"harris_map": ("contact", harris_chart), "separation": ("separation", separation_chart)}


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
        findings=findings(found),
        numbers=numbers(found),
        figures=[*first, *pictured(HELICAL_CATALOGUE, figures, charts)],
        tables=[_critical_speeds(results)] if "sweep" in found else [],
        inputs=[*_operation(results), *file_inputs(settings.file)],
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
        chart=error_orders_chart(results.datasets["sweep"]),
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


def _operation(results: HelicalResults) -> list[Input]:
    settings = results.settings
    mu = np.asarray(settings.mu)
    return [
        Input("pinion torque", f"{settings.pinion_torque:.5g}", "N·m"),
        Input("pinion speed", f"{settings.pinion_speed / RPM:.5g}", "rpm"),
        Input("coefficients of friction", f"{mu.min():g} to {mu.max():g}"),
        Input("stiffness of the mesh", settings.mesh),
        Input("oil", settings.film().oil.name),
        Input("film of the oil", settings.film().film),
        *(Input("film model", one.words) for one in settings.film().film_models.values()),
        Input("oil temperature", f"{settings.oil_temperature - 273.15:.4g}", "°C"),
        Input(
            "composite roughness",
            f"{1e6 * settings.roughness_rms:.3g}",
            "µm",
            ASSUMED,
            "default 0.5 µm unless --roughness-um is given",
        ),
    ]
