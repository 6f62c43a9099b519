"""The shipped axle, films by formula and solved: python -m docs.film_model.compare.

About five minutes. Writes docs/film_model/axle.csv, the figure docs/images/film_model_axle.png and
tables of docs/film_model_axle.md.
"""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from docs.page import IMAGES, Page
from drivetrain.axle_file.read_axle import read_axle
from gearlube.plotting.style import BLUE, GREEN, VERMILLION, house_style, new_figure
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.film_model.model import FilmModel
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.units import celsius_to_kelvin, kmh_to_ms

TABLE = Path(__file__).with_name("axle.csv")
FIGURE = IMAGES / "film_model_axle.png"
SPEEDS = np.array([20.0, 40.0, 60.0, 80.0, 100.0])  # km/h
TORQUES = np.array([10.0, 20.0, 50.0, 100.0, 200.0, 400.0])  # N.m
DEGC = np.array([40.0, 60.0, 80.0, 95.0, 120.0])
MEGA = 1e6
# name, film, Eyring stress [MPa], colour, line
CASES = (
    ("formula, 2 MPa", "formula", 2.0, BLUE, "-"),
    ("formula, 5 MPa", "formula", 5.0, BLUE, "--"),
    ("solved, 2 MPa", "solved", 2.0, VERMILLION, "-"),
    ("solved, 5 MPa", "solved", 5.0, VERMILLION, "--"),
)
# flanks warmer than the oil by a resistance [K/W]; points of speed [km/h], torque [N.m], oil [degC]
BULK_RESISTANCES, BULK_STRESS = (0.0, 0.02, 0.04), 2.0
BULK_POINTS = ((100.0, 300.0, 95.0),)
HEAD = (
    "case", "oil_degc", "speed_km_h", "torque_n_m", "mesh_efficiency_percent", "bound_percent",
    "friction_w", "boundary_w", "least_film_um", "least_film_ratio", "share_outside_percent",
)  # fmt: skip


def axle_of(film: str, stress: float) -> HypoidAxleParameters:
    """Return the shipped axle with a film and an Eyring stress [MPa]."""
    axle = read_axle("mohammadpour_2015").axle
    return replace(axle, film=film, oil=replace(axle.oil, eyring_stress=stress * MEGA))


def found(
    axle: HypoidAxleParameters, torques: Array, pinion: Array, degc: Array
) -> dict[str, Array]:
    """Return the quantities of `HEAD` over (temperature, speed, torque)."""
    losses = axle_losses(
        axle,
        torques=torques,
        speeds=pinion,
        temperatures=np.array([celsius_to_kelvin(float(one)) for one in degc]),
    )
    put_in = pinion[:, None] * torques
    friction = losses.power[..., 0] + losses.power[..., 1]
    sigma = axle.roughness_rms
    return {
        "mesh_efficiency_percent": 100.0 * (1.0 - friction / put_in),
        "bound_percent": 100.0 * losses.friction_bound / put_in,
        "friction_w": friction,
        "boundary_w": losses.power[..., 1],
        "least_film_um": losses.film_ratio * sigma * 1e6,
        "least_film_ratio": losses.film_ratio,
        "share_outside_percent": 100.0 * losses.share_outside,
    }


def over_the_range() -> dict[str, dict[str, Array]]:
    """Return all cases over speed, torque and temperature."""
    road = read_axle("mohammadpour_2015").driveline.road_load
    pinion = np.array([road.pinion_speed(kmh_to_ms(speed)) for speed in SPEEDS])
    return {
        name: found(axle_of(film, stress), TORQUES, pinion, DEGC)
        for name, film, stress, _, _ in CASES
    }


def on_the_road() -> dict[str, dict[str, Array]]:
    """Return all cases at the speeds and road loads of the paper, 95 degC; arrays over speed."""
    road = read_axle("mohammadpour_2015").driveline.road_load
    at = {}
    for name, film, stress, _, _ in CASES:
        points = [
            found(
                axle_of(film, stress),
                np.array([road.pinion_torque(kmh_to_ms(speed))]),
                np.array([road.pinion_speed(kmh_to_ms(speed))]),
                np.array([95.0]),
            )
            for speed in SPEEDS
        ]
        at[name] = {key: np.array([one[key][0, 0, 0] for one in points]) for key in points[0]}
    return at


