"""Kernels for a law from outside are kept on disk while the law's file is unchanged."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

OWN = """
from gearlube_core.oil.film_oil import viscosity
from gearlube_core.oil.film_oil_data import film_oil
viscosity(film_oil(eta0=0.05, alpha=2e-8), 1e8)
"""
FOREIGN = """
from foreign_law import Linear
viscosity(film_oil(eta0=0.05, law=Linear(1e-8)), 1e8)
"""
LAW = """
from typing import NamedTuple
from gearlube_core.kernels.jit import kernel

class Linear(NamedTuple):
    slope: float

    @kernel
    def log_viscosity(self, p, cooling):
        return self.slope * p, self.slope
"""
TELL = """
print(sum(viscosity.stats.cache_hits.values()), sum(viscosity.stats.cache_misses.values()))
"""


def hits_and_misses(script: str, *places: Path, cache: Path) -> str:
    root = Path(__file__).parents[2]
    path = os.pathsep.join(str(place) for place in (root, *places))
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache), "PYTHONPATH": path}
    done = subprocess.run(
        [sys.executable, "-c", script + TELL],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.mark.slow  # a changed source is in the default run, test_compiled_cache
def test_a_process_without_the_law_reads_what_one_with_it_left(tmp_path):
    (tmp_path / "foreign_law.py").write_text(LAW)
    cache = tmp_path / "cache"
    assert hits_and_misses(OWN + FOREIGN, tmp_path, cache=cache) == "0 2"
    # numba reads the types of all specialisations at once: one it cannot import would stop it
    assert hits_and_misses(OWN, cache=cache) == "1 0"
    assert hits_and_misses(OWN + FOREIGN, tmp_path, cache=cache) == "2 0"
    (tmp_path / "foreign_law.py").write_text(
        LAW.replace("self.slope * p,", "2.0 * self.slope * p,")
    )
    assert hits_and_misses(OWN + FOREIGN, tmp_path, cache=cache) == "1 1"
