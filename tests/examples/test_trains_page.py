"""The code of docs/trains.md runs as it stands, page from top to bottom."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "trains.md"


@pytest.mark.slow
def test_the_code_of_the_page_runs(capsys):
    space: dict[str, Any] = {"__name__": "__main__"}  # as a script of its own
    for block in re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL):
        exec(compile(block, "page", "exec", dont_inherit=True), space)  # own text
    dte, lost = map(float, capsys.readouterr().out.split()[:2])  # what is printed first
    # 4.5 kN on lines of 13 N/(um mm) over about 50 mm give 7 um, and bearings as much again
    assert 5e-6 < dte < 3e-5
    # 0.5 to 1.2 % of 15.4 kW in each of two meshes, for a millisecond
    assert 0.15 < lost < 0.37
    # the propshaft carries what the motor gives
    assert space["driven"].outputs()["propshaft.torque"] == pytest.approx(50.0, rel=1e-6)
    before = space["braked"].lost["brake"]
    space["braked"].step(1e-3, space["torques"], 333.15)
    # 5 N.m at the speed of the input, 50 rad/s times the ratio squared
    assert space["braked"].lost["brake"] - before == pytest.approx(
        5.0 * 50.0 * space["ratio"] ** 2 * 1e-3, rel=1e-2
    )
