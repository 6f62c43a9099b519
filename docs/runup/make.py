"""Numbers and pictures of docs/runup.md: python -m docs.runup.make.

One run-up, and steady points that it is compared with; about four minutes on one core.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from docs.page import IMAGES, Page
from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.axle_file.read_axle import read_axle
from gearlube.studies.runup.animation.dataset import animate_ramp
from gearlube.studies.runup.figures.catalogue import CATALOGUE
from gearlube.studies.runup.figures.moving.parts import MOVING
from gearlube.studies.runup.findings import findings
from gearlube.studies.runup.run import run_runup
from gearlube.studies.runup.settings import RunupSettings
from gearlube.studies.sweep.axle_in_fmu import settings_of
from gearlube.studies.sweep.point import march
from gearlube_core.progress import no_progress
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

OIL = celsius_to_kelvin(80.0)
TORQUE = 80.0  # N.m
STEADY_KMH = (60.0, 100.0)
ORDERS = (1, 2, 3)
_DPI = 100
SHOWN = ("order_tracks", "waterfall", "campbell", "operating_shape")


def main() -> None:
    """Run, draw and write."""
    car = read_axle("mohammadpour_2015")
    settings = RunupSettings(
        car_axle=car,
        start_speed=rpm_to_rads(600.0),
        end_speed=rpm_to_rads(4000.0),
        duration=20.0,
        pinion_torque=TORQUE,
        oil_temperature=OIL,
    )
    ramp = run_runup(settings)
    page = Page("runup")
    for entry in CATALOGUE:
        if entry.name in SHOWN:
            entry.draw(ramp).savefig(IMAGES / f"runup_{entry.name}.png", dpi=_DPI)
            page.paragraph(f"](images/runup_{entry.name}.png)", entry.caption)
    moving = animate_ramp(settings, ramp)
    for one in MOVING:
        one.animate(moving, IMAGES / f"runup_{one.name}.gif", no_progress)
    page.fill(
        "mesh orders 1 to 3 of the transmission error | within {} % at 60 km/h, {} % at 100 km/h |",
        *(f"{steady_off(car, speed):.2f}" for speed in STEADY_KMH),
    )
    page.fill(
        "80 °C, preload {} N. Findings of the report:", f"{ramp.attrs['bearing_preload']:.0f}"
    )
    found = (f"- **{one.headline}** {one.detail}".rstrip() for one in findings(ramp)[:4])
    page.paragraph("Findings of the report:", "\n".join(found))
    page.write()


def steady_off(car: CarAxle, speed_kmh: float) -> float:
    """Return how far a ramp through a steady point of the sweep is from it [%]."""
    settings = settings_of(car.axle, driver="hold", oil_temperature=OIL, record_time=0.6)
    steady = march(car, speed_kmh, settings)
    speed = float(steady["pinion_speed"])
    ramp = run_runup(
        RunupSettings(
            car_axle=car,
            start_speed=speed - 6.0,
            end_speed=speed + 6.0,
            duration=4.0,
            pinion_torque=float(steady["pinion_torque"]),
            oil_temperature=OIL,
        )
    )
    return 100.0 * max(abs(ratio - 1.0) for ratio in ratios(steady, ramp, speed))


def ratios(steady: xr.Dataset, ramp: xr.Dataset, speed: float) -> list[float]:
    """Return amplitudes of the ramp over those of the steady point at the mesh orders."""
    teeth = int(ramp.attrs["pinion_teeth"])
    block = int(np.argmin(np.abs(ramp["block_speed"].values - speed)))
    order = steady["order"].values
    return [
        float(ramp["dte_track"].values[block, m - 1])
        / float(steady["dte_spectrum"].values[int(np.argmin(np.abs(order - teeth * m)))])
        for m in ORDERS
    ]


if __name__ == "__main__":
    main()
