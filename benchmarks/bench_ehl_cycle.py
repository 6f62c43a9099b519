"""Cost of the film of a helical pair through its meshing cycle.

`python -m benchmarks.bench_ehl_cycle [steps]` marches design A of Jamali 2015 (Eyring oil) on his
mesh of 182 x 857 nodes and on the default mesh, a few steps at the beginning, in the middle and
towards the end of the cycle; it prints processor and wall time of one step, the 575 steps at that
rate with the steady start, and the peak memory. With "cycle" for the steps the whole cycle is
marched on the default mesh, then on one of 129 nodes that is dense where the film leaves the
contact.
"""

from __future__ import annotations

import os
import resource
import statistics
import sys
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")

from gearlube_core.ehl.helical_cycle import march_helical_cycle
from gearlube_core.ehl.helical_film import EXIT_GRADING, HelicalFilm, jamali_2015_film
from gearlube_core.ehl.transient_march import FilmMarch

MESHES = ((182, 857), (97, 257))
PLACES = (100, 300, 490)  # steps of the cycle
SETTLING = 4  # steps after the film at rest, which cost more: the preconditioner is built


def step_times(nodes: tuple[int, int], steps: int) -> None:
    """Print what the start and single steps cost on a mesh."""
    film = jamali_2015_film("a", nodes=nodes)
    starts, processor, wall, failed = [], [], [], 0
    for place in PLACES:
        begin = time.process_time()
        march = FilmMarch(film.moving_film(), film.time_step, start_time=place * film.time_step)
        starts.append(time.process_time() - begin)
        for _ in range(SETTLING):
            march.step(throw=False)
        for _ in range(steps):
            begin, tick = time.process_time(), time.perf_counter()
            failed += not march.step(throw=False).converged
            processor.append(time.process_time() - begin)
            wall.append(time.perf_counter() - tick)
    start, mean = statistics.median(starts), statistics.mean(processor)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    count = film.steps.count
    sys.stdout.write(
        f"{nodes[0]} x {nodes[1]}: start {start:.1f} s, step {mean:.2f} s (processor; "
        f"{statistics.mean(wall):.2f} s wall, longest {max(processor):.2f} s), {count} steps "
        f"{(start + count * mean) / 60.0:.1f} min, {failed} of {len(wall)} not converged, "
        f"peak {peak:.0f} MiB\n"
    )
    sys.stdout.flush()


def whole_cycle(name: str, film: HelicalFilm) -> None:
    """March all steps and print what they cost and find."""
    begin, tick = time.process_time(), time.perf_counter()
    cycle = march_helical_cycle(film, throw=False)
    pressure, least = 1e-9 * cycle["pressure_max"], 1e6 * cycle["minimum_film"]
    sys.stdout.write(
        f"cycle, {name}, {film.nodes[0]} x {film.nodes[1]}: "
        f"{time.process_time() - begin:.0f} s processor, {time.perf_counter() - tick:.0f} s wall, "
        f"{cycle.failures} steps not converged, longest {cycle['seconds'][1:].max():.1f} s; "
        f"{pressure.min():.3f} to {pressure.max():.3f} GPa, "
        f"{least.min():.3f} to {least.max():.3f} um\n"
    )
    sys.stdout.flush()


if __name__ == "__main__":
    if sys.argv[1:] == ["cycle"]:
        whole_cycle("uniform", jamali_2015_film("a"))
        dense = jamali_2015_film("a", nodes=(129, 257), grading=EXIT_GRADING)
        whole_cycle("dense at the exit", dense)
    else:
        for mesh in MESHES[::-1]:
            step_times(mesh, int(sys.argv[1]) if len(sys.argv) > 1 else 8)
