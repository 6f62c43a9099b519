"""Rough line films in time: contact against the lambda ratio, for seeds and speeds."""

from __future__ import annotations

import csv
import logging
import math
import time
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.transient import LineHistory, LineMarch
from gearlube_core.ehl.statistics.rough_film import RoughFilmStatistics
from gearlube_core.ehl.statistics.zone import FilmZone
from gearlube_core.oil.film_oil_data import jamali_2015_oil
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.surface.extrusion import Lay
from gearlube_core.surface.generator import generated_profile
from gearlube_core.surface.generator_request import RoughnessRequest
from gearlube_core.surface.heights import Profile
from gearlube_core.surface.moving import GrownInPlace, MovingRoughness, MovingSurface
from gearlube_core.surface.schedule import RoughSchedule

KEPT = Path(__file__).parent / "lines.csv"
SEEDS, SPEEDS = (1, 2, 3, 4, 5), (1.0, 2.0, 4.0)  # speeds over 6.71 m/s
NODES, ROUGHNESS = 401, 0.25e-6  # Rq of each surface [m]
_PERIOD, _POINTS, _WIDTH, _ROWS = 1.0e-3, 640, 1e-3, 16  # m
_REQUEST = RoughnessRequest(
    root_mean_square=ROUGHNESS,
    correlation_length=10e-6,
    shortest_wave=24e-6,  # ten nodes
    longest_wave=100e-6,
)
_MEAN, _SLIDE_ROLL = 6.71, 0.3632  # [jamali_2015 Table 7.1]
# half-widths that the faster surface moves: growth of the roughness; and that the slower one moves
# until what entered smooth has left; then what is gathered
_GROWN, _FORGOTTEN, _GATHERED = 1.0, 2.5, 2.0
_STEPS = 100  # in which the faster surface moves a half-width, a node each
logger = logging.getLogger("docs.rough_contact")


@dataclass(frozen=True, slots=True, kw_only=True)
class RoughLine:
    """Means over time of one run."""

    seed: int
    speed: float  # over 6.71 m/s
    lambda_smooth: float
    lambda_mean: float
    below_1_nm: float  # shares of the Hertzian zone
    below_5_nm: float
    below_10_nm: float
    below_25_nm: float
    pressure_max: float  # mean over time of the largest pressure [Pa]
    steps: int
    failures: int
    seconds: float


def rough_profile(seed: int) -> Profile:
    """Return a periodic profile of a seed."""
    random = np.random.default_rng(seed)
    return generated_profile(_REQUEST, _PERIOD, _POINTS, random).surface


def rough_line(seed: int, speed: float) -> RoughLine:
    """Return a run of the line contact of [jamali_2015 7.7] with two made profiles."""
    began = time.process_time()
    fast, slow = (speed * _MEAN * (1.0 + share * _SLIDE_ROLL) for share in (0.5, -0.5))
    contact = LineProblem(
        lubricant=jamali_2015_oil(),
        radius=0.014,
        line_load=360e3,
        reduced_modulus=227.5e9,
        speed_1=fast,
        speed_2=slow,
    )
    a = contact.half_width
    settings = LineSettings(nodes=NODES)
    problem = LineProblem(
        **{f.name: getattr(contact, f.name) for f in fields(contact) if f.name != "domain"},
        domain=(-2.5 * a, 1.5 * a),
    )
    smooth = solve_line(problem, settings)
    schedule = RoughSchedule.by_travel(
        length=a,
        fast=fast,
        slow=slow,
        until_rough=_GROWN * slow / fast + _FORGOTTEN,
        rough=_GATHERED,
        steps=_STEPS,
    )
    surfaces = tuple(
        MovingSurface(
            heights=rough_profile(one),
            lay=Lay(period=_PERIOD, width=_WIDTH, turns=0),
            speed=u,
        )
        for one, u in ((seed, fast), (100 + seed, slow))
    )
    rows = _WIDTH / _ROWS * np.arange(float(_ROWS))
    rough = MovingRoughness(
        surfaces=surfaces,
        x=smooth.x,
        y=rows,
        schedule=schedule,
        feed=GrownInPlace(duration=_GROWN * a / fast),
    )

    def gap(x: Array, t: float) -> Array:
        return np.asarray(x * x / (2.0 * contact.radius) - rough(x, rows[:1], t)[:, 0])

    centre = int(np.abs(smooth.x).argmin())
    statistics = RoughFilmStatistics(
        zone=FilmZone.line(smooth.x, rows[:4], a),
        roughness=math.sqrt(2.0) * ROUGHNESS,
        smooth_film=float(smooth.film[centre]),
    )
    march = LineMarch(smooth, LineHistory(gap=gap), schedule.time_step)
    failures = 0
    for step in range(schedule.steps):
        film = march.step(throw=False)
        failures += not film.converged
        if step >= schedule.until_rough:
            repeated = np.ones(4)
            statistics.add(
                march.time, np.outer(film.film, repeated), np.outer(film.pressure, repeated)
            )
    found = statistics.dataset()
    shares = [float(one) for one in found.contact_share.mean("time")]
    return RoughLine(
        seed=seed,
        speed=speed,
        lambda_smooth=found.attrs["lambda_smooth"],
        lambda_mean=float(found.lambda_mean.mean()),
        below_1_nm=shares[0],
        below_5_nm=shares[1],
        below_10_nm=shares[2],
        below_25_nm=shares[3],
        pressure_max=float(found.pressure_max.mean()),
        steps=schedule.steps,
        failures=failures,
        seconds=time.process_time() - began,
    )


def read_lines(path: Path = KEPT) -> list[RoughLine]:
    """Return the runs that are kept."""
    if not path.exists():
        return []
    whole = {"seed", "steps", "failures"}
    with path.open(encoding="utf-8", newline="") as file:
        return [
            RoughLine(**{k: int(v) if k in whole else float(v) for k, v in row.items()})  # type: ignore[arg-type]
            for row in csv.DictReader(file)
        ]


def solve_lines(path: Path = KEPT) -> list[RoughLine]:
    """Solve the runs that are missing and keep them; return all."""
    runs = read_lines(path)
    for seed in SEEDS:
        for speed in SPEEDS:
            if any((one.seed, one.speed) == (seed, speed) for one in runs):
                continue
            runs.append(rough_line(seed, speed))
            logger.info("%s", runs[-1])
            names = [one.name for one in fields(RoughLine)]
            lines = [",".join(f"{asdict(one)[n]:.6g}" for n in names) for one in runs]
            write_text("\n".join([",".join(names), *lines]) + "\n", path)
    return runs


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    solve_lines()
