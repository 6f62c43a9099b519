"""Cost and robustness of the point contact film.

`python -m pytest benchmarks/bench_ehl.py --benchmark-only` times cold solutions, grid nest
included; `python -m benchmarks.bench_ehl [nodes] [share]` solves a map of 384 contacts over load M
and material L of Moes and the ellipticity of the dry contact, or a share of it, and prints how
many converge. A failure is a failure.
"""

from __future__ import annotations

import math
import os
import statistics
import sys
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from gearlube_core.contact.elliptical_hertz import log_curvature_ratio
from gearlube_core.ehl.point_solver import solve_point_contact
from tests.ehl_point_cases import moes_contact, moes_film

LOADS = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
MATERIALS = (0.0, 1.0, 2.5, 5.0, 10.0, 15.0, 20.0, 25.0)
ELLIPTICITIES = (0.2, 0.5, 1.0, 2.0, 5.0, 10.0)


def radius_ratio(ellipticity: float) -> float:
    """Return R_y/R_x of a dry contact with semi-axes a_y/a_x."""
    exponent = log_curvature_ratio(abs(math.log(ellipticity)))
    return math.exp(exponent if ellipticity >= 1.0 else -exponent)


@pytest.mark.parametrize(
    ("nodes", "M", "L"),
    [(129, 20, 5), (129, 200, 10), (257, 20, 5), (257, 200, 10), (257, 200, 15)],
)
def test_cold_solution(benchmark: BenchmarkFixture, nodes: int, M: float, L: float) -> None:
    problem = moes_contact(M, L, nodes=(nodes, nodes))
    solve_point_contact(problem.with_nodes(33, 33), throw=False)  # compiles
    solution = benchmark.pedantic(solve_point_contact, args=(problem,), rounds=3)
    assert solution.outcome.converged


def robustness_map(nodes: int, stride: int) -> None:
    """Solve every `stride`-th contact of the map and print what failed and the share."""
    cases = [(k, M, L) for k in ELLIPTICITIES for M in LOADS for L in MATERIALS][::stride]
    seconds, failed, lower = [], 0, 0
    for ellipticity, M, L in cases:
        begin = time.perf_counter()
        problem = moes_contact(M, L, nodes=(nodes, nodes), radius_ratio=radius_ratio(ellipticity))
        solution = solve_point_contact(problem, throw=False)
        seconds.append(time.perf_counter() - begin)
        case = f"ellipticity {ellipticity:g} M {M:g} L {L:g}: "
        case += f"H_c {moes_film(problem, solution.central_film):.3f} {seconds[-1]:.1f} s"
        lower += solution.outcome.converged and solution.outcome.wedge == "upwind-1"
        if not solution.outcome.converged:
            failed += 1
            sys.stdout.write(f"FAILED {case} {solution.outcome.sentence}\n")
            sys.stdout.flush()
    sys.stdout.write(
        f"{len(cases) - failed} of {len(cases)} converged on {nodes} x {nodes} nodes\n"
    )
    sys.stdout.write(f"median {statistics.median(seconds):.2f} s, longest {max(seconds):.1f} s\n")


if __name__ == "__main__":
    arguments = [int(argument) for argument in sys.argv[1:]]
    robustness_map(*(arguments + [65, 1][len(arguments) :]))
