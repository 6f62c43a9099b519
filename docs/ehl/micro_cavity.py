"""A micro-cavity passing a point contact, rolling and sliding, after Mourier et al. 2006.

The cavity changes how much oil enters the contact. What has entered is too viscous to be pumped and
moves with the mean speed of the surfaces; the cavity moves with its own surface.
"""

from __future__ import annotations

import logging
import math
import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from docs.ehl.store import Store
from gearlube_core.arrays import Array
from gearlube_core.ehl.point.problem import EllipticParaboloid
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.ehl.transient.steady import solve_steady_film
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.film_oil_data import film_oil

logger = logging.getLogger("docs.ehl")

RADIUS, LOAD, SPEED = 0.0125, 15.0, 0.09  # m, N, mean of the surfaces m/s
MODULUS = 0.5 * 110e9  # E* [Pa]
OIL = film_oil(eta0=0.25, alpha=22e-9)
A = (0.75 * LOAD * RADIUS / MODULUS) ** (1.0 / 3.0)  # dry radius [m]
_FLAT = 0.9  # dry radii within which the film is compared
_PIECE = 80e-6  # of oil that is followed [m]
# places of the cavity between which the pieces are followed, and those where it leads [m]
_FOLLOWED, _FOLLOWED_BEHIND = (-38e-6, -8e-6), (30e-6, 75e-6)
_INLET, _OUTLET, _SIDE, _START = 2.5, 1.5, 1.75, -2.2  # radii


@dataclass(frozen=True, slots=True, kw_only=True)
class CavityCase:
    """A cavity d cos(pi s/2) exp(-2 s^2), s = r/(1.2 r_c), on one surface."""

    name: str
    slide_roll: float  # (u_cavity - u_other)/(u_cavity + u_other)
    depth: float  # [m]
    cavity_radius: float  # [m]
    oil: FilmOil = OIL

    @property
    def cavity_speed(self) -> float:
        """Return the speed of the surface with the cavity [m/s]."""
        return SPEED * (1.0 + self.slide_roll)

    def centre(self, t: float) -> float:
        """Return where the cavity is [m]."""
        return _START * A + self.cavity_speed * t

    def shape(self, x: Array, y: Array, t: float) -> Array:
        """Return its depth over a grid [m]."""
        s = np.hypot(x[:, None] - self.centre(t), y[None, :]) / (1.2 * self.cavity_radius)
        return np.asarray(self.depth * np.cos(0.5 * math.pi * s) * np.exp(-2.0 * s**2))

    def film(self, nodes: tuple[int, int], smooth: bool = False) -> MovingFilm:
        """Return the film, or that of the smooth ball."""
        ball = EllipticParaboloid(RADIUS, RADIUS)
        other = 2.0 * SPEED - self.cavity_speed

        def conditions(x: Array, y: Array, t: float) -> FilmConditions:
            gap = ball(x[:, None], y[None, :]) + (0.0 if smooth else self.shape(x, y, t))
            speeds = (np.full(y.size, self.cavity_speed), np.full(y.size, other))
            return FilmConditions(gap, LOAD, *speeds)

        return MovingFilm(
            conditions=conditions,
            lubricant=self.oil,
            contact_modulus=MODULUS,
            x_limits=(-_INLET * A, _OUTLET * A),
            y_limits=(-_SIDE * A, _SIDE * A),
            nodes=nodes,
            hertz=ball,
            load=LOAD,
            speed=SPEED,
        )


# geometry of the simulations as Hansen et al. 2022 give it
ROLLING = CavityCase(name="rolling", slide_roll=0.0, depth=175e-9, cavity_radius=15.5e-6)
SLIDING = CavityCase(name="sliding", slide_roll=-0.5, depth=160e-9, cavity_radius=21.5e-6)
# the same cavity on the faster surface, without a published counterpart
FASTER = CavityCase(name="faster", slide_roll=0.5, depth=160e-9, cavity_radius=21.5e-6)


@dataclass(frozen=True, slots=True, kw_only=True)
class Passage:
    """Films along the line of motion through the middle, while a cavity passes."""

    x: Array  # [m], shape (nx,)
    times: Array  # [s], shape (steps,)
    centre: Array  # of the cavity [m], shape (steps,)
    film: Array  # [m], shape (steps, nx)
    pressure: Array  # [Pa], shape (steps, nx)
    smooth_film: Array  # without a cavity [m], shape (nx,)
    smooth_pressure: Array
    failures: int  # steps that did not converge
    seconds: float  # of the processor

    @property
    def change(self) -> Array:
        """Return what the cavity changes of the film [m], shape (steps, nx)."""
        return np.asarray(self.film - self.smooth_film)

    def step(self, centre: float) -> int:
        """Return the step at which the cavity is nearest to a place [m]."""
        return int(np.abs(self.centre - centre).argmin())


