"""The main curves of a helical pair as charts of a report."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import Axis, Line, line_chart, mark_level
from gearlube.studies.helical.figures.layout import distinct
from gearlube.studies.helical.findings import order_amplitudes
from gearlube.studies.helical.settings import RPM

_ORDERS = 5
_SPEED = Axis("pinion speed", "rpm")


def error_orders_chart(sweep: xr.Dataset) -> Any:
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


def harris_chart(contact: xr.Dataset) -> Any:
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


def separation_chart(separation: xr.Dataset) -> Any:
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
