import importlib.util
from pathlib import Path

import numpy as np
import pytest

from tests.helpers.fmu_cases import HYPOID_AXLE
from tests.helpers.native_fmus import native_fmus

PATH = Path(__file__).parents[2] / "examples" / "simulate_fmu.py"
# Mohammadpour et al. 2015, Table A1: inertias [kg m2] and tooth numbers
PINION_INERTIA, GEAR_INERTIA, RATIO = 1734e-6, 5.81e-2, 36 / 13


def _example():
    spec = importlib.util.spec_from_file_location(PATH.stem, PATH)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_axle_gathers_the_speed_that_its_efficiency_leaves_it():
    native_fmus(HYPOID_AXLE)  # the library is kept: the example needs none of its own
    example = _example()
    result = example.main()
    assert result["time"][-1] == pytest.approx(0.2)
    held = np.interp(result["time"], example.TIMES, example.TORQUES)[:-1]
    inertia = PINION_INERTIA + GEAR_INERTIA / RATIO**2
    acceleration = (result["axle.efficiency"][1:] * held - example.LOAD / RATIO) / inertia
    gained = np.sum(acceleration * np.diff(result["time"]))
    speed = result["pinion.speed"]
    # rigid bodies: the elastic axle stores less than 0.2 % of the energy it passes on
    assert speed[-1] - speed[0] == pytest.approx(gained, rel=2e-3)
    # 503.2590 rad/s at four times finer inner steps
    assert speed[-1] == pytest.approx(503.259, abs=2e-3)
