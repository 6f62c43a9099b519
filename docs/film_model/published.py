"""Friction of solved films beside published levels: python -m docs.film_model.published.

Seconds; nothing is solved. Mean friction of a flank over the engagement, weighted with load times
sliding as lost power is, with asperities, at points of the shipped axle. Beside it stand Xu and
Kahraman 2007 and Schlenk (ISO/TR 14179-2), and which Eyring stress an oil would need to meet them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from docs.page import IMAGES, Page
from docs.published_friction import schlenk, xu_kahraman
from gearlube.plotting.style import BLUE, GREEN, ORANGE, PURPLE, VERMILLION, house_style, new_figure
from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.hertz import ellipticity
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.ehl.gears.hypoid_film import pair_contact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.friction.flank_data import contact_geometry
from gearlube_core.friction.flank_film import FlankEllipse, flank_film_model
from gearlube_core.friction.flank_laws import SOLVED, Consistent
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import LubricantState, lubricant_state
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY, ROELANDS_PRESSURE
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

FIGURE = IMAGES / "film_model_published.png"
MESH = shipped_mesh_table("mohammadpour_2015")
SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
NUMBERS = flank_film_model(FilmModel.named("hypoid_flank"))
SPEEDS = np.array([20.0, 40.0, 60.0, 80.0, 100.0])  # km/h
TORQUES = np.array([20.0, 50.0, 100.0, 200.0, 400.0])  # N.m
DEGC = np.array([60.0, 95.0])
_RPM_PER_KMH = 22.95
_PHASES = np.linspace(-1.5, 1.5, 61)
_LEAST_SHARE = 0.02  # of the load, of a phase that counts
MEGA = 1e6
LEAST, MOST, BEYOND = 1.0, 10.0, 12.0  # MPa: of the model's domain; where more is drawn
TWIN_DISC = 0.045  # about, mineral oils (Doleschel et al., DGMK)
_STEP = 1e-3  # of the logarithm of a load
_STAR = " *"
XU_KAHRAMAN, SCHLENK = FORMULAS = ("Xu and Kahraman", "Schlenk")
LEAST_LINE_LOAD = 150.0  # N/mm, of Schlenk's formula
SIGMA = 0.5e-6  # m, composite, of the shipped axle
# of an oil: share of mineral oil's friction in ISO/TR 14179-2
OILS = {
    "mohammadpour_2015": 1.0,
    "karagiannis_2012": 1.0,
    "fva_3": 1.0,
    "fva_3a": 1.0,
    "arana_2019_m100": 1.0,
    "arana_2019_pao100": 0.8,
}
# the one value of Karagiannis et al. 2012 is printed without a temperature; the library takes 40
OTHER_ALPHA = ("karagiannis_2012", 95.0)


class Contacts(NamedTuple):
    """A flank over its engagement; arrays over the loaded phases."""

    load: Array  # [N]
    R_x: Array  # [m]
    R_y: Array
    psi: Array  # entrainment from the minor axis [rad]
    delta: Array  # sliding from entrainment [rad]
    speed: Array  # [m/s]
    slip: Array


def contacts(speed_kmh: float, torque: float) -> Contacts:
    """Return the contacts of a pair at a vehicle speed and a pinion torque, under static load."""
    pinion = rpm_to_rads(_RPM_PER_KMH * speed_kmh)
    c = pair_contact(MESH, torque, _PHASES)
    held = c.share > _LEAST_SHARE
    load = abs(torque) / MESH.mean("R_p", torque) * c.share[held]
    u, v = pinion * c.entrainment[held].T
    s, t = pinion * c.sliding[held].T
    psi = np.arctan2(v, u)
    delta = np.arctan2(t, s) - psi
    delta -= math.pi * np.floor(delta / math.pi + 0.5)
    return Contacts(load, c.R_x[held], c.R_y[held], psi, delta, np.hypot(u, v), np.hypot(s, t))


def lubricant(oil: str) -> Lubricant:
    """Return an oil of the library; with " *": its pressure coefficient at `OTHER_ALPHA`."""
    found = Lubricant.named(oil.removesuffix(_STAR))
    if not oil.endswith(_STAR):
        return found
    return replace(found, alpha_temperature=celsius_to_kelvin(OTHER_ALPHA[1]))


def state(oil: str, degc: float, tau0: float | None) -> LubricantState:
    """Return an oil at a temperature with an Eyring stress [MPa]; None: its own."""
    found = lubricant_state(lubricant(oil).parameters(), celsius_to_kelvin(degc))
    return found if tau0 is None else found._replace(tau0=MEGA * tau0)


class Mean(NamedTuple):
    """Means over an engagement, weighted with load times sliding."""

    friction: float  # with asperities [-]
    film_friction: float  # of the film alone [-]
    outside: float  # share of the load outside the domain [-]


def solved_mean(c: Contacts, oil: LubricantState, film: int = SOLVED) -> Mean:
    """Return the mean friction of a flank by solved films, or by formulas."""
    law = Consistent()(gear_flanks(SIGMA), SOLID)._replace(film=float(film))
    rows = []
    for n in range(c.load.size):
        geometry = contact_geometry(c.R_x[n], c.R_y[n], c.psi[n], SOLID.contact_modulus)
        ellipse = FlankEllipse(
            c.R_x[n], c.R_y[n], ellipticity(c.R_y[n] / c.R_x[n]), c.psi[n], c.delta[n]
        )
        motion = (c.load[n], c.speed[n], c.slip[n], geometry)
        of_model = law.model_film(*motion, ellipse, oil, NUMBERS)
        found = law.bounded_flank(*motion, of_model, oil, NUMBERS)
        rubbing = found.state.viscous_friction + found.state.boundary_friction
        rows.append((rubbing, math.exp(of_model.log_friction) * c.load[n], of_model.outside))
    total, of_film, outside = np.array(rows).T
    work = float((c.load * c.slip).sum())
    return Mean(
        float((total * c.slip).sum()) / work,
        float((of_film * c.slip).sum()) / work,
        float((outside * c.load).sum() / c.load.sum()),
    )


def levels_of(c: Contacts, oil: LubricantState) -> dict[str, float]:
    """Return the means of the published formulas over an engagement, weighted alike."""
    geometry = [
        contact_geometry(*one, SOLID.contact_modulus)
        for one in zip(c.R_x, c.R_y, c.psi, strict=True)
    ]
    p = np.array([one.pressure_coefficient for one in geometry]) * c.load ** (1.0 / 3.0)
    k = np.array([ellipticity(one) for one in c.R_y / c.R_x])
    length = 2.0 * np.sqrt(c.load * k / (math.pi * p))
    eta, weights = 1e3 * oil.eta0, c.load * c.slip
    line_load = np.maximum(1e-3 * c.load / length, LEAST_LINE_LOAD)
    local = {
        XU_KAHRAMAN: xu_kahraman(1.5e-9 * p, c.slip / c.speed, c.speed, eta, c.R_x, SIGMA),
        SCHLENK: schlenk(line_load, 2e3 * c.speed * np.cos(c.psi) * c.R_x, eta, SIGMA),
    }
    return {name: float((one * weights).sum() / weights.sum()) for name, one in local.items()}


def needed_stress(c: Contacts, oil: str, degc: float, target: float) -> float:
    """Return the Eyring stress at which solved films have a mean friction [MPa].

    0 and infinity: less than 1 and more than 10 MPa, which the model is not made for.
    """

    def excess(log_stress: float) -> float:
        return solved_mean(c, state(oil, degc, math.exp(log_stress))).friction - target

    low, high = math.log(LEAST), math.log(MOST)
    if excess(low) > 0.0:
        return 0.0
    if excess(high) < 0.0:
        return math.inf
    return math.exp(brentq(excess, low, high, xtol=1e-3))


def pressure_exponent(oil: str) -> float:
    """Return Roelands' Z of an oil at 40 degC."""
    found = state(oil, 40.0, None)
    return found.alpha / (ROELANDS_PRESSURE * (math.log(found.eta0) + ROELANDS_LOG_VISCOSITY))