def march(
    case: CavityCase, nodes: tuple[int, int], last_centre: float = 0.7, courant: float = 0.5
) -> Passage:
    """Return the passage until the cavity is at `last_centre` [dry radii].

    The mean speed takes `courant` nodes a time step: second-order backward differences delay a wave
    by (omega dt)^2/3 of its speed, 3 % for the oil that a cavity lets in at one node a step.
    """
    film = case.film(nodes)
    x, middle = film.x, nodes[1] // 2
    step = courant * float(x[1] - x[0]) / SPEED
    count = math.ceil((last_centre - _START) * A / (case.cavity_speed * step))
    began = time.process_time()
    smooth = solve_steady_film(case.film(nodes, smooth=True), 0.0)
    run = FilmMarch(film, step)
    times, films, pressures, failures = [], [], [], 0
    for n in range(count):
        found = run.step(throw=False)
        failures += not found.converged
        times.append(found.time)
        films.append(found.film[:, middle])
        pressures.append(found.pressure[:, middle])
        if n % 50 == 0:
            logger.info("  cavity %s, step %d of %d", case.name, n, count)
    return Passage(
        x=x,
        times=np.array(times),
        centre=np.array([case.centre(t) for t in times]),
        film=np.array(films),
        pressure=np.array(pressures),
        smooth_film=smooth.film[:, middle],
        smooth_pressure=smooth.pressure[:, middle],
        failures=failures,
        seconds=time.process_time() - began,
    )


def kept_passage(store: Store, case: CavityCase, nodes: tuple[int, int]) -> Passage:
    """Return a passage from the folder, marched if it is not there and the store computes."""

    def marched() -> dict[str, Any]:
        found = march(case, nodes)
        return {name: getattr(found, name) for name in Passage.__slots__}

    values = store.kept(f"cavity_{case.name}_{nodes[0]}x{nodes[1]}", marched)
    values["failures"], values["seconds"] = int(values["failures"]), float(values["seconds"])
    return Passage(**values)


def shift_between(x: Array, template: Array, start: int, profile: Array, most: float) -> float:
    """Return how far a piece of a profile has moved, where its cross-correlation is largest.

    Correlations are those of Pearson, over as many nodes as the piece has; between nodes the
    parabola through the largest and its neighbours decides.

    Parameters
    ----------
    x
        Even nodes [m].
    template
        Piece of the profile at an earlier time, from node `start` on.
    profile
        At the later time, all nodes.
    most
        Largest shift looked for [m]; none lies upstream.

    Returns
    -------
    float
        Shift [m] towards larger x.
    """
    dx = float(x[1] - x[0])
    # one shift upstream, for the parabola of a piece that has hardly moved
    last = min(round(most / dx) + 1, profile.size - start - template.size)
    shifts = np.arange(-1, last + 1)
    pieces = [profile[start + s : start + s + template.size] for s in shifts]
    likeness = np.array([np.corrcoef(template, piece)[0, 1] for piece in pieces])
    k = int(np.clip(likeness.argmax(), 1, likeness.size - 2))
    low, top, high = likeness[k - 1 : k + 2]
    bend = low - 2.0 * top + high
    return dx * (int(shifts[k]) + (0.5 * (low - high) / bend if bend < 0.0 else 0.0))


def travel_speed(passage: Passage, first: int, last: int, limits: tuple[float, float]) -> float:
    """Return the speed of the piece of the change of film that lies within limits at a step [m/s].

    Parameters
    ----------
    passage
    first, last
        Steps between which it is followed; the piece is that of `first`.
    limits
        Of the piece at the first step [m].

    Notes
    -----
    The slope of the straight line through its shifts. Shifts are looked for up to twice the mean
    speed, faster than either surface, and within 0.9 dry radii, where the film is flat.
    """
    inside = np.abs(passage.x) < _FLAT * A
    x, change = passage.x[inside], passage.change[:, inside]
    start, end = (int(np.abs(x - limit).argmin()) for limit in limits)
    piece = change[first, start:end]
    steps = np.arange(first, last + 1)
    times = passage.times[steps] - passage.times[first]
    shifts = [
        shift_between(x, piece, start, change[n], 2.0 * SPEED * t)
        for n, t in zip(steps, times, strict=True)
    ]
    return float(np.polyfit(times, shifts, 1)[0])


def speeds(case: CavityCase, passage: Passage) -> tuple[float, float]:
    """Return the speeds of the hollow in the film and of the oil that the cavity let in [m/s].

    The hollow is what lies within 1.2 r_c of the cavity, the oil a piece of 80 um in front of it
    where the cavity is slower than the oil, else behind it.
    """
    reach = 1.2 * case.cavity_radius
    places = _FOLLOWED_BEHIND if case.slide_roll > 0.0 else _FOLLOWED
    first, last = (passage.step(place) for place in places)
    back, front = passage.centre[first] - reach, passage.centre[first] + reach
    hollow = travel_speed(passage, first, last, (back, front))
    if case.slide_roll == 0.0:
        return hollow, math.nan
    oil = (back - _PIECE, back) if case.slide_roll > 0.0 else (front, front + _PIECE)
    return hollow, travel_speed(passage, first, last, oil)
