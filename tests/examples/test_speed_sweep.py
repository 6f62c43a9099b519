import importlib.util
import math
import re
from pathlib import Path

import numpy as np
import pytest

PATH = Path(__file__).parents[2] / "examples" / "speed_sweep.py"


def _example():
    spec = importlib.util.spec_from_file_location(PATH.stem, PATH)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.slow
def test_mesh_frequency_follows_the_vehicle_speed(tmp_path):
    results = _example().sweep(tmp_path)
    assert int(results["status"].sum()) == 6
    speed = results["speed_kmh"].values / 3.6
    # Zg V / (2 pi r_t) with r_t = 3.05 D / (2 pi) of a 195/65R16 tyre; the slip of the driven
    # tyres (0.5 % at most at this tractive force) is added.
    radius = 3.05 * 0.6599 / (2.0 * math.pi)
    expected = 36 * speed / (2.0 * math.pi * radius)
    np.testing.assert_allclose(results["mesh_frequency"].sel(preload=2500.0), expected, rtol=5e-3)
    report = (tmp_path / "report.html").read_text()
    figures = set(re.findall('<figure id="(.+?)"', report))
    assert figures >= {
        "operating_points",
        "dte_map",
        "dte_orders",
        "radial_map",
        "efficiency",
        "film",
    }
    assert figures >= {"bearing_force_map", "bearing_force_orders", "roller_map", "roller_zone"}