def as_csv(cases: dict[str, dict[str, Array]]) -> str:
    """Return the table of all points."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEAD)
    for name, values in cases.items():
        for i, degc in enumerate(DEGC):
            for j, speed in enumerate(SPEEDS):
                for k, torque in enumerate(TORQUES):
                    row = [f"{values[key][i, j, k]:.5g}" for key in HEAD[4:]]
                    writer.writerow([name, f"{degc:g}", f"{speed:g}", f"{torque:g}", *row])
    return text.getvalue()


def figure(cases: dict[str, dict[str, Array]]) -> Any:
    """Return efficiency and film ratio over speed, torque and temperature through one point."""
    t, s, q = 3, 4, 3  # 95 degC, 100 km/h, 100 N.m
    axes_of = (
        ("vehicle speed [km/h]", SPEEDS, (t, slice(None), q)),
        ("pinion torque [N·m]", TORQUES, (t, s, slice(None))),
        ("oil temperature [°C]", DEGC, (slice(None), s, q)),
    )
    with house_style():
        made = new_figure(9.0, 6.2)
        grid = made.subplots(2, 3, sharey="row", sharex="col")
        for column, (label, x, place) in enumerate(axes_of):
            for name, _, _, colour, line in CASES:
                values = cases[name]
                y, bound = (
                    values[key][place] for key in ("mesh_efficiency_percent", "bound_percent")
                )
                grid[0, column].plot(x, y, line, color=colour, label=name.replace(", ", ", τ₀ = "))
                grid[0, column].fill_between(x, y - bound, y + bound, color=colour, alpha=0.2, lw=0)
                if name.endswith("2 MPa"):  # films hardly feel the Eyring stress
                    grid[1, column].plot(x, values["least_film_ratio"][place], line, color=colour)
            grid[1, column].axhline(1.0, color=GREEN, lw=1.0, ls=":")
            grid[1, column].set_xlabel(label)
        grid[0, 0].set_ylabel("efficiency of the mesh [%]")
        grid[1, 0].set_ylabel("least film ratio λ [-]\n(τ₀ = 2 MPa; τ₀ hardly matters)")
        grid[1, 0].annotate("film as thick as the roughness", (22.0, 1.02), fontsize=8, color=GREEN)
        grid[0, 0].set_title("100 N·m, 95 °C")
        grid[0, 1].set_title("100 km/h, 95 °C")
        grid[0, 2].set_title("100 km/h, 100 N·m")
        handles, labels = grid[0, 0].get_legend_handles_labels()
        made.legend(handles, labels, loc="outside upper center", ncol=4)
    return made


def range_rows(cases: dict[str, dict[str, Array]]) -> list[list[str]]:
    """Return ratios of formula to solved over the range, by share of points."""
    rows = []
    formula, solved = cases["formula, 2 MPa"], cases["solved, 2 MPa"]
    for key, words in (("friction_w", "friction loss"), ("boundary_w", "of it by asperities"),
                       ("least_film_um", "least film")):  # fmt: skip
        ratio = (formula[key] / solved[key])[solved["share_outside_percent"] < 1.0]
        cells = np.quantile(ratio, (0.0, 0.05, 0.5, 0.95, 1.0))
        rows.append([words, *(f"{one:.2f}" for one in cells)])
    return rows


def put_outside(page: Page, solved: dict[str, Array]) -> None:
    """Put in how many points lie outside the domain, and the bound of the loss."""
    outside = solved["share_outside_percent"]
    bound = solved["bound_percent"] / (100.0 - solved["mesh_efficiency_percent"]) * 100.0
    page.fill(
        "Of {} points {} have less than 1 % of their load outside the domain, {} more than half. "
        "The bound of the friction loss is {} % of it in the median, {} % or less at 95 % of the "
        "points.",
        outside.size,
        int(np.sum(outside < 1.0)),
        int(np.sum(outside > 50.0)),
        f"{np.median(bound):.1f}",
        f"{np.quantile(bound, 0.95):.0f}",
    )


def road_rows(road: dict[str, dict[str, Array]]) -> list[list[str]]:
    """Return efficiencies and films at the paper's points."""
    rows = []
    for name, values in road.items():
        y, bound = values["mesh_efficiency_percent"], values["bound_percent"]
        cells = [
            f"{a:.2f} ± {b:.2f}" if b > 0.0 else f"{a:.2f}" for a, b in zip(y, bound, strict=True)
        ]
        rows.append([f"{name}: efficiency of the mesh [%]", *cells, f"{np.ptp(y):.2f}"])
    for name in ("formula, 2 MPa", "solved, 2 MPa"):
        cells = [f"{one:.2f}" for one in road[name]["least_film_ratio"]]
        rows.append([f"{name}: least film ratio λ", *cells, ""])
    return rows


def warmed(film: str, resistance: float, at: tuple[float, float, float]) -> list[str]:
    """Return rise of the bulk [K], efficiency of the mesh [%] and least film ratio."""
    axle = replace(axle_of(film, BULK_STRESS), flank_bulk_resistance=resistance)
    speed, torque, degc = at
    pinion = read_axle("mohammadpour_2015").driveline.road_load.pinion_speed(kmh_to_ms(speed))
    oil = celsius_to_kelvin(degc)
    losses = axle_losses(
        axle, torques=np.array([torque]), speeds=np.array([pinion]), temperatures=np.array([oil])
    )
    friction = float(losses.power[0, 0, 0, :2].sum())
    return [
        f"{float(losses.bulk_temperature[0, 0, 0]) - oil:.0f}",
        f"{100.0 * (1.0 - friction / (pinion * torque)):.2f}",
        f"{float(losses.film_ratio[0, 0, 0]):.2f}",
    ]


def bulk_rows() -> list[list[str]]:
    """Return what flanks that their own friction warms do."""
    rows = []
    for at in BULK_POINTS:
        for film in ("formula", "solved"):
            cells = [cell for R in BULK_RESISTANCES for cell in warmed(film, R, at)]
            speed, torque, degc = at
            rows.append([f"{speed:g} km/h, {torque:g} N·m, {degc:g} °C: {film}", *cells])
    return rows


def main() -> None:
    """Compute all and write it."""
    cases, road, page = over_the_range(), on_the_road(), Page("film_model_axle")
    write_text(as_csv(cases), TABLE)
    figure(cases).savefig(FIGURE)
    model = FilmModel.named("hypoid_flank")
    page.fill(
        "Model `hypoid_flank`, checksum `{}`, state `{}`: bounds {} % of the film, {} % of the "
        "friction.",
        model.checksum,
        model.provenance.get("state"),
        f"{100.0 * model.film_bound:.2f}",
        f"{100.0 * model.friction_bound:.2f}",
    )
    page.rows("2 MPa, formula over solved", range_rows(cases))
    put_outside(page, cases["solved, 2 MPa"])
    page.rows("| 20 km/h |", road_rows(road))
    page.rows("2 MPa | 0 K/W", bulk_rows())
    page.write()


if __name__ == "__main__":
    main()
