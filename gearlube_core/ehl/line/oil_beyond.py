"""Oil beyond a line film's domain: pressure on the upstream border, load and forces."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.line.problem import LineProblem, hertz_gap
from gearlube_core.oil.film_oil import pressure_viscosity

_POINTS = 12  # of Gauss, over border/x from 0 to 1
_THICKEST = 0.5  # reduced pressure times alpha, taken no larger; from 1 on there is no pressure
_THICK = 3.0  # films of gap on a border, below which it cuts the contact


class OilBeyond(NamedTuple):
    """Effect of the oil outside the domain."""

    pressure: float  # on the upstream border [Pa]
    load: float  # per length [N/m]
    rolling_force: float  # int h/2 |dp/dx| dx on either surface [N/m]
    shear_force: float  # int tau dx at mid-film, with the sign of u_2 - u_1 [N/m]


NOTHING = OilBeyond(0.0, 0.0, 0.0, 0.0)


def oil_beyond(
    problem: LineProblem, limits: tuple[float, float], speed_1: float, speed_2: float
) -> OilBeyond:
    """Return the effect of the oil from both borders to infinity, between two parabolas.

    dq/dx = 12 eta0 u (h - h*)/h^3,  p = -ln(1 - alpha q)/alpha,  tau = eta0 (u_2 - u_1) s/h,
    s = 1 upstream, h*/h of streaks downstream

    Parameters
    ----------
    problem : LineProblem
        Its film h* by [moes_1992] and its dry gap make up h. An error of 10 % of h* moves what is
        found by 1e-3 where the gap is a hundred films.
    limits : tuple of float
        First and last x of the domain [m]; X is the distance to the upstream one.
    speed_1, speed_2 : float
        Of the surfaces now [m/s]; no oil is found where they carry the other way than those of
        the problem.

    Notes
    -----
    Far away q = 16 eta0 u R^2/x^3, the load beyond is 8 eta0 u R^2/X^2, the rolling force
    12 eta0 u R/X and the shear force 2 eta0 (u_2 - u_1) R/X. Squeeze is left out.
    """
    way, speed = math.copysign(1.0, problem.entrainment_speed), 0.5 * (speed_1 + speed_2)
    outlet, inlet = way * limits[way > 0.0], -way * limits[way < 0.0]
    if way * speed <= 0.0 or problem.entrainment_speed == 0.0:
        return NOTHING
    ahead, behind = (_outside(problem, distance) for distance in (inlet, outlet))
    if ahead is None or behind is None:
        return NOTHING
    (x, lengths, h), (_, lengths_behind, h_behind) = ahead, behind
    eta0, alpha = problem.lubricant.eta0, pressure_viscosity(problem.lubricant)
    carried = problem.film_guess()
    rise = 12.0 * eta0 * abs(speed) * (h - carried) / h**3 * lengths
    reduced = min(float(rise.sum()), _THICKEST / max(alpha, 1e-300))
    pressure = -math.log1p(-alpha * reduced) / alpha if alpha else reduced
    sheared = float((lengths / h).sum() + (carried * lengths_behind / h_behind**2).sum())
    return OilBeyond(
        pressure,
        float(rise @ (x - inlet)),
        0.5 * float(rise @ h),
        eta0 * (speed_2 - speed_1) * sheared,
    )


def beyond_sentence(of: LineProblem, now: LineProblem, found: OilBeyond) -> str:
    """Return a warning where no oil beyond a flooded domain is counted, else an empty string.

    `of` is the problem of `oil_beyond`, `now` the same with the surface speeds of now.
    """
    if found is not NOTHING or not of.flooded_beyond or of.entrainment_speed == 0.0:
        return ""
    if of.entrainment_speed * now.entrainment_speed <= 0.0:
        return " Oil beyond the domain is not counted: the surfaces carry it the other way."
    return " Oil beyond the domain is not counted: the domain cuts the contact. Widen it."


def _outside(problem: LineProblem, distance: float) -> tuple[Array, Array, Array] | None:
    """Return places, weights and film [m] from a border on; None: it is near the contact."""
    b, film = problem.half_width, problem.film_guess()
    nodes, weights = np.polynomial.legendre.leggauss(_POINTS)
    s = 0.5 + 0.5 * nodes  # border/x
    x = distance / s
    if distance <= b:
        return None
    gap = hertz_gap(np.append(x, distance) / b) * b * b / problem.radius
    if gap[-1] < _THICK * film:
        return None
    return x, 0.5 * weights * distance / s**2, film + gap[:-1]
