"""Elastohydrodynamic films: pressure and film of lubricated contacts of elastic bodies.

=========  ========================================================================
line       Line contacts: steady, in time, and with heat.
point      Point contacts: steady, isothermal and with heat.
transient  Point contacts whose gap, load and speeds change in time.
gears      Films on the flanks of helical and hypoid pairs through their mesh cycle.
case       Contacts as TOML files describe them.
gap        Shapes of the gap: ridges, dents, waviness, measured surfaces.
=========  ========================================================================

Each folder of a solver has `problem`, `settings`, `solution` and `solver` on top; its other files
are the inner parts. All quantities are in SI. The names below can be imported from here; a module
is loaded when one of its names is first used.

Examples
--------
The film of a line contact, of 2 kN over 10 mm, that rolls at 2 m/s:

>>> from gearlube_core.ehl import LineProblem, LineSettings, solve_line
>>> from gearlube_core.oil.film_oil_data import film_oil
>>> oil = film_oil(eta0=0.04, alpha=2e-8)  # Pa s, 1/Pa
>>> line = solve_line(
...     LineProblem(lubricant=oil, radius=0.01, line_load=2e5, reduced_modulus=2.3e11,
...                 speed_1=2.0, speed_2=2.0),
...     LineSettings(nodes=401),
... )
>>> bool(line.converged), round(1e6 * line.minimum_film, 1)  # um
(True, 0.4)

The film of a ball of the same radius on a flat, under 20 N:

>>> from gearlube_core.ehl import PointSolverSettings, elliptical_contact, solve_point_contact
>>> ball = elliptical_contact(R_x=0.01, R_y=0.01, entrainment=(2.0, 0.0), load=20.0,
...                           contact_modulus=1.15e11, lubricant=oil, nodes=(65, 65))
>>> point = solve_point_contact(ball, PointSolverSettings(tolerance=1e-6))
>>> point.outcome.converged, round(1e6 * point.central_film, 2)  # um
(True, 0.39)

With heat, `solve_thermal_line` and `solve_thermal_point` take the same problems, both solids and an
oil with law="houpert". In time: `LineMarch` for lines, `FilmMarch` for points.

Solvers raise `ConvergenceError` if a film does not converge; with throw=False they return what was
reached, marked as not converged. Case files are read by `case`. Datasets, files and figures of
these solutions: `gearlube.studies.films`.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_NAMES = {
    "LineProblem": "line.problem",
    "LineSettings": "line.problem",
    "LineSolution": "line.solution",
    "solve_line": "line.solver",
    "LineMarch": "line.transient",
    "ThermalSettings": "line.thermal",
    "ThermalLineSolution": "line.thermal",
    "solve_thermal_line": "line.thermal",
    "PointContactProblem": "point.problem",
    "EllipticParaboloid": "point.problem",
    "ContactDomain": "point.contact_domain",
    "elliptical_contact": "point.contact_domain",
    "line_section": "point.contact_domain",
    "SolidContact": "point.solid_contact",
    "PointSolverSettings": "point.settings",
    "PointSolution": "point.solution",
    "solve_point_contact": "point.solver",
    "PointThermalSettings": "point.thermal.solver",
    "ThermalPointSolution": "point.thermal.solver",
    "solve_thermal_point": "point.thermal.solver",
    "FilmConditions": "transient.level",
    "MovingFilm": "transient.problem",
    "FilmSolution": "transient.solution",
    "solve_steady_film": "transient.steady",
    "FilmMarch": "transient.march",
    "FilmCurves": "transient.curves",
    "HelicalFilm": "gears.helical_film",
    "solve_helical_line": "gears.helical_cycle",
    "march_helical_cycle": "gears.helical_cycle",
    "HypoidFilm": "gears.hypoid_film",
    "steady_films": "gears.hypoid_cycle",
    "march_flank": "gears.hypoid_cycle",
}
__all__ = tuple(_NAMES)


def __getattr__(name: str) -> Any:
    if name not in _NAMES:
        raise AttributeError(f"{__name__} has no public name {name!r}.")
    value = getattr(import_module(f"{__name__}.{_NAMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_NAMES})
