"""One small line, point and transient film of any oil, each solved in about a second."""

from __future__ import annotations

from functools import partial

import numpy as np

from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solution import LineSolution
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.problem import EllipticParaboloid
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.oil.film_oil import FilmOil, density
from tests.helpers.ehl_point_cases import box_flow

R, LOAD, MODULUS, SPEED, SLIP = 0.0125, 15.0, 55e9, 0.5, 0.2
_SHAPE = EllipticParaboloid(R, R)
_A = (0.75 * LOAD * R / MODULUS) ** (1.0 / 3.0)  # Hertz radius [m]
TIGHT = PointSolverSettings(wedge="central", tolerance=1e-9, load_tolerance=1e-9)


def line_contact(oil: FilmOil) -> LineProblem:
    """Return a line contact of 0.5 GPa that slides by 40 % of its entrainment."""
    return LineProblem(
        lubricant=oil,
        radius=R,
        line_load=1e5,
        reduced_modulus=2.0 * MODULUS,
        speed_1=SPEED + 0.5 * SLIP,
        speed_2=SPEED - 0.5 * SLIP,
    )


def line_film(oil: FilmOil, nodes: int = 101) -> LineSolution:
    """Return its film."""
    return solve_line(line_contact(oil), LineSettings(nodes=nodes, tolerance=1e-9))


def point_film(oil: FilmOil) -> PointSolution:
    """Return the film of a ball that slides along its entrainment."""
    contact = elliptical_contact(
        R_x=R,
        R_y=R,
        entrainment=(SPEED, 0.0),
        load=LOAD,
        contact_modulus=MODULUS,
        lubricant=oil,
        sliding=(SLIP, 0.0),
        nodes=(33, 33),
    )
    return solve_point_contact(contact, TIGHT)


def films_in_time(oil: FilmOil) -> tuple[FilmSolution, FilmSolution, FilmSolution]:
    """Return the steady film of a ball and those after one and two steps of 5 % more load."""
    step = _A / (10.0 * SPEED)

    def conditions(x: np.ndarray, y: np.ndarray, time: float) -> FilmConditions:
        first, second = (np.full(y.size, SPEED - side * 0.5 * SLIP) for side in (1.0, -1.0))
        load = LOAD * (1.0 + 0.05 * time / step)
        return FilmConditions(_SHAPE(x[:, None], y[None, :]), load, first, second)

    film = MovingFilm(
        conditions=conditions,
        lubricant=oil,
        contact_modulus=MODULUS,
        x_limits=(-2.5 * _A, 1.5 * _A),
        y_limits=(-2.0 * _A, 2.0 * _A),
        nodes=(25, 25),
        hertz=_SHAPE,
        load=LOAD,
        speed=SPEED,
    )
    march = FilmMarch(film, step, settings=TIGHT)
    return march.solution, march.step(), march.step()


def oil_balance(oil: FilmOil) -> float:
    """Return the oil that a box gains but does not hold, over what enters it [-].

    Its gain per time after the second step, (3 m - 4 m' + m'')/(2 dt), against what flows in.
    """
    films = films_in_time(oil)
    film = films[2]
    steps, box = (film.x[1] - film.x[0], film.y[1] - film.y[0]), (6, 18, 7, 17)
    held = [
        steps[0] * steps[1] * (np.vectorize(partial(density, oil))(f.pressure) * f.film)[6:19, 7:18]
        for f in films
    ]
    dt = film.time - films[1].time
    gain = float((1.5 * held[2] - 2.0 * held[1] + 0.5 * held[0]).sum()) / dt
    entering, stays = box_flow(film.pressure, film.film, oil, SPEED, steps, box)
    return (stays - gain) / entering
