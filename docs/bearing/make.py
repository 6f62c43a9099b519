"""Put numbers into docs/bearing.md and draw its figure: python -m docs.bearing.make. A minute."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq
from scipy.stats import chi2, norm

from docs.film_model.make import domain_rows
from docs.page import DOCS, IMAGES, Page
from gearlube.plotting.style import GREY, SERIES, house_style, new_figure
from gearlube.studies.bearing.figures import LAW_NAMES
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.geometry import BearingGeometry, Rib
from gearlube_core.bearings.losses.laws import DEFAULT_LAW, zhou_hoeprich_force
from gearlube_core.bearings.losses.loss import UNCALIBRATED, BearingLoss, LossModel, bearing_loss
from gearlube_core.bearings.losses.race_rolling import ROLLER_MODEL
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
from gearlube_core.film_model.model import FilmModel
from gearlube_core.input_file.table import read_table
from gearlube_core.oil.film_oil_data import film_oil_of
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

FILE = BearingFile.named("wingertszahn_2023")
OIL = Lubricant.named("fva_3")
AXIAL = 6000.0  # N
MEASURED = DOCS / "measured"  # tables and their sources
LAWS = (
    "zhou_hoeprich",
    "palmgren",
    "aihara",
    "goksem_hargreaves",
    "skf",
    "biboulet_houpert",
    "solved_films",
)
# [manjunath_2023]: rollers 6.846 to 6.131 mm thick, whose apex gives the pitch diameter; no data of
# the rib
BEARING_32008 = BearingGeometry(
    bore_diameter=40e-3,
    outside_diameter=68e-3,
    pitch_diameter=54.35e-3,
    roller_diameter=6.4885e-3,
    roller_length=13.66e-3,
    n_rollers=23,
    outer_angle=math.radians(14.17),
    inner_angle=math.radians(11.17),
    rib=Rib(contact_height=0.15 * 6.4885e-3),
    series="320X",
)
HEIGHTS = (2.0, 2.5, 3.0)  # mm, of the rib contact


class Point(NamedTuple):
    """One measured point."""

    degc: float
    radial: float
    rpm: int
    torque: float


POINTS = tuple(
    Point(
        row.number("temperature_degc"),
        row.number("radial_load_n"),
        row.whole("speed_rpm", 0, 9999),
        row.number("friction_torque_n_m"),
    )
    for row in read_table(MEASURED / "bearing_32216.csv")
)


def loss(point: Point, geometry: Any = None, **model: Any) -> BearingLoss:
    """Return the loss of the bearing at a measured point."""
    return bearing_loss(
        geometry or FILE.geometry(),
        OIL,
        LossModel(**({"law": "zhou_hoeprich"} | model)),
        speed=rpm_to_rads(point.rpm),
        axial_load=AXIAL,
        radial_load=point.radial,
        temperature=celsius_to_kelvin(point.degc),
    )


def ratios(law: str) -> np.ndarray:
    """Return computed over measured torque at every point."""
    return np.array([loss(point, law=law).torque / point.torque for point in POINTS])


class Read(NamedTuple):
    """A torque of the second bearing [N m], as two others read it from one figure."""

    degc: float
    rpm: float
    readings: tuple[float, float]

    @property
    def torque(self) -> float:
        """Return the geometric mean of both readings [N m]."""
        return math.sqrt(math.prod(self.readings))

    def computed(self, law: str) -> float:
        """Return the torque by a law [N m]."""
        return bearing_loss(
            BEARING_32008,
            Lubricant.named("fva_3a"),
            LossModel(law=law),
            speed=rpm_to_rads(self.rpm),
            axial_load=12850.0,
            radial_load=0.0,
            temperature=celsius_to_kelvin(self.degc),
        ).torque


POINTS_32008 = tuple(
    Read(
        row.number("temperature_degc"),
        row.number("speed_rpm"),
        (row.number("reading_1_n_m"), row.number("reading_2_n_m")),
    )
    for row in read_table(MEASURED / "bearing_32008.csv")
)


def ratios_32008(law: str) -> np.ndarray:
    """Return computed over measured torque of the second bearing, the mean of both readings."""
    return np.array([point.computed(law) / point.torque for point in POINTS_32008])


def wanted_factor(law: str) -> float:
    """Return the factor that holds 95 % of torques, with 95 % confidence.

    exp(1.96 s (n/chi2_0.05(n))^(1/2)), s the rms of the logarithms of n points, which count half:
    points of one bearing share their error.
    """
    logs = np.log(np.concatenate([ratios(law), ratios_32008(law)]))
    count = 0.5 * logs.size
    spread = math.sqrt(np.mean(logs**2) * count / chi2.ppf(0.05, count))
    return math.exp(norm.ppf(0.975) * spread)


def factors() -> list[list[str]]:
    """Return the rows of misfits and of the error bars that follow from them."""
    rows = []
    for law in sorted(LAWS, key=wanted_factor):
        found, other = ratios(law), ratios_32008(law)
        logs = np.log(found)
        rows.append([
            LAW_NAMES[law], f"{found.min():.2f} to {found.max():.2f}",
            f"{math.exp(logs.mean()):.2f}", f"{100 * _rms(found):.0f} %",
            f"{100 * float(np.std(logs)):.0f} %", f"{other.min():.2f} to {other.max():.2f}",
            f"{wanted_factor(law):.2f}", f"{UNCALIBRATED[law]:g}",
        ])  # fmt: skip
    return rows


def _rms(found: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.log(found) ** 2)))


def parts() -> list[list[str]]:
    """Return the rows of parts of the default law, and of the rib with other heights."""
    rows = []
    for point in (POINTS[0], POINTS[2], POINTS[6], POINTS[10]):
        found = loss(point)
        ribs = []
        for height in HEIGHTS:
            geometry = FILE.geometry()
            rib = replace(geometry.rib, contact_height=1e-3 * height)
            ribs.append(f"{loss(point, replace(geometry, rib=rib)).parts['rib']:.3f}")
        rows.append([
            f"{point.degc:g} °C, {point.radial:g} N, {point.rpm} rpm",
            *(f"{found.parts[one]:.3f}" for one in ("rolling", "rib", "drag", "hysteresis")),
            f"{found.film_ratio:.1f}", f"{found.rib_film_ratio:.1f}", f"{found.rib_friction:.4f}",
            " / ".join(ribs),
        ])  # fmt: skip
    return rows


def needed(page: Page) -> None:
    """Put in what flooded films would need to give the measured torques: layer or warmth."""
    layers = [1e6 * _root(point, "inlet_layer", 1e-8, 1e-3) for point in POINTS]
    rises = [_root(point, "temperature_rise", 0.0, 60.0) for point in POINTS]
    page.fill(
        "`--inlet-layer-um`: {} of oil on both",
        f"{min(layers):.0f} to {max(layers):.0f} µm",
    )
    page.fill(
        "oil hotter than the outer ring by {} (`--temperature-rise`)",
        f"{min(rises):.0f} to {max(rises):.0f} K",
    )


def _root(point: Point, name: str, low: float, high: float) -> float:
    def excess(value: float) -> float:
        changed: dict[str, Any] = {name: value}
        return loss(point, law="biboulet_houpert", **changed).torque - point.torque

    return float(brentq(excess, low, high, xtol=1e-9 if high < 1.0 else 1e-3))


def solved() -> list[list[str]]:
    """Return the rows of solved films against the laws, at the outer race."""
    p = FILE.geometry().parameters()
    oil = film_oil_of(OIL, celsius_to_kelvin(50.0), newtonian=True)
    load = AXIAL / (p.n_rollers * math.sin(FILE.geometry().outer_angle)) / p.length
    alpha = lubricant_state(OIL.parameters(), celsius_to_kelvin(50.0)).alpha
    rows = []
    for rpm in (500, 2000, 4000):
        u = p.mean_ratio * rpm_to_rads(rpm)
        line = LineProblem(
            lubricant=oil,
            radius=p.R_outer,
            line_load=load,
            reduced_modulus=p.reduced_modulus,
            speed_1=u,
            speed_2=u,
        )
        film = solve_line(line, LineSettings(nodes=2401))
        slope = np.gradient(film.pressure, film.x)
        force = 0.5 * float(np.trapezoid(film.film * slope, film.x))
        lost = float(np.trapezoid(film.film**3 * slope**2 / (12.0 * film.viscosity), film.x))
        at = (p.R_outer, load, p.reduced_modulus, oil.eta0, alpha, u)
        rows.append([
            str(rpm), f"{force:.0f}", f"{lost / (force * u):.2f}",
            *(_law(law, at, force) for law in (biboulet_houpert_force, zhou_hoeprich_force)),
        ])  # fmt: skip
    return rows


def _law(law: Callable[..., tuple[float, int]], at: tuple[float, ...], force: float) -> str:
    found = law(*at)[0]
    return f"{found:.0f} ({100 * (found / force - 1):+.0f} %)"


def film_model(page: Page) -> None:
    """Put in errors, domain and making of the film model of rollers."""
    model = FilmModel.named(ROLLER_MODEL)
    p = model.provenance
    rows = []
    bounds = (100.0 * model.film_bound, 100.0 * model.friction_bound)
    for words, key in (
        ("what the bearings visit", "errors_fresh_bearing"),
        ("anywhere in the domain", "errors_box"),
    ):
        found = p[key]
        for name, short, bound in zip(
            ("central film", "rolling force"), ("film", "friction"), bounds, strict=True
        ):
            rows.append([
                words, str(found["contacts"]), name, f"{found[f'{short}_rms_percent']:.2f}",
                f"{found[f'{short}_max_percent']:.2f}", f"{bound:.2f}",
            ])  # fmt: skip
    page.rows("contacts | number | quantity", rows)
    page.rows("quantity | least | most", domain_rows(model))
    solves, over, rest = p["solves"], p["bounds"]["fresh_violations"], p["grid_error_left_percent"]
    page.fill(
        "- {} contacts for training and {} of the domain for the bounds; {} that the shipped "
        "bearings visit for the test, of which {} exceed the bounds of film and force. "
        "{} solutions failed.",
        solves["box"] + solves["edge"] + solves["bearing"],
        solves["calibration"],
        solves["fresh"],
        f"{over[0]} and {over[1]}",
        p["failed"],
    )
    page.fill(
        "513 nodes. {} contacts on 1025 nodes lead to the limit of fine grids; what that misses is "
        "{} % rms of the film and {} % of the force.",
        p["fine_solves"],
        f"{rest[0]:.2f}",
        f"{rest[1]:.2f}",
    )


def picture() -> Any:
    """Return the figure: measured torques with every law and the error bar of the default."""
    groups = ((50.0, 0.0), (50.0, 6500.0), (42.0, 6500.0))
    speeds = np.linspace(100.0, 4200.0, 42)
    with house_style():
        figure = new_figure(11.5, 4.4)
        for ax, (degc, radial) in zip(figure.subplots(1, 3, sharey=True), groups, strict=True):
            for i, law in enumerate(LAWS):
                curve = [loss(Point(degc, radial, rpm, 1.0), law=law) for rpm in speeds]
                torque = np.array([one.torque for one in curve])
                if law == DEFAULT_LAW:
                    factor = curve[0].factor
                    ends = torque / factor, torque * factor
                    words = "error bar of the default law (95 %)"
                    ax.fill_between(speeds, *ends, color=GREY, alpha=0.35, lw=0.0, label=words)
                look = {"color": SERIES[i]} if i < len(SERIES) else {"color": "black", "ls": "--"}
                ax.plot(speeds, torque, label=LAW_NAMES[law], **look)
            here = [point for point in POINTS if (point.degc, point.radial) == (degc, radial)]
            ax.errorbar(
                [point.rpm for point in here], [point.torque for point in here], yerr=0.1,
                fmt="o", color="black", capsize=2.5, label="measured", zorder=5,
            )  # fmt: skip
            ax.set(
                xlabel="shaft speed [rpm]",
                title=f"6 kN axial, {1e-3 * radial:g} kN radial, {degc:g} °C",
            )
        figure.axes[0].set_ylabel("friction torque [N·m]")
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=4, loc="outside lower center")
    return figure


def measured(page: Page) -> None:
    """Put in what the laws give for the measured bearings."""
    page.rows("law | 32216", factors())
    page.rows("point | rolling", parts())
    best, second = sorted(LAWS, key=lambda one: _rms(ratios(one)))[:2]
    page.fill(
        "On the bearing 32216 {} predicts best (rms misfit {}), {} second ({}).",
        LAW_NAMES[best],
        f"{100 * _rms(ratios(best)):.0f} %",
        LAW_NAMES[second],
        f"{100 * _rms(ratios(second)):.0f} %",
    )


def main() -> None:
    """Write the page and the figure."""
    page = Page("bearing")
    measured(page)
    page.rows("speed [rpm] | solved F", solved())
    film_model(page)
    needed(page)
    page.write()
    picture().savefig(IMAGES / "bearing_32216.png", dpi=110)


if __name__ == "__main__":
    main()
