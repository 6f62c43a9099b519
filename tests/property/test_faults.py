"""Faults as they happen: two runs at once, a parent killed, a full disk, damaged kernels."""

from __future__ import annotations

import os
import random
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

ROOT = Path(__file__).parents[2]
STUDY = """
import sys
from gearlube.variation import run
from gearlube.variation.design import Axis, Design
from gearlube_core.errors import GearLubeError
from gearlube.cli.exit_codes import exit_on_error
from tests.helpers.variation_stand_in import AreaStudy
run.code_hash = lambda: "code"
run._compile = lambda study, design: None
if __name__ == "__main__":
    design = Design(axes=(Axis("width_mm", tuple(float(w) for w in range(40))),))
    with exit_on_error():
        study = AreaStudy(seconds=float(sys.argv[3]))
        done = run.run_variation(study, design, out=sys.argv[1], jobs=int(sys.argv[2]), block=1)
        print(done.computed)
"""
LAW = """
import math
from gearlube_core.kernels.jit import kernel
@kernel
def inner(x):
    return math.exp(x) + x * x
@kernel
def outer(x):
    return inner(x) + inner(x + 1.0)
"""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="signals and limits of Unix"),
]


def study(folder: Path, jobs: int, seconds: float, before: str = "") -> subprocess.Popen[str]:
    """Start 40 blocks that take `seconds` each; `before` are commands of the shell."""
    script = folder / "study.py"
    script.write_text(STUDY)
    command = [sys.executable, str(script), str(folder / "out"), str(jobs), str(seconds)]
    return subprocess.Popen(
        ["bash", "-c", f'{before} exec "$@"', "bash", *command],
        env=dict(os.environ, PYTHONPATH=str(ROOT)),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def blocks(folder: Path) -> int:
    status = folder / "out/results.zarr/status"
    return sum(one.name.isdecimal() for one in status.iterdir()) if status.is_dir() else 0


def until(condition, seconds: float = 60.0) -> None:
    limit = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < limit
        time.sleep(0.05)


@pytest.mark.parametrize("pause", [0.0, 0.1, 2.0])
def test_of_two_runs_at_once_one_is_refused_and_nothing_is_lost(tmp_path, pause):
    first = study(tmp_path, 1, 0.1)
    time.sleep(pause)
    second = study(tmp_path, 1, 0.1)
    ended = [(one.communicate(timeout=120.0), one.returncode) for one in (first, second)]
    refused = [said for (_, said), code in ended if code]
    assert sorted(code for _, code in ended) == [0, 1], ended
    assert re.search(r"where process \d+ on .*, started 2.*, writes", refused[0])
    assert blocks(tmp_path) == 40
    again = study(tmp_path, 1, 0.1)
    assert again.communicate(timeout=60.0)[0] == "0\n"


def test_after_a_kill_no_worker_is_left_and_finished_blocks_are_kept(tmp_path):
    parent = study(tmp_path, 2, 0.3)
    until(lambda: blocks(tmp_path) >= 6)
    # the process that minds semaphores ends by itself, as it cleans up
    workers = psutil.Process(parent.pid).children(recursive=True)
    assert len(workers) >= 2
    kept = blocks(tmp_path)
    parent.kill()
    _, left = psutil.wait_procs(workers, timeout=15.0)
    assert left == []
    again = study(tmp_path, 2, 0.01)
    said = again.communicate(timeout=120.0)
    assert 0 < int(said[0]) <= 40 - kept, said
    assert blocks(tmp_path) == 40


@pytest.mark.parametrize("megabytes", [600, 650, 700])
def test_too_little_memory_ends_with_a_message(tmp_path, megabytes):
    """The parent or its workers can start no thread, or there is just enough."""
    run = study(tmp_path, 2, 0.0, f"ulimit -v {megabytes * 1000};")
    out, said = run.communicate(timeout=60.0)
    assert out == "40\n" or "too little memory" in said or "want of memory" in said, said


def test_damaged_kernels_are_compiled_again(tmp_path):
    (tmp_path / "law.py").write_text(LAW)
    cache = tmp_path / "cache"
    environment = dict(
        os.environ,
        NUMBA_CACHE_DIR=str(cache),
        PYTHONPATH=os.pathsep.join((str(tmp_path), str(ROOT))),
    )

    def result() -> tuple[int, str]:
        command = [sys.executable, "-c", "from law import outer; print(outer(1.0))"]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    good = result()
    assert good[0] == 0
    shutil.copytree(cache, tmp_path / "good")
    drawn = random.Random(2)
    for number in range(30):
        shutil.rmtree(cache)
        shutil.copytree(tmp_path / "good", cache)
        path = drawn.choice(sorted(cache.rglob("*.nb?")))
        bad = bytearray(path.read_bytes())
        for _ in range(3):
            bad[drawn.randrange(len(bad))] ^= 1 << drawn.randrange(8)
        path.write_bytes(bad if number % 3 else bad[: drawn.randrange(len(bad))])
        assert result() == good, path
