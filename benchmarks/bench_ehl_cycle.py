"""Cost and accuracy of the film of a helical pair through its meshing cycle.

`python -m benchmarks.bench_ehl_cycle [steps]` marches design A of Jamali 2015 (Eyring oil) on his
mesh of 182 x 857 nodes, on one of 129 x 257 that is dense where the film leaves the contact, and
on the default mesh, a few steps at the beginning, in the middle and towards the end of the cycle;
it prints processor and wall time of one step, the 575 steps at that rate with the steady start,
and the peak memory. With "cycle" the whole cycle is marched on the last two. With "accuracy" 24
steps are marched on all of them from rest at those places, or at the steps that follow, and on
twice the thesis' nodes across: a surface crosses the contact in 17 steps. What is printed is the
largest difference over the last 22 steps of the largest pressure, the smallest film and the
friction, and that of all films under pressure at the last.
"""

from __future__ import annotations

import os
import resource
import statistics
import sys
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from scipy.interpolate import RectBivariateSpline

from gearlube_core.ehl.gears.helical_film import EXIT_GRADING, HelicalFilm, march_helical_cycle
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.oil.film_oil import film_properties
from tests.helpers.jamali_2015 import jamali_2015_film

Mesh = tuple[str, tuple[int, int], tuple[tuple[float, float], ...]]
THESIS: Mesh = ("that of the thesis", (182, 857), ())
DENSE: Mesh = ("dense at the exit", (129, 257), EXIT_GRADING)
COARSE: Mesh = ("dense at the exit", (129, 129), EXIT_GRADING)
DEFAULT: Mesh = ("uniform", (97, 257), ())
REFERENCE: Mesh = ("reference", (363, 257), ())
PLACES = (100, 300, 490)  # steps of the cycle
SETTLING = 4  # steps after the film at rest, which cost more: the preconditioner is built
STRETCH = 24  # steps
LOADED, PRESSED = 1e6, 50e6  # Pa, from which on oil shears and films are compared


def film_on(mesh: Mesh) -> HelicalFilm:
    """Return the film of design A on a mesh."""
    return jamali_2015_film("a", nodes=mesh[1], grading=mesh[2])


def named(mesh: Mesh) -> str:
    """Return what the lines of a mesh begin with."""
    return f"{mesh[1][0]} x {mesh[1][1]}, {mesh[0]}"


def step_times(mesh: Mesh, steps: int) -> None:
    """Print what the start and single steps cost on a mesh."""
    film = film_on(mesh)
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
        f"{named(mesh)}: start {start:.1f} s, step {mean:.2f} s (processor; "
        f"{statistics.mean(wall):.2f} s wall, longest {max(processor):.2f} s), {count} steps "
        f"{(start + count * mean) / 60.0:.1f} min, {failed} of {len(wall)} not converged, "
        f"peak {peak:.0f} MiB\n"
    )
    sys.stdout.flush()


def whole_cycle(mesh: Mesh) -> None:
    """March all steps and print what they cost and find."""
    film = film_on(mesh)
    begin, tick = time.process_time(), time.perf_counter()
    cycle = march_helical_cycle(film, throw=False)
    pressure, least = 1e-9 * cycle["pressure_max"], 1e6 * cycle["minimum_film"]
    sys.stdout.write(
        f"cycle, {named(mesh)}: "
        f"{time.process_time() - begin:.0f} s processor, {time.perf_counter() - tick:.0f} s wall, "
        f"{cycle.failures} steps not converged, longest {cycle['seconds'][1:].max():.1f} s; "
        f"{pressure.min():.3f} to {pressure.max():.3f} GPa, "
        f"{least.min():.3f} to {least.max():.3f} um\n"
    )
    sys.stdout.flush()


def friction(film: HelicalFilm, found: FilmSolution) -> float:
    """Return the shear force of both signs, that of an Eyring film between even surfaces [N]."""
    oil = film.lubricant
    speed_1, speed_2 = film.surface_speeds(found.y, film.line(found.time))
    viscosity = film_properties(oil, np.ascontiguousarray(found.pressure))[0]
    rate = np.abs(speed_2 - speed_1) / (found.film * oil.shear.tau0)
    stress = oil.shear.tau0 * np.arcsinh(viscosity * rate)
    stress[found.pressure < LOADED] = 0.0
    return float(np.trapezoid(np.trapezoid(stress, found.x, axis=0), found.y))


def stretch(mesh: Mesh, place: int) -> tuple[np.ndarray, FilmSolution]:
    """Return pressure, film and friction of the steps after a film at rest, and the last film."""
    film = film_on(mesh)
    march = FilmMarch(film.moving_film(), film.time_step, start_time=place * film.time_step)
    rows = []
    for _ in range(STRETCH):
        found = march.step(throw=False)
        rows.append((found.maximum_pressure, found.minimum_film, friction(film, found)))
    return np.array(rows[2:]), found


def differences(one: FilmSolution, other: FilmSolution) -> tuple[float, float]:
    """Return root mean square and largest of film over film less 1, under pressure [-].

    On the rows of the coarser mesh, so that its films are not interpolated along the line.
    """
    x, y = one.x[1:-1], min(one.y, other.y, key=len)
    p, h, h_other = (
        RectBivariateSpline(found.x, found.y, field)(x, y)
        for found, field in ((other, other.pressure), (one, one.film), (other, other.film))
    )
    off = (h / h_other - 1.0)[p > PRESSED]
    return float(np.sqrt((off**2).mean())), float(np.abs(off).max())


def accuracy(places: tuple[int, ...]) -> None:
    """Print how far meshes are off the reference and off the thesis' mesh while the line moves."""
    meshes = (REFERENCE, THESIS, DENSE, COARSE, DEFAULT)
    for place in places:
        found = [stretch(mesh, place) for mesh in meshes]
        for k in range(2):
            curves, last = found[k]
            for mesh, (own, end) in zip(meshes[k + 1 :], found[k + 1 :], strict=True):
                off = 100.0 * np.abs(own / curves - 1.0).max(axis=0)
                mean, most = differences(end, last)
                sys.stdout.write(
                    f"from step {place}, {named(mesh)}, off {named(meshes[k])}: largest pressure "
                    f"{off[0]:.3f} %, smallest film {off[1]:.2f} %, friction {off[2]:.3f} %; films "
                    f"{100.0 * mean:.2f} % (root mean square), {100.0 * most:.1f} % at most\n"
                )
        sys.stdout.flush()


if __name__ == "__main__":
    if sys.argv[1:2] == ["cycle"]:
        for mesh in (DEFAULT, DENSE):
            whole_cycle(mesh)
    elif sys.argv[1:2] == ["accuracy"]:
        accuracy(tuple(int(place) for place in sys.argv[2:]) or PLACES)
    else:
        for mesh in (DEFAULT, DENSE, THESIS):
            step_times(mesh, int(sys.argv[1]) if len(sys.argv) > 1 else 8)
