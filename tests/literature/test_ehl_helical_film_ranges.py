"""Films of Jamali 2015 claims J3 to J6 on small grids: at rest, and over some steps in motion.

97 nodes across resolve the film within 10 to 27 % by its own estimate; 33 along are too few for the
kink where relief begins. On finer grids and in motion the smallest films are thinner than printed,
0.13 um and less (docs/ehl.md, "the smallest film in motion"), which these grids do not show.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from docs.ehl.cases import FilmCase
from gearlube_core.ehl.gears.helical_film import march_helical_cycle, solve_helical_line
from gearlube_core.ehl.transient.solution import FilmSolution

NODES = (97, 33)  # across and along the line
# design, F_o over F, pressures [GPa], films [um], a step before the smallest film in motion
CLAIMS = {
    "J3": ("a", 0.0, (1.02, 1.25), (0.16, 0.22), 498),
    "J4": ("b", 0.0, (0.82, 1.12), (0.16, 0.25), 8),
    "J5": ("a", 0.25, (0.98, 1.17), (0.16, 0.22), 498),
}


@cache
def _at_rest(
    design: str, crown_start: float, step: int, nodes: tuple[int, int] = NODES
) -> FilmSolution:
    case = FilmCase(design=design, crown_start=crown_start, nodes=nodes)
    return solve_helical_line(case.film(), step)


@pytest.mark.parametrize("step", [75, 300, 500])
@pytest.mark.parametrize("claim", CLAIMS)
def test_lines_at_rest_lie_in_the_printed_ranges(claim: str, step: int) -> None:
    design, crown_start, pressures, films, _ = CLAIMS[claim]
    line = _at_rest(design, crown_start, step)
    # 5 %: that of the pressure on 33 nodes along, by its estimate
    assert 0.95 * pressures[0] < 1e-9 * line.maximum_pressure < 1.05 * pressures[1]
    # half of the last printed digit
    assert films[0] - 0.005 < 1e6 * line.minimum_film < films[1] + 0.005
    # told by the solver, with its factor of safety
    assert line.error.minimum_film < 0.4


@pytest.mark.slow
def test_a_crown_that_begins_late_thins_the_film_and_makes_a_spike() -> None:
    """J6: at step 300 0.21 um without, 0.14 um and a spike with F_o = 0.45 F; 15 %."""
    plain, even = _at_rest("a", 0.0, 300), _at_rest("a", 0.25, 300)
    late = _at_rest("a", 0.45, 300, (65, 97))  # its slope at the end needs nodes along the line
    assert 1e6 * plain.minimum_film == pytest.approx(0.21, rel=0.15)
    assert 1e6 * late.minimum_film == pytest.approx(0.14, rel=0.15)
    place = late.y[np.unravel_index(late.pressure.argmax(), late.pressure.shape)[1]]
    assert late.maximum_pressure > 1.02 * even.maximum_pressure
    assert abs(place) > 10e-3


def _smallest_films(
    design: str, crown_start: float, nodes: tuple[int, int], first: int, count: int, parts: int
) -> tuple[np.ndarray, float]:
    """Return the smallest film after each of `count` steps, and its largest estimated error."""
    film = FilmCase(design=design, crown_start=crown_start, nodes=nodes).film()
    march = march_helical_cycle(film, first=first, last=first + count, substeps=parts)
    return 1e6 * march["minimum_film"][1:], float(march["time_error"][1:].max())


# one design, and the crown that begins late; lines at rest are in the default run for all claims
@pytest.mark.slow
@pytest.mark.parametrize(
    "claim", ["J3", *(pytest.param(one, marks=pytest.mark.slow) for one in ("J4", "J5")), "J6"]
)
def test_films_in_motion_are_known_to_the_estimated_error_of_the_time_step(claim: str) -> None:
    if claim == "J6":
        design, crown_start, first, nodes, count = "a", 0.45, 297, (33, 97), 3
    else:
        design, crown_start, _, films, first = CLAIMS[claim]
        nodes, count = NODES, 4
    whole, told = _smallest_films(design, crown_start, nodes, first, count, 1)
    quarters, _ = _smallest_films(design, crown_start, nodes, first, count, 4)
    true = float(np.abs(whole / quarters - 1.0).max())
    # an estimate 30 times too large would say nothing
    assert true < told < 30.0 * true
    if claim != "J6":  # three steps from rest, on too few nodes across for a film to compare
        # 15 % for reading the thesis' figures
        assert 0.85 * films[0] < quarters.min() < 1.15 * films[1]
