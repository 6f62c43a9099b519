"""Losses of the shipped axles against published ranges: python -m docs.loss_map.claims.

A minute. Puts four tables into docs/loss_map.md. Over cycles it takes the numbers of
docs/drive_cycle.
"""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from docs.page import ROOT, Page
from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.axle_file.read_axle import read_axle
from gearlube.studies.loss_map.report import no_load_table
from gearlube.studies.loss_map.run import run_loss_map
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.arrays import Array
from gearlube_core.drag import seal_torque
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.units import celsius_to_kelvin, kmh_to_ms, rpm_to_rads
from tests.helpers.fzg_gears import friction as fzg_friction

CYCLES = ROOT / "docs" / "drive_cycle" / "numbers.csv"
SHARE = "zhou_hoeprich_1991"  # of `friction`
_MIXED_DEGC = (40.0, 80.0, 120.0)
_ROUNDING = 0.05  # points


def losses(car: CarAxle, torques: Array, speeds: Array, degc: Array) -> Array:
    """Return losses by source [W], (temperatures, speeds, torques, sources)."""
    found = axle_losses(
        car.axle,
        torques=np.atleast_1d(torques),
        speeds=np.atleast_1d(speeds),
        temperatures=np.array([celsius_to_kelvin(float(t)) for t in np.atleast_1d(degc)]),
        extremes=False,
    )
    return found.power


def cruise(car: CarAxle, kmh: float, watts: float, degc: float) -> dict[str, float]:
    """Return loss [%] of the power at the pinion, by source, at a vehicle speed."""
    road = car.driveline.road_load
    speed = kmh_to_ms(kmh) / road.tyre.rolling_radius * road.final_drive.ratio
    lost = losses(car, watts / speed, speed, degc)[0, 0, 0]
    return dict(zip(LOSS_SOURCES, (100.0 * lost / watts).tolist(), strict=True))


def wltc(name: str) -> float:
    """Return the efficiency [%] over the WLTC from a cold start, of docs/drive_cycle."""
    with CYCLES.open() as file:
        rows = list(csv.DictReader(file))
    return next(
        float(row["value"])
        for row in rows
        if (row["axle"], row["cycle"], row["quantity"]) == (name, "wltc", "efficiency")
    )


def share(car: CarAxle, pick: Callable[[Array], float], degc: Array) -> float:
    """Return a pick of the loss over the input [%], 20 N.m to the mesh table's end in drive."""
    torques = np.linspace(20.0, car.axle.torque_range[1], 12)
    speeds = np.linspace(30.0, 520.0, 8)
    lost = losses(car, torques, speeds, degc).sum(axis=-1)
    return 100.0 * pick(lost / (speeds[:, None] * torques))


def _text(values: list[float], unit: str = " %") -> list[str]:
    return [f"{value:.3g}{unit}" for value in values]


def _held(*good: bool, otherwise: str = "not held") -> str:
    return "held" if all(good) else otherwise


def _within(values: list[float], low: float, high: float) -> list[str]:
    """Return shares [%], and whether they lie within a range."""
    off = [min(value - low, 0.0) + max(value - high, 0.0) for value in values]
    off = [one if abs(one) >= _ROUNDING else 0.0 for one in off]
    words = " and ".join(f"{one:+.1f}" if one else "within" for one in off)
    return [*_text(values), f"not held: {words} points" if any(off) else "held"]


def statements(cars: list[CarAxle]) -> list[list[str]]:
    """Return what both axles have and the verdict, in the order of the table."""
    shared = [replace(car, axle=replace(car.axle, friction=SHARE)) for car in cars]

    def efficiency(some: list[CarAxle], degc: float) -> list[float]:
        return [100.0 - sum(cruise(car, 100.0, 15e3, degc).values()) for car in some]

    rows = [
        _within(values, 95.0, 97.0)
        for values in (
            efficiency(cars, 80.0),
            efficiency(cars, 40.0),
            efficiency(shared, 80.0),
            [wltc("paper"), wltc("van")],
        )
    ]
    least = [share(car, np.min, np.array([40.0, 60.0, 80.0, 100.0])) for car in cars]
    below = f"not held: {6.0 / min(least):.1f} times below"
    rows.append([*_text(least), _held(min(least) >= 6.0, otherwise=below)])
    cold = [share(car, np.max, np.array([20.0])) for car in cars]
    both = "reached by both" if min(cold) >= 40.0 else "not reached by both"
    rows.append([*_text(cold), both])
    powers = []
    for car in cars:
        lost = losses(car, 30.0, np.array([50.0, 400.0]), 20.0)[0, :, 0].sum(axis=-1)
        powers.append(float(np.log(lost[1] / lost[0]) / np.log(8.0)))
    linear = (abs(one - 1.0) <= 0.2 for one in powers)
    rows.append([*_text(powers, ""), _held(*linear, otherwise="not held: steeper")])
    return rows


def mixed(cars: list[CarAxle]) -> list[list[str]]:
    """Return rows for the flanks' loss over oil temperature by laws of the asperities' load."""
    rows = []
    sources = [LOSS_SOURCES.index(one) for one in ("friction_viscous", "friction_boundary")]
    for car in cars:
        for law in ("consistent", "arana_2019", SHARE):
            made = replace(car, axle=replace(car.axle, friction=law))
            lost = losses(made, 300.0, 60.0, np.array(_MIXED_DEGC))[:, 0, 0, sources]
            totals = lost.sum(axis=-1)
            shares = 100.0 * lost[:, 1] / totals
            rows.append(
                [f"{total:.0f} ({part:.0f} %)" for total, part in zip(totals, shares, strict=True)]
            )
    return rows


def fzg() -> list[list[str]]:
    """Return rows for the mean friction coefficient of FZG gears by each law."""
    laws = ({"mu_b": None}, {"mu_b": 0.065}, {"mu_b": None, "rough": 1e-8})
    return [
        [
            " / ".join(
                f"{fzg_friction(speed, film=film, **law).mean_coefficient:.3f}"  # type: ignore[arg-type]
                for film in ("formula", "solved")
            )
            for speed in (0.5, 2.0, 8.3, 20.0)
        ]
        for law in laws
    ]


def idle(cars: list[CarAxle]) -> list[list[str]]:
    """Return rows for the parts of the torque without load; the last axle has wheel ends."""
    paper, van = (car.axle for car in cars)
    seal = partial(seal_torque, material="any", temperature=343.15, nu_40=175e-6)
    ends = {"pinion_seal_torque": seal(0.045), "wheel_seal_torque": 4.0 * seal(0.07)}
    columns = []
    for axle in (paper, van, replace(van, hub_torque=1.0, **ends)):
        settings = LossMapSettings(
            axle=axle,
            torques=np.array([0.0, 50.0]),
            speeds=rpm_to_rads(1.0) * np.array([500.0, 1500.0, 3000.0]),
            temperatures=np.array([343.15]),
            draws=0,
        )
        (table,) = no_load_table(run_loss_map(settings))
        columns.append([f"{row[1]:.2f}, {row[3]:.2f}" for row in table.rows])
    return [list(row) for row in zip(*columns, strict=True)]


def main() -> None:
    """Compute all statements; put them into the page."""
    cars = [read_axle("mohammadpour_2015"), read_axle(ROOT / "examples" / "my_axle.toml")]
    page = Page("loss_map")
    page.cells("what is said", statements(cars))
    page.cells("axle | `friction` | 40 °C", mixed(cars))
    page.cells("`friction` | 0.5 m/s", fzg(), first=1)
    page.cells("part | paper's axle", idle(cars), first=1)
    page.write()


if __name__ == "__main__":
    main()