class OilFriction(NamedTuple):
    """An oil over all points; arrays (points,)."""

    own: float  # its Eyring stress [MPa]
    Z: float  # of Roelands, at 40 degC [-]
    friction: Array  # of solved films, with asperities [-]
    published: dict[str, Array]
    needed: dict[str, Array]  # Eyring stress to meet them [MPa]
    outside: float  # largest share of the load outside the domain [-]


def compared(oil: str) -> OilFriction:
    """Return the friction of an oil at all points beside the published levels."""
    share = OILS[oil.removesuffix(_STAR)]
    rows, wanted = [], []
    for degc in DEGC:
        for speed in SPEEDS:
            for torque in TORQUES:
                c, own = contacts(float(speed), float(torque)), state(oil, float(degc), None)
                mean = solved_mean(c, own)
                published = levels_of(c, own)
                published[SCHLENK] *= share
                levels = [published[name] for name in FORMULAS]
                rows.append((mean.friction, mean.outside, *levels))
                wanted.append([needed_stress(c, oil, float(degc), one) for one in levels])
    values, needed = np.array(rows).T, np.array(wanted).T
    names = FORMULAS
    return OilFriction(
        own.tau0 / MEGA,
        pressure_exponent(oil),
        values[0],
        dict(zip(names, values[2:], strict=True)),
        dict(zip(names, needed, strict=True)),
        float(values[1].max()),
    )


