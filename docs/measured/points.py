"""What is predicted for each measured point, by the shipped defaults."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from docs.bearing.make import POINTS, POINTS_32008, loss
from docs.ehl.micro_cavity import LOAD as CAVITY_LOAD
from docs.ehl.micro_cavity import MODULUS, OIL, RADIUS, ROLLING, SLIDING, SPEED, A, kept_passage
from docs.ehl.micro_cavity_page import NODES, SLIDING_PUBLISHED, at_cavity
from docs.ehl.store import Store
from docs.kept_films import KeptFilms
from gearlube_core.arrays import Array
from gearlube_core.bearings.losses.laws import DEFAULT_LAW
from gearlube_core.bearings.losses.loss import UNCALIBRATED
from gearlube_core.dynamics.hypoid_axle.uncertain import UNCERTAIN
from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.input_file.table import read_table
from gearlube_core.oil.film_laws import roelands
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.pressure_coefficients import slope_for
from gearlube_core.units import celsius_to_kelvin

TABLES = Path(__file__).parent
FACTORS = {one.name: one.factor for one in UNCERTAIN}
FILM_ERROR = 0.01  # wanted, of the grid
# steel ball on glass
GLASS_R, GLASS_LOAD = 9.525e-3, 20.0  # m, N
GLASS_MODULUS = 1.0 / ((1.0 - 0.3**2) / 210e9 + (1.0 - 0.21**2) / 70e9)  # E* [Pa]
CAVITY_ALPHA = 22e-9  # 1/Pa
# discs of Dyson, Naylor and Wilson; their oils and loads are not at hand
DISC_R, DISC_MODULUS = 19.05e-3, 224e9  # m, E' [Pa]
DISC_ETA0, DISC_ALPHA = 0.2, 2e-8  # Pa s, 1/Pa, of films
DISC_PRESSURES = (0.3e9, 0.5e9, 0.8e9)  # Pa, largest
DISC_FILMS = (25e-9, 158e-9, 1e-6)  # m
_OF_VISCOSITY, _OF_ALPHA = 0.68, 0.53  # exponents of films
_LEAST_READING = 0.05  # relative uncertainty of a torque read from a figure


class Point(NamedTuple):
    """A measured point and what is predicted for it; factors hold 95 % (k = 2)."""

    data: str
    where: str
    unit: str
    measured: float
    uncertainty: float  # factor of the measurement
    predicted: float
    factor: float  # of the prediction

    @property
    def log_ratio(self) -> float:
        """Return ln(predicted/measured)."""
        return math.log(self.predicted / self.measured)

    @property
    def inside(self) -> bool:
        """Tell whether both bars of 95 % together hold the difference."""
        bar = math.hypot(math.log(self.uncertainty), math.log(self.factor))
        return abs(self.log_ratio) <= bar


def film_factor(grid: float) -> float:
    """Return the factor (k = 2) of a film with an error of its grid."""
    viscosity, alpha = (math.log(FACTORS[one]) for one in ("viscosity", "alpha"))
    return math.exp(math.hypot(_OF_VISCOSITY * viscosity, _OF_ALPHA * alpha, grid))


def _ball(oil: FilmOil, radius: float, load: float, modulus: float, u: float) -> PointSolution:
    contact = elliptical_contact(
        R_x=radius, R_y=radius, entrainment=(u, 0.0), load=load, contact_modulus=modulus,
        lubricant=oil,
    )  # fmt: skip
    return solve_point_contact(contact, film_error=FILM_ERROR)


def fva_3(work: Path) -> Iterator[Point]:
    """Yield the central films of FVA 3 between ball and glass."""
    kept, oil = KeptFilms(work), Lubricant.named("fva_3")
    for row in read_table(TABLES / "fva_3_films.csv"):
        degc, u = row.number("temperature_degc"), row.number("speed_m_s")

        def solved(degc: float = degc, u: float = u) -> dict[str, Array]:
            film_of = film_oil_of(oil, celsius_to_kelvin(degc), newtonian=True)
            film = _ball(film_of, GLASS_R, GLASS_LOAD, GLASS_MODULUS, u)
            return {"now": np.array([film.central_film, film.error.central_film])}

        h, grid = kept.kept(f"fva_3_{degc:g}_{u:g}", solved)["now"]
        yield Point(
            f"FVA 3, {degc:g} °C", f"{u:.3g} m/s", "nm", row.number("central_film_nm"),
            1.0 + 0.01 * row.number("uncertainty_percent"),
            1e9 * h, film_factor(grid),
        )  # fmt: skip


def mourier(work: Path) -> Iterator[Point]:
    """Yield the films without and beside the cavity; the printed alpha is that of films."""
    slope = slope_for(lambda one: roelands(OIL.eta0, one), CAVITY_ALPHA, "film")
    oil, kept = film_oil(eta0=OIL.eta0, alpha=slope), KeptFilms(work / "now")

    def at_rest() -> dict[str, Array]:
        film = _ball(oil, RADIUS, CAVITY_LOAD, MODULUS, SPEED)
        middle = film.film[:, film.nodes[1] // 2]
        x = film.problem.x
        error = film.error
        return {
            "middle": np.array([film.central_film, error.central_film]),
            "outlet": np.array([middle[np.abs(x) < 1.2 * A].min(), error.minimum_film]),
        }

    rest = kept.kept("mourier_at_rest", at_rest)
    passage = kept_passage(Store(work / "now"), replace(SLIDING, oil=oil), NODES)
    place = SLIDING_PUBLISHED[-1].centre
    n = passage.step(1e-6 * place)
    ahead = at_cavity(SLIDING, passage, place).oil
    offset = passage.centre[n] - passage.x
    near = (offset > SLIDING.cavity_radius) & (offset < 3.0 * SLIDING.cavity_radius)
    found = {
        **{name: (1e9 * h, error) for name, (h, error) in rest.items()},
        "ahead of the cavity": (ahead, 0.02),
        "behind the cavity": (1e9 * float(passage.film[n][near].min()), 0.02),
    }
    for row in read_table(TABLES / "mourier_2006.csv"):
        ratio, where = row.number("slide_roll"), row.text("where")
        measured = row.number("film_nm")
        film, grid = found[where]
        rolls = "rolling" if ratio == ROLLING.slide_roll else "sliding"
        yield Point(
            "Mourier's ball", f"{rolls}, {where}", "nm", measured,
            1.0 + row.number("uncertainty_nm") / measured, film, film_factor(grid),
        )  # fmt: skip


def bearings() -> Iterator[Point]:
    """Yield the torques of both tapered roller bearings, by the default law."""
    factor = UNCALIBRATED[DEFAULT_LAW]
    for one in POINTS:
        torque = loss(one, law=DEFAULT_LAW).torque
        where = f"{one.degc:g} °C, {one.radial:g} N radial, {one.rpm} rpm"
        read = 1.0 + 0.1 / one.torque
        yield Point("bearing 32216", where, "N·m", one.torque, read, torque, factor)
    for two in POINTS_32008:
        torque = two.computed(DEFAULT_LAW)
        difference = 0.5 * abs(math.log(two.readings[0] / two.readings[1]))
        read = math.exp(max(difference, _LEAST_READING))
        where = f"{two.degc:g} °C, {two.rpm:g} rpm"
        yield Point("bearing 32008", where, "N·m", two.torque, read, torque, factor)


def exponents(work: Path) -> dict[str, Array]:
    """Return the exponents of central films between discs, over `DISC_PRESSURES`."""

    def film(u: float, pressure: float, alpha: float = DISC_ALPHA) -> float:
        slope = slope_for(lambda one: roelands(DISC_ETA0, one), alpha, "film")
        line = LineProblem(
            lubricant=film_oil(eta0=DISC_ETA0, alpha=slope),
            radius=DISC_R,
            line_load=2.0 * math.pi * DISC_R * pressure**2 / DISC_MODULUS,
            reduced_modulus=DISC_MODULUS,
            speed_1=u,
            speed_2=u,
        )
        return solve_line(line).central_film

    def solved() -> dict[str, Array]:
        found = []
        for pressure in DISC_PRESSURES:
            middle = DISC_FILMS[1]
            u = 0.04 * (middle / film(0.04, pressure)) ** (1.0 / 0.7)
            ends = [u * (one / middle) ** (1.0 / 0.7) for one in DISC_FILMS]
            films = [film(one, pressure) for one in ends]
            alphas = [film(u, pressure, by * DISC_ALPHA) for by in (0.8, 1.25)]
            loads = [film(u, by * pressure) for by in (0.9, 1.0 / 0.9)]
            found.append([
                np.polyfit(np.log(ends), np.log(films), 1)[0],
                math.log(alphas[1] / alphas[0]) / math.log(1.25 / 0.8),
                math.log(loads[1] / loads[0]) / math.log(0.9**-4),
            ])  # fmt: skip
        return dict(zip(("speed", "alpha", "load"), np.array(found).T, strict=True))

    return KeptFilms(work).kept("dyson", solved)
