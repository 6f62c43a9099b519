"""Cost of tooth contact analysis: `pytest -n 0 benchmarks/bench_contact.py --benchmark-only`.

`python -m benchmarks.bench_contact` times the whole mesh table: from nothing, and with tooth
compliances or positions on disk.
"""

from __future__ import annotations

import logging
import math
import tempfile
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
from pytest_benchmark.fixture import BenchmarkFixture

from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_contact.gap_map import gap_map
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.sensitivity.analysis import error_rates
from gearlube_core.hypoid_contact.sensitivity.loaded_rates import loaded_rates
from gearlube_core.hypoid_contact.sensitivity.parameter import Variations, usual_parameters
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_contact.unloaded_error import unloaded_error
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.process_pool import single_threaded
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_contact.coupled_strips import PairStiffness

_LOGGER = logging.getLogger("bench_contact")
FILE = HypoidGearFile.named("mohammadpour_2015")
TORQUE = 100.0  # N.m


@cache
def drive_pair() -> FlankPair:
    return FlankPair.from_file(FILE, "drive")


@cache
def drive_stiffness() -> PairStiffness:
    return pair_stiffness(FILE, ToothBodySettings())["drive"]


def test_path_of_200_positions(benchmark: BenchmarkFixture) -> None:
    angles = np.linspace(-0.4, 1.4, 200) * drive_pair().gear_pitch
    benchmark(contact_path, drive_pair(), angles)


def test_gap_over_a_tooth(benchmark: BenchmarkFixture) -> None:
    benchmark(gap_map, drive_pair(), 0.0, 0.0)


def test_loaded_position(benchmark: BenchmarkFixture) -> None:
    position = MeshPosition.at(drive_pair(), 0.3)
    benchmark(position.load, TORQUE, drive_stiffness(), LoadedSettings())


def test_loaded_position_on_fine_cells(benchmark: BenchmarkFixture) -> None:
    position = MeshPosition.at(drive_pair(), 0.3)
    fine = LoadedSettings(cells_across=64, cells_along=96)
    benchmark(position.load, TORQUE, drive_stiffness(), fine)


def time_rates() -> None:
    """Log what all derivatives cost in analyses, both timed turn by turn; least of five."""
    names = usual_parameters(FILE)
    pair, teeth = drive_pair(), drive_stiffness()
    variations = Variations.of(FILE, pair, names)
    error = unloaded_error(pair, 33)
    state = MeshPosition.at(pair, 0.3).load(TORQUE, teeth, LoadedSettings())

    def unloaded() -> None:
        unloaded_error(FlankPair.from_file(FILE, "drive"), 33)

    def position() -> None:
        MeshPosition.at(pair, 0.3).load(TORQUE, teeth, LoadedSettings())

    cases: dict[str, tuple[Callable[[], object], Callable[[], object]]] = {
        "unloaded error": (unloaded, lambda: error_rates(Variations.of(FILE, pair, names), error)),
        "loaded position": (position, lambda: loaded_rates(variations, state, teeth)),
    }
    with single_threaded():
        for what, (analysis, rates) in cases.items():
            least = [math.inf, math.inf]
            for _ in range(5):
                for k, run in enumerate((analysis, rates)):
                    began = time.perf_counter()
                    run()
                    least[k] = min(least[k], time.perf_counter() - began)
            _LOGGER.info(
                "%-16s %6.0f ms, derivatives by %d parameters %6.0f ms: %.1f times",
                *(what, 1e3 * least[0], len(names), 1e3 * least[1], least[1] / least[0]),
            )


def time_table() -> None:
    """Log the wall time of a full mesh table, by what lies on disk before."""
    with tempfile.TemporaryDirectory() as folder:
        cache_folder, store = Path(folder) / "cache", Path(folder) / "positions"
        for state, kept in (
            ("from nothing", None),
            ("tooth compliances on disk", None),
            ("tooth compliances on disk, positions kept", store),
            ("positions on disk", store),
        ):
            began = time.perf_counter()
            dataset = analyse_contact(FILE, ContactSettings(), store=kept, cache=cache_folder)
            contact_table(FILE, dataset)
            _LOGGER.info("%-42s %6.1f s", state, time.perf_counter() - began)


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    _LOGGER.setLevel(logging.INFO)
    time_rates()
    time_table()
