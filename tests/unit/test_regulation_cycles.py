"""Driving cycles of regulations have the phases, lengths and sums that these count."""

from __future__ import annotations

import sys
from types import ModuleType

import numpy as np
import pytest

import gearlube as gl
from drivetrain.cycle.traces import EXTRA_URBAN, URBAN
from gearlube_core.errors import ParameterError


def test_nedc_has_the_phases_that_the_regulation_counts():
    """[unece_2012 Annex 4a, 6.1.1]: seconds at rest and at speed of an urban cycle."""
    ends = [0, *(end for _, end in URBAN)]
    rows = list(zip(URBAN, ends, strict=False))
    rest = sum(s for (s, end), before in rows if end == before == 0)
    steady = sum(s for (s, end), before in rows if end == before > 0)
    gaining = sum(s for (s, end), before in rows if end > before)
    losing = sum(s for (s, end), before in rows if end < before)
    assert (rest, steady, gaining, losing) == (60, 57 + 8, 36, 25 + 9)  # 8 s change gears
    assert sum(s for s, _ in EXTRA_URBAN) == 400


def test_nedc_has_length_time_and_highest_speed_of_the_regulation():
    cycle = gl.studies.DriveCycle.named("nedc")
    assert cycle.duration == 1180.0
    assert cycle.speed.max() == pytest.approx(120.0 / 3.6, rel=1e-12)
    # 4.052 and 6.955 km are stated, rounded over corners that the tables do not have
    assert cycle.distance == pytest.approx(11_007.0, rel=0.003)
    assert np.abs(np.diff(cycle.speed)).max() == pytest.approx(50.0 / 3.6 / 10.0, rel=1e-12)


def test_nedc_is_that_of_a_package_a_second_apart():
    held = pytest.importorskip("wltp.cycles.nedc").cycle_data()["cycle"]
    ours = 3.6 * gl.studies.DriveCycle.named("nedc").speed
    # where the package is late or early by a second; two accelerations are rounded there
    assert np.abs(ours[1:] - np.array(held)).max() <= 3.1
    assert np.mean(np.abs(ours[1:] - np.array(held)) > 0.02) < 0.05


def test_wltc_has_the_sums_of_the_regulation():
    pytest.importorskip("wltp.cycles.class3")
    cycle = gl.studies.DriveCycle.named("wltc")
    assert cycle.time.size == 1801
    assert cycle.distance == pytest.approx(23_266.3, abs=0.1)
    assert 3.6 * cycle.speed.max() == pytest.approx(131.3, abs=1e-9)


def test_ftp75_has_the_length_of_the_regulation():
    pytest.importorskip("fastsim")
    cycle = gl.studies.DriveCycle.named("ftp75")
    assert cycle.time.size == 1875
    assert cycle.distance == pytest.approx(17_769.0, abs=2.0)
    assert cycle.speed[-505:].tolist() == cycle.speed[1:506].tolist()


@pytest.mark.parametrize(("cycle", "package"), [("wltc", "wltp"), ("ftp75", "fastsim")])
def test_a_missing_package_is_named_with_its_cure(monkeypatch, cycle, package):
    for name in (package, "wltp.cycles", "wltp.cycles.class3"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ParameterError, match=rf"{package}, which is not inst.*gearlube\[cycles\]"):
        gl.studies.DriveCycle.named(cycle)


def test_a_trace_that_is_not_the_regulations_is_refused(monkeypatch):
    module = ModuleType("wltp.cycles.class3")
    module.class_data_b = lambda: {"cycle": [0.0] * 1801}
    for name in ("wltp", "wltp.cycles", "wltp.cycles.class3"):
        monkeypatch.setitem(sys.modules, name, module)
    with pytest.raises(ParameterError, match=r"must have 1801, 83758\.6; got 1801 speeds with sum"):
        gl.studies.DriveCycle.named("wltc")
    del module.class_data_b
    with pytest.raises(ParameterError, match="does not hold its trace"):
        gl.studies.DriveCycle.named("wltc")
