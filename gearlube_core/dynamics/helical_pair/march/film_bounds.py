"""Outputs on the error of solved films: bounds of each contact line, share outside the domain."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.state import LINES_MAX
from gearlube_core.friction.solved_line import BoundedLine
from gearlube_core.kernels.jit import kernel

BOUND_QUANTITIES = ("film_bound", "friction_bound")
LINE_BOUNDS = tuple(f"line[{i}].{q}" for i in range(1, LINES_MAX + 1) for q in BOUND_QUANTITIES)
N_BOUNDS = len(BOUND_QUANTITIES)


class BoundSums(NamedTuple):
    """Sums over points of contact lines; all floats."""

    load: float  # [N]
    outside: float  # load outside the domain of the film model [N]
    film: float  # load times bound of the film [N]
    force: float  # friction [N]
    doubt: float  # its bound [N]
    power: float  # lost in friction [W]
    power_doubt: float  # its bound [W]


@kernel
def with_point(sums: BoundSums, load: float, sliding: float, film: BoundedLine) -> BoundSums:
    """Return the sums with one more point.

    Parameters
    ----------
    sums
        Of the points before.
    load, sliding
        Load of the point [N] and sliding speed there [m/s].
    film
        Film and friction there.
    """
    force = film.state.friction_coefficient * load
    doubt, speed = film.coefficient_bound * load, abs(sliding)
    return BoundSums(
        sums.load + load,
        sums.outside + film.outside * load,
        sums.film + film.film_bound * load,
        sums.force + force,
        sums.doubt + doubt,
        sums.power + force * speed,
        sums.power_doubt + doubt * speed,
    )


@kernel
def with_line(total: BoundSums, line: BoundSums) -> BoundSums:
    """Return the sums of both."""
    return BoundSums(
        total.load + line.load,
        total.outside + line.outside,
        total.film + line.film,
        total.force + line.force,
        total.doubt + line.doubt,
        total.power + line.power,
        total.power_doubt + line.power_doubt,
    )


@kernel
def write_bounds(line: BoundSums, first: int, out: Array) -> None:
    """Write the bounds of a line, which begin at `first`.

    That of the film is a mean weighted with the load, that of friction one with the friction
    force. A line without load has none. Errors of all points count as if they had one sign.
    """
    out[first] = line.film / line.load if line.load > 0.0 else 0.0
    out[first + 1] = line.doubt / line.force if line.force > 0.0 else 0.0
