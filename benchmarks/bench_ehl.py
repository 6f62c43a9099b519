"""Cost and robustness of the point contact film.

`pytest -n 0 benchmarks/bench_ehl.py --benchmark-only` times cold solutions, grid nest
included; `python -m benchmarks.bench_ehl [nodes] [stride] [file.csv]` solves a map of 474 contacts
over load M and material L of Moes, the ellipticity a_y/a_x of the dry contact and, for an Eyring
oil, the ratio of sliding to rolling, or every
`stride`-th of them, and prints how many converge and how. Each result is written to the file at
once; contacts that it holds are not solved again. A failure is a failure.
"""

from __future__ import annotations

import csv
import os
import statistics
import sys
import time
from itertools import product
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from gearlube_core.ehl.point.solver import solve_point_contact
from tests.helpers.ehl_point_cases import moes_contact, moes_film, radius_ratio, sliding_along

LOADS = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
MATERIALS = (0.0, 1.0, 2.5, 5.0, 10.0, 15.0, 20.0, 25.0)
ELLIPTICITIES = (0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
# wide contacts; M counts the load over R_x, along the motion, so that they bear more of it
SLENDER = (20.0, 50.0, 100.0)
SLENDER_LOADS = (50.0, 500.0, 5000.0)
SLENDER_MATERIALS = (0.0, 5.0, 15.0, 25.0)
# an Eyring oil whose surfaces slide by as much as they roll
SLIDING_LOADS = (20.0, 200.0, 1000.0)
SLIDING_MATERIALS = (5.0, 10.0, 20.0)
KEY = ("ellipticity", "M", "L", "slide_roll")
RESULT = ("converged", "wedge", "limited", "residual", "H_c", "H_min", "steps", "cpu_s")


@pytest.mark.parametrize(
    ("nodes", "M", "L"),
    [(129, 20, 5), (129, 200, 10), (257, 20, 5), (257, 200, 10), (257, 200, 15)],
)
def test_cold_solution(benchmark: BenchmarkFixture, nodes: int, M: float, L: float) -> None:
    problem = moes_contact(M, L, nodes=(nodes, nodes))
    solve_point_contact(problem.with_nodes(33, 33), throw=False)  # compiles
    solution = benchmark.pedantic(solve_point_contact, args=(problem,), rounds=3)
    assert solution.outcome.converged


def contacts() -> list[tuple[float, ...]]:
    """Return the map: ellipticity, M, L, ratio of sliding to mean speed."""
    return [
        *product(ELLIPTICITIES, LOADS, MATERIALS, (0.0,)),
        *product(SLENDER, SLENDER_LOADS, SLENDER_MATERIALS, (0.0,)),
        *product(ELLIPTICITIES, SLIDING_LOADS, SLIDING_MATERIALS, (1.0,)),
    ]


def solve(case: tuple[float, ...], nodes: int) -> dict[str, str]:
    """Return the row of one contact."""
    ellipticity, M, L, slide_roll = case
    problem = moes_contact(M, L, nodes=(nodes, nodes), radius_ratio=radius_ratio(ellipticity))
    if slide_roll > 0.0:
        problem = sliding_along(problem, slide_roll)
    begin = time.process_time()
    solution = solve_point_contact(problem, throw=False)
    seconds = time.process_time() - begin
    outcome = solution.outcome
    values = (
        str(int(outcome.converged)),
        outcome.wedge,
        f"{outcome.limited:.4f}",
        f"{outcome.residual:.1e}",
        f"{moes_film(problem, solution.central_film):.4f}",
        f"{moes_film(problem, solution.minimum_film):.4f}",
        str(len(solution.residuals)),
        f"{seconds:.2f}",
    )
    return dict(zip(KEY + RESULT, (*(f"{x:g}" for x in case), *values), strict=True))


def kind(row: dict[str, str]) -> str:
    """Return how a contact came out."""
    if row["converged"] != "1":
        return "failed"
    if row["wedge"] == "upwind-1":
        return "first order"
    return "second order" if float(row["limited"]) == 0.0 else "limited faces"


def print_table(rows: list[dict[str, str]]) -> None:
    """Print counts and CPU times by ellipticity."""
    kinds = ("second order", "limited faces", "first order", "failed")
    columns = ("ellipticity", "contacts", *kinds, "largest share", "median s", "longest s")
    sys.stdout.write("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|\n")
    slides = f"Eyring oil, slide-roll {1.0:g}"
    names = [row["ellipticity"] if row["slide_roll"] == "0" else slides for row in rows]
    for group in [*dict.fromkeys(names), "all"]:
        chosen = [row for row, name in zip(rows, names, strict=True) if group in (name, "all")]
        counts = [sum(kind(row) == name for row in chosen) for name in kinds]
        share = max(float(row["limited"]) for row in chosen)
        seconds = [float(row["cpu_s"]) for row in chosen]
        times = f"{statistics.median(seconds):.2f} | {max(seconds):.1f}"
        cells = " | ".join(str(count) for count in counts)
        sys.stdout.write(f"| {group} | {len(chosen)} | {cells} | {share:.1%} | {times} |\n")


def robustness_map(nodes: int, stride: int, path: Path | None) -> None:
    """Solve every `stride`-th contact of the map that the file lacks, then print the table."""
    known: dict[tuple[str, ...], dict[str, str]] = {}
    if path is not None and path.exists():
        with path.open(newline="") as stream:
            known = {tuple(row[k] for k in KEY): row for row in csv.DictReader(stream)}
    moes_start = moes_contact(20.0, 5.0, nodes=(33, 33))
    solve_point_contact(moes_start, throw=False)  # compiles
    rows = []
    for case in contacts()[::stride]:
        row = known.get(tuple(f"{x:g}" for x in case))
        if row is None:
            row = solve(case, nodes)
            if path is not None:
                new = not path.exists()
                with path.open("a", newline="") as stream:
                    writer = csv.DictWriter(stream, KEY + RESULT)
                    if new:
                        writer.writeheader()
                    writer.writerow(row)
        if kind(row) in ("failed", "first order"):
            sys.stdout.write(f"{kind(row)}: {row}\n")
            sys.stdout.flush()
        rows.append(row)
    print_table(rows)


if __name__ == "__main__":
    numbers = [int(argument) for argument in sys.argv[1:3]]
    robustness_map(
        *(numbers + [65, 1][len(numbers) :]), Path(sys.argv[3]) if len(sys.argv) > 3 else None
    )