def _spread(values: Array) -> str:
    low, middle, high = np.quantile(values, (0.05, 0.5, 0.95))
    return f"{middle:.3f} ({low:.3f} to {high:.3f})"


def _stress(value: float) -> str:
    return "below 1" if value < LEAST else "above 10" if value > MOST else f"{value:.1f}"


def _stresses(values: Array) -> str:
    low, middle, high = np.quantile(values, (0.05, 0.5, 0.95), method="nearest")
    return f"{_stress(middle)} ({_stress(low)} to {_stress(high)})"


def rows_of(found: dict[str, OilFriction]) -> list[list[str]]:
    """Return all oils: median and 5 to 95 % of the points."""
    return [
        [
            oil,
            f"{one.Z:.2f}",
            f"{one.own:.1f}",
            _spread(one.friction),
            *(_spread(one.published[name]) for name in FORMULAS),
            *(_stresses(one.needed[name]) for name in FORMULAS),
        ]
        for oil, one in found.items()
    ]


# dynamic viscosity [mPa s] and alpha [1/GPa] at 30, 60 and 100 degC, Table 2.3 of
# Stachowiak and Batchelor, Engineering Tribology; those with all six numbers are mineral oils
MEASURED_OILS = (
    (153.0, 34.0, 9.1, 23.7, 20.5, 15.8),
    (250.0, 50.5, 12.6, 25.0, 21.3, 17.6),
    (810.0, 135.0, 26.8, 34.0, 28.0, 22.0),
    (18.6, 6.3, 2.4, 20.0, 16.0, 13.0),
    (45.0, 12.0, 3.9, 28.0, 20.0, 16.0),
    (107.0, 23.3, 6.4, 29.6, 22.8, 17.8),
    (122.0, 26.3, 7.3, 27.0, 21.6, 17.5),
    (171.0, 31.0, 7.5, 28.0, 23.0, 18.0),
    (30.7, 8.6, 3.1, 25.7, 20.3, 15.4),
    (165.0, 30.0, 6.8, 33.0, 23.8, 16.0),
    (310.0, 44.2, 9.4, 34.6, 26.3, 19.5),
    (2000.0, 180.0, 24.0, 41.5, 29.4, 25.0),
)


def exponents_of_table() -> Array:
    """Return Roelands' Z of the measured mineral oils, (oils, temperatures)."""
    values = np.array(MEASURED_OILS)
    eta, alpha = 1e-3 * values[:, :3], 1e-9 * values[:, 3:]
    return np.asarray(alpha / (ROELANDS_PRESSURE * (np.log(eta) + ROELANDS_LOG_VISCOSITY)))


def film_exponents() -> Array:
    """Return d ln h/d ln W of solved films at all points and phases inside the domain."""
    law = Consistent()(gear_flanks(SIGMA), SOLID)._replace(film=float(SOLVED))
    found = []
    for degc in DEGC:
        oil = state("mohammadpour_2015", float(degc), None)
        for speed in SPEEDS:
            for torque in TORQUES:
                c = contacts(float(speed), float(torque))
                for n in range(c.load.size):
                    place = (c.R_x[n], c.R_y[n], c.psi[n])
                    geometry = contact_geometry(*place, SOLID.contact_modulus)
                    ellipse = FlankEllipse(
                        *place[:2], ellipticity(place[1] / place[0]), c.psi[n], c.delta[n]
                    )
                    low, high = (
                        law.model_film(load, c.speed[n], c.slip[n], geometry, ellipse, oil, NUMBERS)
                        for load in (c.load[n] * math.exp(-_STEP), c.load[n] * math.exp(_STEP))
                    )
                    if low.outside == high.outside == 0.0:
                        found.append((high.log_film - low.log_film) / (2.0 * _STEP))
    return np.array(found)


