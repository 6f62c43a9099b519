"""Cost of a rough film in motion: ridges that cross between cyclic sides, an Eyring oil.

`python -m benchmarks.bench_ehl_rough [steps]` marches the section of Jamali 2015 Table 7.1 on
801 x 64 nodes. Profiles of both surfaces without waves shorter than 24 um move with them at 8
degrees to the motion, to either side, and grow to Ra 0.31 um within 120 steps. It prints, for every
ten steps, the smallest film, the largest pressure, nodes with less than 10 nm, and means of one
step: Newton steps, Krylov iterations, processor and wall time.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.contact_domain import line_section
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import MovingFilm, moving_section
from gearlube_core.oil.film_oil_data import film_oil

NODES = (801, 64)
RADIUS, LENGTH, LINE_LOAD = 0.014, 2e-3, 3.6e5
SPEEDS = 7.9178, 5.5022  # m/s
WAVES = 24e-6, 150e-6  # shortest and longest [m]
PERIOD, ROUGHNESS, ANGLE, GROWTH = 4e-3, 0.31e-6, np.radians(8.0), 120


def ridges(seed: int, side: float) -> Callable[[Array, Array], Array]:
    """Return a height [m], periodic over `PERIOD` along x and `LENGTH` along y."""
    rng = np.random.default_rng(seed)
    count = np.arange(round(PERIOD / WAVES[1]), round(PERIOD / WAVES[0]) + 1)
    size = (
        rng.rayleigh(size=count.size) / np.sqrt(count) * np.exp(2j * np.pi * rng.random(count.size))
    )
    across = np.rint(side * count / PERIOD * np.tan(ANGLE) * LENGTH).astype(int)
    x = np.linspace(0.0, PERIOD, 8193)
    parts = {
        m: (size[across == m] * np.exp(2j * np.pi * np.outer(x, count[across == m]) / PERIOD)).sum(
            1
        )
        for m in np.unique(across)
    }
    profile = sum(parts.values()).real
    unit = ROUGHNESS / np.abs(profile - profile.mean()).mean()

    def height(x_: Array, y: Array) -> Array:
        place = np.mod(x_, PERIOD)
        total = np.zeros((x_.size, y.size))
        for m, part in parts.items():
            turn = np.exp(2j * np.pi * m * y / LENGTH)
            total += (np.interp(place, x, part)[:, None] * turn).real
        return unit * total

    return height


def rough_film() -> tuple[MovingFilm, float]:
    """Return the film and its time step: half a node of the fast surface."""
    section = line_section(
        R_x=RADIUS,
        length=LENGTH,
        line_load=LINE_LOAD,
        speed_1=SPEEDS[0],
        speed_2=SPEEDS[1],
        contact_modulus=0.5 * 227.5e9,
        lubricant=film_oil(eta0=0.00625, alpha=13.3e-9, eyring_stress=10e6),
        nodes=NODES,
    )
    step = 0.5 * (section.x_limits[1] - section.x_limits[0]) / (NODES[0] - 1) / SPEEDS[0]
    surfaces = (ridges(1, 1.0), SPEEDS[0]), (ridges(2, -1.0), SPEEDS[1])

    def heights(x: Array, y: Array, time: float) -> Array:
        grown = min(time / (GROWTH * step), 1.0)
        if grown == 0.0:
            return np.zeros((x.size, y.size))
        one, other = (height(x - speed * time, y) for height, speed in surfaces)
        return grown * (one + other)

    return moving_section(section, heights, SolidContact()), step


def march(steps: int) -> None:
    """Print what ten steps each cost and find."""
    film, step = rough_film()
    run = FilmMarch(film, step)
    rows = []
    for count in range(1, steps + 1):
        begin, tick = time.process_time(), time.perf_counter()
        found = run.step(throw=False)
        rows.append(
            (
                found.newton_steps,
                found.krylov_steps,
                time.process_time() - begin,
                time.perf_counter() - tick,
                "parts" in found.outcome,
                not found.converged,
            )
        )
        if count % 10 == 0:
            newton, krylov, processor, wall, parts, failed = np.array(rows[-10:], float).T
            sys.stdout.write(
                f"steps {count - 9}-{count} ({min(count / GROWTH, 1.0):.2f} of the roughness): "
                f"smallest film {1e9 * found.minimum_film:.1f} nm, largest pressure "
                f"{1e-9 * found.maximum_pressure:.2f} GPa, {(found.film < 1e-8).sum()} nodes below "
                f"10 nm; Newton {newton.mean():.1f}, Krylov {krylov.mean():.0f}, processor "
                f"{processor.mean():.2f} s, wall {wall.mean():.2f} s a step; in parts "
                f"{parts.sum():.0f}, not converged {failed.sum():.0f}\n"
            )
            sys.stdout.flush()


if __name__ == "__main__":
    march(int(sys.argv[1]) if len(sys.argv) > 1 else 120)
