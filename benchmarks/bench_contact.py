"""Cost of tooth contact analysis: `pytest -n 0 benchmarks/bench_contact.py --benchmark-only`.

`python -m benchmarks.bench_contact` times the whole mesh table: from nothing, and with tooth
compliances or positions on disk.
"""

from __future__ import annotations

import logging
import tempfile
import time
from functools import cache
from pathlib import Path

import numpy as np
from pytest_benchmark.fixture import BenchmarkFixture

from gearlube_core.hypoid_contact.analysis import ContactSettings, analyse_contact
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_contact.gap_map import gap_map
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
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
    time_table()