def figure(found: dict[str, OilFriction]) -> Any:
    """Return friction over speed and torque beside published levels, and the stresses needed."""
    with house_style():
        made = new_figure(11.5, 4.6)
        over_speed, over_torque, needed = made.subplots(1, 3, width_ratios=(1.0, 1.0, 1.25))
        over_torque.sharey(over_speed)
        _draw(over_speed, "vehicle speed [km/h]", SPEEDS, lambda v: contacts(v, 100.0))
        _draw(over_torque, "pinion torque [N·m]", TORQUES, lambda q: contacts(60.0, q))
        over_speed.set_title("100 N·m, 95 °C")
        over_torque.set_title("60 km/h, 95 °C")
        over_speed.set_ylabel("mean friction coefficient [-]")
        over_speed.set_ylim(0.0, 0.07)
        _draw_needed(needed, found)
        lines, points = (ax.get_legend_handles_labels() for ax in (over_speed, needed))
        handles, labels = (one + other for one, other in zip(lines, points, strict=True))
        made.legend(handles, labels, loc="outside upper center", ncol=5)
    return made


def _draw(axes: Any, label: str, x: Array, at: Callable[[float], Contacts]) -> None:
    oil = "mohammadpour_2015"
    for tau0, line in ((2.0, "-"), (5.0, "--"), (10.0, ":")):
        y = [solved_mean(at(float(one)), state(oil, 95.0, tau0)).friction for one in x]
        axes.plot(x, y, line, color=VERMILLION, label=f"solved films, τ₀ = {tau0:g} MPa")
    y = [solved_mean(at(float(one)), state(oil, 95.0, 2.0), 0).friction for one in x]
    axes.plot(x, y, color=BLUE, label="formulas, τ₀ = 2 MPa")
    levels = [levels_of(at(float(one)), state(oil, 95.0, None)) for one in x]
    for name, colour in zip(FORMULAS, (GREEN, PURPLE), strict=True):
        y = [one[name] for one in levels]
        axes.plot(x, y, "o-", color=colour, label=name)
    axes.axhline(TWIN_DISC, color=ORANGE, lw=1.2, label="mineral oils, twin discs (measured)")
    axes.set_xlabel(label)


def _draw_needed(axes: Any, found: dict[str, OilFriction]) -> None:
    for n, one in enumerate(found.values()):
        for shift, values, colour in zip(
            (-0.16, 0.16), one.needed.values(), (GREEN, PURPLE), strict=True
        ):
            low, middle, high = np.quantile(values, (0.05, 0.5, 0.95), method="nearest")
            ends = [min(max(end, 0.9), BEYOND) for end in (low, middle, high)]
            axes.plot(ends[::2], [n + shift] * 2, color=colour, lw=2.0)
            axes.plot(ends[1], n + shift, "o", color=colour)
        label = "stress of the oil (right)" if n == 0 else None
        axes.plot(one.own, n, "x", color="black", ms=7, mew=2, label=label)
    axes.plot([], [], "o-", color="0.4", lw=2.0, label="5 to 95 % of the points, median (right)")
    axes.axvspan(MOST, BEYOND * 1.05, color="#E8E8E8")
    axes.set_xscale("log")
    axes.set_xlim(0.9, BEYOND * 1.05)
    axes.set_xticks([1, 2, 3, 5, 7, 10], ["1", "2", "3", "5", "7", "10"])
    axes.minorticks_off()
    axes.set_yticks(range(len(found)), list(found))
    axes.invert_yaxis()
    axes.set_xlabel("Eyring stress [MPa]; grey: above 10")
    axes.set_title("stress that gives the published friction")


def main() -> None:
    """Compute all and write it."""
    oils = [*OILS]
    oils.insert(oils.index(OTHER_ALPHA[0]) + 1, OTHER_ALPHA[0] + _STAR)
    found = {oil: compared(oil) for oil in oils}
    figure(found).savefig(FIGURE)
    page = Page("film_model_axle")
    page.rows("Oil | Z at 40 °C", rows_of(found))
    Z = exponents_of_table()
    page.fill(
        "Z of {} measured mineral oils at 30, 60 and 100 °C: {} to {}, median {} (computed",
        Z.shape[0],
        *(f"{one:.2f}" for one in (Z.min(), Z.max(), np.median(Z))),
    )
    quantiles = np.quantile(film_exponents(), (0.5, 0.05, 0.95, 0.0, 1.0))
    page.fill(
        "d ln h/d ln W of solved films over the points and the engagement: median {}, {} to {} at "
        "90 % of the contacts, {} to {} in all.",
        *(f"{one:.3f}".replace("-", "−") for one in quantiles),
    )
    page.write()


if __name__ == "__main__":
    main()
