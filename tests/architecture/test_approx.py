"""Comparisons can fail: small SI numbers, and references that are made of something else."""

from __future__ import annotations

import ast
from pathlib import Path

import numpy as np
import pytest

SMALL = 1e-14
REFERENCES = sorted((Path(__file__).parents[1] / "references").glob("*.py"))
PACKAGE = ("gearlube", "gearlube_core", "drivetrain", "fmu_src")


@pytest.mark.parametrize("expected", [SMALL, [SMALL], np.array([SMALL])], ids=type)
def test_a_relative_tolerance_holds_for_small_numbers_too(expected: object):
    found = np.multiply(expected, 1.1)
    assert found != pytest.approx(expected, rel=0.01)
    assert found == pytest.approx(expected, rel=0.11)
    assert found == pytest.approx(expected, abs=SMALL)


@pytest.mark.parametrize("path", REFERENCES, ids=lambda path: path.name)
def test_an_independent_reference_imports_nothing_of_the_package(path: Path):
    modules = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            modules |= {one.name.partition(".")[0] for one in node.names}
        elif isinstance(node, ast.ImportFrom):
            modules.add(str(node.module).partition(".")[0])
    assert not modules & {*PACKAGE, "tests"}


def test_there_are_independent_references():
    assert len(REFERENCES) > 3
