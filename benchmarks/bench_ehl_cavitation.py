"""Mass-conserving cavitation of point contacts beside Reynolds', and starved inlets.

`python -m benchmarks.bench_ehl_cavitation [nodes] [starved nodes]` solves 102 contacts over load M
and material L of Moes, ellipticity and angle of entrainment with both, and every second of them
with inlet layers of 5 down to 0.1 of the flooded central film; it prints how many converge, what
they cost and how far the films differ. A failure is a failure.
"""

from __future__ import annotations

import os
import sys
import time
from dataclasses import replace
from itertools import product

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import solve_point_contact
from tests.helpers.ehl_point_cases import moes_contact, radius_ratio

REYNOLDS = PointSolverSettings()
CONSERVING = PointSolverSettings(cavitation="mass_conserving")
LOADS = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
CONTACTS = [
    *product((1.0, 3.0, 8.0), LOADS, (2.5, 5.0, 10.0, 15.0), (0.0,)),
    *((k, M, L, a) for k, (M, L), a in product(
        (2.0, 3.0), ((20.0, 5.0), (50.0, 10.0), (200.0, 10.0)), (30.0, 60.0, 90.0)
    )),
]  # fmt: skip
LAYERS = (5.0, 2.0, 1.0, 0.3, 0.1)


def _contact(case: tuple[float, ...], nodes: int) -> PointContactProblem:
    ellipticity, M, L, degrees = case
    # films over one and the same domain
    return moes_contact(
        M, L, nodes=(nodes, nodes), radius_ratio=radius_ratio(ellipticity),
        angle=float(np.deg2rad(degrees)), oil_beyond=False,
    )  # fmt: skip


def _timed(
    problem: PointContactProblem, settings: PointSolverSettings
) -> tuple[PointSolution, float]:
    begin = time.process_time()
    solution = solve_point_contact(problem, settings, throw=False)
    return solution, time.process_time() - begin


def _result_line(name: str, found: list[tuple[PointSolution, float]]) -> None:
    good = [s.outcome for s, _ in found if s.outcome.converged]
    second = sum(outcome.wedge == "upwind-2" for outcome in good)
    seconds = np.array([t for _, t in found])
    sys.stdout.write(
        f"{name}: {len(good)} of {len(found)} converge, {second} of second order; CPU s: "
        f"{seconds.sum():.1f} in all, median {np.median(seconds):.2f}, most {seconds.max():.2f}\n"
    )


def main() -> None:
    """Solve both maps and print what came out."""
    given = [int(word) for word in sys.argv[1:3]]
    nodes, coarse = (*given, *(129, 65)[len(given) :])
    start = _contact((1.0, 50.0, 5.0, 0.0), 33)
    for problem in (start, replace(start, inlet_layer=1e-7)):
        solve_point_contact(problem, CONSERVING, throw=False)  # compiles
    solve_point_contact(start)
    pairs = [
        [_timed(_contact(case, nodes), s) for s in (REYNOLDS, CONSERVING)] for case in CONTACTS
    ]
    _result_line("Reynolds", [pair[0] for pair in pairs])
    _result_line("mass conserving", [pair[1] for pair in pairs])
    for name in ("central_film", "minimum_film", "maximum_pressure"):
        off = np.array([abs(getattr(b[0], name) / getattr(a[0], name) - 1.0) for a, b in pairs])
        worst = CONTACTS[int(off.argmax())]
        sys.stdout.write(f"{name}: median {np.median(off):.1e}, most {off.max():.1e} at {worst}\n")
    starved = []
    for case in CONTACTS[::2]:
        problem = _contact(case, coarse)
        film = solve_point_contact(problem, CONSERVING, throw=False).central_film
        starved += [_timed(replace(problem, inlet_layer=r * film), CONSERVING) for r in LAYERS]
    _result_line("starved", starved)


if __name__ == "__main__":
    main()
