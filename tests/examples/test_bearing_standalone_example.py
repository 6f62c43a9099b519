import importlib.util
import math
from pathlib import Path

import pytest

PATH = Path(__file__).parents[2] / "examples" / "roller_bearing_standalone.py"


def _example():
    spec = importlib.util.spec_from_file_location(PATH.stem, PATH)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_clearance_makes_the_shaft_move_as_rollers_pass():
    example = _example()
    rolling, amplitude = example.strongest_line(-example.FIT)
    _, still = example.strongest_line(example.FIT)
    # N ri/(ri + ro) w/(2 pi); the record holds whole roller passes, so the line is exact
    assert rolling == pytest.approx(12 * 25 / 62.7 * 209 / (2 * math.pi), rel=1e-9)
    # 64.4 nm at eight times finer steps as well
    assert amplitude == pytest.approx(64.4e-9, rel=1e-3)
    assert still < 1e-3 * amplitude
