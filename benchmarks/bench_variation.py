"""Cost of many points to the process that runs them: `python -m benchmarks.bench_variation`.

    python -m benchmarks.bench_variation [POINTS] [SECONDS] [JOBS] [map|helical|contact]

Each point is checked as one of `gearlube vary STUDY` is, but then waits SECONDS in place of
computing, so that what is measured is the cost of the bookkeeping alone. Each has 60 numbers.
"""

from __future__ import annotations

import logging
import resource
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from gearlube.variation.design import Design, Point, Sampling, Spread, Value
from gearlube.variation.keys import Keys
from gearlube.variation.point_study import PointStudy, Quantity, point_study

_LOGGER = logging.getLogger("bench_variation")
NUMBERS = 60
SPREADS = {
    "map": (
        Spread(key="pinion.bearing.preload_n", low=2e3, high=3e3, mean=2500.0, deviation=167.0),
        Spread(key="gear_set.backlash_um", low=120.0, high=180.0),
        Spread(key="gear_set.roughness_rms_um", low=0.4, high=0.6, mean=0.5, deviation=0.03),
    ),
    "helical": (
        Spread(key="operation.pinion_torque_n_m", low=100.0, high=300.0),
        Spread(key="pinion.flank.lead_slope_um", low=-10.0, high=10.0),
        Spread(key="oil.temperature_degc", low=40.0, high=90.0),
    ),
    "contact": (
        Spread(key="misalignment.pinion_offset_um", low=-50.0, high=50.0),
        Spread(key="misalignment.pinion_axial_um", low=-50.0, high=50.0),
        Spread(key="pinion.machine.tilt_angle_deg", low=31.7, high=31.77),
    ),
}


@dataclass(frozen=True, kw_only=True)
class WaitingStudy:
    """Checks of a point of another study, and a wait instead of its computation."""

    other: PointStudy
    seconds: float
    name: str = "wait"
    subject: str = "nothing"
    block: int = 50
    shown: tuple[str, ...] = ("number_0",)

    @property
    def keys(self) -> Keys:
        return self.other.keys

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        return tuple(Quantity(f"number_{i}", "1", "a number") for i in range(NUMBERS))

    @property
    def identity(self) -> str:
        return self.other.identity

    def prepared(self, texts: Mapping[str, tuple[Value, ...]]) -> WaitingStudy:
        return self

    def scatter(self) -> tuple[Spread, ...]:
        return self.other.scatter()

    def check(self, point: Point) -> None:
        self.other.check(point)

    def compute(self, point: Point) -> Sequence[float]:
        time.sleep(self.seconds)
        return [float(i) for i in range(NUMBERS)]


def megabytes() -> float:
    """Return the largest memory of this process so far [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main(points: int, seconds: float, jobs: int, name: str) -> None:
    """Run, run again, summarise; tell what this process took."""
    # here, so that the processes, which read this module, do not load them
    from gearlube.variation.run import run_variation
    from gearlube.variation.store import open_variation
    from gearlube.variation.summary import write_summary

    study = WaitingStudy(other=point_study(name), seconds=seconds)
    design = Design(spreads=SPREADS[name], sampling=Sampling("random", points))
    seen: list[float] = []

    def progress(share: float, sentence: str) -> None:
        if share > 0.1:  # by then all is imported and the design is drawn
            seen.append(megabytes())

    with tempfile.TemporaryDirectory() as folder:
        began, cpu = time.perf_counter(), time.process_time()
        run_variation(study, design, out=folder, jobs=jobs, progress=progress)
        took, cpu = time.perf_counter() - began, time.process_time() - cpu
        ideal = points * seconds / jobs
        _LOGGER.info("%d points of %g s on %d processes: %.0f s", points, seconds, jobs, took)
        _LOGGER.info("time over that of the points alone, %.0f s: %.3f", ideal, took / ideal)
        _LOGGER.info("processor time of this process: %.2f ms a point", 1e3 * cpu / points)
        grown = 1024.0 * (seen[-1] - seen[0]) / (0.9 * points)
        _LOGGER.info(
            "memory of this process: %.0f MB; grown by %.2f kB a point over the last nine tenths",
            seen[-1], grown,
        )  # fmt: skip
        began = time.perf_counter()
        again = run_variation(study, design, out=folder, jobs=jobs)
        _LOGGER.info(
            "all there: %.2f s for %d points, %d computed",
            time.perf_counter() - began, points, again.computed,
        )  # fmt: skip
        for name in ("0", "1"):
            (Path(folder) / "results.zarr" / "status" / name).unlink()
        began = time.perf_counter()
        again = run_variation(study, design, out=folder, jobs=1)
        rest = time.perf_counter() - began - seconds * again.computed
        _LOGGER.info("two blocks lost: %.2f s beside the %d points", rest, again.computed)
        began = time.perf_counter()
        open_variation(folder)
        _LOGGER.info("opened: %.2f s", time.perf_counter() - began)
        began = time.perf_counter()
        write_summary(Path(folder))
        _LOGGER.info("statistics and tables: %.1f s", time.perf_counter() - began)


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    given = [*sys.argv[1:], *("10000", "0.1", "2", "map")[len(sys.argv) - 1 :]]
    main(int(given[0]), float(given[1]), int(given[2]), given[3])
