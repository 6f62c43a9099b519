"""Statements of Jamali 2015 on motion, sections, speed and method: J14 to J18."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from docs.ehl.cases import CYCLE, FACETED, LINE, FilmCase
from docs.ehl.claims import MM, exponent, listed
from docs.ehl.claims_cycle import cycle
from docs.ehl.runs import APPROACH, POSITIONS, SPEEDS
from docs.ehl.store import SETTINGS, Store
from docs.page import Claims, Verdict, judge_parts
from gearlube_core.arrays import Array
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solution import LineSolution
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.helical_geometry.modification import Crown, FlankModification, ModifiedPair
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap
from tests.helpers.jamali_2015 import jamali_2015


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """Film of one section in motion and at rest."""

    y: float  # [m]
    x: Array  # [m]
    pressure: Array  # transient [Pa]
    film: Array  # [m]
    rest_pressure: Array
    rest_film: Array

    @property
    def film_ratio(self) -> float:
        """Return the smallest film in motion over that at rest."""
        return float(self.film.min() / self.rest_film.min())

    @property
    def pressure_off(self) -> float:
        """Return the difference of the largest pressures over that at rest."""
        return abs(float(self.pressure.max() / self.rest_pressure.max()) - 1.0)


def section(store: Store, design: str, step: int, y: float) -> Section:
    """Return the section at y [m], between rows, of a design at one of the detailed steps."""
    pressure, film = cycle(store, design).fields(step)
    rest = store.steady(FilmCase(design=design, nodes=CYCLE), step)
    j = int(np.clip(np.searchsorted(rest.y, y), 1, rest.y.size - 1))
    share = float((y - rest.y[j - 1]) / (rest.y[j] - rest.y[j - 1]))

    def at(values: Array) -> Array:
        return np.asarray((1.0 - share) * values[:, j - 1] + share * values[:, j])

    return Section(
        y=y,
        x=rest.x,
        pressure=at(pressure),
        film=at(film),
        rest_pressure=at(rest.pressure),
        rest_film=at(rest.film),
    )


def line_contact(
    store: Store, case: FilmCase, step: float, y: float, **how: object
) -> LineSolution:
    """Return the line contact with gap, speeds and load per length of a section at rest."""
    rest = store.steady(case, step)
    j = rest.column(y)
    place = rest.y[j : j + 1]
    film = case.film()
    X = film.line(case.number(step) * film.time_step)
    u_1, u_2 = film.surface_speeds(place, X)
    plane = film.modified.pair.plane
    s = X - 0.5 * plane.W * plane.sin_b / plane.cos_b + float(place[0]) * plane.sin_b
    problem = LineProblem(
        lubricant=film.lubricant,
        radius=s * (plane.x_g - s) / (plane.x_g * plane.cos_b),
        line_load=float(rest.pressure[:, j].sum()) * (rest.x[1] - rest.x[0]),
        reduced_modulus=2.0 * film.contact_modulus,
        speed_1=float(u_1[0]),
        speed_2=float(u_2[0]),
        gap=lambda x: film.gap(x, place, X)[:, 0],
        domain=(float(rest.x[0]), float(rest.x[-1])),
    )
    return solve_line(problem, LineSettings(**how))  # type: ignore[arg-type]


# y of the thesis' sections [mm] at steps 75, 300, 500
_APART = {75: (2.0, 5.0), 300: (19.0, 19.8), 500: (-2.0, -5.0)}
_ALIKE = {75: (12.0,), 300: (-19.0, -10.0, 0.0, 16.0), 500: (-10.0,)}
_LINES = (-18.0, -10.0, 0.0, 10.0, 17.0)
_METHODS = ("differences", "elements")  # of the whole line at rest
_GRIDS = (CYCLE, FACETED)
_STEP = 300
_LOAD = 14.4e3  # N: sec. 4.1
MOTIONS = Claims()


@MOTIONS("J14")
def _motion(store: Store) -> Verdict:
    apart = [(n, y, section(store, "a", n, y / MM)) for n, ys in _APART.items() for y in ys]
    alike = [(n, y, section(store, "a", n, y / MM)) for n, ys in _ALIKE.items() for y in ys]
    words = ", ".join(f"{n}/{y:g}: {s.film_ratio:.2f}" for n, y, s in apart)
    same = ", ".join(f"{n}/{y:g}: {s.film_ratio:.2f}" for n, y, s in alike)
    pressure = max(s.pressure_off for _, _, s in (*apart, *alike))
    return Verdict(
        f"film over that at rest, step/y: in the relief {words}; away from it {same}; largest "
        f"pressures of the sections within {100.0 * pressure:.1f} %",
        judge_parts(
            all(s.film_ratio < 0.97 for _, _, s in apart),
            all(abs(s.film_ratio - 1.0) < 0.05 for _, _, s in alike),
            pressure < 0.05,
        ),
    )


@MOTIONS("J15")
def _lines(store: Store) -> Verdict:
    case = FilmCase(design="b", nodes=FACETED)
    rest = store.steady(case, 300)
    off = []
    for y in _LINES:
        j, line = rest.column(y / MM), line_contact(store, case, 300, y / MM)
        off.append(
            (
                100.0 * (float(rest.pressure[:, j].max()) / line.maximum_pressure - 1.0),
                100.0 * (float(rest.film[:, j].min()) / line.minimum_film - 1.0),
            )
        )
    worst = [max(abs(p), abs(h)) for p, h in off]
    return Verdict(
        "; ".join(f"{y:g} mm: {p:+.1f}, {h:+.1f} %" for y, (p, h) in zip(_LINES, off, strict=True))
        + " (pressure, film)",
        judge_parts(max(worst[:-1]) < 3.0, worst[-1] < 15.0),
    )


@MOTIONS("J16")
def _speeds(store: Store) -> Verdict:
    slopes, tops = [], []
    for n in POSITIONS:
        films = [store.steady(FilmCase(speed=s, nodes=FACETED), n) for s in SPEEDS]
        slopes.append(exponent(SPEEDS, [f.min_film for f in films]))
        tops.append(max(abs(f.max_pressure / films[0].max_pressure - 1.0) for f in films))
    marches = [store.march(FilmCase(speed=s, nodes=CYCLE), 500 - APPROACH, 500) for s in SPEEDS]
    moving = exponent(SPEEDS, [m.at("min_film", 500) for m in marches])
    p = [m.at("max_pressure", 500) for m in marches]
    moved = max(abs(v / p[0] - 1.0) for v in p)
    return Verdict(
        f"at rest {listed(slopes, '{:.3f}')}, transient at step 500 {moving:.3f}; pressure within "
        f"{100.0 * max(tops):.1f} % at rest, {100.0 * moved:.1f} % transient",
        judge_parts(
            all(abs(v - 0.68) <= 0.02 for v in (*slopes, moving)), max(*tops, moved) < 0.03
        ),
    )


def _problem(nodes: tuple[int, int]) -> PointContactProblem:
    """Return the contact line as a point contact: speeds of its middle all along it."""
    film = FilmCase(nodes=nodes).film()
    moving = film.moving_film()
    X = film.line(_STEP * film.time_step)
    gap = UndeformedGap(modified=film.modified)
    u_1, u_2 = film.surface_speeds(np.zeros(1), X)
    return PointContactProblem(
        gap=lambda x, y: np.minimum(gap.heights(x, y, X), film.largest_gap),
        entrainment=(0.5 * float(u_1[0] + u_2[0]), 0.0),
        load=film.load(X),
        contact_modulus=film.contact_modulus,
        lubricant=film.lubricant,
        x_limits=moving.x_limits,
        y_limits=moving.y_limits,
        nodes=nodes,
        hertz=moving.hertz,
        sliding=(float(u_1[0] - u_2[0]), 0.0),
    )


def discretised(store: Store, nodes: tuple[int, int]) -> dict[str, tuple[Array, Array]]:
    """Return pressure [Pa] and film [m] by either method, shape (x, y)."""

    def both() -> dict[str, Array]:
        arrays: dict[str, Array] = {}
        for method in _METHODS:
            settings = PointSolverSettings(
                wedge=SETTINGS.wedge, tolerance=SETTINGS.tolerance, discretisation=method
            )
            found = solve_point_contact(_problem(nodes), settings)
            arrays |= {f"{method}_pressure": found.pressure, f"{method}_film": found.film}
        return arrays

    data = store.kept(f"methods_{nodes[0]}x{nodes[1]}", both)
    return {m: (data[f"{m}_pressure"], data[f"{m}_film"]) for m in _METHODS}


@MOTIONS("J17")
def _elements(store: Store) -> Verdict:
    worst = []
    for design in "ab":
        for y in (-0.010, 0.0, 0.010):
            fields = [
                line_contact(store, FilmCase(design=design), 300, y, stencil=stencil)
                for stencil in ("galerkin", "central", "upwind-2")
            ]
            elements = fields[0]
            worst += [
                max(
                    abs(elements.maximum_pressure / other.maximum_pressure - 1.0),
                    abs(elements.minimum_film / other.minimum_film - 1.0),
                    abs(elements.central_film / other.central_film - 1.0),
                )
                for other in fields[1:]
            ]
    words, whole = [], []
    for nodes in _GRIDS:
        (p, h), (p_e, h_e) = discretised(store, nodes).values()
        whole = [abs(float(p_e.max() / p.max()) - 1.0), abs(float(h_e.min() / h.min()) - 1.0)]
        words.append(f"{100.0 * whole[0]:.2f}, {100.0 * whole[1]:.1f} % on {nodes[0]} x {nodes[1]}")
    return Verdict(
        f"lines: within {100.0 * max(worst):.2f} %; contact line of A (pressure, film): "
        + ", ".join(words),
        judge_parts(max(worst) < 0.02 and whole[0] < 0.02, whole[1] < 0.02),
    )


@MOTIONS("J18")
def _length(store: Store) -> Verdict:
    pair = jamali_2015("a").pair
    case = FilmCase()
    film = case.film()
    _, X = film.largest_load()
    crowned = FlankModification(crown=Crown(amount=8e-6, start=0.0))
    moving = film.moving_film()
    shares = []
    for gear in (crowned, FlankModification()):
        gap = UndeformedGap(modified=ModifiedPair(pair=pair, pinion=crowned, gear=gear))
        heights = gap.heights(moving.x[:, None], moving.y[None, :], X)
        dry = dry_contact_of_gap(
            heights, moving.x[1] - moving.x[0], moving.y[1] - moving.y[0], film.contact_modulus,
            _LOAD, tolerance=1e-4,
        )  # fmt: skip
        shares.append(float((dry.pressure > 0.0).any(axis=0).mean()))
    lubricated = store.steady(FilmCase(), 300).length / film.line_length
    return Verdict(
        f"{shares[0]:.3f} w; with one crowned tooth {shares[1]:.2f} w; with relief and film at "
        f"step 300 {lubricated:.2f} w",
        judge_parts(abs(shares[0] - 0.93) <= 0.01),
        "Dry contact at 14.4 kN without relief, with a crown on both teeth, "
        f"{LINE[1]} rows of nodes.",
    )
