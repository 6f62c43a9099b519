"""The axle with flanks that their own friction warms: python -m docs.film_model.bulk.

Half a minute. Writes a table of docs/film_model_axle.md.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from docs.film_model.compare import axle_of
from docs.film_model.marked_page import put
from drivetrain.axle_file.read_axle import read_axle
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.units import celsius_to_kelvin, kmh_to_ms

RESISTANCES = (0.0, 0.02, 0.04)  # K/W
POINTS = ((40.0, 100.0, 95.0), (100.0, 50.0, 60.0), (100.0, 100.0, 95.0), (100.0, 300.0, 95.0))
STRESS = 2.0  # MPa


def point(film: str, resistance: float, at: tuple[float, float, float]) -> tuple[float, ...]:
    """Return rise of the bulk [K], efficiency of the mesh [%], least film ratio, flank loss [W]."""
    axle = replace(axle_of(film, STRESS), flank_bulk_resistance=resistance)
    speed, torque, degc = at
    pinion = read_axle("mohammadpour_2015").driveline.road_load.pinion_speed(kmh_to_ms(speed))
    oil = celsius_to_kelvin(degc)
    found = axle_losses(
        axle, torques=np.array([torque]), speeds=np.array([pinion]), temperatures=np.array([oil])
    )
    friction = float(found.power[0, 0, 0, :2].sum())
    return (
        float(found.bulk_temperature[0, 0, 0]) - oil,
        100.0 * (1.0 - friction / (pinion * torque)),
        float(found.film_ratio[0, 0, 0]),
        friction,
    )


def table() -> str:
    """Return the points as Markdown."""
    head = "".join(f" {one:g} K/W: rise [K] | efficiency [%] | least λ |" for one in RESISTANCES)
    lines = [f"| 2 MPa |{head}", "|---|" + "---|" * (3 * len(RESISTANCES))]
    for at in POINTS:
        for film in ("formula", "solved"):
            cells = []
            for resistance in RESISTANCES:
                rise, efficiency, ratio, _ = point(film, resistance, at)
                cells += [f"{rise:.0f}", f"{efficiency:.2f}", f"{ratio:.2f}"]
            speed, torque, degc = at
            name = f"{speed:g} km/h, {torque:g} N·m, {degc:g} °C: {film}"
            lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    put("bulk", "bulk", table())
