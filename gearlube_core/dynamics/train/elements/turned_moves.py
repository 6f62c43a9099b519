"""Motion of a body in axes that turn about z with another one."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ
from gearlube_core.kernels.inlining import inside


class Moves(NamedTuple):
    """Displacements and angles of a body, their rates, or forces and moments on it.

    Angles about z are left out, as they grow without a bound; their rates are not.
    """

    x: float
    y: float
    z: float
    rx: float
    ry: float
    rz: float


@inside
def turned_moves(s: Array, u: int, cos: float, sin: float) -> Moves:
    """Return the displacements and tilts at place `u` of the state in axes at an angle."""
    return Moves(
        cos * s[u] + sin * s[u + 1],
        cos * s[u + 1] - sin * s[u],
        s[u + 2],
        cos * s[u + 3] + sin * s[u + 4],
        cos * s[u + 4] - sin * s[u + 3],
        0.0,
    )


@inside
def turned_rates(s: Array, u: int, moves: Moves, cos: float, sin: float, turning: float) -> Moves:
    """Return the rates of `turned_moves` in axes that turn with a speed [rad/s]."""
    v = u + RATE
    seen = turned_moves(s, v, cos, sin)
    return Moves(
        seen.x + turning * moves.y,
        seen.y - turning * moves.x,
        seen.z,
        seen.rx + turning * moves.ry,
        seen.ry - turning * moves.rx,
        s[v + RZ] - turning,
    )


@inside
def add_turned(ds: Array, u: int, w: Moves, cos: float, sin: float) -> None:
    """Add forces and moments in axes at an angle to the rates of the body at place `u`."""
    v = u + RATE
    ds[v] += cos * w.x - sin * w.y
    ds[v + 1] += sin * w.x + cos * w.y
    ds[v + 2] += w.z
    ds[v + 3] += cos * w.rx - sin * w.ry
    ds[v + 4] += sin * w.rx + cos * w.ry
    ds[v + RZ] += w.rz


@inside
def swept(u: Moves, w: Moves) -> float:
    """Return the moment about z of forces at the displaced body, and of moments at its tilts."""
    return u.x * w.y - u.y * w.x + u.rx * w.ry - u.ry * w.rx
